"""The loops of a walk along few and long rows, shared among threads: templates as in ``walks``, whose parts they use.

Nothing hangs on the number of threads: the tiles are those of a serial walk, and so are the sums from tile to tile. The
turns of all tiles come first, and tell each its heading. Then the places of each tile are summed from 0, and last moved
to where the ways of the tiles before it lead. Threads meet three times and no more: on a busy machine each time may
cost a time slice.
"""

from __future__ import annotations

import numpy as np
from numba import prange

from coplanar.engine.compiled import walks
from coplanar.engine.compiled.columns import gather, row, scatter, table_of
from coplanar.engine.compiled.walks import LONG, TILE

PIECE = 8  # tiles that a thread takes at a time


def piece_turns(ins, strides, paces, steps, which, piece, start):
    """How far each tile of a piece turns."""
    table, poses = table_of(3 * LONG), np.zeros((4, 1))
    for t in range(piece * PIECE, min((piece + 1) * PIECE, start.shape[1])):
        first = t * TILE
        turns(table, poses, ins, strides, paces, which, first, 1, min(TILE, steps - first))  # noqa: F821
        start[2, t] = poses[1, 0]


def piece_ways(ins, strides, paces, outs, size, which, piece, start):
    """The tiles of a piece from the headings where they start; their ways are left in place of where they start."""
    table, poses = table_of(3 * LONG), np.empty((4, 1))
    for t in range(piece * PIECE, min((piece + 1) * PIECE, start.shape[1])):
        first = t * TILE
        poses[0, 0], poses[2, 0], poses[3, 0] = start[2, t], 0.0, 0.0
        count = min(TILE, size[1] - first)
        walk_tile(table, poses, ins, strides, paces, outs, size, which, first, 1, count)  # noqa: F821
        start[0, t], start[1, t] = poses[2, 0], poses[3, 0]


def piece_moved(outs, size, which, piece, start):
    """The places of a piece moved to where its tiles start."""
    for t in range(piece * PIECE, min((piece + 1) * PIECE, start.shape[1])):
        first = t * TILE
        there = which * (size[1] + 1) + first
        for axis in range(2):
            out, place = (outs[axis],), start[axis, t]
            for k in range(min(TILE, size[1] - first)):
                scatter(out, there, k, place + row(out, there, k)[0])


def summed(column, begin):
    """What each tile adds becomes where it starts; returns where the last one ends."""
    for t in range(len(column)):
        added = column[t]
        column[t] = begin
        begin += added
    return begin


def stretch_serial(begin, hold, ins, strides, paces, outs, size):
    """All rows, one after another."""
    walk_share(begin, hold, ins, strides, paces, outs, size, 0, size[0])  # noqa: F821


def stretch_parallel(begin, hold, ins, strides, paces, outs, size):
    """All rows, one after another, the tiles of each shared among threads."""
    rows, steps = size[0], size[1]
    tiles = (steps + TILE - 1) // TILE
    pieces = (tiles + PIECE - 1) // PIECE
    start = np.empty((3, tiles))  # x, y and heading
    for which in range(rows):
        x, y, heading = gather(begin, hold, which, 0)
        for piece in prange(pieces):
            piece_turns(ins, strides, paces, steps, which, piece, start)
        heading = summed(start[2], heading)
        for piece in prange(pieces):
            piece_ways(ins, strides, paces, outs, size, which, piece, start)
        x, y = summed(start[0], x), summed(start[1], y)
        if KEEP:  # noqa: F821
            for piece in prange(pieces):
                piece_moved(outs, size, which, piece, start)
        last = which * (steps + 1) + steps if KEEP else which  # noqa: F821
        scatter(outs, last, 0, (x, y, heading))


PARTS = (*walks.PARTS, piece_turns, piece_ways, piece_moved, summed)
