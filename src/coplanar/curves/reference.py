"""Curves in time: where the reference is, how fast it goes, how it accelerates."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.curves.analytic import as_number
from coplanar.curves.base import Curve
from coplanar.engine import components, evaluator, stack
from coplanar.errors import InvalidValue
from coplanar.laws import curves as laws

_velocity = evaluator(laws.velocity_along)
_acceleration = evaluator(laws.acceleration_along)
_PROFILES = {"uniform": evaluator(laws.uniform), "minimum_jerk": evaluator(laws.minimum_jerk)}


class Timed(Protocol):
    """What a controller follows: a point that moves in time."""

    def position(self, t: ArrayLike) -> np.ndarray:
        """[m], shape (..., 2)."""
        ...

    def velocity(self, t: ArrayLike) -> np.ndarray:
        """[m/s], shape (..., 2)."""
        ...

    def acceleration(self, t: ArrayLike) -> np.ndarray:
        """[m/s^2], shape (..., 2)."""
        ...


@dataclass(frozen=True, slots=True)
class Reference:
    """A curve run through in time: P(phi(t)), phi = first + laps (last - first) s(t), s from 0 to 1.

    Before ``start_time`` it rests at the first point, after ``start_time + duration`` at the last.

    Attributes:
        curve: The curve.
        duration: [s].
        start_time: [s].
        laps: How many times around; 1 on an open curve.
        profile: How s runs: "uniform" (phidot constant) or "minimum_jerk" (from rest to rest).

    Example:
        >>> from coplanar.curves import Circle
        >>> lap = Reference(Circle(1.0), duration=2.0)
        >>> lap.velocity(0.0).round(6).tolist()
        [-0.0, 3.141593]
    """

    curve: Curve
    duration: float
    start_time: float = field(default=0.0, kw_only=True)
    laps: float = field(default=1.0, kw_only=True)
    profile: str = field(default="uniform", kw_only=True)

    def __post_init__(self) -> None:
        for name, check in (("duration", checks.positive), ("start_time", checks.real), ("laps", checks.positive)):
            object.__setattr__(self, name, as_number(name, check(name, getattr(self, name))))
        checks.choice("profile", self.profile, _PROFILES)
        if self.laps != 1.0 and not self.curve.closed:
            raise InvalidValue("laps", self.laps, "1: the curve is open")

    def parameter(self, t: ArrayLike) -> tuple[Real, Real, Real]:
        """phi, phidot, phiddot at times t [s], each of shape (...)."""
        low, high = self.curve.interval
        span = self.laps * (high - low)
        progress, rate, change = _PROFILES[self.profile](checks.real("t", t), self.start_time, self.duration)
        return low + span * progress, span * rate, span * change

    def position(self, t: ArrayLike) -> np.ndarray:
        """P(phi(t)) [m], shape (..., 2)."""
        return self.curve.position(self.parameter(t)[0])

    def velocity(self, t: ArrayLike) -> np.ndarray:
        """dP/dt = P' phidot [m/s], shape (..., 2)."""
        phi, rate, _ = self.parameter(t)
        velocity: np.ndarray = stack(_velocity(*components(self.curve.derivative(phi)), rate))
        return velocity

    def acceleration(self, t: ArrayLike) -> np.ndarray:
        """d2P/dt2 = P'' phidot^2 + P' phiddot [m/s^2], shape (..., 2)."""
        phi, rate, change = self.parameter(t)
        first, second = self.curve.derivative(phi), self.curve.second_derivative(phi)
        answer: np.ndarray = stack(_acceleration(*components(first), *components(second), rate, change))
        return answer


@dataclass(frozen=True, slots=True)
class HeldPoint:
    """A reference that rests.

    Attributes:
        point: Where [m], shape (..., 2).

    Example:
        >>> HeldPoint((1, 2)).position([0.0, 1.0]).tolist()
        [[1.0, 2.0], [1.0, 2.0]]
    """

    point: ArrayLike

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", checks.frozen(checks.vector("point", self.point, 2)))

    def position(self, t: ArrayLike) -> np.ndarray:
        """The point at every time, shape (..., 2)."""
        shape = np.broadcast_shapes(np.shape(checks.real("t", t)), self.point.shape[:-1])
        return np.broadcast_to(self.point, (*shape, 2))

    def velocity(self, t: ArrayLike) -> np.ndarray:
        """(0, 0) [m/s], shape (..., 2)."""
        return np.zeros(self.position(t).shape)

    def acceleration(self, t: ArrayLike) -> np.ndarray:
        """(0, 0) [m/s^2], shape (..., 2)."""
        return np.zeros(self.position(t).shape)
