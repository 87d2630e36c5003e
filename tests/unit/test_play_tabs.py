"""What the tabs show is what the library says."""

from __future__ import annotations

import math
import time

import numpy as np
import pytest

import coplanar
from coplanar.curves import HeldPoint
from coplanar.play import Session
from coplanar.play.controls import checked_state
from coplanar.play.tabs import TABS
from coplanar.simulation import Noise, simulate

SESSION = Session()


def show(tab, state=None, **more):
    answer = SESSION.handle({"id": 1, "do": "show", "tab": tab, "state": state or {}, **more})
    assert answer["ok"], answer
    return answer


def refused(tab, state=None, **more):
    answer = SESSION.handle({"id": 1, "do": "show", "tab": tab, "state": state or {}, **more})
    assert not answer["ok"]
    return answer["error"]


def numbers(answer):
    return {entry["key"]: entry["number"] for entry in answer["readouts"] if "number" in entry}


def said(answer, tone=None):
    return [entry["text"] for entry in answer["sentences"] if tone in (None, entry["tone"])]


def layers(answer, kind, picture="main"):
    return [layer for layer in answer["pictures"][picture]["layers"] if layer["kind"] == kind]


def handle(answer, name):
    return next(entry for entry in answer["handles"] if entry["id"] == name)


STATES = [
    *((tab, {}) for tab in TABS),
    ("arm", {"links": "3", "limited": True}),
    ("arm", {"limited": True, "target_x": -1.5, "target_y": -0.9}),
    ("arm", {"target_x": 4.0}),
    ("arm", {"follow": "joints", "q1": 6.2, "q2": -3.0}),
    ("arm", {"curve": "lemniscate", "size": 1.0, "l2": 1.0, "curve_x": 0.0, "curve_y": 0.0}),
    ("drive", {"curve": "stroke"}),
    ("drive", {"start": "free", "limited": True, "compare": True}),
    ("drive", {"controller": "polar", "start": "free"}),
    (
        "drive",
        {"controller": "polar", "start": "free", "form": "smooth", "k_beta": 1.0, "noisy": True, "compare": True},
    ),
    ("base", {"layout": "swerve", "omega": 0.0, "vx": 0.0, "vy": 0.0}),
    ("base", {"layout": "custom"}),
    ("motion", {"then": [{"v": -1.0}, {"omega": 0.0, "alpha": 0.0}]}),
    ("shoot", {"by": "angle", "angle": -1.4}),
    ("shoot", {"by": "least", "drag": 0.0}),
    ("lab", {"motion": "shot", "duration": 1.0}),
]


@pytest.mark.parametrize(("tab", "state"), STATES)
def test_a_state_that_was_answered_is_complete_and_stays_as_it_is(tab, state):
    first = show(tab, state)
    assert first["complete"]
    assert set(first["state"]) == {control.key for control in TABS[tab].controls}
    assert checked_state(TABS[tab].controls, first["state"]) == first["state"]
    again = show(tab, first["state"])
    assert again == first


@pytest.mark.parametrize(("tab", "state"), STATES)
def test_every_handle_can_be_dragged_nudged_and_leads_to_a_valid_state(tab, state):
    before = show(tab, state)
    for one in before["handles"]:
        x, y = one["at"]
        moved = show(tab, before["state"], drag={"handle": one["id"], "to": [x + 0.1, y + 0.05]})
        assert checked_state(TABS[tab].controls, moved["state"]) == moved["state"]
        far = show(tab, before["state"], drag={"handle": one["id"], "to": [-900.0, 900.0]})
        assert checked_state(TABS[tab].controls, far["state"]) == far["state"]
        show(tab, before["state"], nudge={"handle": one["id"], "by": [1, -1]})


def test_arrow_keys_move_by_the_handles_step_and_turn_counterclockwise_upwards():
    state = show("base")["state"]
    x, y = handle(show("base", state), "wheel_1")["at"]
    moved = show("base", state, nudge={"handle": "wheel_1", "by": [2, -1]})
    assert np.allclose(handle(moved, "wheel_1")["at"], [x + 0.02, y - 0.01], rtol=0, atol=1e-9)
    for by, turned in (([0, 1], 0.05), ([1, 0], -0.05), ([-2, 0], 0.1)):
        angle = show("base", state, nudge={"handle": "turn_1", "by": by})["state"]["wheels"][0]["drive_angle"]
        assert angle == pytest.approx(turned, abs=1e-9)


