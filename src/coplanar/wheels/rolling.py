"""A single wheel on a straight road."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import PI, evaluator, stack
from coplanar.laws import rolling as laws

_centre_speed = evaluator(laws.centre_speed)
_rim_position = evaluator(laws.rim_position)
_rim_velocity = evaluator(laws.rim_velocity)
_rolling_rate = evaluator(laws.rolling_rate)
_slip_speed = evaluator(laws.slip_speed)


@dataclass(frozen=True, slots=True)
class RollingWheel:
    """A wheel seen from the side, x along the road and y up: v_centre = r phidot when it does not slip.

    A positive rate turns it clockwise and drives it towards +x. The rim angle beta is measured from the contact in
    the sense of that turning: 0 at the contact, pi/2 at the rear, pi on top, 3 pi/2 in front.

    Attributes:
        radius: [m].

    Raises:
        InvalidValue: If the radius is not positive and finite.

    Example:
        >>> wheel = RollingWheel(0.5)
        >>> wheel.centre_speed(4.0), wheel.top_velocity(4.0).round(12).tolist()
        (2.0, [4.0, 0.0])
        >>> wheel.contact_velocity(4.0).tolist()
        [0.0, 0.0]
    """

    radius: Real

    def __post_init__(self) -> None:
        radius = checks.positive("radius", self.radius, remedy="give the radius, not the diameter, in metres")
        object.__setattr__(self, "radius", checks.frozen(radius))

    def centre_speed(self, rate: ArrayLike, *, slip: ArrayLike = 0.0) -> Real:
        """Speed v_centre = r phidot + slip [m/s].

        Args:
            rate: phidot, clockwise [rad/s].
            slip: Velocity of the contact along the road [m/s]; negative when the wheel spins.
        """
        return _centre_speed(checks.real("rate", rate), self.radius, checks.real("slip", slip))

    def rate(self, speed: ArrayLike, *, slip: ArrayLike = 0.0) -> Real:
        """Rate phidot = (v_centre - slip)/r [rad/s].

        Example:
            >>> RollingWheel(0.5).rate(2.0)
            4.0
        """
        return _rolling_rate(checks.real("speed", speed), self.radius, checks.real("slip", slip))

    def slip(self, speed: ArrayLike, rate: ArrayLike) -> Real:
        """Slip v_centre - r phidot [m/s]: 0 rolls, negative spins, positive skids.

        Example:
            >>> RollingWheel(0.5).slip(1.5, 4.0)
            -0.5
        """
        return _slip_speed(checks.real("speed", speed), checks.real("rate", rate), self.radius)

    def rim_velocity(self, rate: ArrayLike, beta: ArrayLike, *, slip: ArrayLike = 0.0) -> np.ndarray:
        """v_centre + omega x (point - centre): velocity of a rim point over the road, shape (..., 2) [m/s].

        Args:
            rate: phidot, clockwise [rad/s].
            beta: Rim angle from the contact, in the sense of the turning [rad].
            slip: Velocity of the contact along the road [m/s].

        Example:
            >>> from math import pi
            >>> RollingWheel(0.5).rim_velocity(4.0, pi / 2).round(12).tolist()
            [2.0, 2.0]
        """
        angle = checks.real("beta", beta)
        v: np.ndarray = stack(_rim_velocity(checks.real("rate", rate), self.radius, checks.real("slip", slip), angle))
        return v

    def contact_velocity(self, rate: ArrayLike, *, slip: ArrayLike = 0.0) -> np.ndarray:
        """Velocity of the contact, (slip, 0), shape (..., 2) [m/s]."""
        return self.rim_velocity(rate, 0.0, slip=slip)

    def top_velocity(self, rate: ArrayLike, *, slip: ArrayLike = 0.0) -> np.ndarray:
        """Velocity of the top, (v_centre + r phidot, 0), shape (..., 2) [m/s]: twice the centre's without slip."""
        return self.rim_velocity(rate, PI, slip=slip)

    def rim_position(self, beta: ArrayLike, *, centre: ArrayLike = 0.0) -> np.ndarray:
        """Where a rim point is, on the road y = 0, shape (..., 2) [m].

        Args:
            beta: Rim angle from the contact [rad].
            centre: How far along the road the wheel's centre is [m].

        Example:
            >>> RollingWheel(0.5).rim_position(0.0, centre=2.0).tolist()
            [2.0, 0.0]
        """
        p: np.ndarray = stack(_rim_position(checks.real("centre", centre), self.radius, checks.real("beta", beta)))
        return p

    def rim_path(self, angle: ArrayLike) -> np.ndarray:
        """The cycloid of the rim point that touched the road at the origin, shape (..., 2) [m].

        Args:
            angle: How far the wheel has rolled since [rad].

        Example:
            >>> from math import pi
            >>> RollingWheel(0.5).rim_path(pi).round(6).tolist()
            [1.570796, 1.0]
        """
        return self.rim_position(angle, centre=self.centre_speed(angle))
