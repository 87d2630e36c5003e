"""What holds of every aim: it comes true, or says why not; no launch does better than the least and the farthest."""

from __future__ import annotations

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st

from coplanar.flight import AimStatus, Projectile

quick = settings(deadline=None, max_examples=40)


def ball(k, g=9.81):
    return Projectile.from_drag_per_mass(k, gravity=g)


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
