"""A rolling wheel: the rim's velocity is the derivative of the rim's path, at every slip."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar.wheels import RollingWheel

SHAPES = [(), (1,), (3, 1, 2)]
EPS = np.finfo(float).eps
TINY = np.finfo(float).tiny / EPS  # below this, products lose digits to underflow
numbers = st.floats(-5, 5)
radii = st.floats(0.01, 2.0)


@pytest.mark.parametrize("shape", SHAPES)
@given(radius=radii, rate=numbers, beta=numbers, slip=numbers)
@settings(deadline=None, max_examples=20)
def test_rim_velocity(shape, radius, rate, beta, slip):
    wheel = RollingWheel(radius)
    rates, betas = np.full(shape, rate), np.full(shape, beta)
    v = wheel.rim_velocity(rates, betas, slip=slip)
    assert v.shape == (*shape, 2)
    scale = abs(slip) + radius * abs(rate) + 1.0
    # v_centre + omega x (point - centre), as a cross product of three-dimensional vectors; the wheel turns clockwise.
    arm = wheel.rim_position(betas) - (0.0, radius)
    spin = np.cross((0.0, 0.0, -rate), np.concatenate([arm, np.zeros((*shape, 1))], -1))[..., :2]
    centre = np.array([radius * rate + slip, 0.0])
    np.testing.assert_allclose(v, centre + spin, rtol=0, atol=20 * EPS * scale)
    np.testing.assert_allclose(np.linalg.norm(arm, axis=-1), radius, rtol=10 * EPS)
    # It is the derivative of the position: the centre advances by v_centre, beta by the rate.
    h = 1e-5

    def position(t):
        return wheel.rim_position(betas + rate * t, centre=centre[0] * t)

    np.testing.assert_allclose(v, (position(h) - position(-h)) / (2 * h), rtol=0, atol=1e-8 * scale * (1 + rate * rate))


@given(radius=radii, rate=numbers, slip=numbers)
@settings(deadline=None, max_examples=30)
def test_contact_and_top(radius, rate, slip):
    """0 at the contact and twice the centre on top when it rolls; the slip itself at the contact when it does not."""
    wheel = RollingWheel(radius)
    assert wheel.contact_velocity(rate).tolist() == [0.0, 0.0]
    scale = abs(slip) + radius * abs(rate) + TINY
    np.testing.assert_allclose(
        wheel.top_velocity(rate), [2 * wheel.centre_speed(rate), 0.0], rtol=0, atol=4 * EPS * scale
    )
    np.testing.assert_allclose(wheel.contact_velocity(rate, slip=slip), [slip, 0.0], rtol=0, atol=4 * EPS * scale)
    speed = wheel.centre_speed(rate, slip=slip)
    assert wheel.slip(speed, rate) == pytest.approx(slip, abs=4 * EPS * scale)
    assert wheel.rate(speed, slip=slip) == pytest.approx(rate, abs=8 * EPS * scale / radius)


@given(radius=radii, angle=st.floats(-20, 20))
@settings(deadline=None, max_examples=30)
def test_cycloid(radius, angle):
    """A rim point draws x = r (a - sin a), y = r (1 - cos a), and its speed is 2 r phidot |sin(a/2)|."""
    wheel = RollingWheel(radius)
    expected = [radius * (angle - np.sin(angle)), radius * (1 - np.cos(angle))]
    np.testing.assert_allclose(wheel.rim_path(angle), expected, rtol=0, atol=radius * 100 * EPS)
    speed = np.linalg.norm(wheel.rim_velocity(1.0, angle))
    assert speed == pytest.approx(2 * radius * abs(np.sin(angle / 2)), abs=radius * 20 * EPS)


def test_rear_rises_and_front_sinks():
    """Beta runs with the turning: forward rolling lifts the rear of the rim."""
    wheel = RollingWheel(0.5)
    assert wheel.rim_position(pi / 2)[0] < 0.0 < wheel.rim_velocity(1.0, pi / 2)[1]
    assert wheel.rim_position(3 * pi / 2)[0] > 0.0 > wheel.rim_velocity(1.0, 3 * pi / 2)[1]
