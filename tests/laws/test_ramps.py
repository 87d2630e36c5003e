"""Laws of ramps, moves from rest to rest and holonomic motion."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import trapezoid as quadrature

from coplanar import Displacement, Pose, Twist
from coplanar.motion import HolonomicMotion, Odometry, Ramp, Trapezoid, discretize, twist_between

quick = settings(deadline=None, max_examples=40)
ordinary = st.floats(-3.0, 3.0).map(lambda x: round(x, 9))
numbers = st.one_of(ordinary, st.sampled_from([0.0, 1e-300, -1e-15, 1e-9]))
positive = st.floats(0.05, 3.0)
SHAPES = [(), (1,), (3, 1, 2)]
seeds = st.integers(0, 2**32 - 1)


@given(v1=numbers, v2=numbers, a=positive)
@quick
def test_ramps_land_exactly_and_hold(v1, v2, a):
    for ramp in (Ramp.independent([v1, v2], [v2, v1], a), Ramp.synchronised([v1, 0.0], [v2, 3.0], [a, 2.0])):
        end = ramp.duration
        after = [end, np.nextafter(end, np.inf), end + 1.0]
        assert np.all(ramp.velocity(after) == ramp.target)
        assert np.all(ramp.velocity(-1.0) == ramp.start)
        assert np.isfinite(ramp.accelerations).all()
    np.testing.assert_allclose(Ramp.independent([v1], [v2], a).duration, abs(v2 - v1) / a)


@given(v1=numbers, v2=numbers, a=positive)
@quick
def test_ramp_positions_are_the_integral(v1, v2, a):
    ramp = Ramp.independent([v1, 1.0], [v2, 1.0], a)
    knots = np.unique([0.0, *ramp.durations, ramp.duration + 1.0])
    way = quadrature(ramp.velocity(knots), knots, axis=0)  # exact: the velocity is linear between knots
    np.testing.assert_allclose(ramp.position([2.0, -1.0], knots[-1]) - [2.0, -1.0], way, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(ramp.position([0.0, 0.0], -2.0), -2.0 * ramp.start)


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds)
@quick
def test_synchronised_ramps_keep_the_direction_and_the_limits(shape, seed):
    rng = np.random.default_rng(seed)
    start, target = rng.uniform(-2, 2, (2, *shape, 3))
    limits = rng.uniform(0.2, 2.0, 3)
    ramp, t = Ramp.synchronised(start, target, limits), rng.uniform(0.0, 1.0)
    gained = ramp.velocity(t * np.asarray(ramp.duration)) - start
    np.testing.assert_allclose(gained, t * (target - start), atol=1e-12)
    used = np.abs(ramp.accelerations) / limits
    np.testing.assert_allclose(used.max(axis=-1), 1.0)
    length = np.linalg.norm(Ramp.synchronised(start, target, 0.7, limit="norm").accelerations, axis=-1)
    np.testing.assert_allclose(length, 0.7)


def test_independent_ramps_bend_the_path():
    start, target = [0.0, 0.0], [2.0, 1.0]
    middle = Ramp.independent(start, target, 1.0).velocity(1.0)
    assert abs(middle[0] * target[1] - middle[1] * target[0]) > 0.5
    middle = Ramp.synchronised(start, target, 1.0).velocity(1.0)
    assert abs(middle[0] * target[1] - middle[1] * target[0]) < 1e-12


@given(v=st.tuples(numbers, numbers), w=st.tuples(numbers, numbers), part=st.floats(0.0, 1.2))
@quick
def test_ramps_of_a_unicycle_are_a_program(v, w, part):
    ramp = Ramp.independent([v[0], w[0]], [v[1], w[1]], [1.0, 0.7])
    program, t = ramp.as_program(), min(part, 1.0) * ramp.duration
    twist, velocity = program.twist(t), ramp.velocity(t)
    np.testing.assert_allclose((twist.vx, twist.omega), velocity, atol=1e-12)
    turned = ramp.position([0.0, 0.0], t)[1]
    np.testing.assert_allclose(program.pose(Pose(), t).theta, turned, atol=1e-12)


@given(
    d=st.one_of(ordinary, ordinary.map(lambda d: 30.0 * d)),
    limit=positive,
    up=positive,
    down=positive,
)
@quick
def test_moves(d, limit, up, down):
    move = Trapezoid(d, limit, up, down)
    rise, cruise, _ = move.times
    knots = np.array([0.0, rise, rise + cruise, move.duration])
    # A time is rounded in proportion to the duration, and the velocity there by as much times the acceleration.
    rounding = 4.0 * np.finfo(float).eps * max(up, down) * move.duration**2
    np.testing.assert_allclose(quadrature(move.velocity(knots), knots), d, rtol=1e-13, atol=rounding)
    assert move.peak <= limit
    assert (cruise == 0.0) or move.peak == limit
    for t in (move.duration, move.duration + 1.0):
        assert (move.position(t), move.velocity(t)) == (d, 0.0)
    assert (move.position(0.0), move.velocity(-1.0)) == (0.0, 0.0)
    for part in (0.1, 0.5, 0.9):  # on the way as well
        t = part * move.duration
        until = np.append(knots[knots < t], t)
        np.testing.assert_allclose(move.position(t), quadrature(move.velocity(until), until), rtol=1e-13, atol=rounding)


@given(d=st.floats(0.01, 5.0), up=positive, down=positive)
@quick
def test_short_moves_are_triangles(d, up, down):
    peak = np.sqrt(2.0 * d * up * down / (up + down))
    triangle = Trapezoid(d, 1.01 * peak, up, down)
    assert triangle.times[1] == 0.0
    np.testing.assert_allclose(triangle.peak, peak)
    assert Trapezoid(d, 0.99 * peak, up, down).times[1] > 0.0


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds)
@quick
def test_holonomic_positions_are_integrals(shape, seed):
    rng = np.random.default_rng(seed)
    t = np.cumsum(rng.uniform(0.1, 1.0, 6))
    samples = rng.uniform(-2, 2, (3, *shape, 6))
    start = Pose(*rng.uniform(-1, 1, (3, *shape)))
    linear = HolonomicMotion.from_samples(t, *samples)
    held = HolonomicMotion.from_samples(t, *samples, between="hold")
    ways = {id(linear): quadrature(samples, t), id(held): (samples[..., :-1] * np.diff(t)).sum(-1)}
    for motion in (linear, held):
        end = motion.end(start).as_array()
        np.testing.assert_allclose(end, start.as_array() + np.moveaxis(ways[id(motion)], 0, -1), atol=1e-12)
        assert np.shape(motion.speed(1.0)) == shape
    np.testing.assert_allclose(linear.velocity(t[3] - t[0]), np.moveaxis(samples[..., 3], 0, -1), atol=1e-12)
    np.testing.assert_allclose(linear.pose(start, 99.0).as_array(), linear.end(start).as_array())


@given(seed=seeds)
@quick
def test_accelerations_and_samples_are_the_same_motion(seed):
    rng = np.random.default_rng(seed)
    dt, a, v0 = rng.uniform(0.1, 1.0, 4), rng.uniform(-2, 2, (4, 3)), rng.uniform(-1, 1, 3)
    v = np.vstack([v0, v0 + np.cumsum(a * dt[:, None], axis=0)])
    one = HolonomicMotion.from_accelerations(dt, a, velocity=v0)
    other = HolonomicMotion.from_samples(np.concatenate([[0.0], np.cumsum(dt)]), *v.T)
    t = np.linspace(-0.1, 4.5, 40)
    np.testing.assert_allclose(one.pose(Pose(), t).as_array(), other.pose(Pose(), t).as_array(), atol=1e-12)


def test_a_constant_field_twist_is_a_line_and_a_constant_body_twist_an_arc():
    twist, t = Twist(1.0, 0.0, 2.0), np.linspace(0.0, 1.0, 5)
    field = HolonomicMotion([[1.0, 0.0, 2.0]], [[0.0, 0.0, 0.0]], [1.0]).pose(Pose(), t)
    body = Pose().step(twist.during(t))
    np.testing.assert_allclose(field.theta, body.theta)
    assert np.all(field.y == 0.0)
    np.testing.assert_allclose(np.hypot(body.x, body.y - 0.5), 0.5)
    assert body.y[-1] > 0.5


@given(vx=numbers, vy=numbers, omega=numbers, dt=st.floats(0.001, 1.0))
@quick
def test_discretised_twists_end_where_they_should(vx, vy, omega, dt):
    wanted = Twist(vx, vy, omega)
    end = Pose().step(discretize(wanted, dt).during(dt))
    np.testing.assert_allclose(end.as_array(), (vx * dt, vy * dt, omega * dt), atol=1e-12)
    there = Pose(vx, vy, omega)
    led = Pose(1.0, 2.0, 0.5).step(twist_between(Pose(1.0, 2.0, 0.5), there, dt).during(dt))
    np.testing.assert_allclose(led.position, there.position, atol=1e-11)


def test_sideways_increments_are_odometry_too():
    path = Odometry(Displacement(0.0, [1.0, 1.0], 0.0)).path(Pose())
    assert path.y.tolist() == [0.0, 1.0, 2.0]
