"""What an inverse answers: joints, branches, how far off, and why."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np

from coplanar.arms.chain import Chain
from coplanar.engine import evaluator
from coplanar.errors import NoSolution
from coplanar.laws import se2
from coplanar.solving import Report, code_of, count_by_status, status_of

_wrap = evaluator(se2.wrap)


class Reach(Enum):
    """How the tool stands to the target."""

    REACHED = "the tool is at the target"
    FIRST_JOINT_FREE = "the tool is at the target, and the first joint is free: the target is on its axis"
    TOO_FAR = "the target is beyond the outer ring: the arm is stretched towards it, at the nearest point"
    TOO_CLOSE = "the target is inside the inner ring: the arm is folded towards it, at the nearest point"
    OUTSIDE_LIMITS = "the joint limits keep the tool away: this is the nearest point within them"
    STOPPED_BY_LIMITS = "the joint limits stopped the search: the nearest point that it found, which may be a local one"
    STALLED = "no small motion comes nearer: the nearest point that the search found, which may be a local one"
    BUDGET_SPENT = "the iterations are spent: the best point so far"


@dataclass(frozen=True, slots=True)
class Solution:
    """The answer of ``Arm.inverse``; the leading axes are those of the targets.

    Attributes:
        chain: The arm.
        target: Wanted position of the tool in the world, shape (..., 2) [m].
        heading: Wanted heading of the tool [rad], shape (...); None where only a position was asked for.
        q: Chosen joints, shape (..., n).
        branches: Every branch, shape (..., b, n): the elbow's +1 then -1 in closed form, ``q`` alone otherwise. Whole
            turns are added to come nearest to ``near``, or within the limits.
        allowed: Which branches are within the limits, shape (..., b).
        elbow: Sign of the sine at the elbow of ``q``, an int or an array; 0 where there is no closed form.
        code: Place of the status in ``Reach``, an int or an array of them.
        gap: Distance from the target to the nearest point found; 0 where it is reached, but for a target that was
            taken for reached within the tolerance [m].
        iterations: Of the numerical search; 0 for a closed form.
        report: Every iteration of a single numerical search.
    """

    chain: Chain
    target: np.ndarray
    heading: Any
    q: np.ndarray
    branches: np.ndarray
    allowed: np.ndarray
    elbow: Any
    code: Any
    gap: Any
    iterations: Any
    report: Report

    @property
    def status(self) -> Any:
        """A ``Reach``, or an object array of them for a batch."""
        return status_of(Reach, self.code)

    @property
    def reached(self) -> Any:
        """Whether the tool is at the target to within the tolerance; an array of bool for a batch."""
        return self.code <= code_of(Reach.FIRST_JOINT_FREE)

    @property
    def nearest(self) -> np.ndarray:
        """Where the tool is at ``q``: the target, or the nearest point to it, shape (..., 2) [m]."""
        return self.chain.forward(self.q).position

    def position_error(self) -> Any:
        """Distance from the tool at ``q`` to the target, computed anew [m]."""
        offset = self.nearest - self.target
        return _plain(np.hypot(offset[..., 0], offset[..., 1]))

    def heading_error(self) -> Any:
        """Heading of the tool at ``q`` less the wanted one, in (-pi, pi]; 0 where none was asked for [rad]."""
        if self.heading is None:
            return _plain(np.zeros(self.q.shape[:-1]))
        return _wrap(self.chain.forward(self.q).theta - self.heading)

    def singular_value(self) -> Any:
        """Smallest singular value of the task's Jacobian at ``q`` [m/rad].

        A millimetre in the target is up to 1e-3/value radians in the joints; 0 where the branches meet.
        """
        return _plain(self._singular_values()[..., -1])

    def conditioning(self) -> Any:
        """Smallest over largest singular value of the task's Jacobian at ``q``: 1 is best, 0 singular."""
        values = self._singular_values()
        return _plain(values[..., -1] / np.where(values[..., 0] > 0.0, values[..., 0], 1.0))

    def _singular_values(self) -> np.ndarray:
        task = "position" if self.heading is None else "pose"
        values: np.ndarray = np.linalg.svd(self.chain.jacobian(self.q, task=task), compute_uv=False)
        return values

    def or_raise(self) -> Solution:
        """This answer if every target is reached.

        Raises:
            NoSolution: With the sentence, the largest gap and this answer, if one is not.
        """
        if not np.all(self.reached):
            raise NoSolution(self.sentence(), self)
        return self

    def sentence(self) -> str:
        """The status, the gap and the conditioning in one line; the counts of each status for a batch."""
        text = count_by_status(Reach, self.code)
        largest, least = np.max(self.gap, initial=0.0), np.min(self.conditioning(), initial=1.0)
        return f"{text}; gap {largest:.3g} m, smallest over largest singular value {least:.3g}"


def _plain(value: Any) -> Any:
    return float(value) if np.ndim(value) == 0 else value
