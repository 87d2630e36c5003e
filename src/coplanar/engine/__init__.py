"""How a law is evaluated. A law imports its primitives from here; a thing imports ``evaluator``."""

from coplanar.engine.arrays import (
    PI,
    TAU,
    absolute,
    asinh,
    atan,
    atan2,
    atanh,
    copysign,
    cos,
    cosh,
    dsinc,
    exp,
    expm1,
    floor,
    hypot,
    integrate,
    log,
    log1p,
    maximum,
    minimum,
    nearest,
    sin,
    sinc,
    sincos,
    sinh,
    sqrt,
    tan,
    tanh,
    where,
)
from coplanar.engine.evaluator import Evaluator, can_compile, evaluator
from coplanar.engine.foreign import components, is_foreign, namespace_of, stack

__all__ = [
    "PI", "TAU", "Evaluator", "absolute", "asinh", "atan", "atan2", "atanh", "can_compile", "components", "copysign", "cos", "cosh",
    "dsinc", "evaluator", "exp", "expm1", "floor", "hypot", "integrate", "is_foreign", "log", "log1p", "maximum", "minimum",
    "namespace_of", "nearest", "sin", "sinc", "sincos", "sinh", "sqrt", "stack", "tan", "tanh", "where",
]  # fmt: skip
