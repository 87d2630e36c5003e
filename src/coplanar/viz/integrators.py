"""Integrators: their paths over one another, and their error against the step."""

from __future__ import annotations

import numpy as np

from coplanar.motion import Comparison
from coplanar.viz.paper import Axes, Paper

FINE = 401  # points of the exact path


def plot_integrators(comparison: Comparison, ax: Axes | None = None, *, step: float | None = None) -> Axes:
    """The paths that several integrators make of one motion, over the exact one; the legend says how far they are off.

    Args:
        comparison: Of integrators.
        ax: Where to draw; a new figure if None.
        step: Of every method [s]; the longest compared if None.
    """
    paper = Paper.plane(ax)
    h = float(np.max(comparison.steps)) if step is None else step
    exact = comparison.program.pose(comparison.start, np.linspace(0.0, comparison.program.duration, FINE))
    paper.line(exact.position, "reference", linewidth=4.5, alpha=0.35, label="exact")
    for k, method in enumerate(comparison.methods):
        path = comparison.path(method, h)[1].position
        label = f"{method}, {comparison.error(method, h):.2g} m off"
        paper.line(path, f"C{k}", linewidth=1.5, marker="o", markersize=3.0, label=label)
    paper.title(f"steps of {h:.3g} s")
    paper.legend()
    return paper.ax


def plot_convergence(comparison: Comparison, ax: Axes | None = None, *, tolerance: float | None = 1e-3) -> Axes:
    """The error of several integrators against their step, logarithmic, with orders; the largest step for a tolerance.

    Args:
        comparison: Of integrators.
        ax: Where to draw; a new figure if None.
        tolerance: Error for which the largest step is sought and marked [m]; None for none.

    Example:
        >>> from coplanar import Pose, Program, Segment
        >>> ax = plot_convergence(Comparison(Program([Segment(1.0, 1.0, duration=2.0)]), Pose(), ("euler", "rk4")))
        >>> ax.get_xlabel(), len(ax.get_legend().get_texts())
        ('step [s]', 2)
    """
    paper = Paper.on(ax, xlabel="step [s]", ylabel="largest error [m]")
    paper.ax.set_xscale("log")
    paper.ax.set_yscale("log")
    errors = comparison.errors()
    for k, (method, order) in enumerate(zip(comparison.methods, comparison.orders(errors), strict=True)):
        label = f"{method}, order {order:.1f}" if np.isfinite(order) else method
        if tolerance is not None:
            label += f"; {_marked(comparison, method, tolerance, f'C{k}', paper)}"
        shown = errors[k] > 0.0
        xy = np.column_stack([comparison.steps, errors[k]])[shown]
        paper.line(xy, f"C{k}", marker="o", markersize=4.0, linewidth=1.5, label=label)
    if tolerance is not None:
        paper.ax.axhline(tolerance, color=paper.theme.muted, linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)
    paper.legend()
    return paper.ax


def _marked(comparison: Comparison, method: str, tolerance: float, colour: str, paper: Paper) -> str:
    """The largest step for a tolerance as a mark, and in words."""
    name = "1 mm" if tolerance == 1e-3 else f"{tolerance:g} m"
    step = comparison.largest_step(method, tolerance)
    if not step:
        return f"{name}: no step"
    paper.dots([(step, max(comparison.error(method, step), 1e-16))], colour, marker="D", size=7, hollow=True)
    return f"{name}: {step:.3g} s"
