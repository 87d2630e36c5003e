"""A serial arm in the plane."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.arms.chain import Chain
from coplanar.arms.ellipses import Ellipse, ellipse_of
from coplanar.arms.inverse import inverse
from coplanar.arms.posture import Posture, columns
from coplanar.arms.rates import Rates, resolve_rates
from coplanar.arms.solution import Solution
from coplanar.arms.workspace import Workspace, workspace_of
from coplanar.checks import ArrayLike
from coplanar.engine import components, evaluator, stack
from coplanar.errors import InvalidShape
from coplanar.laws import arms as laws
from coplanar.se2 import Pose

_torque = evaluator(laws.torque)


@dataclass(frozen=True, slots=True)
class Arm(Chain):
    """A serial arm in the plane: phi_i = phi_(i-1) + q_i + bend_i, P_i = P_(i-1) + l_i [cos phi_i, sin phi_i].

    A revolute joint "R" turns its link: q_i is the angle from the link before ("relative") or from the base's x axis
    ("absolute") [rad]. A prismatic joint "P" extends its link: the link keeps the direction of the one before and has
    the length links[i] + q_i along itself [m].

    Attributes:
        links: Length of every link [m]; positive, for a prismatic joint 0 or more.
        joints: One letter a link, "R" or "P"; all revolute when None.
        angles: "relative" or "absolute".
        base: Where the arm stands in the world.
        tool: The tool in the last link's frame, whose origin is the link's end and whose x axis points along it.
        limits: A pair (lower, upper) for every joint [rad or m], infinite ones and None allowed; free when None.
        bends: A fixed angle added to every link's direction [rad]; 0 when None. With pi/2 a slide stands across.

    Raises:
        InvalidShape: If the numbers of links, joints, limits and bends differ, or base or tool is a batch.
        InvalidValue: If a length is not positive, a number not finite, or limits are in the wrong order.
        UnknownName: If a joint is neither R nor P, or the convention of the angles is unknown.

    Example:
        >>> arm = Arm((1.0, 0.5))
        >>> arm.forward([0.0, 0.0])
        Pose(x=1.5, y=0.0, theta=0.0)
        >>> Arm((1.0, 0.5), angles="absolute").forward([1.0, 0.0]).theta
        0.0
        >>> Arm((1.0, 0.5), joints="RP").forward([0.0, 0.25])
        Pose(x=1.75, y=0.0, theta=0.0)
    """

    def manipulability(self, q: ArrayLike, *, task: str = "position") -> Any:
        """Product of the min(m, n) singular values of J: sqrt(det(J J^T)) where m <= n.  [Yoshikawa 1985]

        For two joints and the three rows of a pose det(J J^T) is 0 everywhere; the product of the two singular
        values that exist, sqrt(det(J^T J)), is what says how far the arm is from singular.

        Args:
            q: Joint variables, shape (..., n).
            task: "position" or "pose" (which adds rad to m).

        Example:
            >>> round(Arm((1.0, 0.5)).manipulability([0.3, -1.5707963267948966]), 12)
            0.5
        """
        product = np.linalg.svd(self.jacobian(q, task=task), compute_uv=False).prod(axis=-1)
        return float(product) if product.ndim == 0 else product

    def ellipse(self, q: ArrayLike, *, kind: str = "velocity", task: str = "position") -> Ellipse:
        """Where unit joint rates take the tool (velocity), or what force unit joint torques hold (force).

        Args:
            q: Joint variables, shape (..., n).
            kind: "velocity" or "force".
            task: "position" for an ellipse, "pose" for an ellipsoid.

        Example:
            >>> Arm((1.0, 1.0)).ellipse([0.0, 0.0]).radii.round(12).tolist()
            [2.2360679775, 0.0]
        """
        return ellipse_of(self.jacobian(q, task=task), kind)

    def torques(self, q: ArrayLike, wrench: ArrayLike) -> np.ndarray:
        """Joint torques tau = J^T f with which the tool pushes with this wrench, at rest, without weight.

        Args:
            q: Joint variables, shape (..., n).
            wrench: Force (fx, fy) [N], or force and moment (fx, fy, m) [N, N m], in world axes at the tool.

        Returns:
            Torque of every revolute joint [N m], force of every prismatic one [N], shape (..., n).

        Raises:
            InvalidShape: If the wrench has neither two nor three components.

        Example:
            >>> Arm((1.0, 0.5)).torques([0.0, 0.0], [0.0, 2.0]).tolist()
            [3.0, 1.0]
        """
        force = checks.vector("wrench", wrench)
        if np.shape(force)[-1] not in (2, 3):
            raise InvalidShape("wrench", f"shape {np.shape(force)}", "shape (..., 2) or (..., 3)")
        checked = self.checked_joints("q", q)
        checks.broadcast(q=checked[..., 0], wrench=force[..., 0])
        fx, fy, *moment = components(force)
        parts = columns(self, Posture.of(self, checked))
        torques: np.ndarray = stack([_torque(*column, fx, fy, *(moment or [0.0])) for column in parts])
        return torques

    def rates(
        self,
        q: ArrayLike,
        velocity: ArrayLike,
        *,
        task: str = "position",
        damping: float | None = None,
        null_rate: ArrayLike | None = None,
    ) -> Rates:
        """Joint rates for a velocity of the tool, exact and damped, with what each leaves undone.

        Args:
            q: Joint variables, shape (..., n).
            velocity: Of the tool in the world: (vx, vy), for the task "pose" (vx, vy, omega) [m/s, rad/s].
            task: "position" or "pose".
            damping: lambda of the damped rates [m/rad]; 0.05 of the sum of the links when None.
            null_rate: Joint rates to come as near to as the task leaves free (n > m), shape (..., n).

        Example:
            >>> rates = Arm((1.0, 1.0)).rates([0.0, 1.0], [0.1, 0.0])
            >>> rates.exact.round(6).tolist()
            [0.064209, -0.183049]
        """
        return resolve_rates(
            self, self.checked_joints("q", q), velocity, task=task, damping=damping, null_rate=null_rate
        )

    def inverse(
        self,
        target: ArrayLike | Pose,
        *,
        near: ArrayLike | None = None,
        elbow: ArrayLike | None = None,
        method: str = "auto",
        tolerance: float = 1e-9,
        iterations: int = 100,
    ) -> Solution:
        """Joints that bring the tool to a target, or as near as it gets; every branch where there is a closed form.

        Two revolute joints and a position, or three and a pose, are solved in closed form; everything else by damped
        least squares. Branches are compared in unwrapped joints: whole turns are added where that comes nearer to
        ``near`` or into the limits.

        Args:
            target: Position of the tool, shape (..., 2) [m], or its pose, in the world.
            near: Joints to come nearest to, shape (..., n); the numerical search starts there. Zeros when None, and
                the search then starts from bent postures of its own.
            elbow: +1 or -1 takes this branch, the sign of the sine at the elbow; the nearest (then +1) when None.
            method: "auto", "closed" or "numerical".
            tolerance: How far from the target counts as reached [m]; the gap is reported all the same.
            iterations: Budget of the numerical search.

        Returns:
            Joints, branches, status, nearest point, gap; ``.or_raise()`` for those who prefer an exception.

        Raises:
            InvalidShape: If target and near do not broadcast.
            InvalidValue: If a number is not finite, or the elbow neither +1 nor -1.
            UnknownName: If the method is none of the three, or "closed" where there is no closed form.

        Example:
            >>> arm = Arm((1.0, 1.0))
            >>> arm.inverse([1.0, 1.0]).branches.round(6).tolist()
            [[0.0, 1.570796], [1.570796, -1.570796]]
            >>> answer = arm.inverse([3.0, 0.0])
            >>> answer.status.name, answer.gap, answer.nearest.tolist()
            ('TOO_FAR', 1.0, [2.0, 0.0])
        """
        return inverse(self, target, near=near, elbow=elbow, method=method, tolerance=tolerance, iterations=iterations)

    def workspace(self) -> Workspace:
        """Which points the tool can reach: a ring, or the region that the joint limits leave of it.

        Example:
            >>> ring = Arm((1.0, 0.4)).workspace()
            >>> ring.outer, round(ring.inner, 12), ring.exact
            (1.4, 0.6, True)
        """
        return workspace_of(self)
