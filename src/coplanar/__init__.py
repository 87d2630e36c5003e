"""Robots that live in a plane: frames, arms, wheels, motion, projectiles.

SI units and radians everywhere; leading axes broadcast as in NumPy. ``T_a_b`` takes coordinates in b to coordinates in a.
"""

from coplanar.arms import Arm
from coplanar.control import PointTracker, PolarController, Unicycle
from coplanar.curves import Astroid, Circle, Ellipse, FreeCurve, Lemniscate, Line, Polyline, Spline
from coplanar.errors import CoplanarError, InvalidInput, NoSolution
from coplanar.frames import FrameTree, coordinates, from_coordinates
from coplanar.integrators import integrate_ode
from coplanar.motion import DrivingHistory, HolonomicMotion, Odometry, OdometryNoise, Program, Ramp, Segment, Trapezoid
from coplanar.run import Run
from coplanar.se2 import Displacement, Pose, Twist, unwrap_angles, wrap_angle
from coplanar.simulate import simulate
from coplanar.tracing import trace
from coplanar.wheels import Icr, RollingWheel, Wheel, WheeledBase, identify_wiring

__version__ = "0.1.0"

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
