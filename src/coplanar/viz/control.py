"""Poles of a sampled loop, against the circle that they must stay in."""

from __future__ import annotations

import textwrap

import numpy as np

from coplanar.control.stability import StabilityReport
from coplanar.viz.axes import disc
from coplanar.viz.paper import Axes, Paper


def plot_poles(report: StabilityReport, ax: Axes | None = None, *, words: bool | None = None) -> Axes:
    r"""The poles of a loop and the unit circle, its stability boundary: inside, an error dies out.

    Args:
        report: Of one loop, or of an array of gains, whose poles are all drawn.
        ax: Where to draw; a new figure if None.
        words: Whether there are a legend and, above a single loop, its status; by default in a figure of its own.

    Example:
        >>> from coplanar.control import PointTracker
        >>> ax = plot_poles(PointTracker((0.05, 0.0), kp=100.0, kd=0.5).stability(0.01))
        >>> ax.get_title(loc="left")
        'exactly on the stability boundary: an error neither grows\nnor dies out'
    """
    paper = Paper.on(ax, xlabel="Re z", ylabel="Im z")
    spoken = ax is None if words is None else words
    circle = disc(1.0, 181)
    paper.region(circle, colour="third", alpha=0.08)
    paper.line(circle, "third", linewidth=1.4, label="stability boundary")
    poles = np.ravel(report.poles)
    paper.cross(_points(poles), label="along the path", size=8)
    if report.lateral_poles is not None:
        across = np.ravel(report.lateral_poles)
        poles = np.concatenate([poles, across])
        paper.dots(_points(across), "first", marker="+", size=10, markeredgewidth=2.0, label="across the path")
    paper.ax.set_aspect("equal")
    half = 1.12 * max(1.1, float(np.abs(_points(poles)).max()))
    paper.ax.set(xlim=(-half, half), ylim=(-half - 0.7 * spoken, half))
    if spoken and np.ndim(report.margin) == 0:
        paper.title(textwrap.fill(report.status.value, 58))
    if spoken:
        paper.legend(loc="lower center", fontsize=8)
    return paper.ax


def _points(poles: np.ndarray) -> np.ndarray:
    return np.column_stack([poles.real, poles.imag])
