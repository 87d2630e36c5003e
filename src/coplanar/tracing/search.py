"""Any other arm along a curve: the inverse at every parameter, started from the joints before."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from coplanar.arms import Arm, Reach
from coplanar.curves import Curve
from coplanar.tracing.result import Failure, Reason

_REASONS = {
    Reach.TOO_FAR: Reason.TOO_FAR,
    Reach.TOO_CLOSE: Reason.TOO_CLOSE,
    Reach.OUTSIDE_LIMITS: Reason.JOINT_LIMIT,
    Reach.STOPPED_BY_LIMITS: Reason.JOINT_LIMIT,
}
HALVINGS = 40  # of an interval between two parameters, to find where in it the arm stops following


@dataclass(frozen=True, slots=True)
class Walker:
    """An arm and a curve, and what counts as following.

    Attributes:
        arm: The arm.
        curve: The curve.
        tolerance: How far from the curve counts as on it [m].
        step_limit: How far a joint may move from one parameter to the next [rad or m].
    """

    arm: Arm
    curve: Curve
    tolerance: float
    step_limit: float

    def step(self, phi: float, last: np.ndarray | None) -> tuple[np.ndarray, Reason | None, float]:
        """Joints at phi, why they do not follow (None if they do), and the gap [m]."""
        answer = self.arm.inverse(self.curve.position(phi), near=last, tolerance=self.tolerance)
        q = np.asarray(answer.q)
        if not answer.reached:
            return q, _REASONS.get(answer.status, Reason.NOT_FOUND), float(answer.gap)
        jumped = last is not None and np.abs(q - last).max() > self.step_limit
        return q, Reason.NOT_FOUND if jumped else None, 0.0

    def walk(self, parameters: np.ndarray, near: np.ndarray | None) -> tuple[np.ndarray, np.ndarray, list[Failure]]:
        """Joints row by row, which of them follow, and the intervals where they do not."""
        rows, last = [], near
        for phi in parameters.tolist():
            rows.append(self.step(phi, last))
            if rows[-1][1] is None:
                last = rows[-1][0]
        q = np.array([row[0] for row in rows])
        followed = np.array([row[1] is None for row in rows])
        failures = [self._failure(parameters, rows, a, b) for a, b in _runs(~followed)]
        return q, followed, failures

    def _failure(
        self, parameters: np.ndarray, rows: list[tuple[np.ndarray, Reason | None, float]], a: int, b: int
    ) -> Failure:
        """Rows a to b as an interval, its ends refined."""
        first, last = float(parameters[a]), float(parameters[b])
        if a > 0:
            first = self._edge(float(parameters[a - 1]), first, rows[a - 1][0])
        if b + 1 < len(rows):
            last = self._edge(float(parameters[b + 1]), last, rows[b + 1][0])
        return Failure(first, last, rows[a][1] or Reason.NOT_FOUND, max(row[2] for row in rows[a : b + 1]))

    def _edge(self, inside: float, outside: float, q: np.ndarray) -> float:
        """The last parameter from ``inside`` towards ``outside`` at which the arm follows."""
        for _ in range(HALVINGS):
            middle = 0.5 * (inside + outside)
            found, reason, _ = self.step(middle, q)
            if reason is None:
                inside, q = middle, found
            else:
                outside = middle
        return inside


def _runs(marked: np.ndarray) -> Iterator[tuple[int, int]]:
    """First and last place of every run of marked rows."""
    edges = np.diff(np.concatenate([[0], marked.astype(int), [0]]))
    return zip(np.flatnonzero(edges == 1).tolist(), (np.flatnonzero(edges == -1) - 1).tolist(), strict=True)
