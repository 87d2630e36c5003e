"""A law over a block of rows whose inputs lie as they like: intrinsics beside those of ``columns``.

The pattern of pairs says by bit k that line k is every other entry of memory, as a coordinate in a table of points.
"""

from __future__ import annotations

from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from coplanar.engine.compiled.abreast import abreast, is_nan, is_not_finite
from coplanar.engine.compiled.columns import entry_of, pointer_to, reached

SIDE_BY_SIDE = 2  # vectors; of more of them the numbers on the way find no room in the registers


@intrinsic(prefer_literal=True)
def lines(typing, columns, steps, room, start, pairs):
    """Where the rows from ``start`` on begin in each column, one after another: a tuple of pointers.

    Columns of step 1 are read where they are, numbers (step 0) where they were spread, and columns of step 2 where they
    are if the pattern of pairs has their bit set; others are laid out in the room.
    """
    answer = types.Tuple([types.CPointer(column.dtype) for column in columns])

    def generate(context, builder, signature, arguments):
        table, walk, space, begin, _ = arguments
        zero, one = (begin.type(number) for number in (0, 1))
        shelf = context.make_array(signature.args[2])(context, builder, space)
        slot, pointers = zero, []
        for k, kind in enumerate(signature.args[0]):
            step = builder.extract_value(walk, k)
            there = pointer_to(context, builder, kind, builder.extract_value(table, k), builder.mul(begin, step))
            if not _bit(pairs, k):
                apart = builder.icmp_unsigned(">", step, one)
                corner = [slot, zero]
                laid = cgutils.get_item_pointer(context, builder, signature.args[2], shelf, corner, wraparound=False)
                there = builder.select(apart, laid, there)
                slot = builder.add(slot, builder.zext(apart, slot.type))
            pointers.append(there)
        return context.make_tuple(builder, signature.return_type, pointers)

    return answer(columns, steps, room, types.intp, pairs), generate


def _bit(pattern, k):
    return bool(pattern.literal_value >> k & 1)


@intrinsic(prefer_literal=True)
def take(typing, lines, i, pairs):
    """Entry ``i`` of every line, as a tuple; entry ``2 i`` where the pattern of pairs has the line's bit set."""
    answer = types.Tuple([line.dtype for line in lines])

    def generate(context, builder, signature, arguments):
        given, place, _ = arguments
        return context.make_tuple(builder, signature.return_type, taken(builder, given, place, pairs))

    return answer(lines, types.intp, pairs), generate


def taken(builder, lines, place, pairs):
    """What ``take`` reads. Steps that are constant, and known not to wrap, make vector code."""
    twice = builder.mul(place, place.type(2), flags=("nsw", "nuw"))
    pointers = cgutils.unpack_tuple(builder, lines)
    places = [twice if _bit(pairs, k) else place for k in range(len(pointers))]
    return [builder.load(builder.gep(p, [i], inbounds=True)) for p, i in zip(pointers, places, strict=True)]


@intrinsic
def along(typing, table, column, i, ins, strides, paces, row, first):
    """Where a column of a table from entry ``i`` on, and what ``reach`` reads from ``first`` on, are: pointers."""
    answer = types.Tuple([types.CPointer(kind.dtype) for kind in (table, *ins)])

    def generate(context, builder, signature, arguments):
        zero = arguments[2].type(0)
        head = entry_of(context, builder, arguments, signature.args[0], 0)
        places = reached(builder, [*arguments[3:], zero])
        columns = zip(signature.args[3], cgutils.unpack_tuple(builder, arguments[3]), places, strict=True)
        rest = [pointer_to(context, builder, kind, column, place) for kind, column, place in columns]
        return context.make_tuple(builder, signature.return_type, [head, *rest])

    index = types.intp
    return answer(table, index, index, ins, strides, paces, index, index), generate


@intrinsic(prefer_literal=True)
def each(typing, law, zeros, lines, outs, start, rows, pairs, finite):
    """``outs = law(0, ..., *lines)`` on the first rows of the lines, written from ``start`` on.

    Returns in how many rows a NaN shows. The law is given as many zeros first, and asked for as many results as there
    are outs. The pattern of pairs is that of ``take``. With ``finite`` infinities count as NaN does.
    """
    given = (types.float64,) * zeros.literal_value + tuple(line.dtype for line in lines)
    called = law.get_call_type(typing, given, {})
    kinds = called.return_type.types if isinstance(called.return_type, types.BaseTuple) else (called.return_type,)

    def generate(context, builder, signature, arguments):
        _, _, pointers, columns, begin, count, _, _ = arguments
        law_of_row = context.get_function(law, called)
        is_in_doubt = is_not_finite if finite.literal_value else is_nan
        first = [context.get_constant(types.float64, 0.0)] * zeros.literal_value
        with abreast(builder, count, SIDE_BY_SIDE) as (index, show, mark):
            answer = law_of_row(builder, [*first, *map(mark, taken(builder, pointers, index, pairs))])
            many = isinstance(called.return_type, types.BaseTuple)
            place, written = builder.add(begin, index), []
            for k, out in enumerate(outs):
                value = builder.extract_value(answer, k) if many else answer
                written.append(context.cast(builder, value, kinds[k], out.dtype))
                there = pointer_to(context, builder, out, builder.extract_value(columns, k), place)
                mark(builder.store(written[-1], there))
            shown = show(is_in_doubt(builder, written))
        return builder.load(shown)

    return types.intp(law, zeros, lines, outs, types.intp, types.intp, pairs, finite), generate
