"""A chain of links: what it is made of, and where it is."""

from __future__ import annotations

import math
from dataclasses import KW_ONLY, dataclass, field
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.arms import geometry
from coplanar.arms.plan import Plan, plan_of
from coplanar.arms.posture import Posture, column_rates, columns, linkage
from coplanar.checks import ArrayLike
from coplanar.engine import memory, stack
from coplanar.se2 import Pose
from coplanar.se2.triple import matrix_of

TASKS = ("pose", "position")

_FLOAT = frozenset((float,))


@dataclass(frozen=True, slots=True)
class Chain:
    """A chain of n links: phi_i = phi_(i-1) + q_i + bend_i, P_i = P_(i-1) + l_i [cos phi_i, sin phi_i].

    ``Arm`` says what each field is, and adds what is solved.

    Raises:
        InvalidShape: If the numbers of links, joints, limits and bends differ, or base or tool is a batch.
        InvalidValue: If a length is not positive, a number not finite, or limits are in the wrong order.
        UnknownName: If a joint is neither R nor P, or the convention of the angles is unknown.

    Example:
        >>> Chain((1.0, 0.5)).forward([0.0, 0.0])
        Pose(x=1.5, y=0.0, theta=0.0)
    """

    links: Any
    _: KW_ONLY
    joints: Any = None
    angles: str = "relative"
    base: Pose = field(default_factory=Pose)
    tool: Pose = field(default_factory=Pose)
    limits: Any = None
    bends: Any = None
    plan: Plan = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        n = np.size(self.links)
        joints = geometry.joint_letters(self.joints, n)
        checked = {
            "joints": joints,
            "links": geometry.link_lengths(self.links, joints),
            "angles": checks.choice("angles", self.angles, geometry.CONVENTIONS),
            "limits": geometry.joint_limits(self.limits, n),
            "bends": geometry.fixed_bends(self.bends, n),
        }
        for name, value in checked.items():
            object.__setattr__(self, name, value)
        for name in ("base", "tool"):
            geometry.single_pose(name, getattr(self, name))
        object.__setattr__(self, "plan", plan_of(self))

    @property
    def n(self) -> int:
        """How many joints there are."""
        return len(self.links)

    @property
    def lower(self) -> np.ndarray:
        """Lower joint limits, -inf where there is none, shape (n,)."""
        return np.array([-math.inf] * self.n if self.limits is None else [low for low, _ in self.limits])

    @property
    def upper(self) -> np.ndarray:
        """Upper joint limits, inf where there is none, shape (n,)."""
        return np.array([math.inf] * self.n if self.limits is None else [high for _, high in self.limits])

    def forward(self, q: ArrayLike, *, out: np.ndarray | None = None) -> Pose:
        """Pose of the tool in the world.

        Args:
            q: Joint variables [rad, m], shape (..., n).
            out: Where x, y and theta are written, shape (3, ...); the pose that comes back looks at it.

        Raises:
            InvalidShape: If the last axis is not n long, or ``out`` is of another shape or type.
            InvalidValue: If an entry is not finite.

        Example:
            >>> from math import pi
            >>> tool = Chain((1.0, 1.0)).forward([0.0, pi / 2])
            >>> tool.as_array().round(12).tolist()
            [1.0, 1.0, 1.570796326795]
        """
        joints = self.joints_of(q)
        if out is not None:
            checks.output(out, (3, *np.shape(joints)[:-1]))
        if self._in_loops(joints):
            return self._rows(joints, task=None, into=(out, None))[0]
        posture = Posture.of(self, joints)
        x, y, theta = *posture.tip, posture.angles[-1] + self.tool.theta
        if out is not None:
            out[0], out[1], out[2] = x, y, theta
            x, y, theta = out if out.ndim > 1 else out.tolist()
        return Pose._of(x, y, theta)

    def kinematics(self, q: ArrayLike, *, task: str = "pose") -> tuple[Pose, np.ndarray]:
        """``forward`` and ``jacobian`` at once, for little more than either.

        Args:
            q: Joint variables, shape (..., n).
            task: "pose" or "position".

        Example:
            >>> tool, jacobian = Chain((1.0, 0.5)).kinematics([0.0, 0.0])
            >>> tool.x, jacobian[1].tolist()
            (1.5, [1.5, 0.5])
        """
        _check_task(task)
        joints = self.joints_of(q)
        if self._in_loops(joints):
            pose, jacobian = self._rows(joints, task=task)
            return pose, np.asarray(jacobian)
        posture = Posture.of(self, joints)
        pose = Pose._of(*posture.tip, posture.angles[-1] + self.tool.theta)
        return pose, _matrix(columns(self, posture), task)

    def points(self, q: ArrayLike) -> np.ndarray:
        """The base, the end of every link, and the tool where it stands off the last link's end.

        Args:
            q: Joint variables, shape (..., n).

        Returns:
            World coordinates, shape (..., n + 1, 2); (..., n + 2, 2) with a tool off the end [m].

        Example:
            >>> Chain((1.0, 0.5)).points([0.0, 0.0]).tolist()
            [[0.0, 0.0], [1.0, 0.0], [1.5, 0.0]]
        """
        joints = self.joints_of(q)
        if self._in_loops(joints):
            points = memory.empty((*joints.shape[:-1], self.n + (2 if self.plan.mounted else 1), 2))
            linkage.places(
                self.plan.table, joints.reshape(-1, self.n), None, points.reshape(-1, *points.shape[-2:]), None
            )
            return points
        posture = Posture.of(self, joints)
        corners = [*posture.points, posture.tip] if self.plan.mounted else posture.points
        xs, ys = (stack(part) for part in zip(*corners, strict=True))
        corners_of: np.ndarray = stack((xs, ys))
        return corners_of

    def jacobian(self, q: ArrayLike, *, task: str = "pose", out: np.ndarray | None = None) -> np.ndarray:
        """J with [xdot, ydot, thetadot] = J q_rate, of the tool in the world.

        Args:
            q: Joint variables, shape (..., n).
            task: "pose" for three rows, "position" for the first two.
            out: Where it is written, of its shape; it comes back.

        Returns:
            Shape (..., 3, n) or (..., 2, n) [m/rad or 1; the last row rad/rad or 0].

        Raises:
            UnknownName: If the task is neither.

        Example:
            >>> Chain((1.0, 0.5)).jacobian([0.0, 0.0]).tolist()
            [[0.0, 0.0], [1.5, 0.5], [1.0, 1.0]]
        """
        if task not in TASKS:
            _check_task(task)
        joints = self.joints_of(q)
        if out is not None:
            checks.output(out, (*np.shape(joints)[:-1], 3 if task == "pose" else 2, self.n))
        if self._in_loops(joints):
            return np.asarray(self._rows(joints, task=task, pose=False, into=(None, out))[1])
        matrix = _matrix(columns(self, Posture.of(self, joints)), task)
        if out is None:
            return matrix
        out[...] = matrix
        return out

    def jacobian_dot(self, q: ArrayLike, q_rate: ArrayLike, *, task: str = "pose") -> np.ndarray:
        """dJ/dt along q_rate, so that the tool's acceleration is J q_acceleration + Jdot q_rate.

        Args:
            q: Joint variables, shape (..., n).
            q_rate: Joint rates [rad/s, m/s], shape (..., n).
            task: "pose" or "position".

        Returns:
            Shape (..., 3, n) or (..., 2, n).

        Example:
            >>> Chain((1.0, 0.5)).jacobian_dot([0.0, 0.0], [1.0, 0.0], task="position").tolist()
            [[-1.5, -0.5], [0.0, 0.0]]
        """
        _check_task(task)
        at, rates = self.checked_joints("q", q), self.checked_joints("q_rate", q_rate)
        checks.broadcast(q=at, q_rate=rates)
        return _matrix(column_rates(self, Posture.of(self, at), rates), task)

    def is_within_limits(self, q: ArrayLike, *, tolerance: float = 1e-12) -> Any:
        """Whether every joint is inside its limits, to a tolerance [rad, m]: bool, or an array of the leading shape.

        Example:
            >>> Chain((1.0, 1.0), limits=[(-1.0, 1.0), None]).is_within_limits([[0.5, 9.0], [1.5, 0.0]]).tolist()
            [True, False]
        """
        joints = self.checked_joints("q", q)
        inside = ((joints >= self.lower - tolerance) & (joints <= self.upper + tolerance)).all(axis=-1)
        return bool(inside) if np.ndim(inside) == 0 else inside

    def joints_of(self, q: ArrayLike, name: str = "q") -> Any:
        """Checked joints as they are evaluated: floats of one configuration in a list, many in an array (..., n)."""
        values = q.tolist() if type(q) is np.ndarray and q.ndim == 1 and q.dtype == np.float64 else q
        if type(values) in (list, tuple) and _FLOAT.issuperset(map(type, values)) and len(values) == self.n:
            total = sum(map(abs, values))
            if total < math.inf:
                return list(values)
        checked = self.checked_joints(name, q)
        return checked.tolist() if type(checked) is np.ndarray and checked.ndim == 1 else checked

    def _in_loops(self, joints: Any) -> bool:
        """Whether the compiled loops serve so many rows sooner."""
        return type(joints) is np.ndarray and linkage.pays("chain", joints.size // self.n)

    def _rows(
        self, joints: np.ndarray, *, task: str | None, pose: bool = True, into: tuple[Any, Any] = (None, None)
    ) -> tuple[Pose, np.ndarray | None]:
        """Pose and Jacobian by the compiled loop, into arrays that are there or into new ones."""
        lead = joints.shape[:-1]
        rows = joints.size // self.n
        size = (rows, 3 if task == "pose" else 2, self.n)
        parts = _room(into[0], (3, rows if pose else 0), joints)
        jacobian = None if task is None else _room(into[1], size, joints)
        linkage.places(self.plan.table, joints.reshape(-1, self.n), parts, None, jacobian)
        tool = Pose._of(*(part.reshape(lead) for part in _placed(parts, into[0]))) if pose else self.base
        return tool, None if jacobian is None else _placed(jacobian, into[1]).reshape(*lead, *size[1:])

    def checked_joints(self, name: str, q: ArrayLike) -> Any:
        """One finite value for every joint, shape (..., n); ``name`` is what an error calls it."""
        return checks.vector(name, q, self.n, remedy=f"give one value for each of the {self.n} joints")


def _room(wanted: np.ndarray | None, size: tuple[int, ...], joints: np.ndarray) -> np.ndarray:
    """Contiguous rows apart from the joints: those of the wanted memory where it can be, or new ones."""
    if wanted is not None and wanted.flags.c_contiguous and not np.may_share_memory(wanted, joints):
        return wanted.reshape(size)
    return memory.empty(size)


def _placed(made: np.ndarray, wanted: np.ndarray | None) -> np.ndarray:
    """What was made, in the wanted memory if there is one."""
    if wanted is None or np.may_share_memory(made, wanted):
        return made
    wanted[...] = made.reshape(wanted.shape)
    return wanted


def _matrix(table: list[tuple[Any, Any, float]], task: str) -> np.ndarray:
    """The Jacobian from its columns."""
    xs, ys, turns = zip(*table, strict=True)
    if type(xs[0]) is float:
        return np.array(xs + ys + turns if task == "pose" else xs + ys).reshape(-1, len(table))
    return matrix_of(xs, ys, turns) if task == "pose" else matrix_of(xs, ys)


def _check_task(task: str) -> None:
    if task not in TASKS:
        checks.choice("task", task, TASKS)
