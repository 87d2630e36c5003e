"""The loops of a search along an integral: a block of rows advances together, and rows that have settled leave.

``begin``, ``span``, ``rates``, ``improve``, ``finish``, their safe forms and the constants GIVEN (how many inputs), ROW
(numbers of a row), WITH (and whether it goes on), STATE, SPAN (what a span has), ARGS (of them parameters), SUMS and
OUT (of an answer) are names that ``coplanar.engine.compiled.search`` supplies; the bodies are templates and never run
as they stand. A row shows a NaN where a fast primitive does not answer; it is searched for again, safely, from its
beginning.

The columns of the table are the row (ROW), its span (how many panels; middle and half of the present one; the
parameters), the sums of the present panel (SUMS), the integrals (SUMS), and whether it goes on.
"""

from __future__ import annotations

import math

import numpy as np
from numba import prange

from coplanar.engine import gauss
from coplanar.engine.compiled.columns import WIDTH, align_stack, get, pick, put, scatter, some, sum_of, table_of
from coplanar.engine.compiled.door import numbers
from coplanar.engine.compiled.primitives import add_terms, scaled_terms

MOST_SPAN = 16.0  # panels of a row in the vector code; beyond, it is left to the safe laws
WORK = 20  # a row of a search is the work of so many rows of a law
COUNTS = np.array([nodes for nodes, _ in gauss.PARTS])
SHARES = np.array([part for _, part in gauss.PARTS])
NODES, WEIGHTS = (np.zeros((len(COUNTS), gauss.WHOLE)) for _ in range(2))
for _k, _count in enumerate(COUNTS):
    NODES[_k, :_count], WEIGHTS[_k, :_count] = gauss.rule(int(_count))


def rule_for(share):
    """Which of the rules serves such a part of a panel."""
    k = 0
    while k < len(SHARES) - 1 and not share <= SHARES[k]:
        k += 1
    return k


def spans(table, rows):
    """The next integral of every row; returns the most panels, and the greatest part of a panel."""
    for i in range(rows):
        put(table, ROW, i, span(*some(table, 0, i, ROW)))  # noqa: F821
    most = share = 1e-9
    for i in range(rows):
        panels = get(table, ROW, i)  # noqa: F821
        count = max(1.0, np.ceil(panels))
        most = max(most, count if count <= MOST_SPAN else 1.0)
        share = max(share, panels / count)
    for i in range(rows):
        panels, lower, upper = some(table, ROW, i, 3)  # noqa: F821
        count = max(1.0, np.ceil(panels))
        half = 0.5 * (upper - lower) / count
        half = half if panels <= MOST_SPAN else math.nan
        put(table, ROW, i, (count, lower + half, half))  # noqa: F821
    return most, share


def panel(table, nodes, weights, count, rows):
    """The sums over the present panel: node by node, so that the rows, innermost, are vector code."""
    for c in range(SUMS):  # noqa: F821
        for i in range(rows):
            put(table, ROW + SPAN + c, i, 0.0)  # noqa: F821
    for j in range(count):
        node, weight = nodes[j], weights[j]
        for i in range(rows):
            middle, half = some(table, ROW + 1, i, 2)  # noqa: F821
            terms = rates(middle + node * half, *some(table, ROW + 3, i, ARGS))  # noqa: F821
            put(table, ROW + SPAN, i, add_terms(some(table, ROW + SPAN, i, SUMS), weight, terms))  # noqa: F821


def integrals(table, place, rows):
    """All panels of every row. After the first one, rows that need more close up at the front of their columns."""
    first, total = ROW + SPAN, ROW + SPAN + SUMS  # noqa: F821
    most, share = spans(table, rows)
    k = rule_for(share)
    panel(table, NODES[k], WEIGHTS[k], COUNTS[k], rows)
    for i in range(rows):
        put(table, total, i, scaled_terms(some(table, first, i, SUMS), get(table, ROW + 2, i)))  # noqa: F821
        place[i] = i
    left, done = rows, 1.0
    while done < most:
        open_rows = 0
        for i in range(left):
            if get(table, ROW, i) > done:  # noqa: F821
                put(table, ROW, open_rows, some(table, ROW, i, SPAN))  # noqa: F821
                put(table, ROW + 1, open_rows, get(table, ROW + 1, open_rows) + 2.0 * get(table, ROW + 2, open_rows))  # noqa: F821
                place[open_rows] = place[i]
                open_rows += 1
        left = open_rows
        panel(table, NODES[k], WEIGHTS[k], COUNTS[k], left)
        for i in range(left):
            half = get(table, ROW + 2, i)  # noqa: F821
            so_far = some(table, total, place[i], SUMS)  # noqa: F821
            put(table, total, place[i], add_terms(so_far, half, some(table, first, i, SUMS)))  # noqa: F821
        done += 1.0


