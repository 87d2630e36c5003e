"""Pictures that others are made of: paths, robots along them, quantities over time, links."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from coplanar.checks import ArrayLike
from coplanar.curves import Curve
from coplanar.errors import InvalidShape
from coplanar.run import Run
from coplanar.se2 import Pose
from coplanar.viz.paper import Axes, Paper

APART = 0.4  # of a robot's radius, plus radians turned: nearer than this, robots are drawn as one
CURVE_POINTS = 401  # of a curve that is drawn as a path


def axes_or_new(ax: Axes | None) -> Axes:
    """The given axes, or those of a new figure."""
    return Paper.on(ax).ax


def plane(ax: Axes, title: str = "") -> Axes:
    """Axes of the plane: x and y in metres at the same scale."""
    return Paper.plane(ax, title).ax


def plot_path(path: Run | Pose | Curve | ArrayLike, ax: Axes | None = None, **line: Any) -> Axes:
    """A path, its start marked.

    Args:
        path: A run or poses, whose positions are drawn; a curve; or points (..., n, 2) [m], which may have a third
            column. Every member of a batch is drawn; more than six share one colour.
        ax: Where to draw; a new figure if None.
        **line: Passed to Matplotlib's ``plot``: ``label``, ``color``, ``linestyle``. Colours may be roles ("trail").

    Returns:
        The axes.

    Example:
        >>> ax = plot_path([(0, 0), (1, 2)])
        >>> ax.get_xlabel(), ax.lines[0].get_xydata().tolist()
        ('x [m]', [[0.0, 0.0], [1.0, 2.0]])
    """
    paper = Paper.plane(ax)
    members = path_points(path)
    for xy, colour in zip(members, paper.lines(members, **line), strict=True):
        if not isinstance(path, Curve):
            paper.dots(xy[:1], colour, size=4.5)
    return paper.ax


def plot_headings(
    poses: ArrayLike | Pose | Run, ax: Axes | None = None, *, count: int = 12, length: float | None = None,
    colour: Any = "body",
) -> Axes:  # fmt: skip
    """Discs with a heading line along a path of poses, as robots are drawn.

    Args:
        poses: A run, poses of shape (..., n), or x, y [m] and heading [rad], shape (..., n, 3).
        ax: Where to draw; a new figure if None.
        count: How many of the poses are drawn, evenly over the rows; of those that nearly coincide one.
        length: Radius of the disc [m]; a part of the path's extent if None.
        colour: Of the discs.
    """
    paper = Paper.plane(ax)
    for table in pose_rows(poses):
        table = table[np.isfinite(table).all(axis=1)]
        radius = robot_radius(table[:, :2]) if length is None else length
        rows = table[np.unique(np.linspace(0, len(table) - 1, min(count, len(table))).round().astype(int))]
        _robots(paper, _apart(rows, radius), radius, colour)
    return paper.ax


def plot_series(
    t: ArrayLike, columns: Mapping[str, ArrayLike], ax: Axes | None = None, *, unit: str, xlabel: str = "time [s]",
    held: bool = False,
) -> Axes:  # fmt: skip
    """Quantities of one unit against time, each named.

    Args:
        t: Times [s] or whatever ``xlabel`` says, shape (n,).
        columns: Name to values, shape (n,), or (n, ...) for a batch.
        ax: Where to draw; a new figure if None.
        unit: For the label of the vertical axis, with the quantity: "error [m]".
        xlabel: Label of the horizontal axis.
        held: Draw steps: each value holds over the interval that ends in its row.
    """
    paper = Paper.on(ax, xlabel=xlabel, ylabel=unit)
    times = np.asarray(t, np.float64)
    for name, values in columns.items():
        members = np.asarray(values, np.float64).reshape(len(times), -1)
        colour, faint = paper.next_colour(), 1.0 if members.shape[1] == 1 else max(0.15, members.shape[1] ** -0.5)
        style = {"drawstyle": "steps-pre"} if held else {}
        for i, column in enumerate(members.T):
            xy = np.column_stack([times, column])
            paper.line(xy, colour, linewidth=1.5, alpha=faint, label="_" if i else name, **style)
    if len(columns) > 1:
        paper.legend()
    return paper.ax


def plot_linkage(joints: ArrayLike, ax: Axes | None = None, *, colours: Sequence[Any] = (), alpha: float = 1.0) -> Axes:
    """An arm as its links between joints (..., n, 2) [m], base first.

    Args:
        joints: Joint points and the tool.
        ax: Where to draw; a new figure if None.
        colours: Of the links, one after the other; those of links if empty.
        alpha: Opacity, for an arm's other postures.
    """
    paper = Paper.plane(ax)
    table = np.asarray(joints, np.float64)
    shown = colours or ("link",)
    for points in table.reshape(-1, *table.shape[-2:]):
        for i, link in enumerate(itertools.pairwise(points)):
            paper.line(np.array(link), shown[i % len(shown)], linewidth=6, alpha=alpha, zorder=3)
        paper.dots(points, shown[0], size=6, hollow=True, alpha=alpha)
    return paper.ax


def path_points(path: Any) -> np.ndarray:
    """The points of a run, of poses, of a curve, or points as they are: shape (members, n, 2) [m].

    Raises:
        InvalidShape: If the points are not (..., n, 2).
    """
    if isinstance(path, Curve):
        xy = path.position(path.parameters(CURVE_POINTS))
    elif isinstance(path, Run):
        xy = np.moveaxis(path.stacked("x", "y"), 0, -2)
    else:
        xy = path.position if isinstance(path, Pose) else np.asarray(path, np.float64)
    if xy.ndim < 2 or xy.shape[-1] not in (2, 3):
        raise InvalidShape("path", f"shape {xy.shape}", "points of shape (..., n, 2), or poses of shape (..., n, 3)")
    return xy[..., :2].reshape(-1, *xy.shape[-2:-1], 2)


def pose_rows(poses: Any) -> np.ndarray:
    """The rows of a run, of poses, or (x, y, theta) as they are: shape (members, n, 3).

    Raises:
        InvalidShape: If the table is not (..., n, 3).
    """
    if isinstance(poses, Run):
        table = np.moveaxis(poses.stacked("x", "y", "theta"), 0, -2)
    else:
        table = poses.as_array() if isinstance(poses, Pose) else np.asarray(poses, np.float64)
    if table.ndim < 2 or table.shape[-1] != 3:
        raise InvalidShape("poses", f"shape {table.shape}", "x, y and heading of shape (..., n, 3)")
    return table.reshape(-1, *table.shape[-2:])


def robot_radius(points: np.ndarray) -> float:
    """A radius for robots along a path (n, 2): a twentieth of its extent [m], 0.1 m where it has none."""
    extent = float(np.ptp(points, axis=0).max(initial=0.0)) if len(points) else 0.0
    return 0.05 * extent if extent > 0.0 else 0.1


def disc(radius: float, count: int = 41) -> np.ndarray:
    """A closed circle about the origin, shape (count, 2) [m]."""
    around = np.linspace(0.0, 2.0 * np.pi, count)
    return radius * np.column_stack([np.cos(around), np.sin(around)])


def _apart(rows: np.ndarray, radius: float) -> np.ndarray:
    """Poses without those that nearly coincide with the one kept before."""
    kept = rows[:1]
    for row in rows[1:]:
        moved = float(np.hypot(*(row - kept[-1])[:2])) / radius + abs(row[2] - kept[-1][2])
        kept = np.vstack([kept, row]) if moved > APART else kept
    return kept


def _robots(paper: Paper, rows: np.ndarray, radius: float, colour: Any) -> None:
    placed = Pose(*rows.T)
    noses = placed @ np.array([radius, 0.0])
    for centre, nose in zip(rows[:, :2], noses, strict=True):
        paper.region(centre + disc(radius), colour=colour, alpha=0.16, edge=0.8)
        paper.line(np.array([centre, nose]), colour, linewidth=1.4, zorder=3)
