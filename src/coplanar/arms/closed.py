"""Closed forms: two revolute joints for a position, three for a pose, both branches of each, worked out when asked."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from coplanar.arms.chain import Chain
from coplanar.arms.geometry import tool_lever
from coplanar.arms.goal import ELBOWS, Goal
from coplanar.arms.plan import TwoLinks
from coplanar.engine import evaluator, memory
from coplanar.laws import arms as laws
from coplanar.laws import se2
from coplanar.solving import Report

__all__ = [
    "ELBOWS", "Closed", "Triangle", "elbow_of", "has_closed_form", "joints_of_turns", "triangle_of", "wind",
]  # fmt: skip

ENDLESS = 1e15  # [rad] where there is no limit: the angle whose neighbour is a turn away

_act_inverse = evaluator(se2.act_inverse)
_chosen_elbow = evaluator(laws.chosen_elbow)
_joint_near = evaluator(laws.joint_near)
_joint_within = evaluator(laws.joint_within)
_turn_near = evaluator(laws.turn_near)
_turn_within = evaluator(laws.turn_within)
_two_link_both = evaluator(laws.two_link_both)
_two_link_reach = evaluator(laws.two_link_reach)
_two_link_row = evaluator(laws.two_link_row)
_two_link_turns = evaluator(laws.two_link_turns)
_wrist = evaluator(laws.wrist)


@dataclass(frozen=True, slots=True)
class Triangle:
    """The two links that a closed form solves, and their target from the base.

    Attributes:
        x: Target of the second link's end in the base frame, a float or shape (k,) [m].
        y: Likewise.
        l1: First link [m].
        l2: Second link, or the line from the second joint to the tool [m].
        lean: Angle from the second link to that line [rad].
        heading: Direction of the third link in the base frame [rad]; None without one.
    """

    x: Any
    y: Any
    l1: float
    l2: float
    lean: float
    heading: Any


def triangle_of(chain: Chain, points: np.ndarray, headings: np.ndarray | None) -> Triangle:
    """The triangle of base, elbow and wrist for world targets, shape (k, 2)."""
    links = links_of(chain, headings is not None)
    x, y, heading = _from_base(chain, points[:, 0], points[:, 1], headings)
    return Triangle(x, y, links.l1, links.l2, links.lean, heading)


def _from_base(chain: Chain, x: Any, y: Any, heading: Any) -> tuple[Any, Any, Any]:
    """Where the second link ends, in the base frame, and the third link's direction."""
    base = chain.base
    if not chain.plan.at_origin:
        x, y = _act_inverse(base.x, base.y, base.theta, x, y)
    if heading is None:
        return x, y, None
    turned = heading - base.theta - chain.tool.theta
    return *_wrist(x, y, turned, chain.links[-1] + chain.tool.x, chain.tool.y), turned


def links_of(chain: Chain, with_heading: bool) -> Any:
    """The ``TwoLinks`` of the closed form, or None: RR and a position, RRR and a pose."""
    return chain.plan.pose if with_heading else chain.plan.position


def has_closed_form(chain: Chain, with_heading: bool) -> bool:
    """Whether ``triangle_of`` holds."""
    return links_of(chain, with_heading) is not None


