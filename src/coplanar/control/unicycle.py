"""The plant: a unicycle whose command (v, omega) is held over each control interval."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from coplanar import checks
from coplanar.checks import Real
from coplanar.engine import evaluator
from coplanar.laws import control as laws
from coplanar.laws import se2

_rates = evaluator(laws.unicycle_rates)
_arc = evaluator(se2.step)


class Row(NamedTuple):
    """Nodes c and weights b of an explicit Runge-Kutta method.

    The rates of a unicycle depend on the heading alone, which turns evenly while the command is held, so that the
    stage headings are theta + c_i h omega whatever the matrix of the method.
    """

    nodes: tuple[float, ...]
    weights: tuple[float, ...]

    @property
    def lead(self) -> float:
        """The sum of b_i c_i: how much of the turn within a step its displacement feels; 1/2 from order 2 on."""
        return sum(b * c for b, c in zip(self.weights, self.nodes, strict=True))


ROWS = {
    "euler": Row((0.0,), (1.0,)),
    "midpoint": Row((0.0, 0.5), (0.0, 1.0)),
    "heun": Row((0.0, 1.0), (0.5, 0.5)),
    "rk4": Row((0.0, 0.5, 0.5, 1.0), (1 / 6, 1 / 3, 1 / 3, 1 / 6)),
}
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
        (x, y, theta), (v, omega) = state, command
        if method == "exact":
            x, y, theta = _arc(x, y, theta, v * step, 0.0, omega * step)
            return x, y, theta
        checks.choice("method", method, METHODS)
        turn = omega * step
        for node, weight in zip(*ROWS[method], strict=True):
            dx, dy, _ = _rates(theta + node * turn, v, omega)
            x, y = x + weight * step * dx, y + weight * step * dy
        return x, y, theta + turn
