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

from coplanar.engine.compiled.columns import WIDTH, gather, get, put, reach, scatter

LONG = 4  # columns of a table that make one of a tile: the longer the tile, the less often its loops begin
TILE = LONG * WIDTH
TURN, X, Y = 0, LONG, 2 * LONG  # where the columns begin


def headings(table, first, count, heading):
    """Turns into the headings before them; returns the heading after the last one.

    Four at a time, so that a sum waits for one addition of the sum before it and not for four.
    """
    whole = first + count - count % 4
    for k in range(first, whole, 4):
        a, b = get(table, TURN, k), get(table, TURN, k + 1)
        c, d = get(table, TURN, k + 2), get(table, TURN, k + 3)
        put(table, TURN, k, heading)
        put(table, TURN, k + 1, heading + a)
        put(table, TURN, k + 2, heading + (a + b))
        put(table, TURN, k + 3, heading + (a + b + c))
        heading += (a + b) + (c + d)
    for k in range(whole, first + count):
        a = get(table, TURN, k)
        put(table, TURN, k, heading)
        heading += a
    return heading


def places(table, column, first, count, place, out, there):
    """The places before each way of a column, from ``there`` on in the output; returns the place after the last one."""
    whole = first + count - count % 4
    there -= first
    for k in range(first, whole, 4):
        a, b = get(table, column, k), get(table, column, k + 1)
        c, d = get(table, column, k + 2), get(table, column, k + 3)
        if KEEP:  # noqa: F821
            scatter(out, there, k, place)
            scatter(out, there, k + 1, place + a)
            scatter(out, there, k + 2, place + (a + b))
            scatter(out, there, k + 3, place + (a + b + c))
        place += (a + b) + (c + d)
    for k in range(whole, first + count):
        if KEEP:  # noqa: F821
            scatter(out, there, k, place)
        place += get(table, column, k)
    return place


def turned(table, poses, rows, count):
    """Headings of a tile of rows; those after it go into the poses. Returns their sum: NaN if one is."""
    total = 0.0
    for r in range(rows):
        poses[1, r] = headings(table, r * count, count, poses[0, r])
        total += poses[1, r]
    return total


def ways(table, poses, ins, strides, paces, row, first, rows, count):
    """Headings and ways of a tile; where the fast law says NaN, by the safe one."""
    for i in range(rows * count):
        put(table, TURN, i, law(0.0, 0.0, 0.0, *reach(ins, strides, paces, row, first, i))[2])  # noqa: F821
    total = turned(table, poses, rows, count)
    doubtful = 0 if total == total else 1  # NaN is what does not equal itself
    for i in range(rows * count):
        x, y, _ = law(0.0, 0.0, get(table, TURN, i), *reach(ins, strides, paces, row, first, i))  # noqa: F821
        put(table, X, i, x)
        put(table, Y, i, y)
        doubtful += 0 if x + y == x + y else 1
    if doubtful:
        for i in range(rows * count):
            put(table, TURN, i, safe_law(0.0, 0.0, 0.0, *reach(ins, strides, paces, row, first, i))[2])  # noqa: F821
        turned(table, poses, rows, count)
        for i in range(rows * count):
            x, y, _ = safe_law(0.0, 0.0, get(table, TURN, i), *reach(ins, strides, paces, row, first, i))  # noqa: F821
            put(table, X, i, x)
            put(table, Y, i, y)


def walk_rows(begin, hold, ins, strides, paces, outs, size, row, rows):
    """A few rows from their first poses to the end: one tile of all, or one row tile by tile."""
    steps = size[1]
    table, poses = np.empty((3 * LONG, WIDTH)), np.empty((4, TILE))  # heading, heading after the tile, x, y
    for r in range(rows):
        poses[2, r], poses[3, r], poses[0, r] = gather(begin, hold, row + r, 0)
    xs, ys, angles = (outs[0],), (outs[1],), (outs[2],)
    for first in range(0, steps, TILE):
        count = min(TILE, steps - first)
        ways(table, poses, ins, strides, paces, row, first, rows, count)
        for r in range(rows):
            there = (row + r) * (steps + 1) + first
            poses[2, r] = places(table, X, r * count, count, poses[2, r], xs, there)
            poses[3, r] = places(table, Y, r * count, count, poses[3, r], ys, there)
            poses[0, r] = poses[1, r]
            if KEEP:  # noqa: F821
                for k in range(count):
                    scatter(angles, there, k, get(table, TURN, r * count + k))
    for r in range(rows):
        last = (row + r) * (steps + 1) + steps if KEEP else row + r  # noqa: F821
        scatter(outs, last, 0, (poses[2, r], poses[3, r], poses[0, r]))


def walk_serial(begin, hold, ins, strides, paces, outs, size):
    """All rows, one group after another."""
    rows, group = size[0], size[2]
    for g in range((rows + group - 1) // group):
        row = g * group
        walk_rows(begin, hold, ins, strides, paces, outs, size, row, min(group, rows - row))


def walk_parallel(begin, hold, ins, strides, paces, outs, size):
    """All rows, the groups shared among threads."""
    rows, group = size[0], size[2]
    for g in prange((rows + group - 1) // group):
        row = g * group
        walk_rows(begin, hold, ins, strides, paces, outs, size, row, min(group, rows - row))


PARTS = (headings, places, turned, ways, walk_rows)
