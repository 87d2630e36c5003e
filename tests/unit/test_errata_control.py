"""What the notes print about the point P, beside what is right."""

from __future__ import annotations

import math

import numpy as np

from coplanar.control import PointTracker, Stability, Unicycle
from coplanar.curves import Astroid
from coplanar.simulation import simulate

THETA, POINT = 0.7, (0.3, 0.2)
C, S = math.cos(THETA), math.sin(THETA)
R = np.array([[C, -S], [S, C]])
P = np.array([1.0, -0.5])


def test_center_is_p_less_r_p():
    """Section 2.6.2 prints C = P + R p."""
    pose = PointTracker(POINT, kp=1.0).pose_for(P, THETA)
    np.testing.assert_allclose(pose.position + R @ POINT, P)
    printed = P + R @ POINT
    assert np.abs(printed + R @ POINT - P).max() > 0.1


def test_derivative_of_the_rotation():
    """Section 2.6.2 prints Rdot = thetadot [[s, -c], [c, -s]]."""
    h, omega = 1e-6, 1.3
    turned = [np.array([[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]]) for a in (THETA - h, THETA + h)]
    slope = omega * (turned[1] - turned[0]) / (2.0 * h)
    np.testing.assert_allclose(omega * np.array([[-S, -C], [C, -S]]), slope, atol=1e-9)
    assert np.abs(omega * np.array([[S, -C], [C, -S]]) - slope).max() > 0.5
    ours = PointTracker(POINT, kp=1.0).velocity(THETA, (0.4, omega))
    np.testing.assert_allclose(ours, 0.4 * R[:, 0] + slope @ POINT, atol=1e-9)


def test_inverse_has_py_over_px_and_a_positive_cosine():
    """Section 2.6.2 prints px/py, and -(1/px) cos in the last entry."""
    px, py = POINT
    A = np.array([[C, -(px * S + py * C)], [S, px * C - py * S]])
    tracker = PointTracker(POINT, kp=1.0)
    ours = np.stack([tracker.command(THETA, w) for w in np.eye(2)], axis=-1)
    np.testing.assert_allclose(ours @ A, np.eye(2), atol=1e-15)
    np.testing.assert_allclose(ours, [[C - py / px * S, S + py / px * C], [-S / px, C / px]])
    printed = np.array([[C - px / py * S, S + px / py * C], [-S / px, -C / px]])
    assert np.abs(printed @ A - np.eye(2)).max() > 0.5


def test_the_gains_of_listing_8_are_on_the_boundary():
    """Printed kp = 100, kd = 0.5, h = 0.01: with Euler it holds, with Runge-Kutta in its place it diverges."""
    tracker = PointTracker((0.05, 0.0), kp=100.0, kd=0.5, error_against="next")
    report = tracker.stability(0.01)
    assert report.status is Stability.BOUNDARY
    assert report.poles.tolist() == [0.5, -1.0]
    astroid = Astroid(1.0).over(10.0)
    start = tracker.pose_for((1.0, 0.0), heading=0.5 * math.pi)
    runs = {
        method: simulate(Unicycle(), tracker, astroid, step=0.01, method=method, start=start)
        for method in ("euler", "rk4")
    }
    assert np.abs(runs["euler"].errors).max() < 0.01
    assert np.abs(runs["rk4"].errors).max() > 1.0
    inside = PointTracker((0.05, 0.0), kp=100.0, kd=0.3, error_against="next")
    assert inside.stability(0.01, method="rk4", speed=1.5 * 0.2 * math.pi).status is Stability.STABLE
    tame = simulate(Unicycle(), inside, astroid, step=0.01, method="rk4", start=start)
    assert np.abs(tame.errors).max() < 0.01
