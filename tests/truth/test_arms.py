"""Arms against values that were made without them; ``tools/truth_arms.py`` is the generator."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from mpmath import mp, mpf

from coplanar import Pose
from coplanar.arms import Arm, Reach
from coplanar.engine import evaluator
from coplanar.laws import arms as laws
from tests.engines import ARRAY_ENGINES, on_engine

TRUTH = json.loads((Path(__file__).parent / "arms.json").read_text())
TOLERANCE = TRUTH["tolerance"]


def arm_of(row):
    poses = {k: Pose(*row[k]) for k in ("base", "tool") if k in row}
    return Arm(row["links"], joints=row["joints"], angles=row["angles"], bends=row.get("bends"), **poses)


@pytest.mark.parametrize("engine", ["floats", *ARRAY_ENGINES])
def test_two_link_inverse_to_the_last_digits_where_it_is_well_conditioned(engine):
    given = np.array([c["given"] for c in TRUTH["inverse"]]).T
    if engine == "floats":
        answers = np.array([evaluator(laws.two_link_inverse)(*row) for row in given.T.tolist()]).T
    else:
        answers = on_engine(engine, laws.two_link_inverse, *given)
    with mp.workdps(30):
        for case, q1, q2 in zip(TRUTH["inverse"], *answers, strict=True):
            turn = abs(mpf(float(q1)) - mpf(case["q"][0]))
            errors = min(turn, abs(turn - 2 * mp.pi)), abs(mpf(float(q2)) - mpf(case["q"][1]))
            # An error eps in the radius is eps/sin q2 in the joints, whatever the formula.
            assert max(errors) * case["sine"] < TOLERANCE["inverse_times_sine"], case


def test_two_link_inverse_puts_the_tip_on_the_target_even_where_the_joints_are_ill_conditioned():
    x, y, l1, l2, elbow = np.array([c["given"] for c in TRUTH["inverse"]]).T
    q1, q2 = evaluator(laws.two_link_inverse)(x, y, l1, l2, elbow)
    tip = evaluator(laws.two_link)(q1, q2, l1, l2)
    assert np.hypot(tip[0] - x, tip[1] - y).max() < TOLERANCE["inverse_times_sine"]
    assert min(c["sine"] for c in TRUTH["inverse"]) < 1e-6


@pytest.mark.parametrize("case", TRUTH["jacobian"], ids=lambda c: f"{c['arm']['joints']}-{c['arm']['angles']}")
def test_tip_and_jacobians_are_those_of_symbolic_differentiation(case):
    arm = arm_of(case["arm"])
    q, rate = case["q"], case["q_rate"]
    pairs = [
        (arm.forward(q).as_array(), case["tip"]),
        (arm.jacobian(q), case["jacobian"]),
        (arm.jacobian_dot(q, rate), case["jacobian_dot"]),
        (arm.jacobian_dot(q, rate, task="position"), case["jacobian_dot"][:2]),
    ]
    for ours, truth in pairs:
        assert np.allclose(ours, truth, rtol=TOLERANCE["jacobian"], atol=10 * TOLERANCE["jacobian"])


def test_the_demo_ends_on_a_branch_of_the_one_that_minpack_finds():
    demo = TRUTH["demo"]
    arm = Arm(demo["links"])
    ours = arm.inverse(demo["target"], near=demo["start"], method="numerical", tolerance=1e-12).or_raise()
    both = arm.inverse(demo["target"]).branches
    for q in (ours.q, np.array(demo["q_wrapped"])):
        assert np.abs(both - q).max(axis=1).min() < TOLERANCE["demo"]


@pytest.mark.parametrize("case", TRUTH["limited"], ids=lambda c: f"{c['angles']}-{c['target']}")
def test_nearest_point_within_limits_is_that_of_a_bounded_minimiser(case):
    arm = Arm(case["links"], angles=case["angles"], limits=case["limits"])
    answer = arm.inverse(case["target"])
    assert answer.gap == pytest.approx(case["distance"], abs=TOLERANCE["limited"])
    assert answer.position_error() == pytest.approx(answer.gap, abs=1e-12)
    assert arm.is_within_limits(answer.q)
    assert answer.reached == (answer.status is Reach.REACHED)
