"""Arms: postures, ellipses, workspaces, and what an inverse answers."""

from __future__ import annotations

import textwrap

import numpy as np

from coplanar.arms import Arm, Solution, Workspace
from coplanar.arms.chain import Chain
from coplanar.arms.workspace import workspace_of
from coplanar.checks import ArrayLike
from coplanar.viz.axes import plot_linkage
from coplanar.viz.paper import Axes, Paper
from coplanar.viz.regions import around, loops_of

SMALLEST = 0.05  # [rad] a smaller joint angle is not drawn
FLAT = 1e-9  # a force ellipse that is thinner than this part of its length is unbounded
DRAWN = 0.3  # of the arm's length: the largest half axis of an ellipse


def plot_arm(
    arm: Arm, q: ArrayLike, ax: Axes | None = None, *, names: bool = True, ellipse: str | None = None,
    workspace: bool = False,
) -> Axes:  # fmt: skip
    """An arm in a posture, with its joint angles; every posture of a batch, with the last one solid.

    Args:
        arm: The arm.
        q: Joint variables [rad, m], shape (..., n).
        ax: Where to draw; a new figure if None.
        names: Whether joints are named and their angles drawn, of a single posture.
        ellipse: "velocity" or "force" adds that ellipse at the tool, in place of the names.
        workspace: Whether what it can reach is drawn behind it.

    Example:
        >>> arm = Arm((0.5, 0.3))
        >>> ax = plot_arm(arm, (0.3, 0.4))
        >>> [text.get_text() for text in ax.texts]
        ['q1', 'q2', 'base', 'elbow', 'tool']
    """
    paper = Paper.plane(ax)
    postures = np.asarray(arm.checked_joints("q", q)).reshape(-1, arm.n)
    if workspace:
        plot_workspace(arm, paper.ax)
    for i, posture in enumerate(postures):
        plot_linkage(arm.points(posture), paper.ax, alpha=1.0 if i == len(postures) - 1 else 0.3)
    if ellipse is not None:
        plot_ellipse(arm, postures, paper.ax, kind=ellipse)
        paper.legend()
    elif names and len(postures) == 1:
        _angles(paper, arm, postures[0])
        _named(paper, arm.points(postures[0]))
    paper.ax.margins(0.1)
    return paper.ax


def plot_ellipse(
    arm: Arm, q: ArrayLike, ax: Axes | None = None, *, kind: str = "velocity", scale: float | None = None
) -> Axes:
    """Where unit joint rates take the tool, or what force unit joint torques hold, about the tool.

    Where an arm is singular its force ellipse is unbounded; it is drawn as a dashed line through the tool.

    Args:
        arm: The arm.
        q: Joint variables, shape (..., n).
        ax: Where to draw; a new figure if None.
        kind: "velocity" or "force".
        scale: Length drawn for a radius of 1 [m per m/rad, or m per 1/m]; fitted to the arm if None.
    """
    paper = Paper.plane(ax)
    postures = np.asarray(arm.checked_joints("q", q)).reshape(-1, arm.n)
    shape = arm.ellipse(postures, kind=kind)
    bounded = shape.radii[:, 0] * FLAT < (shape.radii[:, 1] if kind == "force" else np.inf)
    largest = float(shape.radii[bounded].max(initial=0.0))
    size = DRAWN * float(np.hypot(*np.diff(arm.points(postures[0]), axis=0).T).sum())
    factor = scale or (size / largest if largest > 0.0 else 1.0)
    for i, tool in enumerate(arm.forward(postures).position):
        one = arm.ellipse(postures[i], kind=kind)
        if bounded[i]:
            outline = one.outline(tool, scale=factor)
            paper.region(outline, colour="third", alpha=0.15)
            paper.line(outline, "third", linewidth=1.4, label="_" if i else f"{kind} ellipse")
        else:
            reach = 2.0 * size * one.axes[:, 0]
            paper.line(np.array([tool - reach, tool + reach]), "third", linestyle="--", linewidth=1.4)
    return paper.ax


def plot_workspace(region: Chain | Workspace, ax: Axes | None = None, *, label: str = "workspace") -> Axes:
    """What an arm can reach: the region and its boundary; dashed where the boundary is sampled, not exact.

    Args:
        region: An arm, or its workspace.
        ax: Where to draw; a new figure if None.
        label: For a legend.
    """
    paper = Paper.plane(ax)
    space = region if isinstance(region, Workspace) else workspace_of(region)
    pieces = space.boundary(129)
    if not space.exact:
        pieces = around(pieces[0], pieces[1], np.array(space.centre))
    outlines = loops_of(pieces)
    if outlines:
        paper.region(*outlines, colour="sixth", alpha=0.1)
    for i, piece in enumerate(pieces):
        paper.line(
            piece, "sixth", linewidth=1.1, linestyle="-" if space.exact else "--", zorder=1.5, label="_" if i else label
        )  # fmt: skip
    return paper.ax


