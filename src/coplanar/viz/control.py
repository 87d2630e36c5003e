"""Poles of a sampled loop, against the circle that they must stay in."""

from __future__ import annotations

import numpy as np

from coplanar.control.stability import StabilityReport
from coplanar.viz.axes import Axes, axes_or_new


def plot_poles(report: StabilityReport, ax: Axes | None = None) -> Axes:
    """The poles of a loop in the unit circle: inside, an error dies out.

    Args:
        report: Of one loop, not of an array of gains.
        ax: Where to draw; a new figure if None.
    """
    ax = axes_or_new(ax)
    around = np.linspace(0.0, 2.0 * np.pi, 181)
    ax.fill(np.cos(around), np.sin(around), alpha=0.08, linewidth=0)
    ax.plot(np.cos(around), np.sin(around), linewidth=1.0, color="C5")
    ax.plot(report.poles.real, report.poles.imag, "x", color="C3", markersize=8, markeredgewidth=2)
    ax.set_aspect("equal")
    ax.set_xlim(-1.35, 1.35)
    ax.set_ylim(-1.35, 1.35)
    ax.set_xlabel("Re z")
    ax.set_ylabel("Im z")
    return ax
