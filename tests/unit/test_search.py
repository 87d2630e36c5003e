"""Searches along an integral: every evaluator, shapes, rows that need the safe laws, rounds that are spent."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar import errors
from coplanar.engine import Integral, Search, absolute, exp, log, log1p, where
from tests.engines import BATCH_SHAPES, NEEDS_NUMBA


def begin(wanted, rate):
    """How far to integrate exp(rate s) from 0 to have as much as is wanted."""
    return 0.0 * wanted, 0.9 * log1p(rate * wanted) / rate, 0.0 * wanted, wanted, rate


def span(lower, upper, area, wanted, rate):
    """A panel for every 4 of the exponent."""
    return absolute(rate * (upper - lower)) / 4.0, lower, upper, rate


def growth(s, rate):
    """exp(rate s)."""
    return (exp(rate * s),)


def improve(lower, upper, area, wanted, rate, more):
    """Newton on the logarithm, which is nearly straight."""
    area = area + more
    step = area / exp(rate * upper) * log(wanted / area)
    return where(absolute(step) > 1e-9 * upper, 1.0, 0.0), upper, upper + step, area


def finish(going, lower, upper, area, wanted, rate):
    """Where, and whether the rounds were spent."""
    return upper, going


def search(**words):
    return Search(begin, span, Integral(growth), improve, finish, **words)


def exact(wanted, rate):
    return np.log1p(rate * wanted) / rate


ENGINES = ["text", pytest.param("compiled", marks=NEEDS_NUMBA)]


@pytest.fixture(scope="module")
def shared():
    return search()


def run(shared, engine, wanted, rate, **words):
    arrays = [np.asarray(a, float) for a in (wanted, rate)]
    return getattr(shared, f"on_{engine}")(arrays, np.broadcast_shapes(*(a.shape for a in arrays)), **words)


@pytest.mark.parametrize("engine", ENGINES)
class TestArrays:
    def test_rows_of_one_and_of_many_panels(self, shared, engine):
        wanted, rate = 10.0 ** np.linspace(-3.0, 12.0, 700), 0.7
        upper, going = run(shared, engine, wanted, rate)
        assert np.allclose(upper, exact(wanted, rate), rtol=1e-13)
        assert not going.any()

    def test_floats_agree(self, shared, engine):
        wanted = np.linspace(0.1, 50.0, 20)
        upper, _ = run(shared, engine, wanted, 0.3)
        assert np.allclose(upper, [shared.on_floats(w, 0.3)[0] for w in wanted.tolist()], rtol=1e-13)

    @pytest.mark.parametrize("shape", BATCH_SHAPES)
    def test_shapes(self, shared, engine, shape):
        upper, _ = run(shared, engine, np.full(shape, 2.0), np.full(shape[-1:], 0.5))
        assert upper.shape == shape
        assert np.allclose(upper, exact(2.0, 0.5), rtol=1e-13)

    def test_rows_that_lie_elsewhere_in_memory(self, shared, engine):
        wanted = np.linspace(0.1, 50.0, 600).reshape(20, 30).T
        assert np.allclose(run(shared, engine, wanted, 0.3)[0], exact(wanted, 0.3), rtol=1e-13)

    def test_a_row_beyond_the_fast_primitives_is_found_safely(self, shared, engine):
        wanted = np.array([1.0, 1e305, 2.0])
        with np.errstate(all="ignore"):
            upper, going = run(shared, engine, wanted, 1.0)
        assert np.allclose(upper, exact(wanted, 1.0), rtol=1e-13)
        assert not going.any()

    def test_a_row_that_is_not_a_number_stays_alone(self, shared, engine):
        upper, _ = run(shared, engine, np.array([1.0, np.nan, 2.0]), 0.5)
        assert np.isnan(upper[1])
        assert np.allclose(upper[[0, 2]], exact(np.array([1.0, 2.0]), 0.5), rtol=1e-13)

    def test_spent_rounds_are_told(self, shared, engine):
        _, going = run(shared, engine, np.array([1.0, 1e6]), 0.5, rounds=2)
        assert going.tolist() == [1.0, 1.0]

    def test_no_rows(self, shared, engine):
        assert run(shared, engine, np.empty(0), 0.5)[0].shape == (0,)


class TestCalls:
    def test_floats_in_floats_out(self):
        answer = search()(2.0, 0.5)
        assert {type(a) for a in answer} == {float}
        assert answer[0] == pytest.approx(exact(2.0, 0.5), rel=1e-14)

    def test_floats_that_math_refuses_are_not_numbers(self):
        assert np.isnan(search().on_floats(0.0, 0.5)[0])

    def test_one_row_is_that_of_floats(self):
        one = search()
        assert one(np.array([[2.0]]), 0.5)[0].tolist() == [[one(2.0, 0.5)[0]]]

    def test_refuses_shapes_that_do_not_broadcast(self):
        with pytest.raises(errors.InvalidShape, match=r"\(2,\), \(3,\)"):
            search()(np.ones(2), np.ones(3))

    def test_the_rounds_of_a_search_are_its_own(self):
        assert search(rounds=1)(2.0, 0.5)[1] == 1.0

    def test_refuses_another_rule(self):
        with pytest.raises(ValueError, match="16 points"):
            Search(begin, span, Integral(growth, 8), improve, finish)

    @NEEDS_NUMBA
    def test_a_call_by_floats_is_compiled_once_a_batch_was(self):
        both = search()
        slow = both(3.0, 0.5)
        both.on_compiled([np.linspace(1.0, 2.0, 5), np.array(0.5)], (5,))
        assert both._loops.single is not None
        assert both(3.0, 0.5) == pytest.approx(slow, rel=1e-14)
