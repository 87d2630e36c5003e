"""Robots that live in a plane: frames, arms, wheels, motion, projectiles.

SI units and radians everywhere; leading axes broadcast as in NumPy. ``T_a_b`` takes coordinates in b to those in a.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from coplanar.version import __version__ as __version__

if TYPE_CHECKING:
    from coplanar.arms import Arm
    from coplanar.control import Limits, PointTracker, PolarController, Unicycle
    from coplanar.curves import Astroid, Circle, Ellipse, FreeCurve, HeldPoint, Lemniscate, Line, Polyline, Spline
    from coplanar.engine import warm_up
    from coplanar.errors import CoplanarError, InvalidInput, NoSolution
    from coplanar.flight import Projectile
    from coplanar.frames import FrameTree, coordinates, from_coordinates
    from coplanar.integrators import integrate_ode
    from coplanar.logs import read_choreo, read_log, read_path, read_urdf, write_log, write_urdf
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
    from coplanar.simulation import Noise, simulate
    from coplanar.sweeps import sweep
    from coplanar.tracing import trace
    from coplanar.wheels import Icr, RollingWheel, Wheel, WheeledBase, identify_wiring

_HOMES = {
    "arms": "Arm",
    "control": "Limits PointTracker PolarController Unicycle",
    "curves": "Astroid Circle Ellipse FreeCurve HeldPoint Lemniscate Line Polyline Spline",
    "engine": "warm_up",
    "errors": "CoplanarError InvalidInput NoSolution",
    "flight": "Projectile",
    "frames": "FrameTree coordinates from_coordinates",
    "integrators": "integrate_ode",
    "logs": "read_choreo read_log read_path read_urdf write_log write_urdf",
    "motion": "DrivingHistory HolonomicMotion Odometry OdometryNoise Program Ramp Segment Trapezoid",
    "run": "Run",
    "se2": "Displacement Pose Twist unwrap_angles wrap_angle",
    "simulation": "Noise simulate",
    "sweeps": "sweep",
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
    "HeldPoint",
    "HolonomicMotion",
    "Icr",
    "InvalidInput",
    "Lemniscate",
    "Limits",
    "Line",
    "NoSolution",
    "Noise",
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
    "read_choreo",
    "read_log",
    "read_path",
    "read_urdf",
    "simulate",
    "sweep",
    "trace",
    "unwrap_angles",
    "warm_up",
    "wrap_angle",
    "write_log",
    "write_urdf",
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
