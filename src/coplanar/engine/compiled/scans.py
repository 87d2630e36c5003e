"""The loops of a scan: one text for every law that carries a state from step to step.

``law``, ``safe_law`` and the constants STATES, PATTERN, KEPT and ENDS are names that
``coplanar.engine.compiled.kernels`` supplies; the bodies are templates and never run as they stand. Rows (robots,
targets) are innermost, so that each step is vector code over a block of rows. The state of a block stays in a table in
the first-level cache, whose columns have ``WIDTH`` rows; what is kept is copied out of it after every step.

An input is either shared, one number per step, or own, one number per step and row; bit k of PATTERN says that input k
is own. Bit k of KEPT says that the output of entry k of the state holds it before the first step and after every step;
ENDS are the others, which hold the end alone.
"""

from __future__ import annotations

import numpy as np
from numba import prange

from coplanar.engine.compiled.columns import WIDTH, gather, merge, put, row, some, spill, total_of


def scan_block(initial, walk, shared, own, parameters, hold, outs, size, start, rows):
    """One block of rows from its initial state to the end; rows that show a NaN on the way are run again, safely."""
    count, width = size
    table, doubt = np.empty((STATES, WIDTH)), np.zeros(WIDTH)  # noqa: F821
    for i in range(rows):
        put(table, 0, i, gather(initial, walk, start, i))
    spill(outs, table, start, rows, KEPT)  # noqa: F821
    for k in range(count):
        common = row(shared, k, 0)
        mine = k * width + start
        for i in range(rows):
            inputs = merge(common, row(own, mine, i), PATTERN)  # noqa: F821
            now = law(*some(table, 0, i, STATES), *inputs, *gather(parameters, hold, start, i))  # noqa: F821
            put(table, 0, i, now)
            check = total_of(now)
            doubt[i] += check  # NaN, once there, stays
        spill(outs, table, mine + width, rows, KEPT)  # noqa: F821
    spill(outs, table, start, rows, ENDS)  # noqa: F821
    for i in range(rows):
        if doubt[i] != doubt[i]:
            scan_row(initial, walk, shared, own, parameters, hold, outs, size, start, i)


def scan_row(initial, walk, shared, own, parameters, hold, outs, size, start, i):
    """One row from its initial state to the end by the safe law."""
    count, width = size
    table = np.empty((STATES, WIDTH))  # noqa: F821
    constants = gather(parameters, hold, start, i)
    put(table, 0, 0, gather(initial, walk, start, i))
    spill(outs, table, start + i, 1, KEPT)  # noqa: F821
    for k in range(count):
        inputs = merge(row(shared, k, 0), row(own, k * width + start, i), PATTERN)  # noqa: F821
        put(table, 0, 0, safe_law(*some(table, 0, 0, STATES), *inputs, *constants))  # noqa: F821
        spill(outs, table, (k + 1) * width + start + i, 1, KEPT)  # noqa: F821
    spill(outs, table, start + i, 1, ENDS)  # noqa: F821


def scan_serial(initial, walk, shared, own, parameters, hold, outs, size):
    """All blocks, one after another."""
    width = size[1]
    for b in range((width + WIDTH - 1) // WIDTH):
        start = b * WIDTH
        scan_block(initial, walk, shared, own, parameters, hold, outs, size, start, min(WIDTH, width - start))


def scan_parallel(initial, walk, shared, own, parameters, hold, outs, size):
    """All blocks, shared among threads."""
    width = size[1]
    for b in prange((width + WIDTH - 1) // WIDTH):
        start = b * WIDTH
        scan_block(initial, walk, shared, own, parameters, hold, outs, size, start, min(WIDTH, width - start))


PARTS = (scan_row, scan_block)
