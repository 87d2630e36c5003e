"""What holds for the parts of damped least squares: small systems are solved, steps are short, damping adapts."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar.engine import evaluator
from coplanar.laws import squares as laws

numbers = st.floats(-3.0, 3.0)
sizes = st.floats(0.0, 10.0)
gentle = settings(deadline=None, max_examples=60)


@gentle
@given(
    rows=st.lists(st.lists(numbers, min_size=3, max_size=3), min_size=3, max_size=3), right=st.tuples(*[numbers] * 3)
)
def test_the_system_of_three_is_solved(rows, right):
    matrix = np.array(rows) @ np.array(rows).T + 0.1 * np.eye(3)
    a, b, c, d, e, f = (float(matrix[i, j]) for i, j in zip(*np.triu_indices(3), strict=True))
    answer = evaluator(laws.solve_three)(a, b, c, d, e, f, *right)
    assert np.abs(matrix @ answer - right).max() < 1e-10


def test_a_system_of_two_is_one_of_three_with_nothing_in_the_third():
    answer = evaluator(laws.solve_three)(2.0, 1.0, 0.0, 3.0, 0.0, 1e-300, 1.0, 2.0, 0.0)
    assert answer[:2] == pytest.approx(tuple(np.linalg.solve([[2.0, 1.0], [1.0, 3.0]], [1.0, 2.0])))
    assert answer[2] == 0.0


@gentle
@given(length=sizes, longest=st.floats(1e-3, 10.0))
def test_a_step_is_no_longer_than_allowed_and_no_shorter_than_need_be(length, longest):
    factor = evaluator(laws.shortening)(length, longest)
    assert factor * length == pytest.approx(min(length, longest))
    assert evaluator(laws.shortening)(np.inf, longest) == 1.0


@gentle
@given(square=st.floats(0.01, 10.0), part=st.floats(0.01, 1.0))
def test_the_gain_is_one_where_the_model_holds(square, part):
    predicted = square * (1.0 - part)
    assert evaluator(laws.gain)(square, predicted, predicted) == pytest.approx(1.0)
    assert evaluator(laws.gain)(square, predicted, square) == 0.0
    assert evaluator(laws.gain)(square, square, 0.0) == -1.0
    assert np.isnan(evaluator(laws.gain)(1.0, 0.5, np.nan))


@pytest.mark.parametrize(
    ("gained", "factor", "taken"),
    [(1.0, 0.1, 1.0), (0.5, 1.0, 1.0), (0.1, 4.0, 1.0), (0.0, 16.0, 0.0), (-1.0, 16.0, 0.0), (np.nan, 16.0, 0.0)],
)
def test_damping_falls_with_the_gain_and_a_step_without_gain_is_refused(gained, factor, taken):
    assert evaluator(laws.adapted)(0.1, gained) == (pytest.approx(0.1 * factor), taken)
    assert evaluator(laws.adapted)(0.0, gained)[0] == laws.DAMPING_FLOOR


@pytest.mark.parametrize(
    ("x", "slope", "free"), [(-1.0, 1.0, 0.0), (-1.0, -1.0, 1.0), (1.0, -1.0, 0.0), (1.0, 1.0, 1.0), (0.0, 1.0, 1.0)]
)
def test_what_stands_at_a_bound_is_free_to_leave_it_only(x, slope, free):
    assert evaluator(laws.free)(x, -1.0, 1.0, slope) == free


def test_a_step_is_nothing_beside_where_it_starts():
    still = evaluator(laws.still)
    assert [still(s, 1e3, 1e-14) for s in (0.0, 1e-12, 1e-11, 1e-10)] == [1.0, 1.0, 1.0, 0.0]
    assert still(np.nan, 1.0, 1e-14) == 0.0


def test_a_system_without_rank_is_damped_all_the_same():
    assert evaluator(laws.damping)(0.1, 0.0, 0.0) > 0.0
    assert evaluator(laws.damping)(0.1, 4.0, 0.0) == pytest.approx(0.4)
    assert evaluator(laws.damping)(0.0, 4.0, 1.0) == pytest.approx(laws.LEAST_DAMPING)
