"""Exact arcs: one odometry step, a million of them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from benchmarks import truth
from benchmarks.limits import Limits
from benchmarks.measure import Contender, Workload
from benchmarks.peers import jax64, load
from benchmarks.single import as_they_come, warmed
from coplanar import Displacement, Pose, Twist
from coplanar.engine import evaluator
from coplanar.laws import se2

DT = 0.01  # [s]


class Steps(NamedTuple):
    """Poses and the displacements that follow, shape (rows,)."""

    x: np.ndarray
    y: np.ndarray
    theta: np.ndarray
    dx: np.ndarray
    dy: np.ndarray
    dtheta: np.ndarray


def steps(rows: int) -> Steps:
    """Poses within metres, increments of a tick of 10 ms; every hundredth does not turn, another hardly does."""
    rng = np.random.default_rng(1)
    x, y, theta = rng.uniform(-3.0, 3.0, (3, rows))
    vx, vy, omega = rng.uniform(-2.0, 2.0, (3, rows))
    omega[::100], omega[1::100] = 0.0, 1e-9
    return Steps(x, y, theta, vx * DT, vy * DT, omega * DT)


def first(data: Steps) -> list[float]:
    """The row that one call works on."""
    return [float(column[2]) for column in data]


def same_row(data: Steps, count: int) -> np.ndarray:
    """Truth of that row."""
    del count
    return truth.rows(truth.arc, [column[2:3] for column in data], 1)


def objects(data: Steps) -> Contender:
    """What a tick does: a twist is made of velocities, the next pose of it, and its three numbers are read."""
    x, y, theta, dx, dy, dtheta = first(data)
    pose, vx, vy, omega = Pose(x, y, theta), dx / DT, dy / DT, dtheta / DT

    def call() -> tuple[float, float, float]:
        now = pose.integrate(Twist(vx, vy, omega), DT)
        return now.x, now.y, now.theta

    return Contender("coplanar: pose.integrate(Twist(...), dt), read", call, 1)


def lean(data: Steps) -> Contender:
    """The next pose alone, of a twist that is there."""
    x, y, theta, dx, dy, dtheta = first(data)
    pose, twist = Pose(x, y, theta), Twist(dx / DT, dy / DT, dtheta / DT)
    return Contender("coplanar: pose.integrate(twist, dt) alone", lambda: pose.integrate(twist, DT), 1)


def bare_law(data: Steps) -> Contender:
    """The law on floats, without the objects."""
    row = first(data)
    law = evaluator(se2.step)
    return Contender("coplanar: the law on floats", lambda: law(*row), 1)


def wpilib_pose(x: float, y: float, theta: float) -> Any:
    """A Pose2d."""
    geometry = load("wpimath.geometry")
    return geometry.Pose2d(x, y, geometry.Rotation2d(theta))


def wpilib_read(poses: Any) -> np.ndarray:
    """Columns of one Pose2d or of a list of them."""
    many = poses if isinstance(poses, list) else [poses]
    return np.array([(p.X(), p.Y(), p.rotation().radians()) for p in many])


def wpilib_once(data: Steps) -> Contender:
    """C++ with a Python binding: the same tick."""
    x, y, theta, dx, dy, dtheta = first(data)
    twist_of = load("wpimath.geometry").Twist2d
    pose, vx, vy, omega = wpilib_pose(x, y, theta), dx / DT, dy / DT, dtheta / DT

    def call() -> tuple[float, float, float]:
        now = pose.exp(twist_of(vx * DT, vy * DT, omega * DT))
        return now.X(), now.Y(), now.rotation().radians()

    return Contender("WPILib (C++), read", call, 1, slack=1e-9)


def wpilib_lean(data: Steps) -> Contender:
    """The next pose alone, of a twist that is there; nothing of it comes to Python."""
    x, y, theta, *way = first(data)
    pose, twist = wpilib_pose(x, y, theta), load("wpimath.geometry").Twist2d(*way)
    return Contender("WPILib (C++), pose.exp(twist) alone", lambda: pose.exp(twist), 1, wpilib_read, slack=1e-9,
                     note="not a whole tick", counts=False)  # fmt: skip


def spatialmath_once(data: Steps) -> Contender:
    """SE2 composed with SE2.Exp."""
    module = load("spatialmath")
    x, y, theta, dx, dy, dtheta = first(data)
    pose, twist = module.SE2(x, y, theta), np.array([dx, dy, dtheta])
    read = lambda T: np.array([[*T.t, T.theta()]])  # noqa: E731
    return Contender("spatialmath", lambda: pose * module.SE2.Exp(twist), 1, read)


def jaxlie_once(data: Steps) -> Contender:
    """Compiled by JAX, one row."""
    jax, jnp = jax64()
    jaxlie = load("jaxlie")
    x, y, theta, dx, dy, dtheta = first(data)
    pose, twist = jaxlie.SE2.from_xy_theta(x, y, theta), jnp.array([dx, dy, dtheta])
    run = jax.jit(lambda T, xi: T @ jaxlie.SE2.exp(xi))
    return Contender("jaxlie, jit", lambda: run(pose, twist).parameters().block_until_ready(), 1, jaxlie_read)


def jaxlie_read(parameters: Any) -> np.ndarray:
    """Columns of (cos, sin, x, y)."""
    c, s, x, y = np.atleast_2d(np.asarray(parameters)).T
    return np.column_stack((x, y, np.arctan2(s, c)))


def numpy_euler(data: Steps) -> Contender:
    """A motion model as in teaching code: matrices and an Euler step."""
    x, y, theta, dx, dy, dtheta = first(data)
    state, u = np.array([[x], [y], [theta]]), np.array([[dx / DT], [dy / DT], [dtheta / DT]])

    def call() -> np.ndarray:
        c, s = np.cos(state[2, 0]), np.sin(state[2, 0])
        rates = np.array([[DT * c, -DT * s, 0.0], [DT * s, DT * c, 0.0], [0.0, 0.0, DT]])
        return np.eye(3) @ state + rates @ u

    return Contender(
        "NumPy, Euler in matrices", call, 1, lambda a: a.T, slack=1e-3, note="Euler, not exact", counts=False
    )


def batch(data: Steps) -> Contender:
    """Poses and displacements that are there."""
    poses, increments = Pose(*data[:3]), Displacement(*data[3:])
    return Contender("coplanar: poses.step(increments)", lambda: poses.step(increments), len(data.x))


def batch_law(data: Steps) -> Contender:
    """The compiled law into arrays that are there."""
    law, out = evaluator(se2.step), tuple(np.empty(len(data.x)) for _ in range(3))
    return Contender("coplanar: the law, out=", lambda: law.on_compiled(*data, out=out), len(data.x))


def single_law(data: Steps) -> Contender:
    """The same in single precision."""
    law, given = evaluator(se2.step), [np.float32(column) for column in data]
    out = tuple(np.empty(len(data.x), np.float32) for _ in range(3))
    call = lambda: law.on_compiled(*given, out=out)  # noqa: E731
    return Contender("coplanar: the law, out=, float32", call, len(data.x), slack=1e-5)


def numpy_batch(data: Steps) -> Contender:
    """As an expert writes it: half angle, sinc, in place where it can be."""

    def call() -> tuple[np.ndarray, ...]:
        half = 0.5 * data.dtheta
        chord = np.sinc(half / np.pi)
        middle = data.theta + half
        c, s = np.cos(middle) * chord, np.sin(middle) * chord
        return data.x + c * data.dx - s * data.dy, data.y + s * data.dx + c * data.dy, data.theta + data.dtheta

    return Contender("NumPy", call, len(data.x))


def jaxlie_batch(data: Steps) -> Contender:
    """Compiled and vectorised by JAX, on as many threads as it takes."""
    jax, jnp = jax64()
    jaxlie = load("jaxlie")
    step = lambda x, y, theta, xi: (jaxlie.SE2.from_xy_theta(x, y, theta) @ jaxlie.SE2.exp(xi)).parameters()  # noqa: E731
    run = jax.jit(jax.vmap(step))
    columns = [jnp.asarray(c) for c in data[:3]] + [jnp.stack(data[3:], axis=-1)]
    return Contender(
        "jaxlie, jit(vmap)", lambda: run(*columns).block_until_ready(), len(data.x), jaxlie_read, slack=1e-9
    )


def wpilib_batch(data: Steps) -> Contender:
    """A loop, from lists of numbers to poses."""
    twist_of, count = load("wpimath.geometry").Twist2d, 2000
    poses = [wpilib_pose(*row) for row in zip(*(c[:count].tolist() for c in data[:3]), strict=True)]
    ways = list(zip(*(c[:count].tolist() for c in data[3:]), strict=True))
    call = lambda: [pose.exp(twist_of(*way)) for pose, way in zip(poses, ways, strict=True)]  # noqa: E731
    return Contender("WPILib (C++), loop", call, count, wpilib_read, slack=1e-9)


def once_floor(limits: Limits, threads: int, data: Any) -> float:
    """One call of a C function."""
    del threads, data
    return limits.call


def batch_floor(limits: Limits, threads: int, data: Any) -> float:
    """Six numbers in, three out; a sincos and the sine of the half angle."""
    del data
    return limits.floor(threads, read=6, written=3, sincos=2)


ONCE = Workload(
    "step", "one odometry step", "call", steps, (100, 100),
    (warmed(objects), warmed(lean), as_they_come(objects), bare_law),
    {"robotpy-wpimath": wpilib_once, "robotpy-wpimath ": wpilib_lean, "jaxlie": jaxlie_once,
     "spatialmath (roboticstoolbox)": spatialmath_once, "NumPy": numpy_euler},
    once_floor, {1: 1500.0}, 1e-12, same_row, (1, 1), (None,),
)  # fmt: skip

BATCH = Workload(
    "arcs", "10^6 exact arcs", "row", steps, (1_000_000, 100_000), (batch, batch_law, single_law),
    {"NumPy": numpy_batch, "jaxlie": jaxlie_batch, "robotpy-wpimath": wpilib_batch},
    batch_floor, {1: 4.5, 2: 2.7}, 1e-12, lambda data, count: truth.rows(truth.arc, data, count), (1000, 200),
)  # fmt: skip
