"""Scenes of runs: what moves, as data for the canvas player and for animations that are files."""

from __future__ import annotations

from typing import Any

import numpy as np

from coplanar.arms import Arm
from coplanar.checks import ArrayLike
from coplanar.curves import Curve
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.run import Run
from coplanar.viz.axes import disc, path_points, robot_radius
from coplanar.viz.scene import Scene
from coplanar.viz.style import ORDER

FRAMES = 301  # of a scene, unless told; a shorter run keeps its own rows
ROBOTS = 64  # at most in a scene


def scene_of_run(
    run: Run, *, arm: Arm | None = None, reference: Curve | ArrayLike | None = None, point: ArrayLike | None = None,
    radius: float | None = None, frames: int = FRAMES,
) -> Scene:  # fmt: skip
    """A run as a moving picture: robots as discs with a heading line, arms as links, projectiles as dots, with trails.

    Rows that are not finite, where a loop diverged, are left out.

    Args:
        run: With columns x and y; or of the kind "arm". Of a batch every robot is drawn.
        arm: Whose joints a run of the kind "arm" holds.
        reference: What was followed: a curve, or points (n, 2) [m].
        point: The point on the robot whose trail is drawn [m]; its centre if None.
        radius: Of the robots [m]; a part of the path's extent if None.
        frames: A longer run is resampled in time to so many.

    Raises:
        InvalidValue: If the run has nothing to draw, or is an arm's and the arm is not given.
        InvalidShape: If there are more than ``ROBOTS`` robots.

    Example:
        >>> run = Run({"t": [0.0, 1.0], "x": [0.0, 1.0], "y": [0.0, 0.5]}, "flight")
        >>> [layer["kind"] for layer in scene_of_run(run).layers]
        ['trail', 'point']
    """
    size = int(np.prod(run.shape, dtype=int))
    if size > ROBOTS:
        raise InvalidShape("run", f"{size} robots", f"at most {ROBOTS}", "choose some by run.robot(slice(0, 64))")
    shown = _resampled(run, frames)
    scene = Scene(shown.t)
    if reference is not None:
        for xy in path_points(reference):
            scene = scene.curve(xy, dashed=True)
    if run.kind == "arm":
        return _arm(scene, shown, arm)
    if not {"x", "y"} <= set(run.columns):
        raise InvalidValue("run", list(run.columns), "columns x and y, or a run of an arm", "there is nothing to draw")
    return _robots(scene, shown, point, radius)


def _resampled(run: Run, frames: int) -> Run:
    """The finite rows in the order of time, at most so many of them."""
    table = np.column_stack([np.reshape(column, (len(run), -1)) for column in run.columns.values()])
    good = np.isfinite(table).all(axis=1)
    rows = len(run) if good.all() else int(good.argmin())
    if rows == 0:
        raise InvalidValue("run", "no finite row", "one row or more")
    order = slice(None, rows) if run.t[-1] >= run.t[0] else slice(rows - 1, None, -1)
    cut = Run({name: column[order] for name, column in run.columns.items()}, run.kind, index=run.index)
    if rows <= max(frames, 2):
        return cut
    times = np.linspace(cut.t[0], cut.t[-1], max(frames, 2))
    return cut.at(np.clip(times, cut.t[0], cut.t[-1]))


def _arm(scene: Scene, run: Run, arm: Arm | None) -> Scene:
    if arm is None:
        raise InvalidValue("arm", None, "the arm whose joints these are", "pass arm=...")
    joints = np.moveaxis(run.stacked(*run.names.states), 0, -2).reshape(-1, len(run), arm.n)
    for q, (role, look) in zip(joints, _looks(len(joints), "link"), strict=True):
        points = arm.points(q)
        scene = scene.linkage(points, role=role, **look)
        scene = scene.trail(points[:, -1], role="trail" if len(joints) == 1 else role, **look)
    return scene


def _robots(scene: Scene, run: Run, point: ArrayLike | None, radius: float | None) -> Scene:
    centres = path_points(run)
    posed = "theta" in run.columns
    followed = run.poses @ np.asarray(point, np.float64) if posed and point is not None else run.stacked("x", "y")
    trails = np.moveaxis(followed, 0, -2).reshape(centres.shape)
    outline = disc(radius or robot_radius(centres.reshape(-1, 2)), 37)
    poses = np.moveaxis(run.stacked("x", "y", "theta"), 0, -2).reshape(-1, len(run), 3) if posed else centres
    for xy, table, (role, look) in zip(trails, poses, _looks(len(trails), "body"), strict=True):
        scene = scene.trail(xy, role="trail" if len(trails) == 1 else role, **look)
        if posed:
            scene = scene.body(table, outline, role=role, **look)
        else:
            scene = scene.moving_point(xy, role="target" if len(trails) == 1 else role, **look)
    return scene


def _looks(count: int, role: str) -> list[tuple[str, dict[str, Any]]]:
    """Role and look of each of so many: a few are told apart by colour, many share one."""
    if count == 1:
        return [(role, {})]
    if count <= len(ORDER):
        return [(name, {}) for name in ORDER[:count]]
    return [("first", {"opacity": 0.6})] * count
