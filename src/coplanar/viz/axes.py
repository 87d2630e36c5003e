"""Axes that every picture shares: equal scales, units on the labels, nothing shown and nothing blocked."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np

from coplanar.checks import ArrayLike

Axes = Any  # matplotlib.axes.Axes; Matplotlib is imported when something is drawn


def axes_or_new(ax: Axes | None) -> Axes:
    """The given axes, or those of a new figure."""
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.subplots()[1]


def plane(ax: Axes, title: str = "") -> Axes:
    """Axes of the plane: x and y in metres at the same scale."""
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    if title:
        ax.set_title(title)
    return ax


def plot_path(points: ArrayLike, ax: Axes | None = None, **line: Any) -> Axes:
    """A path through points (n, 2) [m], its start marked.

    Args:
        points: The path.
        ax: Where to draw; a new figure if None.
        **line: Passed to Matplotlib's ``plot``.

    Returns:
        The axes.
    """
    ax = plane(axes_or_new(ax))
    xy = np.asarray(points)
    (drawn,) = ax.plot(xy[:, 0], xy[:, 1], **line)
    ax.plot(xy[:1, 0], xy[:1, 1], "o", color=drawn.get_color(), markersize=4)
    return ax


def plot_headings(
    poses: ArrayLike, ax: Axes | None = None, *, count: int = 12, length: float = 0.1, colour: Any = None
) -> Axes:
    """Discs with a heading line along a path of poses (n, 3), as robots are drawn.

    Args:
        poses: x, y [m] and heading [rad].
        ax: Where to draw; a new figure if None.
        count: How many of the poses are drawn.
        length: Radius of the disc [m].
        colour: Of the discs; the theme's first colour if None.
    """
    ax = plane(axes_or_new(ax))
    table = np.asarray(poses)
    colour = colour or ax._get_lines.get_next_color()
    around = np.linspace(0.0, 2.0 * np.pi, 41)
    for i in np.unique(np.linspace(0, len(table) - 1, count).round().astype(int)):
        x, y, theta = table[i]
        ax.fill(x + length * np.cos(around), y + length * np.sin(around), facecolor=colour, alpha=0.18, linewidth=0)
        ax.plot([x, x + length * np.cos(theta)], [y, y + length * np.sin(theta)], color=colour, linewidth=1.2)
    return ax


def plot_series(
    t: ArrayLike, columns: dict[str, ArrayLike], ax: Axes | None = None, *, unit: str, xlabel: str = "time [s]"
) -> Axes:
    """Quantities of one unit against time, each named.

    Args:
        t: Times [s] or whatever ``xlabel`` says.
        columns: Name to values.
        ax: Where to draw; a new figure if None.
        unit: For the label of the vertical axis, with the quantity: "error [m]".
        xlabel: Label of the horizontal axis.
    """
    ax = axes_or_new(ax)
    for name, values in columns.items():
        ax.plot(np.asarray(t), np.asarray(values), label=name)
    ax.set_xlabel(xlabel)
    ax.set_ylabel(unit)
    if len(columns) > 1:
        ax.legend()
    return ax


def plot_linkage(joints: ArrayLike, ax: Axes | None = None, *, colours: Sequence[Any] = (), alpha: float = 1.0) -> Axes:
    """An arm as its links between joints (n, 2) [m], base first.

    Args:
        joints: Joint points and the tool.
        ax: Where to draw; a new figure if None.
        colours: One per link; the theme's if empty.
        alpha: Opacity, for an arm's other postures.
    """
    ax = plane(axes_or_new(ax))
    points = np.asarray(joints)
    for i, (start, end) in enumerate(itertools.pairwise(points)):
        style = {"color": colours[i % len(colours)]} if colours else {}
        ax.plot(*zip(start, end, strict=True), linewidth=6, alpha=alpha, solid_capstyle="round", zorder=3, **style)
    ax.plot(points[:, 0], points[:, 1], "o", color=ax.get_facecolor(), markeredgecolor="C5", markersize=6,
            markeredgewidth=1.5, alpha=alpha, zorder=4)  # fmt: skip
    return ax
