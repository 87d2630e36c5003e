"""What a search did, line by line."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, slots=True)
class Iteration:
    """One line of a search.

    Attributes:
        number: 0 is the start.
        evaluations: Calls of the function so far, those for differences among them.
        residual: Norm of the residual at ``x``.
        step: Norm of the step that was tried; 0 at the start.
        damping: lambda of the step, in units of the Jacobian squared; 0 for an undamped one.
        accepted: Whether the step was taken; if not, ``x`` is where the line before was.
        x: Where the search is after this line.
    """

    number: int
    evaluations: int
    residual: float
    step: float
    damping: float
    accepted: bool
    x: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Report:
    """The iterations of one search, oldest first; empty for a batch.

    Example:
        >>> report = Report((Iteration(0, 1, 0.5, 0.0, 0.0, True, (1.0, 2.0)),))
        >>> len(report), report[0].residual
        (1, 0.5)
    """

    iterations: tuple[Iteration, ...] = ()

    def __len__(self) -> int:
        return len(self.iterations)

    def __iter__(self) -> Iterator[Iteration]:
        return iter(self.iterations)

    def __getitem__(self, index: int) -> Iteration:
        """The line of that index."""
        return self.iterations[index]

    @property
    def rows(self) -> list[tuple[int, int, float, float, float, bool, tuple[float, ...]]]:
        """The lines as tuples, in the order of the table's columns."""
        return [(i.number, i.evaluations, i.residual, i.step, i.damping, i.accepted, i.x) for i in self]

    def table(self) -> str:
        """The lines as text, one row an iteration.

        Example:
            >>> print(Report((Iteration(0, 1, 0.5, 0.0, 0.0, True, (1.0, 2.0)),)).table())
             Iteration  Evaluations    |residual|        |step|       damping  taken  x
                     0            1   5.00000e-01   0.00000e+00   0.00000e+00    yes  1.000000  2.000000
        """
        head = f"{'Iteration':>10}{'Evaluations':>13}{'|residual|':>14}{'|step|':>14}{'damping':>14}  taken  x"
        return "\n".join([head, *(_line(i) for i in self)])


def _line(row: Iteration) -> str:
    numbers = f"{row.number:>10}{row.evaluations:>13}{row.residual:>14.5e}{row.step:>14.5e}{row.damping:>14.5e}"
    return f"{numbers}  {'yes' if row.accepted else 'no':>5}  " + "  ".join(f"{v:.6f}" for v in np.atleast_1d(row.x))
