"""Integrators: their paths over one another, and their error against the step."""

from __future__ import annotations

import numpy as np

from coplanar.comparison import IntegratorComparison
from coplanar.errors import InvalidValue
from coplanar.viz.paper import Axes, Paper

FINE = 401  # points of the exact path


def plot_integrators(comparison: IntegratorComparison, ax: Axes | None = None, *, count: int | None = None) -> Axes:
    """The paths that several integrators make of one motion, over the exact one; the legend says how far they are off.

    A state of one entry is drawn against time, any other by its first two.

    Args:
        comparison: Of integrators.
        ax: Where to draw; a new figure if None.
        count: How many steps each takes; the fewest compared if None.
    """
    plane = len(comparison.start) > 1
    paper = Paper.plane(ax) if plane else Paper.on(ax, xlabel="time [s]", ylabel="state")
    steps = count or comparison.counts[0]
    t = comparison.times(FINE - 1)
    paper.line(_points(t, comparison.exact(t)), "reference", linewidth=4.5, alpha=0.35, label="exact")
    for method, colour in zip(comparison.methods, _colours(comparison), strict=True):
        error, times = comparison.error(method, steps), comparison.times(steps)
        words = "diverges" if not np.isfinite(error) else f"{error:.2g}{' m' if plane else ''} off"
        label = f"{method}, {words}"
        try:
            path = _points(times, comparison.path(method, steps))
        except InvalidValue:
            path = np.empty((0, 2))
        paper.line(path, colour, linewidth=1.5, marker="o", markersize=3.0, label=label)
    paper.title(f"{steps} steps of {comparison.duration / steps:.3g} s")
    paper.legend()
    return paper.ax


def plot_convergence(
    comparison: IntegratorComparison, ax: Axes | None = None, *, tolerance: float | None = 1e-3, unit: str = "m"
) -> Axes:
    """The error of several integrators against their step, logarithmic, with orders; the largest step for a tolerance.

    Args:
        comparison: Of integrators.
        ax: Where to draw; a new figure if None.
        tolerance: Error for which the largest step is sought and marked [the unit of what is measured]; None for none.
        unit: Of the error, for the label.

    Example:
        >>> from coplanar.comparison import compare_integrators
        >>> decay = compare_integrators(lambda t, y: -y, 1.0, [1.0], methods=("euler", "rk4"))
        >>> ax = plot_convergence(decay)
        >>> [text.get_text() for text in ax.get_legend().get_texts()][0]
        'euler, order 1.0; 1 mm: 0.00541 s'
    """
    paper = Paper.on(ax, xlabel="step [s]", ylabel=f"largest error [{unit}]")
    paper.ax.set_xscale("log")
    paper.ax.set_yscale("log")
    name = "1 mm" if tolerance == 1e-3 and unit == "m" else f"{tolerance:g} {unit}" if tolerance else ""
    for method, colour, errors in zip(comparison.methods, _colours(comparison), comparison.errors, strict=True):
        order = comparison.order(method)
        label = method if order is None else f"{method}, order {order:.1f}"
        if tolerance is not None:
            step = comparison.largest_step(method, tolerance)
            label += f"; {name}: {step:.3g} s" if step else f"; {name}: no step"
            if step:
                at = comparison.error(method, round(comparison.duration / step))
                paper.dots([(step, at)], colour, marker="D", size=7, hollow=True)
        shown = np.isfinite(errors) & (errors > 0.0)
        xy = np.column_stack([comparison.steps, errors])[shown]
        paper.line(xy, colour, marker="o", markersize=4.0, linewidth=1.5, label=label)
    if tolerance is not None:
        paper.ax.axhline(tolerance, color=paper.theme.muted, linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)
    paper.legend()
    return paper.ax


def _colours(comparison: IntegratorComparison) -> list[str]:
    return [f"C{i}" for i in range(len(comparison.methods))]


def _points(t: np.ndarray, states: np.ndarray) -> np.ndarray:
    return states[:, :2] if states.shape[1] > 1 else np.column_stack([t, states[:, 0]])