def judge(table, rows):
    """The next state of every row. Returns how many go on."""
    align_stack()
    total = ROW + SPAN + SUMS  # noqa: F821
    for i in range(rows):
        answer = improve(*some(table, 0, i, ROW), *some(table, total, i, SUMS))  # noqa: F821
        put(table, 0, i, answer[1:])
        put(table, total + SUMS, i, answer[0])  # noqa: F821
    left = 0
    for i in range(rows):
        left += 1 if get(table, total + SUMS, i) > 0.0 else 0  # noqa: F821
    return left


def leave(table, settled, which, rows):
    """Rows that go no further are put where they began, and the others close up."""
    mark = ROW + SPAN + 2 * SUMS  # noqa: F821
    left = 0
    for i in range(rows):
        if get(table, mark, i) > 0.0:
            if left != i:
                put(table, 0, left, some(table, 0, i, ROW))  # noqa: F821
                which[left] = which[i]
            left += 1
        else:
            put(settled, 1, which[i], some(table, 0, i, ROW))  # noqa: F821
            put(settled, 0, which[i], 0.0)
    return left


def rounds_block(ins, steps, outs, most, start, rows):
    """One block of rows from its beginning to the answers."""
    align_stack()
    table = table_of(max(ROW + 1 + SPAN + 2 * SUMS, OUT))  # noqa: F821
    settled = table_of(max(1 + ROW, GIVEN))  # noqa: F821
    which, place = np.arange(WIDTH), np.empty(WIDTH, np.int64)
    for i in range(rows):
        put(settled, 0, i, pick(ins, steps, start + i))
    for i in range(rows):
        put(table, 0, i, begin(*some(settled, 0, i, GIVEN)))  # noqa: F821
    open_rows = rows
    for _ in range(most):
        integrals(table, place, open_rows)
        if judge(table, open_rows) < open_rows:
            open_rows = leave(table, settled, which, open_rows)
        if open_rows == 0:
            break
    for i in range(open_rows):
        put(settled, 1, which[i], some(table, 0, i, ROW))  # noqa: F821
        put(settled, 0, which[i], 1.0)
    doubtful = 0
    for i in range(rows):
        put(table, 0, i, finish(*some(settled, 0, i, WITH)))  # noqa: F821
    for i in range(rows):
        check = scatter(outs, start, i, some(table, 0, i, OUT))  # noqa: F821
        doubtful += 0 if check == check else 1  # NaN is what does not equal itself
    if doubtful:
        again(ins, steps, outs, most, start, rows)


def again(ins, steps, outs, most, start, rows):
    """The rows that came out as NaN, safely."""
    for i in range(rows):
        if sum_of(outs, start, i) != sum_of(outs, start, i):
            search_row(ins, steps, outs, most, start, i)


def search_row(ins, steps, outs, most, start, i):
    """One row from its beginning to the answer by the safe laws."""
    scatter(outs, start, i, answer_of(pick(ins, steps, start + i), most))


def rounds_one(inputs, most):
    """One row of Python floats."""
    return answer_of(numbers(inputs), most)


def answer_of(inputs, most):
    """The answer to one row by the safe laws."""
    row = safe_begin(*inputs)  # noqa: F821
    going = 1.0
    for _ in range(most):
        if going > 0.0:
            sums = row_integrals(safe_span(*row))  # noqa: F821
            going, row = row_after(row, sums)
    return safe_finish(going, *row)  # noqa: F821


def row_after(row, sums):
    """Whether one row goes on, and what it is then."""
    answer = safe_improve(*row, *sums)  # noqa: F821
    return answer[0], answer[1:] + row[STATE:]  # noqa: F821


def row_integrals(given):
    """The integrals of one row."""
    panels, lower, upper = given[0], given[1], given[2]
    fine = panels <= gauss.MOST_PANELS
    count = max(1, math.ceil(panels)) if fine else 1
    half = 0.5 * (upper - lower) / count if fine else math.nan
    k = rule_for(panels / count)
    total = scaled_terms(safe_rates(lower + (1.0 + NODES[k, 0]) * half, *given[3:]), WEIGHTS[k, 0])  # noqa: F821
    for n in range(1, count * COUNTS[k]):
        p, j = n // COUNTS[k], n % COUNTS[k]
        at = lower + (2 * p + 1 + NODES[k, j]) * half
        total = add_terms(total, WEIGHTS[k, j], safe_rates(at, *given[3:]))  # noqa: F821
    return scaled_terms(total, half)


def rounds_serial(ins, steps, outs, rows, most):
    """All blocks, one after another; nothing is counted."""
    for b in range((rows + WIDTH - 1) // WIDTH):
        start = b * WIDTH
        rounds_block(ins, steps, outs, most, start, min(WIDTH, rows - start))
    return 0


def rounds_parallel(ins, steps, outs, rows, most):
    """All blocks, shared among threads; nothing is counted."""
    for b in prange((rows + WIDTH - 1) // WIDTH):
        start = b * WIDTH
        rounds_block(ins, steps, outs, most, start, min(WIDTH, rows - start))
    return 0


PARTS = (
    rule_for, spans, panel, integrals, judge, leave, row_integrals, row_after, answer_of, search_row, again,
    rounds_block,
)  # fmt: skip
