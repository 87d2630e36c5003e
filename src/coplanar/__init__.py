"""Robots that live in a plane: frames, arms, wheels, motion, projectiles."""

from coplanar.se2 import Displacement, Pose, Twist, unwrap_angles, wrap_angle

__version__ = "0.1.0"

__all__ = ["Displacement", "Pose", "Twist", "unwrap_angles", "wrap_angle"]