def plot_reach(answer: Solution, ax: Axes | None = None, *, workspace: bool = True) -> Axes:
    """What an inverse answers: every branch, the chosen one solid; where out of reach, the nearest point and the gap.

    Branches that joint limits forbid are dotted lines.

    Args:
        answer: Of ``Arm.inverse``, for one target or many.
        ax: Where to draw; a new figure if None.
        workspace: Whether what the arm can reach is drawn behind it, where that has a bound.
    """
    paper = Paper.plane(ax)
    if workspace and _has_bounds(answer.chain):
        plot_workspace(answer.chain, paper.ax)
    targets = answer.target.reshape(-1, 2)
    many = len(targets) > 1
    parts = (answer.branches, answer.allowed, answer.q, answer.nearest, answer.reached)
    shapes = ((-1, *answer.branches.shape[-2:]), (-1, answer.branches.shape[-2]), (-1, answer.chain.n), (-1, 2), (-1,))
    rows = [np.reshape(part, shape) for part, shape in zip(parts, shapes, strict=True)]
    for target, branches, allowed, q, nearest, reached in zip(targets, *rows, strict=True):
        _branches(paper, answer.chain, branches, allowed, q)
        if not reached:
            _gap(paper, nearest, target)
    paper.cross(targets, label="target")
    if not many:
        paper.title(textwrap.fill(answer.status.value, 62))
    paper.legend()
    return paper.ax


def _has_bounds(chain: Chain) -> bool:
    """Whether every slide has two limits."""
    slides = np.array(list(chain.joints)) == "P"
    return bool(np.isfinite([chain.lower[slides], chain.upper[slides]]).all())


def _branches(paper: Paper, chain: Chain, branches: np.ndarray, allowed: np.ndarray, q: np.ndarray) -> None:
    chosen = int(np.argmin(np.abs(branches - q).sum(axis=-1)))
    for i, (branch, fits) in enumerate(zip(branches, allowed, strict=True)):
        if i == chosen:
            continue
        if fits:
            plot_linkage(chain.points(branch), paper.ax, colours=("second",), alpha=0.35)
        else:
            paper.line(chain.points(branch), "second", linestyle=":", linewidth=1.6)
    plot_linkage(chain.points(q), paper.ax)


def _gap(paper: Paper, nearest: np.ndarray, target: np.ndarray) -> None:
    """From the nearest point to the target; the words stand beyond the target."""
    paper.line(np.array([nearest, target]), "target", linestyle=(0, (4, 3)), linewidth=1.5)
    paper.dots(nearest, "target", size=6)
    right, up = target >= nearest
    beyond = (9.0 if right else -9.0, 8.0 if up else -8.0)
    size = float(np.hypot(*(target - nearest)))
    paper.text(f"gap {size:.3g} m", target, "target", offset=beyond, align="left" if right else "right")


def _named(paper: Paper, points: np.ndarray) -> None:
    middle = ["elbow"] if len(points) == 3 else [f"joint {i}" for i in range(2, len(points))]
    centre = points.mean(axis=0)
    for i, (name, point) in enumerate(zip(["base", *middle, "tool"], points, strict=True)):
        before, after = points[max(i - 1, 0)], points[min(i + 1, len(points) - 1)]
        along = after - before
        across = np.array([along[1], -along[0]]) / max(float(np.hypot(*along)), 1e-300)
        side = 1.0 if across @ (point - centre) >= 0.0 else -1.0
        paper.text(name, point, offset=tuple(17.0 * side * across))


def _angles(paper: Paper, arm: Arm, q: np.ndarray) -> None:
    """The angle of every revolute joint, from where it is counted to the link."""
    points = arm.points(q)[: arm.n + 1]
    spokes = np.diff(points, axis=0)
    headings = np.arctan2(spokes[:, 1], spokes[:, 0])
    for i, (joint, kind) in enumerate(zip(points, arm.joints, strict=False)):
        if kind == "R" and abs(q[i]) > SMALLEST:
            start = headings[i] - q[i]
            size = 0.28 * min(float(np.hypot(*spoke)) for spoke in spokes[max(i - 1, 0) : i + 1])
            turn = start + np.linspace(0.0, q[i], 41)
            arc = joint + size * np.column_stack([np.cos(turn), np.sin(turn)])
            ray = np.array([joint, joint + 1.5 * size * np.array([np.cos(start), np.sin(start)])])
            paper.line(ray, "muted", linewidth=1.0, linestyle=(0, (3, 3)))
            paper.line(arc, "target", linewidth=1.4, zorder=3.5)
            middle = np.array([np.cos(turn[20]), np.sin(turn[20])])
            paper.text(f"q{i + 1}", joint + size * middle, "target", offset=tuple(12.0 * middle))
