"""Errors of the notes that belong to motion: the printed form is wrong, ours is right."""

from __future__ import annotations

import numpy as np

from coplanar import Pose
from coplanar.motion import DrivingHistory, Program, Segment

V, OMEGA, T = 1.5, 0.8, 1.7
RADIUS = V / OMEGA
END = Segment(V, OMEGA, duration=T).end(Pose())


def test_circle_through_the_start():
    """Printed: x^2 + (y - R)^2 = v^2/omega^2 (omega^2 t + sin^2 omega t). It is cos^2 + sin^2, which is 1."""
    left = END.x**2 + (END.y - RADIUS) ** 2
    printed = RADIUS**2 * (OMEGA**2 * T + np.sin(OMEGA * T) ** 2)
    right = RADIUS**2 * (np.cos(OMEGA * T) ** 2 + np.sin(OMEGA * T) ** 2)
    np.testing.assert_allclose(left, right, rtol=1e-14)
    assert abs(left - printed) > 0.1


def test_sign_of_the_lateral_part():
    """Printed in (12): y' = -(v'/omega')(1 - cos omega' t'). A turn to the left goes to the left: plus."""
    np.testing.assert_allclose(END.y, RADIUS * (1.0 - np.cos(OMEGA * T)), rtol=1e-14)
    assert END.y > 0.0 > -RADIUS * (1.0 - np.cos(OMEGA * T))


def test_joining_by_the_printed_sign_misses():
    """Two halves joined by (13) are the whole arc with the plus, and are not with the minus."""
    half = 0.5 * T
    x, y = RADIUS * np.sin(OMEGA * half), RADIUS * (1.0 - np.cos(OMEGA * half))
    joint = Pose(x, y, OMEGA * half)
    np.testing.assert_allclose(joint @ np.array([x, y]), END.position, rtol=1e-13)
    assert np.linalg.norm(joint @ np.array([x, -y]) - END.position) > 0.1
    halves = Program([Segment(V, OMEGA, duration=half)] * 2)
    np.testing.assert_allclose(halves.end(Pose()).as_array(), END.as_array(), rtol=1e-14)


def test_not_every_constant_acceleration_is_a_clothoid():
    """Printed: "the resulting curve is a clothoid". Its curvature is linear in arc length only when a = 0."""
    t = np.linspace(0.0, 1.0, 5)

    def rate_of_curvature(segment):
        arc_length = (segment.v + 0.5 * segment.a * t) * t
        return np.diff(segment.curvature(t)) / np.diff(arc_length)

    without, with_acceleration = (Segment(1.0, 0.5, a, 2.0, duration=1.0) for a in (0.0, 1.0))
    assert np.ptp(rate_of_curvature(without)) < 1e-12
    assert np.ptp(rate_of_curvature(with_acceleration)) > 0.5
    assert (without.kind, with_acceleration.kind) == ("clothoid", "general")


def test_the_square_does_not_close():
    """Listing 5: 71 times, the first side has 11 samples, the last sample is not driven: 1.1, 1, 1 and 0.9 m."""
    square, start = DrivingHistory.square(0.1), Pose(0.0, 0.0, -np.pi / 2)
    assert square.t.size == 71
    assert (square.t[0], square.t[-1]) == (0.0, 7.0)
    sides = np.flatnonzero(np.diff(square.v))
    assert (sides[0] + 1, np.count_nonzero(square.v)) == (11, 40)
    for method in ("euler", "exact", "rk4"):
        path = square.path(start, method)
        np.testing.assert_allclose(path.as_array()[-1], (0.1, -0.1, np.pi), atol=1e-12)
        assert np.linalg.norm(path.position[-1] - path.position[0]) > 0.14


def test_a_square_that_closes():
    side, corner = Segment(1.0, 0.0, duration=1.0), Segment(0.0, np.pi / 2, duration=1.0)
    end = Program([side, corner] * 4).end(Pose(0.0, 0.0, -np.pi / 2))
    np.testing.assert_allclose(end.position, 0.0, atol=1e-15)
