"""Arms: what they refuse, what they say, and the places where textbook answers break."""

from __future__ import annotations

import math
from dataclasses import FrozenInstanceError

import numpy as np
import pytest

from coplanar import Pose
from coplanar.arms import Arc, Arm, Reach
from coplanar.errors import InvalidShape, InvalidValue, NoSolution, UnknownName

ELBOW_ARM = Arm((1.0, 1.0))


@pytest.mark.parametrize(
    ("build", "error", "text"),
    [
        (lambda: Arm((1.0, -0.8)), InvalidValue, "links .* needed 0 or more"),
        (lambda: Arm((1.0, 0.0)), InvalidValue, "greater than 0 at a revolute joint"),
        (lambda: Arm((1.0, float("nan"))), InvalidValue, "links"),
        (lambda: Arm((1.0, float("inf"))), InvalidValue, "links"),
        (lambda: Arm(()), InvalidShape, "at least one"),
        (lambda: Arm([[1.0, 2.0]]), InvalidShape, "vector of lengths|one letter a link|links"),
        (lambda: Arm((1.0, 1.0), joints="RX"), UnknownName, "one of P, R"),
        (lambda: Arm((1.0, 1.0), joints="R"), InvalidShape, "1 joints for 2 links"),
        (lambda: Arm((1.0, 1.0), joints=2), InvalidValue, "a word such as"),
        (lambda: Arm((1.0, 1.0), angles="relatives"), UnknownName, "did you mean 'relative'"),
        (lambda: Arm((1.0, 1.0), limits=[(0.0, 1.0)]), InvalidShape, "a pair for every joint"),
        (lambda: Arm((1.0, 1.0), limits=[(1.0, 0.0), None]), InvalidValue, "lower <= upper"),
        (lambda: Arm((1.0, 1.0), limits=[(float("nan"), 0.0), None]), InvalidValue, "not NaN"),
        (lambda: Arm((1.0, 1.0), limits=["ab", None]), InvalidValue, "a pair"),
        (lambda: Arm((1.0, 1.0), bends=(0.1,)), InvalidShape, "an angle for every link"),
        (lambda: Arm((1.0, 1.0), base=(0.0, 0.0, 0.0)), InvalidValue, "base .* a Pose"),
        (lambda: Arm((1.0, 1.0), tool=Pose(np.zeros(2), 0.0, 0.0)), InvalidShape, "make an arm for each"),
    ],
)
def test_what_is_no_arm_is_refused(build, error, text):
    with pytest.raises(error, match=text):
        build()


@pytest.mark.parametrize(
    ("ask", "error", "text"),
    [
        (lambda arm: arm.forward([0.0]), InvalidShape, "one value for each of the 2 joints"),
        (lambda arm: arm.forward([0.0, float("nan")]), InvalidValue, "q"),
        (lambda arm: arm.jacobian([0.0, 0.0], task="positions"), UnknownName, "did you mean 'position'"),
        (lambda arm: arm.jacobian_dot(np.zeros((3, 2)), np.zeros((2, 2))), InvalidShape, "broadcast"),
        (lambda arm: arm.torques([0.0, 0.0], [1.0]), InvalidShape, "wrench"),
        (lambda arm: arm.torques([0.0, 0.0], [1.0, np.inf]), InvalidValue, "wrench"),
        (lambda arm: arm.torques(np.zeros((3, 2)), np.zeros((2, 2))), InvalidShape, "broadcast"),
        (lambda arm: arm.ellipse([0.0, 0.0], kind="speed"), UnknownName, "velocity"),
        (lambda arm: arm.ellipse([0.0, 1.0], task="pose").outline(), InvalidShape, "position"),
        (lambda arm: arm.rates([0.0, 0.0], [1.0, 0.0, 0.0]), InvalidShape, "velocity"),
        (lambda arm: arm.rates([0.0, 0.0], [1.0, 0.0], damping=-1.0), InvalidValue, "damping"),
        (lambda arm: arm.inverse([1.0, 0.0, 0.0]), InvalidShape, "pass a Pose"),
        (lambda arm: arm.inverse([1.0, np.inf]), InvalidValue, "target"),
        (lambda arm: arm.inverse([1.0, 0.0], elbow=0), InvalidValue, r"\+1 or -1"),
        (lambda arm: arm.inverse([1.0, 0.0], near=[0.0]), InvalidShape, "near"),
        (lambda arm: arm.inverse(np.ones((3, 2)), near=np.ones((2, 2))), InvalidShape, "broadcast"),
        (lambda arm: arm.inverse([1.0, 0.0], tolerance=-1.0), InvalidValue, "tolerance"),
        (lambda arm: arm.inverse([1.0, 0.0], method="newton"), UnknownName, "numerical"),
        (lambda arm: arm.inverse(Pose(1.0, 0.0, 0.0), method="closed"), UnknownName, "closed"),
    ],
)
def test_what_cannot_be_answered_is_refused(ask, error, text):
    with pytest.raises(error, match=text):
        ask(ELBOW_ARM)


