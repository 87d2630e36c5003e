"""Tracking: a point of a differential drive follows an astroid."""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np

from coplanar.control import PointTracker, Unicycle
from coplanar.curves import Astroid
from coplanar.run import Run
from coplanar.simulation import simulate
from coplanar.tour.demo import Demo
from coplanar.viz.axes import plot_headings, plot_path, plot_series
from coplanar.viz.control import plot_poles
from coplanar.viz.scene import Scene

_POINT, _GAIN, _STEP, _DURATION = (0.05, 0.0), 100.0, 0.01, 10.0
_ROBOT = np.array([(0.1 * np.cos(a), 0.1 * np.sin(a)) for a in np.linspace(0.0, 2.0 * pi, 37)])


def track_astroid() -> Demo:
    """PD with gains that stand exactly on the stability boundary."""
    tracker = PointTracker(_POINT, kp=_GAIN, kd=0.5, error_against="next")
    run = _tracked(tracker, "euler")
    report = tracker.stability(_STEP)
    expected = np.sort(np.roots([1.0, -(1.0 - _STEP * _GAIN - 0.5), -0.5]))
    error = float(np.abs(np.sort(report.poles.real) - expected).max())
    return _demo(
        "track-astroid",
        "Point tracking by PD, Euler",
        tracker,
        run,
        headline=f"poles {report.poles.real[0]:+.2f} and {report.poles.real[1]:+.2f}: {report.status.value}",
        check=f"roots of the characteristic polynomial: {error:.0e}",
        passed=bool(error < 1e-12 and _largest_error(run) < 0.02),
        story="A point ahead of the wheels can be driven in any direction. With kp = 100 1/s, kd = 0.5 and 10 ms the "
        "loop has a pole at -1: what once alternates neither dies out nor grows. The report says so before it runs, "
        "and that Runge-Kutta steps in place of Euler's would make the same gains diverge.",
    )


def track_astroid_p() -> Demo:
    """P alone, with Runge-Kutta steps of the plant: it lags and is calm."""
    tracker = PointTracker(_POINT, kp=_GAIN, error_against="next")
    run = _tracked(tracker, "rk4")
    # Against the next reference a deadbeat loop (h kp = 1) is one step behind: e = h |refdot|.
    lag = _STEP * 3.0 * pi / _DURATION
    largest = _largest_error(run)
    return _demo(
        "track-astroid-p",
        "Point tracking by P, Runge-Kutta",
        tracker,
        run,
        headline=f"largest error {1000.0 * largest:.2f} mm",
        check=f"one step of the fastest reference, {1000.0 * lag:.2f} mm: {abs(largest / lag - 1.0):.1%} apart",
        passed=bool(abs(largest / lag - 1.0) < 0.05),
        story="Without the derivative the poles are 0 and well inside the circle. The error is the way that the "
        "reference moves in one step; at the cusps, where the reference stops and turns back, it vanishes.",
    )


def _tracked(tracker: PointTracker, method: str) -> Run:
    reference = Astroid(1.0).over(_DURATION)
    start = tracker.pose_for(reference.position(0.0), 0.5 * pi)
    return simulate(Unicycle(), tracker, reference, step=_STEP, method=method, start=start)


def _largest_error(run: Run) -> float:
    return float(np.hypot(run["ex"], run["ey"]).max())


def _demo(name: str, title: str, tracker: PointTracker, run: Run, **words: Any) -> Demo:
    poses = run.poses.as_array()
    reference = Astroid(1.0).over(_DURATION).position(run.t)
    point = run.poses @ np.asarray(_POINT)

    def figure(canvas: Any) -> None:
        grid = canvas.add_gridspec(2, 3, width_ratios=(1.35, 1.0, 0.8))
        path = plot_path(reference, canvas.add_subplot(grid[:, 0]), color="C5", linewidth=1.0, linestyle="--")
        plot_headings(poses, plot_path(point, path, color="C1"), colour="C0", count=14, length=0.06)
        rates = {"v [m/s]": run["v"], "omega [rad/s]": run["omega"]}
        plot_series(run.t, rates, canvas.add_subplot(grid[0, 1:]), unit="command")
        errors = {"x": 1000.0 * run["ex"], "y": 1000.0 * run["ey"]}
        plot_series(run.t, errors, canvas.add_subplot(grid[1, 1]), unit="error [mm]")
        plot_poles(tracker.stability(_STEP), canvas.add_subplot(grid[1, 2]))

    shown = slice(None, None, 5)
    scene = Scene(run.t[shown]).curve(reference, dashed=True).trail(point[shown]).body(poses[shown], _ROBOT)
    columns = ("t", "x", "y", "theta", "v", "omega", "ex", "ey")
    return Demo(
        name=name,
        title=title,
        tables={"run.csv": {column: run[column] for column in columns}},
        figure=figure,
        scene=scene.moving_point(reference[shown]),
        **words,
    )
