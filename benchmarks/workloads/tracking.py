"""Closed loops: many robots with gains of their own follow a circle by a point ahead of their axle."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from benchmarks import truth
from benchmarks.limits import Limits
from benchmarks.measure import Contender, Workload
from benchmarks.peers import jax64
from coplanar import Circle, PointTracker, Pose, Unicycle, simulate

POINT, STEP, DURATION = 0.1, 0.01, 10.0  # [m], [s], [s]
STEPS = round(DURATION / STEP)


class Robots(NamedTuple):
    """Gains and starting poses, shape (rows,); the reference's points and velocities, shape (steps, 2)."""

    kp: np.ndarray
    kd: np.ndarray
    x: np.ndarray
    y: np.ndarray
    theta: np.ndarray
    points: np.ndarray
    ahead: np.ndarray


def robots(rows: int) -> Robots:
    """Gains within what is stable, robots within half a metre of the circle's start."""
    rng = np.random.default_rng(5)
    kp, kd = rng.uniform(1.0, 20.0, rows), rng.uniform(0.0, 0.3, rows)
    x, y, theta = rng.uniform(0.5, 1.5, rows), rng.uniform(-0.5, 0.5, rows), rng.uniform(1.0, 2.0, rows)
    reference, times = Circle(1.0).over(DURATION), STEP * np.arange(STEPS)
    return Robots(kp, kd, x, y, theta, reference.position(times), reference.velocity(times))


def closed_loop(data: Robots, **keep: Any) -> Callable[[], Any]:
    """``simulate`` as it is called."""
    tracker = PointTracker((POINT, 0.0), kp=data.kp, kd=data.kd, feedforward=True)
    reference, start = Circle(1.0).over(DURATION), Pose(data.x, data.y, data.theta)
    return lambda: simulate(Unicycle(), tracker, reference, step=STEP, start=start, **keep)


def last(run: Any) -> np.ndarray:
    """The last poses of a run."""
    return np.column_stack([run[name][-1] for name in ("x", "y", "theta")])


def at_the_end(data: Robots) -> Contender:
    """The end alone is kept, as the peers have it."""
    return Contender("coplanar: simulate(..., keep='end')", closed_loop(data, keep="end"), len(data.x) * STEPS, last)


def objects(data: Robots) -> Contender:
    """Every pose, command and error is kept."""
    return Contender("coplanar: simulate(...), all kept", closed_loop(data), len(data.x) * STEPS, last)


def paths(data: Robots) -> Contender:
    """The poses are kept, not the commands and errors."""
    call = closed_loop(data, keep=("x", "y", "theta"))
    return Contender("coplanar: simulate(..., keep=('x', 'y', 'theta'))", call, len(data.x) * STEPS, last)


def step(xp: Any, state: Any, row: Any, kp: Any, kd: Any) -> Any:
    """One step of PD control with feed-forward and Euler's method, over NumPy or JAX."""
    x, y, theta, last_x, last_y = state
    rx, ry, fx, fy = row
    c, s = xp.cos(theta), xp.sin(theta)
    ex, ey = rx - x - POINT * c, ry - y - POINT * s
    wx = kp * ex + kd * (ex - last_x) / STEP + fx
    wy = kp * ey + kd * (ey - last_y) / STEP + fy
    v, omega = c * wx + s * wy, (c * wy - s * wx) / POINT
    return x + STEP * v * c, y + STEP * v * s, theta + STEP * omega, ex, ey


def numpy_batch(data: Robots) -> Contender:
    """As an expert writes it: a loop over steps, robots in rows; the end alone is kept."""
    table = list(zip(*data.points.T.tolist(), *data.ahead.T.tolist(), strict=True))

    def call() -> tuple[np.ndarray, ...]:
        state: Any = (data.x, data.y, data.theta, np.zeros_like(data.x), np.zeros_like(data.x))
        for row in table:
            state = step(np, state, row, data.kp, data.kd)
        return state[:3]

    return Contender("NumPy, end kept", call, len(data.x) * STEPS)