@pytest.mark.parametrize(("tab", "state"), STATES)
def test_pictures_have_one_row_a_frame_or_one_for_all(tab, state):
    for live in (False, True):
        for scene in show(tab, state, live=live)["pictures"].values():
            frames = len(scene["times"])
            assert len(scene["bounds"]) == 4
            assert scene["bounds"][0] < scene["bounds"][1]
            assert scene["bounds"][2] < scene["bounds"][3]
            for layer in scene["layers"]:
                framed = {"circles", "ends", "vectors", "joints", "poses", "points"} & set(layer)
                if layer["kind"] not in ("curve", "region"):
                    for name in framed - ({"ends"} if layer["kind"] == "carried" else set()):
                        assert len(layer[name]) in (1, frames)


def test_the_tool_follows_the_hand_on_its_elbow():
    state = show("arm", {"elbow": "-1"})["state"]
    for i in range(40):
        to = [0.9 * math.cos(0.1 * i), 0.9 * math.sin(0.1 * i)]
        answer = show("arm", state, drag={"handle": "tool", "to": to})
        q = [answer["state"]["q1"], answer["state"]["q2"]]
        assert np.allclose(coplanar.Arm((1.0, 0.7)).forward(q).position, to, rtol=0, atol=1e-12)
        assert answer["state"]["elbow"] == "-1"
        assert math.sin(q[1]) < 0.0
        assert abs(q[0] - state["q1"]) < 0.8 or i == 0
        state = answer["state"]


def test_both_elbows_are_drawn_and_numbers_are_the_arms_own():
    answer = show("arm", {"target_x": 0.8, "target_y": 0.7})
    arm = coplanar.Arm((1.0, 0.7))
    solution = arm.inverse((0.8, 0.7), elbow=1)
    read = numbers(answer)
    assert (read["q1"], read["q2"]) == tuple(solution.q.tolist())
    assert read["w"] == arm.manipulability(solution.q)
    assert [read["j11"], read["j12"], read["j21"], read["j22"]] == arm.jacobian(
        solution.q, task="position"
    ).ravel().tolist()
    ghost, chosen = layers(answer, "linkage")
    assert ghost["opacity"] < 1.0
    assert np.allclose(ghost["joints"][0], arm.points(solution.branches[1]).ravel(), rtol=0, atol=1e-5)
    assert np.allclose(chosen["joints"][0], arm.points(solution.q).ravel(), rtol=0, atol=1e-5)
    assert said(answer, "good") == [solution.status.value]


def test_out_of_reach_shows_the_gap_and_the_nearest_point():
    answer = show("arm", {"target_x": 2.7, "target_y": 0.0})
    assert numbers(answer)["gap"] == pytest.approx(1.0, abs=1e-12)
    (gap,) = layers(answer, "segments")
    assert gap["dashed"]
    assert np.allclose(gap["ends"], [[1.7, 0.0, 2.7, 0.0]], rtol=0, atol=1e-5)
    assert "short by 1 m" in said(answer, "no")[0]


def test_joints_that_are_set_by_hand_take_the_target_along():
    state = show("arm")["state"]
    answer = show("arm", state | {"q1": 1.0}, changed="q1")
    assert answer["state"]["follow"] == "joints"
    place = coplanar.Arm((1.0, 0.7)).forward([1.0, state["q2"]]).position
    assert [answer["state"]["target_x"], answer["state"]["target_y"]] == place.tolist()
    other = show("arm", answer["state"] | {"elbow": "-1"}, changed="elbow")
    assert (other["state"]["follow"], other["state"]["elbow"]) == ("target", "-1")
    assert other["state"]["q2"] == pytest.approx(-state["q2"], abs=1e-9)
    assert said(show("arm", answer["state"] | {"limited": True, "q2": 3.0}), "no") == ["joint 2 is beyond its limit"]


def test_three_limited_links_follow_while_dragged_and_arrive_at_rest():
    state = show("arm", {"links": "3", "limited": True})["state"]
    for i in range(12):
        moved = show("arm", state, drag={"handle": "tool", "to": [0.9 - 0.05 * i, 0.8]})
        state = moved["state"]
        assert not moved["complete"]
    rest = show("arm", state)
    assert rest["complete"]
    assert numbers(rest)["gap"] == 0.0


