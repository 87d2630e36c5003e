"""What holds of every flight: energy, scaling, symmetry, the equations of motion, limits."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar.engine import evaluator
from coplanar.flight import Projectile
from coplanar.flight.path import Path, at_time
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


def test_the_derivatives_of_the_launch_are_those_of_automatic_differentiation():
    jax = pytest.importorskip("jax")
    launch = (30.0, np.cos(0.8), np.sin(0.8), 0.1, 9.81)
    with jax.enable_x64(True):
        travel, theta_of_turn = evaluator(laws.travel), evaluator(laws.theta_of_turn)
        state = at_time(Path(*launch), 2.0)
        turn = evaluator(laws.turn)(float(state.theta), launch[0], *launch[3:])

        def flown(v, psi):
            theta = theta_of_turn(turn, v, *launch[3:])  # a constant turn, not a constant theta
            cosine, sine = jax.numpy.cos(psi), jax.numpy.sin(psi)
            return jax.numpy.stack(travel(0.0, theta, v, cosine, sine, *launch[3:]))

        by_v, by_psi = jax.jacfwd(flown, argnums=(0, 1))(jax.numpy.asarray(30.0), jax.numpy.asarray(0.8))
    ours = evaluator(laws.derivatives)(float(state.theta), *launch)
    assert np.allclose([*by_v, *by_psi], ours, rtol=1e-11)


coast, drag_rates = evaluator(laws.coast), evaluator(laws.drag_rates)


@quick
@given(st.floats(-30.0, 30.0), st.floats(-30.0, 30.0), GRAVITIES, TIMES)
def test_coasting_without_drag_is_the_parabola(vx, vy, g, t):
    parabola = (vx * t, vy * t - 0.5 * g * t * t, vx, vy - g * t)
    assert np.allclose(coast(t, vx, vy, 0.0, g), parabola, rtol=1e-14, atol=1e-12)


@quick
@given(st.floats(-3.0, 0.3), st.floats(1.0, 25.0), TIMES)
def test_coasting_at_terminal_speed_goes_on(log_k, g, t):
    k = 10.0**log_k
    end = np.sqrt(g / k)
    assert np.allclose(coast(t, 0.0, -end, k, g), (0.0, -end * t, 0.0, -end), rtol=1e-12, atol=1e-12)


@quick
@given(st.floats(-30.0, 30.0), st.floats(-30.0, 30.0), st.floats(-3.0, 0.0), GRAVITIES)
def test_coasting_starts_with_the_accelerations_of_the_flight(vx, vy, log_k, g):
    k, h = 10.0**log_k, 1e-6
    _, _, u, w = coast(h, vx, vy, k, g)
    scale = k * (vx * vx + vy * vy) + g + 1.0
    assert np.allclose(((u - vx) / h, (w - vy) / h), drag_rates(vx, vy, k, g), rtol=0.0, atol=1e-3 * scale)


@quick
@given(SPEEDS, ANGLES, DRAGS, TIMES)
def test_a_path_turns_more_with_drag_than_without(v, psi, k, t):
    path = Path(v, np.cos(psi), np.sin(psi), k, 9.81)
    turn = evaluator(laws.turn)(float(at_time(path, t).theta), v, k, 9.81)
    assert turn >= evaluator(laws.ballistic_turn)(t, v, np.cos(psi), np.sin(psi), 9.81) * (1 - 1e-11)
