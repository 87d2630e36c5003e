"""Integrals of laws: exact where they should be, and never a guess where they cannot be."""

from __future__ import annotations

import math

import numpy as np
import pytest

from coplanar.engine import Integral, absolute, cos, evaluator, sin, where
from coplanar.engine.arrays import FEW_ROWS
from coplanar.engine.gauss import MOST_PANELS, UNKNOWN, panel_count
from tests.engines import ENGINES, NEEDS_JAX, NEEDS_NUMBA, on_engine, on_floats

EPS = np.finfo(float).eps
RADIANS_A_PANEL = 3.0


def wave(s, rate):
    return cos(rate * s), sin(rate * s)


def cubic(s, a, b):
    return (a + b * s * s * s,)


turning = Integral(wave)
area = Integral(cubic, 2)


def law_of_turning(dt, rate):
    x, y = turning(absolute(rate * dt) / RADIANS_A_PANEL, 0.0, dt, rate)
    return x, y


def law_of_area(panels, lower, upper, a, b):
    (answer,) = area(panels, lower, upper, a, b)
    return answer


def law_of_the_side(dt, rate):
    x, y = turning(absolute(rate * dt) / RADIANS_A_PANEL, 0.0, dt, rate)
    return where(x > y, 1.0, -1.0)


def closed_form(dt, rate):
    half = 0.5 * rate * dt
    chord = dt * np.sinc(half / math.pi)
    return chord * np.cos(half), chord * np.sin(half)


@pytest.mark.parametrize("engine", ENGINES)
def test_any_number_of_panels_gives_the_closed_form(engine):
    rate = np.concatenate([[0.0, 1e-300, 1e-8], np.geomspace(1e-3, 90.0, 40), -np.geomspace(1e-3, 90.0, 40)])
    for dt in (1.0, -1.0, 0.0):
        x, y = on_engine(engine, law_of_turning, np.full_like(rate, dt), rate)
        right = closed_form(dt, rate)
        assert np.max(np.abs(x - right[0])) <= 4 * EPS
        assert np.max(np.abs(y - right[1])) <= 4 * EPS


@pytest.mark.parametrize("engine", ENGINES)
def test_two_points_integrate_a_cubic_exactly_by_any_panels(engine):
    panels = np.array([-3.0, 0.0, 0.5, 1.0, 1.5, 7.0])
    lower, upper = 0.5, -2.0
    answer = on_engine(engine, law_of_area, panels, *(np.full_like(panels, v) for v in (lower, upper, 2.0, 8.0)))[0]
    right = 2.0 * (upper - lower) + 2.0 * (upper**4 - lower**4)
    assert np.max(np.abs(answer - right)) <= 8 * EPS * abs(right)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 3.1 * MOST_PANELS * RADIANS_A_PANEL])
def test_a_row_without_an_integral_is_nan_and_alone(engine, bad):
    """One row that asks for NaN panels must not leave the others with one panel each."""
    dt, rate = np.ones(5), np.array([1.0, 40.0, bad, -25.0, 12.0])
    x, y = on_engine(engine, law_of_turning, dt, rate)
    good = np.arange(5) != 2
    right = closed_form(dt[good], rate[good])
    assert np.isnan([x[2], y[2]]).all()
    assert np.max(np.abs(x[good] - right[0])) <= 4 * EPS
    assert np.max(np.abs(y[good] - right[1])) <= 4 * EPS


@NEEDS_NUMBA
def test_a_comparison_does_not_hide_that_one_panel_is_not_enough():
    dt, rate = np.ones(200), np.linspace(-60.0, 60.0, 200)
    assert np.array_equal(on_engine("compiled", law_of_the_side, dt, rate), on_floats(law_of_the_side, dt, rate))


@NEEDS_JAX
def test_a_traced_integral_is_right_or_nan():
    import jax

    with jax.enable_x64(True):
        rate = jax.numpy.asarray([0.0, 1.0, 2.9 * UNKNOWN, 3.1 * UNKNOWN])
        x, y = jax.jit(evaluator(law_of_turning))(jax.numpy.ones(4), rate)
    x, y, right = np.asarray(x), np.asarray(y), closed_form(1.0, np.asarray(rate))
    assert np.max(np.abs(x - right[0])[:3]) <= 4 * EPS
    assert np.max(np.abs(y - right[1])[:3]) <= 4 * EPS
    assert np.isnan([x[3], y[3]]).all()


@NEEDS_JAX
def test_gradients_of_an_integral():
    import jax

    with jax.enable_x64(True):
        law = evaluator(law_of_turning)
        ones = jax.numpy.ones(())
        by_dt = jax.grad(lambda dt: law(dt, 2.0)[0])(ones)
        by_rate = jax.grad(lambda rate: law(1.0, rate)[1])(0.0 * ones)
    assert abs(float(by_dt) - math.cos(2.0)) <= 8 * EPS
    assert abs(float(by_rate) - 0.5) <= 8 * EPS  # d/dw of int sin(w s) ds is int s ds at w = 0


def test_panels_are_counted_over_those_that_can_be():
    assert panel_count(-1.0) == panel_count(0.0) == panel_count(1.0) == panel_count(math.nan) == 1
    assert panel_count(1.0001) == panel_count(np.array([0.1, 1.0001])) == 2
    assert panel_count(np.array([math.inf, 7.0, math.nan, 2.0 * MOST_PANELS])) == 7
    assert panel_count(np.array([])) == panel_count(math.inf) == 1
    assert panel_count(MOST_PANELS) == MOST_PANELS


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_a_few_rows_are_those_of_many_to_the_last_digit(dtype):
    """Few rows take all nodes of a panel at once, many take node after node: in the same order."""
    dt = np.linspace(0.1, 9.0, 2 * FEW_ROWS, dtype=dtype)
    rate = np.linspace(-1.0, 2.0, 2 * FEW_ROWS, dtype=dtype)
    panels = np.full_like(dt, 6.0)
    many = turning(panels, dt * 0, dt, rate)
    few = turning(panels[:7], dt[:7] * 0, dt[:7], rate[:7])
    for one, other in zip(few, many, strict=True):
        assert one.dtype == other.dtype
        assert np.array_equal(one, other[:7])
    grid = turning(panels[:3, None], dt[:3, None] * 0, dt[:3, None], rate[:4])
    assert grid[0].shape == (3, 4)
    assert grid[1][2, 3] == turning(panels[2:3], dt[2:3] * 0, dt[2:3], rate[3:4])[1][0]
