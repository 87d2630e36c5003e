"""The primitives of the laws in Numba's dialect: a fast set that makes vector code, and a safe set by the C library.

The fast ones answer NaN where they do not hold (see ``elementary``; a quadrature of more than one panel); the loop then
evaluates that row again with the safe ones.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numba.extending import overload

from coplanar.engine.arrays import DSINC_BELOW, PI, SERIES_BELOW, TAU, dsinc_series
from coplanar.engine.compiled import elementary
from coplanar.engine.compiled.elementary import FLAGS, inline
from coplanar.engine.compiled.single import elementary_functions, in_single
from coplanar.engine.gauss import MOST_PANELS, rule

NAN = math.nan


def _root(make):
    def sqrt(x):
        return math.sqrt(x if x > 0.0 else 0.0 * x)  # zero for x <= 0, NaN for NaN

    return make(sqrt)


def _trigonometry(pair, angle, series_of_dsinc, make, sine=None):
    """The primitives that follow from sincos and atan2, and from a sine of its own where there is one."""

    def sin(x):
        return pair(x)[0]

    alone = sine or make(sin)

    def cos(x):
        return pair(x)[1]

    def tan(x):
        s, c = pair(x)
        return s / c

    def atan(x):
        return angle(x, 1.0)

    def sinc(x):
        small = abs(x) < SERIES_BELOW
        z = x * x
        series = 1.0 - z * (1.0 / 6.0 - z * (1.0 / 120.0))
        return series if small else alone(x) / (1.0 if small else x)

    def dsinc(x):
        small = abs(x) < DSINC_BELOW
        apart = 1.0 if small else x
        s, c = pair(apart)
        return x * series_of_dsinc(x * x) if small else (c - s / apart) / apart

    return {"sin": alone, **{f.__name__: make(f) for f in (cos, tan, atan, sinc, dsinc)}}


def _common(make):
    """Comparisons and roundings, the same in both sets."""

    def where(condition, yes, no):
        return yes if condition else no

    def minimum(x, y):
        return x if x < y or x != x else y  # NaN passes through, as in NumPy

    def maximum(x, y):
        return x if x > y or x != x else y  # NaN passes through, as in NumPy

    def nearest(x):
        return np.rint(x)

    def copysign(x, y):
        return math.copysign(x, y)

    def floor(x):
        return np.floor(x)  # a float, where math.floor is an integer of 64 bits

    def absolute(x):
        return abs(x)

    return {f.__name__: make(f) for f in (where, minimum, maximum, nearest, copysign, floor, absolute)}


def _libm():
    """What the C library computes."""

    def hypot(x, y):
        return math.hypot(x, y)

    def exp(x):
        return math.exp(x)

    def log(x):
        return math.log(x)

    def log1p(x):
        return math.log1p(x)

    def expm1(x):
        return math.expm1(x)

    def sinh(x):
        return math.sinh(x)

    def cosh(x):
        return math.cosh(x)

    def tanh(x):
        return math.tanh(x)

    def asinh(x):
        return math.asinh(x)

    def atanh(x):
        return math.atanh(x)

    def sincos(x):
        return math.sin(x), math.cos(x)

    def atan2(y, x):
        return math.atan2(y, x)

    def turn_remainder(x):
        rest = np.fmod(x, TAU)
        rest = rest - TAU if rest > PI else rest
        return rest + TAU if rest < -PI else rest

    texts = (turn_remainder, hypot, exp, log, log1p, expm1, sinh, cosh, tanh, asinh, atanh, sincos, atan2)
    return {f.__name__: inline(f) for f in texts}


def add_terms(total, weight, terms):
    """``total + weight * terms`` for tuples, unrolled by type."""


@overload(add_terms, jit_options={"forceinline": True, "fastmath": FLAGS})
def _add_terms(total, weight, terms):
    if len(total) == 1:
        return lambda total, weight, terms: (total[0] + weight * terms[0],)
    return lambda total, weight, terms: (total[0] + weight * terms[0], *add_terms(total[1:], weight, terms[1:]))


def scaled_terms(terms, factor):
    """``factor * terms`` for a tuple, unrolled by type."""


@overload(scaled_terms, jit_options={"forceinline": True, "fastmath": FLAGS})
def _scaled_terms(terms, factor):
    if len(terms) == 1:
        return lambda terms, factor: (factor * terms[0],)
    return lambda terms, factor: (factor * terms[0], *scaled_terms(terms[1:], factor))


def _panel_of(integrand, points, number=float):
    """One Gauss-Legendre panel, its nodes unrolled by type: only then does the loop over rows become vector code."""
    nodes, weights = (tuple(map(number, values)) for values in rule(points))

    def add_nodes(total, middle, half, nodes, weights, parameters):
        """The terms of the nodes that are left."""

    @overload(add_nodes, jit_options={"forceinline": True, "fastmath": FLAGS})
    def _add_nodes(total, middle, half, nodes, weights, parameters):
        if len(nodes) == 0:
            return lambda total, middle, half, nodes, weights, parameters: total
        return lambda total, middle, half, nodes, weights, parameters: add_nodes(
            add_terms(total, weights[0], integrand(middle + nodes[0] * half, *parameters)),
            middle, half, nodes[1:], weights[1:], parameters,
        )  # fmt: skip

    @inline
    def panel(middle, half, parameters):
        first = scaled_terms(integrand(middle + nodes[0] * half, *parameters), weights[0])
        return scaled_terms(add_nodes(first, middle, half, nodes[1:], weights[1:], parameters), half)

    return panel


def _one_panel(make, number):
    """The integral where one panel is enough, NaN where it is not."""

    def one_panel(integrand, points):
        panel = _panel_of(integrand, points, number)

        def integrate(panels, lower, upper, *parameters):
            half = 0.5 * (upper - lower)
            return panel(lower + half, half if panels <= 1.0 else NAN, parameters)

        return make(integrate)

    return one_panel


def _all_panels(integrand, points):
    """The integral by as many panels as the bound asks for."""
    panel = _panel_of(integrand, points)

    @njit(fastmath=FLAGS, error_model="numpy")
    def integrate(panels, lower, upper, *parameters):
        count = max(1, math.ceil(panels)) if panels <= MOST_PANELS else 1
        half = 0.5 * (upper - lower) / count if panels <= MOST_PANELS else math.nan
        total = panel(lower + half, half, parameters)
        for k in range(1, count):
            total = add_terms(total, 1.0, panel(lower + (2 * k + 1) * half, half, parameters))
        return total

    return integrate


def _primitives(functions, integral, make=inline, sine=None):
    series_of_dsinc = make(dsinc_series)
    follow = _trigonometry(functions["sincos"], functions["atan2"], series_of_dsinc, make, sine)
    return {
        **_common(make), **functions, **follow, "sqrt": _root(make), "integral": integral,
        "dsinc_series": series_of_dsinc,
    }  # fmt: skip


_LIBM = _libm()
FAST = _primitives({name: getattr(elementary, name) for name in _LIBM}, _one_panel(inline, float), sine=elementary.sin)
SINGLE = _primitives(elementary_functions(_LIBM), _one_panel(in_single, np.float32), in_single)
SAFE = _primitives(_LIBM, _all_panels)
NAN_WHERE_NOT = frozenset(
    (*_LIBM, "sin", "cos", "tan", "atan", "sinc", "dsinc", "integral")
)  # the fast ones that may answer NaN for a number
