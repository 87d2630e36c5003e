"""Closed forms: two revolute joints for a position, three for a pose, both branches of each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar.arms import geometry
from coplanar.arms.chain import Chain
from coplanar.engine import evaluator
from coplanar.laws import arms as laws

ELBOWS = (1, -1)  # the order of the branches

_ring_gap = evaluator(laws.ring_gap)
_turn_near = evaluator(laws.turn_near)
_turn_within = evaluator(laws.turn_within)
_two_link_inverse = evaluator(laws.two_link_inverse)
_wrist = evaluator(laws.wrist)


@dataclass(frozen=True, slots=True)
class Triangle:
    """The two links that a closed form solves, and their target from the base.

    Attributes:
        x: Target of the second link's end in the base frame, shape (k,) [m].
        y: Likewise.
        l1: First link [m].
        l2: Second link, or the line from the second joint to the tool [m].
        lean: Angle from the second link to that line [rad].
        heading: Direction of the third link in the base frame [rad], shape (k,); None without one.
    """

    x: Any
    y: Any
    l1: float
    l2: float
    lean: float
    heading: Any

    @property
    def radius(self) -> Any:
        """Distance of the target from the base, shape (k,) [m]."""
        return np.hypot(self.x, self.y)

    def gap(self) -> Any:
        """Distance of the target from the ring that the two links reach, shape (k,) [m]."""
        return one_row(_ring_gap, self.x, self.y, *geometry.ring((self.l1, self.l2)))


def one_row(law: Any, *args: Any) -> Any:
    """The law on columns; a single row goes by floats, which is ten times faster there."""
    if len(args[0]) != 1:
        return law(*args)
    answer = law(*(float(a) if type(a) is float else a.item() for a in args))
    return tuple(np.array([a]) for a in answer) if isinstance(answer, tuple) else np.array([answer])


def has_closed_form(chain: Chain, with_heading: bool) -> bool:
    """Whether ``triangle_of`` holds: RR and a position, RRR and a pose."""
    return bool(chain.joints == ("RRR" if with_heading else "RR"))


def triangle_of(chain: Chain, points: np.ndarray, headings: np.ndarray | None) -> Triangle:
    """The triangle of base, elbow and wrist for world targets, shape (k, 2)."""
    x, y = chain.base.act_inverse(points[:, 0], points[:, 1])
    if headings is None:
        lever, lean = geometry.tool_lever(chain)
        return Triangle(x, y, chain.links[0], lever, lean, None)
    heading = headings - chain.base.theta - chain.tool.theta
    x, y = _wrist(x, y, heading, chain.links[-1] + chain.tool.x, chain.tool.y)
    return Triangle(x, y, chain.links[0], chain.links[1], 0.0, heading)


def branches_of(chain: Chain, triangle: Triangle, near: np.ndarray, free: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Joints of both branches, shape (k, 2, n), and which are within the limits, shape (k, 2).

    Args:
        chain: The arm.
        triangle: What to solve.
        near: Joints to come nearest to, shape (k, n).
        free: Where the first joint is free and keeps its value in ``near``, shape (k,).
    """
    both = [_joints(chain, triangle, elbow, near[:, 0], free) for elbow in ELBOWS]
    q = wind(chain, np.stack(both, axis=1), near[:, None, :])
    return q, np.asarray(((q >= chain.lower) & (q <= chain.upper)).all(axis=-1))


def wind(chain: Chain, q: np.ndarray, near: np.ndarray) -> np.ndarray:
    """The revolute joints with whole turns added: within the limits where one fits, then nearest to ``near``."""
    if chain.limits is None:
        turned = np.asarray(_turn_near(q, near))
    else:
        turned = np.asarray(_turn_within(q, near, chain.lower, chain.upper))
    return np.where(np.array(list(chain.joints)) == "R", turned, q)


def _joints(chain: Chain, triangle: Triangle, elbow: int, near: np.ndarray, free: np.ndarray) -> np.ndarray:
    first, second = one_row(_two_link_inverse, triangle.x, triangle.y, triangle.l1, triangle.l2, float(elbow))
    first = np.where(free, near + chain.bends[0], first)
    turns = [first, second - triangle.lean]
    if triangle.heading is not None:
        turns.append(triangle.heading - first - second)
    return joints_of_turns(chain, turns)


def joints_of_turns(chain: Chain, turns: list[Any]) -> np.ndarray:
    """Joints of revolute links from the turn of each against the one before, shape (..., n)."""
    parts = np.stack(np.broadcast_arrays(*turns), axis=-1)
    parts = np.cumsum(parts, axis=-1) if chain.angles == "absolute" else parts
    return np.asarray(parts - np.array(chain.bends))


def elbow_of(chain: Chain, q: np.ndarray) -> Any:
    """Sign of the sine at the elbow, +1 where it is 0: relative to the line to the tool for a two-link arm."""
    lean = geometry.tool_lever(chain)[1] if chain.n == 2 else 0.0
    parts = q + np.array(chain.bends)
    turn = parts[..., 1] - (parts[..., 0] if chain.angles == "absolute" else 0.0) + lean
    return np.where(np.sin(turn) < 0.0, -1, 1)