def test_a_trace_is_certified():
    answer = show("arm", {"curve": "circle"})
    curve = coplanar.Circle(0.4, center=(0.9, 0.4))
    near = [answer["state"]["q1"], answer["state"]["q2"]]
    proof = coplanar.trace(coplanar.Arm((1.0, 0.7)), curve, 121, near=near, at_singular="through").certificate
    assert numbers(answer)["smallest_sine"] == proof.smallest_sine
    assert answer["pictures"]["main"]["times"][-1] == 6.0
    failed = show("arm", {"curve": "circle", "size": 1.0})
    assert "cannot follow" in said(failed, "no")[0]
    assert [layer["role"] for layer in layers(failed, "curve")].count("no") == len(said(failed, "no")) - 1


def test_the_poles_and_the_warning_come_before_the_run():
    notes = {"px": 0.05, "kp": 100.0, "kd": 0.5, "step": 0.01, "error_against": "next"}
    answer = show("drive", notes)
    poles = [entry["value"] for entry in answer["readouts"] if entry["key"].startswith("pole_")]
    assert sorted(map(float, poles)) == [-1.0, 0.5]
    assert "exactly on the stability boundary" in said(answer, "warn")[0]
    crosses = layers(answer, "cross", "poles")
    assert [-1.0, 0.0] in [cross["points"][0] for cross in crosses]
    assert "unstable: errors grow" in said(show("drive", notes | {"method": "rk4"}), "no")
    assert "put P ahead of the axle" in refused("drive", {"px": 0.0})["sentence"]


def test_the_run_is_the_librarys_and_compares_its_integrators():
    answer = show("drive", {"compare": True, "duration": 5.0})
    tracker = coplanar.PointTracker((0.1, 0.0), kp=8.0)
    reference = coplanar.Astroid(1.0).over(5.0)
    runs = {
        method: simulate(coplanar.Unicycle(), tracker, reference, step=0.02, method=method)
        for method in ("euler", "rk4", "exact")
    }
    read = numbers(answer)
    assert answer["pictures"]["main"]["times"][-1] == 5.0
    assert read["end_x"] == runs["euler"]["x"][-1]
    apart = np.hypot(runs["euler"]["x"] - runs["exact"]["x"], runs["euler"]["y"] - runs["exact"]["y"]).max()
    assert read["apart_euler"] == pytest.approx(apart, rel=0.05)  # sampled rows
    assert read["apart_rk4"] < 1e-3 * read["apart_euler"]


def test_a_loop_that_explodes_says_so_and_stays_finite():
    for state in ({"kp": 190.0}, {"kp": 200.0, "kd": 1.2, "step": 0.05, "duration": 30.0}):
        answer = show("drive", state)
        assert "unstable: errors grow" in said(answer, "no")
        trail = np.array(layers(answer, "trail")[0]["points"])
        assert 1.0 < np.abs(trail).max() < 1e3
        assert len(trail) > 3


def test_a_resting_point_is_reached():
    answer = show("drive", {"curve": "point", "curve_x": 0.5, "curve_y": 0.3, "start": "free", "start_x": -0.5})
    assert numbers(answer)["last_error"] < 1e-6
    assert HeldPoint((0.5, 0.3)).position(0.0).tolist() == layers(answer, "point")[-1]["points"][-1]


def test_what_a_base_cannot_do_is_drawn_and_said():
    answer = show("base", {"vx": 0.5, "vy": 0.5, "omega": 0.0})
    base = coplanar.WheeledBase.differential(half_track=0.3, radius=0.1)
    assert base.cannot[0] in said(answer, "warn")
    crossed = [layer for layer in layers(answer, "arrows") if layer.get("crossed")]
    assert len(crossed) == 2  # sideways at all, and the sideways part of what is wanted
    assert [layer["role"] for layer in layers(answer, "body")].count("no") == 1
    free = show("base", {"layout": "mecanum"})
    assert not [layer for layer in layers(free, "arrows") if layer.get("crossed")]
    assert numbers(free)["rank"] == 3
    assert any("mounted as X" in text for text in said(show("base", {"layout": "mecanum", "rollers": "O"}), "no"))


