"""Motion: segments, programs of them, ramps, holonomic motion; their paths and their velocities."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from coplanar.errors import InvalidShape
from coplanar.motion import HolonomicMotion, Program, Ramp, Segment, Trapezoid
from coplanar.se2 import Pose
from coplanar.viz.axes import plot_headings, plot_series, robot_radius
from coplanar.viz.paper import Axes, Paper

Velocities = Segment | Program | HolonomicMotion | Ramp | Trapezoid


def plot_segment(
    segment: Segment, ax: Axes | None = None, *, start: Pose | None = None, count: int = 161, headings: int = 7
) -> Axes:
    """The path of a segment with headings along it; a cusp, where it reverses, is marked.

    Args:
        segment: One segment or a batch, of which every member is drawn.
        ax: Where to draw; a new figure if None.
        start: Pose at time 0; the origin if None.
        count: Points of the line.
        headings: How many robots are drawn along it.

    Example:
        >>> ax = plot_segment(Segment(1.0, 0.5, duration=2.0))
        >>> ax.get_title(loc="left")
        'arc'
    """
    paper = Paper.plane(ax)
    first = Pose() if start is None else start
    shape = np.broadcast_shapes(segment.shape, first.shape)
    part = np.linspace(0.0, 1.0, count).reshape(-1, *(1,) * len(shape))
    poses = np.moveaxis(segment.pose(first, part * segment.duration).as_array(), 0, -2).reshape(-1, count, 3)
    paper.lines(poses[..., :2], None if len(poses) > 1 else "trail")
    if len(poses) == 1:
        plot_headings(poses[0], paper.ax, count=headings)
        paper.title(str(np.ravel(segment.kind)[0]))
    turned = np.broadcast_to(segment.cusp_time, shape)
    at = segment.pose(first, np.where(np.isfinite(turned), turned, 0.0)).position
    cusps = at[np.isfinite(turned)] if shape else at[None][np.isfinite(turned)[None]]
    if len(cusps):
        paper.dots(cusps, "target", marker="D", size=6, label="cusp")
        paper.legend()
    return paper.ax


def plot_program(
    program: Program, ax: Axes | None = None, *, start: Pose | None = None, count: int = 61, headings: int = 16
) -> Axes:
    """The path of a program, its segments in turn in two colours, with squares at the joints between them.

    Args:
        program: One program or a batch, of which every member is drawn.
        ax: Where to draw; a new figure if None.
        start: Pose at time 0; the origin if None.
        count: Points of the line of each segment.
        headings: How many robots are drawn along it, evenly in time.
    """
    paper = Paper.plane(ax)
    first = Pose() if start is None else start
    frames = program.poses(first)
    for i, segment in enumerate(program):
        begin = Pose(*(part[..., i] for part in frames.parts))
        part = np.linspace(0.0, 1.0, count).reshape(-1, *(1,) * len(frames.shape[:-1]))
        way = np.moveaxis(segment.pose(begin, part * segment.duration).position, 0, -2).reshape(-1, count, 2)
        paper.lines(way, "second" if i % 2 == 0 else "third")
    if len(frames.shape) == 1:
        t = np.linspace(0.0, program.duration, headings)
        radius = robot_radius(program.pose(first, np.linspace(0.0, program.duration, 200)).position)
        plot_headings(program.pose(first, t), paper.ax, count=headings, length=0.7 * radius)
    paper.dots(frames.position, "target", marker="s", size=5, label="joints")
    paper.legend()
    return paper.ax


def plot_holonomic(
    motion: HolonomicMotion, ax: Axes | None = None, *, start: Pose | None = None, count: int = 201, headings: int = 9
) -> Axes:
    """The path of a holonomic motion with headings along it.

    Args:
        motion: One motion or a batch, of which every member is drawn.
        ax: Where to draw; a new figure if None.
        start: Pose at time 0; the origin if None.
        count: Points of the line.
        headings: How many robots are drawn along it.
    """
    paper = Paper.plane(ax)
    first = Pose() if start is None else start
    robots = len(np.broadcast_shapes(motion.velocities.shape[:-2], first.shape))
    t = np.linspace(0.0, motion.duration, count).reshape(-1, *(1,) * robots)
    poses = np.moveaxis(motion.pose(first, t).as_array(), 0, -2).reshape(-1, count, 3)
    paper.lines(poses[..., :2], None if len(poses) > 1 else "trail")
    if len(poses) == 1:
        plot_headings(poses[0], paper.ax, count=headings)
    return paper.ax


def plot_velocities(motion: Velocities, ax: Axes | None = None, *, count: int = 401) -> Axes:
    """The velocities of a motion against time: v and omega, vx and vy, or the components of a ramp.

    Args:
        motion: A segment, a program, a holonomic motion, a ramp or a trapezoid; of a batch every member.
        ax: Where to draw; a new figure if None.
        count: Points of the lines.
    """
    if isinstance(motion, Ramp):
        return plot_ramp(motion, ax, count=count)
    end = float(np.max(motion.duration))
    t = np.linspace(0.0, end, count) if end > 0.0 else np.array([0.0])
    unit = "v [m/s], omega [rad/s]"
    if isinstance(motion, HolonomicMotion):
        rates = motion.velocity(t.reshape(-1, *(1,) * (motion.velocities.ndim - 2)))
        columns: dict[str, Any] = dict(zip(("vx", "vy", "omega"), np.moveaxis(rates, -1, 0), strict=True))
        if not np.any(columns["omega"]):
            columns, unit = {name: columns[name] for name in ("vx", "vy")}, "velocity [m/s]"
        else:
            unit = "vx, vy [m/s], omega [rad/s]"
    elif isinstance(motion, Trapezoid):
        columns, unit = {"velocity": motion.velocity(_column(t, motion.peak))}, "velocity [m/s]"
    else:
        shape = motion.frames.shape[:-1] if isinstance(motion, Program) else motion.shape
        twist = motion.twist(_column(t, np.empty(shape)))
        columns = {"v": twist.vx, "omega": twist.omega}
    whole = np.broadcast_shapes(*(np.shape(c) for c in columns.values()))
    return plot_series(t, {name: np.broadcast_to(c, whole) for name, c in columns.items()}, ax, unit=unit)


def plot_ramp(ramp: Ramp, ax: Axes | None = None, *, names: Sequence[str] = (), count: int = 401) -> Axes:
    """The components of a ramp against time, with a dot where each reaches its target.

    Args:
        ramp: One ramp or a batch, of which every member is drawn.
        ax: Where to draw; a new figure if None.
        names: Of the components; "vx" and "vy" if there are two, numbered otherwise, if empty.
        count: Points of the lines.

    Raises:
        InvalidShape: If there are names, but not one for each component.

    Example:
        >>> ax = plot_ramp(Ramp.independent([0.4, 0.2], [1.2, -0.6], [0.5, 0.25]))
        >>> ax.lines[1].get_xdata().round(9).tolist()
        [1.6]
    """
    width = ramp.start.shape[-1]
    labels = tuple(names) or (("vx", "vy") if width == 2 else tuple(f"component {i + 1}" for i in range(width)))
    if len(labels) != width:
        raise InvalidShape("names", f"{len(labels)} names", f"{width}, one for each component")
    paper = Paper.on(ax, xlabel="time [s]", ylabel="velocity [m/s]")
    end = 1.15 * float(np.max(ramp.durations)) or 1.0
    t = np.linspace(0.0, end, count)
    values = ramp.velocity(_column(t, ramp.duration))
    for i, name in enumerate(labels):
        colour = paper.next_colour()
        for k, line in enumerate(values[..., i].reshape(count, -1).T):
            paper.line(np.column_stack([t, line]), colour, label="_" if k else name)
        paper.dots(np.stack([ramp.durations[..., i], ramp.target[..., i]], axis=-1), colour, size=6)
    paper.legend()
    return paper.ax


def _column(t: np.ndarray, like: Any) -> np.ndarray:
    """Times (count, 1 ...) beside a batch."""
    return t.reshape(-1, *(1,) * np.ndim(like))
