"""Arms along curves: one branch by continuity, singular points, limits, exact intervals of failure."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar import Pose
from coplanar.arms import Arm
from coplanar.curves import Astroid, Circle, FreeCurve, Lemniscate, Line, Polyline
from coplanar.errors import InvalidShape, InvalidValue, NoSolution, UnknownName
from coplanar.tracing import Reason, TraceStatus, trace

EQUAL = Arm((1.0, 1.0))
CIRCLE = Circle(0.5, center=(1.0, 0.5))
LEMNISCATE = Lemniscate(1.0)


def test_the_circle_demo():
    answer = trace(EQUAL, CIRCLE, 51, near=(0.5, 0.5))
    assert answer.status is TraceStatus.FOLLOWED
    assert answer.or_raise() is answer
    assert answer.q.shape == (51, 2)
    shown = answer.certificate
    assert shown.elbows == (1,)
    assert shown.position_error < 1e-14
    assert shown.limits_kept
    assert shown.limit_margin == math.inf
    # |sin q2| = r sqrt(4 - r^2)/2 with unit links, at the point farthest from where r^2 = 2.
    r = np.array([math.hypot(1.0, 0.5) - 0.5, math.hypot(1.0, 0.5) + 0.5])
    assert shown.smallest_sine == pytest.approx((0.5 * r * np.sqrt(4.0 - r * r)).min(), abs=1e-14)
    assert shown.largest_step == pytest.approx(np.abs(np.diff(answer.q, axis=0)).max(), abs=1e-15)
    np.testing.assert_allclose(answer.q[-1], answer.q[0], atol=1e-13)
    np.testing.assert_allclose(answer.position_error(), 0.0, atol=1e-14)


def test_the_lemniscate_stops_where_it_cannot():
    answer = trace(EQUAL, LEMNISCATE, 201)
    assert answer.status is TraceStatus.FAILED
    (failure,) = answer.failures
    assert failure.reason is Reason.SINGULAR
    assert failure.first == pytest.approx(0.5 * math.pi, abs=1e-15)
    assert failure.last == math.tau
    assert answer.singular_points[0].kind == "base"
    assert answer.followed.sum() == 51
    assert (answer.q[51:] == answer.q[50]).all()
    with pytest.raises(NoSolution, match="branches meet") as caught:
        answer.or_raise()
    assert caught.value.result is answer


def test_the_lemniscate_straight_through():
    answer = trace(EQUAL, LEMNISCATE, 201, at_singular="through")
    assert answer.status is TraceStatus.PASSED
    assert [p.kind for p in answer.singular_points] == ["base", "base"]
    np.testing.assert_allclose(
        [p.parameter for p in answer.singular_points], [0.5 * math.pi, 1.5 * math.pi], atol=1e-14
    )
    assert all(abs(p.turn) < 1e-12 for p in answer.singular_points)
    shown = answer.certificate
    assert shown.elbows == (1, -1, 1)
    assert shown.smallest_sine < 1e-15
    assert shown.position_error < 1e-14
    assert shown.largest_step < 0.05
    # Smooth: second differences stay as small as steps squared.
    assert np.abs(np.diff(answer.q, 2, axis=0)).max() < 2.0 * shown.largest_step**2
    # On the base the second joint is folded and the first stands across the tangent.
    np.testing.assert_allclose(answer.q[50], [-0.25 * math.pi, math.pi], atol=1e-12)


@pytest.mark.parametrize("count", [200, 77, 1001])
def test_the_singular_point_is_found_between_the_parameters(count):
    stopped = trace(EQUAL, LEMNISCATE, count)
    assert stopped.failures[0].first == pytest.approx(0.5 * math.pi, abs=1e-14)
    through = trace(EQUAL, LEMNISCATE, count, at_singular="through")
    assert through.certificate.largest_step < 0.05 * 201 / count + 1e-3
    assert through.certificate.smallest_sine < 1e-15


def test_the_limit_on_the_base_comes_from_the_curve():
    """The rows beside the base approach the row on it."""
    phi = 0.5 * math.pi + np.array([-1e-3, -1e-5, 0.0, 1e-5, 1e-3])
    for elbow in (1, -1):
        q = trace(EQUAL, LEMNISCATE, phi, elbow=elbow, at_singular="through").q
        np.testing.assert_allclose(q[1], q[2], atol=1e-4)
        np.testing.assert_allclose(q[3], q[2], atol=1e-4)
        np.testing.assert_allclose(0.5 * (q[0] + q[4]), q[2], atol=1e-5)


def test_keeping_the_elbow_on_the_base_costs_half_a_turn():
    answer = trace(EQUAL, LEMNISCATE, 201, at_singular="bounce")
    assert answer.certificate.elbows == (1,)
    assert all(abs(abs(p.turn) - math.pi) < 1e-12 for p in answer.singular_points)
    assert answer.certificate.largest_step > 3.0
    assert answer.certificate.position_error < 1e-14


def test_a_cusp_on_the_base_goes_out_the_way_it_came():
    cusp = Astroid(0.5, center=(0.5, 0.0), interval=(1.0, 6.0))  # the cusp at phi = pi stands on the base
    answer = trace(EQUAL, cusp, 101, at_singular="through")
    assert answer.status is TraceStatus.PASSED
    (point,) = answer.singular_points
    assert point.parameter == pytest.approx(math.pi, abs=1e-9)
    assert abs(point.turn) < 1e-4
    assert answer.certificate.elbows == (1,)
    assert answer.certificate.position_error < 1e-8


def test_a_corner_on_the_base_is_a_turn_in_place():
    corner = Polyline([(1.0, 0.0), (0.0, 0.0), (0.0, 1.0)])
    answer = trace(EQUAL, corner, 41, at_singular="through")
    (point,) = answer.singular_points
    assert point.parameter == pytest.approx(1.0, abs=1e-9)
    assert abs(point.turn) == pytest.approx(0.5 * math.pi, abs=1e-6)


@pytest.mark.parametrize(("arm", "kind"), [(EQUAL, "stretched"), (Arm((1.5, 0.5)), "folded")])
def test_touching_an_edge_of_the_ring(arm, kind):
    """A circle that touches the outer ring from within, or the inner one from outside."""
    circle = Circle(0.5, center=(1.5, 0.0)) if kind == "stretched" else Circle(0.3, center=(1.3, 0.0), tilt=math.pi)
    phi = np.linspace(-2.0, 2.0, 101)
    circle = Circle(circle.radius, center=circle.center, tilt=circle.tilt, interval=(-2.0, 2.0))
    stopped = trace(arm, circle, phi)
    assert stopped.failures[0].reason is Reason.SINGULAR
    assert stopped.failures[0].first == pytest.approx(0.0, abs=1e-12)
    assert stopped.singular_points[0].kind == kind
    through, bounced = (trace(arm, circle, phi, at_singular=way) for way in ("through", "bounce"))
    assert through.certificate.elbows == (1, -1)
    assert bounced.certificate.elbows == (1,)
    bend = [np.abs(np.diff(t.q, 2, axis=0)).max() for t in (through, bounced)]
    assert bend[0] < 0.2 * bend[1]  # straight through is smooth, bouncing has a kink
    for answer in (through, bounced):
        assert answer.certificate.position_error < 1e-7  # the root of a rounding, near the edge
        assert answer.certificate.largest_step < 0.1


def test_out_of_reach_with_exact_intervals():
    """x from 1 to 3 along y = 0.5 leaves the ring of radius 2 at sqrt(4 - 0.25)."""
    answer = trace(EQUAL, Line((1.0, 0.5), (3.0, 0.5)), 11)
    (failure,) = answer.failures
    assert failure.reason is Reason.TOO_FAR
    assert failure.first == pytest.approx((math.sqrt(3.75) - 1.0) / 2.0, abs=1e-15)
    assert failure.last == 1.0
    assert failure.amount == pytest.approx(math.hypot(3.0, 0.5) - 2.0)
    assert answer.followed.tolist() == [True] * 5 + [False] * 6
    tips = EQUAL.forward(answer.q[~answer.followed]).position
    np.testing.assert_allclose(np.hypot(*tips.T), 2.0)  # stretched towards the curve


def test_a_dip_between_two_parameters_is_found():
    """Both ends of the single interval are in reach, the middle is inside the hole."""
    arm = Arm((1.0, 0.5))
    answer = trace(arm, Line((-1.0, 0.4), (1.0, 0.4)), [0.0, 1.0])
    (failure,) = answer.failures
    assert failure.reason is Reason.TOO_CLOSE
    np.testing.assert_allclose([failure.first, failure.last], [0.35, 0.65], atol=1e-15)
    assert failure.amount == pytest.approx(0.1)


def test_limits_with_exact_intervals():
    arm = Arm((1.0, 1.0), limits=[(-math.pi, math.pi), (0.0, 1.8)])
    answer = trace(arm, CIRCLE, 51)
    assert not answer.certificate.limits_kept
    (failure,) = answer.failures
    assert (failure.reason, failure.joint) == (Reason.JOINT_LIMIT, 1)
    for edge in (failure.first, failure.last):
        assert arm.inverse(CIRCLE.position(edge), elbow=1).branches[0, 1] == pytest.approx(1.8, abs=1e-12)
    inside = (answer.parameters > failure.first) & (answer.parameters < failure.last)
    assert (answer.followed == ~inside).all()
    assert (answer.q[inside, 1] > 1.8).all()
    free = trace(EQUAL, CIRCLE, 51)
    assert failure.amount == pytest.approx(free.q[:, 1].max() - 1.8, abs=1e-3)


@pytest.mark.parametrize("angles", ["relative", "absolute"])
def test_whole_turns_are_found_for_limits(angles):
    limits = [(2.0, 9.0), (4.0, 12.0)]
    arm = Arm((1.0, 1.0), angles=angles, limits=limits)
    answer = trace(arm, CIRCLE, 51)
    assert answer.status is TraceStatus.FOLLOWED
    assert answer.certificate.limits_kept
    margins = np.minimum(answer.q - arm.lower, arm.upper - answer.q)
    assert answer.certificate.limit_margin == pytest.approx(margins.min(), abs=1e-3)
    assert arm.is_within_limits(answer.q).all()


def test_winding_is_kept():
    """Once around the base turns the first joint by a turn."""
    around = Circle(1.0)
    answer = trace(EQUAL, around, 41)
    np.testing.assert_allclose(answer.q[-1] - answer.q[0], [math.tau, 0.0], atol=1e-12)
    twice = trace(EQUAL, Circle(1.0, interval=(0.0, 2 * math.tau)), 5)  # half a turn from row to row
    assert twice.q[-1, 0] - twice.q[0, 0] == pytest.approx(2 * math.tau)


def test_near_chooses_the_branch_and_the_turn():
    up, down = (trace(EQUAL, CIRCLE, 11, elbow=e) for e in (1, -1))
    assert (np.sin(up.q[:, 1]) > 0).all()
    assert (np.sin(down.q[:, 1]) < 0).all()
    turns = np.array([math.tau, -math.tau])
    again = trace(EQUAL, CIRCLE, 11, near=down.q[0] + turns)
    np.testing.assert_allclose(again.q, down.q + turns, atol=1e-12)


def test_backwards_is_the_same_trace():
    phi = np.linspace(0.0, math.tau, 31)
    there, back = trace(EQUAL, LEMNISCATE, phi, at_singular="through"), trace(
        EQUAL, LEMNISCATE, phi[::-1], at_singular="through"
    )  # fmt: skip
    np.testing.assert_allclose(back.q[::-1], there.q, atol=1e-12)
    line = Line((1.0, 0.5), (3.0, 0.5))
    (failure,) = trace(EQUAL, line, np.linspace(1.0, 0.0, 11)).failures
    assert (failure.first, failure.last) == (1.0, pytest.approx((math.sqrt(3.75) - 1.0) / 2.0))


@settings(deadline=None, max_examples=40)
@given(
    st.floats(0.3, 2.0), st.floats(0.3, 2.0), st.floats(-1.5, 1.5), st.floats(-1.5, 1.5), st.floats(0.1, 2.0),
    st.sampled_from([1, -1]), st.sampled_from(["relative", "absolute"]), st.floats(-0.3, 0.3),
)  # fmt: skip
def test_what_is_said_to_follow_does(l1, l2, cx, cy, radius, elbow, angles, off):
    arm = Arm((l1, l2), angles=angles, base=Pose(0.2, -0.1, 0.4), tool=Pose(off, 0.5 * off, 1.0))
    answer = trace(arm, oval(cx, cy, radius), 41, elbow=elbow, at_singular="bounce")
    errors = answer.position_error()
    assert (errors[answer.followed] < 1e-7).all()
    assert (errors[~answer.followed] > -1e-9).all()
    for failure in answer.failures:
        for edge in (failure.first, failure.last):
            if 0.0 < edge < math.tau:
                assert arm.inverse(answer.curve.position(edge)).gap < 1e-9
        middle = answer.curve.position(0.5 * (failure.first + failure.last))
        assert arm.inverse(middle).gap > 0.0 or failure.amount < 1e-8
    if not answer.failures:
        assert answer.followed.all()


def oval(cx, cy, radius):
    return FreeCurve(lambda u: (cx + radius * np.cos(u), cy + 0.6 * radius * np.sin(u)), (0.0, math.tau), closed=True)


def test_other_arms_walk():
    arm = Arm((1.0, 0.8, 0.5))
    answer = trace(arm, CIRCLE, 31, near=(0.2, 0.4, 0.3))
    assert answer.status is TraceStatus.FOLLOWED
    assert answer.certificate.smallest_sine is None
    assert answer.certificate.elbows == ()
    assert answer.certificate.position_error < 1e-8
    assert answer.certificate.largest_step < 0.5
    assert answer.certificate.smallest_conditioning > 0.01
    far = trace(arm, Line((1.0, 0.0), (3.0, 0.0)), 9, near=(0.3, 0.3, 0.3))
    (failure,) = far.failures
    assert failure.reason is Reason.TOO_FAR
    assert failure.first == pytest.approx(0.65, abs=1e-4)
    assert failure.last == 1.0
    slide = trace(Arm((0.5, 0.5), joints="RP"), Line((1.2, 0.0), (0.5, 1.0)), 9)
    assert slide.status is TraceStatus.FOLLOWED


def test_a_walk_out_and_back_refines_both_ends():
    arm = Arm((1.0, 0.5, 0.5))
    bow = FreeCurve(lambda u: (1.5 + u * (2.0 - u), 0.0 * u), (0.0, 2.0))
    (failure,) = trace(arm, bow, 12, near=(0.3, 0.3, 0.3)).failures
    np.testing.assert_allclose([failure.first, failure.last], [1 - math.sqrt(0.5), 1 + math.sqrt(0.5)], atol=1e-4)


def test_a_walk_that_jumps_says_so():
    answer = trace(Arm((1.0, 0.8, 0.5)), CIRCLE, 5, near=(0.2, 0.4, 0.3), step_limit=0.05)
    assert answer.failures[0].reason is Reason.NOT_FOUND


def test_as_a_run():
    run = trace(EQUAL, CIRCLE, 51).as_run(10.0)
    assert run.kind == "arm"
    assert run.states.shape == (51, 2)
    assert run.t[-1] == 10.0
    assert np.abs(run.errors).max() < 1e-14
    stopped = trace(EQUAL, LEMNISCATE, 21).as_run(1.0)
    assert "cannot follow" in stopped.warnings[0]


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"parameters": [0.0, 2.0, 1.0]}, InvalidValue, "monotone"),
        ({"parameters": [0.0, math.nan]}, InvalidValue, "finite"),
        ({"parameters": [[0.0, 1.0]]}, InvalidShape, "vector"),
        ({"parameters": 1}, InvalidValue, "2 or more"),
        ({"elbow": 0}, InvalidValue, "elbow"),
        ({"near": (0.1,)}, InvalidShape, "each of the 2 joints"),
        ({"near": [(0.1, 0.2)]}, InvalidShape, "one posture"),
        ({"at_singular": "thru"}, UnknownName, "did you mean 'through'"),
        ({"between": 0}, InvalidValue, "between"),
        ({"tolerance": 0.0}, InvalidValue, "tolerance"),
    ],
)
def test_bad_input(arguments, error, words):
    with pytest.raises(error, match=words):
        trace(EQUAL, CIRCLE, **{"parameters": 11} | arguments)


def test_parameters_off_the_curve():
    with pytest.raises(InvalidValue, match="the curve is open"):
        trace(EQUAL, Line((1, 0), (1, 1)), [0.0, 2.0])
