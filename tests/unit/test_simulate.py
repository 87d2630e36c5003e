"""Closed loops: the demo, times, batches, noise, limits, divergence."""

from __future__ import annotations

import math

import numpy as np
import pytest

from coplanar import Pose
from coplanar.control import METHODS, Limits, PointTracker, Unicycle
from coplanar.curves import Astroid, Circle, HeldPoint, Lemniscate
from coplanar.errors import InvalidShape, InvalidValue, UnknownName
from coplanar.run import RunStatus
from coplanar.simulation import Noise, simulate
from tests.engines import NEEDS_NUMBA

ASTROID = Astroid(1.0).over(10.0)


def demo(*, kp=100.0, kd=0.5, method="euler", **more):
    tracker = PointTracker((0.05, 0.0), kp=kp, kd=kd, error_against="next")
    start = tracker.pose_for(ASTROID.position(0.0), heading=0.5 * math.pi)
    return simulate(Unicycle(), tracker, ASTROID, **{"step": 0.01, "method": method, "start": start} | more)


def transcription(*, px, py, kp, kd, h, duration):
    """The loop written out from its equations."""
    count = round(duration / h)
    t = h * np.arange(count + 1)
    ref = np.column_stack([np.cos(2 * np.pi * t / duration) ** 3, np.sin(2 * np.pi * t / duration) ** 3])
    theta = np.pi / 2
    R = np.array([[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]])
    x, y = ref[0] - R @ (px, py)
    table = np.zeros((count + 1, 8))
    table[0] = t[0], x, y, theta, 0, 0, 0, 0
    last = np.zeros(2)
    for i in range(count):
        R = np.array([[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]])
        e = ref[i + 1] - (np.array([x, y]) + R @ (px, py))
        A = np.column_stack([R @ (1, 0), R @ (-py, px)])
        v, omega = np.linalg.solve(A, kp * e + kd * (e - last) / h)
        x, y, theta = x + h * v * np.cos(theta), y + h * v * np.sin(theta), theta + h * omega
        table[i + 1] = t[i + 1], x, y, theta, v, omega, *e
        last = e
    return table


def test_the_demo():
    run = demo()
    assert run.status is RunStatus.COMPLETE
    assert list(run.columns) == ["t", "x", "y", "theta", "v", "omega", "ex", "ey"]
    expected = transcription(px=0.05, py=0.0, kp=100.0, kd=0.5, h=0.01, duration=10.0)
    assert expected.shape == (1001, 8)
    np.testing.assert_allclose(run.stacked(*run.columns), expected, rtol=0, atol=1e-9)
    assert not run.commands[0].any()
    assert not run.errors[0].any()
    assert any("boundary" in sentence for sentence in run.warnings)


def test_a_point_off_the_axis_too():
    tracker = PointTracker((0.08, -0.03), kp=40.0, kd=0.2, error_against="next")
    start = tracker.pose_for((1.0, 0.0), heading=0.5 * math.pi)
    run = simulate(Unicycle(), tracker, ASTROID, step=0.02, start=start)
    expected = transcription(px=0.08, py=-0.03, kp=40.0, kd=0.2, h=0.02, duration=10.0)
    np.testing.assert_allclose(run.stacked(*run.columns), expected, rtol=0, atol=1e-11)


def test_the_demo_with_a_better_plant_diverges():
    """A held command over an exact, or a fourth-order, step: the derivative gain then is too much."""
    euler = demo()
    assert np.abs(euler.errors).max() < 0.01
    assert np.abs(euler["omega"]).max() < 10.0
    for method in ("midpoint", "heun", "rk4", "exact"):
        other = demo(method=method)
        assert np.abs(other.errors).max() > 0.1
        assert np.abs(other["omega"]).max() > 100.0
        assert any("unstable" in sentence for sentence in other.warnings)
        tame = demo(method=method, kd=0.3)
        assert np.abs(tame.errors).max() < 0.01


