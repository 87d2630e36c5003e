"""Poses, twists and displacements of the plane.

``T_a_b`` takes coordinates in frame b to coordinates in frame a, so that adjacent letters cancel:
``T_a_c = T_a_b @ T_b_c`` and ``p_a = T_a_b @ p_b``. Radians, metres, seconds.
A rate (``Twist``, m/s and rad/s) and an increment (``Displacement``, m and rad) are different types.
Every field is a float or an array; leading axes broadcast as in NumPy.
"""

from coplanar.se2.angles import unwrap_angles, wrap_angle
from coplanar.se2.pose import Pose
from coplanar.se2.twist import Displacement, Twist

__all__ = ["Displacement", "Pose", "Twist", "unwrap_angles", "wrap_angle"]