def test_an_arm_is_frozen_and_equal_to_its_like():
    with pytest.raises(FrozenInstanceError):
        ELBOW_ARM.links = (2.0, 2.0)
    assert Arm([1, 1]) == ELBOW_ARM
    assert Arm((1.0, 1.0), angles="absolute") != ELBOW_ARM
    assert hash(Arm((1.0, 1.0), limits=[(0, 1), None])) == hash(Arm((1.0, 1.0), limits=[(0.0, 1.0), None]))


def test_relative_and_absolute_angles_are_two_names_of_one_posture():
    relative, absolute = Arm((1.0, 0.8, 0.3)), Arm((1.0, 0.8, 0.3), angles="absolute")
    q = np.array([0.3, -0.7, 1.1])
    assert np.allclose(relative.points(q), absolute.points(np.cumsum(q)), atol=1e-15)
    assert not np.allclose(relative.points(q), absolute.points(q), atol=1e-2)


def test_a_slide_adds_to_its_link_and_keeps_the_direction_before_it():
    arm = Arm((1.0, 0.5), joints="RP")
    assert np.allclose(arm.forward([np.pi / 2, 0.25]).position, [0.0, 1.75])
    gantry = Arm((0.0, 0.0), joints="PP", bends=(0.0, np.pi / 2))
    assert np.allclose(gantry.forward([[2.0, 3.0], [1.0, 0.5]]).position, [[2.0, 3.0], [1.0, 0.5]])
    assert gantry.jacobian(np.zeros((4, 2))).shape == (4, 3, 2)
    assert np.allclose(gantry.inverse([[2.0, 3.0], [1.0, 0.5]]).q, [[2.0, 3.0], [1.0, 0.5]])


def test_points_hold_the_tool_only_where_it_stands_off_the_end():
    assert ELBOW_ARM.points(np.zeros((5, 2))).shape == (5, 3, 2)
    assert Arm((1.0, 1.0), tool=Pose(0.0, 0.0, 1.0)).points([0.0, 0.0]).shape == (3, 2)
    tooled = Arm((1.0, 1.0), tool=Pose(0.1, 0.2, 0.0)).points([0.0, 0.0])
    assert tooled.tolist() == [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.1, 0.2]]


def test_manipulability_uses_the_rows_of_the_task():
    q = [0.3, 1.0]
    pose = ELBOW_ARM.jacobian(q)
    assert np.linalg.det(pose @ pose.T) == pytest.approx(0.0, abs=1e-15)
    assert ELBOW_ARM.manipulability(q) == pytest.approx(np.sin(1.0))
    assert ELBOW_ARM.manipulability(q, task="pose") == pytest.approx(np.sqrt(np.linalg.det(pose.T @ pose)))
    assert ELBOW_ARM.manipulability([q, [0.0, 0.0]])[1] == pytest.approx(0.0, abs=1e-15)


def test_a_force_ellipse_is_unbounded_where_the_arm_is_singular():
    force = ELBOW_ARM.ellipse([0.0, 0.0], kind="force")
    assert force.radii[0] > 1e15
    assert force.angle == pytest.approx(0.0, abs=1e-12)
    assert Arm((1.0,)).ellipse([0.0], kind="force").radii[0] == np.inf


@pytest.mark.parametrize(
    ("target", "status", "gap", "nearest"),
    [
        ((3.0, 0.0), Reach.TOO_FAR, 1.2, (1.8, 0.0)),
        ((0.0, -2.8), Reach.TOO_FAR, 1.0, (0.0, -1.8)),
        ((0.1, 0.0), Reach.TOO_CLOSE, 0.1, (0.2, 0.0)),
        ((0.0, -0.05), Reach.TOO_CLOSE, 0.15, (0.0, -0.2)),
    ],
)
@pytest.mark.parametrize("method", ["auto", "numerical"])
@pytest.mark.parametrize("links", [(1.0, 0.8), (0.8, 1.0)])
def test_out_of_reach_answers_with_the_nearest_point_and_the_gap(target, status, gap, nearest, method, links):
    answer = Arm(links).inverse(target, method=method)
    assert answer.status is status
    assert answer.gap == pytest.approx(gap)
    assert np.allclose(answer.nearest, nearest)
    assert answer.conditioning() == pytest.approx(0.0, abs=1e-12)
    with pytest.raises(NoSolution, match="ring") as refusal:
        answer.or_raise()
    assert refusal.value.result is answer


