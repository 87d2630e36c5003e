"""The loops of the inverse of a serial chain by damped least squares: many targets at once, each done when it is done.

As in ``chains`` the laws and the parts are names that ``coplanar.engine.compiled.kernels`` supplies. A block of rows
advances together, column by column; rows that are done leave, and those still open close up. The columns of the state:

joints (n), Jacobian (2 n), error (3), target (3), mu.
"""

from __future__ import annotations

import numpy as np
from numba import prange

from coplanar.engine.compiled import chains
from coplanar.engine.compiled.chains import WIDTH

OPEN, CONVERGED, STALLED, NOT_FINITE = 0, 1, 2, 3  # how a row stands; an open one has spent its budget


def errors(place, state, error, n, weight, rows):
    """Error of a block of rows at the tool's place, which is the last of the places."""
    at, goal = 3 * (n + 1) * WIDTH, (3 * n + 3) * WIDTH
    for i in range(rows):
        x, y, angle = place[at + i], place[at + WIDTH + i], place[at + 2 * WIDTH + i]
        ex, ey, turn = task_error(  # noqa: F821
            x, y, angle, state[goal + i], state[goal + WIDTH + i], state[goal + 2 * WIDTH + i], weight
        )
        error[i], error[WIDTH + i], error[2 * WIDTH + i] = ex, ey, turn
    for i in range(rows):
        if error[2 * WIDTH + i] != error[2 * WIDTH + i]:
            _, _, error[2 * WIDTH + i] = safe_task_error(  # noqa: F821
                0.0, 0.0, place[at + 2 * WIDTH + i], 0.0, 0.0, state[goal + 2 * WIDTH + i], weight
            )


def squares(error, out, rows):
    """|F|^2."""
    for i in range(rows):
        x, y, turn = error[i], error[WIDTH + i], error[2 * WIDTH + i]
        out[i] = x * x + y * y + turn * turn


def normal(state, joints, bounds, weight, keep, matrix, rows):
    """J J^T of the joints that no bound blocks, as (xx, xy, xt, yy, yt, tt), and which joints those are."""
    n = len(joints)
    f = 3 * n * WIDTH
    for i in range(6 * WIDTH):
        matrix[i] = 0.0
    for k in range(n):
        lower, upper, turn = bounds[0, k], bounds[1, k], weight * joints[k, 5]
        at, j = k * WIDTH, (n + 2 * k) * WIDTH
        for i in range(rows):
            jx, jy = state[j + i], state[j + WIDTH + i]
            slope = jx * state[f + i] + jy * state[f + WIDTH + i] + turn * state[f + 2 * WIDTH + i]
            part = free(state[at + i], lower, upper, slope)  # noqa: F821
            keep[at + i] = part
            gx, gy, gt = part * jx, part * jy, part * turn
            matrix[i] += gx * gx
            matrix[WIDTH + i] += gx * gy
            matrix[2 * WIDTH + i] += gx * gt
            matrix[3 * WIDTH + i] += gy * gy
            matrix[4 * WIDTH + i] += gy * gt
            matrix[5 * WIDTH + i] += gt * gt


def solve(state, matrix, square, n, answer, rows):
    """(J J^T + lambda I)^-1 F."""
    f, mu = 3 * n * WIDTH, (3 * n + 6) * WIDTH
    for i in range(rows):
        xx, yy, tt = matrix[i], matrix[3 * WIDTH + i], matrix[5 * WIDTH + i]
        more = damping(state[mu + i], square[i], xx + yy + tt)  # noqa: F821
        a, b, c = solve_three(  # noqa: F821
            xx + more, matrix[WIDTH + i], matrix[2 * WIDTH + i], yy + more, matrix[4 * WIDTH + i], tt + more,
            state[f + i], state[f + WIDTH + i], state[f + 2 * WIDTH + i],
        )  # fmt: skip
        answer[i], answer[WIDTH + i], answer[2 * WIDTH + i] = a, b, c