def test_a_dragged_wheel_makes_a_layout_of_ones_own():
    state = show("base", {"layout": "omni3"})["state"]
    moved = show("base", state, drag={"handle": "wheel_2", "to": [-0.3, 0.1]})
    assert moved["state"]["layout"] == "custom"
    assert [moved["state"]["wheels"][1][axis] for axis in "xy"] == [-0.3, 0.1]
    turned = show("base", moved["state"], drag={"handle": "turn_2", "to": [-0.3, 0.9]})
    assert turned["state"]["wheels"][1]["drive_angle"] == pytest.approx(math.pi / 2)
    edited = show("base", state | {"wheels": state["wheels"][:2]}, changed="wheels")
    assert len(edited["state"]["wheels"]) == 2
    assert "drag.to" not in str(edited)


def test_redundant_wheels_see_a_slip():
    assert "at least one wheel slips" in said(show("base", {"layout": "mecanum", "slip": 2.0}), "no")[0]
    assert any("within the noise" in text for text in said(show("base", {"layout": "mecanum"}), "good"))


@pytest.mark.parametrize(
    ("preset", "kind"), [("line", "line"), ("circle", "arc"), ("clothoid", "clothoid"), ("spin", "spin")]
)
def test_the_same_sliders_make_every_curve(preset, kind):
    answer = show("motion", {"preset": preset}, changed="preset")
    assert next(e["value"] for e in answer["readouts"] if e["key"] == "kind_1") == kind
    moved = show("motion", answer["state"] | {"v": 0.5}, changed="v")
    assert moved["state"]["preset"] == "custom"


def test_a_cusp_is_named_and_the_end_can_be_dragged():
    answer = show("motion", {"preset": "cusp"}, changed="preset")
    assert any("cusp 2 s" in text for text in said(answer, "warn"))
    state = show("motion")["state"]
    for _ in range(3):
        state = show("motion", state, drag={"handle": "end", "to": [1.5, 1.0]})["state"]
    assert np.allclose(handle(show("motion", state), "end")["at"], [1.5, 1.0], rtol=0, atol=1e-9)


def test_integrators_stand_beside_the_exact_path():
    state = {"compare": True, "step": 0.5}
    read = numbers(show("motion", state))
    half = numbers(show("motion", state | {"step": 0.25}))
    assert half["apart_euler"] < read["apart_euler"]
    assert read["apart_rk4"] / half["apart_rk4"] > 10.0
    assert refused("motion", {"step": 0.02, "then": [{"duration": 8.0}] * 7})["key"] == "step"


def test_both_arcs_hit_and_a_short_shot_says_how_short():
    ball = coplanar.Projectile(mass=1.0, drag=0.01)
    aim = ball.aim((30.0, 6.0), speed=30.0)
    answer = show("shoot")
    read = numbers(answer)
    assert (read["low_angle"], read["high_angle"]) == (aim.low.angle, aim.high.angle)
    assert read["least_speed"] == aim.least_speed
    for arc in layers(answer, "trail"):
        assert np.allclose(arc["points"][-1], [30.0, 6.0], rtol=0, atol=1e-3)
    out = show("shoot", {"target_x": 90.0})
    assert numbers(out)["shortfall"] == ball.aim((90.0, 6.0), speed=30.0).shortfall > 1.0
    assert "short by" in said(out, "no")[0]
    (gap,) = (layer for layer in layers(out, "segments") if layer.get("dashed"))
    assert gap["ends"][0][2:] == [90.0, 6.0]


def test_the_envelope_is_kept_while_the_target_moves():
    state = show("shoot", {"speed": 33.3})["state"]
    moved = show("shoot", state, drag={"handle": "target", "to": [25.0, 4.0]})
    assert [layer for layer in layers(moved, "curve") if layer.get("dashed")]
    other = show("shoot", state | {"speed": 33.4}, changed="speed", live=True)
    assert not [layer for layer in layers(other, "curve") if layer.get("dashed")]
    assert not other["complete"]


def test_no_launch_is_an_answer():
    answer = show("shoot", {"by": "angle", "angle": -1.4})
    assert "no speed reaches the target" in said(answer, "no")[0]
    assert not layers(answer, "trail")


@pytest.mark.parametrize("motion", ["arc", "clothoid"])
def test_orders_are_seen_and_a_step_for_a_millimetre_is_verified(motion):
    answer = show("lab", {"motion": motion, "alpha": 0.3 if motion == "clothoid" else 0.0, "duration": 3.0})
    read = numbers(answer)
    for method, order in (("euler", 1), ("midpoint", 2), ("rk4", 4)):
        assert read[f"order_{method}"] == pytest.approx(order, abs=0.2)
        step = read[f"largest_step_{method}"]
        if step >= 0.006:
            close = numbers(show("lab", answer["state"] | {"step": min(step, 2.0)}))
            assert close[f"apart_{method}"] <= 1e-3
    assert next(series for series in answer["series"] if series.get("log"))


