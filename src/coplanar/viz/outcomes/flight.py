"""Flight: shots, and launches that are aimed."""

from __future__ import annotations

from math import degrees
from typing import Any

import numpy as np

from coplanar.scenarios import Outcome
from coplanar.viz.axes import plane, plot_series
from coplanar.viz.flight import plot_envelope, plot_shot
from coplanar.viz.outcomes.driving import thinned
from coplanar.viz.scene import Scene


def draw_shot(outcome: Outcome, canvas: Any) -> None:
    """The path with its apex, and the velocities."""
    way, apex = outcome.things["way"], outcome.things["shot"].apex()
    left, right = canvas.subplots(1, 2, width_ratios=(1, 1.2))
    plane(left, "path").plot(way.x, way.y, color="C1")
    left.plot(apex.x, apex.y, "o", color="C3")
    left.annotate("apex", (apex.x, apex.y), textcoords="offset points", xytext=(6, 6))
    plot_series(way.time, {"vx": way.vx, "vy": way.vy}, right, unit="velocity [m/s]")


def shot_scene(outcome: Outcome) -> Scene:
    """The projectile on its path."""
    way = outcome.things["way"]
    shown = thinned(len(way.time))
    return Scene(way.time[shown]).trail(way.position[shown]).moving_point(way.position[shown])


def draw_aim(outcome: Outcome, canvas: Any) -> None:
    """Every arc, the target, and the envelope of a given speed; what falls short shows by how much."""
    aim, arcs, scenario = outcome.things["aim"], outcome.things["arcs"], outcome.scenario
    ax = canvas.subplots()
    if scenario.speed is not None and aim.projectile.gravity > 0.0 and not any(scenario.start):
        down = np.arctan2(*aim.target[::-1]) if aim.target[0] > 0.0 else 0.0
        plot_envelope(aim.projectile, scenario.speed, ax, lowest=min(-0.05, float(down)))
    for arc, name in zip(arcs, ("low arc", "high arc") if len(arcs) > 1 else ("launch",), strict=False):
        plot_shot(arc.shot, arc.time, ax, label=f"{name}, {arc.speed:.4g} m/s at {degrees(arc.angle):.1f} deg")
    plane(ax).plot(*aim.target, "x", color="C3", markersize=9, markeredgewidth=2)
    if arcs:
        if not aim.hit:
            end = arcs[0].arrival().position
            ax.plot(*zip(end, aim.target, strict=True), "--", color="C3", linewidth=1.2)
        ax.legend()
    else:  # no launch at all: the line along which it would go
        ax.axline(
            tuple(aim.start), slope=float(np.tan(scenario.angle or 0.0)), linestyle="--", color="C5", linewidth=1.2
        )
        ax.plot(*aim.start, "o", color="C0")
    if not aim.hit:
        ax.set_title(aim.status.value, fontsize=9)


def aim_scene(outcome: Outcome) -> Scene | None:
    """The arcs, each at its own pace; what has arrived waits."""
    aim, arcs = outcome.things["aim"], outcome.things["arcs"]
    if not arcs:
        return None
    scene = Scene(np.linspace(0.0, max(arc.time for arc in arcs), 121))
    for arc, role in zip(arcs, ("first", "second"), strict=False):
        way = arc.shot.at(np.minimum(scene.times, arc.time)).position
        scene = scene.trail(way, role=role).moving_point(way, role=role)
    return scene.curve(np.array([aim.target, aim.target]), role="target").moving_point([aim.target] * 121)
