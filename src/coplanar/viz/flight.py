"""Shots: their paths, the limit of what a speed reaches."""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np

from coplanar.checks import Real
from coplanar.flight import Projectile, Shot
from coplanar.viz.axes import Axes, axes_or_new, plane


def plot_shot(shot: Shot, duration: Real, ax: Axes | None = None, *, count: int = 121, **line: Any) -> Axes:
    """The path of one shot up to a time.

    Args:
        shot: One shot.
        duration: [s].
        ax: Where to draw; a new figure if None.
        count: Points of the line.
        **line: Passed to Matplotlib's ``plot``.
    """
    ax = plane(axes_or_new(ax))
    way = shot.sample(duration, count=count)
    ax.plot(way.x, way.y, **line)
    return ax


def plot_envelope(projectile: Projectile, speed: float, ax: Axes | None = None, *, lowest: float = -0.6) -> Axes:
    """The limit of what a speed reaches to the right; targets beyond it are out of reach.

    Args:
        projectile: What flies.
        speed: [m/s].
        ax: Where to draw; a new figure if None.
        lowest: Direction from which the limit is drawn, up to straight up [rad].
    """
    ax = plane(axes_or_new(ax))
    points = projectile.envelope(speed, np.linspace(lowest, 0.5 * pi, 61))
    ax.plot(points[:, 0], points[:, 1], linestyle="--", linewidth=1.2, color="C5", label="envelope")
    return ax
