"""Compiled loops in single precision: computed in it, right to its last digits, and safe where the fast ones end."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar.engine import atan2, cos, evaluator, exp, hypot, sin, sinc, sincos, where
from tests.engines import NEEDS_NUMBA

pytestmark = NEEDS_NUMBA
ONE = 1.0


def wave(x, y):
    return sin(x), cos(x), sinc(x) + 0.0 * y


def polar(x, y):
    return atan2(y, x), hypot(x, y)


def sign_of_sine(x, y):
    return where(sin(x) > 0.0, 1.0, -1.0) + 0.0 * y


def thirds(x, y):
    """Sums of one sign, which do not cancel."""
    return x * x * (1.0 / 3.0) + y * y * 0.1


def grown(x, y):
    return exp(x) + 0.0 * y


def both(law, x, y):
    """In single precision, and the same numbers in double."""
    x, y = np.float32(x), np.float32(y)
    answers = evaluator(law).on_compiled(x, y)
    truth = evaluator(law).on_text(x.astype(float), y.astype(float))
    pairs = zip(answers, truth, strict=True) if isinstance(answers, tuple) else [(answers, truth)]
    return [(one, np.asarray(two)) for one, two in pairs]


@pytest.mark.parametrize(("law", "ulps"), [(wave, 2.0), (polar, 3.0), (thirds, 2.0), (grown, 1.0)])
def test_it_is_right_to_the_last_digits(law, ulps):
    rng = np.random.default_rng(0)
    x, y = rng.uniform(-30.0, 30.0, (2, 20_001))
    for single, truth in both(law, x, y):
        assert single.dtype == np.float32
        assert np.max(np.abs(single - truth) / np.maximum(np.spacing(np.abs(np.float32(truth))), 3e-8)) <= ulps


def test_it_is_computed_in_single_precision():
    """A sum that single precision cannot hold: double precision inside, or in a constant, would show."""

    def lost(x, y):
        return (x + y) - x, (x + 1.0) - x, (x + ONE) - x

    for single, _ in both(lost, np.full(100, 1e8), np.ones(100)):
        assert not single.any()


def test_angles_beyond_the_fast_sine():
    x = np.float32([4e3, 4001.0, 1e5, -3e7, 1e30, 0.0, -0.0, 1e-30])
    for single, truth in both(wave, x, np.zeros(8)):
        assert np.max(np.abs(single - truth)) <= 2e-7
    ((single, truth),) = both(sign_of_sine, x, np.zeros(8))
    assert np.array_equal(single, truth)


@pytest.mark.parametrize("law", [wave, polar, grown])
def test_what_is_special_is_as_in_double_precision(law):
    x = np.float32([np.nan, np.inf, -np.inf, 0.0, -0.0, 0.0, 1e-30, 1e25, 3e38, 1e-45])
    y = np.float32([1.0, 1.0, -1.0, 0.0, 0.0, -1.0, 1e-30, -1e25, 3e38, 0.0])
    for single, truth in both(law, x, y):
        with np.errstate(over="ignore"):
            right = truth.astype(np.float32)
        assert np.allclose(single, right, rtol=3e-7, atol=3e-7, equal_nan=True)


def test_a_sine_and_cosine_of_one_angle():
    def square(x, y):
        s, c = sincos(x)
        return s * s + c * c + 0.0 * y

    ((single, _),) = both(square, np.linspace(-3e3, 3e3, 4099), np.zeros(4099))
    assert np.max(np.abs(single - 1.0)) <= 4e-7
