"""Which inverse serves which arm, and which rows of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.arms import closed, geometry, limited, numerical
from coplanar.arms.chain import Chain
from coplanar.arms.goal import Goal
from coplanar.arms.solution import Reach, Solution
from coplanar.checks import ArrayLike
from coplanar.errors import UnknownName
from coplanar.se2 import Pose
from coplanar.solving import Report, Status, code_of

METHODS = ("auto", "closed", "numerical")

_CODE = {kind: code_of(kind) for kind in Reach}


@dataclass(slots=True, eq=False)
class Answer:
    """The columns of a solution, each an array of k rows: joints of shape (n, k), branches of one or two of them."""

    joints: np.ndarray
    branches: tuple[np.ndarray, ...]
    inside: tuple[Any, ...]
    elbow: Any
    code: np.ndarray
    gap: np.ndarray
    iterations: np.ndarray
    report: Report


def inverse(
    chain: Chain,
    target: ArrayLike | Pose,
    *,
    near: ArrayLike | None = None,
    elbow: ArrayLike | None = None,
    method: str = "auto",
    tolerance: float = 1e-9,
    iterations: int = 100,
) -> Solution:
    """Joints for targets; see ``Arm.inverse``."""
    if method not in METHODS:
        checks.choice("method", method, METHODS)
    goal = Goal.of(chain, target, near, elbow, tolerance)
    links = closed.links_of(chain, goal.heading is not None)
    if method == "closed" and links is None:
        raise UnknownName("method", f"closed (for {chain.joints})", ("numerical", "auto"))
    if links is None or method == "numerical":
        goal.own()
        return Solution(chain, goal, _numerical(chain, goal, iterations))
    if not goal.lead and goal.near is None and chain.plan.plain:
        return Solution(chain, goal, closed.One(chain, goal, links))
    answer = closed.Closed(chain, goal, links)
    if chain.limits is None:
        return Solution(chain, goal, answer)
    return Solution(chain, goal, _within_limits(chain, goal, answer, iterations))


def _within_limits(chain: Chain, goal: Goal, answer: closed.Closed, iterations: int) -> Any:
    """The answer; rows none of whose branches is within the limits have the nearest point that is."""
    up, down = answer.inside
    if type(up) is float and up + down > 0.0:
        return answer
    outside = np.flatnonzero(np.maximum(up, down) == 0.0)
    if not outside.size:
        return answer
    columns = (answer.elbow, answer.code, answer.gap, answer.iterations)
    elbow, code, gap, used = (np.array(c, ndmin=1) for c in columns)
    q = np.array(answer.joints).reshape(chain.n, -1)
    part = goal.rows(outside)
    found = (_on_edges if goal.heading is None else _searched)(chain, part, q[:, outside].T, iterations)
    q[:, outside], code[outside], gap[outside], used[outside] = found
    elbow[outside] = closed.elbow_of(chain, found[0].T)
    return Answer(q, answer.branches, answer.inside, elbow, code, gap, used, Report())


def _on_edges(chain: Chain, goal: Goal, _start: np.ndarray, _iterations: int) -> tuple[Any, ...]:
    """Two links: joints, status and gap of the nearest point on the edges of the limits, exactly."""
    near = np.zeros((len(goal.x), chain.n)) if goal.near is None else np.stack(goal.near, axis=-1)
    triangle = closed.triangle_of(chain, goal.points, None)
    q, distance = limited.nearest_on_edges(chain, triangle, np.clip(near, chain.lower, chain.upper))
    reached = distance <= goal.tolerance
    code = np.where(reached, _CODE[Reach.REACHED], _CODE[Reach.OUTSIDE_LIMITS])
    return q.T, code, np.where(reached, 0.0, distance), np.zeros(len(q))


def _searched(chain: Chain, goal: Goal, start: np.ndarray, iterations: int) -> tuple[Any, ...]:
    """Three links: by the search, from the closed form's joints brought within the limits."""
    goal.near, goal.elbow = list(np.clip(start, chain.lower, chain.upper).T), None
    found = _numerical(chain, goal, iterations)
    return found.joints, found.code, found.gap, found.iterations


def _numerical(chain: Chain, goal: Goal, iterations: int) -> Answer:
    """The ring decides where it can; the rest is searched."""
    aims = np.array(goal.aims).reshape(len(goal.aims), -1)
    near = None if goal.near is None else np.array(goal.near).reshape(chain.n, -1).T.copy()
    k, n = aims.shape[1], chain.n
    q, code, gap, used = np.empty((k, n)), np.zeros(k, dtype=int), np.zeros(k), np.zeros(k, dtype=int)
    if geometry.turns_freely(chain) and n >= (1 if goal.heading is None else 3):
        gap = numerical.ring_gap(chain, aims)
    off, within = np.flatnonzero(gap > goal.tolerance), np.flatnonzero(gap <= goal.tolerance)
    if off.size:
        beyond, joints = numerical.stretched(chain, aims[:, off])
        code[off] = np.where(beyond, _CODE[Reach.TOO_FAR], _CODE[Reach.TOO_CLOSE])
        q[off] = closed.wind(chain, joints, np.zeros(n) if near is None else near[off])
    report = Report()
    if within.size:
        every = len(within) == k
        part, start = (aims, near) if every else (aims[:, within], None if near is None else near[within])
        found = numerical.search(
            chain, part, start, tolerance=goal.tolerance, iterations=iterations, single=not goal.lead
        )
        q[within], used[within], report = found.q, found.iterations, found.report
        code[within], gap[within] = _outcome(chain, part, goal.tolerance, found)
    return Answer(q.T, (q.T,), (np.ones(k),), np.zeros(k), code, gap, used, report)


def _outcome(chain: Chain, aims: np.ndarray, tolerance: float, found: numerical.Found) -> tuple[np.ndarray, np.ndarray]:
    """Status and gap of the rows that were searched."""
    code, gap = np.full(len(found.q), _CODE[Reach.REACHED]), np.zeros(len(found.q))
    missed = np.flatnonzero(found.miss > tolerance)
    if missed.size:
        q = found.q[missed]
        held = ((q <= chain.lower) | (q >= chain.upper)).any(axis=1)
        spent = found.code[missed] == code_of(Status.BUDGET_SPENT)
        why = np.where(held, _CODE[Reach.STOPPED_BY_LIMITS], _CODE[Reach.STALLED])
        code[missed] = np.where(spent, _CODE[Reach.BUDGET_SPENT], why)
        gap[missed] = np.hypot(*(chain.forward(q).position.T - aims[:2, missed]))
    return code, gap
