"""The loops over rows: one text for every law, whatever it takes and returns.

Arrays come in tuples. Each input walks through memory by its own step: 1 for a full array, 0 for a number or a row of a
table that was repeated over one block, more for the column of a table. So a law has one compiled loop however the
arrays of a call lie, and one more where points are among them: bit k of PAIRS says that input k has step 2, and is read
where it lies. ``law``, ``safe_law``, PAIRS and FINITE (whether infinities count as NaN does) are names that
``coplanar.engine.compiled.kernels`` supplies; the bodies below are templates and never run as they stand.
"""

from __future__ import annotations

import numpy as np
from numba import prange

from coplanar.engine.compiled.columns import align_stack, scatter, sum_of
from coplanar.engine.compiled.door import numbers
from coplanar.engine.compiled.lines import each, lines, take

BLOCK = 4096  # rows at most; a block of ten float64 columns is 320 KiB, which the second-level cache holds
ROOM = BLOCK + 24  # columns whose addresses end alike would meet in the cache


def every(column, step, line, start, rows):
    """Every ``step``-th entry of a column, one after another."""
    for i in range(rows):
        line[i] = column[step * (start + i)]


def lay_out(ins, steps, room, start, rows):
    """The rows of the columns that lie apart in memory, one after another in the room."""
    slot = 0
    for k in range(len(ins)):
        if steps[k] > 1 and not PAIRS >> k & 1:  # noqa: F821
            every(ins[k], steps[k], room[slot], start, rows)
            slot += 1


def block(ins, steps, outs, start, rows):
    """One block of rows: fast law for all, then the safe law for those that came out as NaN.

    Returns how many are NaN even so, or with FINITE not finite.
    """
    align_stack()
    apart = 0
    for k in range(len(steps)):
        apart += 1 if steps[k] > 1 and not PAIRS >> k & 1 else 0  # noqa: F821
    room = np.empty((apart + 1, ROOM if apart else 1), ins[0].dtype)
    if apart:
        lay_out(ins, steps, room, start, rows)
    here = lines(ins, steps, room, start, PAIRS)  # noqa: F821
    left = 0
    if each(law, 0, here, outs, start, rows, PAIRS, FINITE):  # noqa: F821
        for i in range(rows):
            check = sum_of(outs, start, i)
            if check != check:  # NaN is what does not equal itself
                check = scatter(outs, start, i, safe_law(*take(here, i, PAIRS)))  # noqa: F821
            left += 0 if check - check == 0.0 or (check == check and not FINITE) else 1  # noqa: F821
    return left


def rows_one(inputs):
    """One row of Python floats."""
    return safe_law(*numbers(inputs))  # noqa: F821


def rows_serial(ins, steps, outs, rows, size):
    """All blocks of so many rows, one after another; returns what they return, summed."""
    left = 0
    for b in range((rows + size - 1) // size):
        start = b * size
        left += block(ins, steps, outs, start, min(size, rows - start))
    return left


def rows_parallel(ins, steps, outs, rows, size):
    """All blocks of so many rows, shared among threads; returns what they return, summed."""
    left = 0
    for b in prange((rows + size - 1) // size):
        start = b * size
        left += block(ins, steps, outs, start, min(size, rows - start))
    return left


PARTS = (every, lay_out, block)
