"""Elementary functions in Numba's dialect, branch-free, so that a loop over them becomes vector code.

Each is within 2.5 ulp where it holds and answers NaN where it does not (overflow, subnormal numbers, angles beyond
``FAR``); the loop then evaluates that row again by the C library.
"""

from __future__ import annotations

import math

from llvmlite import ir
from numba import njit, types
from numba.extending import intrinsic

from coplanar.engine.arrays import PI, TAU

FLAGS = {"contract", "nsz"}  # fused multiply-add; no care for the sign of zero; NaN and infinity stay exact
FAR = 1.0e5  # [rad] the reductions by pi/2 and by 2 pi are exact to here
TAU_HIGH = 6.2831853069365025  # TAU to 32 bits, so that its products with whole numbers to 2^21 are exact
TAU_LOW = TAU - TAU_HIGH  # the 21 bits left of TAU; exact
WHOLE = 6755399441055744.0  # 1.5 2^52: a sum with it is rounded to a whole number, which its lowest bits hold
STEEP = 700.0  # exp and its kin beyond it are left to the C library


def inline(function):
    """Compile a formula so that it melts into the loop that calls it."""
    return njit(function, forceinline=True, fastmath=FLAGS, error_model="numpy")


@intrinsic
def _bits(typing, x):
    """The 64 bits of a float, as an integer."""
    return types.int64(types.float64), lambda context, builder, signature, arguments: builder.bitcast(
        arguments[0], ir.IntType(64)
    )


@intrinsic
def _float_of(typing, bits):
    """The float with these 64 bits."""
    return types.float64(types.int64), lambda context, builder, signature, arguments: builder.bitcast(
        arguments[0], ir.DoubleType()
    )


@inline
def _reduced(x, rate, high, middle, low):
    """The angle less the nearest multiple of a part of a turn, in three parts, and a number whose bits hold which.

    [Cody and Waite 1980]
    """
    shifted = x * rate + WHOLE
    turns = shifted - WHOLE
    return ((x - turns * high) - turns * middle) - turns * low, shifted


@inline
def sincos(x):
    """Sine and cosine: reduction by pi/2, then two polynomials.  [fdlibm]"""
    r, shifted = _reduced(x, 0.6366197723675814, 1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21)
    z = r * r
    s = r + r * z * (
        -1.66666666666666324348e-01 + z * (8.33333333332248946124e-03 + z * (
            -1.98412698298579493134e-04 + z * (2.75573137070700676789e-06 + z * (
                -2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))))  # fmt: skip
    c = 1.0 - 0.5 * z + z * z * (
        4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * (
            2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07 + z * (
                2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))))  # fmt: skip
    quarter = _bits(shifted)
    odd = (quarter & 1) != 0
    sine = _float_of(_bits(c if odd else s) ^ ((quarter & 2) << 62))
    cosine = _float_of(_bits(s if odd else c) ^ (((quarter + 1) & 2) << 62))
    far = not (abs(x) <= FAR)
    return (math.nan if far else sine), (math.nan if far else cosine)


@inline
def sin(x):
    """Sine alone: reduction by pi, then r (1 + z P(z)), z = r^2, P of degree 7 (error 1.3e-18)."""
    r, shifted = _reduced(x, 0.3183098861837907, 3.1415926534682512, 1.2154201012607932e-10, 4.0445324975919012e-21)
    z = r * r
    p = -0.16666666666666666 + z * (0.008333333333333316 + z * (-0.00019841269841254955 + z * (
        2.755731921915843e-06 + z * (-2.5052107616384595e-08 + z * (1.6058977272815506e-10 + z * (
            -7.643969031052769e-13 + z * 2.731428986122616e-15))))))  # fmt: skip
    sine = _float_of(_bits(r + r * z * p) ^ (_bits(shifted) << 63))
    return sine if abs(x) <= FAR else math.nan


@inline
def atan2(y, x):
    """Angle of (x, y): atan t = t + t z P(z), z = t^2, |t| <= tan(pi/8), P of degree 11 (error 1.2e-18).

    NaN where the sum of the sides is no number or overflows, and at the origin: there the C library answers.
    """
    ay, ax = abs(y), abs(x)
    near, far = min(ax, ay), max(ax, ay)
    steep = near > 0.41421356237309503 * far
    t = (near - far if steep else near) / (near + far if steep else far) + 0.0 * (ax + ay)
    z = t * t
    w = z * z
    even = 0.19999999999999804 + w * (0.11111111105155447 + w * (0.07692296375032143 + w * (
        0.05878928997834775 + w * (0.04551593220626549 + w * 0.016285756855221028))))  # fmt: skip
    odd = -0.3333333333333333 + w * (-0.14285714285659828 + w * (-0.09090908753500877 + w * (
        -0.06666424885738255 + w * (-0.05230454270650244 + w * -0.034570561981427744))))  # fmt: skip
    p = z * (odd + z * even)
    angle = t + t * p
    angle = (0.7853981633974483 + (angle + 3.061616997868383e-17)) if steep else angle
    angle = (1.5707963267948966 - (angle - 6.123233995736766e-17)) if ay > ax else angle
    angle = (3.141592653589793 - (angle - 1.2246467991473532e-16)) if x < 0.0 else angle
    return math.copysign(angle, y)


