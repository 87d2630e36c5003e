"""Rows of columns: read and write one row across a tuple of arrays.

Written as intrinsics (a few lines of code generation each) because a tuple of arrays has a type of its own for every
law: by Numba's usual means each would be compiled entry by entry, and that would be most of the first call's wait.
"""

from __future__ import annotations

from numba import types
from numba.core import cgutils
from numba.extending import intrinsic


def _pointer(context, builder, kind, column, place):
    array = context.make_array(kind)(context, builder, column)
    return cgutils.get_item_pointer(context, builder, kind, array, [place], wraparound=False)


def _read(context, builder, kinds, columns, places):
    values = []
    for k, (kind, place) in enumerate(zip(kinds, places, strict=True)):
        pointer = _pointer(context, builder, kind, builder.extract_value(columns, k), place)
        values.append(context.unpack_value(builder, kind.dtype, pointer))
    return values


@intrinsic
def row(typing, columns, start, i):
    """Row ``start + i`` of the columns, as a tuple."""
    answer = types.Tuple([column.dtype for column in columns])

    def generate(context, builder, signature, arguments):
        place = builder.add(arguments[1], arguments[2])
        values = _read(context, builder, signature.args[0], arguments[0], [place] * len(columns))
        return context.make_tuple(builder, signature.return_type, values)

    return answer(columns, types.intp, types.intp), generate


@intrinsic
def gather(typing, columns, steps, start, i):
    """Row ``start * step + i`` of the columns, each with a step of its own, as a tuple."""
    answer = types.Tuple([column.dtype for column in columns])

    def generate(context, builder, signature, arguments):
        table, walk, begin, index = arguments
        bases = [builder.mul(begin, builder.extract_value(walk, k)) for k in range(len(columns))]
        places = [builder.add(base, index) for base in bases]
        values = _read(context, builder, signature.args[0], table, places)
        return context.make_tuple(builder, signature.return_type, values)

    return answer(columns, steps, types.intp, types.intp), generate


@intrinsic(prefer_literal=True)
def merge(typing, shared, own, pattern):
    """One tuple out of two: bit k of the pattern says that entry k comes from ``own``."""
    bits = [bool(pattern.literal_value >> k & 1) for k in range(len(shared) + len(own))]
    kinds = {False: iter(shared), True: iter(own)}
    answer = types.Tuple([next(kinds[bit]) for bit in bits])

    def generate(context, builder, signature, arguments):
        counts = {False: 0, True: 0}
        values = []
        for bit in bits:
            values.append(builder.extract_value(arguments[bit], counts[bit]))
            counts[bit] += 1
        return context.make_tuple(builder, signature.return_type, values)

    return answer(shared, own, pattern), generate


@intrinsic
def scatter(typing, columns, start, i, row):
    """Write a law's answer, a number or a tuple, as row ``i`` after ``start``; returns the sum of what was written."""
    kinds = row.types if isinstance(row, types.BaseTuple) else (row,)

    def generate(context, builder, signature, arguments):
        table, begin, index, answer = arguments
        place = builder.add(begin, index)
        total = None
        for k, (kind, given) in enumerate(zip(signature.args[0], kinds, strict=True)):
            value = builder.extract_value(answer, k) if isinstance(row, types.BaseTuple) else answer
            value = context.cast(builder, value, given, kind.dtype)
            pointer = _pointer(context, builder, kind, builder.extract_value(table, k), place)
            context.pack_value(builder, kind.dtype, value, pointer)
            total = value if total is None else builder.fadd(total, value)
        return total

    return columns[0].dtype(columns, types.intp, types.intp, row), generate


@intrinsic
def sum_of(typing, columns, start, i):
    """Sum of row ``i`` after ``start``: NaN if an entry is NaN (or infinities cancel)."""

    def generate(context, builder, signature, arguments):
        place = builder.add(arguments[1], arguments[2])
        values = _read(context, builder, signature.args[0], arguments[0], [place] * len(columns))
        total = values[0]
        for value in values[1:]:
            total = builder.fadd(total, value)
        return total

    return columns[0].dtype(columns, types.intp, types.intp), generate
