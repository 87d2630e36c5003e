"""Motions that have an exact answer, as problems for integrators."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar.engine import evaluator
from coplanar.errors import InvalidValue
from coplanar.flight import Projectile
from coplanar.integrators import METHODS, integrate_ode
from coplanar.laws import flight
from coplanar.motion import Comparison, Program, Segment
from coplanar.play.controls import State
from coplanar.play.kept import Kept
from coplanar.se2 import Pose

METHODS_SHOWN = ("euler", "midpoint", "rk4")
COUNTS = tuple(2**i for i in range(9, -1, -1))  # steps with which the error is measured, the shortest step first
MILLIMETRE = 1e-3  # [m] how far from the exact path is allowed for the largest step
MOST_STEPS = 4096  # of one try for it: more take too long for a page that waits
KEPT = 64

_drag_rates = evaluator(flight.drag_rates)
Key = tuple[Any, ...]


@dataclass(frozen=True, slots=True)
class Problem:
    """y' = rates(t, y) with its exact points.

    Attributes:
        rates: As ``integrate_ode`` takes them.
        start: The state at 0; its first two entries are the place.
        duration: [s].
        exact: Times (n,) to points (n, 2) [m].
    """

    rates: Callable[[float, np.ndarray], np.ndarray]
    start: np.ndarray
    duration: float
    exact: Callable[[np.ndarray], np.ndarray]

    def points(self, method: str, count: int) -> np.ndarray | None:
        """Where ``count`` equal steps lead, shape (count + 1, 2) [m]; None where they stop being finite."""
        times = np.linspace(0.0, self.duration, count + 1)
        try:
            return integrate_ode(self.rates, times, self.start, method=method)[:, :2]
        except InvalidValue:
            return None

    def error(self, method: str, count: int) -> float:
        """Largest distance from the exact path at the ends of the steps [m]; infinite where there is no path."""
        points = self.points(method, count)
        if points is None:
            return math.inf
        return float(np.hypot(*(points - self.exact(np.linspace(0.0, self.duration, count + 1))).T).max())


@dataclass(frozen=True, slots=True)
class Study:
    """How the error of one method depends on its step.

    Attributes:
        errors: The largest distance from the exact path, for each of ``COUNTS`` [m].
        order: Observed; NaN where it was not.
        largest_step: With which the method stays within a millimetre [s]; 0 where that takes more than
            ``MOST_STEPS``, NaN where it was not looked for.
    """

    errors: tuple[float, ...]
    order: float = math.nan
    largest_step: float = math.nan


def key_of(state: State) -> Key:
    """What a problem depends on."""
    if state["motion"] == "shot":
        return ("shot", state["duration"], state["speed"], state["angle"], state["drag"])
    return ("segment", state["duration"], state["v"], state["omega"], state["a"], state["alpha"])


def problem_of(key: Key) -> Problem:
    """The problem of a key."""
    return _shot(*key[1:]) if key[0] == "shot" else _segment(*key[1:])


def studies(key: Key) -> dict[str, Study]:
    """The study of every method that is shown: of a driven motion the library's comparison, of a shot its errors."""
    if key[0] == "shot":
        problem = problem_of(key)
        return {m: Study(tuple(problem.error(m, count) for count in COUNTS)) for m in METHODS_SHOWN}
    duration, *parts = key[1:]
    program = Program([Segment(*parts, duration=duration)])
    compared = Comparison(program, Pose(), METHODS_SHOWN, [duration / count for count in COUNTS])
    errors = compared.errors()
    rows = zip(METHODS_SHOWN, errors.tolist(), compared.orders(errors).tolist(), strict=True)
    return {m: Study(tuple(row), order, _largest_step(compared, m, row[0])) for m, row, order in rows}


studies_of = Kept(studies, most=KEPT)


def _largest_step(compared: Comparison, method: str, error: float) -> float:
    """The library's answer, where the error of the shortest step promises one within ``MOST_STEPS``."""
    promised = COUNTS[0] * (error / MILLIMETRE) ** (1.0 / METHODS[method].order)
    return compared.largest_step(method, MILLIMETRE) if promised <= MOST_STEPS else 0.0


def _segment(duration: float, v: float, omega: float, a: float, alpha: float) -> Problem:
    segment = Segment(v, omega, a, alpha, duration=duration)

    def rates(t: float, pose: np.ndarray) -> np.ndarray:
        return segment.twist(float(t)).in_world(float(pose[2]))

    return Problem(rates, np.zeros(3), duration, lambda t: segment.pose(Pose(), t).position)


def _shot(duration: float, speed: float, angle: float, drag: float) -> Problem:
    projectile = Projectile(mass=1.0, drag=drag)
    shot = projectile.launch(speed=speed, angle=angle)
    k, g = projectile.drag_per_mass, projectile.gravity

    def rates(_: float, state: np.ndarray) -> np.ndarray:
        _, _, vx, vy = state.tolist()
        return np.array([vx, vy, *_drag_rates(vx, vy, k, g)])

    return Problem(rates, np.array([0.0, 0.0, shot.vx, shot.vy]), duration, lambda t: shot.at(t).position)


def order_of(method: str) -> int:
    """The order that the method's table claims."""
    return METHODS[method].order
