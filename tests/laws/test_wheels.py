"""Wheeled bases: forward after inverse, least squares, null spaces, centres of rotation, over random layouts."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from coplanar import Pose, Twist
from coplanar.engine import evaluator
from coplanar.laws import wheels as laws
from coplanar.wheels import Icr, Wheel, WheeledBase, turning_radius, wheel_centre_speeds

SHAPES = [(), (1,), (3, 1, 2)]
EPS = np.finfo(float).eps
seeds = st.integers(0, 2**32 - 1)
lengths = st.floats(0.05, 2.0)
speeds = st.floats(-5, 5)


def layouts(rng):
    """A random table of three to six wheels, some of them ordinary, omni, slanted."""
    kinds = [None, 0.0, pi / 4, -pi / 4, rng.uniform(-1, 1)]
    count = rng.integers(3, 7)
    picks = rng.choice(len(kinds), size=count, p=[0.1, 0.4, 0.2, 0.2, 0.1])
    return [Wheel(*rng.uniform(-1, 1, 2), rng.uniform(-pi, pi), rng.uniform(0.05, 0.3), kinds[k]) for k in picks]


def twists(rng, shape):
    return Twist(*rng.normal(size=(3, *shape)))


def well_conditioned(rng):
    base = WheeledBase(layouts(rng))
    assume(base.condition < 100)
    return base


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds)
@settings(deadline=None, max_examples=20)
def test_forward_after_inverse(shape, seed):
    """Wheels to body undoes body to wheels on every twist that slides no wheel, and no residual is left."""
    rng = np.random.default_rng(seed)
    base = well_conditioned(rng)
    wanted = base.feasible(twists(rng, shape)).twist
    rates = base.inverse(wanted)
    assert rates.shape == (*shape, len(base.wheels))
    back = base.forward(rates)
    tolerance = 1000 * EPS * base.condition
    np.testing.assert_allclose(back.as_array(), wanted.as_array(), rtol=0, atol=tolerance)
    residual = base.residual(rates)
    assert residual.shape == (*shape, len(base.row_names))
    np.testing.assert_allclose(residual, 0.0, rtol=0, atol=tolerance * 3)


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds)
@settings(deadline=None, max_examples=20)
def test_forward_is_least_squares(shape, seed):
    """The residual stands at right angles on every row's motion, and every other twist has a larger one."""
    rng = np.random.default_rng(seed)
    base = well_conditioned(rng)
    rates = rng.normal(size=(*shape, len(base.wheels)))
    residual = base.residual(rates)
    rows = np.vstack([base.rolling, base.lateral])
    np.testing.assert_allclose(residual @ rows, 0.0, rtol=0, atol=1000 * EPS * base.condition)
    best = base.forward(rates)
    other = Twist.from_array(best.as_array() + 0.1 * rng.normal(size=3))
    assert np.all(np.sum(base.residual(rates, other) ** 2, -1) >= np.sum(residual**2, -1))


@given(seed=seeds)
@settings(deadline=None, max_examples=30)
def test_rolling_rows_are_contact_velocities(seed):
    """The contact's velocity is the drive speed along beta and a free slide across the roller's axle."""
    rng = np.random.default_rng(seed)
    base, twist = WheeledBase(layouts(rng)), twists(rng, ())
    contacts = base.wheel_velocities(twist)
    for wheel, rate, velocity in zip(base.wheels, base.inverse(twist), contacts, strict=True):
        gamma = wheel.roller_angle or 0.0
        drive = np.array([np.cos(wheel.drive_angle), np.sin(wheel.drive_angle)])
        axle = wheel.drive_angle + gamma
        slide = velocity - wheel.radius * rate * drive
        assert slide @ (np.cos(axle), np.sin(axle)) == pytest.approx(0.0, abs=1e-13 / np.cos(gamma))


@given(seed=seeds)
@settings(deadline=None, max_examples=20)
def test_same_motion_from_another_origin(seed):
    """Moving the body origin changes the rows by the adjoint and leaves the rates as they are."""
    rng = np.random.default_rng(seed)
    wheels, twist = layouts(rng), twists(rng, ())
    T_new_old = Pose(*rng.normal(size=3))
    moved = []
    for w in wheels:
        x, y = T_new_old.act(w.x, w.y)
        moved.append(Wheel(x, y, w.drive_angle + T_new_old.theta, w.radius, w.roller_angle))
    np.testing.assert_allclose(
        WheeledBase(moved).inverse(T_new_old.transform(twist)), WheeledBase(wheels).inverse(twist), rtol=0, atol=1e-10
    )


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds, few=st.integers(1, 3))
@settings(deadline=None, max_examples=20)
def test_feasible_part(shape, seed, few):
    """The feasible part is a projection: feasible itself, nearest, and every admissible twist is kept."""
    rng = np.random.default_rng(seed)
    base = WheeledBase(layouts(rng)[:few])
    assume(base.mobility.singular_values[base.rank - 1] > 0.01)
    wanted = twists(rng, shape)
    answer = base.feasible(wanted)
    again = base.feasible(answer.twist, tolerance=1e-9)
    np.testing.assert_allclose(again.twist.as_array(), answer.twist.as_array(), rtol=0, atol=1e-10)
    assert np.all(again.is_feasible)
    if base.lateral.size:
        np.testing.assert_allclose(answer.twist.as_array() @ base.lateral.T, 0.0, rtol=0, atol=1e-10)
    if base.rank < 3:
        rates_of_undriven = base.inverse(Twist.from_array(base.mobility.undriven))
        np.testing.assert_allclose(rates_of_undriven, 0.0, rtol=0, atol=1e-8)
    scale = np.array([1.0, 1.0, base.mobility.length])
    np.testing.assert_allclose(
        np.sum(answer.infeasible.as_array() * answer.twist.as_array() * scale**2, -1), 0.0, rtol=0, atol=1e-9
    )
    assert base.degrees_of_control == base.rank - base.mobility.constraint_rank == len(base.mobility.admissible)


