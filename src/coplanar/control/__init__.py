"""Controllers: from an error and a reference to a command (v, omega).

``PointTracker`` makes a point fixed on the robot follow a reference, ``PolarController`` drives to a pose. Both tell
what their loop will do before it runs: ``controller.stability(step)``.
"""

from coplanar.control.controller import Controller
from coplanar.control.limits import Limits
from coplanar.control.point_tracker import PointTracker
from coplanar.control.polar import PolarController
from coplanar.control.stability import Stability, StabilityReport
from coplanar.control.unicycle import METHODS, Unicycle

__all__ = [
    "METHODS",
    "Controller",
    "Limits",
    "PointTracker",
    "PolarController",
    "Stability",
    "StabilityReport",
    "Unicycle",
]
