"""Frames: where their origins are and which way their axes point."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from coplanar.errors import InvalidShape
from coplanar.frames import FrameTree
from coplanar.se2 import Pose
from coplanar.viz.paper import Axes, Paper


def plot_frames(
    frames: Pose | FrameTree, ax: Axes | None = None, *, seen_from: str | None = None, names: Sequence[str] = (),
    length: float | None = None,
) -> Axes:  # fmt: skip
    """Frames as pairs of axes with their names; in a tree a dashed line leads from each to its parent.

    Args:
        frames: Poses of any leading shape, seen from the frame that is drawn at the origin; or a tree.
        ax: Where to draw; a new figure if None.
        seen_from: The frame of a tree that is drawn at the origin; its root if None.
        names: Of poses, one each; none are written if empty.
        length: Of the axes [m]; a part of the extent if None.

    Raises:
        InvalidShape: If there are names, but not one for each pose.
        UnknownName: If the tree has no such frame.

    Example:
        >>> ax = plot_frames(FrameTree().with_frame("robot", "world", Pose(1.0, 2.0, 0.0)))
        >>> sorted(text.get_text() for text in ax.texts)
        ['robot', 'world']
    """
    paper = Paper.plane(ax)
    if isinstance(frames, FrameTree):
        named = [(name, frames.pose(name, seen_from or frames.root)) for name in frames.names]
    else:
        named = _named(frames, tuple(names))
    origins = np.concatenate([pose.position.reshape(-1, 2) for _, pose in named])
    extent = float(np.ptp(np.vstack([origins, np.zeros(2)]), axis=0).max())
    size = length or (0.22 * extent if extent > 0.0 else 1.0)
    lines = _lineage(paper, frames, dict(named)) if isinstance(frames, FrameTree) else []
    for _, pose in named:
        _axes(paper, pose, size)
    _names(paper, named, size, lines)
    paper.ax.margins(0.15)
    return paper.ax


def _named(poses: Pose, names: tuple[str, ...]) -> list[tuple[str, Pose]]:
    rows = poses.as_array().reshape(-1, 3)
    if names and len(names) != len(rows):
        raise InvalidShape("names", f"{len(names)} names", f"{len(rows)}, one for each pose")
    here = [] if np.any(np.all(rows == 0.0, axis=1)) else [("", Pose())]
    return here + [(name, Pose(*row)) for name, row in zip(names or ("",) * len(rows), rows, strict=True)]


def _lineage(paper: Paper, tree: FrameTree, poses: dict[str, Pose]) -> list[np.ndarray]:
    lines = []
    for frame in tree.frames:
        ends = np.broadcast_arrays(poses[frame.parent].position, poses[frame.name].position)
        for start, end in zip(*(part.reshape(-1, 2) for part in ends), strict=True):
            lines.append(np.linspace(start, end, 30))
            paper.line(lines[-1], "muted", linewidth=1.0, linestyle=(0, (3, 3)))
    return lines


def _axes(paper: Paper, pose: Pose, size: float) -> None:
    origins = pose.position.reshape(-1, 2)
    for tip, colour in (((size, 0.0), "second"), ((0.0, size), "third")):
        for start, end in zip(origins, (pose @ np.array(tip)).reshape(-1, 2), strict=True):
            paper.arrow(start, end, colour)
    paper.dots(origins, "ink", size=4.5)


def _names(paper: Paper, named: list[tuple[str, Pose]], size: float, lines: list[np.ndarray]) -> None:
    """Each name at the corner of its frame that is farthest from other frames and from the lines between them."""
    taken = [pose @ np.array(tip) for _, pose in named for tip in ((0.0, 0.0), (size, 0.0), (0.0, size))]
    crowd = np.concatenate([np.reshape(points, (-1, 2)) for points in (*taken, *lines)])
    for name, pose in named:
        for row in pose.as_array().reshape(-1, 3) if name else ():
            corners = Pose(*row) @ (0.34 * size * np.array([(-1, -1), (1, -1), (-1, 1), (1, 1)]))
            room = np.hypot(*(corners[:, None] - crowd).transpose(2, 0, 1)).min(axis=1)
            paper.text(name, corners[np.argmax(room)])
