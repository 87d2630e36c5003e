"""The loops of a serial chain: where its links are, row by row, and the columns of its Jacobian.

``link``, ``act``, ``revolute``, ``prismatic``, their safe forms and the other parts are names that
``coplanar.engine.compiled.kernels`` supplies; the bodies are templates and never run as they stand. A block of rows is
carried through all joints while it lies in the nearest caches: scratch memory holds columns of ``WIDTH`` rows.

The places of a chain are triples (x, y, direction): 0 is the base, k + 1 the end of link k, n + 1 the tool. A joint is
a row (carry, turns, bend, length, slides, turns the tool) and an end: the place that turns with it as one rigid body.
"""

from __future__ import annotations

import numpy as np
from numba import prange

WIDTH = 256  # rows of a block; the places and columns of six joints are 74 KiB, which the second-level cache holds


def load(q, into, start, rows, n):
    """Joints of a block of rows, each joint a column."""
    for k in range(n):
        for i in range(rows):
            into[k * WIDTH + i] = q[(start + i) * n + k]


def fold(q, joints, frames, place, rows):
    """Places of a block of rows; a row whose angles are too large for the fast sine is folded again, safely."""
    n = len(joints)
    for c in range(3):
        for i in range(rows):
            place[c * WIDTH + i] = frames[0, c]
    for k in range(n):
        carry, turns, bend = joints[k, 0], joints[k, 1], joints[k, 2]
        length, slides = joints[k, 3], joints[k, 4]
        at = 3 * k * WIDTH
        for i in range(rows):
            x, y, angle = place[at + i], place[at + WIDTH + i], place[at + 2 * WIDTH + i]
            x, y, angle = link(x, y, angle, q[k * WIDTH + i], carry, turns, bend, length, slides)  # noqa: F821
            place[at + 3 * WIDTH + i] = x
            place[at + 4 * WIDTH + i] = y
            place[at + 5 * WIDTH + i] = angle
    at = 3 * n * WIDTH
    tx, ty, turned = frames[1, 0], frames[1, 1], frames[1, 2]
    if tx == 0.0 and ty == 0.0:
        for i in range(2 * WIDTH):
            place[at + 3 * WIDTH + i] = place[at + i]
    else:
        for i in range(rows):
            x, y = act(place[at + i], place[at + WIDTH + i], place[at + 2 * WIDTH + i], tx, ty)  # noqa: F821
            place[at + 3 * WIDTH + i] = x
            place[at + 4 * WIDTH + i] = y
    doubtful = 0
    for i in range(rows):
        place[at + 5 * WIDTH + i] = place[at + 2 * WIDTH + i] + turned
        check = place[at + 3 * WIDTH + i] + place[at + 4 * WIDTH + i]
        doubtful += 0 if check == check else 1  # NaN is what does not equal itself
    if doubtful:
        for i in range(rows):
            check = place[at + 3 * WIDTH + i] + place[at + 4 * WIDTH + i]
            if check != check:
                fold_row(q, joints, frames, place, i)


def fold_row(q, joints, frames, place, i):
    """Places of one row by the safe laws."""
    n = len(joints)
    x, y, angle = frames[0, 0], frames[0, 1], frames[0, 2]
    for k in range(n):
        joint = joints[k]
        x, y, angle = safe_link(  # noqa: F821
            x, y, angle, q[k * WIDTH + i], joint[0], joint[1], joint[2], joint[3], joint[4]
        )
        at = 3 * (k + 1) * WIDTH + i
        place[at], place[at + WIDTH], place[at + 2 * WIDTH] = x, y, angle
    at = 3 * (n + 1) * WIDTH + i
    place[at], place[at + WIDTH] = safe_act(x, y, angle, frames[1, 0], frames[1, 1])  # noqa: F821
    place[at + 2 * WIDTH] = angle + frames[1, 2]


def columns(place, joints, ends, out, rows):
    """(dx/dq, dy/dq) of every joint, one after the other, in columns."""
    for k in range(len(joints)):
        at, end, to = 3 * k * WIDTH, 3 * ends[k] * WIDTH, 2 * k * WIDTH
        if joints[k, 1] != 0.0:
            for i in range(rows):
                x, y = revolute(place[at + i], place[at + WIDTH + i], place[end + i], place[end + WIDTH + i])  # noqa: F821
                out[to + i] = x
                out[to + WIDTH + i] = y
        else:
            for i in range(rows):
                x, y = prismatic(place[at + 5 * WIDTH + i])  # noqa: F821
                out[to + i] = x
                out[to + WIDTH + i] = y
            for i in range(rows):
                if out[to + i] != out[to + i]:
                    out[to + i], out[to + WIDTH + i] = safe_prismatic(place[at + 5 * WIDTH + i])  # noqa: F821


def chain_block(q, joints, ends, frames, pose, points, jacobian, start, rows):
    """One block of rows: what is wanted has room of its own, what is not has none."""
    n = len(joints)
    values, place, slopes = np.empty(n * WIDTH), np.empty(3 * (n + 2) * WIDTH), np.empty(2 * n * WIDTH)
    load(q, values, start, rows, n)  # noqa: F821
    fold(values, joints, frames, place, rows)  # noqa: F821
    if pose.size:
        at = 3 * (n + 1) * WIDTH
        for c in range(3):
            for i in range(rows):
                pose[c, start + i] = place[at + c * WIDTH + i]
    for k in range(points.shape[1]):
        for c in range(2):
            for i in range(rows):
                points[start + i, k, c] = place[(3 * k + c) * WIDTH + i]
    if jacobian.size:
        columns(place, joints, ends, slopes, rows)  # noqa: F821
        for k in range(n):
            for i in range(rows):
                jacobian[start + i, 0, k] = slopes[2 * k * WIDTH + i]
                jacobian[start + i, 1, k] = slopes[(2 * k + 1) * WIDTH + i]
            if jacobian.shape[1] == 3:
                for i in range(rows):
                    jacobian[start + i, 2, k] = joints[k, 5]


def chain_serial(q, joints, ends, frames, pose, points, jacobian, rows):
    """All blocks, one after another."""
    for b in range((rows + WIDTH - 1) // WIDTH):
        start = b * WIDTH
        chain_block(q, joints, ends, frames, pose, points, jacobian, start, min(WIDTH, rows - start))


def chain_parallel(q, joints, ends, frames, pose, points, jacobian, rows):
    """All blocks, shared among threads."""
    for b in prange((rows + WIDTH - 1) // WIDTH):
        start = b * WIDTH
        chain_block(q, joints, ends, frames, pose, points, jacobian, start, min(WIDTH, rows - start))


PARTS = (load, fold_row, fold, columns, chain_block)
