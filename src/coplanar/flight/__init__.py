"""Projectiles with quadratic drag: launch them, land them, aim them."""

from coplanar.flight.aiming import Aim, Arc
from coplanar.flight.forms import AimStatus
from coplanar.flight.impact import Impact, ImpactStatus
from coplanar.flight.projectile import Projectile
from coplanar.flight.reach import Reach, Tolerant
from coplanar.flight.shot import Shot
from coplanar.flight.state import Energy, FlightState, Sensitivity

__all__ = [
    "Aim",
    "AimStatus",
    "Arc",
    "Energy",
    "FlightState",
    "Impact",
    "ImpactStatus",
    "Projectile",
    "Reach",
    "Sensitivity",
    "Shot",
    "Tolerant",
]
