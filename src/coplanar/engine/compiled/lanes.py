"""Running sums along columns, a vector at a time: intrinsics beside those of ``coplanar.engine.compiled.columns``.

Each sum of a plain loop waits for the one before it. Here a vector's entries are summed among themselves, by pairs, by
fours, all, and only its total is waited for.
"""

from __future__ import annotations

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from coplanar.engine.compiled.columns import entry_of, pointer_to

LANES = 8  # numbers in the widest vectors, and in a line of the caches
_VECTOR, _LANE = ir.VectorType(ir.DoubleType(), LANES), ir.IntType(32)


@intrinsic
def sums(typing, table, column, i, total, begin):
    """``LANES`` entries of a column become ``begin`` plus the sums before each; returns the total after them."""

    def generate(context, builder, signature, arguments):
        source = entry_of(context, builder, arguments, signature.args[0], 0)
        return _running(builder, source, source, *arguments[3:])

    return types.float64(table, types.intp, types.intp, types.float64, types.float64), generate


@intrinsic
def sums_into(typing, columns, start, table, column, i, total, begin):
    """As ``sums``, but written from row ``start + i`` on into the one column."""

    def generate(context, builder, signature, arguments):
        place = builder.add(arguments[1], arguments[4])
        column = builder.extract_value(arguments[0], 0)
        target = pointer_to(context, builder, signature.args[0][0], column, place)
        source = entry_of(context, builder, arguments[2:], signature.args[2], 0)
        return _running(builder, source, target, *arguments[5:])

    index, number = types.intp, types.float64
    return number(columns, index, table, index, index, number, number), generate


def _running(builder, source, target, total, begin):
    """Write ``begin`` plus the sums before each entry of a vector; returns the total after it."""
    vector = builder.load(builder.bitcast(source, _VECTOR.as_pointer()), align=8)
    stride = 1
    while stride < LANES:
        vector = builder.fadd(vector, _later(builder, vector, stride))
        stride *= 2
    before = builder.fadd(_spread(builder, total), _later(builder, vector, 1))
    before = builder.fadd(_spread(builder, begin), before)
    builder.store(before, builder.bitcast(target, _VECTOR.as_pointer()), align=8)
    return builder.fadd(total, builder.extract_element(vector, _LANE(LANES - 1)))


def _later(builder, vector, count):
    """Every number so many lanes later; -0 before them, which no sum feels (0 would take a slower instruction)."""
    lanes = ir.Constant(ir.VectorType(_LANE, LANES), [LANES - count + k for k in range(LANES)])
    return builder.shuffle_vector(ir.Constant(_VECTOR, [-0.0] * LANES), vector, lanes)


def _spread(builder, number):
    """The number in every lane."""
    undefined = ir.Constant(_VECTOR, ir.Undefined)
    first = builder.insert_element(undefined, number, _LANE(0))
    return builder.shuffle_vector(first, undefined, ir.Constant(ir.VectorType(_LANE, LANES), [0] * LANES))