@inline
def turn_remainder(x):
    """The angle less the whole turns nearest to it; every product and difference here is exact to ``FAR``."""
    turns = (x * (1.0 / TAU) + WHOLE) - WHOLE
    rest = (x - turns * TAU_HIGH) - turns * TAU_LOW
    rest = rest - TAU if rest > PI else rest
    rest = rest + TAU if rest < -PI else rest
    return rest if abs(x) <= FAR else math.nan


@inline
def _exp_parts(x):
    """2^k and e^r - 1 with x = k log 2 + r, |r| <= log(2)/2; the series' first term left out is r^14/14! < 5e-18."""
    shifted = x * 1.4426950408889634 + WHOLE
    k = shifted - WHOLE
    r = x - k * 6.93147180369123816490e-01
    r = r - k * 1.90821492927058770002e-10
    tail = r * r * (1 / 2 + r * (1 / 6 + r * (1 / 24 + r * (1 / 120 + r * (1 / 720 + r * (1 / 5040 + r * (
        1 / 40320 + r * (1 / 362880 + r * (1 / 3628800 + r * (1 / 39916800 + r * (
            1 / 479001600 + r * (1 / 6227020800))))))))))))  # fmt: skip
    scale = _float_of((_bits(shifted) + 1023) << 52)
    return (scale if abs(x) <= STEEP else math.nan), r + tail


@inline
def exp(x):
    """e^x."""
    scale, rest = _exp_parts(x)
    return scale + scale * rest


@inline
def expm1(x):
    """e^x - 1."""
    scale, rest = _exp_parts(x)
    return (scale - 1.0) + scale * rest


@inline
def _log_sum(x, rest):
    """log(x + rest) of a number and what its rounding lost: k log 2 + log m, m in [sqrt(1/2), sqrt 2).

    log m by s = (m - 1)/(m + 1).  [fdlibm]
    """
    bits = _bits(x)
    k = (bits - 4604544271217802189) >> 52  # the bits of sqrt(1/2)
    f = (_float_of(bits - (k << 52)) - 1.0) + rest * _float_of((1023 - k) << 52)
    s = f / (2.0 + f)
    z = s * s
    series = z * (6.666666666666735130e-01 + z * (3.999999999940941908e-01 + z * (2.857142874366239149e-01 + z * (
        2.222219843214978396e-01 + z * (1.818357216161805012e-01 + z * (
            1.531383769920937332e-01 + z * 1.479819860511658591e-01))))))  # fmt: skip
    half = 0.5 * f * f
    answer = k * 6.93147180369123816490e-01 - (
        (half - (s * (half + series) + k * 1.90821492927058770002e-10)) - f
    )  # fmt: skip
    return answer if 2.3e-308 < x < 1.7e308 else math.nan


@inline
def log(x):
    """Natural logarithm."""
    return _log_sum(x, 0.0)


@inline
def log1p(x):
    """log(1 + x): the logarithm of the rounded sum and of what the rounding lost."""
    total = 1.0 + x
    return _log_sum(total, (x - (total - 1.0)) if x < 1.0 else (1.0 - (total - x)))


@inline
def sinh(x):
    """(e^x - e^-x)/2 by expm1, odd."""
    grown = expm1(abs(x))
    return math.copysign(0.5 * (grown + grown / (1.0 + grown)), x)


@inline
def cosh(x):
    """(e^x + e^-x)/2."""
    grown = exp(x)
    return 0.5 * (grown + 1.0 / grown)


@inline
def tanh(x):
    """(e^2x - 1)/(e^2x + 1); 1 beyond 20, to 1e-17."""
    inner = 20.0 if x > 20.0 else (-20.0 if x < -20.0 else x)
    grown = expm1(2.0 * inner)
    return grown / (grown + 2.0)


@inline
def asinh(x):
    """log(x + sqrt(1 + x^2)), odd."""
    a = abs(x)
    return math.copysign(log1p(a + a * a / (1.0 + math.sqrt(1.0 + a * a))), x)


@inline
def atanh(x):
    """log((1 + x)/(1 - x))/2, odd."""
    a = abs(x)
    return math.copysign(0.5 * log1p(2.0 * a / (1.0 - a)), x)


@inline
def hypot(x, y):
    """sqrt(x^2 + y^2)."""
    square = x * x + y * y
    inside = 1e-280 < square < 1e300
    return math.sqrt(square if inside else (0.0 if x == 0.0 and y == 0.0 else math.nan))
