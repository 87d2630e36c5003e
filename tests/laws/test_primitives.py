"""The primitives of the laws: right to the last digits, alike by every evaluator, smooth where they promise to be."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from coplanar.engine import (
    absolute,
    asinh,
    atan,
    atan2,
    atanh,
    copysign,
    cos,
    cosh,
    dsinc,
    evaluator,
    exp,
    expm1,
    floor,
    hypot,
    log,
    log1p,
    maximum,
    minimum,
    nearest,
    sin,
    sinc,
    sincos,
    sinh,
    sqrt,
    tan,
    tanh,
    turn_remainder,
    where,
)  # fmt: skip
from tests.engines import ENGINES, NEEDS_JAX, NEEDS_NUMBA, on_engine, on_floats

mp = mpmath.mp.clone()
mp.prec = 1200  # an angle of 1e300 has a thousand bits before its point


def law_of_sin(x):
    return sin(x)


def law_of_cos(x):
    return cos(x)


def law_of_sincos(x):
    s, c = sincos(x)
    return s, c


def law_of_tan(x):
    return tan(x)


def law_of_atan(x):
    return atan(x)


def law_of_atan2(y, x):
    return atan2(y, x)


def law_of_sinc(x):
    return sinc(x)


def law_of_dsinc(x):
    return dsinc(x)


def law_of_exp(x):
    return exp(x)


def law_of_expm1(x):
    return expm1(x)


def law_of_log(x):
    return log(x)


def law_of_log1p(x):
    return log1p(x)


def law_of_sinh(x):
    return sinh(x)


def law_of_cosh(x):
    return cosh(x)


def law_of_tanh(x):
    return tanh(x)


def law_of_asinh(x):
    return asinh(x)


def law_of_atanh(x):
    return atanh(x)


def law_of_sqrt(x):
    return sqrt(x)


def law_of_hypot(x, y):
    return hypot(x, y)


def law_of_rounding(x):
    return nearest(x), floor(x), absolute(x), turn_remainder(x)


def law_of_pairs(x, y):
    return minimum(x, y), maximum(x, y), copysign(x, y)


def spread(low, high, count=400, seed=0):
    """Numbers of either sign whose sizes are spread evenly over powers of ten."""
    rng = np.random.default_rng(seed)
    return rng.choice([-1.0, 1.0], count) * 10.0 ** rng.uniform(low, high, count)


QUARTERS = np.arange(-64, 65) * (math.pi / 4)
TURNING = np.concatenate(
    [spread(-18, 3), QUARTERS, np.nextafter(QUARTERS, np.inf), np.nextafter(QUARTERS, -np.inf), [0.0]]
)
FAR = np.concatenate([spread(3, 5, 200), np.round(spread(3, 4.6, 100)) * (math.pi / 2)])
FURTHER = np.concatenate([spread(5, 12, 60), spread(12, 300, 40), [1e5, np.nextafter(1e5, np.inf)]])
NEAR_ONE = 1.0 + spread(-16, -0.5, 200)


def slope_of_sinc(x):
    return (mp.cos(x) - mp.sin(x) / x) / x if x else mp.zero


# law, 50-digit truth, arguments, [ulp] of the compiled loop
EXACT = [
    (law_of_sin, mp.sin, TURNING, 2.0),
    (law_of_cos, mp.cos, TURNING, 2.0),
    (law_of_sin, mp.sin, FAR, 2.1),
    (law_of_cos, mp.cos, FAR, 2.1),
    (law_of_sin, mp.sin, FURTHER, 1.0),
    (law_of_cos, mp.cos, FURTHER, 1.0),
    (law_of_tan, mp.tan, TURNING, 4.0),
    (law_of_atan, mp.atan, spread(-18, 18), 2.0),
    (law_of_sinc, lambda x: mp.sinc(x), TURNING, 3.0),
    (law_of_dsinc, slope_of_sinc, np.concatenate([spread(-18, 0), np.linspace(0.8, 4.0, 100)]), 6.0),
    (law_of_exp, mp.exp, np.concatenate([spread(-18, 2.8), [0.0, 709.0, -745.0]]), 2.5),
    (law_of_expm1, mp.expm1, np.concatenate([spread(-18, 2.8), [709.0, -745.0]]), 2.5),
    (law_of_log, mp.log, np.concatenate([np.abs(spread(-300, 300)), NEAR_ONE, [5e-324, 1.7e308]]), 2.5),
    (law_of_log1p, mp.log1p, np.concatenate([np.abs(spread(-18, 300)), -np.abs(spread(-18, -1e-9))]), 2.5),
    (law_of_sinh, mp.sinh, spread(-18, 2.8), 3.0),
    (law_of_cosh, mp.cosh, spread(-18, 2.8), 2.5),
    (law_of_tanh, mp.tanh, spread(-18, 2.8), 3.5),
    (law_of_asinh, mp.asinh, spread(-18, 150), 3.0),
    (law_of_atanh, mp.atanh, np.concatenate([spread(-18, -1e-9), np.clip(NEAR_ONE, None, 1.0 - 1e-16)]), 3.0),
    (law_of_sqrt, mp.sqrt, np.abs(spread(-300, 300)), 0.51),
]


def worst_ulps(values, truths):
    gaps = [abs(mp.mpf(float(v)) - t) / math.ulp(float(t)) for v, t in zip(values, truths, strict=True)]
    return float(max(gaps))


@pytest.mark.parametrize("engine", ["floats", "text", pytest.param("compiled", marks=NEEDS_NUMBA)])
@pytest.mark.parametrize("case", EXACT, ids=lambda case: f"{case[0].__name__[7:]}-{case[3]}")
def test_one_argument(case, engine):
    law, truth, arguments, ulps = case
    (values,) = on_engine(engine, law, arguments)
    assert worst_ulps(values, [truth(mp.mpf(float(x))) for x in arguments]) <= max(ulps, 2.0)


OCTANTS = [(s * a, t * b) for s in (1, -1) for t in (1, -1) for a, b in ((1.0, 0.3), (0.3, 1.0), (1.0, 1.0))]
AXES = [(0.0, 1.0), (0.0, -1.0), (1.0, 0.0), (-1.0, 0.0), (2.0, 0.0), (0.0, 0.0), (0.0, -0.0)]
EDGES = [(1e308, 1e308), (1.7e308, 1e308), (-1e308, 1.7e308), (5e-324, 5e-324), (5e-324, 1e300), (1e300, -5e-324)]


@pytest.mark.parametrize("engine", ENGINES)
def test_atan2_in_all_octants_and_on_the_axes(engine):
    y, x = spread(-12, 12, 600, seed=1), spread(-3, 3, 600, seed=2)
    corners = np.array([*OCTANTS, *EDGES])
    y, x = np.concatenate([y, corners[:, 0]]), np.concatenate([x, corners[:, 1]])
    if engine == "jax":  # takes subnormal numbers for 0
        y, x = (np.where(np.abs(v) < 1e-300, 1.0, v) for v in (y, x))
    normal = np.abs(y) > 1e-300 * np.maximum(1.0, np.abs(x))
    (angle,) = on_engine(engine, law_of_atan2, y, x)
    truths = [mp.atan2(mp.mpf(float(a)), mp.mpf(float(b))) for a, b in zip(y, x, strict=True)]
    assert worst_ulps(angle[normal], np.array(truths)[normal]) <= 2.0
    axes = np.array(AXES)
    (angle,) = on_engine(engine, law_of_atan2, *axes.T)
    assert np.array_equal(angle, [math.atan2(*axis) for axis in AXES])


@pytest.mark.parametrize("engine", ENGINES)
def test_the_negative_x_axis_has_both_signs_of_pi(engine):
    """A zero y keeps its sign, as in C: the range is [-pi, pi]; ``heading`` is the law that stays in (-pi, pi]."""
    (angle,) = on_engine(engine, law_of_atan2, np.array([0.0, -0.0]), np.array([-1.0, -1.0]))
    assert angle.tolist() == [math.pi, -math.pi]


@pytest.mark.parametrize("engine", ENGINES)
def test_hypot_neither_overflows_nor_underflows(engine):
    x = np.array([3e200, 3e-200, 3.0, 0.0, 0.0, -5.0, 1e308, 3e-160, np.inf, np.nan])
    y = np.array([4e200, 4e-200, 4.0, 0.0, -2.0, 0.0, 1.0, 4e-160, 1.0, 1.0])
    (length,) = on_engine(engine, law_of_hypot, x, y)
    right = np.array([5e200, 5e-200, 5.0, 0.0, 2.0, 5.0, 1e308, 5e-160, np.inf, np.nan])
    assert np.allclose(length, right, rtol=4 * np.finfo(float).eps, atol=0.0, equal_nan=True)


@pytest.mark.parametrize("engine", ENGINES)
def test_rounding_is_the_same_everywhere(engine):
    halves = [0.5, 1.5, 2.5, -0.5, -1.5, -2.5, math.nextafter(0.5, 0.0), math.nextafter(-0.5, 0.0)]
    large = [2.0**52 + 1.0, 2.0**52 - 0.5, 2.0**53, -(2.0**52) - 1.0, 1e18, 1e19, -1e300]
    x = np.array([*halves, *large, 0.0, 7.3, -7.3, np.inf, -np.inf, np.nan])
    whole, below, size, rest = on_engine(engine, law_of_rounding, x)
    assert np.array_equal(whole, np.rint(x), equal_nan=True)
    assert np.array_equal(below, np.floor(x), equal_nan=True)
    assert np.array_equal(size, np.abs(x), equal_nan=True)
    expected = [math.remainder(v, math.tau) if math.isfinite(v) else math.nan for v in x]
    assert np.array_equal(rest, expected, equal_nan=True)


@pytest.mark.parametrize("engine", ENGINES)
def test_smaller_larger_and_sign_are_the_same_everywhere(engine):
    values = np.array([0.0, 1.0, -1.0, 3.5, np.inf, -np.inf, np.nan])
    x, y = (column.ravel() for column in np.meshgrid(values, values))
    small, large, signed = on_engine(engine, law_of_pairs, x, y)
    assert np.array_equal(small, np.minimum(x, y), equal_nan=True)
    assert np.array_equal(large, np.maximum(x, y), equal_nan=True)
    sure = ~np.isnan(y)
    assert np.array_equal(signed[sure], np.copysign(x, y)[sure], equal_nan=True)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_root_of_less_than_nothing_is_nothing(engine):
    (root,) = on_engine(engine, law_of_sqrt, np.array([-1e-300, -4.0, 0.0, 4.0, np.inf, np.nan]))
    assert np.array_equal(root, [0.0, 0.0, 0.0, 2.0, np.inf, np.nan], equal_nan=True)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    "law",
    [law_of_sincos, law_of_tan, law_of_sinc, law_of_dsinc, law_of_exp, law_of_log, law_of_log1p, law_of_atanh,
     law_of_asinh, law_of_tanh, law_of_sinh, law_of_cosh, law_of_expm1, law_of_atan],
    ids=lambda law: law.__name__[7:],
)  # fmt: skip
def test_outside_of_the_domain_it_is_as_numpy_says(law, engine):
    x = np.array([np.nan, np.inf, -np.inf, -1.0, 1.0, -2.0, 2.0, 0.0, -0.0, 1e4, -1e4, 1e22])
    with np.errstate(all="ignore"):
        expected = law(x)
    for one, other in zip(
        on_engine(engine, law, x), expected if isinstance(expected, tuple) else (expected,), strict=True
    ):
        assert np.allclose(one, other, rtol=1e-14, atol=1e-15, equal_nan=True)


def test_slope_of_sinc_over_many_turns():
    x = np.linspace(-10.0, 10.0, 2001)
    truth = np.array([float(slope_of_sinc(mp.mpf(float(v)))) for v in x])
    for engine in ("floats", "text"):
        assert np.max(np.abs(on_engine(engine, law_of_dsinc, x)[0] - truth)) <= 2 * np.finfo(float).eps


def law_of_the_sine_s_sign(x):
    return where(sin(x) > 0.0, 1.0, -1.0)


def law_of_the_cosine_s_sign(x):
    return copysign(1.0, cos(x))


def law_of_a_larger_exponential(x):
    return where(exp(x) < 1e308, x, -1.0)


def law_of_the_nearest_turn(x):
    return nearest(atan2(sin(x), cos(x)) / 3.0), where(tan(x) > x, 1.0, 0.0)


@NEEDS_NUMBA
@pytest.mark.parametrize(
    "law",
    [law_of_the_sine_s_sign, law_of_the_cosine_s_sign, law_of_a_larger_exponential, law_of_the_nearest_turn],
    ids=lambda law: law.__name__[7:],
)
def test_a_comparison_does_not_hide_what_the_fast_primitive_cannot(law):
    x = np.concatenate([spread(0, 3, 50), spread(5, 12, 100), [np.inf, -np.inf, np.nan]])
    for one, other in zip(on_engine("compiled", law, x), on_floats(law, x), strict=True):
        assert np.array_equal(one, other, equal_nan=True)


@NEEDS_JAX
@pytest.mark.parametrize(
    ("law", "points", "slopes"),
    [
        (law_of_sinc, [0.0, 1e-9, -1e-9], [0.0, -1e-9 / 3, 1e-9 / 3]),
        (law_of_dsinc, [0.0, 1e-9, 0.9999999], [-1 / 3, -1 / 3, -0.2391336269]),
        (law_of_sqrt, [0.0, -1.0, 4.0], [0.0, 0.0, 0.25]),
    ],
    ids=["sinc", "dsinc", "sqrt"],
)
def test_gradients_are_finite_at_the_special_points(law, points, slopes):
    import jax

    with jax.enable_x64(True):
        slope = jax.vmap(jax.grad(evaluator(law)))(jax.numpy.asarray(points))
    assert np.allclose(slope, slopes, rtol=1e-6, atol=1e-18)


@NEEDS_JAX
def test_gradients_of_a_length_are_finite_at_the_origin_and_on_the_axes():
    import jax

    with jax.enable_x64(True):
        slope = jax.grad(evaluator(law_of_hypot), argnums=(0, 1))
        assert [float(s) for s in slope(0.0 * jax.numpy.ones(()), jax.numpy.zeros(()))] == [0.0, 0.0]
        assert [float(s) for s in slope(jax.numpy.asarray(3.0), jax.numpy.asarray(0.0))] == [1.0, 0.0]
        assert [float(s) for s in slope(jax.numpy.asarray(0.0), jax.numpy.asarray(-2.0))] == [0.0, -1.0]
