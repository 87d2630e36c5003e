"""Velocities and increments of a body, seen from the body."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import components, evaluator, stack
from coplanar.laws import se2 as laws
from coplanar.se2.triple import Triple, matrix_of

_during = evaluator(laws.during)
_exp_jacobian = evaluator(laws.exp_jacobian)
_over = evaluator(laws.over)
_right_jacobian = evaluator(laws.right_jacobian)
_rotate = evaluator(laws.rotate)


@dataclass(frozen=True, slots=True, eq=False, init=False)
class Displacement(Triple):
    """An increment seen from the moving frame: exponential coordinates of a pose.

    Attributes:
        dx: Forward [m].
        dy: To the left [m].
        dtheta: Counterclockwise [rad].

    Example:
        >>> Displacement(1.0, 0.0, 0.0).over(2.0)
        Twist(vx=0.5, vy=0.0, omega=0.0)
    """

    names: ClassVar = ("dx", "dy", "dtheta")
    dx: Real
    dy: Real
    dtheta: Real

    def __init__(self, dx: ArrayLike = 0.0, dy: ArrayLike = 0.0, dtheta: ArrayLike = 0.0) -> None:
        self._fill(dx, dy, dtheta)

    def exp_jacobian(self) -> np.ndarray:
        """Jacobian of exp: how (x, y, theta) changes with (dx, dy, dtheta), shape (..., 3, 3).

        Example:
            >>> Displacement(1.0, 0.0, 0.0).exp_jacobian()[1].tolist()
            [0.0, 1.0, 0.5]
        """
        a, b, u, w = _exp_jacobian(self.dx, self.dy, self.dtheta)
        return matrix_of((a, -b, u), (b, a, w), (0.0, 0.0, 1.0))

    def right_jacobian(self) -> np.ndarray:
        """J_r with exp(xi + d) = exp(xi) exp(J_r d) for a small d, shape (..., 3, 3).  [Sola 2018, eq. 163]

        Example:
            >>> Displacement().right_jacobian().tolist() == np.eye(3).tolist()
            True
        """
        a, b, u, w = _right_jacobian(self.dx, self.dy, self.dtheta)
        return matrix_of((a, b, u), (-b, a, w), (0.0, 0.0, 1.0))

    def over(self, duration: ArrayLike) -> Twist:
        """The constant twist that makes this displacement in ``duration`` [s].

        Raises:
            InvalidValue: If the duration is not positive.
        """
        dt = checks.positive("duration", duration)
        return Twist._of(*_over(self.dx, self.dy, self.dtheta, dt))


@dataclass(frozen=True, slots=True, eq=False, init=False)
class Twist(Triple):
    """A velocity of the body seen from the body.

    Attributes:
        vx: Forward [m/s].
        vy: To the left [m/s].
        omega: Counterclockwise [rad/s].

    Example:
        >>> Twist(1.0, 0.0, 0.5).during(2.0)
        Displacement(dx=2.0, dy=0.0, dtheta=1.0)
    """

    names: ClassVar = ("vx", "vy", "omega")
    vx: Real
    vy: Real
    omega: Real

    def __init__(self, vx: ArrayLike = 0.0, vy: ArrayLike = 0.0, omega: ArrayLike = 0.0) -> None:
        self._fill(vx, vy, omega)

    def during(self, duration: ArrayLike) -> Displacement:
        """The displacement made in ``duration`` [s] at this constant twist; negative durations go back."""
        dt = checks.real("duration", duration)
        return Displacement._of(*_during(self.vx, self.vy, self.omega, dt))

    def in_world(self, heading: ArrayLike) -> np.ndarray:
        """Pose rates (xdot, ydot, thetadot) of a body with this heading [rad], shape (..., 3).

        Example:
            >>> from math import pi
            >>> Twist(1.0, 0.0, 0.2).in_world(pi / 2).round(12).tolist()
            [0.0, 1.0, 0.2]
        """
        vx, vy = _rotate(checks.real("heading", heading), self.vx, self.vy)
        rates: np.ndarray = stack((vx, vy, self.omega))
        return rates

    @classmethod
    def from_world(cls, rates: ArrayLike, heading: ArrayLike) -> Twist:
        """The body twist of pose rates (..., 3) given in the world.

        Example:
            >>> Twist.from_world([0.0, 1.0, 0.2], 0.0)
            Twist(vx=0.0, vy=1.0, omega=0.2)
        """
        vx, vy, omega = components(checks.vector("rates", rates, 3))
        forward, left = _rotate(-checks.real("heading", heading), vx, vy)
        return cls._of(forward, left, checks.frozen(omega))