def jax_batch(data: Robots) -> Contender:
    """``scan`` of the same step; the end alone is kept."""
    jax, jnp = jax64()
    rows = jnp.asarray(np.column_stack((data.points, data.ahead)))
    kp, kd, x, y, theta = map(jnp.asarray, data[:5])

    @jax.jit
    def roll(kp: Any, kd: Any, x: Any, y: Any, theta: Any) -> Any:
        begin = (x, y, theta, 0.0 * x, 0.0 * x)
        return jax.lax.scan(lambda state, row: (step(jnp, state, row, kp, kd), None), begin, rows)[0][:3]

    call = lambda: jax.block_until_ready(roll(kp, kd, x, y, theta))  # noqa: E731
    return Contender("JAX jit(scan), end kept", call, len(data.x) * STEPS)


def teaching(data: Robots) -> Contender:
    """One robot after another in small matrices, as teaching code has it."""

    def call() -> np.ndarray:
        pose, last = np.array([data.x[0], data.y[0], data.theta[0]]), np.zeros(2)
        for point, ahead in zip(data.points, data.ahead, strict=True):
            c, s = np.cos(pose[2]), np.sin(pose[2])
            error = point - pose[:2] - np.array([[c, -s], [s, c]]) @ np.array([POINT, 0.0])
            w = data.kp[0] * error + data.kd[0] * (error - last) / STEP + ahead
            v, omega = np.linalg.inv(np.array([[c, -POINT * s], [s, POINT * c]])) @ w
            pose, last = pose + STEP * np.array([v * c, v * s, omega]), error
        return pose[None]

    return Contender("NumPy, one robot in matrices", call, STEPS, lambda a: a)


def ends(data: Robots, count: int) -> np.ndarray:
    """Truth: the same loop at fifty digits."""
    rows = [truth.exact(row) for row in np.column_stack((data.points, data.ahead))]

    def end(kp: Any, kd: Any, x: Any, y: Any, theta: Any) -> Any:
        state, h, p = (x, y, theta, truth.mpf(0), truth.mpf(0)), truth.mpf(STEP), truth.mpf(POINT)
        for rx, ry, fx, fy in rows:
            x, y, theta, last_x, last_y = state
            c, s = truth.mp.cos_sin(theta)
            ex, ey = rx - x - p * c, ry - y - p * s
            wx, wy = kp * ex + kd * (ex - last_x) / h + fx, kp * ey + kd * (ey - last_y) / h + fy
            v, omega = c * wx + s * wy, (c * wy - s * wx) / p
            state = x + h * v * c, y + h * v * s, theta + h * omega, ex, ey
        return state[:3]

    return truth.rows(end, data[:5], count)


def floor(limits: Limits, threads: int, data: Any) -> float:
    """One sincos; the state stays in the nearest cache."""
    del data
    return limits.floor(threads, read=0, written=0, sincos=1)


def kept_floor(limits: Limits, threads: int, data: Any) -> float:
    """Seven numbers kept of every step; one sincos."""
    del data
    return limits.floor(threads, read=0, written=7, sincos=1)


END = Workload(
    "tracking", "closed-loop point tracking, 1000 robots x 1000 steps", "robot-step", robots, (1000, 100),
    (at_the_end,), {"NumPy": numpy_batch, "JAX": jax_batch, "NumPy ": teaching},
    floor, {1: 3.0, 2: 1.6}, 1e-9, ends, (5, 1),
)  # fmt: skip

KEPT = Workload(
    "tracked", "closed-loop point tracking, every step kept", "robot-step", robots, (1000, 100), (objects, paths),
    {"NumPy": numpy_batch, "JAX": jax_batch}, kept_floor, {}, 1e-9, ends, (5, 1),
)  # fmt: skip
