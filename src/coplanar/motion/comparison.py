"""Integrators side by side: how far each ends up from the exact path of a program, and with what step it will do."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike
from coplanar.engine import evaluator
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.integrators import METHODS, integrate_ode
from coplanar.laws import motion as laws
from coplanar.motion.program import Program
from coplanar.se2 import Pose

_unicycle_rates = evaluator(laws.unicycle_rates)
_velocities = evaluator(laws.velocities)

WHOLE = 1e-9  # of a step: a count this near a whole number is that number
ROUNDING = 1e-11  # [m] an error below this is rounding, and says nothing of an order
MOST_STEPS = 1 << 14  # of one integration


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """A program driven by fixed-step integrators, each segment in equal steps no longer than asked for.

    Attributes:
        program: What is driven; one robot.
        start: Pose at time 0.
        methods: Names of ``integrators.METHODS``.
        steps: The longest step allowed, shape (k,) [s].

    Raises:
        InvalidShape: If the program or the start is a batch.
        InvalidValue: If a step is not positive, or asks for more than 16384 steps.
        UnknownName: If there is no such method.

    Example:
        >>> from coplanar.motion import Segment
        >>> compared = Comparison(Program([Segment(1.0, 1.0, duration=2.0)]), Pose(), ("euler", "rk4"), [0.2, 0.1])
        >>> compared.errors()[0].round(4).tolist(), compared.orders().round(1).tolist()
        ([0.1684, 0.0842], [1.0, 4.0])
    """

    program: Program
    start: Pose
    methods: tuple[str, ...] = tuple(METHODS)
    steps: ArrayLike = (0.5, 0.25, 0.125, 0.0625, 0.03125)

    def __post_init__(self) -> None:
        for method in self.methods:
            checks.choice("methods", method, METHODS)
        if np.ndim(self.program.duration) or len(self.program.segments.shape) > 1 or self.start.shape:
            raise InvalidShape("program, start", "a batch", "one program and one pose", "compare them one by one")
        steps = checks.positive("steps", checks.vector("steps", self.steps))
        fewest = self.program.duration / MOST_STEPS
        if np.any(steps < fewest):
            raise InvalidValue("steps", self.steps, f"{fewest:.3g} s or more", "more than 16384 steps say nothing new")
        object.__setattr__(self, "steps", checks.frozen(steps))

    def path(self, method: str, step: float) -> tuple[np.ndarray, Pose]:
        """Times and poses of one method with one step, each of shape (rows,).

        Example:
            >>> from coplanar.motion import Segment
            >>> compared = Comparison(Program([Segment(1.0, 0.0, duration=1.0)]), Pose())
            >>> compared.path("euler", 0.5)[1].x.tolist()
            [0.0, 0.5, 1.0]
        """
        checks.choice("method", method, METHODS)
        h, state = checks.positive("step", step), self.start.as_array()
        times, rows = [np.zeros(1)], [state[None]]
        for begin, piece in zip(self.program.knots.tolist(), self.program, strict=False):
            count = max(1, math.ceil(piece.duration / h - WHOLE))
            if piece.duration > 0.0:
                t = np.linspace(0.0, piece.duration, count + 1)
                poses = integrate_ode(_rates_of(piece.parts[:4]), t, state, method=method)
                state = poses[-1]
                times.append(begin + t[1:])
                rows.append(poses[1:])
        return np.concatenate(times), Pose._of(*np.concatenate(rows).T)

    def error(self, method: str, step: float) -> float:
        """The largest distance from the exact path at the ends of the steps [m]."""
        t, poses = self.path(method, step)
        exact = self.program.pose(self.start, t)
        return float(np.hypot(poses.x - exact.x, poses.y - exact.y).max())

    def errors(self) -> np.ndarray:
        """The errors of all methods with all steps, shape (methods, k) [m]."""
        return np.array([[self.error(method, step) for step in self.steps.tolist()] for method in self.methods])

    def orders(self, errors: np.ndarray | None = None) -> np.ndarray:
        """The order of each method, by the two smallest steps whose errors are no rounding, shape (methods,).

        NaN where a method is exact on this program, or only one step shows an error.
        """
        table = self.errors() if errors is None else errors
        place = np.argsort(self.steps)
        return np.array([_slope(self.steps[place], row[place]) for row in table])

    def largest_step(self, method: str, tolerance: float = 1e-3) -> float:
        """The largest step, to 1 %, with which a method stays within a tolerance [m] of the exact path [s].

        It is shortened from the longest segment's duration until it does, as the method's order says; 0 where
        16384 steps are not enough.
        """
        allowed, power = checks.positive("tolerance", tolerance), 1.0 / METHODS[method].order
        high = low = float(np.max(self.program.segments.duration))
        error = self.error(method, low)
        while error > allowed:
            high, low = low, low * min(0.9, max(0.01, (allowed / error) ** power))
            if low * MOST_STEPS < self.program.duration:
                return 0.0
            error = self.error(method, low)
        while high > 1.01 * low:
            reach = low * (allowed / max(error, ROUNDING)) ** power
            middle = reach if 1.002 * low < reach < 0.99 * high else math.sqrt(low * high)
            there = self.error(method, middle)
            low, high, error = (middle, high, there) if there <= allowed else (low, middle, error)
        return low


def _rates_of(parts: tuple[Any, ...]) -> Any:
    """Rates of (x, y, theta) at a time since a segment began."""
    v, omega, a, alpha = parts

    def rates(t: float, pose: np.ndarray) -> np.ndarray:
        return np.array(_unicycle_rates(float(pose[2]), *_velocities(v, omega, a, alpha, float(t))))

    return rates


def _slope(steps: np.ndarray, errors: np.ndarray) -> float:
    """Slope of log(error) over log(step) at the smallest two steps that show an error."""
    shown = np.flatnonzero(errors > ROUNDING)[:2]
    if shown.size < 2:
        return math.nan
    i, j = shown
    return float(np.log(errors[j] / errors[i]) / np.log(steps[j] / steps[i]))
