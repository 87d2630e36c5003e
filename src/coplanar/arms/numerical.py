"""Joints by damped least squares, for arms without a closed form; where the ring decides, exactly all the same."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar.arms import geometry
from coplanar.arms.chain import Chain
from coplanar.arms.closed import joints_of_turns, wind
from coplanar.engine import evaluator
from coplanar.laws import arms as laws
from coplanar.laws import se2
from coplanar.solving import LeastSquaresResult, Report, least_squares

BENDS = (0.5, -0.5, 1.5, -1.5, 2.5)  # [rad] postures to start from, one attempt each: bent this much at every joint
SPREAD = 10  # more attempts where joints are limited, spread over the limits by irrational steps
LONGEST_STEP = 1.0  # [rad, m] a joint step for which the linear model still says something

_ring_gap = evaluator(laws.ring_gap)
_wrap = evaluator(se2.wrap)
_wrist = evaluator(laws.wrist)


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
    """Residual and Jacobian of a position or pose, in metres: a heading counts by the length of the arm."""

    def __init__(self, chain: Chain, with_heading: bool) -> None:
        self.chain = chain
        self.name = "pose" if with_heading else "position"
        length = float(sum(chain.links))
        self.scale = np.array([1.0, 1.0, length if length > 0.0 else 1.0][: 3 if with_heading else 2])

    def residual(self, q: np.ndarray, target: np.ndarray) -> np.ndarray:
        """Tool less target, shape (..., m)."""
        tool = self.chain.forward(q).as_array()[..., : len(self.scale)]
        error = tool - target
        if len(self.scale) == 3:
            error[..., 2] = _wrap(error[..., 2])
        return np.asarray(error * self.scale)

    def jacobian(self, q: np.ndarray, target: np.ndarray) -> np.ndarray:  # noqa: ARG002
        """Of the residual, shape (..., m, n)."""
        return np.asarray(self.chain.jacobian(q, task=self.name) * self.scale[:, None])


def search(
    chain: Chain,
    target: np.ndarray,
    near: np.ndarray | None,
    *,
    tolerance: float,
    iterations: int,
    single: bool,
) -> Found:
    """The joints nearest to every target, shape (k, 2) or (k, 3), from ``near`` or from postures of its own."""
    task = Task(chain, target.shape[-1] == 3)
    starts = _starts(chain, target, near)
    found = _attempt(task, next(starts), target, tolerance, iterations, single)
    for start in starts:
        missed = found.miss > tolerance
        if not missed.any():
            break
        answer = _attempt(task, start[missed], target[missed], tolerance, iterations, single)
        found = _better(found, answer, missed)
    return found


def _starts(chain: Chain, target: np.ndarray, near: np.ndarray | None) -> Iterator[np.ndarray]:
    """Where each attempt begins: at ``near``, bent, and for limited arms spread over the limits, shape (k, n)."""
    if near is not None:
        yield near
    for bend in BENDS:
        yield bent(chain, target, bend)
    if chain.limits is not None:
        lower = np.where(np.isfinite(chain.lower), chain.lower, -np.pi)
        upper = np.where(np.isfinite(chain.upper), chain.upper, np.pi)
        for i in range(1, SPREAD + 1):
            part = (i * np.sqrt([2.0, 3.0, 5.0, 7.0, 11.0, 13.0])[np.arange(chain.n) % 6] + 0.1 * chain.n) % 1.0
            yield np.broadcast_to(lower + part * (upper - lower), (len(target), chain.n))


def _attempt(
    task: Task, start: np.ndarray, target: np.ndarray, tolerance: float, iterations: int, single: bool
) -> Found:
    chain = task.chain
    result: LeastSquaresResult = least_squares(
        task.residual,
        start[0] if single else start,
        jacobian=task.jacobian,
        parameters=(target[0] if single else target,),
        bounds=(chain.lower, chain.upper),
        tolerance=tolerance,
        longest_step=LONGEST_STEP,
        iterations=iterations,
    )
    q = np.atleast_2d(result.x)
    q = wind(chain, q, start) if chain.limits is None else q
    miss, code, used = (np.atleast_1d(v) for v in (result.residual(), result.code, result.iterations))
    return Found(q, miss, code, used, result.report)


def _better(old: Found, new: Found, rows: np.ndarray) -> Found:
    """The old answers, with those rows overwritten that came nearer."""
    place = np.flatnonzero(rows)
    nearer = new.miss < old.miss[place]
    taken = place[nearer]
    fields = [(old.q, new.q), (old.miss, new.miss), (old.code, new.code), (old.iterations, new.iterations)]
    for column, fresh in fields:
        column[taken] = fresh[nearer]
    return Found(old.q, old.miss, old.code, old.iterations, new.report if nearer.any() else old.report)


def bent(chain: Chain, target: np.ndarray, bend: float) -> np.ndarray:
    """A posture with every joint after the first at ``bend``, turned so that the tool lies towards the target."""
    turning = np.array(list(chain.joints)) == "R"
    inside = np.clip(0.0, chain.lower, chain.upper)
    turns = np.where(turning, bend, 0.0)
    turns[np.flatnonzero(turning)[:1]] = 0.0
    shape = np.cumsum(turns) if chain.angles == "absolute" else turns
    q = np.broadcast_to(np.where(turning, shape, inside), (len(target), chain.n)).copy()
    x, y = chain.base.act_inverse(target[:, 0], target[:, 1])
    tip = chain.base.inverse() @ chain.forward(q[:1]).position
    swing = np.arctan2(y, x) - np.arctan2(tip[:, 1], tip[:, 0])
    turned = turning if chain.angles == "absolute" else turning & (np.cumsum(turning) == 1)
    return np.asarray(np.clip(wind(chain, np.where(turned, q + swing[:, None], q), inside), chain.lower, chain.upper))


def stretched(chain: Chain, target: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """For freely turning arms: gap to the ring, whether beyond it, and the joints that point at the target.

    With a heading the last link is placed first, and the ring is that of the links before it.

    Args:
        chain: An arm that ``geometry.turns_freely``, of two links or more where the target has a heading.
        target: Shape (k, 2) or (k, 3).

    Returns:
        Gap [m], whether the target is beyond the outer ring, joints of shape (k, n).
    """
    x, y = chain.base.act_inverse(target[:, 0], target[:, 1])
    lengths, leans = list(geometry.levers(chain)), [0.0] * (chain.n - 1) + [geometry.tool_lever(chain)[1]]
    headings: list[Any] = []
    if target.shape[-1] == 3:
        headings = [target[:, 2] - chain.base.theta - chain.tool.theta]
        x, y = _wrist(x, y, headings[0], chain.links[-1] + chain.tool.x, chain.tool.y)
        lengths, leans = lengths[:-1], leans[:-1]
    inner, outer = geometry.ring(tuple(lengths))
    beyond = np.hypot(x, y) > outer
    towards, longest = np.arctan2(y, x), int(np.argmax(lengths))
    directions = [
        np.where(beyond | (i == longest), towards, towards + np.pi) - lean for i, lean in enumerate(leans)
    ] + headings
    turns = [b - a for a, b in zip([0.0, *directions[:-1]], directions, strict=True)]
    return np.asarray(_ring_gap(x, y, inner, outer)), beyond, joints_of_turns(chain, turns)
