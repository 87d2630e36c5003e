"""The part of a wanted motion that a base can make."""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np

from coplanar.errors import NoSolution
from coplanar.se2 import Twist


class TwistStatus(enum.Enum):
    """Whether the base can make a twist."""

    FEASIBLE = "the base can make this twist"
    PARTLY_FEASIBLE = "the base can make a part of this twist only"


@dataclass(frozen=True, slots=True)
class FeasibleTwist:
    """The nearest twist that the base can be driven along without sliding, and what is missing.

    Attributes:
        wanted: As it was asked for.
        twist: The feasible part.
        reason: What the base cannot do, in words; empty if it can do everything.
        length: What omega is multiplied by to compare it with a speed [m].
        tolerance: How large the infeasible part may be [m/s].
    """

    wanted: Twist
    twist: Twist
    reason: str
    length: float
    tolerance: float

    @property
    def infeasible(self) -> Twist:
        """What is missing: wanted - twist."""
        return Twist.from_array(self.wanted.as_array() - self.twist.as_array())

    @property
    def gap(self) -> float | np.ndarray:
        """Size of the infeasible part, with omega counted as the speed L omega [m/s]."""
        vx, vy, omega = self.infeasible.parts
        size = np.sqrt(np.square(vx) + np.square(vy) + np.square(self.length * omega))
        return size if size.ndim else float(size)

    @property
    def is_feasible(self) -> bool | np.ndarray:
        """Whether nothing is missing: a bool, or an array of the leading shape."""
        small = np.less_equal(self.gap, self.tolerance)
        return small if small.ndim else bool(small)

    @property
    def status(self) -> TwistStatus:
        """One sentence; for a batch, FEASIBLE only if every entry is."""
        return TwistStatus.FEASIBLE if np.all(self.is_feasible) else TwistStatus.PARTLY_FEASIBLE

    def or_raise(self) -> FeasibleTwist:
        """This result, if every twist is feasible.

        Raises:
            NoSolution: If a part is missing.
        """
        if self.status is not TwistStatus.FEASIBLE:
            raise NoSolution(f"{self.status.value}: {self.reason}; short by {np.max(self.gap):.3g} m/s", self)
        return self
