"""Tracking: a robot follows a reference, or drives to a pose."""

from __future__ import annotations

from typing import Any

import numpy as np

from coplanar.run import Run
from coplanar.scenarios import Outcome
from coplanar.viz.axes import plot_headings, plot_path, plot_series
from coplanar.viz.control import plot_poles
from coplanar.viz.outcomes.driving import ROBOT, size_of, thinned
from coplanar.viz.scene import Scene

FAR = 1e6  # [m, rad] a loop that is beyond has diverged, and nothing of it can be drawn


def draw_track(outcome: Outcome, canvas: Any) -> None:
    """Path, commands, errors and poles; the poles alone where the gains were refused."""
    run, report = outcome.run, outcome.things["report"]
    if run is None:
        plot_poles(report, canvas.subplots()).set_title("refused: a pole is outside the unit circle")
        return
    run = _finite(run)
    grid = canvas.add_gridspec(2, 3, width_ratios=(1.35, 1.0, 0.8))
    left = canvas.add_subplot(grid[:, 0])
    wanted, moved = _wanted(outcome, run), _moved(outcome, run)
    if wanted is not None:
        plot_path(wanted, left, color="C5", linewidth=1.0, linestyle="--")
    else:
        goal = outcome.things["controller"].goal
        plot_headings(goal.as_array()[None], left, count=1, colour="C3", length=size_of(run.poses.as_array()))
    poses = run.poses.as_array()
    plot_headings(poses, plot_path(moved, left, color="C1"), colour="C0", count=14, length=0.6 * size_of(poses))
    rates = {"v [m/s]": run["v"], "omega [rad/s]": run["omega"]}
    plot_series(run.t, rates, canvas.add_subplot(grid[0, 1:]), unit="command")
    errors, unit = _errors(run)
    plot_series(run.t, errors, canvas.add_subplot(grid[1, 1]), unit=unit)
    plot_poles(report, canvas.add_subplot(grid[1, 2]))


def track_scene(outcome: Outcome) -> Scene | None:
    """The robot, its tracked point's path, and the moving target."""
    if outcome.run is None:
        return None
    run = _finite(outcome.run)
    wanted, moved, poses = _wanted(outcome, run), _moved(outcome, run), run.poses.as_array()
    shown = thinned(len(run))
    if len(run.t[shown]) < 2:
        return None
    scene = Scene(run.t[shown])
    if wanted is not None:
        scene = scene.curve(wanted, dashed=True)
    scene = scene.trail(moved[shown]).body(poses[shown], ROBOT * (size_of(poses) / 0.1))
    if wanted is None:
        goal = outcome.things["controller"].goal.position
        return scene.moving_point([goal] * len(scene.times))
    return scene.moving_point(wanted[shown])


def _finite(run: Run) -> Run:
    """The rows of a run before it diverged."""
    good = (np.abs(run.states) < FAR).all(axis=1)
    rows = len(good) if good.all() else max(2, int(np.argmin(good)))
    return Run({name: column[:rows] for name, column in run.columns.items()}, run.kind, status=run.status)


def _wanted(outcome: Outcome, run: Run) -> Any:
    """The reference at the run's times; None for a goal."""
    reference = outcome.things["reference"]
    return None if reference is None else reference.position(run.t)


def _moved(outcome: Outcome, run: Run) -> Any:
    """The way of the tracked point, or of the robot's centre."""
    point = getattr(outcome.things["controller"], "point", (0.0, 0.0))
    return run.poses @ np.asarray(point)


def _errors(run: Run) -> tuple[dict[str, Any], str]:
    """The errors by name, and the label of their axis."""
    if "ex" in run.columns:
        return {"x": 1000.0 * run["ex"], "y": 1000.0 * run["ey"]}, "error [mm]"
    return {"rho [m]": run["rho"], "alpha [rad]": run["alpha"], "beta [rad]": run["beta"]}, "error"
