"""Planar arms in URDF: read where the chain lies in one plane, whichever it is."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np

from coplanar import checks
from coplanar.arms import Arm
from coplanar.checks import ArrayLike
from coplanar.errors import UnknownName
from coplanar.logs.files import contents, refuse
from coplanar.logs.urdf_joints import FREE, MOVING, TURNING, Joint, chain_of
from coplanar.logs.xml_tree import xml_of
from coplanar.run.files import blaming
from coplanar.se2 import Pose, wrap_angle

LARGEST = 2**26  # bytes of a URDF that is read unless told otherwise
_SAME = 1e-9  # metres: axes this near, or links this short, are one point


@dataclass(frozen=True, slots=True, eq=False)
class UrdfArm:
    """The planar arm that a URDF describes, and how its numbers and ours go together.

    Attributes:
        arm: The arm, in its plane.
        names: The joints that move, from the root on.
        signs: +1 or -1: what a joint's value in the URDF is multiplied by to be the arm's.
        root: The link at the beginning of the chain.
        tip: The link at its end, the arm's tool.
        plane: T_root_plane, shape (4, 4); the arm's x, y are the first two axes, and the tool moves in z = 0.
        tilt: How far the worst axis is from where a planar chain has it [rad].
    """

    arm: Arm
    names: tuple[str, ...]
    signs: tuple[float, ...]
    root: str
    tip: str
    plane: np.ndarray
    tilt: float

    def joints(self, values: ArrayLike | Mapping[str, float]) -> np.ndarray:
        """The arm's joint variables from the URDF's, by name or in order, shape (..., n); those left out are 0.

        Raises:
            UnknownName: If a name is not one of the joints.
        """
        if isinstance(values, Mapping):
            for name in values:
                if name not in self.names:
                    raise UnknownName("joint", name, self.names)
            values = [values.get(name, 0.0) for name in self.names]
        q: np.ndarray = self.arm.checked_joints("values", values) * np.array(self.signs)
        return q

    def values(self, q: ArrayLike) -> np.ndarray:
        """The URDF's joint values from the arm's, shape (..., n)."""
        return self.joints(q)

    def in_root(self, points: ArrayLike) -> np.ndarray:
        """Points of the arm's plane, shape (..., 2), in the frame of the root link, shape (..., 3) [m]."""
        flat: np.ndarray = checks.vector("points", points, 2)
        spatial: np.ndarray = flat @ self.plane[:3, :2].T + self.plane[:3, 3]
        return spatial


class _Placed(NamedTuple):
    """A joint that moves, as it stands in the root's frame at rest."""

    joint: Joint
    position: np.ndarray
    axis: np.ndarray


class _Link(NamedTuple):
    """A link in the plane: its length, its direction at rest, and the sign of its joint."""

    length: float
    direction: float
    sign: float


def read_urdf(
    path: str | os.PathLike[str], *, tip: str | None = None, tilt: float = 1e-3, largest: int = LARGEST
) -> UrdfArm:
    """Read the planar arm that a URDF describes.

    The chain from the root to the tip may have revolute, continuous, prismatic and fixed joints. The axes of all that
    turn are parallel, slides stand across them, and what comes after a slide stands along it. The plane is any; links
    may lie at different heights above it. Its x axis is the root's x as the plane sees it (y where x stands across).
    It is looked at so that the root's z comes towards the eye or, in an upright plane, points up; an axis that points
    away from the eye has the sign -1. The first fixed joint off the last axis is the end of the last link; what
    follows is the tool.

    Args:
        path: The file; xacro is expanded before.
        tip: The link at the end of the chain; needed where the tree has branches.
        tilt: How far an axis may be from its place and be taken to be there [rad]; 1.57 for pi/2 is 8e-4 off.
        largest: The most bytes the file may have.

    Raises:
        InvalidValue: If the file cannot be read or is no planar chain, naming the line and the reason.
        UnknownName: If there is no link of the tip's name.

    Source: URDF XML specification (ROS).
    """
    file = Path(path)
    slack = checks.positive("tilt", tilt)
    robot = xml_of(file, contents(file, largest))
    chain = chain_of(file, robot, tip)
    with np.errstate(all="ignore"):
        return _planar(file, robot.line, chain, slack)


def _planar(file: Path, line: int, chain: list[Joint], slack: float) -> UrdfArm:
    """The arm of a chain."""
    placed, fixed, base = _placed(chain)
    if not placed:
        refuse(file, f"line {line}", "a chain in which nothing moves", "revolute or prismatic joints")
    axes = _axes(placed)
    worst = _check_axes(file, placed, axes[2], slack)
    points = [one.position @ axes[:2].T for one in placed]
    end, last = _end_of(file, placed[-1], points[-1], [T[:3, 3] @ axes[:2].T for T in fixed], axes)
    links = [_link(file, *three, axes, slack) for three in zip(placed[:-1], points, points[1:], strict=False)]
    links.append(last)
    with blaming(file):
        arm = _arm(placed, links, (_pose(points[0], _heading(base, axes)), end, fixed[-1]), axes)
    plane = np.eye(4)
    plane[:3, :3] = axes.T
    plane[:3, 3] = axes[2] * (fixed[-1][:3, 3] @ axes[2])
    names, signs = tuple(one.joint.name for one in placed), tuple(link.sign for link in links)
    return UrdfArm(arm, names, signs, chain[0].parent, chain[-1].child, checks.frozen(plane), worst)