def step(state, joints, weight, keep, answer, trial, room, longest, rows):
    """-J^T answer of the joints that are free, and in ``room`` the factor that makes it no longer than allowed."""
    n = len(joints)
    for i in range(rows):
        room[i] = 0.0
    for k in range(n):
        at, j, turn = k * WIDTH, (n + 2 * k) * WIDTH, weight * joints[k, 5]
        for i in range(rows):
            jx, jy = state[j + i], state[j + WIDTH + i]
            change = -keep[at + i] * (jx * answer[i] + jy * answer[WIDTH + i] + turn * answer[2 * WIDTH + i])
            trial[at + i] = change
            room[i] += change * change
    for i in range(rows):
        room[i] = shortening(np.sqrt(room[i]), longest)  # noqa: F821


def move(state, joints, bounds, weight, room, trial, model, rows):
    """Joints after the step, within the bounds, and the error that the linear model expects there."""
    n = len(joints)
    f = 3 * n * WIDTH
    for i in range(3 * WIDTH):
        model[i] = state[f + i]
    for k in range(n):
        lower, upper, turn = bounds[0, k], bounds[1, k], weight * joints[k, 5]
        at, j = k * WIDTH, (n + 2 * k) * WIDTH
        for i in range(rows):
            q = state[at + i]
            there = min(max(q + trial[at + i] * room[i], lower), upper)
            trial[at + i] = there
            model[i] += state[j + i] * (there - q)
            model[WIDTH + i] += state[j + WIDTH + i] * (there - q)
            model[2 * WIDTH + i] += turn * (there - q)


def take(state, trial, slopes, there, square, expected, now, taken, n, rows):
    """The steps that gain what they should, with the Jacobian and the error at their ends; mu adapts."""
    mu = (3 * n + 6) * WIDTH
    for i in range(rows):
        gained = gain(square[i], expected[i], now[i])  # noqa: F821
        state[mu + i], taken[i] = adapted(state[mu + i], gained)  # noqa: F821
    for i in range(rows):
        square[i] = now[i] if taken[i] > 0.0 else square[i]
    for c in range(2 * n):
        at = (n + c) * WIDTH
        for i in range(rows):
            state[at + i] = slopes[c * WIDTH + i] if taken[i] > 0.0 else state[at + i]
    for c in range(3):
        at = (3 * n + c) * WIDTH
        for i in range(rows):
            state[at + i] = there[c * WIDTH + i] if taken[i] > 0.0 else state[at + i]


def advance(state, trial, taken, length, size, small, n, codes, rows):
    """Joints where their steps are taken; a row whose step was nothing has stalled."""
    for i in range(rows):
        length[i] = 0.0
        size[i] = 0.0
    for k in range(n):
        at = k * WIDTH
        for i in range(rows):
            change = trial[at + i] - state[at + i]
            length[i] += change * change
            state[at + i] = trial[at + i] if taken[i] > 0.0 else state[at + i]
            size[i] += state[at + i] * state[at + i]
    for i in range(rows):
        if still(np.sqrt(length[i]), np.sqrt(size[i]), small) > 0.0:  # noqa: F821
            codes[i] = STALLED


def leave(state, square, which, codes, used, q, code, iterations, miss, start, n, rows, last):
    """Rows that are done go out; those still open close up, unless it is the last time. Returns how many are open."""
    left = 0
    for i in range(rows):
        if codes[i] == OPEN and not last:
            left += 1
        else:
            row = start + which[i]
            code[row], iterations[row], miss[row] = codes[i], used, np.sqrt(square[i])
            for k in range(n):
                q[row * n + k] = state[k * WIDTH + i]
    if left == rows or last:
        return left
    order = np.empty(left, np.int64)
    to = 0
    for i in range(rows):
        if codes[i] == OPEN:
            order[to] = i
            to += 1
    for c in range(3 * n + 7):
        for i in range(left):
            state[c * WIDTH + i] = state[c * WIDTH + order[i]]
    for i in range(left):
        square[i], which[i], codes[i] = square[order[i]], which[order[i]], OPEN
    return left


