"""The primitives of the laws in Numba's dialect: branch-free, so that LLVM turns a loop over them into vector code.

The fast ones answer NaN where they do not hold (angles beyond ``FAR``, a quadrature of more than one panel,
infinities); the loop then evaluates that row again with the safe ones, which are the C library's.
"""

from __future__ import annotations

import math

from numba import njit, types
from numba.core.datamodel.models import OpaqueModel
from numba.core.imputils import lower_constant
from numba.extending import overload, register_model

from coplanar.engine.arrays import DSINC_BELOW, SERIES_BELOW, dsinc_series
from coplanar.engine.gauss import NODES, WEIGHTS

X1, X2, X3, X4, X5, X6, X7, X8 = NODES[8:]  # the other half mirrors these
W1, W2, W3, W4, W5, W6, W7, W8 = WEIGHTS[8:]

FLAGS = {"contract", "nsz"}  # fused multiply-add; no care for the sign of zero; NaN and infinity stay exact
FAR = 1.0e5  # [rad] the three-part reduction by pi/2 is exact to here


class CompiledLaw:
    """A compiled function that may be passed to another one, ``integrate``, within a loop that is kept on disk.

    Numba hands a function over by its address, which is another one in the next process, and so refuses to keep the
    loop. The function is known by its type alone, so here nothing is handed over.
    """

    def __init__(self, function) -> None:
        self._function = function  # its type refers to it weakly
        self._numba_type_ = _CompiledLawType(function)

    def __call__(self, *args):
        return self._function(*args)


class _CompiledLawType(types.Dispatcher):
    """The type of one compiled law."""


register_model(_CompiledLawType)(OpaqueModel)


@lower_constant(_CompiledLawType)
def _no_value(context, builder, kind, value):
    return context.get_dummy_value()


def inline(function):
    """Compile a formula so that it melts into the loop that calls it."""
    return CompiledLaw(njit(function, forceinline=True, fastmath=FLAGS, error_model="numpy"))


@inline
def sincos(x):
    """Sine and cosine: reduction by pi/2 in three parts, then two polynomials. [Cody and Waite 1980; fdlibm]"""
    turns = math.floor(x * 0.6366197723675814 + 0.5)
    r = x - turns * 1.5707963267341256
    r = r - turns * 6.077100506303966e-11
    r = r - turns * 2.0222662487959506e-21
    z = r * r
    s = r + r * z * (
        -1.66666666666666324348e-01 + z * (8.33333333332248946124e-03 + z * (
            -1.98412698298579493134e-04 + z * (2.75573137070700676789e-06 + z * (
                -2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))))  # fmt: skip
    c = 1.0 - 0.5 * z + z * z * (
        4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * (
            2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07 + z * (
                2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))))  # fmt: skip
    quarter = int(turns)
    odd = (quarter & 1) != 0
    sine = c if odd else s
    cosine = s if odd else c
    sine = -sine if (quarter & 2) != 0 else sine
    cosine = -cosine if ((quarter + 1) & 2) != 0 else cosine
    far = not (abs(x) <= FAR)
    return (math.nan if far else sine), (math.nan if far else cosine)


@inline
def atan2(y, x):
    """Angle of (x, y): atan t = t + t z P(z), z = t^2, |t| <= tan(pi/8), P of degree 11 (error 1.2e-18)."""
    ay, ax = abs(y), abs(x)
    near, far = min(ax, ay), max(ax, ay)
    steep = near > 0.41421356237309503 * far
    t = (near - far if steep else near) / (near + far if steep else far)
    z = t * t
    p = z * (-0.3333333333333333 + z * (0.19999999999999804 + z * (-0.14285714285659828 + z * (
        0.11111111105155447 + z * (-0.09090908753500877 + z * (0.07692296375032143 + z * (
            -0.06666424885738255 + z * (0.05878928997834775 + z * (-0.05230454270650244 + z * (
                0.04551593220626549 + z * (-0.034570561981427744 + z * 0.016285756855221028)))))))))))  # fmt: skip
    angle = t + t * p
    angle = (0.7853981633974483 + (angle + 3.061616997868383e-17)) if steep else angle
    angle = (1.5707963267948966 - (angle - 6.123233995736766e-17)) if ay > ax else angle
    angle = (3.141592653589793 - (angle - 1.2246467991473532e-16)) if x < 0.0 else angle
    return math.copysign(angle, y)


@inline
def sqrt(x):
    """Square root; zero for x <= 0, NaN for NaN."""
    return math.sqrt(x if x > 0.0 else 0.0 * x)


def _trigonometry(pair, angle):
    """The primitives that follow from sincos and atan2."""

    def sin(x):
        return pair(x)[0]

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
        return series if small else pair(x)[0] / (1.0 if small else x)

    def dsinc(x):
        small = abs(x) < DSINC_BELOW
        apart = 1.0 if small else x
        s, c = pair(apart)
        return x * series_of_dsinc(x * x) if small else (c - s / apart) / apart

    return {f.__name__: inline(f) for f in (sin, cos, tan, atan, sinc, dsinc)}