@given(half_track=lengths, left=lengths, right=lengths, rates=st.tuples(speeds, speeds))
@settings(deadline=None, max_examples=40)
def test_differential_textbook(half_track, left, right, rates):
    """The general table gives v = r (wr + wl)/2 and omega = r (wr - wl)/(2b), with unequal radii too."""
    base = WheeledBase.differential(half_track=half_track, left_radius=left, right_radius=right)
    v, omega = evaluator(laws.differential_forward)(*rates, left, right, half_track)
    twist = base.forward(rates)
    np.testing.assert_allclose(twist.as_array(), [v, 0.0, omega], rtol=0, atol=1e-14 / half_track)
    back = evaluator(laws.differential_inverse)(v, omega, left, right, half_track)
    np.testing.assert_allclose(back, rates, rtol=0, atol=1e-14 / min(left, right))
    np.testing.assert_allclose(base.inverse(Twist(v, 0.0, omega)), rates, rtol=0, atol=1e-14 / min(left, right))


@given(half_length=lengths, half_width=lengths, radius=lengths, seed=seeds)
@settings(deadline=None, max_examples=30)
def test_mecanum_matrix(half_length, half_width, radius, seed):
    """The general row gives the standard matrix of the X mounting, and |lx - ly| in the O mounting."""
    twist = twists(np.random.default_rng(seed), ())
    lever = half_length + half_width
    standard = np.array([[1, -1, -lever], [1, 1, lever], [1, 1, -lever], [1, -1, lever]])
    base = WheeledBase.mecanum(radius=radius, half_length=half_length, half_width=half_width)
    np.testing.assert_allclose(
        base.inverse(twist) * radius, standard @ twist.as_array(), rtol=0, atol=1e-14 * (1 + lever) * 9
    )
    wrong = WheeledBase.mecanum(radius=radius, half_length=half_length, half_width=half_width, rollers="O")
    np.testing.assert_allclose(np.abs(wrong.rolling[:, 2]), abs(half_length - half_width), rtol=0, atol=1e-15 * 8)


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds, omega=st.sampled_from([0.7, -2.0, 1e-6]))
@settings(deadline=None, max_examples=20)
def test_centre_of_rotation_stands_still(shape, seed, omega):
    """The centre has no velocity, and it stays where it is in the world while the body moves."""
    rng = np.random.default_rng(seed)
    twist = Twist(*rng.normal(size=(2, *shape)), omega)
    icr = Icr(twist)
    px, py = icr.body[..., 0], icr.body[..., 1]
    scale = 1.0 + np.hypot(px, py)
    np.testing.assert_allclose((twist.vx - omega * py) / scale, 0.0, rtol=0, atol=10 * EPS)
    np.testing.assert_allclose((twist.vy + omega * px) / scale, 0.0, rtol=0, atol=10 * EPS)
    pose = Pose(*rng.normal(size=(3, *shape)))
    later = pose.step(twist.during(0.8))
    before, after = icr.in_world(pose), icr.in_world(later)
    np.testing.assert_allclose((after - before) / scale[..., None], 0.0, rtol=0, atol=50 * EPS)
    np.testing.assert_allclose((pose @ icr.body - before) / scale[..., None], 0.0, rtol=0, atol=50 * EPS)


