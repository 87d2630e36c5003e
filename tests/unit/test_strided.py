"""Compiled loops over arrays that do not lie one entry after another: columns of tables, every other row, reversed."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar import Arm, Pose
from coplanar.engine import Evaluator, evaluator
from coplanar.engine.compiled import kernels
from coplanar.laws import arms, se2
from tests.engines import NEEDS_NUMBA

pytestmark = NEEDS_NUMBA

BLOCK = 4096


def numbers(shape, seed=0):
    return np.random.default_rng(seed).uniform(-3.0, 3.0, shape)


LAYOUTS = {
    "columns of points": lambda n: [numbers((n, 2))[:, k] for k in (0, 1)],
    "columns of poses": lambda n: [numbers((n, 3))[:, k] for k in (2, 0)],
    "a column and an array": lambda n: [numbers((n, 2))[:, 1], numbers(n, 1)],
    "a column and a number": lambda n: [numbers((n, 5))[:, 1], np.float64(0.3)],
    "every other row": lambda n: [numbers(2 * n)[::2], numbers(3 * n, 1)[1::3]],
    "backwards": lambda n: [numbers((n, 2))[::-1, 0], numbers(n, 1)[::-1]],
    "two axes": lambda n: [numbers((2, n, 2))[..., k] for k in (0, 1)],
    "two axes that do not meet": lambda n: [numbers((2, 2 * n, 2))[:, :n, k] for k in (0, 1)],
    "upright": lambda n: [numbers((n, 2)).T, numbers((n, 2), 1).T],
    "spread over an axis": lambda n: [numbers((n, 2))[:, 0], numbers((3, 1), 1)],
    "a row for a table": lambda n: [numbers((n, 3)), numbers(3, 1)],
    "rows that divide one another": lambda n: [numbers((n, 2, 3))[..., 0, None] + numbers((2, 3)), numbers(3, 1)],
    "rows of two lengths": lambda n: [numbers((2, 1, 3)) + numbers((n, 1, 1, 1)), numbers((2, 1, 1), 1) + numbers(3)],
    "a row spread by hand": lambda n: [numbers((n, 5)), np.broadcast_to(numbers(5, 1), (n, 5))],
    "a row longer than a block": lambda n: [numbers((2, BLOCK + n)), numbers(BLOCK + n, 1)],
    "a row backwards": lambda n: [numbers((n, 7)), numbers(14, 1)[::-2]],
    "a row and points": lambda n: [numbers((n, 4))[:, ::2], numbers(2, 1)],
    "a row and what has to be laid out": lambda n: [numbers((4, n)).T, numbers(4, 1)],
    "broadcast": lambda n: np.broadcast_arrays(numbers(n), numbers(n, 1)),
    "read-only": lambda n: [_fixed(numbers((n, 2)))[:, k] for k in (0, 1)],
}


def _fixed(array):
    array.flags.writeable = False
    return array


@pytest.mark.parametrize("n", [1, 2, 7, BLOCK - 1, BLOCK, BLOCK + 1, 3 * BLOCK + 5])
@pytest.mark.parametrize("layout", LAYOUTS)
def test_the_answer_does_not_hang_on_how_arrays_lie(layout, n):
    law = evaluator(arms.link)
    given = [0.5, 0.25, *LAYOUTS[layout](n)]
    before = [np.array(a) for a in given]
    plain = [np.ascontiguousarray(np.broadcast_to(a, np.broadcast_shapes(*map(np.shape, given)))) for a in given]
    for ours, theirs in zip(law.on_compiled(*given), law.on_compiled(*plain), strict=True):
        assert ours.shape == plain[0].shape
        assert np.array_equal(ours, theirs)
    assert all(np.array_equal(a, b) for a, b in zip(given, before, strict=True))


@pytest.mark.parametrize("third", ["upright", "broadcast"])
@pytest.mark.parametrize("layout", LAYOUTS)
def test_nor_on_the_parts_that_some_are_laid_out_in(layout, third, monkeypatch):
    monkeypatch.setattr(kernels, "SPREAD_ROWS", 1000)
    law, n = evaluator(arms.link), BLOCK + 321
    given = [0.5, *LAYOUTS[layout](n)]
    shape = np.broadcast_shapes(*map(np.shape, given))
    spread = numbers(shape[::-1], 2).T if third == "upright" else np.broadcast_to(numbers((*shape[:-1], 1), 2), shape)
    plain = [np.ascontiguousarray(np.broadcast_to(a, shape)) for a in (spread, *given)]
    for ours, theirs in zip(law.on_compiled(spread, *given), law.on_compiled(*plain), strict=True):
        assert np.array_equal(ours, theirs)


def test_rows_of_a_table_that_repeat_are_read_again_by_the_safe_law():
    law, table = evaluator(se2.rotate), numbers((BLOCK, 3))
    angles = np.array([0.5, 1e7, -2.0])
    x, _ = law.on_compiled(angles, table, 1.0)
    assert np.allclose(x, np.cos(angles) * table - np.sin(angles), atol=1e-14)


def test_rows_that_the_fast_law_leaves_are_answered_from_where_they_lie():
    law, table = evaluator(se2.rotate), numbers((BLOCK + 9, 3))
    table[[0, 77, BLOCK + 8], 0] = 1e7, -3e9, 1e300
    c, s = np.cos(table[:, 0]), np.sin(table[:, 0])
    x, y = law.on_compiled(table[:, 0], table[:, 1], table[:, 2])
    assert np.allclose(x, c * table[:, 1] - s * table[:, 2], atol=1e-14)
    assert np.allclose(y, s * table[:, 1] + c * table[:, 2], atol=1e-14)


def test_single_precision_lies_apart_too():
    law, table = evaluator(arms.link), numbers((BLOCK + 9, 2)).astype(np.float32)
    one = np.float32(1.0) + 0.0 * table[:, 0]
    x, _ = law.on_compiled(one, one, table[:, 0], table[:, 1])
    assert x.dtype == np.float32
    assert np.array_equal(x, law.on_compiled(one, one, *(table[:, k].copy() for k in (0, 1)))[0])


def test_an_output_over_its_own_table_is_written_after_it_was_read():
    law, table = evaluator(arms.link), numbers((BLOCK + 9, 2))
    expected = law.on_compiled(0.0, 0.0, table[:, 0].copy(), table[:, 1].copy())
    law.on_compiled(0.0, 0.0, table[:, 0], table[:, 1], out=(table[:, 0], table[:, 1]))
    assert np.array_equal(table.T, expected)


def test_columns_far_apart_are_no_second_compilation_and_points_are_one():
    law = Evaluator(arms.link)
    law.on_compiled(0.0, 0.0, numbers(9), numbers(9))
    law.on_compiled(0.0, 0.0, numbers((9, 4))[:, 0], numbers((9, 3))[:, 1])
    (loop,) = law.kernel()._loops.values()
    assert len(loop.overloads) == 1
    law.on_compiled(0.0, 0.0, *numbers((9, 2)).T)
    law.on_compiled(0.0, 0.0, *numbers((20, 2))[2:].T)
    assert [len(loop.overloads) for loop in law.kernel()._loops.values()] == [1, 1]


def test_points_and_targets_are_tables():
    table = numbers((30_000, 2))
    moved = Pose(1.0, 2.0, 0.5) @ table
    for row in (0, 12_345, 29_999):
        assert np.allclose(moved[row], Pose(1.0, 2.0, 0.5) @ table[row], atol=1e-14)
    answer = Arm((2.0, 1.5)).inverse(table)
    kept = table.copy()
    table[:] = 0.0
    assert np.array_equal(answer.target, kept)
    reached = answer.reached
    assert np.allclose(Arm((2.0, 1.5)).forward(answer.branches[:, 1]).position[reached], kept[reached], atol=1e-13)
