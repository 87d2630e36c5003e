"""Open loop: many robots drive programs of arcs; one robot's log of a million ticks."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from benchmarks import truth
from benchmarks.limits import Limits
from benchmarks.measure import Contender, Workload
from benchmarks.peers import jax64, load
from benchmarks.workloads.arcs import wpilib_pose, wpilib_read
from coplanar import Odometry, Pose

STEPS, DT, TRACK = 100, 0.02, 0.4  # [1], [s], [m]


class Commands(NamedTuple):
    """Velocities of every robot and step, shape (robots, steps)."""

    v: np.ndarray
    omega: np.ndarray


class Log(NamedTuple):
    """How far the wheels rolled in each tick [m], shape (ticks,)."""

    left: np.ndarray
    right: np.ndarray


def commands(rows: int) -> Commands:
    """Velocities as a sampling controller draws them."""
    rng = np.random.default_rng(6)
    return Commands(rng.uniform(0.0, 1.0, (rows, STEPS)), rng.uniform(-1.0, 1.0, (rows, STEPS)))


def log(rows: int) -> Log:
    """Ticks of a millimetre, in encoder counts of 0.1 mm."""
    rng = np.random.default_rng(7)
    left, right = rng.integers(-5, 25, (2, rows)) * 1e-4
    return Log(left, right)


def paths(answer: Any) -> np.ndarray:
    """The whole paths of the robots, one robot a row."""
    return np.hstack([np.asarray(part).reshape(len(part), -1) for part in answer])


def objects(data: Commands) -> Contender:
    """``Odometry.from_velocities(...).path``: every pose is kept."""
    times, start = DT * np.arange(STEPS + 1), Pose()
    call = lambda: Odometry.from_velocities(data.v, data.omega, times).path(start)  # noqa: E731
    read = lambda pose: paths([part[..., 1:] for part in pose.parts])  # noqa: E731
    return Contender("coplanar: Odometry.from_velocities(...).path(start)", call, data.v.size, read)


def numpy_batch(data: Commands) -> Contender:
    """As an expert writes it: running sums of turns, then of chords."""

    def call() -> tuple[np.ndarray, ...]:
        half = (0.5 * DT) * data.omega
        heading = np.cumsum(DT * data.omega, axis=1)
        middle = heading - half
        chord = DT * data.v * np.sinc(half / np.pi)
        return np.cumsum(chord * np.cos(middle), axis=1), np.cumsum(chord * np.sin(middle), axis=1), heading

    return Contender("NumPy, running sums", call, data.v.size, paths)


def jax_batch(data: Commands) -> Contender:
    """The same, compiled by JAX."""
    jax, jnp = jax64()

    @jax.jit
    def roll(v: Any, omega: Any) -> Any:
        half, heading = (0.5 * DT) * omega, jnp.cumsum(DT * omega, axis=1)
        chord, middle = DT * v * jnp.sinc(half / jnp.pi), heading - half
        return jnp.cumsum(chord * jnp.cos(middle), axis=1), jnp.cumsum(chord * jnp.sin(middle), axis=1), heading

    v, omega = map(jnp.asarray, data)
    return Contender("JAX jit, running sums", lambda: jax.block_until_ready(roll(v, omega)), data.v.size, paths)


def wpilib_loop(data: Commands) -> Contender:
    """C++, step after step; headings of less than a turn compare as they are."""
    twist, start, count = load("wpimath.geometry").Twist2d, wpilib_pose(0.0, 0.0, 0.0), 20
    table = [
        list(zip(v, w, strict=True)) for v, w in zip(data.v[:count].tolist(), data.omega[:count].tolist(), strict=True)
    ]

    def call() -> list[list[Any]]:
        robots = []
        for row in table:
            pose, path = start, []
            for v, omega in row:
                pose = pose.exp(twist(v * DT, 0.0, omega * DT))
                path.append(pose)
            robots.append(path)
        return robots

    read = lambda robots: np.array([wpilib_read(path).T.reshape(-1) for path in robots])  # noqa: E731
    return Contender("WPILib (C++), loop", call, count * STEPS, read, slack=1e-8)


def rolled(data: Commands, count: int) -> np.ndarray:
    """Truth: arc after arc at fifty digits."""
    answer = []
    for v, omega in zip(data.v[:count], data.omega[:count], strict=True):
        pose, path, dt = (truth.mpf(0),) * 3, [], truth.mpf(DT)
        for a, b in zip(truth.exact(v), truth.exact(omega), strict=True):
            pose = truth.arc(*pose, a * dt, truth.mpf(0), b * dt)
            path.append([float(p) for p in pose])
        answer.append(np.array(path).T.reshape(-1))
    return np.array(answer)


def odometer(data: Log) -> Contender:
    """``Odometry.from_wheels(...).path``: every pose is kept."""
    start = Pose()
    call = lambda: Odometry.from_wheels(data.left, data.right, track=TRACK).path(start)  # noqa: E731
    read = lambda pose: np.column_stack(pose.parts)[1:]  # noqa: E731
    return Contender("coplanar: Odometry.from_wheels(...).path(start)", call, len(data.left), read)


def numpy_log(data: Log) -> Contender:
    """As an expert writes it: running sums."""

    def call() -> tuple[np.ndarray, ...]:
        turn = (data.right - data.left) * (1.0 / TRACK)
        heading = np.cumsum(turn)
        middle = heading - 0.5 * turn
        chord = 0.5 * (data.left + data.right) * np.sinc(turn / (2.0 * np.pi))
        return np.cumsum(chord * np.cos(middle)), np.cumsum(chord * np.sin(middle)), heading

    return Contender("NumPy, running sums", call, len(data.left))


def wpilib_log(data: Log) -> Contender:
    """C++ odometry, tick after tick; it takes the heading from a gyroscope, here the wheels' own."""
    odometry, rotation, count = (
        load("wpimath.kinematics").DifferentialDriveOdometry,
        load("wpimath.geometry").Rotation2d,
        2000,
    )
    left, right = np.cumsum(data.left[:count]), np.cumsum(data.right[:count])
    ticks = list(zip(((right - left) / TRACK).tolist(), left.tolist(), right.tolist(), strict=True))

    def call() -> list[Any]:
        track = odometry(rotation(0.0), 0.0, 0.0)
        return [track.update(rotation(angle), a, b) for angle, a, b in ticks]

    return Contender("WPILib (C++) odometry, loop", call, count, wpilib_read, slack=1e-8)


