"""Projectiles under quadratic drag: where shots come down, and how to aim at a speed."""

from __future__ import annotations

import logging
import math
from typing import Any, NamedTuple

import numpy as np

from benchmarks import truth
from benchmarks.limits import Limits
from benchmarks.measure import Contender, Workload
from benchmarks.peers import load
from benchmarks.single import as_they_come, warmed
from coplanar.flight import Projectile

DRAG, GRAVITY = 0.02, 9.81  # C/m [1/m], [m/s^2]
BALL = Projectile(mass=1.0, drag=DRAG, gravity=GRAVITY)
FOOT = 0.3048  # [m]
EVALUATIONS, NODES = 2, 48  # of the quadrature, to 1e-10: at the crossing, and once more after a Newton step


class Shots(NamedTuple):
    """Speeds and angles of launch, and how far they carry, shape (rows,)."""

    speed: np.ndarray
    angle: np.ndarray
    distance: np.ndarray


def shots(rows: int) -> Shots:
    """Low arcs that stay within 30 ft, where py-ballisticcalc has the same air all the way."""
    rng = np.random.default_rng(8)
    speed, angle = rng.uniform(12.0, 30.0, rows), rng.uniform(0.1, 0.5, rows)
    speed[0], angle[0] = 30.0, 0.4
    return Shots(speed, angle, np.zeros(rows))


def aims(rows: int) -> Shots:
    """The same with the distances that they carry: what is aimed at."""
    data = shots(rows)
    return data._replace(distance=np.asarray(BALL.launch(speed=data.speed, angle=data.angle).impact().state.x))


def landed(impact: Any) -> np.ndarray:
    """Distance and time of flight."""
    return np.column_stack([np.atleast_1d(part) for part in (impact.state.x, impact.time)])


def landings(data: Shots, count: int) -> np.ndarray:
    """Truth by the hodograph at thirty digits."""
    k, g = truth.exact((DRAG, GRAVITY))
    return truth.rows(lambda v, angle: truth.impact(v, angle, k, g), data[:2], count)


def one_shot(data: Shots) -> Contender:
    """A single one."""
    speed, angle = float(data.speed[0]), float(data.angle[0])
    call = lambda: BALL.launch(speed=speed, angle=angle).impact()  # noqa: E731
    return Contender("coplanar: launch(...).impact(), one", call, 1, landed, threads=1)


def batch(data: Shots) -> Contender:
    """All of them, with status."""
    call = lambda: BALL.launch(speed=data.speed, angle=data.angle).impact()  # noqa: E731
    return Contender("coplanar: launch(...).impact()", call, len(data.speed), landed)


def rates(_: float, state: np.ndarray) -> tuple[float, float, float, float]:
    """Equations of motion for ``solve_ivp``."""
    vx, vy = state[2], state[3]
    drag = DRAG * math.hypot(vx, vy)
    return vx, vy, -drag * vx, -GRAVITY - drag * vy


def flown(speed: float, angle: float) -> tuple[float, float]:
    """Distance and time by SciPy to 1e-10."""
    begin = (0.0, 0.0, speed * math.cos(angle), speed * math.sin(angle))
    answer = load("scipy.integrate").solve_ivp(
        rates, (0.0, 20.0), begin, method="DOP853", events=down, rtol=1e-10, atol=1e-12
    )
    return answer.y_events[0][0][0], answer.t_events[0][0]


def down(_: float, state: np.ndarray) -> float:
    """Height; counts where it falls through 0."""
    return float(state[1])


down.terminal, down.direction = True, -1.0  # type: ignore[attr-defined]


def solve_ivp_loop(data: Shots) -> Contender:
    """The usual way."""
    load("scipy.integrate")
    jobs = list(zip(data.speed[:10].tolist(), data.angle[:10].tolist(), strict=True))
    return Contender("SciPy solve_ivp DOP853, loop", lambda: [flown(*job) for job in jobs], len(jobs), np.array)


def ballisticcalc() -> tuple[Any, Any, Any, Any]:
    """py-ballisticcalc with a drag coefficient that makes k = DRAG, its Cython engine, and its parts."""
    module = load("py_ballisticcalc")
    logging.getLogger("py_balcalc").setLevel(logging.WARNING)
    config = {"cGravityConstant": -GRAVITY / FOOT, "cMinimumVelocity": 0.0, "cMaximumDrop": -1.0}
    calculator = module.Calculator(config=config, engine="cythonized_rk4_engine")
    air = module.Atmo.icao()
    drag = DRAG * FOOT / (2.08551e-4 * air.density_ratio)  # its unit: 1/ft through a constant of its own
    return module, calculator, module.DragModel(1.0, [module.DragDataPoint(1.0, drag)]), air


def ballisticcalc_shot(parts: Any, speed: float, angle: float) -> Any:
    """One of its shots, over the axis."""
    module, _, drag, air = parts
    ammo = module.Ammo(drag, module.Velocity.MPS(speed))
    weapon = module.Weapon(sight_height=module.Distance.Meter(0.0))
    return module.Shot(ammo=ammo, weapon=weapon, atmo=air, relative_angle=module.Angular.Radian(angle))


