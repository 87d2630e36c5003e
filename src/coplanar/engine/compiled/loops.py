"""The loops: one text for every law, whatever it takes and returns.

Arrays come in tuples. Each input walks through memory by its own step, 1 for a full array and 0 for a scalar that was
spread over one block, so a law has one compiled loop whatever is scalar in a call. ``law`` and ``safe_law`` are names
that ``coplanar.engine.compiled.kernels`` supplies; the bodies below are templates and never run as they stand.
"""

from __future__ import annotations

from numba import prange, types
from numba.extending import overload

from coplanar.engine.compiled.primitives import FLAGS

BLOCK = 4096  # rows; a block of ten float64 columns is 320 KiB, which the second-level cache holds

_INLINE = {"forceinline": True, "fastmath": FLAGS}


def gather(columns, i):
    """Row ``i`` of the columns, as a tuple."""


@overload(gather, jit_options=_INLINE)
def _gather(columns, i):
    if len(columns) == 1:
        return lambda columns, i: (columns[0][i],)
    return lambda columns, i: (columns[0][i], *gather(columns[1:], i))


def scatter(columns, i, row):
    """Write a law's answer, a number or a tuple, into row ``i``; returns the sum of what was written."""


@overload(scatter, jit_options=_INLINE)
def _scatter(columns, i, row):
    if not isinstance(row, types.BaseTuple):

        def write(columns, i, row):
            columns[0][i] = row
            return row

    elif len(columns) == 1:

        def write(columns, i, row):
            columns[0][i] = row[0]
            return row[0]

    else:

        def write(columns, i, row):
            columns[0][i] = row[0]
            return row[0] + scatter(columns[1:], i, row[1:])

    return write


def inputs_from(columns, start, steps):
    """Every input from its own place on."""


@overload(inputs_from, jit_options=_INLINE)
def _inputs_from(columns, start, steps):
    if len(columns) == 1:
        return lambda columns, start, steps: (columns[0][start * steps[0] :],)
    return lambda columns, start, steps: (
        columns[0][start * steps[0] :],
        *inputs_from(columns[1:], start, steps[1:]),
    )


def outputs_from(columns, start, stop):
    """Rows ``start`` to ``stop`` of every output."""


@overload(outputs_from, jit_options=_INLINE)
def _outputs_from(columns, start, stop):
    if len(columns) == 1:
        return lambda columns, start, stop: (columns[0][start:stop],)
    return lambda columns, start, stop: (columns[0][start:stop], *outputs_from(columns[1:], start, stop))


def block(ins, outs, rows):
    """One block of rows: fast law for all, then the safe law for those that came out as NaN."""
    doubtful = 0
    for i in range(rows):
        check = scatter(outs, i, law(*gather(ins, i)))  # noqa: F821
        doubtful += 0 if check == check else 1  # NaN is what does not equal itself
    if doubtful:
        for i in range(rows):
            if _any_nan(outs, i):
                scatter(outs, i, safe_law(*gather(ins, i)))  # noqa: F821


def _any_nan(columns, i):
    """Whether row ``i`` holds a NaN."""


@overload(_any_nan, jit_options=_INLINE)
def _any_nan_overload(columns, i):
    if len(columns) == 1:
        return lambda columns, i: columns[0][i] != columns[0][i]
    return lambda columns, i: columns[0][i] != columns[0][i] or _any_nan(columns[1:], i)


def serial(ins, steps, outs, rows):
    """All blocks, one after another."""
    for b in range((rows + BLOCK - 1) // BLOCK):
        start = b * BLOCK
        stop = min(start + BLOCK, rows)
        block(inputs_from(ins, start, steps), outputs_from(outs, start, stop), stop - start)


def parallel(ins, steps, outs, rows):
    """All blocks, shared among threads."""
    for b in prange((rows + BLOCK - 1) // BLOCK):
        start = b * BLOCK
        stop = min(start + BLOCK, rows)
        block(inputs_from(ins, start, steps), outputs_from(outs, start, stop), stop - start)