def ticked(data: Log, count: int) -> np.ndarray:
    """Truth: tick after tick at fifty digits."""
    pose, path, track = (truth.mpf(0),) * 3, [], truth.mpf(TRACK)
    for a, b in zip(truth.exact(data.left[:count]), truth.exact(data.right[:count]), strict=True):
        pose = truth.arc(*pose, (a + b) / 2, truth.mpf(0), (b - a) / track)
        path.append([float(p) for p in pose])
    return np.array(path)


def roll_floor(limits: Limits, threads: int, data: Any) -> float:
    """Two numbers in, three kept; a sincos and the sine of the half angle."""
    del data
    return limits.floor(threads, read=2, written=3, sincos=2)


ROLLS = Workload(
    "rollouts", f"open-loop arcs, 10^4 robots x {STEPS} steps", "robot-step", commands, (10_000, 1000), (objects,),
    {"NumPy": numpy_batch, "JAX": jax_batch, "robotpy-wpimath": wpilib_loop},
    roll_floor, {1: 6.0, 2: 3.4}, 1e-11, rolled, (20, 3),
)  # fmt: skip

LOG = Workload(
    "log", "odometry over a log of 10^6 ticks", "tick", log, (1_000_000, 100_000), (odometer,),
    {"NumPy": numpy_log, "robotpy-wpimath": wpilib_log}, roll_floor, {}, 1e-8, ticked, (2000, 300),
)  # fmt: skip
