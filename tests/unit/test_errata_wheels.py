"""Equations of the course notes that are printed wrong, beside the right ones."""

from __future__ import annotations

from math import cos, hypot, pi, sin

import numpy as np
import pytest

from coplanar import Pose, Twist
from coplanar.engine import evaluator
from coplanar.frames import coordinates
from coplanar.laws import wheels as laws
from coplanar.wheels import Wheel, WheeledBase, turning_radius, wheel_centre_speeds


def test_rotation_of_coordinates():
    """000/001, rotation: C^1 = R_0^1 C^0, R_0^1 being read off a table of basis vectors scaled by coordinates.

    The table mixes vectors with coordinates: scaled by X_1 and Y_1 its rows are no unit vectors, and the matrix only
    comes out when the scale is dropped. Coordinates change by C_1 = R^T C_0, with R = [[c, -s], [s, c]].
    """
    theta, C_0 = 0.6, np.array([2.0, 3.0])
    R = np.array([[cos(theta), -sin(theta)], [sin(theta), cos(theta)]])
    C_1 = np.array(Pose(0.0, 0.0, theta).act_inverse(*C_0))
    np.testing.assert_allclose(C_1, R.T @ C_0, rtol=0, atol=1e-15)
    np.testing.assert_allclose(C_1, coordinates(C_0, R.T), rtol=0, atol=1e-15)  # the rows of R^T are the basis vectors
    printed = np.diag(C_1) @ R.T  # X_1 (cos, sin) and Y_1 (-sin, cos): what is printed for the two unit vectors
    assert np.abs(np.linalg.norm(printed, axis=1) - 1.0).min() > 0.1
    assert np.abs(printed @ C_0 - C_1).max() > 0.1
    # Read as the matrix that the arm's chapter calls R_1^0 = [[c, -s], [s, c]], it turns the wrong way.
    assert np.abs(R @ C_0 - C_1).max() > 0.1
    np.testing.assert_allclose(R @ C_1, C_0, rtol=0, atol=1e-15)


def test_net_rotation_is_a_difference():
    """002 section 3: Omega = wr + wl. Two equal wheels would turn the base; it is wr - wl."""
    half_track, radius = 0.25, 0.1
    base = WheeledBase.differential(half_track=half_track, radius=radius)
    left = right = 5.0
    printed = 0.5 * radius / half_track * (right + left)
    assert base.forward(base.rates(left=left, right=right)).omega == pytest.approx(0.0, abs=1e-15)
    assert printed > 1.0
    assert base.forward(base.rates(left=1.0, right=5.0)).omega == pytest.approx(0.5 * radius / half_track * (5.0 - 1.0))


def test_turning_about_a_standing_wheel():
    """002 section 3: thetadot = r thetadot/2b. That forces thetadot = 0 (or r = 2b); it is r phidot_r/2b."""
    half_track, radius, right = 0.25, 0.1, 5.0
    omega = WheeledBase.differential(half_track=half_track, radius=radius).forward([0.0, right]).omega
    assert omega == pytest.approx(radius * right / (2 * half_track))
    assert abs(omega - radius * omega / (2 * half_track)) > 0.5


def test_left_wheel_speed():
    """004 (2): U_c = (R - b) omega. The centre moves with R omega; (R - b) omega is the left wheel's speed."""
    R, b, omega = 1.5, 0.25, 2.0
    base = WheeledBase.differential(half_track=b, radius=0.1)
    twist = Twist(R * omega, 0.0, omega)
    left, right = base.wheel_velocities(twist)[:, 0]
    assert left == pytest.approx((R - b) * omega)
    assert abs(twist.vx - (R - b) * omega) > 0.1
    assert wheel_centre_speeds(R, omega, half_track=b) == pytest.approx((left, right))
    assert 0.5 * (left + right) == pytest.approx(twist.vx)  # (4) needs v_l, not U_c, in (2)
    assert turning_radius(left, right, half_track=b) == pytest.approx(R)


