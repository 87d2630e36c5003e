"""What a run looks like: path, poles, commands, errors."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from coplanar.control import PointTracker, PolarController, Stability, StabilityReport
from coplanar.curves import Reference
from coplanar.play.answer import Answer, Handle
from coplanar.play.controls import State
from coplanar.play.tabs import strokes, views
from coplanar.play.tabs.drive_loop import AnyController, AnyReference, report_of
from coplanar.run import Run, RunStatus
from coplanar.se2 import Pose, wrap_angle
from coplanar.viz.scene import Scene

FRAMES = 201  # of the animation and the series: samples of the run
LIVE_FRAMES = 81  # while something is dragged
SPEEDS = 2001  # samples of the reference, to find how fast it moves
WANTED = 161  # points of the reference as it is drawn
FAR = 50.0  # times half the view: a path that goes further is cut there
EDGE = 1.28  # a pole further out is drawn at the edge of its picture
ROBOT = 0.08  # radius of the disc that is drawn, over half the view
ROLES = {"euler": "fifth", "rk4": "fourth", "exact": "third", "midpoint": "second", "heun": "second"}
NAMES = {"euler": "Euler", "rk4": "RK4", "exact": "exact arcs", "midpoint": "midpoint", "heun": "Heun"}
TONES = {Stability.STABLE: "good", Stability.BOUNDARY: "warn", Stability.UNSTABLE: "no"}

Follower = tuple[AnyController, AnyReference, Pose]


def show(answer: Answer, state: State, follower: Follower, runs: dict[str, Run], *, live: bool) -> None:
    """Everything about one state; the first run is the one of the chosen method."""
    controller, reference, start = follower
    half = half_view(state)
    chosen, *_ = runs.values()
    report = report_of(state, top_speed(reference, state["duration"]))
    rows = shown_rows(chosen, half, LIVE_FRAMES if live else FRAMES)
    answer.pictures["main"] = _picture(follower, half, chosen, runs, rows)
    answer.pictures["poles"] = poles(report)
    _legend(answer, state, runs)
    _handles(answer, state, start, half)
    _say(answer, report, chosen, rows, state)
    _read(answer, report, chosen)
    if isinstance(controller, PolarController):
        turned = wrap_angle(float(chosen["theta"][-1]) - float(controller.goal.theta))
        answer.read("heading_error", "heading less the goal's, at the end", turned, "rad", "Run")
    _plot(answer, chosen, runs, rows)


def _legend(answer: Answer, state: State, runs: dict[str, Run]) -> None:
    """Of the integrators, where there are several."""
    if len(runs) > 1:
        way = "the robot" if state["controller"] == "polar" else "P"
        answer.name(f"way of {way}, {NAMES[state['method']]}", "trail")
        for method in runs:
            answer.name(NAMES[method], ROLES[method])


def half_view(state: State) -> float:
    """Half the width of the view [m]; it depends on the size of the reference alone, or on where start and goal are."""
    if state["controller"] == "polar":
        ends = [(state[f"{end}_x"], state[f"{end}_y"]) for end in ("start", "goal")]
        return views.half_width(np.array(ends), 2.0)
    named = state["curve"] not in ("stroke", "point")
    return max(1.7 * float(state["size"]), 0.8) if named else 2.0


def shown_rows(run: Run, half: float, frames: int = FRAMES) -> np.ndarray:
    """Rows that are drawn: evenly, as far as the run stays anywhere near."""
    with np.errstate(all="ignore"):
        gone = ~(np.hypot(run["x"], run["y"]) < FAR * half)
    last = int(gone.argmax()) - 1 if gone.any() else len(run) - 1
    return np.unique(np.linspace(0, max(last, 1), frames).round().astype(int))


def poles(report: StabilityReport) -> Scene:
    """The poles in the unit circle: inside, an error dies out; on it the loop is on its stability boundary."""
    scene = Scene(unit="", view=(-1.35, 1.35, -1.35, 1.35))
    scene = scene.discs([0.0, 0.0, 1.0], role="good", fill=True, opacity=0.8)
    scene = scene.segments([-1.35, 0.0, 1.35, 0.0, 0.0, -1.35, 0.0, 1.35], width=1.0, opacity=0.6)
    groups = [("first", report.poles)]
    if report.lateral_poles is not None:
        groups.insert(0, ("second", report.lateral_poles))
    for role, found in groups:
        for pole in found.tolist():
            x, y = (min(max(part, -EDGE), EDGE) for part in (pole.real, pole.imag))
            scene = scene.cross([x, y], role="no" if abs(pole) > 1.0 else role, size=7.0)
            if max(abs(pole.real), abs(pole.imag)) > EDGE:
                side = "left" if x < -1.0 else "right" if x > 1.0 else "center"
                scene = scene.text(f"|z| = {abs(pole):.3g}", [x, y], role="no", align=side, shift=(0, -14))
    return scene


def _picture(follower: Follower, half: float, run: Run, runs: dict[str, Run], rows: np.ndarray) -> Scene:
    controller, reference, _ = follower
    table = run.poses.as_array()[rows]
    scene = Scene(run.t[rows], view=(-half, half, -half, half))
    if isinstance(reference, Reference):
        scene = scene.curve(reference.curve.position(reference.curve.parameters(WANTED)), dashed=True)
    for method, other in runs.items():
        if len(runs) > 1:
            drawn = shown_rows(other, half)
            scene = scene.curve(other.stacked("x", "y")[drawn], role=ROLES[method])
    around = np.linspace(0.0, 2.0 * np.pi, 33)
    disc = ROBOT * half * np.column_stack((np.cos(around), np.sin(around)))
    if not isinstance(controller, PointTracker):
        goal = controller.goal.as_array()
        return scene.body(goal, disc, role="target", dashed=True).trail(table[:, :2]).body(table, disc)
    point = np.column_stack(Pose(*table.T).act(controller.px, controller.py))
    scene = scene.trail(point).body(table, disc)
    levers = [0.0, 0.0, float(controller.px), float(controller.py)]
    scene = scene.carried(table, levers, role="muted", width=1.5).moving_point(point, role="trail", size=4.0)
    return scene if reference is None else scene.moving_point(reference.position(run.t[rows]), size=4.0)


def _handles(answer: Answer, state: State, start: Pose, half: float) -> None:
    reach = 2.2 * ROBOT * half
    if state["controller"] == "polar":
        goal = state["goal_x"], state["goal_y"]
        answer.handles.append(Handle("goal", "Goal", goal))
        answer.handles.append(_turning("goal_turn", "Heading of the goal", goal, state["goal_heading"], reach))
    elif state["curve"] != "stroke":
        label = "Target of P" if state["curve"] == "point" else "Curve: drag its centre"
        answer.handles.append(Handle("curve", label, (state["curve_x"], state["curve_y"])))
    x, y, theta = (float(part) for part in start.parts)
    answer.handles.append(Handle("start", "Start of the robot", (x, y)))
    answer.handles.append(_turning("heading", "Heading at the start", (x, y), theta, reach))


def _turning(name: str, label: str, about: tuple[float, float], theta: float, reach: float) -> Handle:
    nose = (about[0] + reach * math.cos(theta), about[1] + reach * math.sin(theta))
    return Handle(name, label, nose, step=0.05, about=about, value=f"{math.degrees(theta):.0f} degrees")


def top_speed(reference: AnyReference, duration: float) -> float:
    """Of the reference, over the whole run [m/s]."""
    if reference is None:
        return 0.0
    return float(np.hypot(*reference.velocity(np.linspace(0.0, duration, SPEEDS)).T).max())


def _say(answer: Answer, report: StabilityReport, run: Run, rows: np.ndarray, state: State) -> None:
    answer.say(TONES[report.status], report.status.value)
    for warning in report.warnings:
        answer.say("warn", warning)
    if run.status is RunStatus.DIVERGED:
        answer.say("no", run.status.value)
    elif rows[-1] < len(run) - 1:
        answer.say("no", f"the path leaves the picture for good at t = {run.t[rows[-1]]:.3g} s")
    if state["limited"] and len(run) > 1:
        limits = np.array([state["v_limit"], state["omega_limit"]]) * (1.0 - 1e-9)
        share = float((np.abs(run.commands[1:]) >= limits).any(axis=-1).mean())
        if share > 0.0:
            answer.say("warn", f"the limits hold the command back in {100.0 * share:.3g} % of the steps")
    if state["controller"] == "point" and state["curve"] == "stroke" and strokes.curve_of(state) is None:
        answer.say("note", "draw a curve for P to follow")


def _read(answer: Answer, report: StabilityReport, run: Run) -> None:
    answer.read("margin", "margin 1 - |largest pole|", report.margin, "", "Stability")
    answer.read("largest_step", "stable for steps below", report.largest_step, "s", "Stability")
    for name, found in (("pole", report.poles), ("lateral pole", report.lateral_poles)):
        for i, pole in enumerate([] if found is None else found.tolist(), 1):
            answer.read(f"{name.replace(' ', '_')}_{i}", f"{name} {i}", _complex(pole), "", "Stability")
    with np.errstate(all="ignore"):
        off = run["rho"] if "rho" in run.names.errors else np.hypot(*run.errors.T)
        largest = {"v": np.abs(run["v"]).max(), "omega": np.abs(run["omega"]).max()}
    answer.read("last_error", "error at the end", float(off[-1]), "m", "Run")
    answer.read("largest_error", "largest error", float(off.max()), "m", "Run")
    answer.read("largest_v", "largest |v|", float(largest["v"]), "m/s", "Run")
    answer.read("largest_omega", "largest |omega|", float(largest["omega"]), "rad/s", "Run")
    for name in ("x", "y", "theta"):
        answer.read(f"end_{name}", f"{name} at the end", float(run[name][-1]), "rad" if name == "theta" else "m", "Run")


def _plot(answer: Answer, run: Run, runs: dict[str, Run], rows: np.ndarray) -> None:
    time = ("time [s]", run.t[rows])
    answer.plot("Forward velocity", "m/s", time, {"v": run["v"][rows]})
    answer.plot("Turn rate", "rad/s", time, {"omega": run["omega"][rows]})
    if "rho" in run.names.errors:
        answer.plot("Distance to the goal", "m", time, {"rho": run["rho"][rows]})
        bearings = {"alpha, of the goal": run["alpha"][rows], "beta, of its heading": run["beta"][rows]}
        answer.plot("Bearings", "rad", time, bearings)
    else:
        answer.plot("Error", "m", time, {"ex": run["ex"][rows], "ey": run["ey"][rows]})
    if "exact" in runs and len(runs) > 1:
        apart = {method: _apart(other, runs["exact"], rows) for method, other in runs.items() if method != "exact"}
        answer.plot("Distance from the exact run", "m", time, apart, roles=ROLES)
        for method, distance in apart.items():
            most = float(np.nanmax(distance, initial=0.0))
            answer.read(f"apart_{method}", f"{method} from exact, at most", most, "m", "Integrators")


def _apart(run: Run, exact: Run, rows: np.ndarray) -> Any:
    """Distance between two runs at the rows; NaN where one of them has ended."""
    length = min(len(run), len(exact))
    inside = rows[rows < length]
    with np.errstate(all="ignore"):
        gap = np.hypot(*(run.stacked("x", "y")[inside] - exact.stacked("x", "y")[inside]).T)
    return np.concatenate([gap, np.full(len(rows) - len(inside), np.nan)])


def _complex(value: complex) -> str:
    if abs(value.imag) < 5e-7:
        return f"{value.real:.6g}"
    return f"{value.real:.6g} {'+' if value.imag > 0.0 else '-'} {abs(value.imag):.6g}i"