@pytest.mark.parametrize("method", METHODS)
def test_small_steps_agree_whatever_the_method(method):
    tracker = PointTracker((0.2, 0.05), kp=5.0)
    start = Pose(0.7, -0.2, 1.0)
    ends = [
        simulate(Unicycle(), tracker, ASTROID, duration=2.0, step=h, method=method, start=start).states[-1]
        for h in (0.01, 0.005)
    ]
    np.testing.assert_allclose(ends[0], ends[1], atol=0.05)
    exact = simulate(Unicycle(), tracker, ASTROID, duration=2.0, step=0.005, method="exact", start=start).states[-1]
    np.testing.assert_allclose(ends[1], exact, atol=0.02)


@pytest.mark.parametrize("method", METHODS)
def test_a_batch_is_its_robots(method):
    point = np.array([[0.1, 0.0], [0.2, 0.05], [-0.1, 0.02]])
    kp, kd = np.array([20.0, 10.0, 15.0]), np.array([[0.0], [0.2]])
    many = simulate(
        Unicycle(), PointTracker(point, kp, kd, ki=1.0), Lemniscate(1.0).over(8.0), step=0.02, duration=2.0,
        method=method, start=Pose(0.5, 0.1, 0.3),
    )  # fmt: skip
    assert many.shape == (2, 3)
    assert many["x"].shape == (101, 2, 3)
    for i, j in np.ndindex(2, 3):
        alone = simulate(
            Unicycle(), PointTracker(point[j], kp[j], kd[i, 0], ki=1.0), Lemniscate(1.0).over(8.0), step=0.02,
            duration=2.0, method=method, start=Pose(0.5, 0.1, 0.3),
        )  # fmt: skip
        for name, column in alone.columns.items():
            np.testing.assert_allclose(many.robot((i, j))[name], column, rtol=1e-9, atol=1e-11)


def test_a_batch_with_limits_and_noise_is_stepped_alike():
    tracker = PointTracker((0.1, 0.0), kp=np.array([10.0, 20.0]))
    bare = simulate(Unicycle(), tracker, ASTROID, step=0.05)
    stepped = simulate(Unicycle(), tracker, ASTROID, step=0.05, limits=Limits(v=1e9), noise=Noise())
    for name in bare.columns:
        np.testing.assert_allclose(stepped[name], bare[name], atol=1e-12)


def test_many_targets():
    goals = np.array([[0.0, 1.0], [1.0, 0.0], [-1.0, -1.0]])
    tracker = PointTracker((0.1, 0.0), kp=5.0)
    start = Pose(np.zeros(3), np.zeros(3), 0.0)
    run = simulate(Unicycle(), tracker, HeldPoint(goals), duration=5.0, step=0.02, method="exact", start=start)
    same = simulate(Unicycle(), tracker, HeldPoint(goals), duration=5.0, step=0.02, method="exact", start=Pose())
    np.testing.assert_array_equal(same.states, run.states)
    limits, still = Limits(v=[0.1, 0.2]), HeldPoint(goals[0])
    slow = simulate(Unicycle(), tracker, still, duration=1.0, step=0.02, limits=limits, start=Pose())
    np.testing.assert_allclose(np.abs(slow["v"]).max(0), [0.1, 0.2])
    ends = np.stack(run.robot(slice(None)).poses[-1].act(0.1, 0.0), axis=-1)
    np.testing.assert_allclose(ends, goals, atol=1e-6)


def test_times():
    tracker, circle = PointTracker((0.1, 0.0), kp=5.0), Circle(1.0).over(1.0, start_time=2.0)
    short = simulate(Unicycle(), tracker, circle, step=0.3)
    np.testing.assert_allclose(short.t, [2.0, 2.3, 2.6, 2.9, 3.0])
    free = simulate(Unicycle(), tracker, circle, t=[2.0, 2.1, 2.5])
    assert free.t.tolist() == [2.0, 2.1, 2.5]
    assert len(simulate(Unicycle(), tracker, ASTROID, step=0.1, duration=0.7)) == 8
    assert len(simulate(Unicycle(), tracker, ASTROID, step=5.0, duration=0.7)) == 2


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"t": [0.0, 2.0, 1.0]}, "monotone"),
        ({"t": [1.0, 0.0]}, "increasing"),
        ({"t": [0.0, math.nan]}, "finite"),
        ({"t": [0.0, 1.0], "step": 0.1}, "either t"),
        ({}, "both, or t"),
        ({"step": 0.0}, "step = 0.0"),
        ({"step": math.inf}, "finite"),
        ({"duration": -1.0, "step": 0.1}, "duration"),
    ],
)
def test_bad_times(arguments, words):
    with pytest.raises(InvalidValue, match=words):
        simulate(Unicycle(), PointTracker((0.1, 0.0), kp=5.0), ASTROID, **arguments)


