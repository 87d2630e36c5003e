"""Driving: histories, programs, holonomic motion, ramps, integrators."""

from __future__ import annotations

from math import tau
from typing import Any

import numpy as np

from coplanar.scenarios import Outcome
from coplanar.viz.axes import plot_headings, plot_path, plot_series
from coplanar.viz.integrators import plot_convergence, plot_integrators
from coplanar.viz.scene import Scene

ROBOT = np.array([(0.1 * np.cos(a), 0.1 * np.sin(a)) for a in np.linspace(0.0, tau, 37)])
CRATE = 0.105 * np.array([(1, 1), (-1, 1), (-1, -1), (1, -1), (1, 1)])
FRAMES = 400  # of a scene: a page that holds more than this only grows


def draw_drive(outcome: Outcome, canvas: Any) -> None:
    """The path with headings, and the commands."""
    history, path = outcome.things["history"], outcome.things["path"].as_array()
    left, right = canvas.subplots(1, 2, width_ratios=(1.2, 1))
    plot_headings(path, plot_path(path, left, color="C1"), colour="C0", length=size_of(path))
    left.set_title(f"{outcome.scenario.method}, {np.diff(history.t)[0]:g} s")
    for name in ("v", "omega"):
        unit = "m/s" if name == "v" else "rad/s"
        right.step(history.t, outcome.tables["run.csv"][name], where="post", label=f"{name} [{unit}]")
    right.set_xlabel("time [s]")
    right.legend()


def draw_program(outcome: Outcome, canvas: Any) -> None:
    """The path with headings and joints, and v and omega."""
    program, start, path = outcome.things["program"], outcome.things["start"], outcome.things["path"].as_array()
    left, right = canvas.subplots(1, 2, width_ratios=(1.4, 1))
    plot_headings(path, plot_path(path, left, color="C1"), colour="C0", count=16, length=size_of(path))
    if len(program) > 1:
        knots = program.poses(start)
        left.plot(knots.x, knots.y, "s", color="C3", markersize=5)
        left.set_title(f"{len(program)} segments; squares mark the joints")
    run = outcome.run
    if run is not None:
        plot_series(run.t, {"v [m/s]": run["v"], "omega [rad/s]": run["omega"]}, right, unit="velocity")


def path_scene(outcome: Outcome) -> Scene | None:
    """A disc that drives the path."""
    run = outcome.run
    if run is None:
        return None
    shown = thinned(len(run))
    path = run.poses.as_array()[shown]
    return Scene(run.t[shown]).trail(path[:, :2]).body(path, ROBOT * (size_of(path) / 0.1))


def draw_holonomic(outcome: Outcome, canvas: Any) -> None:
    """The path, and the velocities."""
    path, run = outcome.things["path"], outcome.run
    left, right = canvas.subplots(1, 2, width_ratios=(1.3, 1))
    plot_path(path.position, left, color="C1")
    if run is not None:
        series = {"vx": run["vx"], "vy": run["vy"], "speed": outcome.things["motion"].speed(run.t)}
        plot_series(run.t, series, right, unit="velocity [m/s]")


def holonomic_scene(outcome: Outcome) -> Scene | None:
    """A crate that moves and turns on its own terms."""
    run = outcome.run
    if run is None:
        return None
    shown = thinned(len(run))
    path = run.poses.as_array()[shown]
    return Scene(run.t[shown]).trail(path[:, :2]).body(path, CRATE)


def draw_ramp(outcome: Outcome, canvas: Any) -> None:
    """Both sorts of ramp as paths, and the velocities of the one that was asked for."""
    ramp, other, t = outcome.things["ramp"], outcome.things["other"], outcome.tables["run.csv"]["t"]
    names = ("synchronised", "independent") if outcome.scenario.together else ("independent", "synchronised")
    left, right = canvas.subplots(1, 2, width_ratios=(1.2, 1))
    for one, name in zip((ramp, other), names, strict=True):
        plot_path(one.position((0.0, 0.0), t), left, label=name)
    left.legend()
    velocity = outcome.things["velocity"]
    plot_series(t, {"vx": velocity[:, 0], "vy": velocity[:, 1]}, right, unit="velocity [m/s]")


def ramp_scene(outcome: Outcome) -> Scene:
    """A point that speeds up and slows down."""
    t, position = np.asarray(outcome.tables["run.csv"]["t"]), outcome.things["position"]
    shown = thinned(len(t))
    return Scene(t[shown]).trail(position[shown]).moving_point(position[shown])


def draw_lab(outcome: Outcome, canvas: Any) -> None:
    """The paths of every method with the longest step, and the errors over the step."""
    left, right = canvas.subplots(1, 2, width_ratios=(1.1, 1))
    plot_integrators(outcome.things["comparison"], left)
    plot_convergence(outcome.things["comparison"], right, tolerance=outcome.scenario.tolerance)


def thinned(count: int) -> slice:
    """Every k-th of so many rows, so that a scene keeps to ``FRAMES``."""
    return slice(None, None, max(1, -(-count // FRAMES)))


def size_of(path: np.ndarray) -> float:
    """Radius of a disc that suits a path [m]."""
    spread = float(np.ptp(path[:, :2], axis=0).max())
    return min(0.1, max(0.04 * spread, 0.01))