def test_a_shot_shows_its_errors_against_the_step():
    answer = show("lab", {"motion": "shot", "duration": 1.5})
    series = next(series for series in answer["series"] if series.get("log"))
    for line, order in zip(series["lines"], (1, 2, 4), strict=True):
        finest, next_one = line["values"][2], line["values"][3]
        assert math.log2(next_one / finest) == pytest.approx(order, abs=0.35)


def test_a_method_that_diverges_is_said_to():
    answer = show("lab", {"motion": "shot", "drag": 0.5, "speed": 60.0, "step": 1.0, "duration": 10.0})
    assert "Euler diverges at this step" in said(answer, "no")


POLAR = {"controller": "polar", "start_x": -0.5, "start_y": -0.4, "heading": 0.3}


def test_a_robot_drives_to_the_pose_under_the_hand():
    state = show("drive", POLAR)["state"]
    moved = show("drive", state, drag={"handle": "goal", "to": [-1.0, 0.5]})["state"]
    turned = show("drive", moved, drag={"handle": "goal_turn", "to": [-1.0, 5.0]})["state"]
    assert (turned["goal_x"], turned["goal_y"], turned["goal_heading"]) == (-1.0, 0.5, pytest.approx(math.pi / 2))
    answer = show("drive", turned)
    goal = coplanar.Pose(-1.0, 0.5, turned["goal_heading"])
    controller = coplanar.PolarController(goal, 3.0, 8.0, -1.5, arrive_within=0.01)
    start = coplanar.Pose(-0.5, -0.4, 0.3)
    run = simulate(coplanar.Unicycle(), controller, duration=10.0, step=0.02, start=start)
    read = numbers(answer)
    assert read["last_error"] == run["rho"][-1] < 0.01
    assert abs(read["heading_error"]) < 1e-3
    assert (read["end_x"], read["end_y"]) == (run["x"][-1], run["y"][-1])
    assert read["margin"] == controller.stability(0.02).margin
    assert [series["title"] for series in answer["series"]][2:] == ["Distance to the goal", "Bearings"]


def test_each_law_of_driving_to_a_pose_has_gains_of_its_own():
    smooth = show("drive", POLAR | {"form": "smooth"}, changed="form")["state"]
    assert [smooth[key] for key in ("k_rho", "k_alpha", "k_beta")] == [3.0, 6.0, 1.0]
    assert "k_rho k_beta < 0" in " ".join(said(show("drive", smooth | {"form": "linear"}), "warn"))
    back = show("drive", smooth | {"controller": "point"}, changed="controller")["state"]
    assert back["start"] == "reference"


def test_noise_is_the_same_at_every_look_and_on_the_way_to_it():
    """The picture does not flicker: what is shown while something is dragged is the beginning of the whole run."""
    state = {"noisy": True, "duration": 20.0}
    rest, live = show("drive", state), show("drive", state, live=True)
    assert show("drive", state) == rest
    v = [answer["series"][0] for answer in (rest, live)]
    known = dict(zip(v[0]["x"]["values"], v[0]["lines"][0]["values"], strict=True))
    seen = [(t, value) for t, value in zip(v[1]["x"]["values"], v[1]["lines"][0]["values"], strict=True) if t in known]
    assert len(seen) > 10
    assert all(value == pytest.approx(known[t], abs=1e-4) for t, value in seen)
    noise = Noise(0.005, 0.01, 0.02, 0.1)
    tracker, reference = coplanar.PointTracker((0.1, 0.0), kp=8.0), coplanar.Astroid(1.0).over(20.0)
    run = simulate(coplanar.Unicycle(), tracker, reference, step=0.02, noise=noise)
    assert numbers(rest)["end_x"] == run["x"][-1]
    assert numbers(show("drive", state | {"seed": 1.0}))["end_x"] != run["x"][-1]
    assert numbers(show("drive", state | {"noisy": False}))["largest_error"] < numbers(rest)["largest_error"]


def test_a_loop_that_turns_by_thousands_of_radians_is_answered():
    fast = {"px": 0.005, "kp": 200.0, "step": 0.2, "duration": 30.0, "compare": True}
    for method in ("euler", "rk4", "exact"):
        start = time.perf_counter()
        answer = show("drive", fast | {"method": method})
        assert numbers(answer)["largest_omega"] > 1e3
        assert time.perf_counter() - start < 5.0
        for layer in layers(answer, "body"):
            assert np.isfinite(layer["poses"]).all()


