"""The primitives of the laws, as array text over a namespace ``xp``.

Here ``xp`` is NumPy, so a law that imports these names is a valid NumPy function by itself. The same text
bound to another namespace (``engine.binding``) serves JAX, PyTorch and whoever else speaks the array API.
Where a primitive has a special point, both sides of it are finite, so that gradients are.
"""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as xp

from coplanar.engine.gauss import panel_count, rule

PI = math.pi
TAU = math.tau

SERIES_BELOW = 5e-3  # [rad] sinc by its series: the first term left out is x^6/5040 < 4e-18
FEW_ROWS = 512  # of an integral, whose nodes fit into the caches all at once
DSINC_BELOW = 1.0  # [rad] dsinc by its series: the first term left out is 20 x^19/21! < 4e-19


def sin(x: Any) -> Any:
    """Sine of an angle in radians."""
    return xp.sin(x)


def cos(x: Any) -> Any:
    """Cosine of an angle in radians."""
    return xp.cos(x)


def sincos(x: Any) -> Any:
    """Sine and cosine of one angle, in this order."""
    return xp.sin(x), xp.cos(x)


def tan(x: Any) -> Any:
    """Tangent of an angle in radians."""
    return xp.tan(x)


def atan2(y: Any, x: Any) -> Any:
    """Angle of the point (x, y), in [-pi, pi]."""
    return xp.atan2(y, x)


def sqrt(x: Any) -> Any:
    """Square root; zero, with a zero gradient, for x <= 0."""
    inside = x > 0.0
    return xp.where(inside, xp.sqrt(xp.where(inside, x, 1.0)), 0.0 * x)


def hypot(x: Any, y: Any) -> Any:
    """Length of (x, y); zero, with a zero gradient, at the origin."""
    apart = (x != 0.0) | (y != 0.0)
    return xp.where(apart, xp.hypot(xp.where(apart, x, 1.0), y), 0.0)


def exp(x: Any) -> Any:
    """Natural exponential."""
    return xp.exp(x)


def log(x: Any) -> Any:
    """Natural logarithm."""
    return xp.log(x)


def log1p(x: Any) -> Any:
    """log(1 + x) without cancellation."""
    return xp.log1p(x)


def expm1(x: Any) -> Any:
    """exp(x) - 1 without cancellation."""
    return xp.expm1(x)


def sinh(x: Any) -> Any:
    """Hyperbolic sine."""
    return xp.sinh(x)


def cosh(x: Any) -> Any:
    """Hyperbolic cosine."""
    return xp.cosh(x)


def tanh(x: Any) -> Any:
    """Hyperbolic tangent."""
    return xp.tanh(x)


def asinh(x: Any) -> Any:
    """Inverse hyperbolic sine."""
    return xp.asinh(x)


def atan(x: Any) -> Any:
    """Inverse tangent."""
    return xp.atan(x)


def atanh(x: Any) -> Any:
    """Inverse hyperbolic tangent."""
    return xp.atanh(x)


def copysign(x: Any, y: Any) -> Any:
    """The magnitude of x with the sign of y."""
    return xp.copysign(x, y)


def floor(x: Any) -> Any:
    """Greatest whole number that is not above x."""
    return xp.floor(x)


def absolute(x: Any) -> Any:
    """Absolute value."""
    return xp.abs(x)


def turn_remainder(x: Any) -> Any:
    """The angle less the whole turns (of ``TAU``) nearest to it, in [-pi, pi]; no rounding, whatever the angle."""
    rest = xp.fmod(x, TAU)
    return xp.where(rest > PI, rest - TAU, xp.where(rest < -PI, rest + TAU, rest))


def nearest(x: Any) -> Any:
    """Nearest whole number, halves to even."""
    return xp.round(x)


def where(condition: Any, yes: Any, no: Any) -> Any:
    """``yes`` where the condition holds, ``no`` elsewhere; both are evaluated."""
    return xp.where(condition, yes, no)


def minimum(x: Any, y: Any) -> Any:
    """The smaller of two; NaN if one is."""
    return xp.where((x < y) | (x != x), x, y)


