"""What an inverse is asked for: targets and wishes, checked once, each a float or a column of rows."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.arms.chain import Chain
from coplanar.checks import Real
from coplanar.engine import components, is_foreign, memory
from coplanar.errors import InvalidValue
from coplanar.se2 import Pose

ELBOWS = (1, -1)  # the order of the branches
REMEDY = "pass a Pose where the tool's heading matters"


@dataclass(slots=True, eq=False)
class Goal:
    """Targets in columns: floats where there is one, otherwise arrays of k rows.

    Attributes:
        lead: The leading shape of the targets.
        x: World position [m].
        y: Likewise.
        heading: Of the tool; None where only positions are asked for [rad].
        near: A column for every joint, to come nearest to; None where the caller has no wish.
        elbow: Wanted branch; None likewise.
        tolerance: What counts as reached [m].
        owned: Whether the columns are finite numbers, and nobody else can change them.
    """

    lead: tuple[int, ...]
    x: Real
    y: Real
    heading: Any
    near: Any
    elbow: Any
    tolerance: float
    owned: bool = True

    @classmethod
    def of(cls, chain: Chain, target: Any, near: Any, elbow: Any, tolerance: float) -> Goal:
        """Broadcast, in columns, checked; those of positions alone are to be owned before the answer is handed out."""
        if type(tolerance) is not float or not 0.0 <= tolerance < math.inf:
            tolerance = checks.not_negative("tolerance", tolerance)
        point = _single(target)
        if point is not None:
            near = None if near is None else chain.joints_of(near, "near")
            elbow = float(elbow) if type(elbow) is int and elbow in ELBOWS else elbow
            if (near is None or type(near) is list) and (elbow is None or (type(elbow) is float and elbow in ELBOWS)):
                return cls((), point[0], point[1], None, near, elbow, tolerance)
        return cls._general(chain, target, near, elbow, tolerance)

    @classmethod
    def _general(cls, chain: Chain, target: Any, near: Any, elbow: Any, tolerance: float) -> Goal:
        pose = isinstance(target, Pose)
        parts = target.parts if pose else components(_points(target))
        wishes = {"target": sum(parts[1:], parts[0])} if pose else {"target": parts[0]}
        if near is not None:
            near = components(chain.checked_joints("near", near))
            wishes["near"] = near[0]
        if elbow is not None:
            elbow = checks.real("elbow", elbow)
            if not np.isin(elbow, ELBOWS).all():
                raise InvalidValue("elbow", elbow, "+1 or -1, the sign of the sine at the elbow")
            wishes["elbow"] = elbow
        lead = checks.broadcast(**wishes)
        if lead and not pose and near is None and parts[0].shape == lead:
            elbow = None if elbow is None else _columns((elbow,), lead)[0]
            x, y = (part.reshape(-1) for part in parts)
            return cls(lead, x, y, None, None, elbow, tolerance, owned=False)
        if not pose and not is_foreign(target):
            checks.finite("target", target, np.asarray(target, np.float64), remedy=REMEDY)
        x, y, *heading = _columns(parts, lead)
        return cls(
            lead,
            x,
            y,
            heading[0] if pose else None,
            None if near is None else _columns(near, lead),
            None if elbow is None else _columns((elbow,), lead)[0],
            tolerance,
        )

    def own(self) -> None:
        """Have the positions, finite numbers, in columns of one memory."""
        if not self.owned:
            self.hold(*_columns((self.x, self.y), self.x.shape))

    def hold(self, x: np.ndarray, y: np.ndarray, *, finite: bool = False) -> None:
        """Take these columns for the positions; they are checked unless it is known that they are finite."""
        self.x, self.y, self.owned = x, y, True
        if not finite:
            checks.finite("target", self.points, self.points, remedy=REMEDY)

    @property
    def aims(self) -> list[Real]:
        """The columns of the position, and of the heading where it matters."""
        return [self.x, self.y] if self.heading is None else [self.x, self.y, self.heading]

    @property
    def points(self) -> np.ndarray:
        """Positions, shape (..., 2)."""
        return shaped([self.x, self.y], self.lead)

    def rows(self, which: np.ndarray) -> Goal:
        """Some of the targets, as rows."""
        pick = [None if c is None else np.atleast_1d(c)[which] for c in (self.x, self.y, self.heading, self.elbow)]
        near = None if self.near is None else [np.atleast_1d(c)[which] for c in self.near]
        return Goal((len(which),), pick[0], pick[1], pick[2], near, pick[3], self.tolerance)


def _points(target: Any) -> Any:
    """Positions, of which nobody knows yet whether they are finite."""
    return checks.ending_in(2, "target", checks.reals("target", target, remedy=REMEDY), remedy=REMEDY)


def _single(target: Any) -> Any:
    """The two floats of one position in plain numbers; None for anything else."""
    point = target.tolist() if type(target) is np.ndarray and target.shape == (2,) else target
    if type(point) not in (tuple, list) or len(point) != 2:
        return None
    x, y = point
    return point if type(x) is type(y) is float and math.isfinite(x) and math.isfinite(y) else None


def _columns(parts: Any, lead: tuple[int, ...]) -> Any:
    """Columns of one memory, of their own."""
    if not lead:
        return parts
    table = memory.empty((len(parts), *lead))
    for column, part in zip(table, parts, strict=True):
        column[...] = part
    return table.reshape(len(parts), -1)


def shaped(columns: Any, lead: tuple[int, ...]) -> np.ndarray:
    """Columns side by side, shape (..., columns), read-only; a view where they are one memory."""
    if not lead:
        answer = np.array(columns).reshape(-1)
    else:
        table = columns if isinstance(columns, np.ndarray) else np.stack(columns)
        answer = np.moveaxis(table.reshape(len(table), *lead), 0, -1)
    answer.flags.writeable = False
    return answer
