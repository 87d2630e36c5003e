"""Ramps: from one velocity to another at a given acceleration, and moves from rest to rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import evaluator
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.laws import ramps as laws
from coplanar.motion.program import Program
from coplanar.motion.segment import Segment

_ramp = evaluator(laws.ramp)
_ramp_time = evaluator(laws.ramp_time)
_rate = evaluator(laws.rate)
_trapezoid = evaluator(laws.trapezoid)
_trapezoid_times = evaluator(laws.trapezoid_times)

_MAGNITUDE = "give the magnitude; the sign follows from target - start"


@dataclass(frozen=True, slots=True)
class Ramp:
    """Velocities that change at constant acceleration until each component reaches its target, then hold.

    Attributes:
        start: Velocities at time 0, shape (..., k) [m/s, rad/s].
        target: Velocities to reach, shape (..., k).
        durations: How long each component takes, shape (..., k) [s]; 0 where start and target agree.

    Raises:
        InvalidValue: If a duration is negative, or 0 where start and target differ.
        InvalidShape: If they do not broadcast.

    Example:
        >>> ramp = Ramp.independent([0.0, 0.0], [1.0, -0.5], 1.0)
        >>> ramp.durations.tolist(), ramp.velocity(0.75).tolist()
        ([1.0, 0.5], [0.75, -0.5])
    """

    start: np.ndarray
    target: np.ndarray
    durations: np.ndarray

    def __post_init__(self) -> None:
        durations = checks.not_negative("durations", checks.vector("durations", self.durations))
        start, target = checks.vector("start", self.start), checks.vector("target", self.target)
        shape = checks.broadcast(start=start, target=target, durations=durations)
        if np.any(np.not_equal(start, target) & np.equal(durations, 0.0)):
            raise InvalidValue("durations", self.durations, "greater than 0 where start and target differ")
        for name, value in (("start", start), ("target", target), ("durations", durations)):
            object.__setattr__(self, name, checks.frozen(np.broadcast_to(value, shape)))

    @classmethod
    def independent(cls, start: ArrayLike, target: ArrayLike, acceleration: ArrayLike) -> Ramp:
        """Every component at its own acceleration: the faster ones wait at their target, and the path bends.

        Args:
            start: Velocities at time 0, shape (..., k).
            target: Velocities to reach, shape (..., k).
            acceleration: Magnitudes, a number or shape (..., k) [m/s^2, rad/s^2].

        Raises:
            InvalidValue: If an acceleration is not positive.
        """
        one, other, magnitude = _velocities(start, target, acceleration)
        return cls(one, other, _ramp_time(one, other, magnitude))

    @classmethod
    def synchronised(cls, start: ArrayLike, target: ArrayLike, acceleration: ArrayLike, *, limit: str = "each") -> Ramp:
        """All components arrive together: a straight line in the space of velocities.

        Args:
            start: Velocities at time 0, shape (..., k).
            target: Velocities to reach, shape (..., k).
            acceleration: Magnitudes [m/s^2, rad/s^2].
            limit: "each" keeps every component within its own acceleration, a number or shape (..., k); "norm" keeps
                the length of the acceleration vector at the number, or shape (..., 1).

        Raises:
            InvalidValue: If an acceleration is not positive.
            UnknownName: If the limit is neither.

        Example:
            >>> Ramp.synchronised([0.0, 0.0], [3.0, 4.0], 1.0).durations.tolist()
            [4.0, 4.0]
            >>> Ramp.synchronised([0.0, 0.0], [3.0, 4.0], 1.0, limit="norm").durations.tolist()
            [5.0, 5.0]
        """
        checks.choice("limit", limit, ("each", "norm"))
        one, other, magnitude = _velocities(start, target, acceleration)
        times = _ramp_time(one, other, magnitude)
        if limit == "norm":
            longest = np.linalg.norm(times, axis=-1, keepdims=True)
        else:
            longest = np.max(times, axis=-1, keepdims=True)
        return cls(one, other, longest)

    @property
    def duration(self) -> Real:
        """When the last component reaches its target [s], of the leading shape."""
        return checks.real("duration", self.durations.max(axis=-1))

    @property
    def accelerations(self) -> np.ndarray:
        """Signed acceleration of each component until it holds, shape (..., k); 0 for a ramp of length 0.

        Example:
            >>> Ramp.independent([1.0, 2.0], [0.0, 2.0], 0.5).accelerations.tolist()
            [-0.5, 0.0]
        """
        rates: np.ndarray = _rate(self.start, self.target, self.durations)
        return rates

    def velocity(self, t: ArrayLike) -> np.ndarray:
        """Velocities at time t [s]: the start before 0, exactly the target from each component's duration on.

        Args:
            t: Broadcasts with the leading shape.

        Returns:
            Shape (..., k).
        """
        return self._state(0.0, t)[1]

    def position(self, start: ArrayLike, t: ArrayLike) -> np.ndarray:
        """Positions at time t: x0 + v t + a t^2/2 until the target is reached, then at the target's velocity.

        Args:
            start: Positions at time 0, shape (..., k).
            t: [s], broadcasts with the leading shape.

        Returns:
            Shape (..., k).

        Example:
            >>> Ramp.independent([0.0, 0.0], [2.0, 0.0], 1.0).position([1.0, 0.0], 3.0).tolist()
            [5.0, 0.0]
        """
        return self._state(checks.vector("start", start), t)[0]

    def _state(self, position: Real, t: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        time = np.asarray(checks.real("t", t))[..., None]
        where, velocity = _ramp(position, self.start, self.target, self.durations, time)
        return where, velocity

    def as_program(self) -> Program:
        """The segments that a unicycle drives while (v, omega) ramp: the ramps, then one of them alone.

        Raises:
            InvalidShape: If the components are not (v, omega).

        Example:
            >>> Ramp.independent([0.0, 0.0], [1.0, 0.5], 1.0).as_program().knots.tolist()
            [0.0, 0.5, 1.0]
        """
        if self.start.shape[-1] != 2:
            raise InvalidShape("components", f"{self.start.shape[-1]}", "2, which are v and omega")
        first, last = self.durations.min(axis=-1), self.durations.max(axis=-1)
        pieces = []
        for begin, end in ((np.zeros_like(first), first), (first, last)):
            velocities, middle = self.velocity(begin), 0.5 * (begin + end)
            turning = np.where(middle[..., None] < self.durations, self.accelerations, 0.0)
            pieces.append(Segment(*np.moveaxis(velocities, -1, 0), *np.moveaxis(turning, -1, 0), duration=end - begin))
        return Program(pieces)


@dataclass(frozen=True, slots=True)
class Trapezoid:
    """A move from rest to rest over a distance: speed up, cruise at the limit, slow down; a short one is a triangle.

    Fields are floats or arrays that broadcast.

    Attributes:
        distance: Signed [m, rad].
        limit: Largest speed, positive [m/s, rad/s].
        up: Magnitude of the acceleration [m/s^2, rad/s^2].
        down: Magnitude of the deceleration; as ``up`` where None.

    Raises:
        InvalidValue: If a magnitude is not positive.
        InvalidShape: If they do not broadcast.

    Example:
        >>> Trapezoid(3.0, 1.0, 1.0).duration, Trapezoid(0.25, 1.0, 1.0).duration
        (4.0, 1.0)
    """

    distance: Real
    limit: Real
    up: Real
    down: Real = None

    def __post_init__(self) -> None:
        down = self.up if self.down is None else self.down
        values = {"distance": checks.real("distance", self.distance)}
        magnitudes = (("limit", self.limit), ("up", self.up), ("down", down))
        values |= {n: checks.positive(n, value, remedy="give the magnitude") for n, value in magnitudes}
        checks.broadcast(**values)
        for name, value in values.items():
            object.__setattr__(self, name, checks.frozen(value))

    @property
    def times(self) -> tuple[Real, Real, Real]:
        """How long it speeds up, cruises and slows down [s]."""
        rise, cruise, fall, _ = self._plan()
        return rise, cruise, fall

    @property
    def duration(self) -> Real:
        """How long the move takes [s]; 0 for no distance."""
        rise, cruise, fall, _ = self._plan()
        return rise + cruise + fall

    @property
    def peak(self) -> Real:
        """The largest speed of this move [m/s, rad/s]: the limit, or less for a triangle.

        Example:
            >>> Trapezoid(-0.25, 1.0, 1.0).peak
            0.5
        """
        return self._plan()[3]

    def position(self, t: ArrayLike) -> Real:
        """The way covered at time t; exactly the distance from the end on.

        Example:
            >>> Trapezoid(3.0, 1.0, 1.0).position([0.0, 1.0, 3.0, 9.0]).tolist()
            [0.0, 0.5, 2.5, 3.0]
        """
        return _trapezoid(self.distance, self.limit, self.up, self.down, checks.real("t", t))[0]

    def velocity(self, t: ArrayLike) -> Real:
        """The velocity at time t; exactly 0 from the end on.

        Example:
            >>> Trapezoid(-3.0, 1.0, 1.0).velocity(2.0)
            -1.0
        """
        return _trapezoid(self.distance, self.limit, self.up, self.down, checks.real("t", t))[1]

    def _plan(self) -> tuple[Real, Real, Real, Real]:
        rise, cruise, fall, peak = _trapezoid_times(self.distance, self.limit, self.up, self.down)
        return rise, cruise, fall, peak


def _velocities(start: ArrayLike, target: ArrayLike, acceleration: ArrayLike) -> tuple[np.ndarray, np.ndarray, Real]:
    one, other = checks.vector("start", start), checks.vector("target", target)
    magnitude = checks.positive("acceleration", acceleration, remedy=_MAGNITUDE)
    checks.broadcast(start=one, target=other, acceleration=magnitude)
    return one, other, magnitude
