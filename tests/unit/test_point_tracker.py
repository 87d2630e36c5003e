"""The point tracker: what it refuses, what it warns of, what it does."""

from __future__ import annotations

import math

import numpy as np
import pytest

from coplanar import Pose
from coplanar.control import PointTracker, Stability, Unicycle
from coplanar.curves import Astroid, Circle, HeldPoint, Line
from coplanar.errors import InvalidShape, InvalidValue, NoSolution, UnknownName
from coplanar.simulation import simulate


def test_px_zero_names_the_way_out():
    with pytest.raises(InvalidValue, match=r"px other than 0.*PolarController"):
        PointTracker((0.0, 0.1), kp=1.0)
    with pytest.raises(InvalidValue, match="PolarController"):
        PointTracker([(0.1, 0.0), (0.0, 0.0)], kp=1.0)


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        ({"kp": 0.0}, InvalidValue),
        ({"kp": -1.0}, InvalidValue),
        ({"kp": math.nan}, InvalidValue),
        ({"kp": 1.0, "ki": -1.0}, InvalidValue),
        ({"kp": 1.0, "kd": math.inf}, InvalidValue),
        ({"kp": 1.0, "error_against": "last"}, UnknownName),
        ({"kp": [1.0, 2.0], "kd": [0.0, 0.1, 0.2]}, InvalidShape),
        ({"kp": 1.0, "point": (0.1,)}, InvalidShape),
    ],
)
def test_bad_input(arguments, error):
    with pytest.raises(error):
        PointTracker(**{"point": (0.1, 0.0)} | arguments)


def test_bad_stability_input():
    tracker = PointTracker((0.1, 0.0), kp=1.0)
    with pytest.raises(InvalidValue, match="step"):
        tracker.stability(0.0)
    with pytest.raises(UnknownName, match="did you mean 'rk4'"):
        tracker.stability(0.1, method="rk45")
    with pytest.raises(InvalidValue, match="speed"):
        tracker.stability(0.1, speed=-1.0)


def test_the_demo_is_exactly_on_the_boundary():
    report = PointTracker((0.05, 0.0), kp=100.0, kd=0.5).stability(0.01)
    assert report.status is Stability.BOUNDARY
    assert report.poles.tolist() == [0.5, -1.0]
    assert report.margin == 0.0
    assert report.largest_step == 0.01
    assert not report.stable
    assert report.conditions == {"h kp + 2 kd + h^2 ki/2 < 2": False, "|kd| < 1": True}
    assert "has to be below 2" in str(report)
    with pytest.raises(NoSolution, match="boundary") as caught:
        report.or_raise()
    assert caught.value.result is report


def test_the_demo_with_any_better_plant_is_unstable_on_the_move():
    tracker = PointTracker((0.05, 0.0), kp=100.0, kd=0.5)
    assert tracker.stability(0.01, speed=0.9).status is Stability.BOUNDARY
    fast = PointTracker((0.05, 0.0), kp=5.0, kd=0.1).stability(0.01, speed=10.0)
    assert fast.status is Stability.BOUNDARY
    assert fast.warnings[0].startswith("on the stability boundary on the move: h V/|px| is 2 and has to be below 2")
    for method in ("midpoint", "heun", "rk4", "exact"):
        report = tracker.stability(0.01, method=method, speed=0.9)
        assert report.status is Stability.UNSTABLE
        assert report.largest_step == pytest.approx(1.0 / (100.0 + 0.9 / 0.05))


def test_stable_gains_say_nothing():
    report = PointTracker((0.1, 0.0), kp=10.0).stability(0.01, speed=0.5)
    assert report.status is Stability.STABLE
    assert report.warnings == ()
    assert report.or_raise() is report
    assert str(report) == Stability.STABLE.value


def test_warnings_are_sentences():
    def warnings(*, point=(0.1, 0.0), kp=10.0, kd=0.0, ki=0.0, speed=0.0, method="euler", **extra):
        return " | ".join(PointTracker(point, kp, kd, ki, **extra).stability(0.01, speed=speed, method=method).warnings)

    assert "turns round and drives in reverse" in warnings(point=(-0.1, 0.0))
    assert "|py/px| = 4 amplifies v" in warnings(point=(0.1, 0.4))
    assert "|kd| is 1.2 and has to be below 1" in warnings(kd=1.2)
    assert "asks for |omega| = kp |e|/|px| = 500 rad/s" in warnings(point=(0.001, 0.0), speed=0.5)
    assert "counts the reference's motion twice" in warnings(feedforward=True, error_against="next")
    assert "h V/|px| is 5" in warnings(point=(0.001, 0.0), speed=0.5)
    assert "sideways while it turns" in warnings(kp=150.0, point=(0.01, 0.0), speed=0.6, method="rk4")
    assert "outruns the negative kd" in warnings(kp=5.0, kd=-0.9, ki=300.0)


def test_a_batch_of_gains_reports_for_each():
    report = PointTracker((0.05, 0.0), kp=100.0, kd=np.array([0.3, 0.5, 0.7])).stability(0.01)
    assert list(report.status) == [Stability.STABLE, Stability.BOUNDARY, Stability.UNSTABLE]
    assert report.stable.tolist() == [True, False, False]
    np.testing.assert_allclose(report.largest_step, [0.014, 0.01, 0.006])
    assert any("(1 of 3)" in sentence for sentence in report.warnings)
    with pytest.raises(NoSolution, match="unstable"):
        report.or_raise()


