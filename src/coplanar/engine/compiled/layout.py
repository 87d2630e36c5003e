"""How arrays lie: as the columns that loops read, and in parts where they do not lie as a column."""

from __future__ import annotations

import math

import numpy as np

from coplanar.engine.compiled import loops


def part(column, step, piece, space):
    """A piece of an input as a column of the input's step: where it lies, or in a space that it may fill."""
    if step is None:
        return laid_out(piece, space)
    return read_only(piece if step == 1 else piece[(slice(1),) * piece.ndim]) if step else column


def laid_out(piece, space):
    """The piece in a row, in a space that it may fill."""
    column = space[: piece.size]
    column.reshape(piece.shape)[...] = piece
    return read_only(column)


def slabs(shape, most):
    """Indices that cut an array into pieces of ``most`` rows or fewer, one after another as they lie in memory."""
    axis = next(k for k in range(len(shape)) if math.prod(shape[k + 1 :]) <= most)
    length = most // math.prod(shape[axis + 1 :])
    for outer in np.ndindex(shape[:axis]):
        for first in range(0, shape[axis], length):
            yield (*outer, slice(first, first + length))


def column(array, shape, rows):
    """The array as a flat column and its step; None and None where it has to be spread first.

    All columns are read-only, so that a loop is compiled once whether or not the caller's arrays are.
    """
    if not array.ndim and shape:
        return read_only(spread(array, min(rows, loops.BLOCK))), 0
    layout = array.flags
    if array.shape == shape and layout.aligned:
        if layout.c_contiguous:
            return read_only(array), 1
        if step := even_step(array):
            return read_only(array[(slice(1),) * array.ndim]), step
    if array.size and not any(s for s, n in zip(array.strides, array.shape, strict=True) if n > 1):
        return read_only(spread(array, min(rows, loops.BLOCK))), 0
    return None, None


def columns(inputs, shape):
    """The inputs as columns, and their steps."""
    rows = math.prod(shape)
    return tuple(zip(*[column(a, shape, rows) for a in inputs], strict=True))


def repeated(inputs, ready, shape):
    """As ``columns``, but those that repeat themselves have step 0 like a number; and the rows of a block.

    Such an input is laid out for one block. A block is whole periods of all of them, so that each begins with it.
    """
    ins, steps = ready
    periods = [1 if step is not None else period(a, shape) for a, step in zip(inputs, steps, strict=True)]
    common = math.lcm(*periods)
    if not 1 < common <= loops.BLOCK:
        return ready, loops.BLOCK
    block = loops.BLOCK // common * common
    count = min(block, math.prod(shape))
    filled = [
        read_only(np.resize(a[(0,) * (a.ndim - tail(a, shape))], count)) if column is None else column
        for column, a in zip(ins, inputs, strict=True)
    ]
    return (tuple(filled), tuple(step or 0 for step in steps)), block


def period(array, shape):
    """After how many rows the entries come again, as one row does for a whole table; 0 if they do not."""
    axes = tail(array, shape)
    return math.prod(shape[len(shape) - axes :]) if axes else 0


def tail(array, shape):
    """How many of the last axes the array has in full, if it is the same along all others; else 0."""
    spread = 0
    while spread < array.ndim and (array.shape[spread] == 1 or array.strides[spread] == 0):
        spread += 1
    axes = array.ndim - spread
    return axes if array.shape[spread:] == shape[len(shape) - axes :] else 0


def even_step(array):
    """How many entries a row lies after the one before, where that is one number of at least 2; else 0."""
    step, rest = divmod(array.strides[-1], array.itemsize)
    even = [s == n * inner for s, n, inner in zip(array.strides[:-1], array.shape[1:], array.strides[1:], strict=True)]
    return step if step > 1 and not rest and all(even) else 0


def spread(array, count):
    """The one number of an array so many times."""
    column = np.empty(count, array.dtype)
    column.fill(array.flat[0])
    return column


def read_only(array):
    """The entries in a row, not to be written."""
    column = array.ravel()
    column.setflags(False)
    return column


def may_be_written(out, inputs):
    """Whether the loop can write into ``out`` itself: a row may be read again after it was written."""
    return out.flags.c_contiguous and out.flags.aligned and not any(np.may_share_memory(out, a) for a in inputs)
