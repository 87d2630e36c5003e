"""The loops of a walk: one text for every law of a pose's step, along rows of steps that lie side by side in memory.

``law``, ``safe_law`` and the constant KEEP are names that ``coplanar.engine.compiled.kernels`` supplies; the bodies are
templates and never run as they stand. A step turns the heading by what does not hang on the pose, and moves the place
by what hangs on the heading alone. So a tile of steps is taken at once: all turns, the headings as their running sums,
all ways, the places as their running sums. The law is vector code; a table in the first-level cache carries what is
between. A tile is a part of one long row, or a few whole short ones.

An input is read at ``row * stride + step * pace`` (stride 0: the same for all rows, laid out as often as a tile has
rows; pace 0: one number for all steps, spread over a tile).
"""

from __future__ import annotations

import numpy as np
from numba import prange

from coplanar.engine.compiled.columns import (
    WIDTH,
    align_stack,
    claim,
    fetch,
    gather,
    get,
    put,
    reach,
    scatter,
    table_of,
)
from coplanar.engine.compiled.lanes import LANES, sums, sums_into
from coplanar.engine.compiled.lines import along, each

LONG = 4  # columns of a table that make one of a tile: the longer the tile, the less often its loops begin
TILE = LONG * WIDTH
TURN, X, Y = 0, LONG, 2 * LONG  # where the columns begin
BLOCK = 4 * LANES  # entries between two calls for memory; a part of TILE
SHARE = 8  # groups that a thread takes at a time


def running(table, column, first, count, begin):
    """A row's part of a column becomes ``begin`` plus the sums before each entry; returns the sum of all entries."""
    total = 0.0
    whole = first + count - count % LANES
    for k in range(first, whole, LANES):
        total = sums(table, column, k, total, begin)
    for k in range(whole, first + count):
        entry = get(table, column, k)
        put(table, column, k, begin + total)
        total += entry
    return total


def lay(table, column, first, count, begin, out, there):
    """As ``running``, but written to an output from ``there`` on."""
    total = 0.0
    whole = first + count - count % LANES
    there -= first
    for k in range(first, whole, LANES):
        total = sums_into(out, there, table, column, k, total, begin)
    for k in range(whole, first + count):
        scatter(out, there, k, begin + total)
        total += get(table, column, k)
    return total


def turned(table, poses, rows, count):
    """Headings of a tile of rows; their turns go into the poses. Returns the sum of all: NaN if one is."""
    total = 0.0
    for r in range(rows):
        poses[1, r] = running(table, TURN, r * count, count, poses[0, r])
        total += poses[1, r]
    return total


def turns(table, poses, ins, strides, paces, row, first, rows, count):
    """Headings before the steps of a tile; where the fast law says NaN, by the safe one."""
    align_stack()
    for i in range(rows * count):
        put(table, TURN, i, law(0.0, 0.0, 0.0, *reach(ins, strides, paces, row, first, i))[2])  # noqa: F821
    total = turned(table, poses, rows, count)
    if total != total:  # NaN is what does not equal itself
        for i in range(rows * count):
            put(table, TURN, i, safe_law(0.0, 0.0, 0.0, *reach(ins, strides, paces, row, first, i))[2])  # noqa: F821
        turned(table, poses, rows, count)


def ways(table, ins, strides, paces, outs, there, row, first, count):
    """Ways of a tile by its headings; where the fast law says NaN, by the safe one.

    While the law keeps the processor busy, memory is told what comes next: the places of this tile, the inputs of the
    next. A last block that is not full begins earlier and does some entries again.
    """
    align_stack()
    doubtful, block = 0, min(BLOCK, count)
    flat = table.reshape(-1)
    xy = (flat[X * WIDTH :], flat[Y * WIDTH :])
    for begin in range(0, count, BLOCK):
        for k in range(begin, begin + BLOCK, LANES):
            fetch(ins, strides, paces, row, first, count + k)
            if KEEP:  # noqa: F821
                claim(outs, there, k)
        base = min(begin, count - block)
        here = along(table, TURN, base, ins, strides, paces, row, first + base)
        doubtful += each(law, 2, here, xy, base, block, 0, False)  # noqa: F821
    if doubtful:
        for i in range(count):
            x, y, _ = safe_law(0.0, 0.0, get(table, TURN, i), *reach(ins, strides, paces, row, first, i))  # noqa: F821
            put(table, X, i, x)
            put(table, Y, i, y)


def walk_tile(table, poses, ins, strides, paces, outs, size, row, first, rows, count):
    """One tile from the poses before it, in which the poses after it are left."""
    xs, ys, angles = (outs[0],), (outs[1],), (outs[2],)
    turns(table, poses, ins, strides, paces, row, first, rows, count)
    ways(table, ins, strides, paces, outs, row * (size[1] + 1) + first, row, first, rows * count)
    for r in range(rows):
        begin = r * count
        if KEEP:  # noqa: F821
            there = (row + r) * (size[1] + 1) + first
            for k in range(count):
                scatter(angles, there, k, get(table, TURN, begin + k))
            poses[2, r] += lay(table, X, begin, count, poses[2, r], xs, there)
            poses[3, r] += lay(table, Y, begin, count, poses[3, r], ys, there)
        else:
            poses[2, r] += running(table, X, begin, count, 0.0)
            poses[3, r] += running(table, Y, begin, count, 0.0)
        poses[0, r] += poses[1, r]


def walk_rows(table, poses, begin, hold, ins, strides, paces, outs, size, row, rows):
    """A few rows from their first poses to the end: one tile of all, or one row tile by tile."""
    steps = size[1]
    for r in range(rows):
        poses[2, r], poses[3, r], poses[0, r] = gather(begin, hold, row + r, 0)
    for first in range(0, steps, TILE):
        walk_tile(table, poses, ins, strides, paces, outs, size, row, first, rows, min(TILE, steps - first))
    for r in range(rows):
        last = (row + r) * (steps + 1) + steps if KEEP else row + r  # noqa: F821
        scatter(outs, last, 0, (poses[2, r], poses[3, r], poses[0, r]))


def walk_share(begin, hold, ins, strides, paces, outs, size, group, groups):
    """Some groups of rows, one after another."""
    rows, many = size[0], size[2]
    table, poses = table_of(3 * LONG), np.empty((4, TILE))  # heading, turn in the tile, x, y
    for row in range(group * many, min(rows, (group + groups) * many), many):
        walk_rows(table, poses, begin, hold, ins, strides, paces, outs, size, row, min(many, rows - row))


def walk_serial(begin, hold, ins, strides, paces, outs, size):
    """All rows, one group after another."""
    walk_share(begin, hold, ins, strides, paces, outs, size, 0, size[0])


def walk_parallel(begin, hold, ins, strides, paces, outs, size):
    """All rows, the groups shared among threads."""
    groups = (size[0] + size[2] - 1) // size[2]
    for share in prange((groups + SHARE - 1) // SHARE):
        walk_share(begin, hold, ins, strides, paces, outs, size, share * SHARE, SHARE)


PARTS = (running, lay, turned, turns, ways, walk_tile, walk_rows, walk_share)
