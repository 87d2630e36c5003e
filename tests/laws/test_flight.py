"""What holds of every flight: energy, scaling, symmetry, the equations of motion, limits, and aims that come true."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from coplanar.engine import evaluator
from coplanar.flight import AimStatus, Projectile
from coplanar.flight.path import Path, at_time, by_launch
from coplanar.laws import flight as laws
from tests.engines import BATCH_SHAPES

SPEEDS = st.floats(1.0, 80.0)
ANGLES = st.floats(-1.5, 1.5)
STEEP = st.sampled_from(
    [np.pi / 2, np.pi / 2 - 1e-3, np.pi / 2 - 1e-6, np.pi / 2 - 1e-9, np.pi / 2 - 1e-13, -np.pi / 2]
)
DRAGS = st.one_of(st.just(0.0), st.floats(-12.0, 0.3).map(lambda e: 10.0**e))
GRAVITIES = st.one_of(st.just(0.0), st.floats(0.5, 25.0))
TIMES = st.floats(0.0, 6.0)
quick = settings(deadline=None, max_examples=40)


def ball(k, g=9.81, mass=1.0):
    return Projectile.from_drag_per_mass(k, mass=mass, gravity=g)


@quick
@given(SPEEDS, st.one_of(ANGLES, STEEP), DRAGS, GRAVITIES, TIMES)
def test_the_velocity_and_its_rate_obey_the_equations_of_motion(v, psi, k, g, t):
    """A central difference of the position is the velocity, one of the velocity is the drag law."""
    shot, h = ball(k, g).launch(speed=v, angle=psi), 1e-4
    now, ends = shot.at(t + h), (shot.at(t), shot.at(t + 2 * h))
    third = k * (v + g * t) * (k * v * v + g) * 40.0 + 1.0  # a bound on the third derivative's scale
    for name, rate in zip(
        ("x", "y", "vx", "vy"), (now.vx, now.vy, *laws.drag_rates(now.vx, now.vy, k, g)), strict=True
    ):
        slope = (getattr(ends[1], name) - getattr(ends[0], name)) / (2 * h)
        size = 1.0 + abs(getattr(now, name))
        assert abs(slope - rate) < 1e-10 * size / h + (third * (1.0 + k * v) + k * k * v**3) * h * h * 10.0


@quick
@given(SPEEDS, st.one_of(ANGLES, STEEP), DRAGS, GRAVITIES)
def test_drag_takes_energy_and_never_gives_it(v, psi, k, g):
    shot = ball(k, g).launch(speed=v, angle=psi)
    lost = shot.energy(np.linspace(0.0, 5.0, 21)).lost
    assert np.all(np.diff(lost) >= -1e-12 * (v * v + g * v * 5.0 + 25 * g * g))
    if k > 1e-3:
        assert np.all(np.diff(lost) > 0.0)


@quick
@given(SPEEDS, ANGLES, DRAGS, TIMES)
def test_the_state_continued_from_the_middle_is_the_state_at_the_end(v, psi, k, t):
    projectile = ball(k)
    shot = projectile.launch(speed=v, angle=psi)
    half = shot.at(0.5 * t)
    whole, rest = shot.at(t), projectile.launch(velocity=half.velocity, start=half.position).at(0.5 * t)
    assert np.allclose(rest[1:], whole[1:], rtol=1e-12, atol=1e-12 * (1.0 + v * t + 5 * t * t))


@quick
@given(SPEEDS, ANGLES, st.floats(-6.0, 0.3), TIMES, st.floats(0.1, 10.0))
def test_only_drag_per_mass_and_gravity_matter(v, psi, log_k, t, mass):
    """The mass cancels; and lengths by L, speeds by sqrt(g L) turn every flight into one of another scale."""
    k = 10.0**log_k
    one, heavy = (ball(k, mass=m).launch(speed=v, angle=psi).at(t) for m in (1.0, mass))
    assert np.allclose(one, heavy, rtol=1e-12, atol=1e-12)
    scaled = ball(k / 4.0).launch(speed=2.0 * v, angle=psi).at(2.0 * t)
    assert np.allclose(scaled.position, 4.0 * one.position, rtol=1e-12, atol=1e-12 * v)
    assert np.allclose(scaled.velocity, 2.0 * one.velocity, rtol=1e-12, atol=1e-12 * v)


@quick
@given(SPEEDS, ANGLES, DRAGS, GRAVITIES, TIMES)
def test_a_launch_to_the_left_is_the_mirror_image(v, psi, k, g, t):
    right, left = (ball(k, g).launch(velocity=(s * v * np.cos(psi), v * np.sin(psi))) for s in (1.0, -1.0))
    assert np.array_equal(right.at(t).position * (-1.0, 1.0), left.at(t).position)
    assert np.array_equal(right.sensitivity(t).by_speed * (-1.0, 1.0), left.sensitivity(t).by_speed)
    assert np.array_equal(right.sensitivity(t).by_angle * (1.0, -1.0), left.sensitivity(t).by_angle)


@quick
@given(SPEEDS, ANGLES, GRAVITIES, TIMES, st.floats(-18.0, -9.0))
def test_faint_drag_is_the_parabola_plus_a_small_correction(v, psi, g, t, log_k):
    free, faint = (ball(k, g).launch(speed=v, angle=psi).at(t) for k in (0.0, 10.0**log_k))
    parabola = v * t * np.cos(psi), v * t * np.sin(psi) - 0.5 * g * t * t
    size = 1.0 + v * t + g * t * t
    assert np.allclose(free.position, parabola, rtol=0.0, atol=4e-15 * size)
    assert np.allclose(faint.position, parabola, rtol=0.0, atol=4e-15 * size + 10.0**log_k * size * size)


@quick
@given(SPEEDS, ANGLES, st.floats(-9.0, 0.3), TIMES, st.floats(-18.0, -9.0))
def test_faint_gravity_is_the_logarithmic_straight_line_plus_a_small_correction(v, psi, log_k, t, log_g):
    k = 10.0**log_k
    none, faint = (ball(k, g).launch(speed=v, angle=psi).at(t) for g in (0.0, 10.0**log_g))
    way = np.log1p(k * v * t) / k
    line = way * np.array([np.cos(psi), np.sin(psi)])
    assert np.allclose(none.position, line, rtol=0.0, atol=1e-14 * (1.0 + way))
    assert np.allclose(faint.position, line, rtol=0.0, atol=1e-14 * (1.0 + way) + 10.0**log_g * t * t)


@quick
@given(SPEEDS, st.floats(-4.0, 0.3), TIMES, st.floats(-16.0, -2.0), st.sampled_from([1.0, -1.0]))
def test_the_vertical_flight_is_the_limit_of_steep_ones(v, log_k, t, log_lean, up):
    """Time and height differ by the square of the lean, the way aside is linear in it."""
    k, lean = 10.0**log_k, 10.0**log_lean
    straight = ball(k).launch(velocity=(0.0, up * v)).at(t)
    leaning = ball(k).launch(velocity=(lean * v, up * v)).at(t)
    size = 1.0 + v * t + 5 * t * t
    assert straight.x == 0.0
    assert abs(leaning.y - straight.y) < 1e-13 * size + 10.0 * lean * lean * size
    tiny = ball(k).launch(velocity=(1e-30 * v, up * v)).at(t)
    assert abs(leaning.x / lean - tiny.x / 1e-30) < (1e-12 + 10.0 * (lean * (1.0 + k * v)) ** 2) * size


@quick
@given(SPEEDS, st.floats(-1.3, 1.3), DRAGS, GRAVITIES, st.floats(0.1, 4.0))
def test_sensitivities_are_the_differences_of_the_exact_flight(v, psi, k, g, t):
    shot, h = ball(k, g).launch(speed=v, angle=psi), 1e-5
    ways = {
        "by_speed": [ball(k, g).launch(speed=v + s * h * v, angle=psi).at(t).position for s in (1, -1)],
        "by_angle": [ball(k, g).launch(speed=v, angle=psi + s * h).at(t).position for s in (1, -1)],
    }
    for name, (plus, minus) in ways.items():
        step = 2 * h * (v if name == "by_speed" else 1.0)
        exact = getattr(shot.sensitivity(t), name)
        assert np.allclose(exact, (plus - minus) / step, rtol=1e-6, atol=1e-6 * (1.0 + v * t + g * t * t))


@pytest.mark.parametrize("shape", BATCH_SHAPES)
def test_a_batch_is_its_rows(shape):
    rng = np.random.default_rng(3)
    v, psi, k, t = (rng.uniform(*ends, shape) for ends in ((5, 60), (-1.2, 1.5), (0, 0.5), (0, 5)))
    shot = ball(k).launch(speed=v, angle=psi)
    state, landing, apex = shot.at(t), shot.impact(level=-3.0), shot.apex()
    target = np.stack([rng.uniform(-9, 9, shape), rng.uniform(-9, 9, shape)], -1)
    aims = {
        kind: ball(k).aim(target, **kind_of) for kind, kind_of in (("speed", {"speed": v}), ("time", {"time": 1.0}))
    }
    assert state.position.shape == (*shape, 2)
    for i in np.ndindex(shape):
        row = ball(float(k[i]) if shape else k).launch(speed=v[i] if shape else v, angle=psi[i] if shape else psi)
        now, pick = row.at(float(t[i])), lambda a, i=i: np.asarray(a)[i]
        assert np.allclose([pick(c) for c in state], now, rtol=1e-12, atol=1e-12)
        assert np.isclose(pick(landing.time), row.impact(level=-3.0).time, rtol=1e-11)
        assert np.isclose(pick(apex.y), row.apex().y, rtol=1e-12, atol=1e-13)
        for kind, aim in aims.items():
            alone = ball(k[i]).aim(target[i], **{kind: v[i] if kind == "speed" else 1.0})
            assert pick(aim.status) is alone.status
            assert np.isclose(pick(aim.low.angle), alone.low.angle, rtol=1e-9)
            assert np.isclose(pick(aim.high.time), alone.high.time, rtol=1e-9)


TARGETS = st.tuples(st.floats(-60.0, 60.0), st.floats(-40.0, 40.0)).filter(lambda p: np.hypot(*p) > 1e-3)
AIM_DRAGS = st.one_of(st.just(0.0), st.floats(-8.0, -0.5).map(lambda e: 10.0**e))


def near(target, aim):
    return 1e-11 * (np.hypot(*target) + aim.high.speed * aim.high.time)


@quick
@given(TARGETS, AIM_DRAGS, st.floats(-1.5, 1.5).map(lambda e: 10.0**e))
@example((5.0, 10.0), 0.025, 2.0)
@example((0.0, -0.5 * 9.81), 0.0, 1.0)  # it is enough to let go
def test_an_aim_by_time_is_at_the_target_in_time(target, k, time):
    aim = ball(k).aim(target, time=time)
    if aim.status is AimStatus.TOO_FAST:
        assert k * np.hypot(*target) + time * np.sqrt(9.81 * k) > 50.0
        return
    assert aim.hit
    assert aim.miss() < near(target, aim)
    assert aim.low.time == time


@quick
@given(TARGETS, AIM_DRAGS, st.floats(1.0, 80.0))
def test_an_aim_by_speed_hits_with_both_arcs_or_says_how_short_it_falls(target, k, speed):
    aim = ball(k).aim(target, speed=speed)
    if aim.hit:
        assert aim.miss() < near(target, aim)
        for arc in (aim.low, aim.high):
            assert np.isclose(arc.speed, speed, rtol=1e-12)
        assert aim.low.time <= aim.high.time * (1 + 1e-7)
        assert aim.least_speed <= speed * (1 + 1e-9)
    else:
        assert aim.status is AimStatus.OUT_OF_REACH
        assert np.isclose(aim.miss(), aim.shortfall, rtol=1e-8)
        assert np.isclose(aim.furthest + aim.shortfall, np.hypot(*target), rtol=1e-12)
        assert aim.least_speed > speed * (1 - 1e-9)


@quick
@given(TARGETS, AIM_DRAGS, st.floats(-1.4, 1.5))
def test_an_aim_by_angle_hits_or_the_target_is_not_below_the_line(target, k, psi):
    if target[0] < 0.0:
        psi = np.pi - psi
    aim = ball(k).aim(target, angle=psi)
    above = np.hypot(*target) * np.sin(psi - np.arctan2(target[1], target[0])) * (1 if target[0] >= 0.0 else -1)
    if aim.hit:
        assert above > 0.0
        assert aim.miss() < near(target, aim)
        assert abs(np.angle(np.exp(1j * (aim.low.angle - psi)))) < 1e-12
    else:
        assert aim.status in (AimStatus.OFF_THE_LINE, AimStatus.TOO_FAST, AimStatus.ANY_SPEED)
        assert above < 1e-9 or abs(target[0]) < 1e-6 or k * np.hypot(*target) > 1.0
        assert aim.miss() == np.inf


@quick
@given(TARGETS.filter(lambda p: abs(p[0]) > 1e-2), AIM_DRAGS, st.floats(-0.3, 0.3))
def test_no_other_angle_reaches_the_target_with_less_than_the_least_speed(target, k, turn):
    projectile = ball(k)
    least = projectile.aim(target)
    assert least.hit
    assert least.miss() < near(target, least)
    other = projectile.aim(target, angle=least.low.angle + turn)
    if other.hit:
        assert other.low.speed >= least.low.speed * (1 - 1e-12)


@quick
@given(st.floats(-1.2, 1.4), AIM_DRAGS, st.floats(2.0, 60.0), st.floats(-15.0, -1.0))
def test_near_the_envelope_both_arcs_merge_like_the_root_of_what_is_missing(slope, k, speed, log_short):
    projectile, short = ball(k), 10.0**log_short
    reach = projectile.furthest(speed, slope=slope)
    inside = projectile.aim(reach.point * (1.0 - short), speed=speed)
    assert inside.hit or short < 1e-13
    spread = np.ptp(inside.angles)
    assert spread < 6.0 * np.sqrt(short) + 1e-6
    assert spread > 0.1 * np.sqrt(short) - 1e-6
    outside = projectile.aim(reach.point * (1.0 + 1e-9 + short), speed=speed)
    assert outside.status is AimStatus.OUT_OF_REACH
    assert np.isclose(outside.shortfall, (1e-9 + short) * reach.distance, rtol=1e-4)


@quick
@given(st.floats(2.0, 60.0), st.floats(-1.4, 1.55), st.floats(1.0, 20.0))
def test_without_drag_the_envelope_is_the_parabola_of_safety(speed, slope, g):
    x, y = ball(0.0, g).envelope(speed, slope)
    assert np.isclose(y, speed**2 / (2 * g) - g * x**2 / (2 * speed**2), rtol=1e-9, atol=1e-9 * (abs(x) + speed**2 / g))


@quick
@given(st.floats(5.0, 60.0), st.floats(0.1, 1.4), AIM_DRAGS)
def test_the_range_of_a_launch_never_passes_the_furthest(speed, psi, k):
    shot = ball(k).launch(speed=speed, angle=psi)
    assert shot.impact().state.x <= ball(k).furthest(speed).distance * (1 + 1e-12)


def test_the_derivatives_of_the_launch_are_those_of_automatic_differentiation():
    jax = pytest.importorskip("jax")
    launch = (30.0, np.cos(0.8), np.sin(0.8), 0.1, 9.81)
    with jax.enable_x64(True):
        at = evaluator(laws.travel)

        def flown(v, psi):  # at a constant q, not at a constant theta: theta depends on the speed
            state = at_time(Path(*launch), 2.0)
            q = (laws.turn(state.theta, *(launch[0], *launch[3:])) - 1.0) / launch[4]
            theta = jax.numpy.log1p(q * laws_pace(v))
            return jax.numpy.stack(at(0.0 * v, theta, v, jax.numpy.cos(psi), jax.numpy.sin(psi), *launch[3:]))

        def laws_pace(v):
            return evaluator(laws.pace)(v, *launch[3:])

        by_v, by_psi = (jax.jacfwd(flown, argnums=i)(jax.numpy.asarray(30.0), jax.numpy.asarray(0.8)) for i in (0, 1))
    state = at_time(Path(*launch), 2.0)
    ours = evaluator(laws.derivatives)(float(state.theta), *launch)
    assert np.allclose([*by_v, *by_psi], ours, rtol=1e-11)
    assert len(by_launch(Path(*launch), state)) == 4