def test_a_target_a_little_beyond_the_reach_is_reached_within_the_stated_tolerance():
    beyond = (2.0 + 1e-7, 0.0)
    strict, lenient = ELBOW_ARM.inverse(beyond), ELBOW_ARM.inverse(beyond, tolerance=1e-6)
    assert strict.status is Reach.TOO_FAR
    assert lenient.status is Reach.REACHED
    assert lenient.gap == strict.gap == pytest.approx(1e-7)


@pytest.mark.parametrize("target", [(0.0, 0.0), (1e-17, -1e-12)])
def test_on_the_base_an_equal_armed_elbow_folds_and_the_first_joint_keeps_its_place(target):
    answer = ELBOW_ARM.inverse(target, near=(0.7, 3.0))
    assert answer.status is Reach.FIRST_JOINT_FREE
    assert answer.reached
    assert answer.q.tolist() == pytest.approx([0.7, np.pi])
    assert "free" in answer.sentence()
    assert ELBOW_ARM.inverse(target).q[0] == 0.0


def test_next_to_the_base_of_unequal_links_the_hole_is_left_towards_the_target():
    for target in ((0.0, 0.0), (0.0, 1e-10), (0.0, -1e-10)):
        hole = Arm((1.0, 0.8)).inverse(target)
        assert hole.status is Reach.TOO_CLOSE
        assert hole.gap == pytest.approx(0.2 - np.hypot(*target), abs=1e-15)
        assert hole.position_error() == pytest.approx(hole.gap, abs=1e-15)


def test_next_to_the_base_of_an_equal_armed_elbow_the_tip_is_exact():
    for r in 10.0 ** -np.arange(1, 17):
        answer = ELBOW_ARM.inverse((r, r), tolerance=0.0)
        assert answer.position_error() < 1e-15


def test_near_full_stretch_the_conditioning_says_what_a_digit_is_worth():
    stretch = ELBOW_ARM.inverse((2.0 - 1e-12, 0.0))
    assert stretch.reached
    assert stretch.singular_value() < 1e-6
    # One rounding of the radius moves the joints by about eps/sin q2, more than 1e-11 here.
    other = ELBOW_ARM.inverse((np.nextafter(2.0 - 1e-12, 0.0), 0.0))
    assert 1e-11 < abs(stretch.q[1] - other.q[1]) < 1e-9
    assert ELBOW_ARM.inverse((1.0, 1.0)).conditioning() > 0.3


def test_branches_are_chosen_by_continuity_of_unwrapped_joints():
    target = (1.0, 1.0)
    up, down = ELBOW_ARM.inverse(target).branches
    assert np.allclose(ELBOW_ARM.inverse(target, near=down + 0.2).q, down)
    wound = down + np.array([4 * np.pi, -2 * np.pi])
    turned = ELBOW_ARM.inverse(target, near=wound)
    assert np.allclose(turned.q, wound)
    assert turned.elbow == -1
    assert np.allclose(ELBOW_ARM.inverse(target, near=down, elbow=1).q, up)


def test_elbow_is_the_sign_of_the_sine_and_not_up_or_down():
    left, right = ELBOW_ARM.inverse((1.2, 0.3), elbow=1), ELBOW_ARM.inverse((-1.2, 0.3), elbow=1)
    height = [a.chain.points(a.q)[1][1] - 0.5 * a.target[1] for a in (left, right)]
    assert height[0] < 0.0 < height[1]
    assert np.sin(left.q[1]) > 0.0
    assert np.sin(right.q[1]) > 0.0


def test_limits_take_part_in_the_choice_of_the_branch_and_of_the_turn():
    target = (1.0, 1.0)
    up = Arm((1.0, 1.0), limits=[None, (-3.0, -0.1)]).inverse(target)
    assert up.elbow == -1
    assert up.allowed.tolist() == [False, True]
    wound = Arm((1.0, 1.0), limits=[(6.0, 8.0), (0.0, 3.0)]).inverse(target)
    assert wound.reached
    assert wound.q == pytest.approx([2 * np.pi, np.pi / 2])
    preferred = Arm((1.0, 1.0), limits=[None, (-3.0, -0.1)]).inverse(target, elbow=1)
    assert preferred.elbow == -1


