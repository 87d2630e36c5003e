"""The loops of a serial chain: where its links are, row by row, and the columns of its Jacobian.

``link``, ``act``, ``revolute``, ``prismatic``, their safe forms and the other parts are names that
``coplanar.engine.compiled.kernels`` supplies; the bodies are templates and never run as they stand. A block of rows is
carried through all joints while it lies in the nearest caches, in tables whose columns have ``WIDTH`` rows.

The places of a chain are triples (x, y, direction): 0 is the base, k + 1 the end of link k, n + 1 the tool. A joint is
a row (carry, turns, bend, length, slides, turns the tool) and an end: the place that turns with it as one rigid body.
The frames are base and tool, each (x, y, direction).
"""

from __future__ import annotations

from numba import prange

from coplanar.engine.compiled.columns import WIDTH, align_stack, get, put, some, table_of


def load(q, into, start, rows, n):
    """Joints of a block of rows, each joint a column."""
    for k in range(n):
        for i in range(rows):
            put(into, k, i, q[start + i, k])


def fold(q, joints, frames, place, rows):
    """Places of a block of rows; a row whose angles are too large for the fast sine is folded again, safely."""
    align_stack()
    n = len(joints)
    x, y, angle = frames[0, 0], frames[0, 1], frames[0, 2]
    for i in range(rows):
        put(place, 0, i, (x, y, angle))
    for k in range(n):
        carry, turns, bend, length, slides = joints[k, 0], joints[k, 1], joints[k, 2], joints[k, 3], joints[k, 4]
        for i in range(rows):
            here = some(place, 3 * k, i, 3)
            put(place, 3 * k + 3, i, link(*here, get(q, k, i), carry, turns, bend, length, slides))  # noqa: F821
    mount(frames, place, n, rows)
    doubtful = 0
    for i in range(rows):
        check = get(place, 3 * n + 3, i) + get(place, 3 * n + 4, i)
        doubtful += 0 if check == check else 1  # NaN is what does not equal itself
    if doubtful:
        for i in range(rows):
            check = get(place, 3 * n + 3, i) + get(place, 3 * n + 4, i)
            if check != check:
                fold_row(q, joints, frames, place, i)


def mount(frames, place, n, rows):
    """The tool, on the last link's end."""
    align_stack()
    tx, ty, turned = frames[1, 0], frames[1, 1], frames[1, 2]
    if tx == 0.0 and ty == 0.0:
        for i in range(rows):
            x, y, angle = some(place, 3 * n, i, 3)
            put(place, 3 * n + 3, i, (x, y, angle + turned))
    else:
        for i in range(rows):
            x, y, angle = some(place, 3 * n, i, 3)
            put(place, 3 * n + 3, i, (*act(x, y, angle, tx, ty), angle + turned))  # noqa: F821


def fold_row(q, joints, frames, place, i):
    """Places of one row by the safe laws."""
    n = len(joints)
    for k in range(n):
        carry, turns, bend, length, slides = joints[k, 0], joints[k, 1], joints[k, 2], joints[k, 3], joints[k, 4]
        here = some(place, 3 * k, i, 3)
        put(place, 3 * k + 3, i, safe_link(*here, get(q, k, i), carry, turns, bend, length, slides))  # noqa: F821
    x, y, angle = some(place, 3 * n, i, 3)
    put(place, 3 * n + 3, i, (*safe_act(x, y, angle, frames[1, 0], frames[1, 1]), angle + frames[1, 2]))  # noqa: F821


def columns(place, joints, ends, out, first, rows):
    """(dx/dq, dy/dq) of every joint, one after the other, from the column ``first`` on."""
    align_stack()
    for k in range(len(joints)):
        end, to = 3 * ends[k], first + 2 * k
        if joints[k, 1] != 0.0:
            for i in range(rows):
                put(out, to, i, revolute(*some(place, 3 * k, i, 2), *some(place, end, i, 2)))  # noqa: F821
        else:
            for i in range(rows):
                put(out, to, i, prismatic(get(place, 3 * k + 5, i)))  # noqa: F821
            for i in range(rows):
                if get(out, to, i) != get(out, to, i):
                    put(out, to, i, safe_prismatic(get(place, 3 * k + 5, i)))  # noqa: F821


def chain_block(q, joints, ends, frames, pose, points, jacobian, start, rows):
    """One block of rows: what is wanted has room of its own, what is not has none."""
    n = len(joints)
    values, place = table_of(n), table_of(3 * n + 6)
    load(q, values, start, rows, n)
    fold(values, joints, frames, place, rows)
    if pose.size:
        for i in range(rows):
            pose[0, start + i], pose[1, start + i], pose[2, start + i] = some(place, 3 * n + 3, i, 3)
    for k in range(points.shape[1]):
        for i in range(rows):
            points[start + i, k, 0], points[start + i, k, 1] = some(place, 3 * k, i, 2)
    if jacobian.size:
        chain_columns(place, joints, ends, jacobian, start, rows)


def chain_columns(place, joints, ends, jacobian, start, rows):
    """The columns into the rows of the Jacobian, two or three."""
    n = len(joints)
    slopes = table_of(2 * n)
    columns(place, joints, ends, slopes, 0, rows)
    for k in range(n):
        for i in range(rows):
            jacobian[start + i, 0, k], jacobian[start + i, 1, k] = some(slopes, 2 * k, i, 2)
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


FOLD = (load, mount, fold_row, fold, columns)
PARTS = (*FOLD, chain_columns, chain_block)
