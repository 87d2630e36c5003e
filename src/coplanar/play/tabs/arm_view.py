"""What an arm that stands still looks like, and what is read of it."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from coplanar.arms import Arc, Arm, Reach, Solution, Workspace
from coplanar.play.answer import Answer, Handle
from coplanar.play.controls import State
from coplanar.viz.scene import Scene

ROOM = 1.3  # of the stretched arm: half the width of the view
SCALES = {"velocity": 0.25, "force": 0.1}  # length drawn for a radius of 1 [s rad^-1 or m/N]
LONGEST_AXIS = 3.0  # [m] of an ellipse that is drawn
NEARLY_SINGULAR = 0.05  # smallest over largest singular value
KEPT_WORKSPACES = 32

Region = tuple[Workspace, list[np.ndarray]]


def show(answer: Answer, posed: tuple[Arm, np.ndarray], solution: Solution | None, state: State, *, live: bool) -> None:
    """Picture, handle, readouts and sentences of one posture."""
    arm, q = posed
    points = arm.points(q)
    tool = tuple(points[-1].tolist())
    scene = background(arm, live=live)
    scene = _with_limits(scene, arm, points)
    if solution is not None:
        scene = _with_target(_with_ghosts(scene, arm, solution), solution)
    scene = scene.linkage(points)
    answer.pictures["main"] = _with_ellipse(scene, arm, q, tool, state["ellipse"]).moving_point(tool, role="trail")
    held = (state["target_x"], state["target_y"]) if state["follow"] == "target" else tool
    answer.handles.append(Handle("tool", "Tool: drag the target", held, value=f"x {tool[0]:.2f}, y {tool[1]:.2f} m"))
    _read(answer, arm, q, solution)
    _say(answer, arm, q, solution)


def background(arm: Arm, *, live: bool) -> Scene:
    """The view, which depends on the links alone, and the region that the tool reaches."""
    half = ROOM * sum(arm.links)
    scene = Scene(view=(-half, half, -half, half))
    if live and arm.limits is not None and arm.n == 3:
        return scene  # the region is sampled, which takes too long for a frame
    workspace, lines = region(tuple(arm.links), arm.limits)
    if arm.limits is None:
        return scene.region(lines, role="muted", opacity=0.6)
    for line in lines:
        scene = scene.curve(line, role="muted", dashed=not workspace.exact)
    return scene


@lru_cache(maxsize=KEPT_WORKSPACES)
def region(links: tuple[float, ...], limits: tuple[tuple[float, float], ...] | None) -> Region:
    """The workspace and its boundary; kept, because a drag asks for the same one sixty times a second."""
    workspace = Arm(links, limits=limits).workspace()
    return workspace, workspace.boundary(145)


def _with_limits(scene: Scene, arm: Arm, points: np.ndarray) -> Scene:
    """A sector at every limited joint: where the next link may point."""
    if arm.limits is None:
        return scene
    before = 0.0
    for i, (low, high) in enumerate(arm.limits):
        x, y = points[i].tolist()
        edge = Arc((x, y), 0.28 * arm.links[i], before + low, min(high - low, math.tau)).points(25)
        scene = scene.outline([(x, y), *edge.tolist()], role="muted", fill=True, opacity=0.7)
        before = math.atan2(*(points[i + 1] - points[i])[::-1])
    return scene


def _with_ghosts(scene: Scene, arm: Arm, solution: Solution) -> Scene:
    """The other branches, dashed where the limits forbid them."""
    for q, allowed in zip(solution.branches, solution.allowed.tolist(), strict=True):
        if np.abs(q - solution.q).max() > 1e-6:
            scene = scene.linkage(arm.points(q), opacity=0.28, dashed=not allowed)
    return scene


def _with_target(scene: Scene, solution: Solution) -> Scene:
    """The target, and the gap to the nearest point."""
    target, nearest = solution.target.tolist(), solution.nearest.tolist()
    if not solution.reached:
        scene = scene.segments([*nearest, *target], role="no", dashed=True)
    return scene.cross(target)


def _with_ellipse(scene: Scene, arm: Arm, q: np.ndarray, tool: tuple[float, float], kind: str) -> Scene:
    if kind == "none":
        return scene
    ellipse, scale = arm.ellipse(q, kind=kind), SCALES[kind]
    if not ellipse.radii[0] * scale < LONGEST_AXIS:
        return scene
    return scene.outline(ellipse.outline(tool, scale=scale, count=49), role="third", fill=True)


def _read(answer: Answer, arm: Arm, q: np.ndarray, solution: Solution | None) -> None:
    tool, jacobian = arm.kinematics(q, task="position")
    for i, angle in enumerate(q.tolist(), 1):
        answer.read(f"q{i}", f"q{i}", angle, "rad", "Joints")
    for key, unit in (("x", "m"), ("y", "m"), ("theta", "rad")):
        answer.read(key, f"tool {key}", getattr(tool, key), unit, "Tool")
    if solution is not None:
        answer.read("gap", "gap to the target", solution.gap, "m", "Tool")
    for i, row in enumerate(jacobian.tolist(), 1):
        for j, entry in enumerate(row, 1):
            answer.read(f"j{i}{j}", f"J{i}{j}", entry, "m/rad", "Jacobian")
    radii = arm.ellipse(q).radii.tolist()
    answer.read("w", "manipulability w", arm.manipulability(q), "m^2/rad^2", "Jacobian")
    answer.read("major", "ellipse, half length", radii[0], "m/rad", "Jacobian")
    answer.read("minor", "ellipse, half width", radii[1], "m/rad", "Jacobian")
    if solution is not None:
        answer.read("conditioning", "smallest / largest", solution.conditioning(), "", "Jacobian")
    if arm.limits is None:
        ring = region(tuple(arm.links), None)[0]
        answer.read("outer", "reach", ring.outer, "m", "Workspace")
        answer.read("inner", "inner radius", ring.inner, "m", "Workspace")


def _say(answer: Answer, arm: Arm, q: np.ndarray, solution: Solution | None) -> None:
    if solution is not None:
        status = solution.status
        fine, free = solution.reached, status is Reach.FIRST_JOINT_FREE
        gap = "" if fine else f"; short by {solution.gap:.4g} m"
        answer.say("warn" if free else ("good" if fine else "no"), status.value + gap)
        if fine and arm.n == 2 and not free:
            _say_branches(answer, solution)
        if fine and solution.conditioning() < NEARLY_SINGULAR:
            answer.say("warn", _near_singular(solution))
    for i, outside in enumerate(((q < arm.lower) | (q > arm.upper)).tolist(), 1):
        if outside and solution is None:
            answer.say("no", f"joint {i} is beyond its limit")


def _say_branches(answer: Answer, solution: Solution) -> None:
    allowed = int(solution.allowed.sum())
    if solution.chain.limits is None or allowed == 2:
        answer.say("note", "two postures reach it, one for each sign of the elbow")
    else:
        answer.say("note", "the limits leave one of the two postures")


def _near_singular(solution: Solution) -> str:
    value = solution.singular_value()
    if 10.0 * math.pi * value > 1e-3:  # less than ten half turns
        return f"nearly singular: a millimetre at the tool is {1e-3 / value:.3g} rad in the joints"
    return "singular: there is a direction in which no rates of the joints move the tool"
