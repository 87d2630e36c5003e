"""Joints by damped least squares, for arms without a closed form; where the ring decides, exactly all the same."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar.arms import geometry
from coplanar.arms.chain import Chain
from coplanar.arms.closed import joints_of_turns, wind
from coplanar.arms.posture import linkage
from coplanar.engine import components, evaluator, stack
from coplanar.laws import arms as laws
from coplanar.solving import LeastSquaresResult, Report, Status, code_of, least_squares

BENDS = (0.5, -0.5, 1.5, -1.5, 2.5)  # [rad] postures to start from, one attempt each: bent this much at every joint
SPREAD = 10  # more attempts where joints are limited, spread over the limits by irrational steps
DAMPING = 0.1  # of the first step, lambda/|F|^2
LEAST_STEP = 1e-14  # beside 1 + |q|: a search whose steps are shorter has stalled
LONGEST_STEP = 1.0  # [rad, m] a joint step for which the linear model still says something

_ring_gap = evaluator(laws.ring_gap)
_task_error = evaluator(laws.task_error)
_turn_near = evaluator(laws.turn_near)
_turn_within = evaluator(laws.turn_within)
_wrist = evaluator(laws.wrist)
_STATUS_OF_LOOPS = np.array(
    [code_of(s) for s in (Status.BUDGET_SPENT, Status.CONVERGED, Status.STALLED, Status.NOT_FINITE)]
)  # in the order of ``engine.compiled.searches``


@dataclass(frozen=True, slots=True)
class Found:
    """What the search found for every row.

    Attributes:
        q: Shape (k, n).
        miss: Norm of the residual, a heading counted by the arm's length, shape (k,) [m].
        code: Of ``coplanar.solving.Status``, shape (k,).
        iterations: Of the attempt that was kept, shape (k,).
        report: For a single row.
    """

    q: np.ndarray
    miss: np.ndarray
    code: np.ndarray
    iterations: np.ndarray
    report: Report


class Task:
    """Error of a position or pose, and its Jacobian, in metres: a heading counts by the length of the arm."""

    def __init__(self, chain: Chain, rows: int) -> None:
        self.chain = chain
        self.name = "pose" if rows == 3 else "position"
        length = float(sum(chain.links))
        self.weight = 0.0 if rows == 2 else (length if length > 0.0 else 1.0)
        self.scale = np.array([1.0, 1.0, self.weight][:rows])

    def residual(self, q: np.ndarray, target: np.ndarray) -> np.ndarray:
        """Tool less target, shape (..., m)."""
        x, y, *heading = components(target)
        error = _task_error(*self.chain.forward(q).parts, x, y, heading[0] if heading else 0.0, self.weight)
        return np.asarray(stack(error[: len(self.scale)]))

    def jacobian(self, q: np.ndarray, target: np.ndarray) -> np.ndarray:  # noqa: ARG002
        """Of the residual, shape (..., m, n)."""
        return np.asarray(self.chain.jacobian(q, task=self.name) * self.scale[:, None])


def search(
    chain: Chain, aims: np.ndarray, near: np.ndarray | None, *, tolerance: float, iterations: int, single: bool
) -> Found:
    """The joints nearest to every target, shape (2, k) or (3, k), from ``near`` or from postures of its own."""
    task = Task(chain, len(aims))
    starts = _starts(chain, aims, near)
    found = _attempt(task, next(starts), aims, tolerance, iterations, single)
    while (missed := np.flatnonzero(found.miss > tolerance)).size:
        start = next(starts, None)
        if start is None:
            break
        answer = _attempt(task, start[missed], aims[:, missed], tolerance, iterations, single)
        found = _better(found, answer, missed)
    return found


def _starts(chain: Chain, aims: np.ndarray, near: np.ndarray | None) -> Iterator[np.ndarray]:
    """Where each attempt begins: at ``near``, bent, and for limited arms spread over the limits, shape (k, n)."""
    if near is not None:
        yield near
    for bend in BENDS:
        yield bent(chain, aims, bend)
    if chain.limits is not None:
        lower = np.where(np.isfinite(chain.lower), chain.lower, -np.pi)
        upper = np.where(np.isfinite(chain.upper), chain.upper, np.pi)
        for i in range(1, SPREAD + 1):
            part = (i * np.sqrt([2.0, 3.0, 5.0, 7.0, 11.0, 13.0])[np.arange(chain.n) % 6] + 0.1 * chain.n) % 1.0
            yield np.broadcast_to(lower + part * (upper - lower), (aims.shape[1], chain.n))


def _attempt(task: Task, start: np.ndarray, aims: np.ndarray, tolerance: float, iterations: int, single: bool) -> Found:
    chain = task.chain
    compiled = not single and chain.n >= len(aims) and linkage.pays("search", len(start))
    q, miss, code, used, report = (_by_loops if compiled else _by_rows)(
        task, start, aims, tolerance, iterations, single
    )
    return Found(wind(chain, q, start) if chain.limits is None else q, miss, code, used, report)


def _by_loops(
    task: Task, start: np.ndarray, aims: np.ndarray, tolerance: float, iterations: int, _single: bool
) -> tuple[Any, ...]:
    """All rows by the compiled loop."""
    chain = task.chain
    q, code, used, miss = linkage.search(
        chain.plan.table,
        start,
        aims,
        bounds=np.array([chain.lower, chain.upper]),
        settings=(tolerance, LEAST_STEP, DAMPING, LONGEST_STEP, task.weight),
        budget=iterations,
    )
    return q, miss, _STATUS_OF_LOOPS[code], used, Report()


def _by_rows(
    task: Task, start: np.ndarray, aims: np.ndarray, tolerance: float, iterations: int, single: bool
) -> tuple[Any, ...]:
    """All rows by NumPy; a single one with a report of its iterations."""
    result: LeastSquaresResult = least_squares(
        task.residual,
        start[0] if single else start,
        jacobian=task.jacobian,
        parameters=(aims[:, 0] if single else aims.T,),
        bounds=(task.chain.lower, task.chain.upper),
        tolerance=tolerance,
        step_tolerance=LEAST_STEP,
        damping=DAMPING,
        longest_step=LONGEST_STEP,
        iterations=iterations,
    )
    miss, code, used = (np.atleast_1d(v) for v in (result.residual(), result.code, result.iterations))
    return np.atleast_2d(result.x), miss, code, used, result.report


def _better(old: Found, new: Found, rows: np.ndarray) -> Found:
    """The old answers, with those of the rows overwritten that came nearer."""
    nearer = new.miss < old.miss[rows]
    taken = rows[nearer]
    fields = [(old.q, new.q), (old.miss, new.miss), (old.code, new.code), (old.iterations, new.iterations)]
    for column, fresh in fields:
        column[taken] = fresh[nearer]
    return Found(old.q, old.miss, old.code, old.iterations, new.report if nearer.any() else old.report)


def bent(chain: Chain, aims: np.ndarray, bend: float) -> np.ndarray:
    """A posture with every joint after the first at ``bend``, turned so that the tool lies towards the target."""
    turning = np.array(list(chain.joints)) == "R"
    inside = np.clip(0.0, chain.lower, chain.upper)
    turns = np.where(turning, bend, 0.0)
    turns[np.flatnonzero(turning)[:1]] = 0.0
    posture = np.where(turning, np.cumsum(turns) if chain.angles == "absolute" else turns, inside)
    x, y = _from_base(chain, aims)
    tip_x, tip_y = chain.base.inverse() @ chain.forward(posture).position
    swing = np.arctan2(y, x) - math.atan2(tip_y, tip_x)
    turned = turning if chain.angles == "absolute" else turning & (np.cumsum(turning) == 1)
    q = np.empty((len(swing), chain.n))
    q[:] = np.clip(wind(chain, posture, inside), chain.lower, chain.upper)
    for i in np.flatnonzero(turned):
        limits = (-np.inf, np.inf) if chain.limits is None else chain.limits[i]
        q[:, i] = np.clip(_toward(posture[i] + swing, inside[i], *limits), *limits)
    return q


def _toward(angle: np.ndarray, near: float, lower: float, upper: float) -> np.ndarray:
    """Whole turns added as ``wind`` adds them, for one joint."""
    if lower == -np.inf and upper == np.inf:
        return np.asarray(_turn_near(angle, near))
    return np.asarray(_turn_within(angle, near, lower, upper))


def ring_gap(chain: Chain, aims: np.ndarray) -> np.ndarray:
    """For freely turning arms: distance of the targets from the ring; of the wrist's, where they have a heading [m]."""
    x, y, lengths, _ = _reaching(chain, aims)
    return np.asarray(_ring_gap(x, y, *geometry.ring(lengths)))


