"""Constant accelerations: one segment, a million of them to rounding."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from benchmarks import truth
from benchmarks.limits import Limits
from benchmarks.measure import Contender, Workload
from benchmarks.peers import jax64, load
from benchmarks.single import as_they_come, warmed
from coplanar import Pose, Segment
from coplanar.engine import evaluator
from coplanar.laws import motion

NODES = 12  # of the experts' Gauss rule: enough for 3 rad


class Moves(NamedTuple):
    """Start poses, velocities, accelerations and durations, shape (rows,)."""

    x: np.ndarray
    y: np.ndarray
    theta: np.ndarray
    v: np.ndarray
    omega: np.ndarray
    a: np.ndarray
    alpha: np.ndarray
    t: np.ndarray


def moves(rows: int) -> Moves:
    """Turns of at most 3 rad; some rows do not turn, or hardly, or at a constant rate."""
    rng = np.random.default_rng(3)
    x, y, theta = rng.uniform(-3.0, 3.0, (3, rows))
    v, omega, a, alpha = rng.uniform(-2.0, 2.0, (4, rows))
    omega[::50], alpha[1::50] = 0.0, 0.0
    omega[2::50], alpha[2::50] = 1e-9, 1e-9
    return Moves(x, y, theta, v, omega, a, alpha, rng.uniform(0.1, 1.0, rows))


def clothoids(rows: int) -> Moves:
    """The same at constant speed, as pyclothoids has them."""
    data = moves(rows)
    return data._replace(v=np.abs(data.v) + 0.1, a=np.zeros(rows))


def first(data: Moves) -> list[float]:
    """The row that one call works on."""
    return [float(column[3]) for column in data]


def same_row(data: Moves, count: int) -> np.ndarray:
    """Truth of that row."""
    del count
    return truth.rows(truth.segment, [column[3:4] for column in data], 1)


def objects(data: Moves) -> Contender:
    """A segment that is there: its end."""
    x, y, theta, v, omega, a, alpha, t = first(data)
    segment, start = Segment(v, omega, a, alpha, duration=t), Pose(x, y, theta)
    return Contender("coplanar: segment.end(start)", lambda: segment.end(start), 1)


def built(data: Moves) -> Contender:
    """The segment made and its end."""
    x, y, theta, v, omega, a, alpha, t = first(data)
    start = Pose(x, y, theta)
    return Contender("coplanar: Segment(...).end(start)", lambda: Segment(v, omega, a, alpha, duration=t).end(start), 1)


def bare_law(data: Moves) -> Contender:
    """The law on floats."""
    row, law = first(data), evaluator(motion.segment)
    return Contender("coplanar: the law on floats", lambda: law(*row), 1)


def pyclothoids_once(data: Moves) -> Contender:
    """A clothoid made and its end, C++ with a Python binding."""
    make = load("pyclothoids").Clothoid.StandardParams
    x, y, theta, v, omega, _, alpha, t = first(data)

    def call() -> tuple[float, float, float]:
        curve = make(x, y, theta, omega / v, alpha / (v * v), v * t)
        return curve.XEnd, curve.YEnd, curve.ThetaEnd

    return Contender("pyclothoids (C++), built", call, 1, slack=1e-9, note="constant speed only")


def pyclothoids_there(data: Moves) -> Contender:
    """A clothoid that is there, evaluated at its end."""
    make = load("pyclothoids").Clothoid.StandardParams
    x, y, theta, v, omega, _, alpha, t = first(data)
    curve, length = make(x, y, theta, omega / v, alpha / (v * v), v * t), v * t
    call = lambda: (curve.X(length), curve.Y(length), curve.Theta(length))  # noqa: E731
    return Contender("pyclothoids (C++), evaluated", call, 1, slack=1e-9, note="constant speed only")


def quad_once(data: Moves) -> Contender:
    """QUADPACK twice."""
    quad, cos, sin = load("scipy.integrate").quad, load("math").cos, load("math").sin
    x, y, theta, v, omega, a, alpha, t = first(data)
    rate_x = lambda s: (v + a * s) * cos(theta + (omega + 0.5 * alpha * s) * s)  # noqa: E731
    rate_y = lambda s: (v + a * s) * sin(theta + (omega + 0.5 * alpha * s) * s)  # noqa: E731

    def call() -> tuple[float, float, float]:
        return x + quad(rate_x, 0.0, t)[0], y + quad(rate_y, 0.0, t)[0], theta + omega * t + 0.5 * alpha * t * t

    return Contender("SciPy quad, twice", call, 1)


def batch(data: Moves) -> Contender:
    """Segments that are there: their ends."""
    segments, start = Segment(*data[3:7], duration=data.t), Pose(*data[:3])
    return Contender("coplanar: segments.end(starts)", lambda: segments.end(start), len(data.x))


def batch_law(data: Moves) -> Contender:
    """The compiled law into arrays that are there."""
    law, out = evaluator(motion.segment), tuple(np.empty(len(data.x)) for _ in range(3))
    return Contender("coplanar: the law, out=", lambda: law.on_compiled(*data, out=out), len(data.x))


def single_law(data: Moves) -> Contender:
    """The same in single precision."""
    law, given = evaluator(motion.segment), [np.float32(column) for column in data]
    out = tuple(np.empty(len(data.x), np.float32) for _ in range(3))
    call = lambda: law.on_compiled(*given, out=out)  # noqa: E731
    return Contender("coplanar: the law, out=, float32", call, len(data.x), slack=1e-5)


def numpy_batch(data: Moves) -> Contender:
    """As an expert writes it: a Gauss rule of 12 nodes, node by node, on blocks that stay in the cache."""
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    part = [np.ascontiguousarray(c[:100_000]) for c in data]

    def call() -> tuple[np.ndarray, ...]:
        ends = [_gauss(tuple(c[i : i + 5000] for c in part), nodes, weights) for i in range(0, len(part[0]), 5000)]
        return tuple(np.concatenate(c) for c in zip(*ends, strict=True))

    return Contender(f"NumPy, {NODES} Gauss nodes, blocked", call, len(part[0]))


def _gauss(row: Any, nodes: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, ...]:
    x, y, theta, v, omega, a, alpha, t = row
    dx, dy, half = np.zeros_like(x), np.zeros_like(y), 0.5 * t
    for node, weight in zip(nodes, weights, strict=True):
        s = half * (1.0 + node)
        way, angle = weight * (v + a * s), theta + (omega + 0.5 * alpha * s) * s
        dx += way * np.cos(angle)
        dy += way * np.sin(angle)
    return x + half * dx, y + half * dy, theta + (omega + 0.5 * alpha * t) * t


def jax_batch(data: Moves) -> Contender:
    """The same rule, compiled by JAX."""
    jax, jnp = jax64()
    nodes, weights = map(jnp.asarray, np.polynomial.legendre.leggauss(NODES))

    def end(x: Any, y: Any, theta: Any, v: Any, omega: Any, a: Any, alpha: Any, t: Any) -> tuple[Any, Any, Any]:
        s = 0.5 * t * (1.0 + nodes)
        way, angle = 0.5 * t * weights * (v + a * s), theta + (omega + 0.5 * alpha * s) * s
        return x + way @ jnp.cos(angle), y + way @ jnp.sin(angle), theta + (omega + 0.5 * alpha * t) * t

    run, part = jax.jit(jax.vmap(end)), [jnp.asarray(c[:200_000]) for c in data]
    return Contender(f"JAX jit, {NODES} Gauss nodes", lambda: jax.block_until_ready(run(*part)), len(part[0]))


def fresnel_batch(data: Moves) -> Contender:
    """The closed form in Fresnel integrals; it divides by the turn acceleration."""
    fresnel = load("scipy.special").fresnel
    part = [np.ascontiguousarray(c[:100_000]) for c in data]

    def call() -> tuple[np.ndarray, ...]:
        x, y, theta, v, omega, a, alpha, t = part
        rate = np.where(np.abs(alpha) < 1e-6, 1e-6, alpha)
        root, sign = np.sqrt(np.pi / np.abs(rate)), np.sign(rate)
        lower, upper = omega / rate, omega / rate + t
        (s1, c1), (s0, c0) = fresnel(upper / root), fresnel(lower / root)
        base = theta - 0.5 * omega * omega / rate
        whole = root * ((c1 - c0) + 1j * sign * (s1 - s0)) * np.exp(1j * base)
        ends = np.exp(1j * (base + 0.5 * rate * upper**2)) - np.exp(1j * (base + 0.5 * rate * lower**2))
        way = (v - a * lower) * whole + a / (1j * rate) * ends
        return x + way.real, y + way.imag, theta + (omega + 0.5 * alpha * t) * t

    return Contender(
        "SciPy fresnel, closed form",
        call,
        len(part[0]),
        slack=1e9,
        note="loses digits where alpha is small",
        counts=False,
    )


def pyclothoids_batch(data: Moves) -> Contender:
    """A loop over clothoids at constant speed: other rows, the same count."""
    make, count = load("pyclothoids").Clothoid.StandardParams, 1000
    same = clothoids(count)
    rows = [
        (x, y, h, w / v, k / (v * v), v * t)
        for x, y, h, v, w, _, k, t in zip(*map(np.ndarray.tolist, same), strict=True)
    ]

    def call() -> list[tuple[float, float, float]]:
        curves = [make(*row) for row in rows]
        return [(c.XEnd, c.YEnd, c.ThetaEnd) for c in curves]

    def read(answer: list[Any]) -> np.ndarray:
        """Set against ours at the same constant speeds, then placed on this workload's answer."""
        ours = np.column_stack(evaluator(motion.segment)(*same))
        return np.array(answer) - ours + np.column_stack(evaluator(motion.segment)(*(c[:count] for c in data)))

    return Contender("pyclothoids (C++), loop", call, count, read, slack=1e-9, note="constant speed only")


