"""The loops of the inverse of a serial chain by damped least squares: many targets at once, each done when it is done.

As in ``chains`` the laws and the parts are names that ``coplanar.engine.compiled.kernels`` supplies. A block of rows
advances together, column by column; rows that are done leave, and those still open close up. The columns of the state
are the joints (n), the Jacobian (2 n), the error (3), the target (3) and mu.
"""

from __future__ import annotations

import numpy as np
from numba import prange

from coplanar.engine.compiled.chains import FOLD
from coplanar.engine.compiled.columns import WIDTH, align_stack, get, put, some, table_of

OPEN, CONVERGED, STALLED, NOT_FINITE = 0, 1, 2, 3  # how a row stands; one that is open at the end has spent its budget


def errors(place, state, error, first, n, weight, rows):
    """Error of a block of rows at the tool's place, which is the last one, from the column ``first`` on."""
    for i in range(rows):
        put(error, first, i, task_error(*some(place, 3 * n + 3, i, 3), *some(state, 3 * n + 3, i, 3), weight))  # noqa: F821
    for i in range(rows):
        if get(error, first + 2, i) != get(error, first + 2, i):
            put(error, first, i, safe_task_error(*some(place, 3 * n + 3, i, 3), *some(state, 3 * n + 3, i, 3), weight))  # noqa: F821


def squares(error, first, out, rows):
    """|F|^2."""
    for i in range(rows):
        x, y, turn = some(error, first, i, 3)
        out[i] = x * x + y * y + turn * turn


