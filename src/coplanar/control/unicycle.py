"""The plant: a unicycle whose command (v, omega) is held over each control interval."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from coplanar import checks
from coplanar.checks import Real
from coplanar.engine import evaluator
from coplanar.integrators import METHODS as TABLES
from coplanar.integrators import ButcherTableau
from coplanar.laws import control as laws
from coplanar.laws import motion

_arc = evaluator(motion.arc)
_step = evaluator(laws.unicycle_step)


class Row(NamedTuple):
    """Weights of a Runge-Kutta method with the nodes 0, 1/2 and 1; see ``laws.control.unicycle_step``."""

    at_start: float
    at_middle: float
    at_end: float

    @classmethod
    def of(cls, table: ButcherTableau) -> Row:
        """The row of a Butcher tableau whose nodes are 0, 1/2 and 1."""
        sums = {0.0: 0.0, 0.5: 0.0, 1.0: 0.0}
        for weight, node in zip(table.b, table.c, strict=True):
            sums[node] += weight
        return cls(*sums.values())

    @property
    def lead(self) -> float:
        """The sum of weight x node: how much of the turn within a step its displacement feels."""
        return 0.5 * self.at_middle + self.at_end


ROWS = {name: Row.of(table) for name, table in TABLES.items()}
METHODS = (*ROWS, "exact")
State = tuple[Real, Real, Real]
Command = tuple[Real, Real]


@dataclass(frozen=True, slots=True)
class Unicycle:
    """xdot = v cos theta, ydot = v sin theta, thetadot = omega: two controls, three coordinates.

    Example:
        >>> Unicycle().advance((0.0, 0.0, 0.0), (1.0, 0.0), 0.5, method="euler")
        (0.5, 0.0, 0.0)
    """

    def advance(self, state: State, command: Command, step: Real, *, method: str = "exact") -> State:
        """The state after ``step`` [s] under a held command.

        Args:
            state: (x, y, theta) [m, m, rad], each of shape (...).
            command: (v, omega) [m/s, rad/s].
            step: [s].
            method: "euler", "midpoint", "heun", "rk4" or "exact" (the arc itself).

        Raises:
            UnknownName: If the method is none of these.
        """
        checks.choice("method", method, METHODS)
        after: State = (
            _arc(*state, *command, step) if method == "exact" else _step(*state, *command, step, *ROWS[method])
        )
        return after


def lead_of(method: str) -> float:
    """How much of the turn within a step the displacement feels: 0 for Euler, 1/2 for the others.

    Raises:
        UnknownName: If the method is not known.
    """
    checks.choice("method", method, METHODS)
    return 0.5 if method == "exact" else ROWS[method].lead
