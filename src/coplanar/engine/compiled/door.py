"""The door of a compiled function of one row: Python floats come in, anything else is refused by a TypeError.

Numba asks every argument of every call for its type. Here the types are settled beforehand, so that a call costs little
more than one of a function in C; what is left to ask, whether each number is a float, is asked in machine code.
"""

from __future__ import annotations

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import NativeValue, intrinsic, models, register_model, unbox


class _Float(types.Type):
    """A Python float, and nothing that could become one."""


FLOAT = _Float(name="PythonFloat")


@register_model(_Float)
class _Model(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, ir.DoubleType())


@unbox(_Float)
def _unbox(kind, given, c):
    wanted = c.pyapi.get_c_object("PyFloat_Type")
    found = c.pyapi.get_type(given)
    fits = c.builder.icmp_unsigned("==", found, c.builder.bitcast(wanted, found.type))
    number = cgutils.alloca_once_value(c.builder, ir.Constant(ir.DoubleType(), 0.0))
    with c.builder.if_else(fits, likely=True) as (then, otherwise):
        with then:
            c.builder.store(c.pyapi.float_as_double(given), number)
        with otherwise:
            c.pyapi.err_set_string("PyExc_TypeError", "a number that is no float")
    return NativeValue(c.builder.load(number), is_error=c.builder.not_(fits))


@intrinsic
def numbers(typing, row):
    """The row as numbers to reckon with."""
    answer = types.UniTuple(types.float64, len(row))
    return answer(row), lambda context, builder, signature, arguments: arguments[0]


def row_of(count):
    """The type of a tuple of so many Python floats."""
    return types.UniTuple(FLOAT, count)
