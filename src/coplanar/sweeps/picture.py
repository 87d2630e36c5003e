"""A sweep as a picture: a line over one varied key, colours over two."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coplanar.errors import InvalidValue
from coplanar.viz.axes import axes_or_new

if TYPE_CHECKING:
    from coplanar.sweeps.result import Sweep

MOST_CELLS = 40_000


def plot_sweep(table: Sweep, measure: str, ax: Any = None) -> Any:
    """A measure against one varied key, as points and the median; over two keys, as colours.

    Args:
        table: The sweep.
        measure: The name of a measured column.
        ax: Where to draw; a new figure if None.

    Returns:
        The axes.
    """
    values = table[measure]
    if values.dtype.kind not in "fib":
        raise InvalidValue("measure", measure, "a column of numbers")
    keys = [key for key in table.varied if table[key].dtype.kind in "fi" and len(np.unique(table[key])) > 1]
    keys = keys if len(keys) < 3 else [key for key in keys if key != "noise.seed"]
    if not 1 <= len(keys) <= 2:
        raise InvalidValue("varied", keys, "one or two keys whose values are numbers")
    ax = axes_or_new(ax)
    ax.set_xlabel(keys[0])
    if len(keys) == 1:
        return _line(table[keys[0]], values, measure, ax)
    ax.set_ylabel(keys[1])
    return _colours(table[keys[0]], table[keys[1]], values, measure, ax)


def _line(x: np.ndarray, values: np.ndarray, measure: str, ax: Any) -> Any:
    places, which = np.unique(x, return_inverse=True)
    ax.set_ylabel(measure)
    if len(places) == len(x):
        order = np.argsort(x)
        ax.plot(x[order], values[order], ".-" if len(x) <= 60 else "-")
        return ax
    ax.plot(x, values, ".", alpha=0.35, markersize=4)
    ax.plot(places, [np.nanmedian(values[which == k]) for k in range(len(places))], "-", label="median")
    ax.legend()
    return ax


def _colours(x: np.ndarray, y: np.ndarray, values: np.ndarray, measure: str, ax: Any) -> Any:
    columns, i = np.unique(x, return_inverse=True)
    rows, j = np.unique(y, return_inverse=True)
    numbers = values.astype(np.float64)
    if len(columns) * len(rows) > min(MOST_CELLS, 4 * len(x)):  # draws, not a grid
        drawn = ax.scatter(x, y, c=numbers, s=12, cmap="cividis")
    else:
        total, count = np.zeros((2, len(rows), len(columns)))
        np.add.at(total, (j, i), numbers)
        np.add.at(count, (j, i), 1.0)
        with np.errstate(invalid="ignore"):
            drawn = ax.pcolormesh(columns, rows, total / count, cmap="cividis", shading="nearest")
    ax.grid(False)
    ax.figure.colorbar(drawn, ax=ax, label=measure)
    return ax
