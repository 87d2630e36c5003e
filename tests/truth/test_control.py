"""Curves, poles and closed loops against 50 digits."""

from __future__ import annotations

import math

import numpy as np
import pytest

from coplanar.control import PointTracker, Unicycle
from coplanar.curves import Astroid, Circle, Ellipse, Lemniscate
from coplanar.simulation import simulate
from tests.truth.golden import golden

TRUTH = golden("control")
CURVES = {"circle": Circle, "ellipse": Ellipse, "lemniscate": Lemniscate, "astroid": Astroid}


@pytest.mark.parametrize("case", TRUTH.of("curve"), ids=lambda c: f"{c['curve']}-{c['parameter']}")
def test_curves(case):
    curve = CURVES[case["curve"]](*case["sizes"])
    phi = case["parameter"]
    ours = [curve.position(phi), curve.derivative(phi), curve.second_derivative(phi)]
    np.testing.assert_allclose(ours, case["derivatives"], rtol=0, atol=TRUTH.tolerance["curve"])


@pytest.mark.parametrize("case", TRUTH.of("poles"), ids=lambda c: f"{c['kp']}-{c['kd']}-{c['ki']}")
def test_poles(case):
    poles = PointTracker((0.1, 0.0), case["kp"], case["kd"], case["ki"]).stability(case["step"]).poles
    ours = sorted([z.real, z.imag] for z in poles)
    np.testing.assert_allclose(ours, case["poles"], rtol=0, atol=TRUTH.tolerance["poles"])


@pytest.mark.parametrize("case", TRUTH.of("loop"), ids=lambda c: c["method"])
def test_closed_loops(case):
    tracker = PointTracker(case["point"], case["kp"], case["kd"], case["ki"], error_against="next")
    start = tracker.pose_for((1.0, 0.0), heading=0.5 * math.pi)
    run = simulate(Unicycle(), tracker, Astroid(1.0).over(10.0), step=case["step"], method=case["method"], start=start)
    rows = np.array(case["rows"])
    ours = run.stacked("x", "y", "theta", "v", "omega", "ex", "ey")[rows[:, 0].astype(int)]
    np.testing.assert_allclose(ours, rows[:, 1:], rtol=0, atol=TRUTH.tolerance["loop"])
