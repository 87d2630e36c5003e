"""The loops of a scan: one text for every law that carries a state from step to step.

``law``, ``safe_law`` and the constants KEEP and PATTERN are names that ``coplanar.engine.compiled.kernels`` supplies;
the bodies are templates and never run as they stand. Rows (robots, targets) are innermost, so that each step is vector
code over a block of rows; the state is read where the step before has written it, in the first-level cache.

An input is either shared, one number per step, or own, one number per step and row; bit k of PATTERN says that input k
is own. With KEEP the outputs hold the state before the first step and after every step; otherwise the end alone.
"""

from __future__ import annotations

from numba import prange

from coplanar.engine.compiled.columns import gather, merge, row, scatter

BLOCK = 512  # rows; ten float64 columns of a block are 40 KiB


def scan_block(initial, walk, shared, own, parameters, hold, outs, size, start, rows):
    """One block of rows from its initial state to the end; if a NaN shows on the way it is run again, safely."""
    count, width = size
    for i in range(rows):
        scatter(outs, start, i, gather(initial, walk, start, i))
    here = start
    doubtful = 0
    for k in range(count):
        common = row(shared, k, 0)
        mine = k * width + start
        if KEEP:  # noqa: F821
            there = here + width
            for i in range(rows):
                inputs = merge(common, row(own, mine, i), PATTERN)  # noqa: F821
                check = scatter(outs, there, i, law(*row(outs, here, i), *inputs, *gather(parameters, hold, start, i)))  # noqa: F821
                doubtful += 0 if check == check else 1  # NaN is what does not equal itself
            here = there
        else:
            for i in range(rows):
                inputs = merge(common, row(own, mine, i), PATTERN)  # noqa: F821
                check = scatter(outs, start, i, law(*row(outs, start, i), *inputs, *gather(parameters, hold, start, i)))  # noqa: F821
                doubtful += 0 if check == check else 1  # NaN is what does not equal itself
    if doubtful:
        for i in range(rows):
            scan_row(initial, walk, shared, own, parameters, hold, outs, size, start, i)


def scan_row(initial, walk, shared, own, parameters, hold, outs, size, start, i):
    """One row from its initial state to the end by the safe law."""
    count, width = size
    constants = gather(parameters, hold, start, i)
    scatter(outs, start, i, gather(initial, walk, start, i))
    here = start
    for k in range(count):
        inputs = merge(row(shared, k, 0), row(own, k * width + start, i), PATTERN)  # noqa: F821
        there = here + width if KEEP else here  # noqa: F821
        scatter(outs, there, i, safe_law(*row(outs, here, i), *inputs, *constants))  # noqa: F821
        here = there


def scan_serial(initial, walk, shared, own, parameters, hold, outs, size):
    """All blocks, one after another."""
    width = size[1]
    for b in range((width + BLOCK - 1) // BLOCK):
        start = b * BLOCK
        scan_block(initial, walk, shared, own, parameters, hold, outs, size, start, min(BLOCK, width - start))


def scan_parallel(initial, walk, shared, own, parameters, hold, outs, size):
    """All blocks, shared among threads."""
    width = size[1]
    for b in prange((width + BLOCK - 1) // BLOCK):
        start = b * BLOCK
        scan_block(initial, walk, shared, own, parameters, hold, outs, size, start, min(BLOCK, width - start))


PARTS = (scan_row, scan_block)
