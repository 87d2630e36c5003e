"""Motion in the plane: segments of constant acceleration, programs of them, ramps, odometry, holonomic motion.

Radians, metres, seconds. Every field is a float or an array; leading axes are robots, and broadcast as in NumPy.
"""

from coplanar.motion.comparison import Comparison
from coplanar.motion.covariance import OdometryNoise
from coplanar.motion.driving import DrivingHistory
from coplanar.motion.holonomic import HolonomicMotion, discretize, twist_between
from coplanar.motion.odometry import Odometry
from coplanar.motion.program import Program
from coplanar.motion.ramp import Ramp, Trapezoid
from coplanar.motion.reckoning import Reckoning, Stretch
from coplanar.motion.segment import Segment

__all__ = [
    "Comparison",
    "DrivingHistory",
    "HolonomicMotion",
    "Odometry",
    "OdometryNoise",
    "Program",
    "Ramp",
    "Reckoning",
    "Segment",
    "Stretch",
    "Trapezoid",
    "discretize",
    "twist_between",
]
