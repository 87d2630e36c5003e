"""The instantaneous centre of rotation: the point of the body that stands still."""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import evaluator, stack
from coplanar.errors import NoSolution
from coplanar.laws import wheels as laws
from coplanar.se2 import Pose, Twist

_rotation_centre = evaluator(laws.rotation_centre)
_rotation_centre_in_world = evaluator(laws.rotation_centre_in_world)
_turning_radius = evaluator(laws.turning_radius)
_wheel_centre_speeds = evaluator(laws.wheel_centre_speeds)


class IcrStatus(enum.Enum):
    """Whether there is a centre of rotation."""

    TURNS = "the body turns about one point"
    TRANSLATES = "omega = 0: the body translates and has no centre of rotation"


@dataclass(frozen=True, slots=True)
class Icr:
    """The body point without velocity, (-vy, vx)/omega; none when omega = 0.

    Where there is none, ``exists`` is False and every coordinate is infinite.

    Attributes:
        twist: The motion, one or a batch.

    Example:
        >>> Icr(Twist(1.0, 0.0, 0.5)).body.tolist()
        [-0.0, 2.0]
        >>> Icr(Twist(1.0, 0.0, 0.0)).status.value
        'omega = 0: the body translates and has no centre of rotation'
    """

    twist: Twist

    @property
    def exists(self) -> bool | np.ndarray:
        """Whether the body turns: a bool, or an array of the leading shape."""
        turns = np.broadcast_to(np.not_equal(self.twist.omega, 0.0), self.twist.shape)
        return turns if turns.ndim else bool(turns)

    @property
    def status(self) -> IcrStatus:
        """One sentence; for a batch, TURNS only if every entry does."""
        return IcrStatus.TURNS if np.all(self.exists) else IcrStatus.TRANSLATES

    @property
    def body(self) -> np.ndarray:
        """The centre seen from the body, shape (..., 2) [m]."""
        point: np.ndarray = stack(_rotation_centre(*self.twist.parts))
        return point

    @property
    def radius(self) -> Real:
        """R = vx/omega: how far to the left of the body the centre is, negative to the right [m]."""
        return _rotation_centre(*self.twist.parts)[1]

    def in_world(self, pose: Pose) -> np.ndarray:
        """The centre in the world, shape (..., 2) [m]: (x - R sin theta, y + R cos theta) when vy = 0.

        Args:
            pose: The body in the world.

        Example:
            >>> Icr(Twist(1.0, 0.0, 0.5)).in_world(Pose(3.0, 1.0, 0.0)).tolist()
            [3.0, 3.0]
        """
        point: np.ndarray = stack(_rotation_centre_in_world(*pose.parts, *self.twist.parts))
        return point

    def or_raise(self) -> Icr:
        """This result, if there is a centre for every entry.

        Raises:
            NoSolution: If the body does not turn.
        """
        if self.status is not IcrStatus.TURNS:
            raise NoSolution(self.status.value, self)
        return self


def turning_radius(left_speed: ArrayLike, right_speed: ArrayLike, *, half_track: ArrayLike) -> Real:
    """R = b (v_r + v_l)/(v_r - v_l), positive to the left, infinite when both speeds are equal [m].

    Args:
        left_speed: v_l of the left wheel's centre [m/s].
        right_speed: v_r of the right wheel's centre [m/s].
        half_track: b, from the middle to either wheel [m].

    Example:
        >>> turning_radius(0.5, 1.5, half_track=0.25)
        0.5
    """
    b = checks.positive("half_track", half_track)
    return _turning_radius(checks.real("left_speed", left_speed), checks.real("right_speed", right_speed), b)


def wheel_centre_speeds(radius: ArrayLike, omega: ArrayLike, *, half_track: ArrayLike) -> tuple[Real, Real]:
    """v_l = (R - b) omega and v_r = (R + b) omega: left and right wheel about a centre at the distance R [m/s].

    Args:
        radius: R, positive to the left [m].
        omega: Counterclockwise [rad/s].
        half_track: b, from the middle to either wheel [m].

    Example:
        >>> wheel_centre_speeds(0.5, 2.0, half_track=0.25)
        (0.5, 1.5)
    """
    b = checks.positive("half_track", half_track)
    left, right = _wheel_centre_speeds(checks.real("radius", radius), checks.real("omega", omega), b)
    return left, right