@pytest.mark.parametrize("angles", ["relative", "absolute"])
def test_a_target_on_the_very_limit_is_reached(angles):
    arm = Arm((1.0, 0.7), angles=angles, limits=[(-0.5, 1.2), (0.3, 2.0)])
    corners = [(a, b) for a in (-0.5, 1.2) for b in (0.3, 2.0)]
    answer = arm.inverse(arm.forward(corners).position)
    assert answer.reached.all()
    assert arm.is_within_limits(answer.q).all()


def test_limits_that_keep_the_tool_away_answer_with_the_nearest_posture():
    arm = Arm((1.0, 1.0), limits=[(0.0, 1.0), (0.5, 2.0)])
    answer = arm.inverse([[-1.0, -1.0], [1.0, 1.0]])
    assert [s.name for s in answer.status] == ["OUTSIDE_LIMITS", "REACHED"]
    assert answer.gap[0] > 0.0
    assert arm.is_within_limits(answer.q).all()
    with pytest.raises(NoSolution, match="OUTSIDE_LIMITS"):
        answer.or_raise()


def test_three_links_within_limits_search_for_the_nearest_pose_or_say_what_stops_them():
    arm = Arm((1.0, 0.8, 0.4), limits=[(-1.0, 1.0)] * 3)
    answer = arm.inverse(Pose(-1.0, 0.0, 3.0))
    assert answer.status is Reach.STOPPED_BY_LIMITS
    assert arm.is_within_limits(answer.q)
    assert answer.gap == pytest.approx(answer.position_error())
    reached = arm.inverse(arm.forward([0.9, -0.9, 0.9]))
    assert reached.reached


def test_three_links_answer_with_the_nearest_position_at_the_wanted_heading():
    answer = Arm((1.0, 1.0, 0.5)).inverse(Pose(3.5, 0.0, 0.0))
    assert answer.status is Reach.TOO_FAR
    assert answer.gap == pytest.approx(1.0)
    assert answer.heading_error() == pytest.approx(0.0, abs=1e-15)
    assert np.allclose(answer.nearest, [2.5, 0.0])


def test_two_links_cannot_choose_a_heading_and_say_what_is_left():
    answer = ELBOW_ARM.inverse(Pose(1.0, 1.0, 0.5))
    assert answer.status is Reach.STALLED
    assert answer.position_error() > 1e-3
    assert abs(answer.heading_error()) > 1e-3
    square = Pose(1.0, 1.0, np.pi / 2)
    assert ELBOW_ARM.inverse(square).reached


def test_a_spent_budget_says_so():
    answer = Arm((1.0, 0.8, 0.5)).inverse((0.4, 0.9), iterations=1)
    assert answer.status is Reach.BUDGET_SPENT
    assert not answer.reached


def test_the_demo_reports_every_iteration_and_ends_with_a_sentence():
    answer = Arm((0.5, 0.5)).inverse((0.5, 0.0), near=(0.1, 0.1), method="numerical", tolerance=1e-12)
    assert answer.reached
    assert answer.position_error() < 1e-12
    assert [i.number for i in answer.report] == list(range(answer.iterations + 1))
    assert answer.report[0].x == (0.1, 0.1)
    norms = [i.residual for i in answer.report]
    assert norms == sorted(norms, reverse=True)
    assert answer.report[-1].residual == pytest.approx(answer.position_error(), abs=1e-15)
    assert len(answer.report.table().splitlines()) == len(answer.report) + 1
    assert answer.sentence().startswith("the tool is at the target")


def test_batches_and_single_targets_answer_alike():
    targets = np.array([[[1.0, 0.5], [3.0, 0.0]], [[0.0, 0.0], [-1.0, 0.2]]])
    for arm, method in ((ELBOW_ARM, "auto"), (Arm((1.0, 0.6, 0.4)), "numerical")):
        batch = arm.inverse(targets, method=method)
        assert batch.q.shape == (2, 2, arm.n)
        for index in np.ndindex(2, 2):
            one = arm.inverse(targets[index], method=method)
            assert one.status is batch.status[index]
            assert isinstance(one.gap, float)
            assert np.allclose(arm.forward(one.q).position, arm.forward(batch.q[index]).position, atol=1e-8)
    assert ELBOW_ARM.inverse(np.zeros((0, 2))).q.shape == (0, 2)
    assert Arm((1.0, 1.0, 1.0)).inverse(np.zeros((0, 2))).q.shape == (0, 3)