def maximum(x: Any, y: Any) -> Any:
    """The larger of two; NaN if one is."""
    return xp.where((x > y) | (x != x), x, y)


def sinc(x: Any) -> Any:
    """sin(x)/x, 1 at 0."""
    small = xp.abs(x) < SERIES_BELOW
    z = x * x
    return xp.where(small, 1.0 - z * (1.0 / 6.0 - z * (1.0 / 120.0)), xp.sin(x) / xp.where(small, 1.0, x))


def dsinc(x: Any) -> Any:
    """Derivative of sinc: (cos x - sinc x)/x, 0 at 0."""
    small = xp.abs(x) < DSINC_BELOW
    z = xp.where(small, x * x, 0.0)
    apart = xp.where(small, 1.0, x)
    return xp.where(small, x * dsinc_series(z), (xp.cos(apart) - xp.sin(apart) / apart) / apart)


def dsinc_series(z: Any) -> Any:
    """Series of dsinc(x)/x in z = x^2: the sum of (-1)^k 2k z^(k-1)/(2k+1)! over k = 1 ... 9."""
    tail = 1.0 / 518918400.0 + z * (
        -1.0 / 93405312000.0 + z * (1.0 / 22230464256000.0 + z * (-1.0 / 6758061133824000.0))
    )
    return -1.0 / 3.0 + z * (1.0 / 30.0 + z * (-1.0 / 840.0 + z * (1.0 / 45360.0 + z * (-1.0 / 3991680.0 + z * tail))))


class Integral:
    """Integral of a law over an interval, by Gauss-Legendre panels: made once in a law's module, called by the law.

    Attributes:
        integrand: A law of s and parameters that returns a tuple.
        points: Nodes per panel.

    Example:
        >>> def powers(s, scale):
        ...     return scale * s, scale * s * s
        >>> area = Integral(powers)
        >>> [round(float(a), 12) for a in area(1.0, 0.0, 3.0, 2.0)]
        [9.0, 18.0]
    """

    def __init__(self, integrand: Any, points: int = 16, where: Any = where) -> None:
        self.integrand = integrand
        self.points = points
        self._where = where

    def __call__(self, panels: Any, lower: Any, upper: Any, *parameters: Any) -> Any:
        """The integrals of ``integrand(s, *parameters)``.

        Args:
            panels: How many panels the caller's bound asks for; a real number, rounded up. Where it is NaN or more than
                there are (``gauss.MOST_PANELS``; ``gauss.UNKNOWN`` under ``jax.jit``), the integral is NaN.
            lower: Start of the interval.
            upper: End of the interval.
            *parameters: Passed on to the integrand.

        Returns:
            A tuple with one integral for every entry of the integrand's tuple.
        """
        count = panel_count(panels)
        half = 0.5 * (upper - lower) / count + self._where(panels <= count, 0.0, math.nan)
        total: Any = None
        for k in range(count):  # panel by panel, so that rounding does not grow with every node
            panel = self._panel(lower + (2 * k + 1) * half, half, parameters)
            total = panel if total is None else _sums(total, panel)
        return tuple(half * t for t in total)

    def _panel(self, middle: Any, half: Any, parameters: Any) -> Any:
        if type(middle) is xp.ndarray and 0 < middle.size <= FEW_ROWS:
            return self._on_few(middle, half, parameters)
        total: Any = None
        for node, weight in zip(*rule(self.points), strict=True):
            terms = [weight * f for f in self.integrand(middle + node * half, *parameters)]
            total = terms if total is None else _sums(total, terms)
        return total

    def _on_few(self, middle: Any, half: Any, parameters: Any) -> Any:
        """The nodes as a leading axis, added in the same order: for a few rows calls cost more than numbers."""
        depth = max(map(xp.ndim, (middle, half, *parameters)))
        nodes, weights = (xp.reshape(side, (-1, *(1,) * depth)).astype(middle.dtype) for side in rule(self.points))
        terms = self.integrand(middle + nodes * half, *parameters)
        return [functools.reduce(xp.add, weights * term) for term in terms]


def _sums(one: Any, other: Any) -> Any:
    return [a + b for a, b in zip(one, other, strict=True)]
