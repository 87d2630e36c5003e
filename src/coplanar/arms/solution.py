"""What an inverse answers: joints, branches, how far off, and why."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from struct import Struct
from typing import Any

import numpy as np

from coplanar.arms.chain import Chain
from coplanar.arms.closed import One
from coplanar.arms.goal import Goal, shaped
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


_ON_AXIS = code_of(Reach.FIRST_JOINT_FREE)
_REACHES = tuple(Reach)
_FLOAT64 = np.dtype(np.float64)
_pack_two, _pack_four = Struct("2d").pack, Struct("4d").pack  # over bytes an array is read-only, and soonest made


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Solution:
    """The answer of ``Arm.inverse``; the leading axes are those of the targets.

    Branches, status and gap are computed when they are first asked for, and kept; arrays are read-only.

    Attributes:
        chain: The arm.
        goal: What was asked for.
        answer: The columns that the properties show.
    """

    chain: Chain
    goal: Goal
    answer: Any

    def __repr__(self) -> str:
        return f"Solution({count_by_status(Reach, self.code)}; q of shape {self.q.shape})"

    @property
    def target(self) -> np.ndarray:
        """Wanted position of the tool in the world, shape (..., 2) [m]."""
        return self.goal.points

    @property
    def heading(self) -> Any:
        """Wanted heading of the tool [rad], a float or shape (...); None where only a position was asked for."""
        return None if self.goal.heading is None else self._shaped(self.goal.heading)

    @property
    def q(self) -> np.ndarray:
        """Chosen joints, shape (..., n); for a batch a view of columns, joint by joint contiguous."""
        answer = self.answer
        if type(answer) is One:
            return np.ndarray((2,), _FLOAT64, _pack_two(*answer.joints))
        return shaped(self.answer.joints, self.goal.lead)

    @property
    def branches(self) -> np.ndarray:
        """Every branch, shape (..., b, n): the elbow's +1 then -1 in closed form, ``q`` alone otherwise.

        Whole turns are added to come nearest to ``near``, or within the limits.
        """
        answer = self.answer
        if type(answer) is One:
            return np.ndarray((2, 2), _FLOAT64, _pack_four(*answer.angles))
        lead, parts = self.goal.lead, answer.branches
        if not lead:
            branches = np.array(parts).reshape(len(parts), -1)
        else:
            branches = np.stack([shaped(branch, lead) for branch in parts], axis=-2)
        branches.flags.writeable = False
        return branches

    @property
    def allowed(self) -> np.ndarray:
        """Which branches are within the limits, shape (..., b)."""
        lead = self.goal.lead
        return np.stack([np.broadcast_to(self._shaped(part), lead) == 1.0 for part in self.answer.inside], axis=-1)

    @property
    def elbow(self) -> Any:
        """Sign of the sine at the elbow of ``q``, an int or an array; 0 where there is no closed form."""
        return self._whole(self.answer.elbow)

    @property
    def code(self) -> Any:
        """Place of the status in ``Reach``, an int or an array of them."""
        return self._whole(self.answer.code)

    @property
    def gap(self) -> Any:
        """Distance from the target to the nearest point found [m].

        0 where it is reached, but for a target that was taken for reached within the tolerance.
        """
        return self._shaped(self.answer.gap)

    @property
    def iterations(self) -> Any:
        """Of the numerical search, an int or an array; 0 for a closed form."""
        return self._whole(self.answer.iterations)

    @property
    def report(self) -> Report:
        """Every iteration of a single numerical search."""
        report: Report = self.answer.report
        return report

    def _shaped(self, column: Any) -> Any:
        """A float, or a read-only array of the leading shape."""
        if not self.goal.lead:
            return column if type(column) is float else float(column[0])
        array = np.full(self.goal.lead, column) if type(column) is float else column.reshape(self.goal.lead)
        array.flags.writeable = False
        return array

    def _whole(self, column: Any) -> Any:
        """An int, or an array of them."""
        if not self.goal.lead:
            return int(column if type(column) is float else column[0])
        return self._shaped(column).astype(np.int64)

    @property
    def status(self) -> Any:
        """A ``Reach``, or an object array of them for a batch."""
        code = self.answer.code
        return _REACHES[int(code)] if type(code) is float else status_of(Reach, self.code)

    @property
    def reached(self) -> Any:
        """Whether the tool is at the target to within the tolerance; an array of bool for a batch."""
        return self.code <= _ON_AXIS

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
