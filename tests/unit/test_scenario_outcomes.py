"""What running a scenario gives: the numbers of the library, an honest no, and what can be said before."""

from __future__ import annotations

import json
import subprocess
import sys
from math import pi

import numpy as np
import pytest

from coplanar.arms import Arm
from coplanar.control import PointTracker, Unicycle
from coplanar.curves import Astroid
from coplanar.flight import Projectile
from coplanar.scenarios import KINDS, InvalidScenario, Outcome, from_data, load, names, truths
from coplanar.simulation import simulate
from coplanar.wheels import WheeledBase


@pytest.fixture(scope="module")
def outcomes():
    return {name: load(name).run() for name in names()}


def test_every_demonstration_holds(outcomes):
    for name, outcome in outcomes.items():
        assert isinstance(outcome, Outcome)
        assert (outcome.name, outcome.ok, outcome.passed) == (name, True, True)
        assert next(iter(outcome.tables)) == "run.csv"
        assert all(outcome.title and text for text in (outcome.story, outcome.headline, outcome.status, outcome.check))
        assert set(outcome.summary) == set(load(name).measure())
        json.dumps(outcome.summary, allow_nan=False)


def test_every_kind_has_a_demonstration():
    assert {load(name).type for name in names()} == set(KINDS)


def test_tracking_is_the_library_run(outcomes):
    tracker = PointTracker((0.05, 0.0), kp=100.0, kd=0.5, error_against="next")
    reference = Astroid(1.0).over(10.0)
    start = tracker.pose_for(reference.position(0.0), pi / 2)
    run = simulate(Unicycle(), tracker, reference, step=0.01, method="euler", start=start)
    for name, column in run.columns.items():
        assert np.array_equal(outcomes["track-astroid"].run[name], column)
    assert outcomes["track-astroid"].summary["largest_error"] == run.summary()["largest_error"]
    assert outcomes["track-astroid"].warnings == run.warnings


def test_the_square_misses_by_a_step_in_x_and_y(outcomes):
    """Eleven, ten, ten and nine steps of 0.1 m, counted by hand."""
    end = [outcomes["drive-square"].summary[f"final_{name}"] for name in ("x", "y", "theta")]
    assert end == pytest.approx([0.1, -0.1, pi], abs=1e-12)
    assert outcomes["drive-square"].summary["distance"] == pytest.approx(4.0, abs=1e-12)


def test_deadbeat_lags_by_one_step_of_the_fastest_reference(outcomes):
    assert outcomes["track-astroid-p"].summary["largest_error"] == pytest.approx(0.01 * 3.0 * pi / 10.0, rel=0.05)


@pytest.mark.parametrize(
    ("name", "changes", "words"),
    [
        ("arm-reach", {"target": [1.2, 0.0]}, "short by 0.2 m"),
        ("arm-reach", {"arm.links": [0.5, 0.2], "target": [0.1, 0.0]}, "short by 0.2 m"),
        ("trace-circle", {"curve.center": [1.6, 0.5]}, "beyond the outer ring"),
        ("trace-lemniscate", {"at_singular": "stop"}, "the branches meet"),
        ("track-astroid", {"integrator.method": "rk4"}, "refused before it ran: unstable"),
        ("track-astroid", {"controller.kp": 250}, "refused before it ran: unstable"),
        ("aim-speed", {"target": [45, 2]}, "short by"),
        ("aim-angle", {"target": [0.8, 2.1]}, "not below the line of the launch"),
        ("mecanum", {"base": {"type": "differential", "track": 0.4, "radius": 0.05}}, "cannot move sideways"),
        ("mecanum", {"base.rollers": "O", "base.wheelbase": 0.3}, "turn on the spot"),
    ],
)
def test_the_honest_no(name, changes, words):
    scenario = load(name).replaced(changes)
    outcome = scenario.run()
    assert not outcome.ok
    assert outcome.passed
    assert words in " ".join((outcome.status, outcome.headline, *outcome.warnings))
    assert [finding for finding in scenario.preflight() if finding.tone == "no"]
    json.dumps(outcome.summary, allow_nan=False)


def test_unstable_gains_run_on_request():
    outcome = load("track-astroid").replaced({"controller.kp": 400, "unstable": "run"}).run()
    assert (outcome.ok, outcome.summary["diverged"], outcome.summary["largest_error"]) == (False, True, None)
    assert outcome.headline == "the loop diverges"
    refused = load("track-astroid").replaced({"controller.kp": 400}).run()
    assert (refused.run, refused.tables, refused.summary["refused"]) == (None, {}, True)


