"""Motion against mpmath, pyclothoids, SciPy and WPILib; tools/truth_motion.py writes the golden files."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from coplanar import Pose
from coplanar.laws import motion as laws
from coplanar.motion import Odometry, Segment
from tests.engines import ARRAY_ENGINES, on_engine, on_floats


def truth(name):
    document = json.loads((Path(__file__).parent / f"motion_{name}.json").read_text())
    return document["cases"], document["tolerance"]


def segment_on(engine, *args):
    return on_floats(laws.segment, *args) if engine == "floats" else on_engine(engine, laws.segment, *args)


def column(cases, key):
    return np.array([case[key] for case in cases])


@pytest.mark.parametrize("engine", ["floats", *ARRAY_ENGINES])
def test_segments_per_metre(engine):
    cases, tolerance = truth("segments")
    command, end = column(cases, "command"), column(cases, "end")
    x, y, theta = segment_on(engine, 0.0, 0.0, 0.0, *command.T)
    v, omega, a, alpha, t = command.T
    way = np.maximum(1.0, np.abs(v) * t + 0.5 * np.abs(a) * t * t)  # [m]
    assert np.all(np.hypot(x - end[:, 0], y - end[:, 1]) <= tolerance * way)
    np.testing.assert_allclose(theta, omega * t + 0.5 * alpha * t * t, rtol=tolerance, atol=tolerance)


def test_segments_lateral_part_keeps_its_digits():
    """For a turn of less than 0.1 rad the lateral part is small, and still right to 14 digits of its own."""
    cases, tolerance = truth("segments")
    command, end = column(cases, "command"), column(cases, "end")
    gentle = (np.abs(command[:, [1, 3]]).max(axis=1) <= 1e-2) & (end[:, 1] != 0.0)
    _, y, _ = segment_on("floats", 0.0, 0.0, 0.0, *command[gentle].T)
    # Where omega and alpha bend opposite ways the two parts cancel in the true answer as well.
    bends = np.sign(command[gentle, 1]) * np.sign(command[gentle, 3]) >= 0
    assert np.abs(end[gentle, 1]).min() < 1e-12
    np.testing.assert_allclose(y[bends], end[gentle, 1][bends], rtol=tolerance, atol=0.0)


@pytest.mark.parametrize("engine", ["floats", *ARRAY_ENGINES])
def test_jacobians(engine):
    cases, tolerance = truth("jacobians")
    v, omega, a, alpha, t = column(cases, "command").T
    args = (laws.segment_jacobian, 0.0 * v, v, omega, a, alpha, t)
    got = on_floats(*args) if engine == "floats" else on_engine(engine, *args)
    for i, key in enumerate(("by_v", "by_omega", "by_a", "by_alpha")):
        np.testing.assert_allclose(np.stack(got[2 * i : 2 * i + 2], -1), column(cases, key), rtol=0.0, atol=tolerance)


def test_clothoids():
    cases, tolerance = truth("clothoids")
    for case in cases:
        speed = 2.0
        spiral = Segment(speed, speed * case["curvature"], 0.0, speed * speed * case["rate"], duration=10.0)
        poses = spiral.pose(Pose.from_array(case["start"]), np.array(case["at"]) / speed)
        np.testing.assert_allclose(poses.as_array(), case["poses"], rtol=0.0, atol=tolerance)


def test_odes():
    cases, tolerance = truth("odes")
    cusps = 0
    for case in cases:
        segment = Segment(*case["command"], duration=2.0)
        cusps += segment.cusp_time < np.inf
        poses = segment.pose(Pose.from_array(case["start"]), case["at"])
        np.testing.assert_allclose(poses.as_array(), case["poses"], rtol=0.0, atol=tolerance)
    assert cusps > 10


def test_wheels():
    cases, tolerance = truth("wheels")
    for case in cases:
        left, right = np.array(case["ways"]).T
        path = Odometry.from_wheels(left, right, track=case["track"]).path(Pose.from_array(case["start"]))
        np.testing.assert_allclose(path.wrapped.as_array()[1:], case["poses"], rtol=0.0, atol=tolerance)
