"""Wheeled bases against WPILib, and against 50-digit least squares written from the directions of the wheels."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.special import chdtri

from coplanar.se2 import Twist
from coplanar.wheels import Wheel, WheeledBase

WPIMATH = json.loads((Path(__file__).parent / "wheels_wpimath.json").read_text(encoding="utf-8"))
MPMATH = json.loads((Path(__file__).parent / "wheels_mpmath.json").read_text(encoding="utf-8"))


def base_of(kind, case):
    if kind == "differential":
        return WheeledBase.differential(track=case["track"], radius=case["radius"])
    return WheeledBase.mecanum(
        radius=case["radius"], half_length=case["half_length"], half_width=case["half_width"], rollers="X"
    )


@pytest.mark.parametrize("kind", ["differential", "mecanum"])
def test_wpimath(kind):
    tolerance = WPIMATH["tolerance"]
    for case in WPIMATH[kind]:
        base, r = base_of(kind, case), case["radius"]
        wanted = base.inverse(Twist(*case["wanted"]))
        np.testing.assert_allclose(
            base.forward(np.array(case["speeds"]) / r).as_array(), case["twist"], rtol=0, atol=tolerance
        )
        np.testing.assert_allclose(r * wanted, case["wheels"], rtol=0, atol=tolerance)
        slower = base.saturate(wanted, case["limit"] / r)
        np.testing.assert_allclose(r * slower.rates, case["desaturated"], rtol=0, atol=tolerance)


@pytest.mark.parametrize("case", MPMATH["layouts"], ids=lambda case: f"{len(case['wheels'])} wheels")
def test_any_layout(case):
    base = WheeledBase([Wheel(*wheel) for wheel in case["wheels"]])
    # The inverse is rounded once; its entries, and with them the rounding of the sums, grow with the condition.
    tolerance = MPMATH["tolerance"] * case["condition"]
    np.testing.assert_allclose(base.forward(case["rates"]).as_array(), case["forward"], rtol=0, atol=tolerance)
    np.testing.assert_allclose(base.residual(case["rates"]), case["residual"], rtol=0, atol=tolerance)
    np.testing.assert_allclose(base.inverse(Twist(*case["twist"])), case["inverse"], rtol=1e-12, atol=1e-12)


def test_slip_threshold():
    for degrees, false_alarm, threshold in MPMATH["chi_square"]:
        base = WheeledBase.omni(degrees + 3, wheel_distance=0.2, radius=0.05)
        slip = base.slip(np.zeros(degrees + 3), 0.1, false_alarm=false_alarm)
        assert slip.degrees == degrees
        assert slip.threshold == pytest.approx(threshold, rel=1e-12)
        assert slip.threshold == chdtri(degrees, false_alarm)