def once_floor(limits: Limits, threads: int, data: Any) -> float:
    """One call of a C function."""
    del threads, data
    return limits.call


def batch_floor(limits: Limits, threads: int, data: Any) -> float:
    """Eight numbers in, three out; twelve nodes and the middle, a sincos each."""
    del data
    return limits.floor(threads, read=8, written=3, sincos=NODES + 1)


ONCE = Workload(
    "segment", "one constant-acceleration segment", "call", clothoids, (10, 10),
    (warmed(objects), warmed(built), as_they_come(objects), as_they_come(built), bare_law),
    {"pyclothoids": pyclothoids_once, "pyclothoids ": pyclothoids_there, "SciPy quad": quad_once},
    once_floor, {1: 3000.0}, 1e-12, same_row, (1, 1), (None,),
)  # fmt: skip

BATCH = Workload(
    "segments", "10^6 segments to 1e-14", "row", moves, (1_000_000, 100_000), (batch, batch_law, single_law),
    {"NumPy": numpy_batch, "JAX": jax_batch, "SciPy fresnel": fresnel_batch, "pyclothoids": pyclothoids_batch},
    batch_floor, {1: 28.0, 2: 14.0}, 1e-12, lambda data, count: truth.rows(truth.segment, data, count), (300, 50),
)  # fmt: skip
