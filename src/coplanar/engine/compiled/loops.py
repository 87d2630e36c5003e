"""The loops over rows: one text for every law, whatever it takes and returns.

Arrays come in tuples. Each input walks through memory by its own step, 1 for a full array and 0 for a scalar that was
spread over one block, so a law has one compiled loop whatever is scalar in a call. ``law`` and ``safe_law`` are names
that ``coplanar.engine.compiled.kernels`` supplies; the bodies below are templates and never run as they stand.
"""

from __future__ import annotations

from numba import prange

from coplanar.engine.compiled.columns import gather, scatter, sum_of
from coplanar.engine.compiled.door import numbers

BLOCK = 4096  # rows; a block of ten float64 columns is 320 KiB, which the second-level cache holds


def block(ins, steps, outs, start, rows):
    """One block of rows: fast law for all, then the safe law for those that came out as NaN."""
    doubtful = 0
    for i in range(rows):
        check = scatter(outs, start, i, law(*gather(ins, steps, start, i)))  # noqa: F821
        doubtful += 0 if check == check else 1  # NaN is what does not equal itself
    if doubtful:
        for i in range(rows):
            check = sum_of(outs, start, i)
            if check != check:
                scatter(outs, start, i, safe_law(*gather(ins, steps, start, i)))  # noqa: F821


def rows_one(inputs):
    """One row of Python floats."""
    return safe_law(*numbers(inputs))  # noqa: F821


def rows_serial(ins, steps, outs, rows):
    """All blocks, one after another."""
    for b in range((rows + BLOCK - 1) // BLOCK):
        start = b * BLOCK
        block(ins, steps, outs, start, min(BLOCK, rows - start))


def rows_parallel(ins, steps, outs, rows):
    """All blocks, shared among threads."""
    for b in prange((rows + BLOCK - 1) // BLOCK):
        start = b * BLOCK
        block(ins, steps, outs, start, min(BLOCK, rows - start))


PARTS = (block,)
