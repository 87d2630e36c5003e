"""Flights and aims against differential equations; ``tools/truth_flight.py`` is the generator."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar.flight import Projectile
from tests.truth.golden import golden

TRUTH = golden("flight")
TOLERANCE = TRUTH.tolerance
named = {"ids": lambda case: " ".join(map(str, case["given"] if "given" in case else [case["k"]]))}


def shot_of(v, degrees, k, g):
    return Projectile.from_drag_per_mass(k, gravity=g).launch(speed=v, angle=np.radians(degrees))


@pytest.mark.parametrize("case", TRUTH.of("state"), **named)
def test_states_of_taylor_series(case):
    *launch, time = case["given"]
    state = shot_of(*launch).at(float(time))
    scale = 1.0 + np.abs(case["state"])
    assert np.all(np.abs(np.subtract(state[1:], case["state"])) < TOLERANCE["state"] * scale)


@pytest.mark.parametrize("case", TRUTH.of("state"), **named)
def test_the_integrator_agrees_as_far_as_its_own_tolerance_goes(case):
    *launch, time = case["given"]
    state = shot_of(*launch).at(float(time), method="ode")
    assert np.allclose(state[1:], case["state"], rtol=1e-10, atol=1e-10)


def test_states_as_one_batch():
    v, degrees, k, g, time = TRUTH.column("given", "state").T
    states = shot_of(v, degrees, k, g).at(time)
    truth = TRUTH.column("state", "state").T
    assert np.all(np.abs(np.subtract(states[1:], truth)) < TOLERANCE["state"] * (1.0 + np.abs(truth)))


@pytest.mark.parametrize("case", TRUTH.of("impact"), **named)
def test_impacts_are_the_descending_crossings(case):
    *launch, level = case["given"]
    impact = shot_of(*launch).impact(level).or_raise()
    assert np.isclose(impact.time, case["time"], rtol=TOLERANCE["state"])
    assert np.allclose(impact.position, (case["x"], level), rtol=TOLERANCE["state"], atol=1e-12)
    assert impact.velocity[1] < 0.0


@pytest.mark.parametrize("case", TRUTH.of("upright"), **named)
@pytest.mark.parametrize("lean", [0.0, 1e-9, 1e-14])
def test_straight_up_and_down_are_tan_tanh_and_coth(case, lean):
    v, k, g, time = case["given"]
    state = Projectile.from_drag_per_mass(k, gravity=g).launch(velocity=(lean * abs(v), v)).at(time)
    assert np.allclose((state.y, state.vy), (case["y"], case["vy"]), rtol=TOLERANCE["state"], atol=1e-13)


@pytest.mark.parametrize("case", TRUTH.of("best"), **named)
def test_the_best_angle_falls_below_45_degrees_as_drag_grows(case):
    best = Projectile.from_drag_per_mass(case["k"]).furthest(30.0)
    assert abs(np.degrees(best.angle) - case["degrees"]) < TOLERANCE["best_degrees"]
    assert np.isclose(best.distance, case["range"], rtol=TOLERANCE["best_range"])


def test_the_best_angles_to_a_tenth_of_a_degree():
    best = Projectile.from_drag_per_mass(TRUTH.column("k", "best")).furthest(30.0)
    assert np.degrees(best.angle).round(1).tolist() == [45.0, 42.8, 39.1, 33.0, 27.4]


@pytest.mark.parametrize("case", TRUTH.of("angles"), **named)
def test_both_angles_of_a_speed(case):
    x, y, v, k = case["given"]
    aim = Projectile.from_drag_per_mass(k).aim((x, y), speed=v).or_raise()
    assert np.allclose(aim.angles, (case["low"], case["high"]), atol=TOLERANCE["angle"])


def test_the_demonstration_of_aiming_by_time():
    (case,) = TRUTH.of("time")
    *target, time = case["given"]
    aim = Projectile(mass=2.0, drag=0.05).aim(target, time=time).or_raise()
    assert np.allclose(aim.low.velocity, case["velocity"], atol=TOLERANCE["velocity"])


def test_the_demonstration_of_flying():
    """C = 0.5, m = 1, launch velocity (100, 100 tan 60 deg): heavy drag."""
    shot = Projectile(mass=1.0, drag=0.5).launch(velocity=(100.0, 100.0 * np.tan(np.radians(60.0))))
    times = [case["given"][4] for case in TRUTH.of("state") if case["given"][0] == 200]
    truth = [case["state"] for case in TRUTH.of("state") if case["given"][0] == 200]
    assert np.allclose(shot.at(times)[1:], np.transpose(truth), rtol=1e-12, atol=1e-13)


def test_a_grid_of_launches_against_the_integrator():
    """Speeds 10 to 60 m/s, k to 0.02, 5 to 80 degrees, half a second to six."""
    v, k, degrees, t = np.meshgrid(
        [10.0, 30.0, 60.0], [0.0, 1e-4, 0.005, 0.02], [5.0, 30.0, 60.0, 80.0], [0.5, 2.0, 6.0]
    )
    shot = shot_of(v, degrees, k, 9.81)
    exact, ode = shot.at(t), shot.at(t, method="ode")
    assert np.abs(np.subtract(exact[1:], ode[1:])).max() < 1e-10
