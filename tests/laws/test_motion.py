"""Laws that every motion of constant (v, omega, a, alpha) obeys, over batch shapes and near-singular draws."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar import Displacement, Pose
from coplanar.engine import evaluator, gauss
from coplanar.integrators import integrate_ode
from coplanar.laws import motion as laws
from coplanar.motion import DrivingHistory, Odometry, OdometryNoise, Program, Segment
from coplanar.motion.covariance import carried
from tests.engines import HAS_JAX, on_floats

SHAPES = [(), (1,), (3, 1, 2)]
TINY = [0.0, 1e-300, 1e-15, -1e-12, 1e-8, -1e-5]
quick = settings(deadline=None, max_examples=40)
ordinary = st.floats(-3.0, 3.0).map(lambda x: round(x, 9))
numbers = st.one_of(ordinary, st.sampled_from(TINY))
positive = st.floats(0.01, 3.0)
seeds = st.integers(0, 2**32 - 1)


def draw(seed, shape, count=4):
    rng = np.random.default_rng(seed)
    table = rng.uniform(-2.0, 2.0, (count, *shape))
    table[rng.random(table.shape) < 0.2] = rng.choice(TINY)
    return [float(row) if not shape else row for row in table]


def close(one, other, tolerance=1e-12):
    np.testing.assert_allclose(one.as_array(), other.as_array(), rtol=tolerance, atol=tolerance)


def start_of(seed, shape):
    return Pose(*draw(seed + 1, shape, 3))


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds, t=positive, part=st.floats(0.0, 1.0))
@quick
def test_segments_continue(shape, seed, t, part):
    """Driving t1 and then going on with the velocities reached there is driving t1 + t2."""
    segment, start = Segment(*draw(seed, shape), duration=t), start_of(seed, shape)
    now = segment.twist(part * t)
    rest = Segment(now.vx, now.omega, segment.a, segment.alpha, duration=t - part * t)
    close(rest.end(segment.pose(start, part * t)), segment.end(start))


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds, t=positive)
@quick
def test_segments_can_be_driven_back(shape, seed, t):
    segment, start = Segment(*draw(seed, shape), duration=t), start_of(seed, shape)
    last = segment.twist(t)
    back = Segment(-last.vx, -last.omega, segment.a, segment.alpha, duration=t)
    close(back.end(segment.end(start)), start)


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds, t=positive)
@quick
def test_segments_do_not_care_where_they_start(shape, seed, t):
    segment, start = Segment(*draw(seed, shape), duration=t), start_of(seed, shape)
    close(segment.end(start), start @ segment.end(Pose()))


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds, t=numbers)
@quick
def test_arc_is_the_segment_without_acceleration(shape, seed, t):
    v, omega, x, y = draw(seed, shape)
    theta = 0.5 * (x + y)
    arc, segment = laws.arc(x, y, theta, v, omega, t), laws.segment(x, y, theta, v, omega, 0.0 * v, 0.0 * v, t)
    np.testing.assert_allclose(np.stack(arc), np.stack(segment), rtol=1e-13, atol=1e-13)


@given(v=numbers, omega=st.floats(0.2, 3.0), t=positive)
@quick
def test_arc_is_the_closed_form(v, omega, t):
    """x = (v/omega) sin(omega t), y = (v/omega)(1 - cos(omega t)): a circle about (0, v/omega)."""
    x, y, _ = laws.arc(0.0, 0.0, 0.0, v, omega, t)
    radius = v / omega
    np.testing.assert_allclose((x, y), (radius * np.sin(omega * t), radius * (1.0 - np.cos(omega * t))), atol=1e-13)
    np.testing.assert_allclose(x * x + (y - radius) ** 2, radius * radius, rtol=1e-12, atol=1e-13)


@given(v=ordinary, omega=ordinary, t=positive)
@quick
def test_one_step_is_a_thousand_is_the_ode(v, omega, t):
    one = np.array(laws.arc(0.3, -0.2, 0.5, v, omega, t))
    many = Odometry.from_velocities(v, omega, np.linspace(0.0, t, 1001)).path(Pose(0.3, -0.2, 0.5)).as_array()[-1]
    ode = DrivingHistory([0.0, t], v, omega).path(Pose(0.3, -0.2, 0.5), "DOP853").as_array()[-1]
    np.testing.assert_allclose(many, one, atol=1e-12)
    np.testing.assert_allclose(ode, one, atol=1e-8)


@given(v=positive, power=st.integers(1, 300), t=positive)
@quick
def test_lateral_part_of_a_tiny_turn(v, power, t):
    """y -> v omega t^2/2 and, for alpha, v alpha t^3/6, each to its own last digits."""
    tiny = 10.0**-power
    _, y, _ = laws.arc(0.0, 0.0, 0.0, v, tiny, t)
    np.testing.assert_allclose(y, 0.5 * v * tiny * t * t, rtol=1e-14 + tiny * tiny * t * t)
    _, y, _ = (row[()] for row in on_floats(laws.segment, 0.0, 0.0, 0.0, v, 0.0, 0.0, tiny, t))
    np.testing.assert_allclose(y, v * tiny * t**3 / 6.0, rtol=1e-14 + tiny * tiny * t**4)


@given(v=numbers, a=numbers, t=positive, theta=numbers)
@quick
def test_a_line_is_exact(v, a, t, theta):
    end = Segment(v, 0.0, a, 0.0, duration=t).end(Pose(0.0, 0.0, theta))
    way = (v + 0.5 * a * t) * t
    room = 4e-16 * (abs(v) + 0.5 * abs(a) * t) * t + 1e-300  # of the two ways whose sum may be small
    np.testing.assert_allclose(end.as_array(), (way * np.cos(theta), way * np.sin(theta), theta), rtol=4e-16, atol=room)


@given(v=positive, omega=st.floats(0.1, 2.0), h=st.floats(0.01, 0.5), count=st.integers(1, 60))
@quick
def test_euler_is_the_chord_scaled_and_turned(v, omega, h, count):
    """With constant (v, omega): exact = Euler sinc(omega h/2) e^(i omega h/2), so a full turn hides the error."""
    euler = DrivingHistory(h * np.arange(count + 1), v, omega).path(Pose(), "euler").position[-1] @ [1, 1j]
    exact = np.array(laws.arc(0.0, 0.0, 0.0, v, omega, count * h)[:2]) @ [1, 1j]
    half = 0.5 * omega * h
    np.testing.assert_allclose(exact, euler * np.sin(half) / half * np.exp(1j * half), atol=1e-11)


@given(seed=seeds, h=positive)
@quick
def test_an_euler_step_is_the_tangent(seed, h):
    """The law for one step is what the integrator's table does with the rates."""
    x, y, theta, v = draw(seed, ())
    omega = 0.7 * v + x
    step = DrivingHistory([0.0, h], v, omega).path(Pose(x, y, theta), "euler")
    np.testing.assert_allclose(laws.euler(x, y, theta, v, omega, h), step.as_array()[-1], rtol=1e-14, atol=1e-14)


