"""The searches of flights over launches and targets of every kind: evaluators agree, answers come true."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar.flight import Projectile
from coplanar.laws.aiming import arc, farthest
from coplanar.laws.landing import landing
from tests.engines import NEEDS_NUMBA

ROWS = 300


def launches(seed=0, rows=ROWS):
    """Speeds to 10 km/s, every angle, drag from none to 10 per metre, gravity from a tenth to a hundred."""
    rng = np.random.default_rng(seed)
    v, psi = 10.0 ** rng.uniform(-1.0, 4.0, rows), rng.uniform(-1.57, 1.57, rows)
    k = 10.0 ** rng.uniform(-9.0, 1.0, rows) * (rng.random(rows) > 0.1)
    return v, psi, k, 10.0 ** rng.uniform(-1.0, 2.0, rows)


def drops(seed=0):
    """Inputs of landings: such launches above lines of every slope below them."""
    rng = np.random.default_rng(seed)
    v, psi, k, g = launches(seed)
    slope = psi - rng.random(ROWS) * (psi + 1.5)
    height = 10.0 ** rng.uniform(-9.0, 4.0, ROWS) * (rng.random(ROWS) > 0.3)
    zero = np.zeros(ROWS)
    return [zero, height, v * np.cos(psi), v * np.sin(psi), k, g, zero, zero, np.cos(slope), np.sin(slope)]


def sights(seed=0):
    """Speed, line of sight, drag and gravity."""
    v, slope, k, g = launches(seed)
    return [np.minimum(v, 1e3), np.cos(slope), np.sin(slope), np.minimum(k, 1e-2), g]


def both(search, inputs, **words):
    text, compiled = (getattr(search, f"on_{name}")(inputs, (ROWS,), **words) for name in ("text", "compiled"))
    return text, compiled


@NEEDS_NUMBA
def test_landings_agree_over_the_evaluators():
    inputs = drops()
    text, compiled = both(landing, inputs)
    scale = [1.0, 1.0, *[np.hypot(text[2], text[3]) + inputs[1]] * 2, *[np.hypot(inputs[2], inputs[3])] * 2, 1.0]
    for one, other, size in zip(text, compiled, scale, strict=True):
        assert np.all(np.abs(one - other) <= 1e-7 * size * (1.0 + np.abs(one)))  # slopes may be nearly along the path
    level = [*inputs[:8], np.ones(ROWS), np.zeros(ROWS)]
    text, compiled = both(landing, level)
    for one, other, size in zip(text, compiled, scale, strict=True):
        assert np.all(np.abs(one - other) <= 1e-9 * size * (1.0 + np.abs(one)))


@NEEDS_NUMBA
def test_the_farthest_launches_agree_over_the_evaluators():
    text, compiled = both(farthest, sights())
    found = (text[4] > 0.0) & (compiled[4] > 0.0)
    assert found.mean() > 0.9
    assert np.allclose(text[1][found], compiled[1][found], rtol=1e-11)


@NEEDS_NUMBA
def test_the_arcs_agree_over_the_evaluators():
    inputs = sights()
    best, most, theta, _, found = farthest.on_text(inputs, (ROWS,))
    for side in (1.0, -1.0):
        given = [*inputs, 0.7 * most, best, most, theta, np.full(ROWS, side)]
        text, compiled = both(arc, given)
        good = (found > 0.0) & (text[2] > 0.0) & (compiled[2] > 0.0)
        assert good.mean() > 0.9
        assert np.allclose(text[0][good], compiled[0][good], rtol=1e-9)
        assert np.allclose(text[1][good], compiled[1][good], rtol=1e-9)


def test_every_landing_is_on_its_level_and_where_the_flight_is_then():
    v, psi, k, g = launches(1)
    shot = Projectile.from_drag_per_mass(k, gravity=g).launch(speed=v, angle=psi, start=(0.0, 5.0))
    impact = shot.impact()
    assert impact.reached.all()
    now = shot.at(impact.time)
    size = 5.0 + v * v / g * np.abs(np.sin(psi)) + np.abs(impact.state.x)
    assert np.all(np.abs(impact.height()) < 1e-11 * size)
    assert np.all(np.hypot(*(now.position - impact.position).T) < 1e-10 * (size + v * impact.time))


@pytest.mark.parametrize("height", [1e-12, 1e-9, 1e-6])
def test_a_very_short_fall_keeps_its_digits(height):
    """To first order in the drag, T = T0 (1 + k v T0/6)."""
    impact = Projectile.from_drag_per_mass(0.02).launch(velocity=(30.0, 0.0), start=(0.0, height)).impact()
    free = np.sqrt(2.0 * height / 9.81)
    assert np.isclose(impact.time, free * (1.0 + 0.1 * free), rtol=(0.6 * free) ** 2 + 1e-12)


@pytest.mark.parametrize("distance", [1e-10, 1e-6, 1e-3])
def test_a_very_near_target_is_hit_as_without_drag_by_the_low_arc(distance):
    """The time and the rise above the line of sight keep their digits, not only the angle."""
    aim = Projectile.from_drag_per_mass(0.02).aim((distance, 0.0), speed=30.0)
    assert np.isclose(aim.low.time, distance / 30.0, rtol=0.1 * distance + 1e-12)
    assert np.isclose(aim.low.angle, 0.5 * 9.81 * distance / 900.0, rtol=0.1 * distance + 1e-6)
    assert aim.miss() < 1e-11


def test_targets_of_every_kind_are_hit_or_out_of_reach():
    v, slope, k, g = launches(2)
    v = np.minimum(v, 1e3)
    ball = Projectile.from_drag_per_mass(k, gravity=g)
    rng = np.random.default_rng(3)
    part = np.where(rng.random(ROWS) < 0.2, 1.0 + 10.0 ** rng.uniform(-9.0, 0.0, ROWS), 1.0 - rng.random(ROWS) ** 6)
    distance = part * ball.furthest(v, slope=slope).distance
    aim = ball.aim(distance[:, None] * np.stack([np.cos(slope), np.sin(slope)], -1), speed=v)
    clear = np.abs(part - 1.0) > 1e-10
    assert np.array_equal(aim.hit[clear], part[clear] < 1.0)
    assert np.all(aim.miss()[aim.hit] < 1e-11 * (distance + v * aim.high.time)[aim.hit])
    far = ~aim.hit
    assert np.allclose(aim.shortfall[far], (distance - aim.furthest)[far], rtol=1e-9, atol=1e-11 * distance[far].max())
