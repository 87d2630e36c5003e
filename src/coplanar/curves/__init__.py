"""Curves of the plane, and references that run along them in time.

A curve has a position and two derivatives over an interval of its parameter; ``curve.over(duration)`` is a
``Reference`` with position, velocity and acceleration in time. Parameters of shape (...) give points (..., 2).
"""

from coplanar.curves.analytic import Astroid, Circle, Ellipse, Lemniscate, Line
from coplanar.curves.base import Curve
from coplanar.curves.free import FreeCurve
from coplanar.curves.points import Polyline, Spline
from coplanar.curves.reference import HeldPoint, Reference, Timed

__all__ = [
    "Astroid",
    "Circle",
    "Curve",
    "Ellipse",
    "FreeCurve",
    "HeldPoint",
    "Lemniscate",
    "Line",
    "Polyline",
    "Reference",
    "Spline",
    "Timed",
]
