"""Segments: how a body moves while its accelerations are constant."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import evaluator
from coplanar.laws import motion as laws
from coplanar.se2 import Pose, Twist
from coplanar.se2.triple import matrix_of

_curvature = evaluator(laws.curvature)
_cusp_time = evaluator(laws.cusp_time)
_segment = evaluator(laws.segment)
_segment_jacobian = evaluator(laws.segment_jacobian)
_most_turn = evaluator(laws.most_turn)
_velocities = evaluator(laws.velocities)

LONGEST_TURN = 1.0e5  # [rad] the work grows with the turn: 200 000 points at this one
_WITHIN = f"(rate of turn) x duration of at most {LONGEST_TURN:g} rad"

NAMES = ("v", "omega", "a", "alpha", "duration")
KINDS = ("rest", "line", "spin", "arc", "circle", "clothoid", "general")


@dataclass(frozen=True, slots=True)
class Segment:
    """A motion of constant accelerations: v + a t forward, omega + alpha t counterclockwise, for a duration.

    Every field is a float or an array; they broadcast. A line, an arc, a turn on the spot, a clothoid are all segments.

    Attributes:
        v: Forward velocity at the start [m/s].
        omega: Turn rate at the start [rad/s].
        a: Forward acceleration [m/s^2].
        alpha: Turn acceleration [rad/s^2].
        duration: [s], 0 or more.

    Raises:
        InvalidValue: If something is not finite, the duration is negative, or the turn is beyond ``LONGEST_TURN``.
        InvalidShape: If the fields do not broadcast.

    Example:
        >>> from math import pi
        >>> quarter = Segment(pi / 2, pi / 2, duration=1.0)
        >>> quarter.end(Pose()).as_array().round(12).tolist()
        [1.0, 1.0, 1.570796326795]
        >>> quarter.kind
        'arc'
    """

    v: Real
    omega: Real
    a: Real = 0.0
    alpha: Real = 0.0
    _: KW_ONLY
    duration: Real

    def __post_init__(self) -> None:
        if not (checks.plain(*self.parts) and self.duration >= 0.0):
            values = {name: checks.real(name, value) for name, value in zip(NAMES, self.parts, strict=True)}
            checks.not_negative("duration", self.duration)
            checks.broadcast(**values)
            for name, value in values.items():
                object.__setattr__(self, name, checks.frozen(value))
        turn = _most_turn(self.omega, self.alpha, self.duration)
        given = self.omega, self.alpha
        checks.demand(turn <= LONGEST_TURN, "omega, alpha", given, turn, _WITHIN, "split the segment")

    @classmethod
    def _of(cls, *parts: Real) -> Segment:
        """The segment of (v, omega, a, alpha, duration) without the checks."""
        new = object.__new__(cls)
        for name, value in zip(NAMES, parts, strict=True):
            object.__setattr__(new, name, value)
        return new

    @property
    def parts(self) -> tuple[Real, Real, Real, Real, Real]:
        """(v, omega, a, alpha, duration)."""
        return self.v, self.omega, self.a, self.alpha, self.duration

    @property
    def shape(self) -> tuple[int, ...]:
        """The common shape of the fields, () for a single segment."""
        return np.broadcast_shapes(*(np.shape(p) for p in self.parts))

    def __getitem__(self, index: Any) -> Segment:
        """The same slice of every field."""
        whole = (np.broadcast_to(part, self.shape) for part in self.parts)
        return self._of(*(checks.real("slice", part[index]) for part in whole))

    def pose(self, start: Pose, t: ArrayLike, *, out: np.ndarray | None = None) -> Pose:
        """The pose p + int_0^t (v + a s) (cos, sin)(theta + omega s + alpha s^2/2) ds, exact to rounding.

        Args:
            start: Pose at time 0.
            t: Time since the start [s]; broadcasts with the segment's fields and the start. Outside 0 ... duration
                the same accelerations go on.
            out: Where x, y and theta are written, shape (3, ...); the pose that comes back looks at it.

        Returns:
            The pose in the frame of ``start``; its heading counts full turns.

        Example:
            >>> Segment(0.0, 0.0, 2.0, duration=3.0).pose(Pose(1.0, 0.0, 0.0), [0.0, 1.0, 3.0]).x.tolist()
            [1.0, 2.0, 10.0]
        """
        return self._pose(start, checks.real("t", t), out)

    def end(self, start: Pose, *, out: np.ndarray | None = None) -> Pose:
        """The pose when the duration is over.

        Args:
            start: Pose at time 0.
            out: Where x, y and theta are written, shape (3, ...); the pose that comes back looks at it.

        Example:
            >>> Segment(1.0, 0.0, duration=2.0).end(Pose(1.0, 0.0, 0.0))
            Pose(x=3.0, y=0.0, theta=0.0)
        """
        return self._pose(start, self.duration, out)

    def _pose(self, start: Pose, t: Real, out: np.ndarray | None) -> Pose:
        given = start.x, start.y, start.theta, self.v, self.omega, self.a, self.alpha, t
        return Pose._of(*_segment(*given)) if out is None else Pose._into(out, _segment, *given)

    def twist(self, t: ArrayLike) -> Twist:
        """The velocity (v + a t, 0, omega + alpha t) at time t [s], seen from the body.

        Example:
            >>> Segment(1.0, 0.0, 0.5, 0.25, duration=4.0).twist(2.0)
            Twist(vx=2.0, vy=0.0, omega=0.5)
        """
        v, omega = _velocities(self.v, self.omega, self.a, self.alpha, checks.real("t", t))
        return Twist._of(v, 0.0, omega)

    def curvature(self, t: ArrayLike) -> Real:
        """Curvature kappa = omega/v at time t [1/m]; infinite for a turn on the spot, 0 where nothing moves.

        Starting from v = omega = 0 it is the limit alpha/a.

        Example:
            >>> Segment(2.0, 0.0, 0.0, 1.0, duration=1.0).curvature([0.0, 1.0]).tolist()
            [0.0, 0.5]
        """
        now = self.twist(t)
        return _curvature(now.vx, now.omega, self.a, self.alpha)

    @property
    def cusp_time(self) -> Real:
        """When v changes sign within the duration and the path reverses [s]; infinite where it never does.

        Example:
            >>> Segment(1.0, 0.3, -2.0, duration=1.0).cusp_time, Segment(1.0, 0.3, duration=1.0).cusp_time
            (0.5, inf)
        """
        return _cusp_time(self.v, self.a, self.duration)

    @property
    def kind(self) -> Any:
        """What the path is, one of ``KINDS``: a str, or an array of str for an array of segments.

        "rest" and "line" do not turn, "spin" does not travel, "arc" has constant velocities, "circle" the constant
        curvature of a/alpha = v/omega (to a relative 1e-12), "clothoid" a curvature linear in arc length (a = 0 and
        alpha not), "general" neither.

        Example:
            >>> Segment(1.0, 0.0, 0.0, 0.5, duration=1.0).kind, Segment(1.0, 0.0, 1.0, 0.5, duration=1.0).kind
            ('clothoid', 'general')
        """
        travels = (np.not_equal(self.v, 0.0)) | (np.not_equal(self.a, 0.0))
        turns = (np.not_equal(self.omega, 0.0)) | (np.not_equal(self.alpha, 0.0))
        one, other = np.multiply(self.v, self.alpha), np.multiply(self.a, self.omega)
        steady = np.abs(one - other) <= 1e-12 * (np.abs(one) + np.abs(other))
        constant = np.equal(self.a, 0.0) & np.equal(self.alpha, 0.0)
        cases = (~travels & ~turns, ~turns, ~travels, constant, steady, np.equal(self.a, 0.0))
        names = np.select([np.broadcast_to(c, self.shape) for c in cases], KINDS[:-1], KINDS[-1])
        return names if self.shape else str(names)

    def jacobians(self, start: Pose, t: ArrayLike | None = None) -> tuple[np.ndarray, np.ndarray]:
        """How the pose at time t, the end where None, moves with the start and with (v, omega, a, alpha).

        Args:
            start: Pose at time 0.
            t: Time since the start [s].

        Returns:
            F by (x, y, theta) of the start, shape (..., 3, 3), and G by (v, omega, a, alpha), shape (..., 3, 4).

        Example:
            >>> F, G = Segment(1.0, 0.0, duration=2.0).jacobians(Pose())
            >>> F[1].round(12).tolist(), G[1].round(12).tolist()
            ([0.0, 1.0, 2.0], [0.0, 2.0, 0.0, 1.333333333333])
        """
        time = self.duration if t is None else checks.real("t", t)
        xv, yv, xw, yw, xa, ya, xb, yb, xt, yt, tw, tb = _segment_jacobian(
            start.theta, self.v, self.omega, self.a, self.alpha, time
        )
        F = matrix_of((1.0, 0.0, xt), (0.0, 1.0, yt), (0.0, 0.0, 1.0))
        return F, matrix_of((xv, xw, xa, xb), (yv, yw, ya, yb), (0.0, tw, 0.0, tb))
