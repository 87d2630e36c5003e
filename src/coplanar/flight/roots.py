"""Roots of many rows at once: bracketed Newton and secant steps, with the bracket as the way out.

Rows that are done are left out of further evaluations. ``coplanar.solving`` has the general root finders; here the
functions are expensive, their slopes are known, and often one end of the bracket is not, or must not be evaluated.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

ROUNDS = 100  # evaluations; quadratic convergence takes about six, bisection from any bracket about sixty
FINE = 1e-8  # relative length of a Newton step after which the next one would be below the rounding
ROUNDING = 4e-16  # relative length of a bracket that cannot be halved
UNKNOWN_SPAN = 1e3  # longest step where there is neither an upper end nor a limit


class _Rows:
    """The rows of a search that are not settled yet, as columns that shrink together."""

    def __init__(self, *columns: Any) -> None:
        whole = np.broadcast_arrays(*(np.asarray(c, dtype=np.float64) for c in columns))
        self.shape = whole[0].shape
        self.columns = [np.ravel(c) if self.shape else c for c in whole]
        self.found = np.full(self.columns[0].shape, np.nan)
        self.index = np.arange(self.found.size)

    def keep(self, x: np.ndarray, settled: np.ndarray, *others: np.ndarray) -> list[np.ndarray]:
        """Write down every root so far; once half of the rows are settled, go on without them."""
        if not self.shape:
            self.found = x
            return [x, settled, *others]
        self.found[self.index] = x
        if 2 * np.count_nonzero(settled) < settled.size or settled.all():
            return [x, settled, *others]
        left = ~settled
        self.index = self.index[left]
        self.columns = [c[left] for c in self.columns]
        return [c[left] for c in (x, settled, *others)]

    def roots(self) -> np.ndarray:
        """What was written down, in the shape of the rows."""
        return self.found.reshape(self.shape)


def rising_root(
    function: Callable[..., tuple[Any, Any]],
    start: Any,
    lower: Any,
    upper: Any,
    *parameters: Any,
    longest: float = np.inf,
) -> np.ndarray:
    """Roots x with f(x) = 0 for an f that rises, row by row: Newton steps inside a shrinking bracket.

    Args:
        function: (x, *parameters) -> (f, f'), row by row.
        start: First guess, between the bounds.
        lower: Where f is known to be <= 0.
        upper: Where f is known to be >= 0; infinite where that is not known.
        *parameters: Passed on to the function, row by row.
        longest: The longest step upwards.

    Returns:
        The roots; NaN where f is NaN. A root beyond a finite ``upper`` is ``upper``.

    Example:
        >>> round(float(rising_root(lambda x, a: (x * x - a, 2.0 * x), 1.0, 0.0, 2.0, 2.0)), 12)
        1.414213562373
    """
    rows = _Rows(start, lower, upper, *parameters)
    x, low, high = rows.columns[:3]
    untried, settled = np.isfinite(high), np.zeros(x.shape, bool)
    for _ in range(ROUNDS):
        value, slope = function(x, *rows.columns[3:])
        low, high = np.where(value < 0.0, x, low), np.where(value > 0.0, x, high)
        untried = untried & (value < 0.0)
        with np.errstate(all="ignore"):
            newton = np.minimum(x - value / slope, x + longest)
            further = np.where(np.isinf(high), x + min(longest, UNKNOWN_SPAN), 0.5 * (low + high))
            inside = (newton >= low) & (newton <= high)
        step = np.where(inside, newton, np.where(untried, high, further))
        step = np.where((value == 0.0) | settled, x, np.where(np.isnan(value), np.nan, step))
        near = np.where(inside, FINE, ROUNDING) * np.abs(x)
        settled = settled | ~(np.abs(step - x) > near)
        x, settled, low, high, untried = rows.keep(step, settled, low, high, untried)
        if settled.all():
            break
    return rows.roots()


def falling_root(
    function: Callable[..., Any], start: Any, lower: Any, upper: Any, *parameters: Any, fine: float
) -> np.ndarray:
    """Roots x with f(x) = 0 for an f positive at ``lower`` and negative at ``upper``: secants inside the bracket.

    The ends themselves are never evaluated.

    Args:
        function: (x, *parameters) -> f, row by row.
        start: First guess, inside the bracket.
        lower: Where f is positive.
        upper: Where f is negative.
        *parameters: Passed on to the function, row by row.
        fine: Length of the last step over the bracket's.

    Example:
        >>> round(float(falling_root(lambda x, a: a - x * x, 1.0, 0.0, 2.0, 2.0, fine=1e-12)), 9)
        1.414213562
    """
    rows = _Rows(start, lower, upper, *parameters)
    x, low, high = rows.columns[:3]
    span, settled = high - low, np.zeros(x.shape, bool)
    before = value_before = np.full(x.shape, np.nan)  # no secant yet
    for turn in range(ROUNDS):
        value = function(x, *rows.columns[3:])
        low, high = np.where(value > 0.0, x, low), np.where(value < 0.0, x, high)
        nudge = np.where(value > 0.0, x + 0.05 * (high - x), x - 0.05 * (x - low))
        with np.errstate(all="ignore"):
            secant = x - value * (x - before) / (value - value_before)
        trusted = (secant > low) & (secant < high) & (turn % 6 != 5)
        step = np.where(trusted, secant, 0.5 * (low + high) if turn else nudge)
        step = np.where((value == 0.0) | settled, x, step)
        settled = settled | ~((np.abs(step - x) > fine * span) & (high - low > fine * span))
        x, settled, low, high, span, before, value_before = rows.keep(step, settled, low, high, span, x, value)
        if settled.all():
            break
    return rows.roots()
