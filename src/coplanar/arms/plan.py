"""What follows from an arm's fields, worked out once: the table of its joints, and what the closed form solves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from coplanar.arms import geometry
from coplanar.engine.linkage import ChainTable

if TYPE_CHECKING:
    from coplanar.arms.chain import Chain


@dataclass(frozen=True, slots=True, eq=False)
class TwoLinks:
    """The two links that a closed form solves.

    Attributes:
        l1: First link [m].
        l2: Second link, or the line from the second joint to the tool [m].
        lean: Angle from the second link to that line [rad].
        inner: Radius of the hole that they cannot reach [m].
        outer: Radius of the disc that they can [m].
    """

    l1: float
    l2: float
    lean: float
    inner: float
    outer: float


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """An arm as the laws read it.

    Attributes:
        joints: For every joint (carry, turns, bend, length, slides) of ``laws.arms.joint_link``.
        ends: For every joint the index of the last place that turns with it as one rigid body; n stands for the tool.
        turns_tool: dtheta/dq of every joint, 1 or 0.
        mounted: Whether the tool stands off the last link's end.
        at_origin: Whether the base is the world's frame.
        plain: Whether the joints are the closed form's own angles: no bends, no limits, relative, a straight tool.
        position: The two links of the closed form for a position; None where there is none.
        pose: Likewise for a pose.
        table: The same for the compiled loops.
    """

    joints: tuple[tuple[float, float, float, float, float], ...]
    ends: tuple[int, ...]
    turns_tool: tuple[float, ...]
    mounted: bool
    at_origin: bool
    plain: bool
    position: TwoLinks | None
    pose: TwoLinks | None
    table: ChainTable


def plan_of(chain: Chain) -> Plan:
    """Worked out from checked fields."""
    n, tool, base = len(chain.links), chain.tool, chain.base
    joints, ends = _joints(chain), _ends(chain)
    turns_tool = tuple(float(j == "R" and end == n) for j, end in zip(chain.joints, ends, strict=True))
    lever, lean = geometry.tool_lever(chain)
    position = _two_links(chain.links[0], lever, lean) if chain.joints == "RR" else None
    return Plan(
        joints=joints,
        ends=ends,
        turns_tool=turns_tool,
        mounted=(tool.x, tool.y) != (0.0, 0.0),
        at_origin=base.parts == (0.0, 0.0, 0.0),
        plain=chain.joints == "RR"
        and chain.angles == "relative"
        and not any(chain.bends)
        and chain.limits is None
        and lean == 0.0,
        position=position,
        pose=_two_links(chain.links[0], chain.links[1], 0.0) if chain.joints == "RRR" else None,
        table=ChainTable(
            np.column_stack((np.array(joints), turns_tool)),
            np.array([n + 1 if end == n else end for end in ends], dtype=np.int64),
            np.array([base.parts, tool.parts]),
        ),
    )


def _two_links(l1: float, l2: float, lean: float) -> TwoLinks:
    return TwoLinks(l1, l2, lean, *geometry.ring((l1, l2)))


def _joints(chain: Chain) -> tuple[tuple[float, float, float, float, float], ...]:
    """Rows for phi = carry phi_before + turns q + bend; an absolute angle starts from the base's."""
    rows = []
    for joint, bend, length in zip(chain.joints, chain.bends, chain.links, strict=True):
        turns = joint == "R"
        absolute = turns and chain.angles == "absolute"
        start = chain.base.theta if absolute else 0.0
        rows.append((float(not absolute), float(turns), start + bend, length, float(not turns)))
    return tuple(rows)


def _ends(chain: Chain) -> tuple[int, ...]:
    n = len(chain.joints)
    if chain.angles == "relative":
        return (n,) * n
    return tuple(next((k for k in range(i + 1, n) if chain.joints[k] == "R"), n) for i in range(n))
