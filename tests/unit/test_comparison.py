"""Integrators side by side: errors against closed forms, orders, largest steps, what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest

from coplanar.comparison import compare_integrators
from coplanar.errors import InvalidShape, InvalidValue, UnknownName
from coplanar.integrators import METHODS
from coplanar.motion import Segment
from coplanar.se2 import Pose

SEGMENT = Segment(1.0, -0.5, a=0.2, alpha=0.4, duration=4.0)


def driven(t, pose):
    v, omega = 1.0 + 0.2 * t, -0.5 + 0.4 * t
    return np.array([v * math.cos(pose[2]), v * math.sin(pose[2]), omega])


def exact(t):
    return SEGMENT.pose(Pose(), t).as_array()


def decay(_t, y):
    return -y


def fallen(t):
    return np.exp(-t)[:, None]


def test_errors_are_those_of_the_recurrence():
    """Euler on y' = -y is (1 - h)^k; its distance from exp(-k h) is largest somewhere on the way."""
    answer = compare_integrators(decay, 2.0, [1.0], exact=fallen, methods=("euler",), counts=(4, 40))
    for n, error in zip(answer.counts, answer.errors[0], strict=True):
        h, k = 2.0 / n, np.arange(n + 1)
        assert error == pytest.approx(np.abs((1.0 - h) ** k - np.exp(-h * k)).max(), rel=1e-12)


@pytest.mark.parametrize("measured", [None, (0, 1)])
def test_orders_are_those_of_the_tables(measured):
    answer = compare_integrators(driven, 4.0, [0, 0, 0], exact=exact, measured=measured)
    for name in answer.methods:
        assert answer.order(name) == pytest.approx(METHODS[name].order, abs=0.15)


def test_the_truth_by_dop853_is_the_exact_one():
    mine = compare_integrators(driven, 4.0, [0, 0, 0], methods=("rk4",), counts=(8, 16))
    theirs = compare_integrators(driven, 4.0, [0, 0, 0], exact=exact, methods=("rk4",), counts=(8, 16))
    np.testing.assert_allclose(mine.errors, theirs.errors, rtol=1e-6)


@pytest.mark.parametrize("name", METHODS)
def test_the_largest_step_is_within_the_tolerance_and_nearly_the_longest(name):
    answer = compare_integrators(driven, 4.0, [0, 0, 0], exact=exact, measured=(0, 1), counts=(8,))
    step = answer.largest_step(name, 1e-2)
    count = round(4.0 / step)
    assert answer.error(name, count) <= 1e-2
    shorter = count - max(1, math.ceil(1e-3 * count))
    assert answer.error(name, shorter) > 1e-2


def test_no_step_will_do():
    answer = compare_integrators(decay, 1.0, [1.0], exact=fallen, methods=("euler",), counts=(2,))
    assert answer.largest_step("euler", 1e-9, most=50) == 0.0


def test_a_method_that_diverges_is_infinitely_far_off():
    grows = lambda _t, y: 1e200 * y * y  # noqa: E731 - a rate
    answer = compare_integrators(
        grows, 1.0, [1.0], exact=lambda t: np.ones((len(t), 1)), methods=("euler",), counts=(2, 3)
    )
    assert np.isinf(answer.errors).all()
    assert answer.order("euler") is None


def test_an_exact_method_has_no_order():
    still = compare_integrators(lambda _t, y: 0.0 * y, 1.0, [1.0], methods=("euler",))
    assert still.errors.max() == 0.0
    assert still.order("euler") is None
    assert still.largest_step("euler") == 1.0


def test_what_is_refused():
    with pytest.raises(InvalidShape, match="y0"):
        compare_integrators(decay, 1.0, [[1.0]])
    with pytest.raises(InvalidShape, match="exact"):
        compare_integrators(decay, 1.0, [1.0], exact=np.exp)
    with pytest.raises(InvalidValue, match="counts"):
        compare_integrators(decay, 1.0, [1.0], counts=(4, 4))
    with pytest.raises(InvalidValue, match="duration"):
        compare_integrators(decay, 0.0, [1.0])
    with pytest.raises(UnknownName, match="rk4"):
        compare_integrators(decay, 1.0, [1.0], methods=("rk5",))
    with pytest.raises(UnknownName, match="method"):
        compare_integrators(decay, 1.0, [1.0], methods=("rk4",)).order("euler")
    with pytest.raises(ValueError, match="read-only"):
        compare_integrators(decay, 1.0, [1.0]).errors[0] = 1.0