def _placed(chain: list[Joint]) -> tuple[list[_Placed], list[np.ndarray], np.ndarray]:
    """The joints that move, T_root_link of every link from the last of them on, and of the one below the first."""
    placed: list[_Placed] = []
    beyond: list[np.ndarray] = []
    below = at = np.eye(4)
    for joint in chain:
        base, at = at, at @ joint.origin
        if joint.kind in MOVING:
            below = below if placed else base
            placed.append(_Placed(joint, at[:3, 3], at[:3, :3] @ joint.axis))
            beyond = []
        beyond.append(at)
    return placed, beyond, below


def _axes(placed: list[_Placed]) -> np.ndarray:
    """The plane's x, y and normal in the root's frame, in rows."""
    normal = next((one.axis for one in placed if one.joint.kind in TURNING), np.array([0.0, 0.0, 1.0]))
    normal = np.where(np.abs(normal) < 1e-12, 0.0, normal)
    across = np.eye(3)[0 if abs(normal[0]) < 0.9 else 1]
    x = across - normal * (across @ normal)
    x = x / math.sqrt(x @ x)
    y = np.cross(normal, x)
    up = normal[2] if abs(normal[2]) >= abs(y[2]) else y[2]
    return np.array([x, y, normal]) if up > 0.0 else np.array([x, -y, -normal])


def _check_axes(file: Path, placed: list[_Placed], normal: np.ndarray, slack: float) -> float:
    """How far the worst axis is from its place.

    Raises:
        InvalidValue: Naming the line of an axis that is farther.
    """
    worst = 0.0
    for one in placed:
        along, across = float(one.axis @ normal), np.cross(one.axis, normal)
        off = math.atan2(math.sqrt(across @ across), abs(along))
        needed = "an axis parallel to the others that turn"
        if one.joint.kind not in TURNING:
            off, needed = 0.5 * math.pi - off, "a slide across the axes that turn"
        if off > slack:
            given = f"joint {one.joint.name!r}, {math.degrees(off):.3g} deg off the plane"
            refuse(file, f"line {one.joint.line}", given, needed)
        worst = max(worst, off)
    return worst


def _link(file: Path, placed: _Placed, begin: np.ndarray, end: np.ndarray, axes: np.ndarray, slack: float) -> _Link:
    """The link from a joint to the next."""
    dx, dy = (end - begin).tolist()
    length = math.hypot(dx, dy)
    line, name = f"line {placed.joint.line}", placed.joint.name
    if placed.joint.kind in TURNING:
        if length <= _SAME:
            refuse(file, line, f"joint {name!r} and the next on one axis", "links that are longer than 0")
        return _Link(length, math.atan2(dy, dx), math.copysign(1.0, placed.axis @ axes[2]))
    ux, uy = (placed.axis @ axes[:2].T).tolist()
    if length <= _SAME:
        return _Link(0.0, math.atan2(uy, ux), 1.0)
    if abs(ux * dy - uy * dx) > slack * length:
        refuse(file, line, f"slide {name!r} with the next joint {length:.3g} m away", "the next joint along the slide")
    return _Link(length, math.atan2(dy, dx), math.copysign(1.0, ux * dx + uy * dy))


def _end_of(
    file: Path, placed: _Placed, begin: np.ndarray, beyond: list[np.ndarray], axes: np.ndarray
) -> tuple[np.ndarray, _Link]:
    """Where the last link ends, and the link: at the first frame off its axis."""
    away = [point for point in beyond if math.hypot(*(point - begin).tolist()) > _SAME]
    if placed.joint.kind in TURNING:
        if not away:
            given = f"joint {placed.joint.name!r} with nothing off its axis"
            refuse(file, f"line {placed.joint.line}", given, "a link that ends somewhere", "add a fixed joint there")
        return away[0], _link(file, placed, begin, away[0], axes, 0.0)
    slide = placed.axis @ axes[:2].T
    along = [point for point in away[:1] if abs(np.linalg.det([slide, point - begin])) <= _SAME]
    end = along[0] if along else begin
    return end, _link(file, placed, begin, end, axes, 1.0)


def _arm(
    placed: list[_Placed], links: list[_Link], frames: tuple[Pose, np.ndarray, np.ndarray], axes: np.ndarray
) -> Arm:
    base, end, tip = frames
    directions = [base.theta, *(link.direction for link in links)]
    bends = [_tidy(after - before) for before, after in pairwise(directions)]
    limits = [_signed(one.joint.limits, link.sign) for one, link in zip(placed, links, strict=True)]
    tool = _pose(end, directions[-1]).between(_pose(tip[:3, 3] @ axes[:2].T, _heading(tip, axes)))
    return Arm(
        tuple(link.length for link in links),
        joints="".join("R" if one.joint.kind in TURNING else "P" for one in placed),
        base=base,
        tool=Pose(_short(tool.x), _short(tool.y), _tidy(tool.theta)),
        limits=None if all(pair == FREE for pair in limits) else limits,
        bends=bends if any(bends) else None,
    )


def _heading(frame: np.ndarray, axes: np.ndarray) -> float:
    """The angle in the plane of a frame's x axis, or of its y axis where x stands across the plane."""
    in_plane = axes[:2] @ frame[:3, :2]
    column = 0 if math.hypot(*in_plane[:, 0]) > 0.5 else 1
    return _tidy(math.atan2(in_plane[1, column], in_plane[0, column]))


def _pose(point: np.ndarray, theta: float) -> Pose:
    return Pose(float(point[0]), float(point[1]), theta)


def _signed(limits: tuple[float, float], sign: float) -> tuple[float, float]:
    return limits if sign > 0.0 else (-limits[1], -limits[0])


def _tidy(angle: float) -> float:
    """In (-pi, pi]; what is rounding is 0."""
    wrapped = float(wrap_angle(angle))
    return 0.0 if abs(wrapped) < 1e-15 else wrapped


def _short(length: float) -> float:
    return 0.0 if abs(length) < 1e-15 else length