series_of_dsinc = inline(dsinc_series)


def _elementary():
    """What the C library computes, and what is a comparison."""

    def where(condition, yes, no):
        return yes if condition else no

    def minimum(x, y):
        return x if x < y or x != x else y  # NaN passes through, as in NumPy

    def maximum(x, y):
        return x if x > y or x != x else y  # NaN passes through, as in NumPy

    def nearest(x):
        whole = math.floor(x + 0.5)
        return whole - 1.0 if whole - x == 0.5 and whole % 2.0 == 1.0 else whole

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

    def copysign(x, y):
        return math.copysign(x, y)

    def floor(x):
        return math.floor(x) * 1.0

    def absolute(x):
        return abs(x)

    texts = (
        where,
        minimum,
        maximum,
        nearest,
        hypot,
        exp,
        log,
        log1p,
        expm1,
        sinh,
        cosh,
        tanh,
        asinh,
        atanh,
        copysign,
        floor,
        absolute,
    )
    return {f.__name__: inline(f) for f in texts}


def _add(total, weight, terms):
    """``total + weight * terms`` for tuples, unrolled by type."""


@overload(_add, jit_options={"forceinline": True, "fastmath": FLAGS})
def _add_overload(total, weight, terms):
    if len(total) == 1:
        return lambda total, weight, terms: (total[0] + weight * terms[0],)
    return lambda total, weight, terms: (total[0] + weight * terms[0], *_add(total[1:], weight, terms[1:]))


def _times(terms, factor):
    """``factor * terms`` for a tuple, unrolled by type."""


@overload(_times, jit_options={"forceinline": True, "fastmath": FLAGS})
def _times_overload(terms, factor):
    if len(terms) == 1:
        return lambda terms, factor: (factor * terms[0],)
    return lambda terms, factor: (factor * terms[0], *_times(terms[1:], factor))


@inline
def _pair(integrand, middle, offset, weight, parameters):
    """Two nodes, one on either side of the middle."""
    both = _add(integrand(middle - offset, *parameters), 1.0, integrand(middle + offset, *parameters))
    return _times(both, weight)


@inline
def _panel(integrand, middle, half, parameters):
    """One Gauss-Legendre panel about ``middle``."""
    # Written out: LLVM turns the loop over rows into vector code only where there is no other loop within it.
    total = _pair(integrand, middle, half * X1, W1, parameters)
    total = _add(total, 1.0, _pair(integrand, middle, half * X2, W2, parameters))
    total = _add(total, 1.0, _pair(integrand, middle, half * X3, W3, parameters))
    total = _add(total, 1.0, _pair(integrand, middle, half * X4, W4, parameters))
    total = _add(total, 1.0, _pair(integrand, middle, half * X5, W5, parameters))
    total = _add(total, 1.0, _pair(integrand, middle, half * X6, W6, parameters))
    total = _add(total, 1.0, _pair(integrand, middle, half * X7, W7, parameters))
    total = _add(total, 1.0, _pair(integrand, middle, half * X8, W8, parameters))
    return _times(total, half)


@inline
def integrate_one_panel(integrand, panels, lower, upper, *parameters):
    """The integral where one panel is enough, NaN where it is not."""
    half = 0.5 * (upper - lower)
    return _times(_panel(integrand, lower + half, half, parameters), 1.0 if panels <= 1.0 else math.nan)


def out_of_line(function):
    """Compile a formula beside the loop that calls it, for what is rare."""
    return CompiledLaw(njit(function, fastmath=FLAGS, error_model="numpy"))


@out_of_line
def integrate_panels(integrand, panels, lower, upper, *parameters):
    """The integral by as many panels as the bound asks for."""
    count = max(1, math.ceil(panels)) if panels < 1.0e9 else 1
    half = 0.5 * (upper - lower) / count
    total = _panel(integrand, lower + half, half, parameters)
    for k in range(1, count):
        total = _add(total, 1.0, _panel(integrand, lower + (2 * k + 1) * half, half, parameters))
    return total


@inline
def _libm_sincos(x):
    return math.sin(x), math.cos(x)


@inline
def _libm_atan2(y, x):
    return math.atan2(y, x)


def _primitives(pair, angle, integral):
    return {
        **_elementary(), **_trigonometry(pair, angle),
        "sqrt": sqrt, "sincos": pair, "atan2": angle, "integrate": integral, "dsinc_series": series_of_dsinc,
    }  # fmt: skip


FAST = _primitives(sincos, atan2, integrate_one_panel)
SAFE = _primitives(_libm_sincos, _libm_atan2, integrate_panels)

__all__ = ["FAST", "FLAGS", "SAFE", "inline", "out_of_line"]