@given(half_track=lengths, v=speeds, omega=speeds, pose=st.tuples(speeds, speeds, speeds))
@settings(deadline=None, max_examples=40)
def test_wheel_speeds_about_the_centre(half_track, v, omega, pose):
    """R = v/omega = b (vr + vl)/(vr - vl), vl = (R - b) omega, vr = (R + b) omega, ICR = (x - R sin, y + R cos)."""
    assume(abs(omega) > 1e-3)
    base = WheeledBase.differential(half_track=half_track, radius=0.1)
    icr = Icr(Twist(v, 0.0, omega))
    left, right = wheel_centre_speeds(icr.radius, omega, half_track=half_track)
    centres = base.wheel_velocities(icr.twist)
    np.testing.assert_allclose(centres, [[left, 0.0], [right, 0.0]], rtol=0, atol=1e-13)
    assert icr.radius == v / omega
    # The difference of the wheel speeds carries the rounding of the speeds themselves.
    slack = 8 * EPS * (abs(v) / (half_track * abs(omega)) + 1) * (abs(icr.radius) + half_track)
    assert turning_radius(left, right, half_track=half_track) == pytest.approx(icr.radius, abs=slack)
    x, y, theta = pose
    np.testing.assert_allclose(
        icr.in_world(Pose(*pose)), [x - icr.radius * np.sin(theta), y + icr.radius * np.cos(theta)],
        rtol=0, atol=20 * EPS * (10 + abs(icr.radius)),
    )  # fmt: skip


@given(seed=seeds)
@settings(deadline=None, max_examples=20)
def test_bracket_is_the_commutator(seed):
    """[xi1, xi2] of twists is xi1^ xi2^ - xi2^ xi1^ of their matrices [[0, -omega, vx], [omega, 0, vy], [0, 0, 0]]."""
    one, other = np.random.default_rng(seed).normal(size=(2, 3))
    hats = [np.array([[0.0, -omega, vx], [omega, 0.0, vy], [0.0, 0.0, 0.0]]) for vx, vy, omega in (one, other)]
    bracket = evaluator(laws.twist_bracket)(*one, *other)
    commutator = hats[0] @ hats[1] - hats[1] @ hats[0]
    np.testing.assert_allclose(bracket, [commutator[0, 2], commutator[1, 2], commutator[1, 0]], rtol=0, atol=100 * EPS)


@given(seed=seeds, heading=speeds)
@settings(deadline=None, max_examples=30)
def test_constraints(seed, heading):
    """A(q) qdot is the sideways velocity of ordinary wheels: zero exactly on the twists that slide none."""
    rng = np.random.default_rng(seed)
    base = WheeledBase(layouts(rng))
    matrix = base.constraints(heading)
    assert matrix.shape == (base.mobility.constraint_rank, 3)
    for free in base.mobility.free:
        np.testing.assert_allclose(matrix @ Twist.from_array(free).in_world(heading), 0.0, rtol=0, atol=1e-10)
    if len(matrix):
        assert np.abs(matrix @ twists(rng, ()).in_world(heading)).max() > 1e-9


@pytest.mark.parametrize("policy", ["scale", "clip", "keep_omega"])
@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds)
@settings(deadline=None, max_examples=20)
def test_saturation(policy, shape, seed):
    """Rates end inside their limits; unlimited rows are untouched; each policy keeps what it says."""
    rng = np.random.default_rng(seed)
    base = WheeledBase.mecanum(radius=0.1, half_length=0.3, half_width=0.2)
    limits = rng.uniform(5, 20, size=4)
    wanted = Twist(*rng.normal(size=(3, *shape)) * 1.5)
    rates = base.inverse(wanted)
    done = base.saturate(rates, limits, policy=policy)
    assert np.all(np.abs(done.rates) <= limits)
    inside = np.all(np.abs(rates) <= limits, axis=-1)
    np.testing.assert_array_equal(np.asarray(done.is_limited), ~inside)
    np.testing.assert_array_equal(done.rates[inside], rates[inside])
    share, turn_share = np.asarray(done.share), np.asarray(done.turn_share)
    if policy == "clip":
        np.testing.assert_array_equal(done.rates, np.clip(rates, -limits, limits))
        return
    scale = np.stack(np.broadcast_arrays(share, share, turn_share), -1)
    np.testing.assert_allclose(done.twist.as_array(), scale * done.wanted.as_array(), rtol=0, atol=1e-12)
    turns_fully = np.all(np.abs(base.inverse(Twist(0.0, 0.0, done.wanted.omega))) <= limits, axis=-1)
    full = np.any(np.abs(done.rates) >= limits * (1 - 1e-12), axis=-1)
    if policy == "scale":
        np.testing.assert_array_equal(share, turn_share)
        assert np.all(full | inside)  # nothing is given up without need
    else:
        np.testing.assert_array_equal(turn_share == 1.0, turns_fully | inside)
        assert np.all(full | inside | ~turns_fully)


@given(seed=seeds)
@settings(deadline=None, max_examples=20)
def test_increments_and_accelerations(seed):
    """One matrix serves rates, increments and accelerations."""
    rng = np.random.default_rng(seed)
    base = well_conditioned(rng)
    values = rng.normal(size=(2, len(base.wheels)))
    twist = base.forward(values).as_array()
    np.testing.assert_array_equal(base.displacement(values).as_array(), twist)
    np.testing.assert_array_equal(base.twist_rates(values), twist)
    np.testing.assert_array_equal(base.rotations(base.displacement(values)), base.wheel_accelerations(twist))
    np.testing.assert_allclose(
        base.forward(values * 0.5).during(2.0).as_array(), base.displacement(values).as_array(), rtol=0, atol=1e-10
    )