def test_what_is_said_before_it_runs():
    def said(name, **changes):
        return " | ".join(f"{f.tone}: {f.sentence}" for f in load(name).replaced(changes).preflight())

    assert "warn: exactly on the stability boundary" in said("track-astroid")
    assert "good: the tool is at the target" in said("arm-reach")
    assert "good: the base can make this twist" in said("mecanum")
    assert "no: the base can make a part" in said("mecanum", base={"type": "differential", "track": 1, "radius": 0.1})
    assert "warn: segment 0 reverses after 5 s: a cusp" in said(
        "clothoid", segments=[{"v": 1, "a": -0.2, "duration": 9}]
    )
    assert "warn: the posture is singular" in said("arm-pose", q=[0.3, 0.0])
    assert "warn: joint 2 is beyond its limit" in said("arm-pose", **{"arm.limits": [None, [-0.1, 0.1]]})
    assert "warn: passes a singular point (base)" in said("trace-lemniscate")
    assert "m/s would do" in said("aim-speed", target=[45, 2])
    for name in names():
        assert all(f.sentence and f.tone in ("good", "note", "warn", "no") for f in load(name).preflight())


def test_wheel_rates_drive_what_the_base_says():
    pieces = [{"left": 5.0, "right": 5.0, "duration": 2.0}, {"left": 3.0, "right": 6.0, "duration": 1.0}]
    history = {"type": "wheel-rates", "base": {"track": 0.5, "radius": 0.1}, "pieces": pieces}
    run = from_data({"type": "drive", "history": history}).run().run
    base = WheeledBase.differential(track=0.5, radius=0.1)
    twist = base.forward(base.rates(left=3.0, right=6.0))
    assert run["v"][[1, -1]].tolist() == pytest.approx([0.5, twist.vx])
    assert run["omega"][-1] == pytest.approx(twist.omega)
    samples = {"type": "samples", "t": [0, 1, 3], "v": [1, 2, 0], "omega": [0, 0, 0]}
    assert from_data({"type": "drive", "history": samples}).run().summary["final_x"] == 5.0
    with pytest.raises(InvalidScenario, match=r"pieces\.0\.duration"):
        from_data({"type": "drive", "history": {"type": "commands", "pieces": [{"v": 1, "duration": 0.12}]}})


def test_the_three_forms_of_drag():
    def drag(**keys):
        return from_data({"type": "shot", "projectile": keys, "launch": {"velocity": [3, 4]}}).projectile.build()

    assert drag(mass=2.0, drag=0.1).drag_per_mass == 0.05
    assert drag(mass=2.0, drag_per_mass=0.05).drag == 0.1
    ball = Projectile.from_area(0.27, drag_coefficient=0.47, area=0.0452)
    assert drag(mass=0.27, drag_coefficient=0.47, area="452 cm^2").drag == pytest.approx(ball.drag)
    assert drag().drag == 0.0
    for bad in ({"drag": 1, "drag_per_mass": 1}, {"area": 1}, {"drag_coefficient": 1}):
        with pytest.raises(InvalidScenario, match=r"projectile\."):
            drag(**bad)


def test_one_form_of_aiming_at_a_time():
    with pytest.raises(
        InvalidScenario, match=r"speed = 30\.0: needed one of time, speed, angle; time is given already"
    ):
        load("aim-speed").replaced({"time": 1})


def test_what_would_never_end_is_refused_at_once():
    for name, changes in (
        ("track-astroid", {"duration": "1000 h"}), ("clothoid", {"step": 1e-9}), ("ramp", {"step": 1e-9}),
        ("holonomic", {"step": 1e-9}), ("drive-square", {"history.step": 1e-9}), ("integrators", {"steps": [1e-9]}),
        ("trace-circle", {"points": 10**9}), ("shot", {"points": 10**9}),
    ):  # fmt: skip
        with pytest.raises(InvalidScenario):
            load(name).replaced(changes)


def test_progress_goes_from_nothing_to_all():
    told = []
    load("aim-speed").run(told.append)
    assert told[0] == 0.0
    assert told[-1] == 1.0
    assert told == sorted(told)


def test_noise_comes_from_the_seed():
    def end(seed):
        return load("drive-to-pose").replaced({"noise.seed": seed}).measure()["final_x"]

    assert end(1) == end(1) != end(2)


