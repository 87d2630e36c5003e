"""What is said of a projectile at one moment."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from coplanar.checks import Real
from coplanar.engine import stack


class FlightState(NamedTuple):
    """Where a projectile is and how it moves.

    Attributes:
        time: Since the launch [s].
        x: [m].
        y: Upwards [m].
        vx: [m/s].
        vy: [m/s].
    """

    time: Real
    x: Real
    y: Real
    vx: Real
    vy: Real

    @property
    def position(self) -> np.ndarray:
        """Points of shape (..., 2) [m]."""
        points: np.ndarray = stack((self.x, self.y))
        return points

    @property
    def velocity(self) -> np.ndarray:
        """Velocities of shape (..., 2) [m/s]."""
        vectors: np.ndarray = stack((self.vx, self.vy))
        return vectors

    @property
    def speed(self) -> Real:
        """Absolute value of the velocity [m/s]."""
        return plain(np.hypot(self.vx, self.vy))

    @property
    def angle(self) -> Real:
        """Direction of the velocity [rad]."""
        return plain(np.arctan2(self.vy, self.vx))


class Energy(NamedTuple):
    """Energies of a projectile [J].

    Attributes:
        kinetic: m v^2/2.
        potential: m g y, above y = 0.
        lost: What drag has taken since the launch.
    """

    kinetic: Real
    potential: Real
    lost: Real

    @property
    def total(self) -> Real:
        """Kinetic and potential [J]."""
        return self.kinetic + self.potential


class Sensitivity(NamedTuple):
    """How a point moves with the launch: derivatives of shape (..., 2).

    Attributes:
        by_speed: [m per m/s].
        by_angle: [m/rad].
    """

    by_speed: np.ndarray
    by_angle: np.ndarray


def plain(row: Any) -> Any:
    """A float for shape (), the array otherwise."""
    return float(row) if np.ndim(row) == 0 else np.asarray(row)