def ballisticcalc_loop(data: Shots) -> Contender:
    """Cython, Runge-Kutta with its usual step; the crossing as it reports it."""
    parts = ballisticcalc()
    module, calculator = parts[0], parts[1]
    jobs = [
        ballisticcalc_shot(parts, v, a) for v, a in zip(data.speed[:20].tolist(), data.angle[:20].tolist(), strict=True)
    ]
    far, flag = module.Distance.Meter(100.0), module.TrajFlag.ZERO_DOWN

    def call() -> list[Any]:
        return [calculator.fire(job, far, flags=flag, raise_range_error=False) for job in jobs]

    def read(answer: list[Any]) -> np.ndarray:
        hits = [next(row for row in result.trajectory if row.flag & flag) for result in answer]
        return np.array([(hit.distance >> module.Distance.Meter, hit.time) for hit in hits])

    return Contender("py-ballisticcalc (Cython), loop", call, len(jobs), read, slack=1e-2, note="its usual step")


def angles(answer: Any) -> np.ndarray:
    """Low and high angle."""
    return np.column_stack([np.atleast_1d(arc.angle) for arc in (answer.low, answer.high)])


def aimed(data: Shots, count: int) -> np.ndarray:
    """Truth of the low angle."""
    k, g = truth.exact((DRAG, GRAVITY))
    return truth.rows(lambda v, a, d: (truth.low_angle(d, a, v, k, g),), data, count)


def one_aim(data: Shots) -> Contender:
    """A single one."""
    target, speed = (float(data.distance[0]), 0.0), float(data.speed[0])
    return Contender("coplanar: aim(target, speed=), one", lambda: BALL.aim(target, speed=speed), 1, angles, threads=1)


def batch_aim(data: Shots) -> Contender:
    """All of them, both arcs, with status."""
    targets = np.column_stack((data.distance, np.zeros_like(data.distance)))
    return Contender(
        "coplanar: aim(targets, speed=)", lambda: BALL.aim(targets, speed=data.speed), len(targets), angles
    )


def brentq_loop(data: Shots) -> Contender:
    """A root finder around ``solve_ivp``: the low arc alone."""
    brentq = load("scipy.optimize").brentq
    jobs = list(zip(data.speed[:3].tolist(), data.distance[:3].tolist(), strict=True))
    call = lambda: [brentq(lambda a, v=v, d=d: flown(v, a)[0] - d, 0.02, 0.6, xtol=1e-10) for v, d in jobs]  # noqa: E731
    read = lambda answer: np.array(answer)[:, None]  # noqa: E731
    return Contender("SciPy brentq + solve_ivp, loop", call, len(jobs), read, note="low arc alone")


def ballisticcalc_aim(data: Shots) -> Contender:
    """Its own search for the elevation: the low arc alone."""
    parts = ballisticcalc()
    module, calculator = parts[0], parts[1]
    jobs = [
        (ballisticcalc_shot(parts, v, 0.0), module.Distance.Meter(d))
        for v, d in zip(data.speed[:10].tolist(), data.distance[:10].tolist(), strict=True)
    ]
    call = lambda: [calculator.barrel_elevation_for_target(*job) for job in jobs]  # noqa: E731
    read = lambda answer: np.array([[a >> module.Angular.Radian] for a in answer])  # noqa: E731
    return Contender("py-ballisticcalc (Cython), loop", call, len(jobs), read, slack=1e-2, note="low arc alone")


def ballistic_solver_loop(data: Shots) -> Contender:
    """C++, Runge-Kutta of 10 ms, to a micrometre: the low arc; asked for the high one it may answer the low."""
    module = load("ballistic_solver")
    settings = module.BallisticParams()
    settings.g, settings.tolMiss = GRAVITY, 1e-6
    jobs = [([d, 0.0, 0.0], v) for v, d in zip(data.speed[:20].tolist(), data.distance[:20].tolist(), strict=True)]
    still, low = [0.0, 0.0, 0.0], module.ArcMode.Low

    def call() -> list[Any]:
        return [module.solve(target, still, v, DRAG, low, settings) for target, v in jobs]

    missed = sum(not answer["success"] for answer in call())
    note = f"low arc alone; {missed} of {len(jobs)} not to its tolerance" if missed else "low arc alone"
    read = lambda answer: np.array([[arc["theta"]] for arc in answer])  # noqa: E731
    return Contender("ballistic-solver (C++), loop", call, len(jobs), read, slack=1e-2, note=note)


def shot_floor(limits: Limits, threads: int, data: Any) -> float:
    """Two numbers in, five out; the quadrature to 1e-10, an exponential, a root and a quotient at every node."""
    del data
    count = EVALUATIONS * NODES
    return limits.floor(threads, read=2, written=5, exp=count, sqrt=count, sincos=1)


def aim_floor(limits: Limits, threads: int, data: Any) -> float:
    """Two arcs, two Newton steps each."""
    return 4.0 * shot_floor(limits, threads, data)


IMPACT = Workload(
    "shots", "drag shots to impact, 1e-10", "shot", shots, (10_000, 1000),
    (batch, warmed(one_shot), as_they_come(one_shot)),
    {"SciPy solve_ivp": solve_ivp_loop, "py-ballisticcalc": ballisticcalc_loop},
    shot_floor, {1: 500.0, 2: 260.0}, 1e-9, landings, (20, 3),
)  # fmt: skip

AIM = Workload(
    "aim", "aim at a speed, both arcs", "target", aims, (10_000, 1000),
    (batch_aim, warmed(one_aim), as_they_come(one_aim)),
    {"SciPy": brentq_loop, "py-ballisticcalc": ballisticcalc_aim, "ballistic-solver": ballistic_solver_loop},
    aim_floor, {1: 1500.0}, 1e-9, aimed, (4, 1),
)  # fmt: skip
