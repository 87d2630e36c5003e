"""Runs: their paths, commands and errors over time, each in a picture of its own, and all of them in one figure."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from coplanar.checks import ArrayLike
from coplanar.curves import Curve
from coplanar.errors import InvalidValue
from coplanar.run import Run
from coplanar.viz.axes import plot_headings, plot_path, plot_series
from coplanar.viz.paper import Axes, Paper, new_figure, panels
from coplanar.viz.traces import plot_joints

UNITS = {
    "x": "m", "y": "m", "theta": "rad", "v": "m/s", "vx": "m/s", "vy": "m/s", "omega": "rad/s", "ex": "m", "ey": "m",
    "rho": "m", "alpha": "rad", "beta": "rad",
}  # fmt: skip
MILLI = 0.1  # [m] errors that stay below are drawn in millimetres


def plot_track(
    run: Run, ax: Axes | None = None, *, reference: Curve | ArrayLike | None = None, point: ArrayLike | None = None,
    count: int = 14, length: float | None = None,
) -> Axes:  # fmt: skip
    """The path of a run with robots along it, each a disc with its heading line; the reference dashed.

    Args:
        run: With columns x and y; robots are drawn where it has theta.
        ax: Where to draw; a new figure if None.
        reference: What was followed: a curve, or points (n, 2) [m].
        point: The point on the robot whose path is drawn, (px, py) [m]; its centre if None.
        count: How many robots are drawn, of one run; of a batch only the paths.
        length: Radius of the discs [m]; a part of the path's extent if None.
    """
    paper = Paper.plane(ax)
    if reference is not None:
        plot_path(reference, paper.ax, color="reference", linewidth=1.2, linestyle=(0, (5, 3)), label="reference")
    posed, one = "theta" in run.columns, not run.shape
    path = run if point is None else np.moveaxis(run.poses @ np.asarray(point, np.float64), 0, -2)
    label = "path" if reference is not None else None
    plot_path(path, paper.ax, label=label, color="trail" if one else None, zorder=3)
    if one and posed:
        plot_headings(run, paper.ax, count=count, length=length)
    paper.legend()
    return paper.ax


def plot_commands(run: Run, ax: Axes | None = None, *, names: tuple[str, ...] = ()) -> Axes:
    """What drove a run, against time; a command that holds over each step is drawn in steps.

    Args:
        run: With commands; of a batch every member is drawn.
        ax: Where to draw; a new figure if None.
        names: Which of its commands; all of them if empty.

    Raises:
        InvalidValue: If the run has no commands.
        UnknownName: If there is no such column.

    Example:
        >>> run = Run({"t": [0.0, 1.0], "v": [0.0, 2.0], "omega": [0.0, 0.5]}, "unicycle")
        >>> plot_commands(run).get_ylabel()
        'v [m/s], omega [rad/s]'
    """
    chosen = names or _some(run.names.commands, "commands")
    columns = {name: run[name] for name in chosen}
    return plot_series(run.t, columns, ax, unit=_units(chosen), held=set(chosen) <= set(run.names.held))


def plot_errors(run: Run, ax: Axes | None = None, *, names: tuple[str, ...] = ()) -> Axes:
    """The errors of a run against time, in millimetres where lengths stay below a decimetre.

    Args:
        run: With errors; of a batch every member is drawn.
        ax: Where to draw; a new figure if None.
        names: Which of its errors; those that are lengths, or else all, if empty.

    Raises:
        InvalidValue: If the run has no errors.
    """
    every = _some(run.names.errors, "errors")
    chosen = names or tuple(name for name in every if UNITS.get(name) == "m") or every
    lengths = all(UNITS.get(name) == "m" for name in chosen)
    largest = max(float(np.nanmax(np.abs(_finite(run[name])), initial=0.0)) for name in chosen)
    factor, unit = (1e3, "mm") if lengths and largest < MILLI else (1.0, "m")
    columns = {name: factor * run[name] for name in chosen}
    words = "error" if len(chosen) > 1 else f"error {chosen[0]}"
    return plot_series(run.t, columns, ax, unit=f"{words} [{unit}]" if lengths else _units(chosen))


def plot_columns(run: Run, ax: Axes | None = None, *, names: tuple[str, ...] = (), unit: str = "") -> Axes:
    """Columns of a run against its index.

    Args:
        run: Any run; of a batch every member is drawn.
        ax: Where to draw; a new figure if None.
        names: Which columns; all but the index if empty.
        unit: For the label of the vertical axis; that of the columns where it is known.
    """
    chosen = names or tuple(name for name in run.columns if name != run.index)
    label = "time [s]" if run.index == "t" else run.index
    shown = unit or (_units(chosen) if len(chosen) <= 3 else "value")
    return plot_series(run.t, {name: run[name] for name in chosen}, ax, unit=shown, xlabel=label)


def plot_run(
    run: Run, figure: Any = None, *, reference: Curve | ArrayLike | None = None, point: ArrayLike | None = None
) -> Any:
    """Everything there is to see of a run in one figure: its path, and what it has of commands, joints and errors.

    Args:
        run: A run of any kind.
        figure: Matplotlib's; a new one if None.
        reference: What was followed, for the path.
        point: The point on the robot whose path is drawn [m].

    Returns:
        The figure.
    """
    has_path = {"x", "y"} <= set(run.columns)
    drawn = _pictures(run, has_path)
    if figure is None:
        figure = new_figure(8.6 if has_path and drawn else 6.4, max(4.2, 1.6 * len(drawn)))
    places = _places(figure, len(drawn), has_path)
    if has_path:
        plot_track(run, places.pop(0), reference=reference, point=point)
    for ax, draw in zip(places, drawn, strict=True):
        draw(ax)
    for ax in figure.axes:
        ax.label_outer()
    return figure


def _pictures(run: Run, has_path: bool) -> list[Callable[[Axes], Any]]:
    """What is drawn over time beside the path."""
    drawn = [_command(run, name) for name in run.names.commands]
    if run.names.errors:
        drawn.append(lambda ax: plot_errors(run, ax))
    if run.kind == "arm":
        drawn.insert(0, lambda ax: plot_joints(run, ax))
    if run.kind == "flight":
        drawn += [
            lambda ax: plot_columns(run, ax, names=("x", "y"), unit="position [m]"),
            lambda ax: plot_columns(run, ax, names=("vx", "vy"), unit="velocity [m/s]"),
        ]
    return drawn if drawn or has_path else [lambda ax: plot_columns(run, ax)]


def _command(run: Run, name: str) -> Callable[[Axes], Any]:
    return lambda ax: plot_commands(run, ax, names=(name,))


def _places(figure: Any, count: int, has_path: bool) -> list[Axes]:
    """Axes for the path at the left and for ``count`` pictures above one another."""
    if not (has_path and count):
        return _column(figure, count or 1)
    left, right = figure.subfigures(1, 2, width_ratios=(1.15, 1.0))
    for part in (left, right):
        part.set_facecolor(figure.get_facecolor())
    return [panels(left, 1, 1)[0, 0], *_column(right, count)]


def _column(figure: Any, count: int) -> list[Axes]:
    """Axes above one another that share their times."""
    return list(panels(figure, count, 1, sharex=True)[:, 0])


def _some(names: tuple[str, ...], what: str) -> tuple[str, ...]:
    if not names:
        raise InvalidValue("run", f"no {what}", f"a run with {what}", "its kind says which columns are what")
    return names


def _units(names: tuple[str, ...]) -> str:
    """Names with their units, those of one unit together."""
    groups: dict[str, list[str]] = {}
    for name in names:
        groups.setdefault(UNITS.get(name, ""), []).append(name)
    return ", ".join(f"{', '.join(group)} [{unit}]" if unit else ", ".join(group) for unit, group in groups.items())


def _finite(column: np.ndarray) -> np.ndarray:
    return np.where(np.isfinite(column), column, np.nan)
