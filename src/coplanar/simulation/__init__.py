"""Closed loops: plant, controller and reference make a ``Run``."""

from coplanar.simulation.loop import Plant, simulate
from coplanar.simulation.noise import Noise

__all__ = ["Noise", "Plant", "simulate"]
