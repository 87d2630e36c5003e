"""Named frames in a tree, and the coordinates of a vector in an orthonormal basis."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike
from coplanar.engine import components, evaluator, is_foreign, stack
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.laws import frames as laws
from coplanar.se2 import Pose

_coordinates = evaluator(laws.coordinates)
_combination = evaluator(laws.combination)
_orthonormality_gap = evaluator(laws.orthonormality_gap)


@dataclass(frozen=True, slots=True)
class Frame:
    """A frame and where it stands in its parent.

    Attributes:
        name: Its name, unique in a tree.
        parent: The frame that ``pose`` is given in.
        pose: T_parent_name; one pose, or poses of any leading shape.
    """

    name: str
    parent: str
    pose: Pose


@dataclass(frozen=True, slots=True)
class FrameTree:
    """Frames by name, each placed in one that is there already: no name comes twice and no cycle can be built.

    Attributes:
        root: The frame that everything hangs on.
        frames: The others; each after its parent.

    Raises:
        InvalidValue: If a name is empty or taken.
        UnknownName: If a parent is not there yet, with the nearest name suggested.

    Example:
        >>> tree = FrameTree("world").with_frame("robot", "world", Pose(1.0, 2.0, 0.0))
        >>> tree = tree.with_frame("camera", "robot", Pose(0.5, 0.0, 0.0))
        >>> tree.pose("camera", "world")
        Pose(x=1.5, y=2.0, theta=0.0)
        >>> tree.pose("world", "camera")
        Pose(x=-1.5, y=-2.0, theta=0.0)
    """

    root: str = "world"
    frames: tuple[Frame, ...] = ()
    _by_name: Mapping[str, Frame] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        by_name: dict[str, Frame] = {}
        _check_name("root", self.root, ())
        for frame in self.frames:
            known = (self.root, *by_name)
            _check_name("name", frame.name, known)
            checks.choice("parent", frame.parent, known)
            by_name[frame.name] = frame
        object.__setattr__(self, "frames", tuple(self.frames))
        object.__setattr__(self, "_by_name", by_name)

    @property
    def names(self) -> tuple[str, ...]:
        """Every name, the root first."""
        return (self.root, *self._by_name)

    def with_frame(self, name: str, parent: str, pose: Pose) -> FrameTree:
        """A new tree with one frame more.

        Args:
            name: A name that is not taken.
            parent: The frame that the pose is given in.
            pose: T_parent_name [m, m, rad].

        Raises:
            InvalidValue: If the name is empty or taken.
            UnknownName: If there is no such parent.
        """
        return FrameTree(self.root, (*self.frames, Frame(name, parent, pose)))

    def with_pose(self, name: str, pose: Pose) -> FrameTree:
        """A new tree in which one frame stands elsewhere in its parent; its children go with it.

        Raises:
            UnknownName: If there is no such frame below the root.

        Example:
            >>> tree = FrameTree().with_frame("robot", "world", Pose()).with_frame("tool", "robot", Pose(1.0, 0.0, 0.0))
            >>> tree.with_pose("robot", Pose(0.0, 3.0, 0.0)).pose("tool", "world").y
            3.0
        """
        checks.choice("name", name, self._by_name)
        moved = (Frame(f.name, f.parent, pose) if f.name == name else f for f in self.frames)
        return FrameTree(self.root, tuple(moved))

    def parent(self, name: str) -> str | None:
        """The frame that ``name`` is placed in; None for the root.

        Raises:
            UnknownName: If there is no such frame.
        """
        checks.choice("name", name, self.names)
        return self._by_name[name].parent if name in self._by_name else None

    def lineage(self, name: str) -> tuple[str, ...]:
        """The frames from ``name`` up to the root, both included.

        Raises:
            UnknownName: If there is no such frame.

        Example:
            >>> FrameTree().with_frame("robot", "world", Pose()).lineage("robot")
            ('robot', 'world')
        """
        line = [checks.choice("name", name, self.names)]
        while line[-1] in self._by_name:
            line.append(self._by_name[line[-1]].parent)
        return tuple(line)

    def pose(self, of: str, in_: str) -> Pose:
        """T_in_of: where one frame stands in another, through their nearest common ancestor.

        Args:
            of: The frame that is looked at.
            in_: The frame that it is seen from.

        Returns:
            The pose of ``of`` in ``in_``; batched poses on the way broadcast.

        Raises:
            UnknownName: If one of the frames is not there.
            InvalidShape: If batched poses on the way do not broadcast.
        """
        up_of, up_in = self.lineage(of), self.lineage(in_)
        shared = next(name for name in up_of if name in up_in)
        below_of, below_in = up_of[: up_of.index(shared)], up_in[: up_in.index(shared)]
        checks.broadcast(
            **{name: np.broadcast_to(0.0, self._by_name[name].pose.shape) for name in (*below_of, *below_in)}
        )
        return self._down(below_in).between(self._down(below_of))

    def convert(self, points: ArrayLike, *, from_: str, to: str) -> np.ndarray:
        """The same points in another frame's coordinates: p_to = T_to_from p_from.

        Args:
            points: Shape (..., 2), in the frame ``from_`` [m].
            from_: The frame of the given coordinates.
            to: The frame of the wanted coordinates.

        Returns:
            Shape (..., 2), in the frame ``to`` [m].

        Example:
            >>> FrameTree().with_frame("robot", "world", Pose(1.0, 2.0, 0.0)).convert((0, 1), from_="robot", to="world")
            array([1., 3.])
        """
        converted: np.ndarray = self.pose(from_, to) @ points
        return converted

    def _down(self, lineage: tuple[str, ...]) -> Pose:
        """T_ancestor_frame along a lineage that ends below the ancestor."""
        pose = Pose()
        for name in reversed(lineage):
            pose = pose @ self._by_name[name].pose
        return pose


def coordinates(p: ArrayLike, basis: ArrayLike, *, tolerance: float = 1e-9) -> np.ndarray:
    """[p]_k = p . x_k: the coordinates of a vector in an orthonormal basis.

    Args:
        p: Shape (..., 2).
        basis: Shape (..., 2, 2): the vector x_k is row k; right-handed or left-handed.
        tolerance: How far the products x_i . x_j may be from 0 and 1 [-].

    Returns:
        Shape (..., 2).

    Raises:
        InvalidShape: If the shapes are others.
        InvalidValue: If the basis is not orthonormal.

    Example:
        >>> coordinates((3.0, 4.0), [(0.0, 1.0), (-1.0, 0.0)]).tolist()
        [4.0, -3.0]
    """
    vectors = _orthonormal(basis, tolerance)
    parts: np.ndarray = stack(_coordinates(*components(checks.vector("p", p, 2)), *vectors))
    return parts


def from_coordinates(c: ArrayLike, basis: ArrayLike, *, tolerance: float = 1e-9) -> np.ndarray:
    """Vector p = sum_k [p]_k x_k that has these coordinates in an orthonormal basis.

    Args:
        c: Shape (..., 2).
        basis: Shape (..., 2, 2): the vector x_k is row k.
        tolerance: How far the products x_i . x_j may be from 0 and 1 [-].

    Returns:
        Shape (..., 2).

    Raises:
        InvalidShape: If the shapes are others.
        InvalidValue: If the basis is not orthonormal.

    Example:
        >>> from_coordinates((4.0, -3.0), [(0.0, 1.0), (-1.0, 0.0)]).tolist()
        [3.0, 4.0]
    """
    vectors = _orthonormal(basis, tolerance)
    p: np.ndarray = stack(_combination(*components(checks.vector("c", c, 2)), *vectors))
    return p


def _check_name(role: str, name: str, taken: tuple[str, ...]) -> None:
    if not isinstance(name, str) or not name:
        raise InvalidValue(role, name, "a name of at least one letter")
    if name in taken:
        raise InvalidValue(role, name, "a name that is not taken", "move a frame by with_pose")


def _orthonormal(basis: ArrayLike, tolerance: float) -> tuple[ArrayLike, ...]:
    rows = checks.vector("basis", basis, 2)
    if np.ndim(rows) < 2 or rows.shape[-2] != 2:
        raise InvalidShape("basis", f"shape {np.shape(rows)}", "shape (..., 2, 2)", "give one basis vector in each row")
    vectors = (*components(rows[..., 0, :]), *components(rows[..., 1, :]))
    if not is_foreign(rows) and np.max(_orthonormality_gap(*vectors), initial=0.0) > tolerance:
        raise InvalidValue(
            "basis", rows.tolist(), f"unit vectors at right angles, to {tolerance:g}", "solve p = sum_k c_k x_k instead"
        )  # fmt: skip
    return vectors
