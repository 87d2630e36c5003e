"""Rows of columns: read and write one row across a tuple of arrays.

Written as intrinsics (a few lines of code generation each) because a tuple of arrays has a type of its own for every
law: by Numba's usual means each would be compiled entry by entry, and that would be most of the first call's wait.
"""

from __future__ import annotations

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, register_jitable

from coplanar.engine.compiled.abreast import sum_in_pairs

WIDTH = 264  # rows of a table: 64 columns of them are 128 KiB, which the second-level cache holds
LINE = 8  # numbers in a line of the cache


@register_jitable
def table_of(columns):
    """A table of so many columns with no values yet, each of them whole lines of the cache."""
    whole = np.empty(columns * WIDTH + LINE - 1)
    first = -(whole.ctypes.data >> 3) & (LINE - 1)
    return whole[first : first + columns * WIDTH].reshape((columns, WIDTH))


def pointer_to(context, builder, kind, column, place):
    """Where an entry of a column is."""
    array = context.make_array(kind)(context, builder, column)
    return cgutils.get_item_pointer(context, builder, kind, array, [place], wraparound=False)


def _read(context, builder, kinds, columns, places):
    values = []
    for k, (kind, place) in enumerate(zip(kinds, places, strict=True)):
        pointer = pointer_to(context, builder, kind, builder.extract_value(columns, k), place)
        values.append(context.unpack_value(builder, kind.dtype, pointer))
    return values


@intrinsic
def align_stack(typing):
    """Have the function's stack begin at a whole line of the cache, so that no vector kept there lies across two."""

    def generate(context, builder, signature, arguments):
        builder.function.attributes.alignstack = 8 * LINE
        builder.function.attributes.add("noinline")
        return context.get_dummy_value()

    return types.void(), generate


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
def pick(typing, columns, steps, i):
    """Row ``i`` of the columns, each with a step of its own, as a tuple."""
    answer = types.Tuple([column.dtype for column in columns])

    def generate(context, builder, signature, arguments):
        table, walk, index = arguments
        places = [builder.mul(index, builder.extract_value(walk, k)) for k in range(len(columns))]
        values = _read(context, builder, signature.args[0], table, places)
        return context.make_tuple(builder, signature.return_type, values)

    return answer(columns, steps, types.intp), generate


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


@intrinsic
def reach(typing, columns, strides, paces, row, begin, i):
    """Entry ``row * stride + begin * pace + i`` of the columns, each with its own stride and pace, as a tuple."""
    answer = types.Tuple([column.dtype for column in columns])

    def generate(context, builder, signature, arguments):
        values = _read(context, builder, signature.args[0], arguments[0], reached(builder, arguments))
        return context.make_tuple(builder, signature.return_type, values)

    return answer(columns, strides, paces, types.intp, types.intp, types.intp), generate


@intrinsic
def fetch(typing, columns, strides, paces, row, begin, i):
    """Ask for what ``reach`` will read; nothing waits for it."""

    def generate(context, builder, signature, arguments):
        _ask(context, builder, signature.args[0], arguments[0], reached(builder, arguments), 0)
        return context.get_dummy_value()

    return types.void(columns, strides, paces, types.intp, types.intp, types.intp), generate


@intrinsic
def claim(typing, columns, start, i):
    """Ask for what ``scatter`` will write; nothing waits for it."""

    def generate(context, builder, signature, arguments):
        places = [builder.add(arguments[1], arguments[2])] * len(columns)
        _ask(context, builder, signature.args[0], arguments[0], places, 1)
        return context.get_dummy_value()

    return types.void(columns, types.intp, types.intp), generate


def reached(builder, arguments):
    """Where ``reach`` reads."""
    _, by_row, by_step, which, first, index = arguments
    places = []
    for k in range(by_row.type.count):
        base = builder.mul(which, builder.extract_value(by_row, k))
        base = builder.add(base, builder.mul(first, builder.extract_value(by_step, k)))
        places.append(builder.add(base, index))
    return places


def _ask(context, builder, kinds, columns, places, writing):
    """Lines of the caches, to be read or written soon."""
    address, number = ir.IntType(8).as_pointer(), ir.IntType(32)
    kind = ir.FunctionType(ir.VoidType(), [address, number, number, number])
    ask = builder.module.declare_intrinsic("llvm.prefetch", [address], kind)
    for k, (column, place) in enumerate(zip(kinds, places, strict=True)):
        pointer = pointer_to(context, builder, column, builder.extract_value(columns, k), place)
        builder.call(ask, [builder.bitcast(pointer, address), number(writing), number(3), number(1)])


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
        written = []
        for k, (kind, given) in enumerate(zip(signature.args[0], kinds, strict=True)):
            value = builder.extract_value(answer, k) if isinstance(row, types.BaseTuple) else answer
            value = context.cast(builder, value, given, kind.dtype)
            pointer = pointer_to(context, builder, kind, builder.extract_value(table, k), place)
            context.pack_value(builder, kind.dtype, value, pointer)
            written.append(value)
        return sum_in_pairs(builder, written)

    return columns[0].dtype(columns, types.intp, types.intp, row), generate


@intrinsic
def sum_of(typing, columns, start, i):
    """Sum of row ``i`` after ``start``: NaN if an entry is NaN (or infinities cancel)."""

    def generate(context, builder, signature, arguments):
        place = builder.add(arguments[1], arguments[2])
        return sum_in_pairs(builder, _read(context, builder, signature.args[0], arguments[0], [place] * len(columns)))

    return columns[0].dtype(columns, types.intp, types.intp), generate


@intrinsic
def get(typing, table, column, i):
    """Entry ``i`` of a column of a table of shape (columns, ``WIDTH``)."""

    def generate(context, builder, signature, arguments):
        pointer = entry_of(context, builder, arguments, signature.args[0], 0)
        return context.unpack_value(builder, signature.args[0].dtype, pointer)

    return table.dtype(table, types.intp, types.intp), generate


@intrinsic(prefer_literal=True)
def some(typing, table, column, i, count):
    """Entries ``i`` of as many columns, from this one on, as a tuple; the count is a literal."""
    answer = types.UniTuple(table.dtype, count.literal_value)

    def generate(context, builder, signature, arguments):
        kind = signature.args[0]
        pointers = [entry_of(context, builder, arguments, kind, k) for k in range(count.literal_value)]
        values = [context.unpack_value(builder, kind.dtype, pointer) for pointer in pointers]
        return context.make_tuple(builder, signature.return_type, values)

    return answer(table, types.intp, types.intp, count), generate


@intrinsic
def put(typing, table, column, i, value):
    """Write a number as entry ``i`` of a column of such a table, or a tuple into the columns from this one on."""
    many = isinstance(value, types.BaseTuple)

    def generate(context, builder, signature, arguments):
        kind, given = signature.args[0], arguments[3]
        for k in range(len(value) if many else 1):
            number = builder.extract_value(given, k) if many else given
            number = context.cast(builder, number, value[k] if many else value, kind.dtype)
            context.pack_value(builder, kind.dtype, number, entry_of(context, builder, arguments, kind, k))
        return context.get_dummy_value()

    return types.void(table, types.intp, types.intp, value), generate


def entry_of(context, builder, arguments, kind, further):
    """Where it is. That columns are ``WIDTH`` apart is known to the compiler, which then sees that they do not meet."""
    table, column, i = arguments[:3]
    array = context.make_array(kind)(context, builder, table)
    first = builder.add(builder.mul(column, context.get_constant(types.intp, WIDTH)), i)
    place = builder.add(first, context.get_constant(types.intp, further * WIDTH))
    return builder.gep(array.data, [place])