def stretched(chain: Chain, aims: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """For freely turning arms: whether the targets are beyond the ring, and the joints that point at them.

    With a heading the last link is placed first, and the ring is that of the links before it.

    Args:
        chain: An arm that ``geometry.turns_freely``, of two links or more where the target has a heading.
        aims: Shape (2, k) or (3, k).

    Returns:
        Beyond the outer ring or not, and joints of shape (k, n).
    """
    x, y, lengths, headings = _reaching(chain, aims)
    leans = [0.0] * (chain.n - 1) + [geometry.tool_lever(chain)[1]]
    beyond = np.hypot(x, y) > geometry.ring(lengths)[1]
    towards, longest = np.arctan2(y, x), int(np.argmax(lengths))
    directions = [
        np.where(beyond | (i == longest), towards, towards + np.pi) - lean
        for i, lean in enumerate(leans[: len(lengths)])
    ] + headings
    turns = [b - a for a, b in zip([0.0, *directions[:-1]], directions, strict=True)]
    return beyond, joints_of_turns(chain, turns)


def _reaching(chain: Chain, aims: np.ndarray) -> tuple[Any, Any, tuple[float, ...], list[Any]]:
    """Target of the links that reach in the base frame, their lengths, and the heading of a last one that does not."""
    x, y = _from_base(chain, aims)
    if len(aims) == 2:
        return x, y, geometry.levers(chain), []
    heading = aims[2] - chain.base.theta - chain.tool.theta
    x, y = _wrist(x, y, heading, chain.links[-1] + chain.tool.x, chain.tool.y)
    return x, y, tuple(chain.links[:-1]), [heading]


def _from_base(chain: Chain, aims: np.ndarray) -> tuple[Any, Any]:
    """Positions in the base frame."""
    return (aims[0], aims[1]) if chain.plan.at_origin else chain.base.act_inverse(aims[0], aims[1])
