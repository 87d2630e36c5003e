"""Curves at their edges: intervals, closing, bad input."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from coplanar.arms import Arm
from coplanar.curves import Astroid, Circle, Curve, Ellipse, FreeCurve, HeldPoint, Lemniscate, Line, Polyline, Spline
from coplanar.errors import InvalidShape, InvalidValue, UnknownName
from coplanar.tracing import trace

NAN = math.nan


def test_open_and_closed():
    assert Circle(1.0).closed
    assert not Circle(1.0, interval=(0.0, 1.0)).closed
    assert Circle(1.0, interval=(0.0, 4.0 * math.pi)).closed
    assert not Line((0, 0), (1, 1)).closed
    assert Polyline([(0, 0), (1, 0), (0, 1)], closed=True).closed
    assert not Polyline([(0, 0), (1, 0)]).closed


@pytest.mark.parametrize(
    "curve",
    [Line((0, 0), (1, 1)), Circle(1.0, interval=(0, 1)), Polyline([(0, 0), (1, 0)]), Spline([(0, 0), (1, 0)])],
)
def test_outside_an_open_interval(curve):
    with pytest.raises(InvalidValue, match="the curve is open"):
        curve.position(1.1)
    with pytest.raises(InvalidValue, match="the curve is open"):
        curve.derivative(-0.1)
    np.testing.assert_array_equal(curve.position(1.0 + 1e-15), curve.position(1.0))


def test_polyline_runs_at_unit_speed_and_takes_the_piece_that_begins_at_a_corner():
    corner = Polyline([(0, 0), (2, 0), (2, 3)])
    assert corner.interval == (0.0, 5.0)
    assert corner.derivative([0.0, 1.9, 2.0, 5.0]).tolist() == [[1, 0], [1, 0], [0, 1], [0, 1]]
    assert corner.second_derivative(1.0).tolist() == [0.0, 0.0]
    assert corner.position(3.0).tolist() == [2.0, 1.0]


def test_closing_a_path_that_already_closes():
    again = Polyline([(0, 0), (1, 0), (0, 1), (0, 0)], closed=True)
    assert again.interval == Polyline([(0, 0), (1, 0), (0, 1)], closed=True).interval


def test_spline_goes_through_its_points():
    points = np.array([(0, 0), (1, 2), (3, 1), (4, 4)], float)
    for curve in (Spline(points), Spline(points, knots=[0, 1, 2, 5], ends="clamped")):
        np.testing.assert_allclose(curve.position(curve.knots), points, atol=1e-14)
    assert np.abs(Spline(points, ends="clamped").derivative(0.0)).max() < 1e-14
    assert np.abs(Spline(points).second_derivative(0.0)).max() < 1e-14
    ring = Spline(points, closed=True)
    np.testing.assert_allclose(ring.derivative(ring.interval[0]), ring.derivative(ring.interval[1]), atol=1e-12)


def test_lemniscate_height_is_its_length_unless_given():
    assert Lemniscate(2.0).b == 2.0
    assert Lemniscate(2.0, 0.5).b == 0.5


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Circle(0.0), "radius = 0.0: needed greater than 0"),
        (lambda: Circle(-1.0), "greater than 0"),
        (lambda: Ellipse(1.0, NAN), "b = nan: needed finite"),
        (lambda: Ellipse([1.0, 2.0], [1.0, 2.0, 3.0]), "shapes that broadcast"),
        (lambda: Astroid(1.0, center=(0.0, NAN)), "center"),
        (lambda: Astroid(1.0, interval=(1.0, 1.0)), "first < last"),
        (lambda: Line((1, 1), (1, 1)), "HeldPoint"),
        (lambda: Line((1, 1, 1), (1, 1)), "shape"),
        (lambda: Polyline([(0, 0)]), "n of at least 2"),
        (lambda: Polyline([(0, 0), (0, 0), (1, 1)]), "remove point 1"),
        (lambda: Spline([(0, 0), (1, 1)], knots=[1.0, 0.0]), "2 increasing numbers"),
        (lambda: Spline([(0, 0), (1, 1)], knots=[0.0, 1.0, 2.0]), "2 increasing numbers"),
        (lambda: Circle(1.0).over(0.0), "duration"),
        (lambda: Circle(1.0).over(NAN), "duration"),
        (lambda: Line((0, 0), (1, 1)).over(1.0, laps=2.0), "laps = 2.0: needed 1"),
        (lambda: Circle(1.0).position(NAN), "parameter"),
        (lambda: Circle(1.0).parameters(1), "2 or more"),
        (lambda: HeldPoint((1.0, NAN)), "point"),
        (lambda: FreeCurve(3.0, (0.0, 1.0)), "a function phi"),
        (lambda: FreeCurve(lambda u: (u, u, u), (0.0, 1.0)), "shape"),
        (lambda: FreeCurve(lambda u: (u, math.inf + 0.0 * u), (0.0, 1.0)), "finite points"),
    ],
)
def test_bad_input(make, words):
    with pytest.raises((InvalidValue, InvalidShape), match=words):
        make()


def test_unknown_names():
    with pytest.raises(UnknownName, match="did you mean 'uniform'"):
        Circle(1.0).over(1.0, profile="uniformly")
    with pytest.raises(UnknownName, match="natural"):
        Spline([(0, 0), (1, 1)], ends="naturel")
    with pytest.raises(UnknownName):
        FreeCurve(lambda u: (u, u), (0, 1), differences="forward")


def test_nothing_can_be_changed():
    points = np.array([(0.0, 0.0), (1.0, 0.0)])
    path = Polyline(points)
    points[0] = 9.0
    assert path.position(0.0).tolist() == [0.0, 0.0]
    with pytest.raises(ValueError, match="read-only"):
        path.points[0] = 1.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        Circle(1.0).radius = 2.0


def test_reference_rests_before_and_after():
    reference = Line((0, 0), (2, 0)).over(2.0, start_time=1.0)
    assert reference.position([0.0, 1.0, 2.0, 3.0, 9.0])[:, 0].tolist() == [0.0, 0.0, 1.0, 2.0, 2.0]
    assert reference.velocity([0.0, 2.0, 9.0])[:, 0].tolist() == [0.0, 1.0, 0.0]
    smooth = Line((0, 0), (2, 0)).over(2.0, profile="minimum_jerk")
    np.testing.assert_allclose(smooth.velocity([0.0, 2.0]), 0.0, atol=1e-15)
    np.testing.assert_allclose(smooth.acceleration([0.0, 2.0]), 0.0, atol=1e-14)
    assert smooth.velocity(1.0)[0] == pytest.approx(1.875)


def test_laps():
    twice = Circle(1.0).over(2.0, laps=2.0)
    np.testing.assert_allclose(twice.position(1.0), [1.0, 0.0], atol=1e-14)
    np.testing.assert_allclose(twice.velocity(0.0), [0.0, 2.0 * math.pi], atol=1e-14)


def test_held_point_of_many_robots():
    points = HeldPoint([(0, 0), (1, 1)])
    assert points.position(np.zeros((5, 1))).shape == (5, 2, 2)
    assert not points.velocity(0.0).any()
    assert not points.acceleration(0.0).any()


def test_a_curve_of_ones_own_needs_two_methods():
    with pytest.raises(TypeError):
        Curve()


def test_many_circles_at_once_are_each_of_them():
    radii, centres, tilts = np.array([1.0, 2.0, 0.5]), np.array([(0.0, 0.0), (1.0, -1.0), (3.0, 2.0)]), 0.3
    many = Ellipse(radii, 2.0 * radii, center=centres, tilt=tilts).over(4.0)
    t = np.linspace(0.0, 4.0, 5)[:, None]
    assert many.curve.shape == (3,)
    for i, (radius, centre) in enumerate(zip(radii, centres, strict=True)):
        one = Ellipse(radius, 2.0 * radius, center=centre, tilt=tilts).over(4.0)
        assert one.curve.shape == ()
        for name in ("position", "velocity", "acceleration"):
            assert np.allclose(getattr(many, name)(t)[:, i], getattr(one, name)(t[:, 0]), rtol=1e-14, atol=1e-14)


def test_an_arm_follows_one_curve_at_a_time():
    with pytest.raises(InvalidShape, match="one by one"):
        trace(Arm((1.0, 1.0)), Circle([0.1, 0.2], center=(1.0, 0.5)), 11)