def test_other_bad_input():
    tracker = PointTracker((0.1, 0.0), kp=5.0)
    with pytest.raises(UnknownName, match="did you mean 'euler'"):
        simulate(Unicycle(), tracker, ASTROID, step=0.1, method="Euler")
    with pytest.raises(InvalidValue, match=r"curve\.over"):
        simulate(Unicycle(), tracker, duration=1.0, step=0.1, start=Pose())
    with pytest.raises(InvalidShape, match="one number each"):
        simulate(Unicycle(), tracker, ASTROID, step=[0.1, 0.2])
    batch = PointTracker((0.1, 0.0), kp=[1.0, 2.0])
    with pytest.raises(InvalidShape, match="start"):
        simulate(Unicycle(), batch, ASTROID, step=0.1, start=Pose(np.zeros(3), 0.0, 0.0))
    with pytest.raises(InvalidValue, match="position"):
        Noise(position=-0.1)


def test_noise_comes_from_its_seed():
    def noisy(seed, **sizes):
        return demo(kp=20.0, kd=0.0, noise=Noise(seed=seed, **sizes))

    one, again, other = (noisy(seed, position=0.01, heading=0.01) for seed in (1, 1, 2))
    np.testing.assert_array_equal(one.states, again.states)
    assert np.abs(one.states - other.states).max() > 1e-4
    assert one.info["seed"] == 1
    quiet = demo(kp=20.0, kd=0.0)
    np.testing.assert_allclose(noisy(5).states, quiet.states, atol=1e-12)
    driven = noisy(3, v=0.1)
    assert np.abs(driven.states - quiet.states).max() > 1e-3
    sizes = Noise(position=0.5, heading=0.1, v=0.2, omega=0.3, seed=4).draw(4000, ()).std(axis=0)
    np.testing.assert_allclose(sizes, [0.5, 0.5, 0.1, 0.2, 0.3], rtol=0.05)


def test_limits_are_what_is_recorded_and_driven():
    run = demo(kp=20.0, kd=0.0, limits=Limits(v=0.3, omega=2.0))
    assert np.abs(run["v"]).max() <= 0.3 + 1e-12
    moved = np.hypot(np.diff(run["x"]), np.diff(run["y"]))
    np.testing.assert_allclose(moved, 0.01 * np.abs(run["v"][1:]), atol=1e-12)
    np.testing.assert_allclose(np.diff(run["theta"]), 0.01 * run["omega"][1:], atol=1e-12)


def test_divergence_is_said():
    wild = PointTracker((1e-3, 0.0), kp=500.0, kd=0.9)
    run = simulate(Unicycle(), wild, ASTROID, duration=100.0, step=0.05, method="rk4")
    assert run.status is RunStatus.DIVERGED
    assert len(run) < 2001
    assert np.isfinite(run.states[:-1]).all()
    both = simulate(Unicycle(), PointTracker((0.1, 0.0), [5.0, 1000.0], [0.0, 3.0]), ASTROID, step=0.05, duration=40.0)
    assert both.status is RunStatus.DIVERGED
    assert len(both) == 801
    assert np.isfinite(both.robot(0).states).all()


def test_the_astroid_cusps_keep_the_error_small():
    """At a cusp the reference stops and reverses: without a path heading to follow, P still follows the point."""
    tracker = PointTracker((0.05, 0.0), kp=50.0, feedforward=True)
    run = simulate(Unicycle(), tracker, ASTROID, step=0.01, method="exact")
    size = np.hypot(run["ex"], run["ey"])
    assert size.max() < 0.005
    lag = simulate(Unicycle(), PointTracker((0.05, 0.0), kp=50.0), ASTROID, step=0.01, method="exact")
    assert np.hypot(lag["ex"], lag["ey"]).max() == pytest.approx(1.5 * 2.0 * math.pi / 10.0 / 50.0, rel=0.02)


