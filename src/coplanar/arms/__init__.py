"""Serial arms in the plane: forward, inverse and differential kinematics, joint torques, workspace.

``Arm`` is links of given lengths on revolute or prismatic joints. Joints are ``(..., n)``, points ``(..., 2)``; the
convention of the angles, relative or absolute, is a word in the constructor.
"""

from coplanar.arms.arcs import Arc
from coplanar.arms.arm import Arm
from coplanar.arms.ellipses import Ellipse
from coplanar.arms.rates import Rates
from coplanar.arms.solution import Reach, Solution
from coplanar.arms.workspace import Workspace

__all__ = ["Arc", "Arm", "Ellipse", "Rates", "Reach", "Solution", "Workspace"]
