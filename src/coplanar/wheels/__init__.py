"""Wheels: one that rolls along a road, and bases that stand on a table of them."""

from coplanar.wheels.base import WheeledBase
from coplanar.wheels.doctor import Finding, FindingKind
from coplanar.wheels.feasible import FeasibleTwist, TwistStatus
from coplanar.wheels.icr import Icr, IcrStatus, turning_radius, wheel_centre_speeds
from coplanar.wheels.mobility import Mobility
from coplanar.wheels.rolling import RollingWheel
from coplanar.wheels.saturation import Saturation
from coplanar.wheels.slip import Slip, SlipStatus
from coplanar.wheels.wheel import Wheel
from coplanar.wheels.wiring import Wiring, WiringStatus, identify_wiring

__all__ = [
    "FeasibleTwist",
    "Finding",
    "FindingKind",
    "Icr",
    "IcrStatus",
    "Mobility",
    "RollingWheel",
    "Saturation",
    "Slip",
    "SlipStatus",
    "TwistStatus",
    "Wheel",
    "WheeledBase",
    "Wiring",
    "WiringStatus",
    "identify_wiring",
    "turning_radius",
    "wheel_centre_speeds",
]
