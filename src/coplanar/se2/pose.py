"""Poses: where one frame stands in another."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import ClassVar, overload

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import components, evaluator, is_foreign, stack
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.laws import se2 as laws
from coplanar.se2.triple import Triple, matrix_of
from coplanar.se2.twist import Displacement, Twist

_act = evaluator(laws.act)
_act_inverse = evaluator(laws.act_inverse)
_adjoint = evaluator(laws.adjoint)
_between = evaluator(laws.between)
_compose = evaluator(laws.compose)
_exp = evaluator(laws.exp)
_exp_jacobian = evaluator(laws.exp_jacobian)
_heading = evaluator(laws.heading)
_inverse = evaluator(laws.inverse)
_lerp = evaluator(laws.lerp)
_integrate = evaluator(laws.integrate)
_log = evaluator(laws.log)
_rotate = evaluator(laws.rotate)
_screw = evaluator(laws.screw)
_separation = evaluator(laws.separation)
_step = evaluator(laws.step)
_wrap = evaluator(laws.wrap)

_A_RATE = "a Twist makes one by during(duration)"


@dataclass(frozen=True, slots=True, eq=False, init=False)
class Pose(Triple):
    """A frame in another: origin (x, y) and heading theta; or poses of any leading shape.

    The heading is kept as given: 2 pi is a full turn, not 0. ``wrapped`` brings it into (-pi, pi].

    Attributes:
        x: [m].
        y: [m].
        theta: Heading, counterclockwise from the x axis [rad].

    Example:
        >>> T_a_b, T_b_c = Pose(1.0, 0.0, 0.0), Pose(2.0, 3.0, 0.5)
        >>> T_a_b @ T_b_c
        Pose(x=3.0, y=3.0, theta=0.5)
        >>> (T_a_b @ (0.0, 1.0)).tolist()
        [1.0, 1.0]
    """

    names: ClassVar = ("x", "y", "theta")
    x: Real
    y: Real
    theta: Real

    def __init__(self, x: ArrayLike = 0.0, y: ArrayLike = 0.0, theta: ArrayLike = 0.0) -> None:
        self._fill(x, y, theta)

    @classmethod
    def exp(cls, displacement: Displacement) -> Pose:
        """Pose reached along a constant displacement: p = sinc(h) R(h) (dx, dy), h = dtheta/2.

        Example:
            >>> from math import pi
            >>> Pose.exp(Displacement(pi / 2, 0.0, pi / 2)).as_array().round(12).tolist()
            [1.0, 1.0, 1.570796326795]
        """
        checks.instance("displacement", displacement, Displacement, remedy=_A_RATE)
        return cls._of(*_exp(displacement.dx, displacement.dy, displacement.dtheta))

    @classmethod
    def from_matrix(cls, matrix: ArrayLike, *, rotation_error: float = 1e-9) -> Pose:
        """The pose of homogeneous matrices, shape (..., 3, 3); the heading comes in (-pi, pi].

        Args:
            matrix: [[R, p], [0, 0, 1]].
            rotation_error: How far R^T R may be from 1, and the last row from (0, 0, 1), entry by entry [-].

        Raises:
            InvalidShape: If the last axes are not 3 by 3.
            InvalidValue: If the upper left block is no rotation (a reflection is none) or the last row is another.

        Example:
            >>> Pose.from_matrix(Pose(1.0, 2.0, 3.0).as_matrix())
            Pose(x=1.0, y=2.0, theta=3.0)
        """
        T = checks.vector("matrix", matrix, 3)
        if T.ndim < 2 or T.shape[-2] != 3:
            raise InvalidShape("matrix", f"shape {T.shape}", "shape (..., 3, 3)")
        if not is_foreign(T) and not _is_rigid(T, checks.positive("rotation_error", rotation_error)):
            raise InvalidValue(
                "matrix", matrix, "[[R, p], [0, 0, 1]] with a rotation R", "no scale, no reflection, not transposed"
            )
        return cls(T[..., 0, 2], T[..., 1, 2], _heading(T[..., 0, 0], T[..., 1, 0]))

    def as_matrix(self) -> np.ndarray:
        """T = [[R, p], [0, 0, 1]], shape (..., 3, 3).

        Example:
            >>> Pose(1.0, 2.0, 0.0).as_matrix().tolist()
            [[1.0, -0.0, 1.0], [0.0, 1.0, 2.0], [0.0, 0.0, 1.0]]
        """
        c, s = _rotate(self.theta, 1.0, 0.0)
        return matrix_of((c, -s, self.x), (s, c, self.y), (0.0, 0.0, 1.0))

    @property
    def position(self) -> np.ndarray:
        """Origin (x, y), shape (..., 2)."""
        point: np.ndarray = stack((self.x, self.y))
        return point

    @property
    def wrapped(self) -> Pose:
        """The same pose with its heading in (-pi, pi]."""
        return Pose._of(self.x, self.y, _wrap(self.theta))

    @overload
    def __matmul__(self, other: Pose) -> Pose: ...
    @overload
    def __matmul__(self, other: ArrayLike) -> np.ndarray: ...
    def __matmul__(self, other: Pose | ArrayLike) -> Pose | np.ndarray:
        """``T_a_b @ T_b_c`` composes; ``T_a_b @ p_b`` takes points, shape (..., 2), to frame a."""
        if isinstance(other, Pose):
            return Pose._of(*_compose(self.x, self.y, self.theta, other.x, other.y, other.theta))
        if isinstance(other, Triple):
            remedy = "step() takes a Displacement, transform() a Twist"
            raise InvalidValue("right of @", other, "a Pose or points (..., 2)", remedy)
        points: np.ndarray = stack(_act(self.x, self.y, self.theta, *components(checks.vector("points", other, 2))))
        return points

    def act(self, px: ArrayLike, py: ArrayLike) -> tuple[Real, Real]:
        """Coordinates in the outer frame of the point (px, py): C_0 = O_1 + R C_1.

        Example:
            >>> Pose(1.0, 2.0, 0.0).act(0.5, 0.0)
            (1.5, 2.0)
        """
        x, y = _act(self.x, self.y, self.theta, checks.real("px", px), checks.real("py", py))
        return x, y

    def act_inverse(self, px: ArrayLike, py: ArrayLike) -> tuple[Real, Real]:
        """Coordinates in the inner frame of an outer point: C_1 = R^T (C_0 - O_1).

        Example:
            >>> Pose(1.0, 2.0, 0.0).act_inverse(1.5, 2.0)
            (0.5, 0.0)
        """
        x, y = _act_inverse(self.x, self.y, self.theta, checks.real("px", px), checks.real("py", py))
        return x, y

    def inverse(self) -> Pose:
        """T_b_a = T_a_b^-1.

        Example:
            >>> Pose(1.0, 2.0, 0.0).inverse()
            Pose(x=-1.0, y=-2.0, theta=-0.0)
        """
        return Pose._of(*_inverse(self.x, self.y, self.theta))

    def between(self, other: Pose) -> Pose:
        """T_b_c = T_a_b^-1 T_a_c: the other pose seen from this one.

        Example:
            >>> Pose(1.0, 2.0, 0.0).between(Pose(3.0, 2.0, 0.5))
            Pose(x=2.0, y=0.0, theta=0.5)
        """
        checks.instance("other", other, Pose)
        return Pose._of(*_between(self.x, self.y, self.theta, other.x, other.y, other.theta))

    def log(self) -> Displacement:
        """Exponential coordinates with dtheta in (-pi, pi]: the constant displacement that leads here.

        Example:
            >>> from math import pi
            >>> Pose(1.0, 1.0, pi / 2).log().as_array().round(12).tolist()
            [1.570796326795, 0.0, 1.570796326795]
        """
        return Displacement._of(*_log(self.x, self.y, self.theta))

    def step(self, increment: Displacement, *, out: np.ndarray | None = None) -> Pose:
        """T exp(increment): the pose after a displacement seen from the body.

        Args:
            increment: What is driven, seen from the body.
            out: Where x, y and theta are written, shape (3, ...); the pose that comes back looks at it.

        Raises:
            InvalidShape: If they do not broadcast, or ``out`` is of another shape or type.

        Example:
            >>> Pose(1.0, 0.0, 0.0).step(Displacement(2.0, 0.0, 0.0))
            Pose(x=3.0, y=0.0, theta=0.0)
        """
        checks.instance("increment", increment, Displacement, remedy=_A_RATE)
        return Pose._into(out, _step, self.x, self.y, self.theta, increment.dx, increment.dy, increment.dtheta)

    def integrate(self, twist: Twist, duration: ArrayLike, *, out: np.ndarray | None = None) -> Pose:
        """T exp(V dt): the pose after a constant twist for ``duration`` [s]; one step of odometry.

        Args:
            twist: Velocity of the body, seen from itself.
            duration: How long [s].
            out: Where x, y and theta are written, shape (3, ...); the pose that comes back looks at it.

        Raises:
            InvalidShape: If they do not broadcast, or ``out`` is of another shape or type.

        Example:
            >>> Pose(1.0, 0.0, 0.0).integrate(Twist(2.0, 0.0, 0.0), 0.5)
            Pose(x=2.0, y=0.0, theta=0.0)
        """
        dt = duration
        if type(twist) is not Twist or type(dt) is not float or not isfinite(dt):  # asked here: control loops call this
            checks.instance("twist", twist, Twist)
            dt = checks.real("duration", duration)
        if out is not None:
            return Pose._into(out, _integrate, *self.parts, *twist.parts, dt)
        return Pose._of(*_integrate(self.x, self.y, self.theta, twist.vx, twist.vy, twist.omega, dt))

    def transform(self, twist: Twist) -> Twist:
        """Ad_T xi: the twist of the rigid body, seen from frame a instead of frame b.

        Example:
            >>> Pose(0.0, 1.0, 0.0).transform(Twist(0.0, 0.0, 2.0))
            Twist(vx=2.0, vy=0.0, omega=2.0)
        """
        checks.instance("twist", twist, Twist)
        return Twist._of(*_adjoint(self.x, self.y, self.theta, twist.vx, twist.vy, twist.omega))

    def adjoint(self) -> np.ndarray:
        """Ad_T = [[c, -s, y], [s, c, -x], [0, 0, 1]], shape (..., 3, 3).

        Example:
            >>> Pose(1.0, 2.0, 0.0).adjoint()[:, 2].tolist()
            [2.0, -1.0, 1.0]
        """
        c, s = _rotate(self.theta, 1.0, 0.0)
        return matrix_of((c, -s, self.y), (s, c, -self.x), (0.0, 0.0, 1.0))

    def interpolate(self, other: Pose, fraction: ArrayLike, *, path: str = "screw") -> Pose:
        """The pose a fraction of the way to another.

        Args:
            other: Where fraction = 1 leads (up to full turns).
            fraction: 0 is this pose, 1 the other; broadcasts.
            path: "screw" keeps one constant twist (an arc); "decoupled" moves on the straight line while turning.

        Raises:
            UnknownName: If the path is neither.

        Example:
            >>> Pose(0.0, 0.0, 0.0).interpolate(Pose(2.0, 0.0, 0.0), 0.5)
            Pose(x=1.0, y=0.0, theta=0.0)
        """
        checks.choice("path", path, ("screw", "decoupled"))
        f = checks.real("fraction", fraction)
        way = self.between(other)
        if path == "decoupled":
            return Pose._of(*_lerp(*self.parts, *other.parts, f))
        return Pose._of(*_screw(*self.parts, *way.log().parts, f))

    def is_close(self, other: Pose, *, distance: float, angle: float) -> bool | np.ndarray:
        """Whether the origins and the directions are no further apart than told, pose by pose.

        Args:
            other: The pose to compare with; headings may differ by whole turns.
            distance: Between the origins [m].
            angle: Between the directions [rad].

        Example:
            >>> from math import pi
            >>> Pose(1.0, 0.0, pi).is_close(Pose(1.0, 1e-12, -pi), distance=1e-9, angle=1e-9)
            True
        """
        checks.instance("other", other, Pose)
        apart, turned = _separation(*self.parts, *other.parts)
        near: bool | np.ndarray = (apart <= checks.not_negative("distance", distance)) & (
            turned <= checks.not_negative("angle", angle)
        )
        return near


def _is_rigid(T: np.ndarray, error: float) -> bool:
    R = T[..., :2, :2]
    square = np.abs(R.swapaxes(-1, -2) @ R - np.eye(2)).max(initial=0.0)
    last = np.abs(T[..., 2, :] - (0.0, 0.0, 1.0)).max(initial=0.0)
    determinant = R[..., 0, 0] * R[..., 1, 1] - R[..., 0, 1] * R[..., 1, 0]
    return bool(square <= error and last <= error and np.all(determinant > 0.0))
