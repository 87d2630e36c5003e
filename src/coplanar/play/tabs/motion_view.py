"""What a chain of segments looks like, and what integrators make of it."""

from __future__ import annotations

import math

import numpy as np

from coplanar.motion import Comparison, Program, Segment
from coplanar.play.answer import Answer, Handle
from coplanar.play.controls import State
from coplanar.play.tabs import views
from coplanar.se2 import Pose
from coplanar.viz.scene import Scene

FRAMES = 201
DRAWN_STEPS = 200  # of an integrator: of more every other one is drawn
LIVE_FRAMES = 81
STEEPEST = 1e3  # [1/m] a curvature above this is drawn as a gap: the path turns on the spot
LIVE_STEPS = 60  # of an integrator, while something is dragged: of more none is drawn until the hand rests
ROLES = {"euler": "fifth", "rk4": "fourth"}
SHOWN = {"euler": "Euler", "rk4": "RK4"}
CURVES = {
    "rest": "at rest", "line": "line", "spin": "turn on the spot", "arc": "arc", "circle": "arc",
    "clothoid": "clothoid", "general": "general curve",
}  # fmt: skip
NAMES = {
    "rest": "rests",
    "line": "is a straight line",
    "spin": "turns on the spot",
    "arc": "is a circular arc: constant velocities",
    "circle": "is a circular arc driven at changing speed: a/alpha = v/omega",
    "clothoid": "is a clothoid: its curvature is linear in the length run",
    "general": "has no name of its own: its curvature is not linear in the length run, because v changes",
}


Stepped = dict[str, tuple[np.ndarray, Pose]]  # times and poses of an integrator


def show(answer: Answer, segments: list[Segment], start: Pose, state: State, *, live: bool) -> None:
    """Everything about one chain."""
    program = Program(segments)
    t = np.linspace(0.0, program.duration, LIVE_FRAMES if live else FRAMES)
    table = program.pose(start, t).as_array()
    stepped = {}
    if state["compare"] and not (live and is_long(segments, state)):
        compared = Comparison(program, start, tuple(ROLES), [state["step"]])
        stepped = {method: compared.path(method, state["step"]) for method in ROLES}
    half = views.half_width(table[:, :2], 2.0)
    scene = Scene(t, view=(-half, half, -half, half))
    for i, segment in enumerate(segments):
        inside = (t >= program.knots[i]) & (t <= program.knots[i + 1])
        if segment.duration > 0.0 and inside.sum() > 1:
            scene = scene.curve(table[inside, :2], role=("first", "third", "second")[i % 3], opacity=0.55)
    for method, (_, poses) in stepped.items():
        drawn = poses.position[_thinned(len(poses.x))]
        scene = scene.curve(drawn, role=ROLES[method], dashed=True)
        scene = scene.moving_point(drawn.reshape(1, -1), role=ROLES[method], size=2.0)
    size = 0.06 * half
    robot = size * np.array([(1.2, 0.0), (-0.8, 0.8), (-0.5, 0.0), (-0.8, -0.8)])
    answer.pictures["main"] = scene.trail(table[:, :2]).body(table, robot)
    kinds, end = [segment.kind for segment in segments], program.end(start)
    _legend(answer, segments, kinds, stepped)
    _handles(answer, start, end, half)
    _plot(answer, program, t)
    _say(answer, segments, kinds)
    _read(answer, segments, kinds, end)
    _compare(answer, program, start, stepped)


def is_long(segments: list[Segment], state: State) -> bool:
    """Whether the integrators take more steps than there is time for in a frame."""
    return sum(float(segment.duration) for segment in segments) > LIVE_STEPS * float(state["step"])


