"""What integrators make of a motion, beside the exact one."""

from __future__ import annotations

import math

import numpy as np

from coplanar.integrators import METHODS
from coplanar.play.answer import Answer, Handle
from coplanar.play.controls import State
from coplanar.play.tabs import views
from coplanar.play.tabs.problems import (
    COUNTS,
    METHODS_SHOWN,
    MOST_STEPS,
    Problem,
    Study,
    key_of,
    order_of,
    problem_of,
    studies_of,
)
from coplanar.viz.scene import Scene

FRAMES = 121
LIVE_FRAMES = 61
LIVE_STEPS = 120  # of all methods together, while something is dragged
SLOPES = {name: len(METHODS[name].b) for name in METHODS_SHOWN}  # evaluations of the rates a step
NAMES = {"euler": "Euler", "midpoint": "RK2 (midpoint)", "rk4": "RK4"}
ROLES = {"euler": "fifth", "midpoint": "second", "rk4": "fourth"}
COLOURS = {NAMES[method]: role for method, role in ROLES.items()}


def show(answer: Answer, state: State, count: int, *, live: bool) -> None:
    """Everything about one motion and one step."""
    key = key_of(state)
    problem = problem_of(key)
    t = np.linspace(0.0, problem.duration, LIVE_FRAMES if live else FRAMES)
    steps = np.linspace(0.0, problem.duration, count + 1)
    exact, at_steps = np.split(problem.exact(np.concatenate((t, steps))), [len(t)])
    shown = METHODS_SHOWN if not live or count * 7 <= LIVE_STEPS else METHODS_SHOWN[:1]
    paths = {method: problem.points(method, count) for method in shown}
    answer.complete = len(shown) == len(METHODS_SHOWN)
    answer.pictures["main"] = _picture(state, t, exact, paths)
    answer.name("exact", "third")
    for method, points in paths.items():
        if points is not None:
            answer.name(NAMES[method], ROLES[method])
    if state["motion"] == "shot":
        _launch(answer, state, exact)
    _distances(answer, paths, steps, at_steps)
    found = studies_of.within(live, key)
    if found is None:
        answer.complete = False
    else:
        _study(answer, problem, found)


def _picture(state: State, t: np.ndarray, exact: np.ndarray, paths: dict[str, np.ndarray | None]) -> Scene:
    half = views.half_width(exact)
    shot = state["motion"] == "shot"
    view = (-0.1 * half, half, -0.4 * half, 0.7 * half) if shot else (-half, half, -half, half)
    scene = Scene(t, view=view)
    for method, points in paths.items():
        if points is not None:
            role, steps = ROLES[method], np.linspace(0.0, t[-1], len(points))
            now = np.column_stack([np.interp(t, steps, points[:, i]) for i in (0, 1)])
            scene = scene.curve(points, role=role).moving_point(points.reshape(1, -1), role=role, size=2.0)
            scene = scene.moving_point(now, role=role, size=4.0)
    return scene.curve(exact, role="third", dashed=True).trail(exact, role="third").moving_point(exact, role="third")


def _launch(answer: Answer, state: State, exact: np.ndarray) -> None:
    reach = 0.25 * views.half_width(exact)
    tip = (reach * math.cos(state["angle"]), reach * math.sin(state["angle"]))
    said = f"{math.degrees(state['angle']):.0f} degrees"
    answer.handles.append(Handle("launch", "Direction of the launch", tip, step=0.02, about=(0.0, 0.0), value=said))


def _distances(answer: Answer, paths: dict[str, np.ndarray | None], t: np.ndarray, exact: np.ndarray) -> None:
    lines = {}
    for method, points in paths.items():
        if points is None:
            answer.say("no", f"{NAMES[method]} diverges at this step")
            continue
        lines[NAMES[method]] = np.hypot(*(points - exact).T)
        last = float(lines[NAMES[method]][-1])
        answer.read(f"apart_{method}", f"{NAMES[method]}, at the end", last, "m", "Distance from exact")
    answer.read("steps", "steps", len(t) - 1, "", "Distance from exact")
    answer.read("h", "step", float(t[1]), "s", "Distance from exact")
    answer.plot("Distance from the exact motion", "m", ("time [s]", t), lines, roles=COLOURS)


def _study(answer: Answer, problem: Problem, found: dict[str, Study]) -> None:
    steps = [problem.duration / count for count in COUNTS]
    errors = {NAMES[method]: [e if e > 0.0 else math.nan for e in study.errors] for method, study in found.items()}
    answer.plot("Largest error", "m", ("step [s]", steps), errors, log=True, roles=COLOURS)
    for method, study in found.items():
        if math.isfinite(study.order):
            answer.read(f"order_{method}", f"{NAMES[method]}, order", study.order, "", "Order, seen")
        if study.largest_step > 0.0:
            label = f"{NAMES[method]}, step for 1 mm"
            answer.read(f"largest_step_{method}", label, study.largest_step, "s", "Largest step for 1 mm")
            _cost(answer, problem, method, study)
        elif study.largest_step == 0.0:
            answer.say("warn", f"{NAMES[method]} takes more than {MOST_STEPS} steps to stay within 1 mm")


def _cost(answer: Answer, problem: Problem, method: str, study: Study) -> None:
    count = math.ceil(problem.duration / study.largest_step - 1e-9)
    answer.say(
        "note",
        f"{NAMES[method]} (order {order_of(method)}) stays within 1 mm with steps of {study.largest_step:.3g} s: "
        f"{count} steps, {count * SLOPES[method]} evaluations",
    )