def test_a_large_batch_in_the_compiled_loop():
    kp = np.linspace(5.0, 90.0, 210)
    many = simulate(Unicycle(), PointTracker((0.1, 0.0), kp), ASTROID, step=0.01, duration=1.0)
    for i in (0, 100, 209):
        alone = simulate(Unicycle(), PointTracker((0.1, 0.0), float(kp[i])), ASTROID, step=0.01, duration=1.0)
        np.testing.assert_allclose(many.robot(i).states, alone.states, atol=1e-12)


def test_a_seed_for_each_robot_draws_what_it_would_alone():
    many = Noise(position=[0.1, 0.2, 0.1], v=0.3, seed=[4, 7, 4]).draw(20, (3,))
    for k, (size, seed) in enumerate(((0.1, 4), (0.2, 7), (0.1, 4))):
        np.testing.assert_array_equal(many[..., k], Noise(position=size, v=0.3, seed=seed).draw(20, ()))


@pytest.mark.parametrize("seed", [-1, 1.5, [1, -2], "a", True])
def test_a_seed_that_is_none_is_refused(seed):
    with pytest.raises(InvalidValue, match="seed"):
        Noise(seed=seed)


def many(**more):
    tracker = PointTracker((0.1, 0.0), kp=np.array([5.0, 10.0, 20.0]), kd=0.1)
    return simulate(Unicycle(), tracker, ASTROID, **{"step": 0.02, "start": Pose(0.8, 0.1, 1.0)} | more)


@pytest.mark.parametrize("method", ["euler", "exact", "rk4"])
@pytest.mark.parametrize(
    "more", [{}, {"limits": Limits(v=3.0), "noise": Noise(position=0.01, seed=3)}], ids=["all", "stepped"]
)
def test_what_is_kept_is_the_same_whatever_else_is(method, more):
    for make in (many, demo):
        whole = make(method=method, **more)
        end = make(method=method, keep="end", **more)
        assert list(end.columns) == list(whole.columns)
        assert (len(end), end.shape, end.status) == (1, whole.shape, whole.status)
        for name, column in whole.columns.items():
            np.testing.assert_array_equal(end[name], column[-1:])
        some = make(method=method, keep=["ey", "x"], **more)
        assert list(some.columns) == ["t", "x", "ey"]
        for name, column in some.columns.items():
            np.testing.assert_array_equal(column, whole[name])
        assert end.warnings == some.warnings == whole.warnings


@pytest.mark.parametrize("compiled", [False, pytest.param(True, marks=NEEDS_NUMBA)])
def test_what_is_kept_of_a_run_that_diverges(compiled):
    kp = np.full(40, 1e200) if compiled else np.array([1e200, 1e250])
    tracker = PointTracker((0.1, 0.0), kp=kp)
    runs = [
        simulate(Unicycle(), tracker, ASTROID, step=0.01, start=Pose(), keep=keep)
        for keep in ("all", "end", ("theta",))
    ]
    assert {run.status for run in runs} == {RunStatus.DIVERGED}
    whole, end, some = runs
    assert len(whole) == len(some) < 1001
    assert end.t[0] == whole.t[-1]
    np.testing.assert_array_equal(some["theta"], whole["theta"])
    np.testing.assert_array_equal(end["x"][0], whole["x"][-1])


def test_only_columns_that_there_are_can_be_kept():
    with pytest.raises(UnknownName, match="keep"):
        many(keep="ende")
    with pytest.raises(UnknownName, match="keep"):
        many(keep=["x", "z"])


@pytest.mark.parametrize("keep", ["all", "end", ["x"]])
def test_a_run_is_read_only_and_the_times_given_are_not(keep):
    times = np.linspace(0.0, 1.0, 20)
    run = many(t=times, step=None, keep=keep)
    times[0] = -1.0
    assert run.t[-1] == 1.0
    for column in run.columns.values():
        assert not column.flags.writeable
        assert column.base is None or not column.base.flags.writeable
        assert column.base is None or run.robot(0) is not None
