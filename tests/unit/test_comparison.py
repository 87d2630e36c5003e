"""Integrators side by side."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar.errors import InvalidInput, InvalidShape
from coplanar.integrators import METHODS
from coplanar.motion import Comparison, Program, Segment
from coplanar.se2 import Pose

CURVE = Program([Segment(1.0, -0.5, 0.2, 0.4, duration=2.0), Segment(0.8, 1.0, duration=1.05)])
COMPARED = Comparison(CURVE, Pose(1.0, 2.0, 0.3), steps=(0.1, 0.05, 0.025))


def test_orders_are_those_of_the_tables():
    errors = COMPARED.errors()
    assert errors.shape == (len(METHODS), 3)
    assert np.allclose(COMPARED.orders(errors), [METHODS[m].order for m in COMPARED.methods], atol=0.25)


def test_steps_keep_to_the_knots_and_are_no_longer_than_asked():
    t, poses = COMPARED.path("rk4", 0.1)
    assert np.diff(t).max() <= 0.1 + 1e-12
    assert set(CURVE.knots.tolist()) <= set(t.tolist())
    exact = CURVE.pose(COMPARED.start, t)
    assert np.hypot(poses.x - exact.x, poses.y - exact.y).max() == pytest.approx(COMPARED.error("rk4", 0.1), rel=1e-12)
    assert np.allclose(poses.theta, exact.theta, rtol=0, atol=1e-12)


@pytest.mark.parametrize("method", ["midpoint", "rk4"])
def test_the_largest_step_is_within_the_tolerance_and_a_larger_one_is_not(method):
    step = COMPARED.largest_step(method, 1e-3)
    assert COMPARED.error(method, step) <= 1e-3 < COMPARED.error(method, 1.15 * step)


def test_what_would_take_too_many_steps_says_so():
    assert COMPARED.largest_step("euler", 1e-9) == 0.0


def test_a_line_has_no_order():
    line = Comparison(Program([Segment(1.0, 0.0, duration=1.0)]), Pose(), ("euler",))
    assert np.isnan(line.orders()).all()
    assert line.largest_step("euler") == 1.0


def test_misuse_is_refused():
    with pytest.raises(InvalidInput, match="rk5"):
        Comparison(CURVE, Pose(), ("rk5",))
    with pytest.raises(InvalidShape, match="a batch"):
        Comparison(Program([Segment([1.0, 2.0], 0.0, duration=1.0)]), Pose())
    with pytest.raises(InvalidInput, match="steps"):
        Comparison(CURVE, Pose(), steps=[1e-9])
