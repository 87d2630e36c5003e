"""Laws of control: A and its inverse, poles, plant steps, limits, polar coordinates."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from coplanar import Pose
from coplanar.control import Limits, PointTracker, PolarController, Unicycle
from coplanar.control.stability import loop_poles, moving_poles
from coplanar.engine import evaluator
from coplanar.laws import control as laws
from coplanar.laws import polar

SHAPES = [(), (1,), (3, 1, 2)]
angle = st.floats(-7.0, 7.0)
ahead = st.one_of(st.floats(0.01, 2.0), st.floats(-2.0, -0.01), st.sampled_from([1e-6, -1e-6]))
aside = st.floats(-2.0, 2.0)
rate = st.floats(-5.0, 5.0)
step = st.floats(1e-4, 0.1)
gain = st.floats(0.1, 200.0)


@settings(deadline=None, max_examples=60)
@given(angle, ahead, aside, rate, rate)
def test_command_undoes_velocity(heading, px, py, wx, wy):
    tracker = PointTracker((px, py), kp=1.0)
    back = tracker.velocity(heading, tracker.command(heading, (wx, wy)))
    worst = 1e-15 * (1.0 + (abs(py) + 1.0) / abs(px)) * 40.0
    np.testing.assert_allclose(back, [wx, wy], rtol=0, atol=worst)


@settings(deadline=None, max_examples=40)
@given(angle, ahead, aside, rate, rate)
def test_velocity_is_the_rate_of_the_point(heading, px, py, v, omega):
    tracker, h = PointTracker((px, py), kp=1.0), 1e-5
    ends = [Pose(*Unicycle().advance((0.3, -0.2, heading), (v, omega), sign * h)).act(px, py) for sign in (1.0, -1.0)]
    slope = (np.array(ends[0]) - np.array(ends[1])) / (2.0 * h)
    np.testing.assert_allclose(slope, tracker.velocity(heading, (v, omega)), atol=1e-7)


@settings(deadline=None, max_examples=40)
@given(angle, ahead, aside)
def test_determinant_is_px(heading, px, py):
    tracker = PointTracker((px, py), kp=1.0)
    A = np.stack([tracker.velocity(heading, (1.0, 0.0)), tracker.velocity(heading, (0.0, 1.0))], axis=-1)
    assert np.linalg.det(A) == pytest.approx(px, abs=1e-14)


@settings(deadline=None, max_examples=30)
@given(angle, ahead, aside, rate, rate)
def test_center_under_a_point(heading, px, py, x, y):
    pose = PointTracker((px, py), kp=1.0).pose_for((x, y), heading)
    np.testing.assert_allclose(pose.act(px, py), (x, y), atol=1e-14)


@pytest.mark.parametrize("shape", SHAPES)
def test_any_shape(shape):
    rng = np.random.default_rng(0)
    heading, w = rng.normal(size=shape), rng.normal(size=(*shape, 2))
    tracker = PointTracker((0.1, 0.02), kp=1.0)
    command = tracker.command(heading, w)
    assert command.shape == (*shape, 2)
    for i in np.ndindex(shape):
        np.testing.assert_allclose(command[i], tracker.command(float(heading[i]), w[i]), rtol=1e-14)


@settings(deadline=None, max_examples=60)
@given(step, gain, st.floats(-1.5, 1.5))
def test_poles_solve_the_quadratic(h, kp, kd):
    poles = loop_poles(h, kp, kd, 0.0)
    np.testing.assert_allclose(poles.sum(), 1.0 - h * kp - kd, atol=1e-12)
    np.testing.assert_allclose(poles.prod(), -kd, atol=1e-12)
    assert poles[0] == pytest.approx(poles[1].conj()) or not poles.imag.any()


def matrix_of_the_loop(h, kp, kd, ki, g, lead):
    """One step of (e, e before, integral / h, h V theta) across a straight reference, written out."""

    def after(state):
        e, last, total, psi = state
        total = total + e
        push = h * kp * e + kd * (e - last) + h * h * ki * total
        turn = g * (push - psi)
        return [e - push - lead * turn, e, total, psi + turn]

    return np.array([after(column) for column in np.eye(4)]).T


@settings(deadline=None, max_examples=60)
@given(step, gain, st.floats(-0.9, 0.9), st.floats(0.1, 500.0), st.floats(0.01, 3.0), st.sampled_from([0.0, 0.5]))
def test_polynomials_are_those_of_the_loop(h, kp, kd, ki, g, lead):
    def same(polynomial, matrix):
        size = np.abs(np.poly(matrix)).max()
        np.testing.assert_allclose(polynomial, np.poly(matrix), atol=1e-12 * size)

    whole = matrix_of_the_loop(h, kp, kd, ki, g, lead)
    same(evaluator(laws.lateral_polynomial)(h, kp, kd, ki, g, lead), whole)
    still = matrix_of_the_loop(h, kp, kd, ki, 0.0, lead)[:3, :3]
    same(evaluator(laws.pid_polynomial)(h, kp, kd, ki), still)
    bare = matrix_of_the_loop(h, kp, kd, 0.0, g, lead)[np.ix_([0, 1, 3], [0, 1, 3])]
    same(
        evaluator(laws.lateral_polynomial)(h, kp, kd, 0.0, g, lead),
        np.block([[bare, np.zeros((3, 1))], [np.zeros((1, 4))]]),
    )


@settings(deadline=None, max_examples=60)
@given(st.lists(st.floats(-1.4, 1.4), min_size=4, max_size=4))
def test_schur_cohn_is_positive_inside_the_unit_circle_only(roots):
    polynomial = np.poly([complex(roots[0], roots[1]), complex(roots[0], -roots[1]), roots[2], roots[3]]).real
    largest = np.abs(np.roots(polynomial)).max()
    assume(abs(largest - 1.0) > 1e-3)
    assert (evaluator(laws.schur_cohn)(*polynomial[1:]) > 0.0) == (largest < 1.0)


@settings(deadline=None, max_examples=40)
@given(
    st.floats(5.0, 200.0),
    st.floats(-0.9, 0.95),
    st.sampled_from([0.0, 1.0, 50.0, 500.0]),
    st.sampled_from([0.0, 0.3, 2.0]),
)
def test_largest_step_is_where_a_pole_leaves(kp, kd, ki, speed):
    for method in ("euler", "exact"):
        tracker = PointTracker((0.05, 0.0), kp, kd, ki)
        edge = tracker.stability(0.01, method=method, speed=speed).largest_step
        if edge == 0.0:  # the integral is too much for the moving loop, however fast it samples
            margins = [tracker.stability(h, method=method, speed=speed).margin for h in (1e-4, 1e-3, 1e-2)]
            assert max(margins) < 0.0 < ki * speed
            continue
        below = tracker.stability(0.999 * edge, method=method, speed=speed)
        above = tracker.stability(1.001 * edge, method=method, speed=speed)
        assert below.margin > 0.0 > above.margin


@settings(deadline=None, max_examples=30)
@given(gain, st.floats(0.01, 0.95), st.floats(0.1, 2.0), st.floats(0.02, 0.2))
def test_largest_step_on_the_move_in_closed_form(kp, kd, speed, px):
    exact = PointTracker((px, 0.0), kp, kd).stability(0.01, method="rk4", speed=speed)
    assert exact.largest_step <= 2.0 * (1.0 - kd) / (kp + speed / px) * (1.0 + 1e-9)
    euler = PointTracker((px, 0.0), kp, kd).stability(0.01, speed=speed)
    assert euler.largest_step == pytest.approx(min(2.0 * (1.0 - kd) / kp, 2.0 * px / speed), rel=1e-9)


def test_poles_for_many_gains_at_once():
    kp, kd = np.meshgrid([10.0, 100.0], [0.0, 0.5, 1.2], indexing="ij")
    many = loop_poles(0.01, kp, kd, 0.0)
    assert many.shape == (2, 3, 2)
    for i in np.ndindex(kp.shape):
        np.testing.assert_allclose(many[i], loop_poles(0.01, float(kp[i]), float(kd[i]), 0.0), atol=1e-15)
    assert moving_poles(0.01, (kp, kd, 0.0), 0.2, 0.5).shape == (2, 3, 4)


ORDERS = {"euler": 1, "midpoint": 2, "heun": 2, "rk4": 4}


@pytest.mark.parametrize("method", ORDERS)
def test_order_of_the_plant_steps(method):
    def off(step):
        state = exact = (0.1, -0.2, 0.3)
        for k in range(round(1.0 / step)):
            command = (1.0, 2.0 + math.sin(k * step))
            state = Unicycle().advance(state, command, step, method=method)
            exact = Unicycle().advance(exact, command, step)
        return math.dist(state[:2], exact[:2])

    order = math.log2(off(1 / 16) / off(1 / 32))
    assert order == pytest.approx(ORDERS[method], abs=0.25)


@settings(deadline=None, max_examples=30)
@given(angle, rate, rate, st.floats(0.01, 1.0))
def test_exact_steps_join(theta, v, omega, h):
    state = whole = (0.0, 0.0, theta)
    for _ in range(10):
        state = Unicycle().advance(state, (v, omega), 0.1 * h)
    np.testing.assert_allclose(state, Unicycle().advance(whole, (v, omega), h), atol=1e-13)


@settings(deadline=None, max_examples=60)
@given(rate, rate, st.floats(0.1, 2.0), st.floats(0.1, 2.0), st.floats(0.1, 2.0), st.floats(0.05, 0.5))
def test_limits_hold_and_scaling_keeps_the_curvature(v, omega, v_max, omega_max, rim, b):
    for mode in ("scale", "clip", "keep_omega"):
        kept = Limits(v=v_max, omega=omega_max, rim=rim, half_track=b, mode=mode).apply((v, omega))
        assert abs(kept[0]) <= v_max + 1e-12
        assert abs(kept[1]) <= omega_max + 1e-12
        assert abs(kept[0]) + b * abs(kept[1]) <= rim + 1e-12
        again = Limits(v=v_max, omega=omega_max, rim=rim, half_track=b, mode=mode).apply(kept)
        np.testing.assert_allclose(again, kept, atol=1e-14)
    scaled = Limits(v=v_max, omega=omega_max, rim=rim, half_track=b).apply((v, omega))
    assert scaled[0] * omega == pytest.approx(scaled[1] * v, abs=1e-12)
    turned = Limits(omega=omega_max, rim=1e9, half_track=b, mode="keep_omega").apply((v, omega))
    assert turned == pytest.approx((v, max(-omega_max, min(omega_max, omega))))


@settings(deadline=None, max_examples=40)
@given(angle, rate, rate, angle, rate, rate)
def test_polar_coordinates_find_the_goal(theta, x, y, gtheta, gx, gy):
    assume(math.hypot(gx - x, gy - y) > 1e-6)
    rho, alpha, beta = evaluator(polar.polar_coordinates)(x, y, theta, gx, gy, gtheta)
    assert x + rho * math.cos(theta + alpha) == pytest.approx(gx, abs=1e-9)
    assert y + rho * math.sin(theta + alpha) == pytest.approx(gy, abs=1e-9)
    assert math.cos(theta + alpha + beta - gtheta) == pytest.approx(1.0)


@pytest.mark.parametrize("form", ["linear", "smooth"])
@pytest.mark.parametrize("method", ["euler", "heun", "exact"])
@pytest.mark.parametrize("h", [0.01, 0.1, 0.25])
def test_polar_poles_are_those_of_a_step(form, method, h):
    """One step of (alpha, beta) near the goal, differenced; by sum and product, for double roots are no measure."""
    controller, small = PolarController(Pose(), form=form), 1e-6

    def after(alpha, beta):
        towards = -beta
        start = (-0.5 * math.cos(towards), -0.5 * math.sin(towards), towards - alpha)
        command, _, _ = controller.respond(start, (0.0, 0.0, 0.0), (1.0,), h)
        moved = Unicycle().advance(start, command, h, method=method)
        return np.array(evaluator(polar.polar_coordinates)(*moved, 0.0, 0.0, 0.0)[1:])

    J = np.stack([(after(small, 0.0) - after(-small, 0.0)), (after(0.0, small) - after(0.0, -small))], -1) / (2 * small)
    ours = np.poly(controller.stability(h, method=method).poles)
    np.testing.assert_allclose(np.poly([*np.linalg.eigvals(J), 1.0 - h * controller.k_rho]), ours, atol=1e-6)