def test_every_line_is_named():
    names = {
        tab: [line["label"] for line in show(tab)["legends"].get("main", ())] for tab in ("motion", "shoot", "lab")
    }
    assert names["motion"] == ["exact, clothoid", "Euler, 20 steps", "RK4, 20 steps"]
    assert names["shoot"] == ["low arc", "high arc", "limit of the reach"]
    assert names["lab"] == ["exact", "Euler", "RK2 (midpoint)", "RK4"]
    cusp = show("motion", {"preset": "cusp"}, changed="preset")
    assert cusp["legends"]["main"][0] == {"label": "exact, general curve with a cusp", "role": "trail"}
    assert "main" not in show("drive")["legends"]
    compared = show("drive", {"compare": True})
    assert [line["label"] for line in compared["legends"]["main"]] == ["way of P, Euler", "Euler", "RK4", "exact arcs"]
    for tab, answer in (("motion", show("motion")), ("drive", compared), ("lab", show("lab"))):
        drawn = {layer["role"] for layer in answer["pictures"]["main"]["layers"]}
        assert {line["role"] for line in answer["legends"]["main"]} <= drawn, tab


def test_the_integrators_stay_while_a_short_motion_is_dragged():
    state = show("motion")["state"]
    moved = show("motion", state, drag={"handle": "end", "to": [2.0, -1.0]})
    assert moved["complete"]
    assert len(moved["legends"]["main"]) == 3
    long = show("motion", state | {"step": 0.02}, drag={"handle": "end", "to": [2.0, -1.0]})
    assert not long["complete"]
    assert len(long["legends"]["main"]) == 1


def test_three_limited_links_say_at_once_where_a_curve_is_beyond_them():
    state = {"links": "3", "limited": True, "curve": "circle", "curve_x": -6.0}
    start = time.perf_counter()
    answer = show("arm", state)
    assert time.perf_counter() - start < 10.0  # to search for a way at every point takes minutes
    assert said(answer) == ["no posture within the limits reaches 100 % of the curve: the arm cannot follow it"]
    (lost,) = layers(answer, "cross")[-1:]
    assert len(lost["points"][0]) == 2 * 121
    dragged = show("arm", answer["state"], drag={"handle": "curve", "to": [-5.0, 0.0]})
    assert [one["id"] for one in dragged["handles"]] == ["curve"]
    assert dragged["state"]["curve_x"] == -5.0
    followed = show("arm", {"links": "3", "limited": True, "curve": "circle"})
    assert "every joint keeps its limits" in said(followed, "good")


def test_a_limit_takes_the_other_one_along():
    state = show("arm", {"limited": True})["state"]
    moved = show("arm", state | {"lower1": 2.5}, changed="lower1")["state"]
    assert (moved["lower1"], moved["upper1"]) == (2.5, 2.5)
    back = show("arm", moved | {"upper1": -1.0}, changed="upper1")["state"]
    assert (back["lower1"], back["upper1"]) == (-1.0, -1.0)
    kept = show("arm", state | {"lower1": 1.5}, changed="lower1")["state"]
    assert (kept["lower1"], kept["upper1"]) == (1.5, 2.0)


@pytest.mark.parametrize("tab", ["arm", "drive"])
def test_a_line_that_is_too_short_is_asked_for_again(tab):
    for stroke in ([], [[0.5, 0.5], [0.6, 0.5], [0.7, 0.5]]):
        assert "draw a curve" in said(show(tab, {"curve": "stroke", "stroke": stroke}), "note")[-1]


def test_a_singular_posture_is_said_to_be_one():
    near, at = show("arm", {"target_x": 1.6999, "target_y": 0.0}), show("arm", {"target_x": 1.7, "target_y": 0.0})
    assert "a millimetre at the tool is" in said(near, "warn")[0]
    assert said(at, "warn")[-1].startswith("singular: there is a direction")


def test_a_launch_that_hits_nothing_is_still_pointed():
    answer = show("shoot", {"by": "angle", "angle": -1.4})
    (arrow,) = layers(answer, "arrows")
    assert arrow["vectors"][0][2:] == pytest.approx(handle(answer, "launch")["at"], rel=1e-4)
