"""The loops of a scan: one text for every law that carries a state from step to step.

``law``, ``safe_law`` and the constants STATES, FIXED, PATTERN, KEPT and ENDS are names that
``coplanar.engine.compiled.kernels`` supplies; the bodies are templates and never run as they stand. Rows (robots,
targets) are innermost, so that each step is vector code over a block of rows. The state and the parameters of a block
stay in columns in the first-level cache; what is kept is copied out of them after every step.

An input is either shared, one number per step, or own, one number per step and row; bit k of PATTERN says that input k
is own. Bit k of KEPT says that the output of entry k of the state holds it before the first step and after every step;
ENDS are the others, which hold the end alone.
"""

from __future__ import annotations

import numpy as np
from numba import prange

from coplanar.engine.compiled.columns import gather, merge, row
from coplanar.engine.compiled.sweeps import MOST_ROWS, TOGETHER, apart, read, shows_nan, spill, sweep, write


def scan_block(initial, walk, shared, own, parameters, hold, outs, size, start, rows):
    """One block of rows from its initial state to the end; rows that show a NaN on the way are run again, safely."""
    count, width, large = size
    state, fixed, doubt = apart(STATES), apart(FIXED), np.zeros(MOST_ROWS, np.bool_)  # noqa: F821
    full = rows if PATTERN else (rows + TOGETHER - 1) // TOGETHER * TOGETHER  # noqa: F821 (copies of the last row)
    for i in range(full):
        there = start + min(i, rows - 1)
        write(state, i, gather(initial, walk, there, 0))
        write(fixed, i, gather(parameters, hold, there, 0))
    spill(outs, state, start, rows, KEPT, large)  # noqa: F821
    for k in range(count):
        mine = k * width + start
        if sweep(law, state, row(shared, k, 0), own, mine, fixed, full, PATTERN):  # noqa: F821
            for i in range(rows):
                doubt[i] |= shows_nan(state, i)
        spill(outs, state, mine + width, rows, KEPT, large)  # noqa: F821
    spill(outs, state, start, rows, ENDS, False)  # noqa: F821
    for i in range(rows):
        if doubt[i]:
            scan_row(initial, walk, shared, own, parameters, hold, outs, size, start + i)


def scan_row(initial, walk, shared, own, parameters, hold, outs, size, i):
    """One row from its initial state to the end by the safe law."""
    count, width, _ = size
    state, fixed = apart(STATES), gather(parameters, hold, i, 0)  # noqa: F821
    write(state, 0, gather(initial, walk, i, 0))
    spill(outs, state, i, 1, KEPT, False)  # noqa: F821
    for k in range(count):
        inputs = merge(row(shared, k, 0), row(own, k * width, i), PATTERN)  # noqa: F821
        write(state, 0, safe_law(*read(state, 0), *inputs, *fixed))  # noqa: F821
        spill(outs, state, (k + 1) * width + i, 1, KEPT, False)  # noqa: F821
    spill(outs, state, i, 1, ENDS, False)  # noqa: F821


def block_of(width):
    """Rows of a block: even shares for two threads, of whole vectors, whatever the number of threads."""
    blocks = (width + MOST_ROWS - 1) // MOST_ROWS
    blocks += blocks % 2 if blocks > 1 else 0
    share = (width + blocks - 1) // blocks
    return (share + TOGETHER - 1) // TOGETHER * TOGETHER


def scan_serial(initial, walk, shared, own, parameters, hold, outs, size):
    """All blocks, one after another."""
    width = size[1]
    block = block_of(width)
    for start in range(0, width, block):
        scan_block(initial, walk, shared, own, parameters, hold, outs, size, start, min(block, width - start))


def scan_parallel(initial, walk, shared, own, parameters, hold, outs, size):
    """All blocks, shared among threads."""
    width = size[1]
    block = block_of(width)
    for b in prange((width + block - 1) // block):
        start = b * block
        scan_block(initial, walk, shared, own, parameters, hold, outs, size, start, min(block, width - start))


PARTS = (block_of, scan_row, scan_block)