def _legend(answer: Answer, segments: list[Segment], kinds: list[str], stepped: Stepped) -> None:
    """The curve by its own name, and the integrators."""
    cusps = (" with a cusp" if math.isfinite(segment.cusp_time) else "" for segment in segments)
    names = (CURVES[kind] + cusp for kind, cusp in zip(kinds, cusps, strict=True))
    answer.name("exact, " + ", ".join(dict.fromkeys(names)), "trail")
    for method, (every, _) in stepped.items():
        answer.name(f"{SHOWN[method]}, {len(every) - 1} steps", ROLES[method], dashed=True)


def _handles(answer: Answer, start: Pose, end: Pose, half: float) -> None:
    x, y, theta = start.parts
    nose = (x + 0.2 * half * math.cos(theta), y + 0.2 * half * math.sin(theta))
    said = f"{math.degrees(theta):.0f} degrees"
    answer.handles.append(Handle("start", "Start", (x, y)))
    answer.handles.append(Handle("heading", "Heading at the start", nose, step=0.05, about=(x, y), value=said))
    answer.handles.append(Handle("end", "End of the last segment", (float(end.x), float(end.y))))


def _plot(answer: Answer, program: Program, t: np.ndarray) -> None:
    twist, time = program.twist(t), ("time [s]", t)
    answer.plot("Forward velocity", "m/s", time, {"v": twist.vx})
    answer.plot("Turn rate", "rad/s", time, {"omega": twist.omega})
    place = np.clip(np.searchsorted(program.knots, t, side="right") - 1, 0, len(program) - 1)
    pieces = program.segments[place]
    curvature = np.asarray(pieces.curvature(t - program.knots[place]))
    steep = np.abs(curvature) < STEEPEST
    answer.plot("Curvature", "1/m", time, {"kappa": np.where(steep, curvature, np.nan)})


def _say(answer: Answer, segments: list[Segment], kinds: list[str]) -> None:
    for i, (segment, kind) in enumerate(zip(segments, kinds, strict=True), 1):
        which = f"segment {i}" if len(segments) > 1 else "the path"
        answer.say("note", f"{which} {NAMES[kind]}")
        if math.isfinite(segment.cusp_time):
            answer.say("warn", f"{which} reverses in a cusp {segment.cusp_time:.4g} s after it begins: v changes sign")


def _read(answer: Answer, segments: list[Segment], kinds: list[str], end: Pose) -> None:
    for name in ("x", "y", "theta"):
        answer.read(f"end_{name}", f"{name} at the end", float(getattr(end, name)), _unit(name), "End")
    answer.read("duration", "duration", sum(float(segment.duration) for segment in segments), "s", "End")
    for i, (segment, kind) in enumerate(zip(segments, kinds, strict=True), 1):
        group = f"Segment {i}"
        answer.read(f"kind_{i}", "curve", kind, "", group)
        answer.read(f"first_curvature_{i}", "curvature at its start", float(segment.curvature(0.0)), "1/m", group)
        last = float(segment.curvature(segment.duration))
        answer.read(f"last_curvature_{i}", "curvature at its end", last, "1/m", group)


def _compare(answer: Answer, program: Program, start: Pose, stepped: Stepped) -> None:
    """Distance of the integrators from the exact path, at their own times."""
    lines: dict[str, np.ndarray] = {}
    every = next((times for times, _ in stepped.values()), np.zeros(1))
    rows = _thinned(len(every))
    t = every[rows]
    exact = program.pose(start, t).position if stepped else None
    for method, (_, poses) in stepped.items():
        lines[method] = np.hypot(*(poses.position[rows] - exact).T)
        answer.read(f"apart_{method}", f"{method} from exact, at the end", float(lines[method][-1]), "m", "Integrators")
    if lines:
        answer.plot("Distance from the exact path", "m", ("time [s]", t), lines, roles=ROLES)


def _thinned(count: int) -> np.ndarray:
    """Rows that are drawn, the first and the last among them."""
    return np.unique(np.linspace(0, count - 1, min(count, DRAWN_STEPS)).round().astype(int))


def _unit(name: str) -> str:
    return "rad" if name == "theta" else "m"