def test_a_full_turn_hides_the_error_of_euler():
    """|chord| omega h/2 vanishes with the chord: half a turn shows it, a full one does not."""
    h, omega = 2 * np.pi / 100, 1.0
    path = DrivingHistory(h * np.arange(101), 1.0, omega).path(Pose(), "euler").position
    exact = Odometry.from_velocities(1.0, omega, h * np.arange(101)).path(Pose()).position
    error = np.linalg.norm(path - exact, axis=1)
    assert error[100] < 1e-12
    np.testing.assert_allclose(error[50], np.linalg.norm(exact[50]) * omega * h / 2, rtol=1e-2)


@pytest.mark.skipif(not HAS_JAX, reason="JAX is not installed")
def test_segment_jacobian_is_the_derivative():
    import jax

    rows = np.array(draw(7, (40,), 7))
    t = np.linspace(0.1, 3.0, 40)

    def end(*p):
        return jax.numpy.stack(Segment(*p[3:], duration=t).end(Pose(*p[:3])).parts)

    with jax.enable_x64(True):
        args = tuple(map(jax.numpy.asarray, rows))
        directions = [tuple(jax.numpy.full(40, float(i == k)) for i in range(7)) for k in range(7)]
        J = np.stack([jax.jvp(end, args, d)[1] for d in directions], -1)
    F, G = Segment(*rows[3:], duration=t).jacobians(Pose(*rows[:3]))
    np.testing.assert_allclose(np.concatenate((F, G), -1), np.moveaxis(J, 1, 0), atol=1e-12)


@pytest.mark.skipif(not HAS_JAX, reason="JAX is not installed")
def test_gradients_at_the_straight_line():
    import jax

    with jax.enable_x64(True):
        zero = jax.numpy.asarray(0.0)
        end = jax.grad(lambda w, b: Segment(1.0 + 0.0 * w, w, 0.0 * w, b, duration=2.0).end(Pose()).y, (0, 1))
        np.testing.assert_allclose(end(zero, zero), (2.0, 8.0 / 6.0), rtol=1e-13)


@pytest.mark.skipif(not HAS_JAX, reason="JAX is not installed")
def test_a_program_can_be_differentiated():
    import jax

    def end(v):
        return Program(Segment(v, 0.0 * v + 0.3, 0.0 * v, 0.0 * v, duration=0.0 * v + 1.0)).pose(Pose(), 1.5).x

    v = np.array([1.0, 2.0])
    with jax.enable_x64(True):
        slope = [float(jax.jvp(end, (jax.numpy.asarray(v),), (jax.numpy.asarray(e),))[1]) for e in np.eye(2)]
    steps = 1e-6 * np.eye(2)
    np.testing.assert_allclose(slope, [(end(v + s) - end(v - s)) / 2e-6 for s in steps], rtol=1e-7)