def normal(state, joints, bounds, weight, slopes, matrix, rows):
    """J J^T of the joints that no bound blocks, as (xx, xy, xt, yy, yt, tt), and J of those joints."""
    n = len(joints)
    for i in range(rows):
        put(matrix, 0, i, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    for k in range(n):
        lower, upper, turn = bounds[0, k], bounds[1, k], weight * joints[k, 5]
        for i in range(rows):
            x, y = some(state, n + 2 * k, i, 2)
            ex, ey, et = some(state, 3 * n, i, 3)
            part = free(get(state, k, i), lower, upper, x * ex + y * ey + turn * et)  # noqa: F821
            put(slopes, 3 * k, i, (part * x, part * y, part * turn))
        for i in range(rows):
            x, y, t = some(slopes, 3 * k, i, 3)
            xx, xy, xt, yy, yt, tt = some(matrix, 0, i, 6)
            put(matrix, 0, i, (xx + x * x, xy + x * y, xt + x * t, yy + y * y, yt + y * t, tt + t * t))


def solve(state, matrix, square, n, rows):
    """(J J^T + lambda I)^-1 F, in the place of the matrix's first columns."""
    for i in range(rows):
        xx, xy, xt, yy, yt, tt = some(matrix, 0, i, 6)
        more = damping(get(state, 3 * n + 6, i), square[i], xx + yy + tt)  # noqa: F821
        put(matrix, 0, i, solve_three(xx + more, xy, xt, yy + more, yt, tt + more, *some(state, 3 * n, i, 3)))  # noqa: F821


def step(slopes, matrix, trial, room, longest, n, rows):
    """-J^T times the answer, and in ``room`` the factor that makes it no longer than allowed."""
    for i in range(rows):
        room[i] = 0.0
    for k in range(n):
        for i in range(rows):
            (x, y, t), (ax, ay, at) = some(slopes, 3 * k, i, 3), some(matrix, 0, i, 3)
            change = -(x * ax + y * ay + t * at)
            put(trial, k, i, change)
            room[i] += change * change
    for i in range(rows):
        room[i] = shortening(np.sqrt(room[i]), longest)  # noqa: F821


def move(state, joints, bounds, weight, room, trial, model, rows):
    """Joints after the step, within the bounds, and the error that the linear model expects there."""
    n = len(joints)
    for i in range(rows):
        put(model, 0, i, some(state, 3 * n, i, 3))
    for k in range(n):
        lower, upper, turn = bounds[0, k], bounds[1, k], weight * joints[k, 5]
        for i in range(rows):
            (x, y), (ex, ey, et) = some(state, n + 2 * k, i, 2), some(model, 0, i, 3)
            q = get(state, k, i)
            there = min(max(q + get(trial, k, i) * room[i], lower), upper)
            put(trial, k, i, there)
            change = there - q
            put(model, 0, i, (ex + x * change, ey + y * change, et + turn * change))


def judge(state, square, expected, now, taken, n, rows):
    """Which steps gain what they should; mu adapts."""
    for i in range(rows):
        gained = gain(square[i], expected[i], now[i])  # noqa: F821
        mu, fine = adapted(get(state, 3 * n + 6, i), gained)  # noqa: F821
        put(state, 3 * n + 6, i, mu)
        taken[i] = fine
        square[i] = now[i] if fine > 0.0 else square[i]


def take(state, trial, slopes, model, taken, length, size, n, rows):
    """Steps that are taken, with the Jacobian and the error at their ends; squares of a step's length and of |q|."""
    for i in range(rows):
        length[i] = 0.0
        size[i] = 0.0
    for k in range(n):
        for i in range(rows):
            q, there = get(state, k, i), get(trial, k, i)
            new = there if taken[i] > 0.0 else q
            put(state, k, i, new)
            length[i] += (there - q) * (there - q)
            size[i] += new * new
        for i in range(rows):
            (x, y), (u, v) = some(state, n + 2 * k, i, 2), some(slopes, 2 * k, i, 2)
            put(state, n + 2 * k, i, (u if taken[i] > 0.0 else x, v if taken[i] > 0.0 else y))
    for i in range(rows):
        (x, y, t), (u, v, w) = some(state, 3 * n, i, 3), some(model, 0, i, 3)
        fine = taken[i] > 0.0
        put(state, 3 * n, i, (u if fine else x, v if fine else y, w if fine else t))


def close(square, length, size, tolerance, small, codes, rows):
    """Rows whose error is within the tolerance, and rows whose step was nothing."""
    for i in range(rows):
        stopped = still(np.sqrt(length[i]), np.sqrt(size[i]), small)  # noqa: F821
        code = STALLED if stopped > 0.0 else codes[i]
        codes[i] = CONVERGED if square[i] <= tolerance * tolerance else code


def leave(state, square, which, codes, used, outputs, start, n, rows, last):
    """Rows that are done go out; those still open close up, unless it is the last time. Returns how many are open."""
    q, code, iterations, miss = outputs
    left = 0
    for i in range(rows):
        if codes[i] == OPEN and not last:
            which[left], square[left] = which[i], square[i]
            if left != i:
                for c in range(3 * n + 7):
                    put(state, c, left, get(state, c, i))
            left += 1
        else:
            row = start + which[i]
            code[row], iterations[row], miss[row] = codes[i], used, np.sqrt(square[i])
            for k in range(n):
                q[row, k] = get(state, k, i)
    for i in range(left):
        codes[i] = OPEN
    return left


def begin(q, aims, joints, ends, frames, bounds, settings, state, place, square, codes, start, rows):
    """The state of a block of rows at the first guess, brought within the bounds."""
    n = len(joints)
    load(q, state, start, rows, n)  # noqa: F821
    for k in range(n):
        lower, upper = bounds[0, k], bounds[1, k]
        for i in range(rows):
            put(state, k, i, min(max(get(state, k, i), lower), upper))
    for c in range(3):
        for i in range(rows):
            put(state, 3 * n + 3 + c, i, aims[c, start + i] if c < len(aims) else 0.0)
    for i in range(rows):
        put(state, 3 * n + 6, i, settings[2])
    fold(state, joints, frames, place, rows)  # noqa: F821
    columns(place, joints, ends, state, n, rows)  # noqa: F821
    errors(place, state, state, 3 * n, n, settings[4], rows)
    squares(state, 3 * n, square, rows)
    for i in range(rows):
        codes[i] = OPEN if square[i] < np.inf else NOT_FINITE


def search_block(q, aims, joints, ends, frames, bounds, settings, budget, outputs, start, rows):
    """One block of targets from the first guess to the end."""
    align_stack()
    n = len(joints)
    tolerance, small, longest, weight = settings[0], settings[1], settings[3], settings[4]
    state, place, trial = table_of(3 * n + 7), table_of(3 * n + 6), table_of(n)
    slopes, matrix, model = table_of(3 * n), table_of(6), table_of(3)
    square, expected, now, taken = np.empty(WIDTH), np.ones(WIDTH), np.empty(WIDTH), np.empty(WIDTH)
    which, codes = np.arange(WIDTH), np.empty(WIDTH, np.int64)
    begin(q, aims, joints, ends, frames, bounds, settings, state, place, square, codes, start, rows)
    for i in range(rows):
        now[i] = 0.0
    for used in range(budget + 1):
        close(square, expected, now, tolerance, small, codes, rows)
        rows = leave(state, square, which, codes, used, outputs, start, n, rows, used == budget)
        if rows == 0:
            break
        normal(state, joints, bounds, weight, slopes, matrix, rows)
        solve(state, matrix, square, n, rows)
        step(slopes, matrix, trial, taken, longest, n, rows)
        move(state, joints, bounds, weight, taken, trial, model, rows)
        squares(model, 0, expected, rows)
        fold(trial, joints, frames, place, rows)  # noqa: F821
        columns(place, joints, ends, slopes, 0, rows)  # noqa: F821
        errors(place, state, model, 0, n, weight, rows)
        squares(model, 0, now, rows)
        judge(state, square, expected, now, taken, n, rows)
        take(state, trial, slopes, model, taken, expected, now, n, rows)


def search_serial(q, aims, joints, ends, frames, bounds, settings, budget, outputs, rows):
    """All blocks, one after another."""
    for b in range((rows + WIDTH - 1) // WIDTH):
        start = b * WIDTH
        size = min(WIDTH, rows - start)
        search_block(q, aims, joints, ends, frames, bounds, settings, budget, outputs, start, size)


def search_parallel(q, aims, joints, ends, frames, bounds, settings, budget, outputs, rows):
    """All blocks, shared among threads."""
    for b in prange((rows + WIDTH - 1) // WIDTH):
        start = b * WIDTH
        size = min(WIDTH, rows - start)
        search_block(q, aims, joints, ends, frames, bounds, settings, budget, outputs, start, size)


PARTS = (*FOLD, errors, squares, normal, solve, step, move, judge, take, close, leave, begin, search_block)