def test_exact_rates_grow_as_one_over_the_sine_and_damped_ones_lag_instead():
    away = np.array([1e-1, 1e-2, 1e-3, 1e-4])
    q = np.stack((np.zeros(4), away), axis=-1)
    rates = ELBOW_ARM.rates(q, [0.1, 0.0], damping=0.01)
    grown = np.abs(rates.exact[:, 1]) * np.sin(away)
    assert np.allclose(grown, grown[0], rtol=1e-2)
    assert np.abs(rates.damped).max() <= 0.1 / (2 * 0.01)
    assert np.abs(rates.exact_error()).max() < 1e-11
    bias = np.linalg.norm(rates.damped_error(), axis=-1)
    assert np.all(np.diff(bias) > 0.0)
    assert bias[-1] == pytest.approx(0.1, rel=1e-2)


def test_at_a_singular_posture_the_rates_say_that_the_rank_is_lost():
    rates = ELBOW_ARM.rates([0.0, 0.0], [0.1, 0.2])
    assert not rates.exists
    assert rates.rank == 1
    assert np.isfinite(rates.exact).all()
    assert np.allclose(rates.exact_error(), [-0.1, 0.0])
    assert ELBOW_ARM.rates([0.0, 1.0], [0.1, 0.2]).exists


def test_workspace_with_limits_is_exact_for_two_links_and_sampled_for_more():
    half = Arm((1.0, 1.0), limits=[(0.0, np.pi), (0.0, np.pi)]).workspace()
    assert half.exact
    assert half.outer == pytest.approx(2.0)
    assert half.inner == pytest.approx(0.0, abs=1e-12)
    assert half.contains([[0.0, 1.5], [0.0, -1.5]]).tolist() == [True, False]
    more = Arm((1.0, 0.6, 0.4), limits=[(-1.0, 1.0)] * 3).workspace()
    assert not more.exact
    assert more.arcs == ()
    assert more.outer == pytest.approx(2.0)
    far, near = more.boundary()
    assert np.hypot(*far.T).max() <= 2.0 + 1e-12
    assert np.hypot(*near.T).min() == pytest.approx(more.inner)
    slide = Arm((0.5, 0.5), joints="RP", limits=[None, (0.0, 0.5)]).workspace()
    assert (slide.inner, slide.outer) == pytest.approx((1.0, 1.5))
    with pytest.raises(InvalidValue, match="no bound"):
        Arm((0.5, 0.5), joints="RP").workspace()


def test_the_boundary_of_limited_links_separates_reach_from_no_reach():
    arm = Arm((1.0, 0.7), base=Pose(0.1, 0.2, 0.3), limits=[(-0.5, 1.2), (0.3, 2.0)])
    for arc in arm.workspace().arcs:
        middle = np.array(arc.start + 0.5 * arc.sweep)
        sides = np.stack([arc.at(middle, outwards=d) for d in (-1e-4, 1e-4)])
        assert sorted(arm.workspace().contains(sides).tolist()) == [False, True]
    assert isinstance(arm.workspace().arcs[0], Arc)


def test_results_of_one_posture_are_plain_floats():
    assert isinstance(ELBOW_ARM.manipulability([0.0, 1.0]), float)
    assert isinstance(ELBOW_ARM.forward([0.0, 1.0]).x, float)
    answer = ELBOW_ARM.inverse((1.0, 0.5))
    for value in (answer.gap, answer.position_error(), answer.heading_error(), answer.conditioning()):
        assert isinstance(value, float)
    assert isinstance(answer.elbow, int)


@pytest.mark.parametrize("target", [(1e160, 1e160), (-1e200, 0.0), (0.0, 1e308), (1e-200, 0.0), (0.0, -5e-324)])
@pytest.mark.parametrize("rows", [0, 3, 30_000])
def test_targets_of_any_size_get_a_direction_and_no_nan(target, rows):
    answer = ELBOW_ARM.inverse(np.broadcast_to(target, (rows, 2)) if rows else target)
    joints = answer.branches.reshape(-1, 2, 2)[-1]
    assert np.all(np.isfinite(joints))
    if max(map(abs, target)) > 1.0:
        assert joints[:, 0] == pytest.approx([math.atan2(target[1], target[0])] * 2, abs=1e-15)
        assert joints[:, 1] == pytest.approx([0.0, 0.0])
    else:
        assert np.abs(joints[:, 1]) == pytest.approx([math.pi] * 2)
