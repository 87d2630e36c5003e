"""What an arm is made of: checks of its fields, its reach, and the two links that a closed form sees."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from coplanar import checks
from coplanar.errors import InvalidShape, InvalidValue, UnknownName
from coplanar.se2 import Pose

if TYPE_CHECKING:
    from coplanar.arms.chain import Chain

CONVENTIONS = ("absolute", "relative")


def joint_letters(joints: Any, n: int) -> str:
    """One letter for each of n links; all "R" when None."""
    letters = "R" * n if joints is None else joints
    if not isinstance(letters, str):
        raise InvalidValue("joints", joints, "a word such as 'RRP'")
    for letter in letters:
        if letter not in ("R", "P"):
            raise UnknownName("joints", letter, ("R", "P"))
    if len(letters) != n or n == 0:
        raise InvalidShape("joints", f"{len(letters)} joints for {n} links", "one letter a link, at least one")
    return letters


def link_lengths(links: Any, joints: str) -> tuple[float, ...]:
    """Lengths: positive, for a prismatic joint 0 or more."""
    lengths = np.atleast_1d(checks.not_negative("links", links, remedy="a length is in metres and never negative"))
    if lengths.ndim != 1:
        raise InvalidShape("links", f"shape {lengths.shape}", "a vector of lengths")
    if any(length == 0.0 and joint == "R" for length, joint in zip(lengths, joints, strict=True)):
        raise InvalidValue("links", links, "greater than 0 at a revolute joint", "leave a link of no length out")
    return tuple(lengths.tolist())


def joint_limits(limits: Any, n: int) -> tuple[tuple[float, float], ...] | None:
    """A pair for every joint, or None."""
    if limits is None:
        return None
    pairs = [(-math.inf, math.inf) if pair is None else pair for pair in limits]
    try:
        table = np.array(pairs, dtype=float)
    except (TypeError, ValueError):
        raise InvalidValue("limits", limits, "a pair (lower, upper) or None for every joint") from None
    if table.shape != (n, 2):
        raise InvalidShape("limits", f"shape {table.shape}", f"shape ({n}, 2)", "give a pair for every joint")
    if not np.all((table[:, 0] <= table[:, 1]) & (table[:, 0] < math.inf) & (table[:, 1] > -math.inf)):
        raise InvalidValue("limits", limits, "lower <= upper for every joint, not NaN")
    return tuple((low, high) for low, high in table.tolist())


def fixed_bends(bends: Any, n: int) -> tuple[float, ...]:
    """An angle for every link; 0 when None."""
    if bends is None:
        return (0.0,) * n
    angles = checks.vector("bends", bends)
    if angles.shape != (n,):
        raise InvalidShape("bends", f"shape {angles.shape}", f"shape ({n},)", "give an angle for every link")
    return tuple(angles.tolist())


def single_pose(name: str, pose: Any) -> None:
    """Refuse what is no single pose."""
    if not isinstance(pose, Pose):
        raise InvalidValue(name, pose, "a Pose")
    if pose.shape:
        raise InvalidShape(name, f"poses of shape {pose.shape}", "one pose", "make an arm for each")


def tool_lever(chain: Chain) -> tuple[float, float]:
    """The last link and the tool as one: length from the last joint to the tool's origin, and its angle to the link."""
    along = chain.links[-1] + chain.tool.x
    return math.hypot(along, chain.tool.y), math.atan2(chain.tool.y, along)


def levers(chain: Chain) -> tuple[float, ...]:
    """The links with the last one measured to the tool."""
    return (*chain.links[:-1], tool_lever(chain)[0])


def ring(lengths: tuple[float, ...]) -> tuple[float, float]:
    """Inner and outer radius of what freely turning links reach: L and max(0, 2 max(l) - L), L their sum.

    Example:
        >>> ring((1.0, 0.25)), ring((1.0, 1.0, 1.0))
        ((0.75, 1.25), (0.0, 3.0))
    """
    longest = max(lengths)
    others = math.fsum(lengths) - longest if len(lengths) != 2 else min(lengths)
    return max(0.0, longest - others), math.fsum(lengths)


def turns_freely(chain: Chain) -> bool:
    """Whether every joint is revolute and none is limited."""
    return "P" not in chain.joints and chain.limits is None