@given(seed=seeds)
@quick
def test_curvature_of_a_clothoid_is_linear_in_arc_length(seed):
    """With a = 0 the rate of the curvature along the path is alpha/v^2; with an acceleration it is not constant."""
    v, omega, alpha = 0.5 + np.abs(draw(seed, (), 3))
    t = np.linspace(0.0, 1.0, 6)
    clothoid = Segment(v, omega, 0.0, alpha, duration=1.0)
    general = Segment(v, omega, 2.0 * v + alpha, alpha, duration=1.0)
    slopes = [np.diff(s.curvature(t)) / np.diff((s.v + 0.5 * s.a * t) * t) for s in (clothoid, general)]
    assert (clothoid.kind, general.kind) == ("clothoid", "general")
    np.testing.assert_allclose(slopes[0], alpha / v**2, rtol=1e-9)
    assert np.ptp(slopes[1]) > 1e-3 * np.abs(slopes[1]).max()


@given(v=positive, omega=numbers.filter(lambda w: abs(w) > 0.05), gain=st.sampled_from([0.0, 1e-6, -0.5, 2.0]))
@quick
def test_proportional_accelerations_stay_on_the_circle(v, omega, gain):
    segment = Segment(v, omega, gain * v, gain * omega, duration=3.0)
    t = np.linspace(0.0, 3.0, 7)
    path, radius = segment.pose(Pose(), t), v / omega
    np.testing.assert_allclose(np.hypot(path.x, path.y - radius), abs(radius), rtol=1e-12)
    assert segment.kind == ("circle" if gain else "arc")


@given(v=positive, stop=st.floats(0.1, 0.9), omega=ordinary, alpha=ordinary)
@quick
def test_a_cusp_is_passed(v, stop, omega, alpha):
    """The speed changes sign inside: the pose stays the integral, and backs away along the same direction."""
    segment = Segment(v, omega, -v / stop, alpha, duration=1.0)
    np.testing.assert_allclose(segment.cusp_time, stop, rtol=1e-12)
    eps = 1e-3
    around = segment.pose(Pose(), stop + np.array([-eps, 0.0, eps]))
    # Both sides lie behind the cusp, half an acceleration times eps^2 away, along the heading there.
    back = [around[1].act_inverse(*around[i].parts[:2])[0] for i in (0, 2)]
    np.testing.assert_allclose(back, 0.5 * segment.a * eps**2, rtol=1e-3)
    ode = integrate_ode(
        lambda t, p: np.stack(laws.unicycle_rates(p[2], *laws.velocities(*segment.parts[:4], t))),
        [0.0, stop, 1.0], np.zeros(3), method="DOP853",
    )  # fmt: skip
    np.testing.assert_allclose(ode[-1], segment.end(Pose()).as_array(), atol=1e-8)


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds, t=st.floats(-0.5, 5.0))
@quick
def test_programs_are_their_segments(shape, seed, t):
    rng = np.random.default_rng(seed)
    segments = [Segment(*draw(seed + i, shape), duration=float(rng.uniform(0.0, 1.5))) for i in range(4)]
    program, start = Program(segments), start_of(seed, shape)
    pose, before = start, 0.0
    for segment in segments:
        pose = segment.pose(pose, min(max(t - before, 0.0), segment.duration))
        before += segment.duration
    close(program.pose(start, t), pose)
    assert program.poses(start).shape == (*shape, 5)
    close(program.end(start), program.pose(start, program.duration))
    close(program.poses(start)[..., -1], program.end(start))


@given(seed=seeds)
@quick
def test_programs_of_robots_with_their_own_durations(seed):
    """A batch of programs is the programs one by one."""
    rng = np.random.default_rng(seed)
    rows = Segment(*rng.uniform(-2, 2, (4, 3, 5)), duration=rng.uniform(0.0, 1.0, (3, 5)))
    t = rng.uniform(-0.5, 4.0, (7, 1))
    together = Program(rows)
    poses, twists = together.pose(Pose(0.1, 0.2, 0.3), t), together.twist(t).as_array()
    for i in range(3):
        alone = Program(rows[i])
        close(poses[:, i], alone.pose(Pose(0.1, 0.2, 0.3), t[:, 0]))
        np.testing.assert_allclose(twists[:, i], alone.twist(t[:, 0]).as_array(), atol=1e-12)


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds)
@quick
def test_odometry_is_step_after_step(shape, seed):
    rng = np.random.default_rng(seed)
    increments = Displacement(*rng.uniform(-1, 1, (3, *shape, 20)))
    odometry, start = Odometry(increments), start_of(seed, shape)
    path, pose = odometry.path(start), start
    for k in range(20):
        pose = pose.step(increments[..., k])
        close(path[..., k + 1], pose)
    assert path.shape == (*shape, 21)