def begin(q, aims, joints, ends, frames, bounds, settings, state, place, square, codes, start, rows):
    """The state of a block of rows at the first guess, brought within the bounds."""
    n = len(joints)
    f, goal, mu = 3 * n * WIDTH, (3 * n + 3) * WIDTH, (3 * n + 6) * WIDTH
    load(q, state, start, rows, n)  # noqa: F821
    for k in range(n):
        for i in range(rows):
            state[k * WIDTH + i] = min(max(state[k * WIDTH + i], bounds[0, k]), bounds[1, k])
    for c in range(3):
        for i in range(rows):
            state[goal + c * WIDTH + i] = aims[c, start + i] if c < len(aims) else 0.0
    for i in range(rows):
        state[mu + i] = settings[2]
    fold(state, joints, frames, place, rows)  # noqa: F821
    columns(place, joints, ends, state[n * WIDTH : f], rows)  # noqa: F821
    errors(place, state, state[f:goal], n, settings[4], rows)
    squares(state[f:goal], square, rows)
    for i in range(rows):
        codes[i] = OPEN if square[i] < np.inf else NOT_FINITE


def search_block(q, aims, joints, ends, frames, bounds, settings, budget, out, code, iterations, miss, start, rows):
    """One block of targets from the first guess to the end."""
    n = len(joints)
    tolerance, small, longest, weight = settings[0], settings[1], settings[3], settings[4]
    state, place = np.zeros((3 * n + 7) * WIDTH), np.empty(3 * (n + 2) * WIDTH)
    trial, keep, slopes = np.empty(n * WIDTH), np.empty(n * WIDTH), np.empty(2 * n * WIDTH)
    matrix, answer, model, there = (np.empty(6 * WIDTH), np.empty(3 * WIDTH), np.zeros(3 * WIDTH), np.empty(3 * WIDTH))
    square, expected, now, taken = np.empty(WIDTH), np.empty(WIDTH), np.empty(WIDTH), np.empty(WIDTH)
    which, codes = np.arange(WIDTH), np.zeros(WIDTH, np.int64)
    begin(q, aims, joints, ends, frames, bounds, settings, state, place, square, codes, start, rows)
    for used in range(budget + 1):
        for i in range(rows):
            if square[i] <= tolerance * tolerance:
                codes[i] = CONVERGED
        rows = leave(state, square, which, codes, used, out, code, iterations, miss, start, n, rows, used == budget)
        if rows == 0:
            break
        normal(state, joints, bounds, weight, keep, matrix, rows)
        solve(state, matrix, square, n, answer, rows)
        step(state, joints, weight, keep, answer, trial, taken, longest, rows)
        move(state, joints, bounds, weight, taken, trial, model, rows)
        fold(trial, joints, frames, place, rows)  # noqa: F821
        columns(place, joints, ends, slopes, rows)  # noqa: F821
        errors(place, state, there, n, weight, rows)
        squares(model, expected, rows)
        squares(there, now, rows)
        take(state, trial, slopes, there, square, expected, now, taken, n, rows)
        advance(state, trial, taken, expected, now, small, n, codes, rows)


def search_serial(q, aims, joints, ends, frames, bounds, settings, budget, out, code, iterations, miss, rows):
    """All blocks, one after another."""
    for b in range((rows + WIDTH - 1) // WIDTH):
        start = b * WIDTH
        size = min(WIDTH, rows - start)
        search_block(
            q, aims, joints, ends, frames, bounds, settings, budget, out, code, iterations, miss, start, size
        )


def search_parallel(q, aims, joints, ends, frames, bounds, settings, budget, out, code, iterations, miss, rows):
    """All blocks, shared among threads."""
    for b in prange((rows + WIDTH - 1) // WIDTH):
        start = b * WIDTH
        size = min(WIDTH, rows - start)
        search_block(
            q, aims, joints, ends, frames, bounds, settings, budget, out, code, iterations, miss, start, size
        )


PARTS = (
    *chains.PARTS[:-1], errors, squares, normal, solve, step, move, take, advance, leave, begin, search_block,
)  # fmt: skip
