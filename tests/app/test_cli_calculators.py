"""The calculators say what the library says, in numbers for programs and in lines for people."""

from __future__ import annotations

import re
import tomllib
from math import atan2, degrees, hypot, pi
from pathlib import Path

import numpy as np
import pytest

from coplanar import Arm, Pose, Projectile, Twist, WheeledBase
from coplanar.arms.inverse import METHODS as INVERSE_METHODS
from coplanar.cli.arms import Angles, Method
from coplanar.cli.doctor import LIBRARIES, NEEDED
from coplanar.cli.odometry import Method as PathMethod
from coplanar.cli.wheels import Rollers
from coplanar.motion import Comparison, Program, Segment
from coplanar.motion.odometry import PATH_METHODS
from coplanar.wheels.layouts import ROLLERS
from tests.app.commands import SOURCES, run, told

ARM = ("--links", "0.4", "30 cm")


def test_fk():
    document = told("fk", *ARM, "--q", "30 deg", "-0.5", "--base", 1, "-2", "90deg", "--tool", "5cm", 0, 0)
    arm = Arm((0.4, 0.3), base=Pose(1.0, -2.0, pi / 2), tool=Pose(0.05, 0.0, 0.0))
    q = [pi / 6, -0.5]
    assert [*document["position"], document["heading"]] == arm.forward(q).as_array().tolist()
    assert document["points"] == arm.points(q).tolist()
    assert document["jacobian"] == arm.jacobian(q).tolist()
    assert document["manipulability"] == arm.manipulability(q)
    assert document["ellipse_radii"] == arm.ellipse(q).radii.tolist()
    assert document["ellipse_angle"] == arm.ellipse(q).angle


def test_fk_of_other_joints_and_angles():
    document = told("fk", "--links", 1, 0.5, "--joints", "RP", "--q", 0, 0.25)
    assert document["position"] == [1.75, 0.0]
    assert told("fk", "--links", 1, 0.5, "--angles", "absolute", "--q", 1, 0)["heading"] == 0.0
    assert told("fk", "--links", "1,0.5", "--q", "1,0") == told("fk", "--links", 1, "--links", 0.5, "--q", 1, 0)


def test_ik_says_both_branches():
    document = told("ik", *ARM, "--target", "-0.3", "0.4")
    branches = Arm((0.4, 0.3)).inverse((-0.3, 0.4)).branches
    assert [b["q"] for b in document["branches"]] == branches.tolist()
    assert [b["elbow"] for b in document["branches"]] == ["positive", "negative"]
    for elbow, branch in zip(("positive", "negative"), branches.tolist(), strict=True):
        assert told("ik", *ARM, "--target", "-0.3", "0.4", "--elbow", elbow)["q"] == branch
    near = [str(value) for value in branches[1] + [0.1, 2 * pi]]
    moved = told("ik", *ARM, "--target", "-0.3", "0.4", "--near", *near)
    assert moved["q"] == pytest.approx(branches[1] + [0.0, 2 * pi])


def test_ik_out_of_reach_is_a_no_with_the_nearest_point():
    document = told("ik", *ARM, "--target", 3, 0, code=1)
    assert document["code"] == "TOO_FAR"
    assert [document["gap"], *document["nearest"]] == pytest.approx([2.3, 0.7, 0.0])
    limited = told("ik", *ARM, "--target", "-0.3", 0.4, "--limits", "-10deg:10deg", "free", code=1)
    assert limited["code"] == "OUTSIDE_LIMITS"
    assert [b["within_limits"] for b in limited["branches"]] == [False, False]
    code, out, _ = run("ik", *ARM, "--target", 3, 0)
    assert code == 1
    assert "stretched" in out.splitlines()[0]
    assert "2.3 m" in out


def test_ik_with_a_heading_and_by_search():
    pose = told("ik", "--links", 1, 0.8, 0.3, "--target", 1, 0.5, "--heading", "20 deg")
    assert told("fk", "--links", 1, 0.8, 0.3, "--q", *map(str, pose["q"]))["heading"] == pytest.approx(pi / 9)
    searched = told("ik", "--links", 1, 0.8, 0.3, 0.2, "--target", 1, 0.5, "--method", "numerical")
    assert searched["iterations"] > 0
    assert searched["branches"][0]["elbow"] == "-"


def test_aim_by_speed_angle_time_and_least():
    ball = Projectile(2.0, 0.02)
    options = ("aim", "--target", 30, 2, "--mass", "2 kg", "--drag", "20 g/m")
    both = told(*options, "--speed", "30 m/s")
    assert [arc["angle"] for arc in both["arcs"]] == ball.aim((30.0, 2.0), speed=30.0).angles.tolist()
    by_time = told(*options, "--time", "2 s")["arcs"]
    assert by_time[0]["velocity"] == ball.aim((30.0, 2.0), time=2.0).low.velocity.tolist()
    assert len(by_time) == 1
    by_angle = told(*options, "--angle", "45 deg")["arcs"][0]
    assert by_angle["speed"] == pytest.approx(ball.aim((30.0, 2.0), angle=pi / 4).low.speed)
    assert by_angle["degrees"] == pytest.approx(45.0)
    least = told(*options)["arcs"][0]
    assert least["speed"] == ball.aim((30.0, 2.0)).low.speed
    behind = told("aim", "--target", "-3", "-1", "--speed", "9", "--start", "1", "-1")
    assert behind["miss"] < 1e-9