def growth(tracker, method="euler", step=0.01, rows=160):
    """By how much a small error of a robot at rest has grown."""
    start = tracker.pose_for((1e-7, 0.0), heading=0.0)
    run = simulate(
        Unicycle(), tracker, HeldPoint((0.0, 0.0)), duration=rows * step, step=step, start=start, method=method
    )
    return np.abs(run["ex"][-20:]).max(0) / 1e-7


def test_discrete_p_is_stable_up_to_two():
    h = 0.01
    for product, grows in ((0.05, False), (1.0, False), (1.9, False), (2.1, True), (3.0, True)):
        assert bool(growth(PointTracker((0.1, 0.0), kp=product / h)) > 1.0) is grows


def test_pd_region_from_simulation_is_that_of_the_poles():
    kp, kd = np.meshgrid(np.linspace(10.0, 190.0, 10), np.linspace(-0.95, 1.15, 12))
    tracker = PointTracker((0.1, 0.0), kp=kp, kd=kd)
    margin = tracker.stability(0.01).margin
    clear = np.abs(margin) > 0.02
    assert ((growth(tracker) < 1.0) == (margin > 0.0))[clear].all()
    assert 30 < (margin > 0.0).sum() < margin.size - 30


def test_growth_follows_the_largest_pole():
    tracker = PointTracker((0.1, 0.0), kp=210.0)
    report = tracker.stability(0.01)
    run = simulate(
        Unicycle(), tracker, HeldPoint((0.0, 0.0)), duration=0.5, step=0.01, start=tracker.pose_for((1e-9, 0.0), 0.0)
    )
    ratio = run["ex"][-1] / run["ex"][-2]
    assert ratio == pytest.approx(report.poles[np.abs(report.poles).argmax()].real, rel=1e-6)


def straight(px, *, kp=20.0, feedforward=False, heading=0.05, **more):
    tracker = PointTracker((px, 0.0), kp=kp, feedforward=feedforward, **more)
    start = tracker.pose_for((0.0, 0.0), heading)
    return simulate(Unicycle(), tracker, Line((0, 0), (5, 0)).over(10.0), step=0.01, method="exact", start=start)


def test_px_positive_leads_and_px_negative_turns_round():
    ahead, behind = straight(0.1), straight(-0.1)
    for run in (ahead, behind):
        assert np.hypot(run["ex"][-1], run["ey"][-1]) < 0.03  # both track
    assert abs(ahead["theta"][-1]) < 1e-6
    assert ahead["v"][-1] == pytest.approx(0.5)
    assert abs(math.cos(behind["theta"][-1]) + 1.0) < 1e-6  # turned by half a turn
    assert behind["v"][-1] == pytest.approx(-0.5)


def test_feedforward_kills_the_lag():
    assert straight(0.1)["ex"][-1] == pytest.approx(0.5 / 20.0, rel=1e-3)
    assert abs(straight(0.1, feedforward=True)["ex"][-1]) < 1e-9
    assert straight(0.1, error_against="next")["ex"][-1] == pytest.approx(0.5 / 20.0, rel=1e-3)


def test_integral_kills_the_lag_too():
    assert abs(straight(0.1, ki=50.0)["ex"][-1]) < 1e-4


def test_a_small_px_asks_for_the_omega_that_was_said():
    tracker = PointTracker((0.001, 0.0), kp=100.0)
    start = tracker.pose_for((0.0, 0.0), heading=0.0)
    run = simulate(Unicycle(), tracker, HeldPoint((0.0, 0.05)), duration=0.02, step=0.01, start=start)
    assert run["omega"][1] == pytest.approx(tracker.omega_for(0.05)) == 5000.0


def test_large_py_amplifies_v():
    def first_v(py):
        tracker = PointTracker((0.1, py), kp=10.0)
        start = tracker.pose_for((0.0, 0.0), 0.0)
        return simulate(Unicycle(), tracker, HeldPoint((0.0, 0.01)), duration=0.02, step=0.01, start=start)["v"][1]

    assert first_v(0.0) == 0.0
    assert first_v(0.5) == pytest.approx(0.5 / 0.1 * 10.0 * 0.01)


def test_starting_pose_follows_the_reference():
    tracker = PointTracker((0.1, 0.05), kp=10.0)
    moving = tracker.start(Circle(1.0).over(2.0), 0.0)
    assert moving.theta == pytest.approx(0.5 * math.pi)
    np.testing.assert_allclose(moving.act(0.1, 0.05), (1.0, 0.0), atol=1e-15)
    at_cusp = tracker.start(Astroid(1.0).over(10.0), 0.0)
    assert math.cos(at_cusp.theta) == pytest.approx(-1.0)
    assert tracker.start(HeldPoint((1.0, 1.0)), 0.0).theta == 0.0


def test_nothing_can_be_changed():
    tracker = PointTracker(np.array([0.1, 0.0]), kp=np.array([1.0, 2.0]))
    with pytest.raises(ValueError, match="read-only"):
        tracker.kp[0] = 5.0
    with pytest.raises(AttributeError):
        tracker.kp = 5.0
    assert tracker.shape == (2,)
    assert isinstance(tracker.pose_for((0.0, 0.0), 0.0), Pose)
