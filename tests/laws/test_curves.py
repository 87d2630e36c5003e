"""Curves: derivatives are derivatives, placing moves and turns, time follows the chain rule."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar.curves import Astroid, Circle, Ellipse, FreeCurve, Lemniscate, Line, Polyline, Reference, Spline

SHAPES = [(), (1,), (3, 1, 2)]
size = st.floats(0.1, 3.0)
angle = st.floats(-3.0, 3.0)
point = st.tuples(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0))
fraction = st.floats(0.02, 0.98)


def smooth_curves(a, b, center, tilt):
    placed = {"center": center, "tilt": tilt}
    return [
        Line(center, (center[0] + a, center[1] - b)),
        Circle(a, **placed),
        Ellipse(a, b, **placed),
        Lemniscate(a, b, **placed),
        Astroid(a, **placed),
        Spline([center, (3.0, a), (4.0, b), (5.0, 0.0)]),
        Spline([(0.0, 0.0), (1.0, a), (-b, 2.0)], closed=True),
        FreeCurve(lambda u: (np.cos(a * u), np.sin(u) + b * u), (0.0, 2.0)),
    ]


@settings(deadline=None, max_examples=30)
@given(size, size, point, angle, fraction)
def test_derivatives_are_those_of_the_position(a, b, center, tilt, part):
    for curve in smooth_curves(a, b, center, tilt):
        low, high = curve.interval
        phi, h = low + part * (high - low), 1e-4 * (high - low)
        before, at, after = curve.position([phi - h, phi, phi + h])
        extent = 10.0 * (1.0 + np.abs(curve.position(curve.parameters(9))).max()) / (high - low)
        scale = (1.0 + max(a, 1.0 / a, b, 1.0 / b)) ** 3
        assert np.abs((after - before) / (2.0 * h) - curve.derivative(phi)).max() < 1e-5 * scale * extent
        second = (after - 2.0 * at + before) / h**2
        assert np.abs(second - curve.second_derivative(phi)).max() < 2e-2 * scale * extent / (high - low)


@settings(deadline=None, max_examples=20)
@given(size, size, point, angle)
def test_placing_turns_and_moves(a, b, center, tilt):
    own, placed = Lemniscate(a, b), Lemniscate(a, b, center=center, tilt=tilt)
    phi = own.parameters(7)
    R = np.array([[math.cos(tilt), -math.sin(tilt)], [math.sin(tilt), math.cos(tilt)]])
    np.testing.assert_allclose(placed.position(phi), own.position(phi) @ R.T + center, atol=1e-12)
    np.testing.assert_allclose(placed.derivative(phi), own.derivative(phi) @ R.T, atol=1e-12)
    np.testing.assert_allclose(placed.second_derivative(phi), own.second_derivative(phi) @ R.T, atol=1e-12)


@pytest.mark.parametrize("shape", SHAPES)
def test_parameters_of_any_shape(shape):
    for curve in [*smooth_curves(1.0, 0.5, (0.1, 0.2), 0.3), Polyline([(0, 0), (1, 0), (1, 2)])]:
        phi = np.full(shape, 0.3)
        for verb in (curve.position, curve.derivative, curve.second_derivative):
            assert verb(phi).shape == (*shape, 2)
            np.testing.assert_allclose(verb(phi), np.broadcast_to(verb(0.3), (*shape, 2)), rtol=0, atol=1e-12)
        for verb in (curve.over(2.0).position, curve.over(2.0).velocity, curve.over(2.0).acceleration):
            assert verb(phi).shape == (*shape, 2)


@settings(deadline=None, max_examples=30)
@given(size, st.floats(0.5, 20.0), st.floats(-5.0, 5.0), fraction, st.sampled_from(["uniform", "minimum_jerk"]))
def test_time_follows_the_chain_rule(a, duration, start, part, profile):
    for curve in (Astroid(a), Lemniscate(a), Spline([(0, 0), (a, 1.0), (3.0, 0.0)])):
        reference = Reference(curve, duration, start_time=start, profile=profile)
        t, h = start + part * duration, 1e-4 * duration
        before, at, after = reference.position([t - h, t, t + h])
        assert np.abs((after - before) / (2 * h) - reference.velocity(t)).max() < 2e-5 * (a + 4.0) / duration
        assert np.abs((after - 2 * at + before) / h**2 - reference.acceleration(t)).max() < 2e-2 * (a + 4) / duration**2


@settings(deadline=None, max_examples=20)
@given(size, st.floats(-4.0, 8.0))
def test_closed_curves_repeat(a, s):
    square = Polyline([(0, 0), (a, 0), (a, a), (0, a)], closed=True)
    round_spline = Spline([(0, 0), (a, 0), (a, 1.0)], closed=True)
    wavy = FreeCurve(lambda u: (np.cos(u), a * np.sin(u)), (0.0, math.tau), closed=True)
    for curve in (square, round_spline, wavy, Circle(a)):
        low, high = curve.interval
        np.testing.assert_allclose(curve.position(s + high - low), curve.position(s), atol=1e-9)
        np.testing.assert_allclose(curve.position(low), curve.position(high), atol=1e-12)


@settings(deadline=None, max_examples=20)
@given(size, fraction)
def test_differences_are_as_good_as_they_say(a, part):
    given_one = FreeCurve(
        lambda u: (np.exp(a * u), np.sin(u)),
        (0.0, 2.0),
        first=lambda u: (a * np.exp(a * u), np.cos(u)),
        second=lambda u: (a * a * np.exp(a * u), -np.sin(u)),
    )
    u = 2.0 * part
    for phi in (0.0, u, 2.0):
        for differences in ("central", "complex"):
            curve = FreeCurve(given_one.function, (0.0, 2.0), scale=0.25, differences=differences)
            off = np.abs(curve.derivative(phi) - given_one.derivative(phi)).max()
            largest = math.exp(2.0 * a)
            assert off <= (1e-11 if differences == "central" else 1e-14) * largest / curve.scale
            assert off <= 4.0 * curve.derivative_error(phi) + 1e-14 * largest
            second = np.abs(curve.second_derivative(phi) - given_one.second_derivative(phi)).max()
            assert second <= 1e-6 * largest / curve.scale**2
    assert given_one.derivative_error(u) == 0.0


def test_astroid_stops_and_reverses_at_its_cusps():
    reference = Astroid(1.0).over(10.0)
    cusps = np.array([0.0, 2.5, 5.0, 7.5, 10.0])
    assert np.abs(reference.velocity(cusps)).max() < 1e-12
    before, after = reference.velocity(cusps[1:-1] - 1e-4), reference.velocity(cusps[1:-1] + 1e-4)
    cosines = (before * after).sum(-1) / np.linalg.norm(before, axis=-1) / np.linalg.norm(after, axis=-1)
    np.testing.assert_allclose(cosines, -1.0, atol=1e-6)
    assert (np.hypot(*reference.acceleration(cusps).T) > 1.0).all()