# 004 omni, with l = 0.2: the printed rolling rows for the printed angles.
PRINTED = [
    lambda a: (sin(a), -cos(a)),
    lambda a: (sin(a), cos(a)),
    lambda a: (cos(pi / 2 + a), cos(a)),
]
# Where each of them really puts the wheel: the position angle that the one row needs to say the same.
POSITION = [lambda a: a + pi, lambda a: -a, lambda a: a]


def row_of(position, distance=0.2):
    base = WheeledBase([Wheel(distance * cos(position), distance * sin(position), position + pi / 2, 0.05, 0.0)])
    return base.rolling[0]


@pytest.mark.parametrize("wheel", [0, 1, 2])
def test_three_sign_conventions_become_one(wheel):
    """004 omni (1), (3), (5): each row measures its angle otherwise; one row serves all from the position angle."""
    for a in (pi / 6, 0.4, pi / 2):
        np.testing.assert_allclose(row_of(POSITION[wheel](a)), [*PRINTED[wheel](a), 0.2], rtol=0, atol=1e-15)
    # Taken as printed, with one meaning of alpha for all, they are three different wheels.
    others = [PRINTED[k](0.4) for k in range(3) if k != wheel]
    assert min(hypot(x - PRINTED[wheel](0.4)[0], y - PRINTED[wheel](0.4)[1]) for x, y in others) > 0.1


def test_the_notes_three_wheels_are_120_degrees_apart():
    """alpha_1 = alpha_2 = 30 deg, alpha_3 = 90 deg in the printed conventions: one base of three omni wheels."""
    angles = [pi / 6, pi / 6, pi / 2]
    J = np.array([[*row(a), 0.2] for row, a in zip(PRINTED, angles, strict=True)])
    base = WheeledBase.omni(3, wheel_distance=0.2, radius=0.05, first_angle=pi / 2)
    np.testing.assert_allclose(base.rolling, J[[2, 0, 1]], rtol=0, atol=1e-15)  # at 90, 210 and 330 deg
    xi = np.array([0.3, -0.2, 1.1])
    np.testing.assert_allclose(base.inverse(Twist(*xi)) * 0.05, (J @ xi)[[2, 0, 1]], rtol=0, atol=1e-15)


def test_theta0_plus_thetadot3_is_90_degrees_plus_alpha3():
    """004 (5)-(7): "theta0 + thetadot3" adds an angle to a rate; only 90 deg + alpha3 is a direction of a wheel."""
    alpha, theta0, thetadot3 = 0.4, 0.1, 0.7
    printed = (cos(theta0 + thetadot3), cos(alpha))
    right = (cos(pi / 2 + alpha), cos(alpha))
    assert abs(hypot(*printed) - 1.0) > 0.1  # no direction at all
    assert hypot(*right) == pytest.approx(1.0)
    np.testing.assert_allclose(row_of(alpha)[:2], right, rtol=0, atol=1e-15)


def test_lateral_rows_of_omni_wheels():
    """004 (2), (4), (6): "no lateral sliding" for every wheel. Then nothing moves: rollers are free sideways."""
    omni = WheeledBase.omni(3, wheel_distance=0.2, radius=0.05)
    assert omni.lateral.shape == (0, 3)
    ordinary = WheeledBase([Wheel(w.x, w.y, w.drive_angle, w.radius) for w in omni.wheels])
    translation = [row[:2] for row in ordinary.lateral]
    assert np.linalg.matrix_rank(translation) == 2  # as printed, without thetadot: xdot = ydot = 0
    assert (ordinary.degrees_of_control, omni.degrees_of_control) == (1, 3)


def test_one_row_for_every_wheel():
    """The row of an omni wheel at the position angle a is (-sin a, cos a, d), whichever wheel it is."""
    for a in np.linspace(-pi, pi, 13):
        row = evaluator(laws.rolling_row)(0.2 * cos(a), 0.2 * sin(a), float(a) + pi / 2, 0.0)
        np.testing.assert_allclose(row, [-sin(a), cos(a), 0.2], rtol=0, atol=1e-15)
