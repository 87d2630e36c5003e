"""A sweep: one step of a law over a block of rows whose state stays in the first-level cache.

A step is a chain of operations that wait for one another, a hundred cycles long, and a processor looks ahead over no
more than two or three of them. So several vectors of rows are worked on side by side. The compiler does that if it sees
that nothing written is read by another row: hence columns on the stack, each apart from all others.
"""

from __future__ import annotations

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from coplanar.engine.compiled.abreast import abreast, is_nan
from coplanar.engine.compiled.columns import LINE, WIDTH, pointer_to

STEPS = 4  # vectors of a law that steps, side by side
TOGETHER = 32  # rows of so many of the widest vectors: whole ones leave no rest, which would be done one by one
MOST_ROWS = 256  # of a block: as many whole ones as a column holds

_NUMBER, _PLACE = ir.DoubleType(), ir.IntType(64)


@intrinsic(prefer_literal=True)
def apart(typing, count):
    """As many columns of ``WIDTH`` numbers on the stack, each of whole lines of the cache; the count is a literal."""
    answer = types.UniTuple(types.CPointer(types.float64), count.literal_value)

    def generate(context, builder, signature, arguments):
        columns = []
        for _ in range(count.literal_value):
            column = cgutils.alloca_once(builder, ir.ArrayType(_NUMBER, WIDTH))
            column.align = 8 * LINE
            columns.append(builder.bitcast(column, _NUMBER.as_pointer()))
        return context.make_tuple(builder, signature.return_type, columns)

    return answer(count), generate


@intrinsic
def read(typing, columns, i):
    """Row ``i`` of columns that stand apart, as a tuple."""
    answer = types.UniTuple(types.float64, len(columns))

    def generate(context, builder, signature, arguments):
        values = [builder.load(place) for place in _places(builder, *arguments)]
        return context.make_tuple(builder, signature.return_type, values)

    return answer(columns, types.intp), generate


@intrinsic
def write(typing, columns, i, row):
    """Write a tuple as row ``i`` of columns that stand apart."""

    def generate(context, builder, signature, arguments):
        columns, index, given = arguments
        _write(context, builder, _places(builder, columns, index), cgutils.unpack_tuple(builder, given), row)
        return context.get_dummy_value()

    return types.void(columns, types.intp, row), generate


@intrinsic
def shows_nan(typing, columns, i):
    """Whether a number of row ``i`` is NaN (or infinities cancel)."""

    def generate(context, builder, signature, arguments):
        return is_nan(builder, [builder.load(place) for place in _places(builder, *arguments)])

    return types.boolean(columns, types.intp), generate


@intrinsic(prefer_literal=True)
def sweep(typing, law, state, shared, own, start, parameters, rows, pattern):
    """``state = law(*state, *inputs, *parameters)`` on the first rows; returns in how many of them a NaN shows.

    The inputs are numbers shared by all rows and row ``start + i`` of the own ones, in the order of the pattern: bit k
    says that input k is own.
    """
    bits = [bool(pattern.literal_value >> k & 1) for k in range(len(shared) + len(own))]
    called = law.get_call_type(typing, (types.float64,) * (len(state) + len(bits) + len(parameters)), {})

    def generate(context, builder, signature, arguments):
        _, columns, numbers, tables, begin, constants, count, _ = arguments
        step = context.get_function(law, called)
        with abreast(builder, count, STEPS) as (index, show, _):
            places = _places(builder, columns, index)
            given = {False: iter(cgutils.unpack_tuple(builder, numbers)),
                     True: iter(_row(context, builder, own, tables, builder.add(begin, index)))}  # fmt: skip
            held = [builder.load(place) for place in _places(builder, constants, index)]
            now = step(builder, [*map(builder.load, places), *(next(given[bit]) for bit in bits), *held])
            written = _write(context, builder, places, cgutils.unpack_tuple(builder, now), called.return_type)
            shown = show(is_nan(builder, written))
        return builder.load(shown)

    return types.intp(law, state, shared, own, types.intp, parameters, types.intp, pattern), generate


@intrinsic(prefer_literal=True)
def spill(typing, outs, columns, start, rows, pattern, large):
    """Copy the first rows of columns to ``start`` in the outputs; bit k of the pattern asks for column k.

    Large: the outputs are more than the caches hold, and are written past them.
    """
    chosen = [k for k in range(len(outs)) if pattern.literal_value >> k & 1]

    def generate(context, builder, signature, arguments):
        targets, sources, place, count, _, past = arguments
        pairs = [
            (pointer_to(context, builder, outs[k], builder.extract_value(targets, k), place),
             builder.extract_value(sources, k)) for k in chosen
        ]  # fmt: skip
        with builder.if_else(builder.trunc(past, ir.IntType(1))) as (is_large, is_small):
            with is_large:
                for target, source in pairs:
                    _stream(builder, target, source, count)
            with is_small:
                for target, source in pairs:
                    cgutils.raw_memcpy(builder, target, source, count, 8)
        return context.get_dummy_value()

    return types.void(outs, columns, types.intp, types.intp, pattern, types.boolean), generate


def _places(builder, columns, index):
    return [builder.gep(column, [index]) for column in cgutils.unpack_tuple(builder, columns)]


def _row(context, builder, kinds, columns, place):
    """The numbers at a place of arrays."""
    arrays = zip(kinds, cgutils.unpack_tuple(builder, columns), strict=True)
    return [builder.load(pointer_to(context, builder, kind, column, place)) for kind, column in arrays]


def _write(context, builder, places, values, kinds):
    """Store a law's answer; returns it as the numbers that are stored."""
    numbers = [context.cast(builder, v, kind, types.float64) for v, kind in zip(values, kinds, strict=True)]
    for place, number in zip(places, numbers, strict=True):
        builder.store(number, place)
    return numbers


def _stream(builder, target, source, count):
    """Copy numbers past the caches by whole lines: nothing is fetched that is about to be overwritten."""
    line, one = ir.VectorType(_NUMBER, LINE), ir.IntType(32)(1)
    past_line = builder.and_(builder.lshr(builder.ptrtoint(target, _PLACE), _PLACE(3)), _PLACE(LINE - 1))
    head = builder.and_(builder.sub(_PLACE(LINE), past_line), _PLACE(LINE - 1))
    head = builder.select(builder.icmp_signed("<", head, count), head, count)
    lines = builder.lshr(builder.sub(count, head), _PLACE(3))
    _copy(builder, target, source, _PLACE(0), head)
    with cgutils.for_range(builder, lines) as loop:
        here, there = (
            builder.bitcast(builder.gep(p, [builder.add(head, builder.mul(loop.index, _PLACE(LINE)))]),
                            line.as_pointer()) for p in (source, target)
        )  # fmt: skip
        stored = builder.store(builder.load(here, align=8), there, align=8 * LINE)
        stored.set_metadata("nontemporal", builder.module.add_metadata([one]))
    _copy(builder, target, source, builder.add(head, builder.mul(lines, _PLACE(LINE))), count)


def _copy(builder, target, source, first, last):
    with cgutils.for_range_slice(builder, first, last, _PLACE(1), intp=_PLACE) as (index, _):
        builder.store(builder.load(builder.gep(source, [index])), builder.gep(target, [index]))
