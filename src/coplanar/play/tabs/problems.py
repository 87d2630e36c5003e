"""Motions that have an exact answer, as problems for integrators."""

from __future__ import annotations

import itertools
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
from coplanar.motion import Segment
from coplanar.play.controls import State
from coplanar.play.kept import Kept
from coplanar.se2 import Pose

METHODS_SHOWN = ("euler", "midpoint", "rk4")
COUNTS = tuple(2**i for i in range(10))  # steps with which the error is measured
MILLIMETRE = 1e-3  # [m] how near the end has to be for the largest step
MOST_EVALUATIONS = 20_000  # of the rates in one try for it
ROUNDS = 4  # of such tries
MARGIN = 1.002  # above the count that the power law points at
SHARPNESS = 1.02  # the ratio of a count that meets it and one that misses, where the search ends
ROUNDING = 1e-12  # of the way: errors below this say nothing of the order
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
        """Distance of the end from the exact one [m]; infinite where the steps do not lead to an end."""
        points = self.points(method, count)
        if points is None:
            return math.inf
        return float(np.hypot(*(points[-1] - self.exact(np.array([self.duration]))[0])))


@dataclass(frozen=True, slots=True)
class Study:
    """How the error of one method depends on its step.

    Attributes:
        errors: At the end, for each of ``COUNTS`` [m].
        order: Observed between neighbouring counts; NaN where rounding rules.
        largest_step: The largest one found that ends within a millimetre [s]; NaN where none was.
    """

    errors: tuple[float, ...]
    order: float
    largest_step: float


def key_of(state: State) -> Key:
    """What a problem depends on."""
    if state["motion"] == "shot":
        return ("shot", state["duration"], state["speed"], state["angle"], state["drag"])
    return ("segment", state["duration"], state["v"], state["omega"], state["a"], state["alpha"])


def problem_of(key: Key) -> Problem:
    """The problem of a key."""
    return _shot(*key[1:]) if key[0] == "shot" else _segment(*key[1:])


def studies(key: Key) -> dict[str, Study]:
    """The study of every method that is shown."""
    problem = problem_of(key)
    return {method: _study(problem, method) for method in METHODS_SHOWN}


studies_of = Kept(studies, most=KEPT)


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


def _study(problem: Problem, method: str) -> Study:
    errors = tuple(problem.error(method, count) for count in COUNTS)
    way = max(float(np.abs(problem.exact(np.array([problem.duration]))).max()), 1.0)
    return Study(errors, _order(errors, ROUNDING * way), _largest_step(problem, method, errors))


def _order(errors: tuple[float, ...], floor: float) -> float:
    """From the finest pair of counts whose errors are above rounding."""
    pairs = [(a, b) for a, b in itertools.pairwise(errors) if math.isfinite(a) and b > floor]
    return math.log2(pairs[-1][0] / pairs[-1][1]) if pairs else math.nan


def _largest_step(problem: Problem, method: str, errors: tuple[float, ...]) -> float:
    """Between a count that misses and one that does not, narrowed to where error = C h^order points."""
    missing = [i for i, error in enumerate(errors) if not error <= MILLIMETRE]
    if not missing:
        return problem.duration
    last, order = missing[-1], order_of(method)
    low, error = COUNTS[last], errors[last]
    high = COUNTS[last + 1] if last + 1 < len(COUNTS) else 0  # 0 until a count has met it
    for _ in range(ROUNDS):
        if not math.isfinite(error) or 0 < high <= max(SHARPNESS * low, low + 1):
            break
        count = max(math.ceil(MARGIN * low * (error / MILLIMETRE) ** (1.0 / order)), low + 1)
        count = min(count, high - 1) if high else count
        if count * order > MOST_EVALUATIONS:
            break
        now = problem.error(method, count)
        high, low, error = (count, low, error) if now <= MILLIMETRE else (high, count, now)
    return problem.duration / high if high else math.nan


def order_of(method: str) -> int:
    """The order that the method's table claims."""
    return METHODS[method].order
