"""The fast primitives in single precision: twice as many numbers in a vector, half the memory.

The same texts as in double precision wherever there is one; their constants, and those of the laws, are rounded to
single precision, as a single constant of double precision would widen all that it meets. Sine, cosine and arc tangent
have shorter polynomials of their own, and a length has other bounds; the rest is worked out in double precision and
rounded.
"""

from __future__ import annotations

import math
from types import FunctionType

import numpy as np

from coplanar.engine.compiled import elementary
from coplanar.engine.compiled.elementary import inline

NAN = math.nan
FAR = 4000.0  # [rad] the reduction by pi/2 is exact to here


def in_single(function):
    """The function with its constants, and those it takes from its module, in single precision; compiled to melt."""
    constants = tuple(_narrow(c) for c in function.__code__.co_consts)
    names = {name: _narrow(value) for name, value in function.__globals__.items()}
    code = function.__code__.replace(co_consts=constants)
    narrow = FunctionType(code, names, function.__name__, function.__defaults__, function.__closure__)
    narrow.__qualname__ = function.__qualname__
    return inline(narrow)


def _narrow(value):
    with np.errstate(over="ignore"):  # what is beyond single precision is infinite there
        return np.float32(value) if type(value) is float else value


def _sincos(x):
    """Sine and cosine: reduction by pi/2 in three parts, then two polynomials.  [Cody and Waite 1980; Cephes]"""
    turns = (x * 0.6366197723675814 + 12582912.0) - 12582912.0  # 1.5 2^23: rounded to a whole number
    r = x - turns * 1.5703125
    r = r - turns * 4.837512969970703125e-4
    r = r - turns * 7.54978995489188216e-8
    z = r * r
    s = r + r * z * (-1.6666654611e-1 + z * (8.3321608736e-3 + z * -1.9515295891e-4))
    c = 1.0 - 0.5 * z + z * z * (4.166664568298827e-2 + z * (-1.388731625493765e-3 + z * 2.443315711809948e-5))
    quarter = np.int32(turns)
    odd = (quarter & np.int32(1)) != np.int32(0)
    sine = c if odd else s
    cosine = s if odd else c
    sine = -sine if (quarter & np.int32(2)) != np.int32(0) else sine
    cosine = -cosine if ((quarter + np.int32(1)) & np.int32(2)) != np.int32(0) else cosine
    far = not (abs(x) <= FAR)
    return (NAN if far else sine), (NAN if far else cosine)


def _atan2(y, x):
    """Angle of (x, y): atan t = t + t z P(z), z = t^2, |t| <= tan(pi/8).  [Cephes]

    NaN where the sum of the sides is no number or overflows, and at the origin: there the C library answers.
    """
    ay, ax = abs(y), abs(x)
    near, far = min(ax, ay), max(ax, ay)
    steep = near > 0.41421356237309503 * far
    t = (near - far if steep else near) / (near + far if steep else far) + 0.0 * (ax + ay)
    z = t * t
    p = z * (-3.33329491539e-1 + z * (1.99777106478e-1 + z * (-1.38776856032e-1 + z * 8.05374449538e-2)))
    angle = t + t * p
    angle = (0.7853981633974483 + angle) if steep else angle
    angle = (1.5707963267948966 - angle) if ay > ax else angle
    angle = (3.141592653589793 - angle) if x < 0.0 else angle
    return math.copysign(angle, y)


def _hypot(x, y):
    """sqrt(x^2 + y^2)."""
    square = x * x + y * y
    inside = 1e-30 < square < 1e37
    return math.sqrt(square if inside else (0.0 if x == 0.0 and y == 0.0 else NAN))


def _rounded(function):
    """The function of one number in double precision, and the answer rounded."""

    def in_double(x):
        return np.float32(function(np.float64(x)))

    in_double.__name__ = in_double.__qualname__ = f"single_{function.__name__}"
    return inline(in_double)


def elementary_functions(names):
    """The primitives of these names."""
    own = {"sincos": in_single(_sincos), "atan2": in_single(_atan2), "hypot": in_single(_hypot)}
    return {name: own[name] if name in own else _rounded(getattr(elementary, name)) for name in names}
