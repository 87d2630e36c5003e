"""Roots of many rows at once: bracketed Newton and secant steps, with the bracket as the way out."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

ROUNDS = 100  # evaluations; quadratic convergence takes about six, bisection from any bracket about sixty
FINE = 1e-8  # relative length of a Newton step after which the next one would be below the rounding
ROUNDING = 4e-16  # relative length of a bracket that cannot be halved


def rising_root(
    function: Callable[[np.ndarray], tuple[Any, Any]],
    start: Any,
    lower: Any,
    upper: Any,
    *,
    longest: float = np.inf,
    fine: float = FINE,
) -> np.ndarray:
    """Roots x with f(x) = 0 for an f that rises, row by row: Newton steps inside a shrinking bracket.

    Args:
        function: x -> (f, f'), both of the shape of x.
        start: First guess, between the bounds.
        lower: Where f is known to be <= 0.
        upper: Where f is known to be >= 0; infinite where that is not known.
        longest: The longest step to an x greater than every one so far.
        fine: Relative length of the last Newton step.

    Returns:
        The roots; NaN where f is NaN. A root beyond a finite ``upper`` is ``upper``.

    Example:
        >>> round(float(rising_root(lambda x: (x * x - 2.0, 2.0 * x), 1.0, 0.0, 2.0)), 12)
        1.414213562373
    """
    x, low, high = np.broadcast_arrays(*(np.asarray(a, dtype=np.float64) for a in (start, lower, upper)))
    untried, settled = np.isfinite(high), np.zeros(x.shape, bool)
    for _ in range(ROUNDS):
        value, slope = function(x)
        low, high = np.where(value < 0.0, x, low), np.where(value > 0.0, x, high)
        untried = untried & (value < 0.0)
        with np.errstate(all="ignore"):
            newton = np.minimum(x - value / slope, x + longest)
            middle = np.where(untried, high, np.where(np.isinf(high), x + min(longest, 1e3), 0.5 * (low + high)))
            inside = (newton >= low) & (newton <= high)
        step = np.where((value == 0.0) | settled, x, np.where(inside, newton, middle))
        near = np.where(inside, fine, ROUNDING) * np.abs(x)
        settled = settled | ~(np.abs(step - x) > near)
        x = step
        if settled.all():
            break
    return np.where(np.isnan(value), np.nan, x)


def falling_root(
    function: Callable[[np.ndarray], Any], start: Any, lower: Any, upper: Any, *, fine: float
) -> np.ndarray:
    """Roots x with f(x) = 0 for an f positive at ``lower`` and negative at ``upper``: secants inside the bracket.

    The ends themselves are never evaluated.

    Args:
        function: x -> f, of the shape of x.
        start: First guess, inside the bracket.
        lower: Where f is positive.
        upper: Where f is negative.
        fine: Length of the last step over the bracket's.

    Example:
        >>> round(float(falling_root(lambda x: 2.0 - x * x, 1.0, 0.0, 2.0, fine=1e-12)), 9)
        1.414213562
    """
    x, low, high = np.broadcast_arrays(*(np.asarray(a, dtype=np.float64) for a in (start, lower, upper)))
    span = high - low
    value = function(x)
    before, value_before = x, value
    moved = np.where(value > 0.0, x + 0.05 * (high - x), x - 0.05 * (x - low))
    for turn in range(ROUNDS):
        low, high = np.where(value > 0.0, x, low), np.where(value < 0.0, x, high)
        if turn:
            with np.errstate(all="ignore"):
                secant = x - value * (x - before) / (value - value_before)
                middle = 0.5 * (low + high)
                moved = np.where((secant > low) & (secant < high) & (turn % 6 != 0), secant, middle)
        moved = np.where(value == 0.0, x, moved)
        settled = ~((np.abs(moved - x) > fine * span) & (high - low > fine * span))
        before, value_before, x = x, value, moved
        if settled.all():
            break
        value = function(x)
    return np.asarray(x)
