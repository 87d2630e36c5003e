"""Choreo's trajectories."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from coplanar.errors import InvalidValue
from coplanar.logs import read_choreo

T = np.linspace(0.0, 2.0, 21)
FORCES = {"fx": [1.0] * 4, "fy": [0.0] * 4}


def swerve():
    """Round a circle of radius 2, facing its centre the other way round: everything turns."""
    angle, heading = 0.7 * T, -0.4 * T + 3.0
    columns = {
        "t": T, "x": 2.0 * np.cos(angle), "y": 2.0 * np.sin(angle), "heading": heading,
        "vx": -1.4 * np.sin(angle), "vy": 1.4 * np.cos(angle), "omega": np.full(21, -0.4),
        "ax": -0.98 * np.cos(angle), "ay": -0.98 * np.sin(angle), "alpha": np.zeros(21),
    }  # fmt: skip
    return [{n: float(v[i]) for n, v in columns.items()} | FORCES for i in range(21)]


def differential():
    track = 0.5
    columns = {
        "t": T, "x": np.sin(T), "y": 1.0 - np.cos(T), "heading": T,
        "vl": np.full(21, 1.0 - track / 2), "vr": np.full(21, 1.0 + track / 2), "omega": np.ones(21),
        "al": np.zeros(21), "ar": np.zeros(21), "fl": np.zeros(21), "fr": np.zeros(21),
    }  # fmt: skip
    return [{n: float(v[i]) for n, v in columns.items()} for i in range(21)]


@pytest.fixture
def written(tmp_path):
    def write(samples, version=1, **more):
        trajectory = {"sampleType": "Swerve", "waypoints": [0.0, 2.0], "samples": samples, "splits": [0]}
        table = {
            "name": "loop",
            "version": version,
            "snapshot": None,
            "params": {},
            "trajectory": trajectory,
            "events": [],
        }
        path = tmp_path / "loop.traj"
        path.write_text(json.dumps(table | more), encoding="utf-8")
        return path

    return write


@pytest.mark.parametrize("version", [0, 1, 2, 3, "v2025.0.0"])
def test_a_swerve_drive(written, version):
    run = read_choreo(written(swerve(), version))
    assert (run.kind, len(run)) == ("body", 21)
    assert run.info["name"] == "loop"
    assert run.info["version"] == version
    assert run.info["waypoints"] == [0.0, 2.0]
    field = run["vx_field"], run["vy_field"]
    c, s = np.cos(run["theta"]), np.sin(run["theta"])
    np.testing.assert_allclose(run["vx"], c * field[0] + s * field[1], atol=1e-15)
    np.testing.assert_allclose(run["vy"], -s * field[0] + c * field[1], atol=1e-15)
    np.testing.assert_allclose(np.hypot(run["vx"], run["vy"]), 1.4, atol=1e-15)
    assert run.commands.shape == (21, 3)


def test_the_velocities_lead_from_pose_to_pose(written):
    """Simpson's rule over the field's velocity, from the robot's own turned back."""
    run = read_choreo(written(swerve()))
    vx, vy = run.poses.act(run["vx"], run["vy"])
    vx, vy = vx - run["x"], vy - run["y"]
    weights = np.where(np.arange(21) % 2, 4.0, 2.0)
    weights[[0, -1]] = 1.0
    step = T[1] / 3.0
    assert step * (weights * vx).sum() == pytest.approx(run["x"][-1] - run["x"][0], abs=1e-6)
    assert step * (weights * vy).sum() == pytest.approx(run["y"][-1] - run["y"][0], abs=1e-6)


def test_a_differential_drive(written):
    run = read_choreo(written(differential()))
    assert run["vx"].tolist() == [1.0] * 21
    assert run["vy"].tolist() == [0.0] * 21
    assert run["omega"].tolist() == [1.0] * 21
    assert (run["vl"][0], run["vr"][0]) == (0.75, 1.25)
    assert run.info["sample_type"] == "Differential"
    assert run.at(0.05)["x"][0] == pytest.approx(math.sin(0.1) / 2)


def without(samples, name):
    return [{n: v for n, v in sample.items() if n != name} for sample in samples]


@pytest.mark.parametrize(
    ("samples", "more", "words"),
    [
        ([], {}, "trajectory.samples of .*generate the trajectory"),
        (swerve(), {"version": 4}, "version of .*one of 0, 1, 2, 3, v2025.0.0"),
        (swerve(), {"version": True}, "version of"),
        (swerve(), {"version": [1]}, "version of"),
        (swerve(), {"trajectory": []}, "trajectory.samples, as Choreo 2025"),
        (swerve(), {"trajectory": {"samples": {}}}, "trajectory.samples, as"),
        ([*swerve()[:3], 7], {}, "sample 3 of .*an object"),
        (without(differential(), "omega"), {}, "omega of sample 0 of .*a newer Choreo"),
        ([*swerve()[:3], swerve()[3] | {"x": "1"}], {}, "x of sample 3 of .*a finite number"),
        ([*swerve()[:3], swerve()[3] | {"x": True}], {}, "x of sample 3 of"),
        ([*swerve()[:3], swerve()[3] | {"x": 10**400}], {}, "x of sample 3 of"),
        ([*swerve()[:3], swerve()[2]], {}, "t of .*loop.traj.*monotone"),
    ],
)
def test_what_is_no_trajectory(written, samples, more, words):
    with pytest.raises(InvalidValue, match=words):
        read_choreo(written(samples, **more))


def test_a_path_of_another_program(tmp_path):
    path = tmp_path / "some.traj"
    for content in (b"[]", b"{}", b"null", b"x", b""):
        path.write_bytes(content)
        with pytest.raises(InvalidValue, match=r"some\.traj"):
            read_choreo(path)
