"""The joints of a URDF, and the chain of them from the root to a tip."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import numpy as np

from coplanar.errors import UnknownName
from coplanar.logs.files import refuse
from coplanar.logs.xml_tree import Element
from coplanar.run.files import number

TURNING = ("continuous", "revolute")
MOVING = (*TURNING, "prismatic")
FREE = (-math.inf, math.inf)


class Joint(NamedTuple):
    """A joint of a URDF.

    Attributes:
        name: Its name.
        kind: "revolute", "continuous", "prismatic" or "fixed".
        parent: The link it stands on.
        child: The link it carries.
        origin: T_parent_joint at rest, shape (4, 4).
        axis: In the joint's own frame, of length 1, shape (3,).
        limits: Lowest and highest value [rad or m].
        line: Where in the file it begins.
    """

    name: str
    kind: str
    parent: str
    child: str
    origin: np.ndarray
    axis: np.ndarray
    limits: tuple[float, float]
    line: int


def chain_of(path: Path, robot: Element, tip: str | None) -> list[Joint]:
    """The joints from the root link to the tip, in order; the only leaf where no tip is named.

    Raises:
        InvalidValue: Naming the line of what is no chain.
        UnknownName: If there is no such tip.
    """
    if robot.tag != "robot":
        refuse(path, f"line {robot.line}", f"<{robot.tag}>", "<robot>, the top of a URDF")
    links = [_attribute(path, link, "name") for link in robot.all("link")]
    above: dict[str, Element] = {}
    for element in robot.all("joint"):
        child = _end(path, element, "child", links)
        if child in above:
            refuse(path, f"line {element.line}", f"link {child!r}", "a link carried by one joint")
        above[child] = element
    return _way_up(path, above, links, _tip(path, robot, above, links) if tip is None else _known(path, tip, links))


def _way_up(path: Path, above: dict[str, Element], links: list[str], tip: str) -> list[Joint]:
    """Joints from the root to the tip."""
    way: list[Joint] = []
    link = tip
    while link in above:
        if len(way) == len(above):
            refuse(path, f"line {above[link].line}", f"link {link!r}", "links that do not carry themselves")
        way.append(_joint(path, above[link], links))
        link = way[-1].parent
    return way[::-1]


def _known(path: Path, tip: str, links: list[str]) -> str:
    if tip not in links:
        raise UnknownName(f"tip in {path}", tip, links)
    return tip


def _tip(path: Path, robot: Element, above: dict[str, Element], links: list[str]) -> str:
    """The only leaf."""
    parents = Counter(_end(path, element, "parent", links) for element in above.values())
    for element in robot.all("joint"):
        parent = _end(path, element, "parent", links)
        if parents[parent] > 1:
            leaves = [link for link in links if link not in parents]
            refuse(path, f"line {element.line}", f"link {parent!r} with {parents[parent]} joints on it", "a chain",
                   f"name its end by tip=, one of {', '.join(leaves[:8])}")  # fmt: skip
    leaves = [link for link in links if link in above and link not in parents]
    if len(leaves) != 1:
        refuse(path, f"line {robot.line}", f"{len(leaves)} links at ends of chains", "one", "name the end by tip=")
    return leaves[0]


def _joint(path: Path, element: Element, links: list[str]) -> Joint:
    kind, where = _attribute(path, element, "type"), f"line {element.line}"
    name = _attribute(path, element, "name")
    if kind not in (*MOVING, "fixed"):
        refuse(path, where, f"a joint of type {kind!r}", "revolute, continuous, prismatic or fixed")
    if element.first("mimic") is not None:
        refuse(path, where, f"joint {name!r}, which mimics another", "joints that move on their own")
    parent, child = (_end(path, element, end, links) for end in ("parent", "child"))
    axis = _vector(path, element.first("axis"), "xyz", (1.0, 0.0, 0.0))
    length = math.hypot(*axis.tolist())
    if kind in MOVING and not 0.0 < length < math.inf:
        refuse(path, where, axis.tolist(), "an axis that is longer than 0")
    origin = _origin(path, element.first("origin"))
    return Joint(name, kind, parent, child, origin, axis / (length or 1.0), _limits(path, element, kind), element.line)


def _limits(path: Path, element: Element, kind: str) -> tuple[float, float]:
    """Those of a revolute or prismatic joint; 0 where the attribute is left out, as the format says."""
    if kind not in ("revolute", "prismatic"):
        return FREE
    limit = element.first("limit")
    if limit is None:
        refuse(path, f"line {element.line}", f"a {kind} joint without <limit>", "its limits")
    low, high = (_vector(path, limit, name, (0.0,), 1)[0] for name in ("lower", "upper"))
    if low > high:
        refuse(path, f"line {limit.line}", (float(low), float(high)), "lower <= upper")
    return float(low), float(high)


def _origin(path: Path, element: Element | None) -> np.ndarray:
    """The homogeneous matrix of xyz and of roll, pitch, yaw about fixed axes."""
    r, p, y = _vector(path, element, "rpy", (0.0, 0.0, 0.0)).tolist()
    cr, sr, cp, sp, cy, sy = math.cos(r), math.sin(r), math.cos(p), math.sin(p), math.cos(y), math.sin(y)
    matrix = np.eye(4)
    matrix[:3, :3] = (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )
    matrix[:3, 3] = _vector(path, element, "xyz", (0.0, 0.0, 0.0))
    return matrix


def _vector(
    path: Path, element: Element | None, name: str, default: tuple[float, ...], length: int = 3
) -> np.ndarray:  # fmt: skip
    """Numbers in an attribute."""
    if element is None or name not in element.attributes:
        return np.array(default)
    text = element.attributes[name]
    try:
        values = np.array([number(word) for word in text.split()])
    except ValueError:
        values = np.array([math.nan])
    if len(values) != length or not np.isfinite(values).all():
        remedy = "expand the xacro first" if "$" in text else ""
        refuse(path, f"line {element.line}", f'{name}="{text}"', f"{length} finite numbers", remedy)
    return values


def _end(path: Path, element: Element, end: str, links: list[str]) -> str:
    """The link that a joint names as its parent or child."""
    holder = element.first(end)
    if holder is None:
        refuse(path, f"line {element.line}", f"a joint without <{end}>", "parent and child")
    link = _attribute(path, holder, "link")
    if link not in links:
        refuse(path, f"line {holder.line}", f"{end} {link!r}", "a link of this file")
    return link


def _attribute(path: Path, element: Element, name: str) -> str:
    if not element.attributes.get(name):
        refuse(path, f"line {element.line}", f"<{element.tag}> without {name}", f"the attribute {name}")
    return element.attributes[name]