@given(seed=seeds)
@settings(deadline=None, max_examples=15)
def test_odometry_jacobians_against_differences(seed):
    rng = np.random.default_rng(seed)
    increment, pose, eps = rng.uniform(-1, 1, 3), rng.uniform(-1, 1, 3), 1e-6

    def step(p, d):
        return Pose.from_array(p).step(Displacement.from_array(d)).as_array()

    F, G = Odometry(Displacement.from_array(increment[None])).jacobians(Pose.from_array(pose))
    moved = [(step(pose + e, increment) - step(pose - e, increment)) / (2 * eps) for e in eps * np.eye(3)]
    driven = [(step(pose, increment + e) - step(pose, increment - e)) / (2 * eps) for e in eps * np.eye(3)]
    np.testing.assert_allclose(F[0], np.transpose(moved), atol=1e-8)
    np.testing.assert_allclose(G[0], np.transpose(driven), atol=1e-8)


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds)
@settings(deadline=None, max_examples=15)
def test_covariances_are_the_recursion(shape, seed):
    """The running sum about the start is P' = F P F^T + G Q G^T, tick by tick."""
    rng = np.random.default_rng(seed)
    odometry = Odometry(Displacement(*rng.uniform(-1, 1, (3, *shape, 30))))
    start, noise = start_of(seed, shape), OdometryNoise(0.1, 0.02, 0.05, 0.03)
    root = rng.uniform(-0.1, 0.1, (3, 3))
    P = np.broadcast_to(root @ root.T, (*shape, 3, 3))
    F, G = odometry.jacobians(start)
    Q = noise.covariances(odometry.increments)
    got = odometry.covariances(start, noise, P)
    for k in range(30):
        P = carried(F[..., k, :, :], P) + carried(G[..., k, :, :], Q[..., k, :, :])
        np.testing.assert_allclose(got[..., k + 1, :, :], P, rtol=1e-10, atol=1e-13)
    np.testing.assert_allclose(odometry.covariances(start, Q)[..., 0, :, :], 0.0)


@given(seed=seeds, parts=st.integers(2, 8))
@settings(deadline=None, max_examples=15)
def test_noise_does_not_depend_on_the_rate_of_the_ticks(seed, parts):
    """Splitting every tick of a straight way leaves the growth of the variance alone."""
    rng = np.random.default_rng(seed)
    ways, noise = rng.uniform(0.01, 0.02, 200), OdometryNoise(0.1, 0.2, turn_per_metre=0.05)
    split = np.repeat(ways / parts, parts)
    coarse, fine = (Odometry(Displacement(w, 0.0, 0.0)).covariances(Pose(), noise)[-1] for w in (ways, split))
    np.testing.assert_allclose(fine, coarse, rtol=0.02, atol=1e-12)


def test_covariance_is_that_of_many_noisy_runs():
    rng = np.random.default_rng(3)
    ticks, noise = (
        Displacement(np.full(8, 0.25), 0.0, np.linspace(-0.1, 0.4, 8)),
        OdometryNoise(0.02, 0.01, 0.02, 0.02),
    )
    root = np.sqrt(np.einsum("kii->ki", noise.covariances(ticks)))
    noisy = ticks.as_array() + root * rng.standard_normal((2_400, 8, 3))
    ends = Odometry(Displacement.from_array(noisy)).path(Pose()).as_array()[:, -1]
    expected = Odometry(ticks).covariances(Pose(), noise)[-1]
    scale = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
    np.testing.assert_allclose(np.cov(ends.T) / scale, expected / scale, atol=0.1)


@pytest.mark.parametrize("fraction", [*(part for _, part in gauss.PARTS[:-1]), 0.999])
@pytest.mark.parametrize("share", [-1.0, -0.5, 0.0, 0.5, 1.0])
def test_fewer_points_for_a_fraction_of_a_panel_lose_nothing(fraction, share):
    turn = fraction * laws.PANEL_PHASE  # over [-1, 1], from omega and from alpha in these shares
    omega, alpha = 0.5 * turn * (1.0 - abs(share)), 0.5 * turn * share
    row = (0.0, 0.0, 0.0, 0.0, omega - alpha, 1.0, alpha, 2.0)
    few = evaluator(laws.segment).on_floats(*row)
    sixteen = evaluator(laws.segment).on_text(*(np.array([value]) for value in row))
    assert max(abs(a - b[0]) for a, b in zip(few, sixteen, strict=True)) <= 2.0 * 1e-15  # of the path, 2 m