def test_aim_out_of_range_says_what_is_missing():
    document = told("aim", "--target", 60, 0, "--speed", 20, "--drag", 0.02, code=1)
    aim = Projectile(1.0, 0.02).aim((60.0, 0.0), speed=20.0)
    assert document["code"] == "OUT_OF_REACH"
    assert (document["shortfall"], document["furthest"]) == (aim.shortfall, aim.furthest)
    assert document["least_speed"] == document["arcs"][0]["speed"] == aim.least_speed
    assert "short by 34.0108 m" in document["status"]
    assert told("aim", "--target", 3, 9, "--angle", "10 deg", code=1)["code"] == "OFF_THE_LINE"


def test_wheels_forward_and_inverse():
    base = WheeledBase.differential(track=0.5, radius=0.1)
    options = ("wheels", "differential", "--track", "50 cm", "--radius", 0.1)
    document = told(*options, "--twist", 0.5, 0, "30 deg/s", "--rates", 5, 10)
    assert [row["rate"] for row in document["rates"]] == base.inverse(Twist(0.5, 0.0, pi / 6)).tolist()
    assert document["twist"] == base.forward([5.0, 10.0]).as_array().tolist()
    assert document["centre_of_rotation"] == pytest.approx([0.0, 0.75])
    assert (document["rank"], document["holonomic"], document["degrees_of_configuration"]) == (3, False, 3)
    assert told(*options, "--rates", 1, 1)["centre_of_rotation"] is None


def test_wheels_say_what_they_cannot_do():
    options = ("wheels", "differential", "--track", 0.5, "--radius", 0.1)
    document = told(*options, "--twist", 0.5, 0.1, 1, code=1)
    assert (document["gap"], document["nearest"]) == (pytest.approx(0.1), [0.5, 0.0, 1.0])
    assert told(*options)["status"] == "cannot move sideways: left and right would slide"
    mirrored = told("wheels", "mecanum", "--track", 1, "--wheelbase", 1, "--radius", 0.1, "--rollers", "O")
    assert mirrored["rank"] == 2
    assert mirrored["condition"] is None
    assert any("mounted as X" in warning for warning in mirrored["warnings"])
    assert (
        "note: the rollers"
        in run("wheels", "mecanum", "--track", 1, "--wheelbase", 1, "--radius", 0.1, "--rollers", "O")[1]
    )


def test_wheels_of_every_layout(tmp_path):
    assert told("wheels", "omni", "--distance", 0.2, "--radius", 0.05)["condition"] == pytest.approx(2**0.5)
    assert told("wheels", "omni", "--distance", 0.2, "--radius", 0.05, "--count", 5)["rank"] == 3
    table = tmp_path / "wheels.txt"
    table.write_text(
        "# x, y, angle, radius, roller, name\n0.3,0.2,0,0.1,-45deg,fl\n\n0.3,-0.2,0,0.1,45deg,fr # right\n"
    )
    more = ("--wheel=-0.3,0.2,0,0.1,45deg", "--wheel=-0.3,-0.2,0,10 cm,-pi/4")
    document = told("wheels", "table", "--file", table, *more)
    assert document["rank"] == 3
    assert [w["wheel"] for w in document["wheels"]] == ["wheel_1", "wheel_2", "fl", "fr"]
    assert told("wheels", "table", "--wheel", "0,0.2,0,0.1", "0,-0.2,0,0.1")["degrees_of_control"] == 2


def test_swerve_steers_every_wheel():
    document = told(
        "wheels", "swerve", "--wheelbase", 0.6, "--track", 0.5, "--radius", 0.1, "--twist", 0.5, 0.1, "30deg/s"
    )
    for row, wheel in zip(document["rates"], document["wheels"], strict=True):
        vx, vy = 0.5 - pi / 6 * wheel["y"], 0.1 + pi / 6 * wheel["x"]
        assert (row["rate"], row["steering"]) == pytest.approx((hypot(vx, vy) / 0.1, atan2(vy, vx)))


def test_wiring_that_is_wrong_is_a_no():
    options = ("wheels", "differential", "--track", 0.5, "--radius", 0.1, "--jog")
    wrong = told(*options, "-0.05,0,0.2", "0.05,0,0.2", code=1)
    assert wrong["status"] == "motor left is inverted"
    assert [row["inverted"] for row in wrong["wiring"]] == [True, False]
    right = told(*options, "0.05,0,-12deg/s", "0.05,0,0.2")
    assert all(row["motor"] == row["turns"] for row in right["wiring"])


