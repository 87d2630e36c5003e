"""Driving to poses, where the point tracker's px would be 0."""

from __future__ import annotations

import math

import numpy as np
import pytest

from coplanar import Pose
from coplanar.control import Limits, PolarController, Stability, Unicycle
from coplanar.errors import InvalidValue, UnknownName
from coplanar.laws import polar
from coplanar.simulation import Noise, simulate
from tests.engines import NEEDS_NUMBA


def arrive(controller, start, *, duration=20.0, **more):
    return simulate(Unicycle(), controller, duration=duration, step=0.02, start=start, **more)


@pytest.mark.parametrize("form", ["linear", "smooth"])
@pytest.mark.parametrize("method", ["euler", "exact"])
def test_it_arrives_from_all_around_in_one_batch(form, method):
    around = np.linspace(-3.0, 3.0, 13)
    start = Pose(2.0 * np.cos(around), 2.0 * np.sin(around), 1.0 - around)
    goal = Pose(0.3, -0.2, 0.7)
    run = arrive(PolarController(goal, form=form, direction="nearest"), start, method=method)
    assert np.abs(run["rho"][-1]).max() < 1e-5
    assert np.abs(np.cos(run["theta"][-1] - goal.theta) - 1.0).max() < 1e-6
    assert np.isfinite(run.states).all()


def test_directions():
    ahead = Pose(-2.0, 0.3, 0.0)
    assert arrive(PolarController(Pose()), ahead)["v"][1] > 0.0
    assert arrive(PolarController(Pose(), direction="backward"), Pose(2.0, 0.3, 0.0))["v"][1] < 0.0
    nearest = PolarController(Pose(), direction="nearest")
    assert arrive(nearest, ahead)["v"][1] > 0.0
    assert arrive(nearest, Pose(2.0, 0.3, 0.0))["v"][1] < 0.0


def test_at_the_goal_only_the_heading_is_left():
    run = arrive(PolarController(Pose(0.0, 0.0, 1.0)), Pose(0.0, 0.0, 0.0), duration=5.0)
    assert not run["v"].any()
    assert run["theta"][-1] == pytest.approx(1.0)


def test_gain_conditions():
    good = PolarController(Pose()).stability(0.01)
    assert good.status is Stability.STABLE
    assert all(good.conditions.values())
    assert good.warnings == ()
    backwards = PolarController(Pose(), 3.0, 8.0, 1.5).stability(0.01)
    assert backwards.status is Stability.UNSTABLE
    assert backwards.largest_step == 0.0
    assert "needs k_rho k_beta < 0" in str(backwards)
    slow = PolarController(Pose(), 3.0, 2.0, -1.5).stability(0.01)
    assert "needs k_alpha > k_rho" in str(slow)
    weak = PolarController(Pose(), 3.0, 4.0, -1.5).stability(0.01)
    assert weak.status is Stability.STABLE
    assert "keeps it facing it" in str(weak)
    assert PolarController(Pose(), form="smooth").stability(1.0).status is Stability.UNSTABLE
    assert not PolarController(Pose()).stability(0.4).conditions["h k_rho < 1"]


def test_largest_step_is_where_the_run_stops_arriving():
    controller = PolarController(Pose())
    edge = controller.stability(0.01).largest_step
    assert edge == pytest.approx(controller.stability(0.3).largest_step)
    start = Pose(-1.0, 0.002, 0.002)
    for step, arrives in ((0.9 * edge, True), (1.1 * edge, False)):
        run = simulate(Unicycle(), controller, duration=12 * step, step=step, start=start)
        early, late = np.abs(run["alpha"][1:4]).max(), np.abs(run["alpha"][-3:]).max()
        assert bool(late < early) is arrives


def test_a_batch_of_gains():
    report = PolarController(Pose(), 3.0, np.array([8.0, 2.0]), -1.5).stability(0.01)
    assert list(report.status) == [Stability.STABLE, Stability.UNSTABLE]
    assert report.poles.shape == (2, 3)
    assert report.largest_step[1] == 0.0 < report.largest_step[0]


