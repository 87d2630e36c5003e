"""Closed loops: plant, controller and reference make a ``Run``."""

from coplanar.simulate.loop import Plant, simulate
from coplanar.simulate.noise import Noise

__all__ = ["Noise", "Plant", "simulate"]
