"""Wheels: one that rolls, and bases that stand on a table of them."""

from __future__ import annotations

from math import tau
from typing import Any

import numpy as np

from coplanar.scenarios import Outcome
from coplanar.viz.axes import plane, plot_path
from coplanar.viz.outcomes.driving import thinned
from coplanar.viz.scene import Scene
from coplanar.viz.wheels import plot_base


def draw_rolling(outcome: Outcome, canvas: Any) -> None:
    """The rim with its velocities, and the path of one rim point."""
    wheel, beta, velocity, turned = (outcome.things[name] for name in ("wheel", "beta", "velocity", "turned"))
    ax = plane(canvas.subplots(), "rim velocities, and the path of one rim point")
    plot_path(_path(outcome, turned), ax, color="C1")
    points, some = wheel.rim_position(beta), max(1, len(beta) // 12)
    ax.fill(*points.T, alpha=0.15)
    fastest = max(float(np.hypot(*velocity.T).max()), 1e-9)
    arrows = {"angles": "xy", "scale_units": "xy", "scale": fastest / wheel.radius, "width": 0.004, "color": "C0"}
    ax.quiver(*points[::some].T, *velocity[::some].T, **arrows)


def rolling_scene(outcome: Outcome) -> Scene | None:
    """The wheel on its road."""
    wheel, rate, slip, turned = (outcome.things[name] for name in ("wheel", "rate", "slip", "turned"))
    if rate == 0.0:
        return None
    way = np.sign(rate) * turned
    centre = wheel.centre_speed(rate, slip=slip) / rate * way
    around = np.linspace(0.0, tau, 49)
    rim = wheel.rim_position(around) - (0.0, wheel.radius)
    poses = np.column_stack([centre, np.full_like(centre, wheel.radius), -way - 0.25 * tau])
    road = [(float(centre.min()) - 0.4, 0.0), (float(centre.max()) + 0.4, 0.0)]
    path = _path(outcome, turned)
    return Scene(turned / abs(rate)).curve(road).body(poses, rim).trail(path).moving_point(path)


def _path(outcome: Outcome, turned: Any) -> Any:
    """The rim point that touched the road first, with slip."""
    wheel, rate, slip = (outcome.things[name] for name in ("wheel", "rate", "slip"))
    if rate == 0.0:
        return wheel.rim_position(0.0 * turned)
    way = np.sign(rate) * turned
    return wheel.rim_position(way, centre=wheel.centre_speed(rate, slip=slip) / rate * way)


def draw_base(outcome: Outcome, canvas: Any) -> None:
    """The base with its wheel rates and the motion that it makes."""
    base, twist, rates = (outcome.things[name] for name in ("base", "twist", "rates"))
    ax = plot_base(base, canvas.subplots())
    reach = max(max(np.hypot(wheel.x, wheel.y) for wheel in base.wheels), 2.0 * float(base.radii.max()))
    speed = max(float(np.hypot(twist.vx, twist.vy)), 1e-9)
    ax.quiver(0.0, 0.0, twist.vx, twist.vy, angles="xy", scale_units="xy", scale=speed / (0.7 * reach), color="C1")
    words = f"v = ({twist.vx:.3g}, {twist.vy:.3g}) m/s, omega = {twist.omega:.3g} rad/s"
    ax.set_title("\n".join([words, *base.cannot]), fontsize=9)
    for wheel, rate in zip(base.wheels, rates, strict=True):
        ahead = abs(wheel.x) > 2.0 * abs(wheel.y)  # beside such a wheel a centred text would reach into it
        side = ("left" if wheel.x > 0.0 else "right") if ahead else "center"
        ax.annotate(f"{rate:+.2f} rad/s", (1.5 * wheel.x, 1.5 * wheel.y), ha=side, va="center")
        ax.plot(1.5 * wheel.x, 1.5 * wheel.y, alpha=0.0)  # a text alone does not widen the axes
    ax.margins(0.3)


def base_scene(outcome: Outcome) -> Scene:
    """The base on the arc that a constant motion drives."""
    base, path, run = outcome.things["base"], outcome.things["path"].as_array(), outcome.run
    shown = thinned(len(path))
    corners = 1.25 * np.array(sorted(((w.x, w.y) for w in base.wheels), key=lambda p: np.arctan2(p[1], p[0])))
    times = np.arange(len(path)) if run is None else run.t
    scene = Scene(times[shown])
    return scene.body(path[shown], np.vstack([corners, corners[:1]])).trail(path[shown, :2])
