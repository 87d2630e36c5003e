"""Calls within ``warm_up`` wait for the compiler; the same calls later go by what was compiled."""

from __future__ import annotations

import math
import sys

import numpy as np
import pytest

from coplanar import Pose, Projectile, Segment, warm_up
from coplanar.engine import Evaluator, Integral, Search, policy, reproducible, sincos, sqrt
from tests.engines import NEEDS_NUMBA

pytestmark = NEEDS_NUMBA


def spiral(angle, growth):
    """A point of a spiral: more than a handful of operations."""
    s, c = sincos(angle)
    radius = sqrt(1.0 + growth * angle * angle)
    return radius * c, radius * s, (1.0 - growth) / (angle * angle)


def begin(wanted):
    return 0.0 * wanted, wanted, 0.0 * wanted, wanted


def span(lower, upper, area, wanted):
    return 0.5, lower, upper


def growth(s):
    return (1.0 + s,)


def improve(lower, upper, area, wanted, more):
    step = (wanted - area - more) / (1.0 + upper)
    return 1.0 * (step * step > 1e-24), upper, upper + step, area + more


def finish(going, lower, upper, area, wanted):
    return (upper,)


def test_a_single_call_is_compiled_where_that_is_asked_for():
    law = Evaluator(spiral)
    expected = law(0.7, 0.2)
    assert law._one is None
    with warm_up():
        assert law(0.7, 0.2) == pytest.approx(expected, rel=1e-15)
    assert law._one is not None
    assert law(0.7, 0.2) == law._one((0.7, 0.2))
    assert {type(part) for part in law(0.7, 0.2)} == {float}


def test_what_is_no_float_is_answered_as_before():
    law = Evaluator(spiral)
    expected = law(1.0, 2.0)
    with warm_up():
        law(1.0, 2.0)
    assert law(1, 2) == pytest.approx(expected, rel=1e-15)
    assert law(np.float64(1.0), 2.0) == pytest.approx(expected, rel=1e-15)
    column = law(np.array([1.0]), 2.0)[0]
    assert column.shape == (1,)
    assert law(1.0, np.array([2.0, 2.0]))[0].shape == (2,)
    with pytest.raises(TypeError):
        law._one((1, 2.0))


def test_a_division_by_zero_is_what_arrays_make_of_it():
    law = Evaluator(spiral)
    with warm_up():
        assert law(0.0, 0.2)[2] == math.inf
        assert math.isnan(law(0.0, 1.0)[2])


def test_reproducible_digits_are_those_of_math():
    law = Evaluator(spiral)
    with warm_up():
        law(0.7, 0.2)
    law._one = lambda _: (0.0, 0.0, 0.0)
    with reproducible():
        assert law(0.7, 0.2) == law.on_floats(0.7, 0.2)


def test_a_small_batch_and_a_search_are_compiled_too():
    law, search = Evaluator(spiral), Search(begin, span, Integral(growth), improve, finish)
    with warm_up():
        assert law(np.array([0.7, 0.8]), 0.2)[0].shape == (2,)
        assert search(1.5)[0] == pytest.approx(1.0)
    assert law._kernel is not None
    assert search._loops.single is not None


def test_things_answer_as_before():
    segment, ball = Segment(1.0, 0.5, 0.2, 0.4, duration=1.0), Projectile(mass=1.0, drag=0.02)
    before = segment.end(Pose()), ball.launch(speed=20.0, angle=0.5).impact().state.x, ball.aim((15.0, 2.0), speed=20.0)
    with warm_up():
        now = (
            segment.end(Pose()),
            ball.launch(speed=20.0, angle=0.5).impact().state.x,
            ball.aim((15.0, 2.0), speed=20.0),
        )
    assert now[0].parts == pytest.approx(before[0].parts, abs=1e-15)
    assert now[1] == pytest.approx(before[1], rel=1e-14)
    assert now[2].angles == pytest.approx(before[2].angles, rel=1e-13)


def test_without_a_compiler_nothing_changes(monkeypatch):
    monkeypatch.setattr(policy, "can_compile", lambda: False)
    monkeypatch.setattr(sys.modules["coplanar.engine.evaluator"], "can_compile", lambda: False)
    law = Evaluator(spiral)
    with warm_up():
        assert law(0.7, 0.2) == law.on_floats(0.7, 0.2)
        assert law(np.array([0.7]), 0.2)[0].shape == (1,)
    assert law._one is None


def test_the_block_ends():
    with pytest.raises(RuntimeError), warm_up():
        raise RuntimeError
    assert not policy.mode.get()


def test_a_small_batch_does_not_wait_because_a_single_call_was_warmed_up(monkeypatch):
    law, search = Evaluator(spiral), Search(begin, span, Integral(growth), improve, finish)
    with warm_up():
        law(0.7, 0.2)
        search(1.5)
    monkeypatch.setattr(law._kernel, "run", None)
    monkeypatch.setattr(search._loops, "run", None)
    assert law(np.array([0.7, 0.8]), 0.2)[0].shape == (2,)
    assert search(np.array([1.5, 1.6]))[0].shape == (2,)