class One:
    """The answer for one position and an arm whose joints are the closed form's own angles: all of it, by one law.

    The attributes are those of ``Closed``.
    """

    __slots__ = ("angles", "code", "elbow", "gap")
    report, iterations, inside = Report(), 0.0, (1.0, 1.0)

    def __init__(self, chain: Chain, goal: Goal, links: TwoLinks) -> None:
        x, y = goal.x, goal.y
        if not chain.plan.at_origin:
            x, y, _ = _from_base(chain, x, y, None)
        up, down, bend, self.gap, self.code = _two_link_both(
            x, y, links.l1, links.l2, links.inner, links.outer, goal.tolerance
        )
        self.angles = up, bend, down, -bend  # of the elbow's +1, then of -1
        self.elbow = 1.0 if goal.elbow is None else goal.elbow

    @property
    def branches(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """The joints of the elbow's +1, then of -1."""
        return self.angles[:2], self.angles[2:]

    @property
    def joints(self) -> tuple[float, ...]:
        """Those of the wanted elbow."""
        return self.angles[:2] if self.elbow > 0.0 else self.angles[2:]


class Closed:
    """The answer in closed form, in columns as the goal's; of what nobody asks for nothing is computed.

    Joints are a list of floats for one target, a table of shape (n, k) for many.
    """

    report = Report()

    def __init__(self, chain: Chain, goal: Goal, links: TwoLinks) -> None:
        self._chain, self._goal, self._links = chain, goal, links
        self._plain = chain.plan.plain and goal.near is None
        if not self._plain or not chain.plan.at_origin:
            goal.own()
        self._x, self._y, self._heading = _from_base(chain, goal.x, goal.y, goal.heading)
        # One branch is enough where no limit and no nearness has a say in which.
        self._one_will_do = chain.limits is None and (goal.near is None or goal.elbow is not None)
        if self._one_will_do:
            self.elbow = 1.0 if goal.elbow is None else goal.elbow
            self.joints = self._branch(self.elbow)[0]
        else:
            self.elbow, self.joints = self._choice()

    @cached_property
    def _reach(self) -> Any:
        links = self._links
        return _two_link_reach(self._x, self._y, links.inner, links.outer, self._goal.tolerance)

    @property
    def gap(self) -> Any:
        """Distance of the target from the ring [m]."""
        return self._reach[0]

    @property
    def code(self) -> Any:
        """Place of the status in ``Reach``."""
        return self._reach[1]

    @property
    def iterations(self) -> Any:
        """None."""
        return 0.0 if type(self.elbow) is float else np.zeros(self._x.shape)

    @property
    def inside(self) -> tuple[Any, Any]:
        """For each branch 1 where its joints are within the limits, else 0."""
        return self._both[0][1], self._both[1][1]

    @cached_property
    def _both(self) -> tuple[Any, Any]:
        return self._branch(1.0), self._branch(-1.0)

    @cached_property
    def branches(self) -> tuple[Any, Any]:
        """The joints of the elbow's +1, then of -1."""
        if not self._one_will_do:
            return self._both[0][0], self._both[1][0]
        elbow, other = self.elbow, self._branch(-self.elbow)[0]
        if type(elbow) is float:
            return (self.joints, other) if elbow > 0.0 else (other, self.joints)
        return np.where(elbow > 0.0, self.joints, other), np.where(elbow > 0.0, other, self.joints)

    def _choice(self) -> tuple[Any, Any]:
        """Which branch serves each target, and its joints."""
        (up, inside_up), (down, inside_down) = self._both
        near, wish = self._goal.near, self._goal.elbow
        off = (0.0, 0.0) if near is None else (_square_off(up, near), _square_off(down, near))
        elbow = _chosen_elbow(*off, 0.0 if wish is None else wish, inside_up, inside_down)
        if type(elbow) is float:
            return elbow, up if elbow > 0.0 else down
        return elbow, np.where(elbow > 0.0, up, down)

    def _branch(self, elbow: Any) -> tuple[Any, Any]:
        """Joints of one branch, and 1 where they are within the limits, else 0."""
        if self._plain:
            return self._plain_branch(elbow), 1.0
        links, chain = self._links, self._chain
        rest = self._near(0) + chain.bends[0]
        given = (self._x, self._y, elbow, links.l1, links.l2, links.inner, self._goal.tolerance, rest)
        if not self._goal.lead:
            return self._joints(*_two_link_turns(*given))
        table = memory.empty((2, len(self._x)))
        _two_link_turns.into((table[0], table[1]), *given)
        return self._joints(*table)

    def _plain_branch(self, elbow: Any) -> np.ndarray:
        """The closed form's own angles; on the way the goal comes to own its targets."""
        goal, links = self._goal, self._links
        table: np.ndarray = memory.empty((4, len(self._x)))
        axis = goal.tolerance * goal.tolerance if links.inner <= goal.tolerance else -1.0
        numbers = _two_link_row.into(tuple(table), self._x, self._y, links.l1, links.l2, elbow, axis)
        if not goal.owned:
            goal.hold(table[0], table[1], finite=numbers)  # joints of what is not finite are NaN
            self._x, self._y = goal.x, goal.y
        return table[2:]

    def _joints(self, first: Any, second: Any) -> tuple[Any, Any]:
        """From the turn of the first link against the base, and of the second against the first."""
        chain, lean = self._chain, self._links.lean
        turns = [first, second] if self._heading is None else [first, second, self._heading - first - second]
        before = [0.0, first, first + second] if chain.angles == "absolute" else [0.0, 0.0, 0.0]
        bends = [chain.bends[0], chain.bends[1] + lean, *chain.bends[2:]]
        given = [(turn, before[i], bends[i], self._near(i)) for i, turn in enumerate(turns)]
        if chain.limits is None:
            joints, inside = [_joint_near(*row) for row in given], 1.0
        else:
            pairs = [_joint_within(*row, *limit) for row, limit in zip(given, self._bounds, strict=True)]
            joints, inside = [q for q, _ in pairs], math.prod(fine for _, fine in pairs)
        return (np.stack(joints) if self._goal.lead else joints), inside

    @property
    def _bounds(self) -> list[tuple[float, float]]:
        """Limits as finite numbers."""
        return [(max(low, -ENDLESS), min(high, ENDLESS)) for low, high in self._chain.limits]

    def _near(self, i: int) -> Any:
        """What joint i comes nearest to: the wish, brought within the limits."""
        near = 0.0 if self._goal.near is None else self._goal.near[i]
        if self._chain.limits is None:
            return near
        lower, upper = self._chain.limits[i]
        return min(max(near, lower), upper) if type(near) is float else np.clip(near, lower, upper)


def _square_off(joints: Any, near: Any) -> Any:
    """Square of the distance of joints from others."""
    return sum((q - p) * (q - p) for q, p in zip(joints, near, strict=True))


def wind(chain: Chain, q: np.ndarray, near: np.ndarray) -> np.ndarray:
    """The revolute joints with whole turns added: within the limits where one fits, then nearest to ``near``."""
    if chain.limits is None:
        turned = np.asarray(_turn_near(q, near))
    else:
        turned = np.asarray(_turn_within(q, near, chain.lower, chain.upper))
    return turned if "P" not in chain.joints else np.where(np.array(list(chain.joints)) == "R", turned, q)


def joints_of_turns(chain: Chain, turns: list[Any]) -> np.ndarray:
    """Joints of revolute links from the turn of each against the one before, shape (..., n)."""
    parts = np.stack(np.broadcast_arrays(*turns), axis=-1)
    parts = np.cumsum(parts, axis=-1) if chain.angles == "absolute" else parts
    return np.asarray(parts - np.array(chain.bends))


def elbow_of(chain: Chain, q: np.ndarray) -> Any:
    """Sign of the sine at the elbow, +1 where it is 0: relative to the line to the tool for a two-link arm."""
    lean = tool_lever(chain)[1] if chain.n == 2 else 0.0
    parts = q + np.array(chain.bends)
    turn = parts[..., 1] - (parts[..., 0] if chain.angles == "absolute" else 0.0) + lean
    return np.where(np.sin(turn) < 0.0, -1, 1)