def test_limits_hold_on_the_way():
    limits = Limits(v=0.4, omega=1.0, acceleration=0.5, turn_acceleration=2.0)
    run = arrive(PolarController(Pose()), Pose(-2.0, 1.0, 2.0), duration=40.0, limits=limits)
    assert np.abs(run["v"]).max() <= 0.4 + 1e-12
    assert np.abs(run["omega"]).max() <= 1.0 + 1e-12
    assert np.abs(np.diff(run["v"])).max() <= 0.5 * 0.02 + 1e-12
    assert run["rho"][-1] < 0.01


def test_bad_input():
    with pytest.raises(InvalidValue, match="a Pose"):
        PolarController((0.0, 0.0, 0.0))
    with pytest.raises(InvalidValue, match="k_rho"):
        PolarController(Pose(), math.nan)
    with pytest.raises(UnknownName, match="linear"):
        PolarController(Pose(), form="liner")
    with pytest.raises(UnknownName, match="nearest"):
        PolarController(Pose(), direction="near")
    with pytest.raises(InvalidValue, match="start"):
        simulate(Unicycle(), PolarController(Pose()), duration=1.0, step=0.1)


def test_limits_refuse_what_they_cannot_use():
    with pytest.raises(InvalidValue, match="half the distance between the wheels"):
        Limits(rim=1.0)
    with pytest.raises(InvalidValue, match="greater than 0"):
        Limits(v=0.0)
    with pytest.raises(UnknownName, match="did you mean 'scale'"):
        Limits(mode="scaled")


def scattered(rows):
    rng = np.random.default_rng(8)
    return Pose(rng.uniform(-1.0, 1.0, rows), rng.uniform(-1.0, 1.0, rows), rng.uniform(-3.0, 3.0, rows))


@pytest.mark.parametrize("rows", [3, pytest.param(300, marks=NEEDS_NUMBA)], ids=["text", "compiled"])
@pytest.mark.parametrize("method", ["euler", "rk4", "exact"])
@pytest.mark.parametrize("form", ["linear", "smooth"])
def test_a_batch_in_one_go_is_each_robot_by_itself(form, method, rows):
    controller = PolarController(Pose(0.2, -0.1, 0.4), form=form, direction="nearest", arrive_within=0.01)
    start, more = scattered(rows), {"duration": 2.0, "step": 0.02, "method": method}
    many = simulate(Unicycle(), controller, start=start, **more)
    assert list(many.columns) == ["t", "x", "y", "theta", "v", "omega", "rho", "alpha", "beta"]
    for i in {0, rows // 2, rows - 1}:
        alone = simulate(Unicycle(), controller, start=Pose(*(float(part[i]) for part in start.parts)), **more)
        for name, column in alone.columns.items():
            np.testing.assert_allclose(many.robot(i)[name], column, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("rows", [3, pytest.param(300, marks=NEEDS_NUMBA)], ids=["text", "compiled"])
def test_a_batch_in_one_go_is_the_batch_step_by_step(rows):
    controller = PolarController(scattered(rows), k_rho=np.linspace(1.0, 3.0, rows))
    more = {"duration": 2.0, "step": 0.02, "start": Pose(np.zeros((2, 1)), 0.0, 0.0)}
    at_once = simulate(Unicycle(), controller, **more)
    stepped = simulate(Unicycle(), controller, noise=Noise(), **more)
    assert at_once.shape == stepped.shape == (2, rows)
    for name, column in stepped.columns.items():
        np.testing.assert_allclose(at_once[name], column, rtol=1e-9, atol=1e-9)
    end = simulate(Unicycle(), controller, keep="end", **more)
    for name, column in at_once.columns.items():
        np.testing.assert_array_equal(end[name], column[-1:])


@NEEDS_NUMBA
def test_its_loops_are_vector_code():
    """A law that may hide a NaN is evaluated by the C library, row by row: twenty times slower."""
    from coplanar.engine.compiled.doubt import shows_every_nan

    assert all(map(shows_every_nan, (polar.linear_step, polar.linear_arc, polar.smooth_step, polar.smooth_arc)))
