"""The primitives of the laws for one Python float, by the ``math`` module."""

from __future__ import annotations

import functools
import math
from math import asinh, atan, atan2, atanh, copysign, cos, cosh, expm1, hypot, log, log1p, sin, sinh, tan, tanh
from typing import Any

from coplanar.engine.arrays import DSINC_BELOW, PI, SERIES_BELOW, TAU, dsinc_series
from coplanar.engine.gauss import nodes_for, panel_count, rule

exp = math.exp
absolute = abs


def sincos(x: float) -> tuple[float, float]:
    """Sine and cosine of one angle, in this order."""
    return sin(x), cos(x)


def sqrt(x: float) -> float:
    """Square root; zero for x <= 0, NaN for NaN."""
    return math.sqrt(x) if x > 0.0 else 0.0 * x


def turn_remainder(x: float) -> float:
    """The angle less the whole turns nearest to it, in [-pi, pi], without rounding."""
    return math.remainder(x, TAU)


def minimum(x: float, y: float) -> float:
    """The smaller of two; NaN if one is."""
    return x if x < y or x != x else y


def maximum(x: float, y: float) -> float:
    """The larger of two; NaN if one is."""
    return x if x > y or x != x else y


def nearest(x: float) -> float:
    """Nearest whole number, halves to even."""
    return float(round(x))


def floor(x: float) -> float:
    """Greatest whole number that is not above x."""
    return float(math.floor(x))


def where(condition: bool, yes: float, no: float) -> float:
    """``yes`` if the condition holds, otherwise ``no``."""
    return yes if condition else no


def sinc(x: float) -> float:
    """sin(x)/x, 1 at 0."""
    if abs(x) < SERIES_BELOW:
        z = x * x
        return 1.0 - z * (1.0 / 6.0 - z * (1.0 / 120.0))
    return sin(x) / x


def dsinc(x: float) -> float:
    """Derivative of sinc: (cos x - sinc x)/x, 0 at 0."""
    return x * dsinc_series(x * x) if abs(x) < DSINC_BELOW else (cos(x) - sin(x) / x) / x


def integral(integrand: Any, points: int) -> Any:
    """The integral of a law that was bound to these primitives, by Gauss-Legendre panels.

    ``panels`` is a bound on what one panel can take, so a part of a panel needs fewer nodes; half of them are kept,
    as the bound may speak of one factor of the integrand alone.
    """

    def integrate(panels: float, lower: float, upper: float, *parameters: float) -> tuple[float, ...]:
        count = panel_count(panels)
        pairs = _pairs(max(points // 2, nodes_for(points, panels / count)))
        half = 0.5 * (upper - lower) / count if panels <= count else math.nan
        total = _panel(integrand, lower + half, half, pairs, parameters)
        for k in range(1, count):
            more = _panel(integrand, lower + (2 * k + 1) * half, half, pairs, parameters)
            total = [t + m for t, m in zip(total, more, strict=True)]
        return tuple(total)

    return integrate


@functools.cache
def _pairs(points: int) -> tuple[tuple[float, float], ...]:
    """Node and weight, one after the other."""
    return tuple(zip(*rule(points), strict=True))


def _panel(integrand: Any, middle: float, half: float, pairs: Any, parameters: tuple[float, ...]) -> list[float]:
    """The integrals over one panel about ``middle``."""
    rows = [integrand(middle + node * half, *parameters) for node, _ in pairs]
    if len(rows[0]) == 2:  # the pair (x, y), without the general case's tuples
        x = y = 0.0
        for (a, b), (_, weight) in zip(rows, pairs, strict=True):
            x += weight * a
            y += weight * b
        return [half * x, half * y]
    weighted = [[weight * f for f in row] for row, (_, weight) in zip(rows, pairs, strict=True)]
    return [half * column for column in map(sum, zip(*weighted, strict=True))]


__all__ = [
    "PI",
    "TAU",
    "absolute",
    "asinh",
    "atan",
    "atan2",
    "atanh",
    "copysign",
    "cos",
    "cosh",
    "dsinc",
    "dsinc_series",
    "exp",
    "expm1",
    "floor",
    "hypot",
    "integral",
    "log",
    "log1p",
    "maximum",
    "minimum",
    "nearest",
    "sin",
    "sinc",
    "sincos",
    "sinh",
    "sqrt",
    "tan",
    "tanh",
    "turn_remainder",
    "where",
]
