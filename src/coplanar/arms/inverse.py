"""Which inverse serves which arm, and which branch serves which row."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.arms import closed, geometry, limited, numerical
from coplanar.arms.chain import Chain
from coplanar.arms.solution import Reach, Solution
from coplanar.checks import ArrayLike
from coplanar.errors import InvalidValue, UnknownName
from coplanar.se2 import Pose
from coplanar.solving import Report, Status, code_of

METHODS = ("auto", "closed", "numerical")

_CODE = {kind: code_of(kind) for kind in Reach}


@dataclass(frozen=True, slots=True)
class Goal:
    """Targets as rows.

    Attributes:
        lead: Their leading shape.
        points: World positions, shape (k, 2) [m].
        headings: Of the tool, shape (k,); None where only positions are asked for.
        near: Joints to come nearest to, shape (k, n); None where the caller has no wish.
        elbow: Wanted branch, shape (k,); None likewise.
        tolerance: What counts as reached [m].
    """

    lead: tuple[int, ...]
    points: np.ndarray
    headings: np.ndarray | None
    near: np.ndarray | None
    elbow: np.ndarray | None
    tolerance: float

    @classmethod
    def of(cls, chain: Chain, target: Any, near: Any, elbow: Any, tolerance: float) -> Goal:
        """Checked, broadcast, flattened."""
        pose = isinstance(target, Pose)
        remedy = "pass a Pose where the tool's heading matters"
        points = target.position if pose else checks.vector("target", target, 2, remedy=remedy)
        wishes = {"target": np.asarray(points)[..., 0]}
        if near is not None:
            near = np.asarray(chain.checked_joints("near", near))
            wishes["near"] = near[..., 0]
        if elbow is not None:
            elbow = np.asarray(checks.real("elbow", elbow))
            if not np.isin(elbow, closed.ELBOWS).all():
                raise InvalidValue("elbow", elbow, "+1 or -1, the sign of the sine at the elbow")
            wishes["elbow"] = elbow
        lead = checks.broadcast(**wishes)

        def rows(array: Any, *last: int) -> np.ndarray:
            return np.broadcast_to(np.asarray(array), (*lead, *last)).reshape(-1, *last)

        return cls(
            lead,
            rows(points, 2),
            rows(target.theta) if pose else None,
            None if near is None else rows(near, chain.n),
            None if elbow is None else rows(elbow),
            checks.not_negative("tolerance", tolerance),
        )

    @property
    def aims(self) -> np.ndarray:
        """Positions, with the headings where they matter, shape (k, 2) or (k, 3)."""
        return self.points if self.headings is None else np.column_stack((self.points, self.headings))


@dataclass(slots=True)
class Answer:
    """The columns of a solution while they are filled."""

    q: np.ndarray
    branches: np.ndarray
    allowed: np.ndarray
    elbow: np.ndarray
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
    checks.choice("method", method, METHODS)
    goal = Goal.of(chain, target, near, elbow, tolerance)
    in_closed_form = closed.has_closed_form(chain, goal.headings is not None)
    if method == "closed" and not in_closed_form:
        raise UnknownName("method", f"closed (for {chain.joints})", ("numerical", "auto"))
    if in_closed_form and method != "numerical":
        answer = _closed(chain, goal, iterations)
    else:
        answer = _numerical(chain, goal, iterations)
    return _solution(chain, goal, answer)


def _closed(chain: Chain, goal: Goal, iterations: int) -> Answer:
    triangle = closed.triangle_of(chain, goal.points, goal.headings)
    near = np.zeros((len(goal.points), chain.n)) if goal.near is None else goal.near
    near = np.clip(near, chain.lower, chain.upper)
    gap = np.asarray(triangle.gap())
    on_axis = (triangle.radius <= goal.tolerance) & (gap <= goal.tolerance)
    free = on_axis | (triangle.radius == 0.0)
    branches, allowed = closed.branches_of(chain, triangle, near, free)
    pick = _nearest_branch(goal, branches, allowed)
    q = np.take_along_axis(branches, pick[:, None, None], axis=1)[:, 0]
    code = np.where(triangle.radius > triangle.l1 + triangle.l2, _CODE[Reach.TOO_FAR], _CODE[Reach.TOO_CLOSE])
    code[gap <= goal.tolerance] = _CODE[Reach.REACHED]
    code[on_axis] = _CODE[Reach.FIRST_JOINT_FREE]
    answer = Answer(q, branches, allowed, 1 - 2 * pick, code, gap, np.zeros(len(q), dtype=int), Report())
    outside = np.flatnonzero(~allowed.any(axis=1))
    if outside.size:
        _within_limits(chain, goal, answer, outside, near, iterations)
    return answer


def _nearest_branch(goal: Goal, branches: np.ndarray, allowed: np.ndarray) -> np.ndarray:
    """Index of the allowed branch that was asked for, else of the nearest, else of the first."""
    if goal.near is None:
        cost = np.broadcast_to(np.array([0.0, 1.0]), allowed.shape).copy()
    else:
        cost = ((branches - goal.near[:, None, :]) ** 2).sum(axis=-1)
    if goal.elbow is not None:
        cost[goal.elbow[:, None] != np.array(closed.ELBOWS)] += 1e100
    return np.asarray(np.where(allowed, cost, np.inf).argmin(axis=1))


def _within_limits(
    chain: Chain, goal: Goal, answer: Answer, rows: np.ndarray, near: np.ndarray, iterations: int
) -> None:
    """Rows none of whose branches is allowed: the nearest point within the limits."""
    if goal.headings is None:
        triangle = closed.triangle_of(chain, goal.points[rows], None)
        q, distance = limited.nearest_on_edges(chain, triangle, near[rows])
        code = np.where(distance <= goal.tolerance, _CODE[Reach.REACHED], _CODE[Reach.OUTSIDE_LIMITS])
        gap, used = np.where(distance <= goal.tolerance, 0.0, distance), np.zeros(len(rows), dtype=int)
    else:
        start = np.clip(answer.q[rows], chain.lower, chain.upper)
        part = Goal((len(rows),), goal.points[rows], goal.headings[rows], start, None, goal.tolerance)
        found = _numerical(chain, part, iterations)
        q, code, gap, used = found.q, found.code, found.gap, found.iterations
    answer.q[rows], answer.code[rows], answer.gap[rows], answer.iterations[rows] = q, code, gap, used
    answer.elbow[rows] = closed.elbow_of(chain, q)


def _numerical(chain: Chain, goal: Goal, iterations: int) -> Answer:
    """The ring decides where it can; the rest is searched."""
    k, n = len(goal.points), chain.n
    near = np.zeros((k, n)) if goal.near is None else goal.near
    q, code, gap = near.copy(), np.zeros(k, dtype=int), np.zeros(k)
    if geometry.turns_freely(chain) and n >= (1 if goal.headings is None else 3):
        gap, beyond, joints = numerical.stretched(chain, goal.aims)
        code = np.where(beyond, _CODE[Reach.TOO_FAR], _CODE[Reach.TOO_CLOSE])
        q = closed.wind(chain, joints, near)
    within = np.flatnonzero(gap <= goal.tolerance)
    used, report = np.zeros(k, dtype=int), Report()
    if within.size:
        found = _search(chain, goal, within, iterations)
        q[within], used[within], report = found.q, found.iterations, found.report
        code[within], gap[within] = _outcome(chain, goal, within, found)
    allowed = np.ones((k, 1), dtype=bool)
    return Answer(q, q[:, None, :].copy(), allowed, np.zeros(k, dtype=int), code, gap, used, report)


def _search(chain: Chain, goal: Goal, rows: np.ndarray, iterations: int) -> numerical.Found:
    near = None if goal.near is None else goal.near[rows]
    return numerical.search(
        chain, goal.aims[rows], near, tolerance=goal.tolerance, iterations=iterations, single=not goal.lead
    )


def _outcome(chain: Chain, goal: Goal, rows: np.ndarray, found: numerical.Found) -> tuple[np.ndarray, np.ndarray]:
    """Status and gap of the rows that were searched."""
    q, reached = found.q, found.miss <= goal.tolerance
    held = ((q <= chain.lower) | (q >= chain.upper)).any(axis=1)
    code = np.where(held, _CODE[Reach.STOPPED_BY_LIMITS], _CODE[Reach.STALLED])
    code[found.code == code_of(Status.BUDGET_SPENT)] = _CODE[Reach.BUDGET_SPENT]
    code[reached] = _CODE[Reach.REACHED]
    distance = np.hypot(*(chain.forward(q).position - goal.points[rows]).T)
    return code, np.where(reached, 0.0, distance)


def _solution(chain: Chain, goal: Goal, answer: Answer) -> Solution:
    lead = goal.lead

    def shaped(column: np.ndarray) -> Any:
        return column.reshape(lead + column.shape[1:]) if lead or column.ndim > 1 else column[0].item()

    return Solution(
        chain,
        target=shaped(goal.points),
        heading=None if goal.headings is None else shaped(goal.headings),
        q=shaped(answer.q),
        branches=shaped(answer.branches),
        allowed=shaped(answer.allowed),
        elbow=shaped(answer.elbow),
        code=shaped(answer.code),
        gap=shaped(answer.gap),
        iterations=shaped(answer.iterations),
        report=answer.report,
    )
