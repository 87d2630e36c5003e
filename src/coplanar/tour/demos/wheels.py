"""Wheels: one that rolls, three that hold a base."""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np

from coplanar.se2 import Pose, Twist
from coplanar.tour.demo import Demo
from coplanar.viz.axes import plane, plot_path
from coplanar.viz.scene import Scene
from coplanar.viz.wheels import plot_base
from coplanar.wheels import RollingWheel, WheeledBase

OMNI_TWIST = Twist(0.5, 0.2, 1.0)  # the twist of the three-wheel demonstration [m/s, m/s, rad/s]


def rolling_wheel() -> Demo:
    """A wheel that rolls without slipping, and how its rim moves."""
    wheel, rate = RollingWheel(0.3), 2.0
    beta = np.linspace(0.0, 2.0 * pi, 73)
    velocity = wheel.rim_velocity(rate, beta)
    speed = np.hypot(*velocity.T)
    error = float(np.abs(speed - 2.0 * 0.3 * rate * np.abs(np.sin(0.5 * beta))).max())
    turned = np.linspace(0.0, 4.0 * pi, 241)
    path = wheel.rim_path(turned)

    def figure(canvas: Any) -> None:
        ax = plane(canvas.subplots(), "rim velocities, and the path of one rim point")
        plot_path(path, ax, color="C1")
        points = wheel.rim_position(beta)
        ax.fill(*points.T, alpha=0.15)
        ax.quiver(*points[::6].T, *velocity[::6].T, angles="xy", scale_units="xy", scale=4.0, width=0.004, color="C0")

    top = float(np.hypot(*wheel.top_velocity(rate)))
    return Demo(
        name="rolling-wheel",
        title="Rolling without slipping",
        headline=f"contact 0 m/s, centre {wheel.centre_speed(rate):.1f} m/s, top {top:.1f} m/s",
        check=f"distance from the contact times the turn rate: {error:.0e} m/s",
        passed=bool(error < 1e-15 and speed[0] == 0.0),
        story="The contact point stands still for an instant, and the wheel turns about it: the top moves twice as "
        "fast as the centre, and a rim point draws a cycloid.",
        tables={"run.csv": {"beta": beta, "vx": velocity[:, 0], "vy": velocity[:, 1]}},
        figure=figure,
        scene=_rolling_scene(wheel.radius, rate, turned, path),
    )


def omni_three() -> Demo:
    """Three omni wheels at 120 degrees and the rates that make a twist."""
    base = WheeledBase.omni(3, wheel_distance=0.2, radius=0.05)
    rates = base.inverse(OMNI_TWIST)
    placed = 2.0 * pi * np.arange(3) / 3.0
    by_hand = (-np.sin(placed) * OMNI_TWIST.vx + np.cos(placed) * OMNI_TWIST.vy + 0.2 * OMNI_TWIST.omega) / 0.05
    error = float(np.abs(rates - by_hand).max())
    back = float(np.abs(base.forward(rates).as_array() - OMNI_TWIST.as_array()).max())
    t = np.linspace(0.0, 6.0, 121)
    poses = Pose.exp(OMNI_TWIST.during(t)).as_array()

    def figure(canvas: Any) -> None:
        ax = plot_base(base, canvas.subplots())
        ax.quiver(0.0, 0.0, OMNI_TWIST.vx, OMNI_TWIST.vy, angles="xy", scale_units="xy", scale=4.0, color="C1")
        ax.set_title(f"v = ({OMNI_TWIST.vx}, {OMNI_TWIST.vy}) m/s, omega = {OMNI_TWIST.omega} rad/s")
        for wheel, rate in zip(base.wheels, rates, strict=True):
            ax.annotate(f"{rate:+.2f} rad/s", (1.5 * wheel.x, 1.5 * wheel.y), ha="center", va="center")

    return Demo(
        name="omni-three",
        title="Omnidirectional base with three wheels",
        headline=f"{', '.join(f'{r:+.2f}' for r in rates)} rad/s for (0.5, 0.2) m/s and 1 rad/s",
        check=f"the 3 x 3 matrix written out: {error:.0e} rad/s; forward of inverse: {back:.0e}",
        passed=bool(error < 1e-12 and back < 1e-12),
        story="One row per wheel turns a twist into wheel rates. Three wheels at 120 degrees give a square matrix of "
        "full rank, so the base moves in any direction while it turns; a constant twist drives an arc.",
        tables={"run.csv": {"wheel": base.names, "rate": rates}},
        figure=figure,
        scene=_omni_scene(base, t, poses),
    )


def _rolling_scene(radius: float, rate: float, turned: np.ndarray, path: np.ndarray) -> Scene:
    centre = radius * turned
    around = np.linspace(0.0, 2.0 * pi, 49)
    rim = radius * np.column_stack([np.cos(around), np.sin(around)])
    poses = np.column_stack([centre, np.full_like(centre, radius), -turned - 0.5 * pi])
    road = [(-0.4, 0.0), (float(centre[-1]) + 0.4, 0.0)]
    return Scene(turned / rate).curve(road).body(poses, rim).trail(path).moving_point(path)


def _omni_scene(base: WheeledBase, t: np.ndarray, poses: np.ndarray) -> Scene:
    corners = 1.25 * np.array([[w.x, w.y] for w in base.wheels])
    return Scene(t).body(poses, np.vstack([corners, corners[:1]])).trail(poses[:, :2])