def test_lab_compares_integrators():
    document = told("lab", "--v", 1, "--omega", "90deg/s", "--duration", 4, "--step", "50 ms", "--within", "1 mm")
    compared = Comparison(Program([Segment(1.0, pi / 2, duration=4.0)]), Pose(), steps=(0.05, 0.025))
    rows = document["methods"]
    assert [row["method"].split()[0] for row in rows] == ["Euler", "RK2", "RK2", "RK4", "exact"]
    assert [row["largest_error"] for row in rows[:4]] == compared.errors()[:, 0].tolist()
    assert [round(row["order"]) for row in rows[:4]] == [1, 2, 2, 4]
    assert rows[0]["largest_step"] == pytest.approx(compared.largest_step("euler", 1e-3))
    assert document["exact_end"] == pytest.approx([0.0, 0.0], abs=1e-12)
    curved = told("lab", "--a", "0.5", "--alpha", "-0.2", "--duration", 2)
    assert curved["exact_heading"] == pytest.approx(1.0 * 2 - 0.2 * 2)


def test_doctor_says_what_there_is(monkeypatch, tmp_path):
    monkeypatch.setenv("COPLANAR_CACHE", str(tmp_path))
    document = told("doctor")
    assert document["libraries"][0] == {"library": "numpy", "version": np.__version__}
    assert document["cache_folder"] is None or document["cache_folder"].startswith(str(tmp_path))
    assert {row["extra"] for row in document["extras"]} == set(NEEDED)
    assert all(row["present"] or row["add"].startswith("pip install 'coplanar[") for row in document["extras"])


def test_doctor_tells_of_what_is_missing(monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("COPLANAR_CACHE", str(tmp_path / "file"))
    monkeypatch.setitem(NEEDED, "logs", ("mcap", "no-such-thing"))
    document = told("doctor")
    assert [r["add"] for r in document["extras"] if r["extra"] == "logs"] == ["pip install 'coplanar[logs]'"]
    if document["numba"]:
        assert document["cache_folder"] is None
        assert any("COPLANAR_CACHE" in warning for warning in document["warnings"])
    monkeypatch.setattr("coplanar.cli.doctor.LIBRARIES", ("numpy", "no-such-thing"))
    assert told("doctor", code=1)["status"].startswith("missing: no-such-thing")


def test_the_doctor_knows_what_the_project_needs():

    file = Path(SOURCES).parent / "pyproject.toml"
    if not file.exists():
        pytest.skip("not run from the sources")
    project = tomllib.loads(file.read_text())["project"]

    def names(requirements):
        return {re.split(r"[\s<>=!~\[;]", r)[0] for r in requirements}

    assert set(LIBRARIES) == names(project["dependencies"]) - {"numba"}
    for extra, parts in NEEDED.items():
        assert {part for part in parts if part != "distributed"} == names(project["optional-dependencies"][extra])


def test_names_to_complete_are_those_of_the_library():
    assert {m.value for m in Method} == set(INVERSE_METHODS)
    assert tuple(m.value for m in PathMethod) == PATH_METHODS
    assert {r.value for r in Rollers} == set(ROLLERS)
    for angles in Angles:
        Arm((1.0,), angles=angles.value)


@pytest.mark.parametrize(
    ("command", "message"),
    [
        (("fk", *ARM, "--q", 1), "shape"),
        (("fk", *ARM, "--q", 1, "2 kg"), "q = '2 kg': needed"),
        (("fk", *ARM, "--q", "nan", 1), "q = 'nan'"),
        (("fk", "--links", 0, 1, "--q", 1, 1), "links"),
        (("fk", *ARM, "--joints", "RX", "--q", 1, 1), "joints"),
        (("ik", *ARM, "--target", 1, 1, "--limits", "1"), "LOW:HIGH"),
        (("ik", *ARM, "--target", 1, 1, "--heading", 0, "--method", "closed"), "numerical"),
        (("aim", "--target", 0, 0, "--speed", 3), "a point away from the launch point"),
        (("aim", "--target", 1, 0, "--speed", 3, "--time", 2), "one of time, speed, angle"),
        (("aim", "--target", 1, 0, "--speed", "-3"), "speed"),
        (("wheels", "differential", "--radius", 1), "give --track"),
        (("wheels", "table"), "give --wheel or --file"),
        (("wheels", "table", "--wheel", "0,0,0"), "--wheel = '0,0,0'"),
        (("wheels", "table", "--file", "/nowhere"), "No such file"),
        (("wheels", "omni", "--radius", 0.1, "--distance", 1, "--jog", "1,2"), "jog = '1 2': needed 3 numbers"),
        (("wheels", "omni", "--radius", 0.1, "--distance", 1, "--jog", "1,2,3"), "jog every motor once"),
        (("wheels", "omni", "--radius", 0.1, "--distance", 1, "--rates", 1), "rates"),
        (("lab", "--step", 0), "step"),
        (("lab", "--step", "1us"), "steps"),
    ],
)
def test_what_cannot_be_used_is_said(command, message):
    code, out, err = run(*command)
    assert (code, out) == (2, "")
    assert err.startswith("error: ")
    assert message in err


def test_angles_are_said_in_degrees_too():
    out = run("fk", "--links", 1, "--q", 0.5)[1]
    assert f"{degrees(0.5):.6g} deg" in out
