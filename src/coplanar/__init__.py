"""Robots that live in a plane: frames, arms, wheels, motion, projectiles.

SI units and radians everywhere; leading axes broadcast as in NumPy. ``T_a_b`` takes coordinates in b to those in a.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from coplanar.arms import Arm
    from coplanar.control import PointTracker, PolarController, Unicycle
    from coplanar.curves import Astroid, Circle, Ellipse, FreeCurve, Lemniscate, Line, Polyline, Spline
    from coplanar.errors import CoplanarError, InvalidInput, NoSolution
    from coplanar.flight import Projectile
    from coplanar.frames import FrameTree, coordinates, from_coordinates
    from coplanar.integrators import integrate_ode
    from coplanar.motion import (
        DrivingHistory,
        HolonomicMotion,
        Odometry,
        OdometryNoise,
        Program,
        Ramp,
        Segment,
        Trapezoid,
    )
    from coplanar.run import Run
    from coplanar.se2 import Displacement, Pose, Twist, unwrap_angles, wrap_angle
    from coplanar.simulation import simulate
    from coplanar.tracing import trace
    from coplanar.wheels import Icr, RollingWheel, Wheel, WheeledBase, identify_wiring

__version__ = "0.1.0"

_HOMES = {
    "arms": "Arm",
    "control": "PointTracker PolarController Unicycle",
    "curves": "Astroid Circle Ellipse FreeCurve Lemniscate Line Polyline Spline",
    "errors": "CoplanarError InvalidInput NoSolution",
    "flight": "Projectile",
    "frames": "FrameTree coordinates from_coordinates",
    "integrators": "integrate_ode",
    "motion": "DrivingHistory HolonomicMotion Odometry OdometryNoise Program Ramp Segment Trapezoid",
    "run": "Run",
    "se2": "Displacement Pose Twist unwrap_angles wrap_angle",
    "simulation": "simulate",
    "tracing": "trace",
    "wheels": "Icr RollingWheel Wheel WheeledBase identify_wiring",
}
_HOME = {name: home for home, names in _HOMES.items() for name in names.split()}

__all__ = [
    "Arm",
    "Astroid",
    "Circle",
    "CoplanarError",
    "Displacement",
    "DrivingHistory",
    "Ellipse",
    "FrameTree",
    "FreeCurve",
    "HolonomicMotion",
    "Icr",
    "InvalidInput",
    "Lemniscate",
    "Line",
    "NoSolution",
    "Odometry",
    "OdometryNoise",
    "PointTracker",
    "PolarController",
    "Polyline",
    "Pose",
    "Program",
    "Projectile",
    "Ramp",
    "RollingWheel",
    "Run",
    "Segment",
    "Spline",
    "Trapezoid",
    "Twist",
    "Unicycle",
    "Wheel",
    "WheeledBase",
    "coordinates",
    "from_coordinates",
    "identify_wiring",
    "integrate_ode",
    "simulate",
    "trace",
    "unwrap_angles",
    "wrap_angle",
]


def __getattr__(name: str) -> Any:
    """Import a name from its home when it is first asked for, so that ``import coplanar`` costs next to nothing."""
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module(f"{__name__}.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
