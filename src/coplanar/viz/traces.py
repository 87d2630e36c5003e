"""Traces: an arm along a curve, and its joints."""

from __future__ import annotations

import textwrap

import numpy as np

from coplanar.run import Run
from coplanar.tracing import Trace
from coplanar.viz.arms import plot_workspace
from coplanar.viz.axes import plot_linkage, plot_path, plot_series
from coplanar.viz.paper import Axes, Paper


def plot_trace(trace: Trace, ax: Axes | None = None, *, postures: int = 7, workspace: bool = True) -> Axes:
    """The curve, postures along it and the path of the tool; intervals that it cannot follow and singular points.

    Args:
        trace: Of an arm along a curve.
        ax: Where to draw; a new figure if None.
        postures: How many are drawn, evenly over the rows.
        workspace: Whether what the arm can reach is drawn behind it.
    """
    paper = Paper.plane(ax)
    if workspace:
        plot_workspace(trace.arm, paper.ax, label="_")
    plot_path(trace.curve, paper.ax, color="reference", linewidth=1.2, linestyle=(0, (5, 3)), label="curve")
    rows = np.unique(np.linspace(0, len(trace.q) - 1, postures).round().astype(int))
    for i in rows:
        plot_linkage(trace.arm.points(trace.q[i]), paper.ax, alpha=0.9 if i == rows[0] else 0.25)
    tool = np.where(trace.followed[:, None], trace.arm.forward(trace.q).position, np.nan)
    paper.line(tool, "trail", linewidth=2.2, zorder=3.5, label="tool")
    for failure in trace.failures:
        part = trace.curve.position(np.linspace(failure.first, failure.last, 81))
        paper.line(part, "target", linewidth=2.6, zorder=3.4, label=failure.reason.value)
    if trace.singular_points:
        places = trace.curve.position(np.array([point.parameter for point in trace.singular_points]))
        paper.dots(places, "third", marker="D", size=6, zorder=6, label="singular")
    paper.title(textwrap.fill(trace.status.value, 62))
    paper.legend()
    return paper.ax


def plot_joints(joints: Trace | Run, ax: Axes | None = None) -> Axes:
    """The joints of a trace over the parameter of its curve, or of a run over time; a trace's failures are shaded.

    Args:
        joints: A trace, or a run of the kind "arm".
        ax: Where to draw; a new figure if None.
    """
    if isinstance(joints, Run):
        columns = {name: joints[name] for name in joints.names.states}
        return plot_series(joints.t, columns, ax, unit="joint [rad]", xlabel="time [s]")
    slides = "P" in joints.arm.joints
    columns = {f"q{i + 1}": column for i, column in enumerate(joints.q.T)}
    unit = "joint [rad, m]" if slides else "joint [rad]"
    ax = plot_series(joints.parameters, columns, ax, unit=unit, xlabel="curve parameter")
    paper = Paper.on(ax)
    for failure in joints.failures:
        ax.axvspan(failure.first, failure.last, color=paper.theme.colour("target"), alpha=0.12, linewidth=0)
    return ax