@pytest.mark.parametrize("joints", ["RR", "RPR", "PRR"])
@pytest.mark.parametrize("angles", ["relative", "absolute"])
def test_the_truth_about_arms_agrees_and_is_another_one(joints, angles):
    arm = {"links": [0.5, 0.4, 0.3][: len(joints)], "joints": joints, "angles": angles, "bends": [0.1] * len(joints),
           "base": {"x": 1.0, "theta": 0.2}, "tool": {"x": 0.1, "y": 0.05}}  # fmt: skip
    outcome = from_data({"type": "arm-pose", "arm": arm, "q": [0.3, 0.2, -0.4][: len(joints)]}).run()
    assert outcome.passed, outcome.check
    wrong = truths.tool_of(Arm((0.5, 0.31)), (0.3, 0.4)) - complex(*Arm((0.5, 0.3)).forward((0.3, 0.4)).position)
    assert abs(wrong) == pytest.approx(0.01)


@pytest.mark.parametrize("method", ["euler", "midpoint", "heun", "rk4", "exact"])
def test_the_truth_about_loops_sees_a_wrong_step(method):
    gains = {"controller.kp": 30, "controller.ki": 5, "controller.feedforward": True, "controller.point": [0.1, 0.03]}
    scenario = load("track-astroid-p").replaced({"integrator.method": method, **gains})
    outcome = scenario.run()
    assert outcome.passed, outcome.check
    loop = scenario.build()
    other = PointTracker((0.1, 0.03), kp=31.0, ki=5.0, feedforward=True, error_against="next")
    assert truths.loop_error(outcome.run, other, loop.reference, method) > 1e-4
    if method not in ("rk4", "exact"):
        assert truths.loop_error(outcome.run, loop.controller, loop.reference, "rk4") > 1e-9


def test_limits_and_polar_controllers_run():
    limited = (
        load("track-astroid-p")
        .replaced({"limits": {"v": 0.5, "acceleration": 3}, "robot.start": {"x": 0, "y": 0}})
        .run()
    )
    assert limited.passed
    assert limited.summary["largest_v"] <= 0.5
    assert load("drive-to-pose").run().summary["final_rho"] < 0.03


def test_scenarios_know_no_pictures():
    code = (
        "import sys, coplanar.scenarios as s; s.load('track-astroid').run();"
        "sys.exit('matplotlib' in sys.modules or 'coplanar.viz' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize(
    ("name", "changes", "true"),
    [
        ("arm-reach", {"search.near": [0.1, -0.1]}, lambda o: o.things["search"].q[1] < 0.0 < load_q2("arm-reach")),
        ("arm-reach", {"arm.links": [0.5, 0.3]}, lambda o: o.ok),
        ("track-astroid", {"controller.kd": 0.4}, lambda o: o.summary["stable"]),
        ("clothoid", {"segments.0.a": 0}, lambda o: "a clothoid" in o.headline),
        ("drive-square", {"method": "exact"}, lambda o: o.ok),
        ("holonomic", {"pieces.3.alpha": 0.5}, lambda o: o.summary["final_x"] == 2.0 < 1.5 + o.summary["final_theta"]),
        ("rolling-wheel", {"slip": -0.2}, lambda o: o.summary["contact_speed"] == pytest.approx(0.2)),
        ("ramp", {"together": True}, lambda o: o.summary["time_x"] == o.summary["time_y"]),
        ("shot", {"projectile.drag": 0}, lambda o: o.summary["apex_y"] == pytest.approx(30000.0 / (2 * 9.81))),
        ("drive-to-pose", {"controller.arrive_within": 1e-4}, lambda o: np.abs(np.diff(o.run["omega"])).sum() > 90.0),
        ("frames", {"wanted_in": "robot"}, lambda o: o.tables["run.csv"]["y_wanted"][0] == pytest.approx(-1.0)),
        ("arm-pose", {"arm.angles": "absolute"}, lambda o: o.summary["theta"] == 0.4),
    ],
)  # fmt: skip
def test_what_the_comments_of_the_files_invite_to_try(name, changes, true):
    outcome = load(name).replaced(changes).run()
    assert outcome.passed
    assert true(outcome), outcome.summary


def load_q2(name):
    return load(name).run().things["search"].q[1]


def test_the_low_arc_is_the_low_one(outcomes):
    numbers, aim = outcomes["aim-speed"].summary, Projectile(1.0, 0.02).aim((30.0, 2.0), speed=30.0)
    for name, arc in (("low", aim.low), ("high", aim.high)):
        assert (numbers[f"{name}_angle"], numbers[f"{name}_time"]) == (arc.angle, arc.time)
    assert outcomes["aim-speed"].tables["run.csv"]["angle"] == [aim.low.angle, aim.high.angle]
