"""What shots at a target look like."""

from __future__ import annotations

import math

import numpy as np

from coplanar.flight import Aim, AimStatus, Arc, FlightState, Projectile
from coplanar.play.answer import Answer, Handle
from coplanar.play.controls import State
from coplanar.play.kept import Kept
from coplanar.viz.scene import Scene

FRAMES = 121
LIVE_FRAMES = 31
LIMIT = 33  # directions in which the envelope is drawn
LEAST_VIEW = 8.0  # [m]
KEPT = 64
SHAFT = 0.22  # length of the launch arrow, over the width of the view
ROLES = {"low": "first", "high": "second"}
TONES = {
    AimStatus.HIT: "good",
    AimStatus.OUT_OF_REACH: "no",
    AimStatus.OFF_THE_LINE: "no",
    AimStatus.ANY_SPEED: "note",
}


def _limit(mass: float, drag: float, gravity: float, speed: float) -> np.ndarray:
    return Projectile(mass=mass, drag=drag, gravity=gravity).envelope(speed, np.linspace(-0.9, 0.5 * math.pi, LIMIT))


def _furthest(mass: float, drag: float, gravity: float, speed: float) -> tuple[float, float]:
    reach = Projectile(mass=mass, drag=drag, gravity=gravity).furthest(speed)
    return float(reach.distance), float(reach.angle)


envelope_of = Kept(_limit, most=KEPT)
furthest_of = Kept(_furthest, most=KEPT)


def show(answer: Answer, aim: Aim, state: State, *, live: bool) -> None:
    """Everything about one aim."""
    arcs = arcs_of(aim)
    size = _size(state)
    t, flown = _flown(aim, arcs, LIVE_FRAMES if live else FRAMES)
    scene = Scene(t, view=(-0.08 * size, size, -0.22 * size, 0.72 * size))
    scene = scene.segments([-0.08 * size, 0.0, size, 0.0], role="muted", width=1.0)
    scene = _with_envelope(answer, scene, arcs, state, live)
    target = [state["target_x"], state["target_y"]]
    for name, states in flown.items():
        points = np.column_stack((states.x, states.y))
        scene = scene.curve(points, role=ROLES[name], opacity=0.45).trail(points, role=ROLES[name])
        scene = scene.moving_point(points, role=ROLES[name])
        shaft = SHAFT * size * arcs[name].velocity / arcs[name].speed
        scene = scene.arrows([0.0, 0.0, *shaft.tolist()], role=ROLES[name])
        if aim.shortfall > 0.0:
            scene = scene.segments([*points[-1].tolist(), *target], role="no", dashed=True)
    _handles(answer, arcs, state, size)
    if not arcs:
        scene = scene.arrows([0.0, 0.0, *answer.handles[-1].at], role="muted")
    answer.pictures["main"] = scene.cross(target)
    _read_arcs(answer, arcs, flown, live)
    _read_reach(answer, aim, arcs, state, live)
    _say(answer, aim, live)
    speeds = {name: np.asarray(states.speed) for name, states in flown.items()}
    heights = {name: states.y for name, states in flown.items()}
    if flown:
        answer.plot("Speed", "m/s", ("time [s]", t), {n: _until(t, arcs[n], v) for n, v in speeds.items()})
        answer.plot("Height", "m", ("time [s]", t), {n: _until(t, arcs[n], v) for n, v in heights.items()})


def arcs_of(aim: Aim) -> dict[str, Arc]:
    """The launches that there are: the high one only where it differs."""
    found = {"low": aim.low, "high": aim.high}
    real = {name: arc for name, arc in found.items() if math.isfinite(arc.time)}
    if len(real) == 2 and abs(aim.low.angle - aim.high.angle) < 1e-9 and abs(aim.low.time - aim.high.time) < 1e-9:
        real.pop("high")
    return real


def _size(state: State) -> float:
    """The width of the view: a power of two, so that it jumps seldom."""
    reach = max(1.15 * state["target_x"], 1.7 * abs(state["target_y"]), LEAST_VIEW)
    return 2.0 ** math.ceil(math.log2(reach))


def _flown(aim: Aim, arcs: dict[str, Arc], frames: int) -> tuple[np.ndarray, dict[str, FlightState]]:
    """States at common times, all shots at once; one that has arrived rests at its end."""
    if not arcs:
        return np.zeros(1), {}
    ends = np.array([float(arc.time) for arc in arcs.values()])
    t = np.linspace(0.0, ends.max(), frames)
    shots = aim.projectile.launch(velocity=[arc.velocity for arc in arcs.values()])
    states = shots.at(np.minimum(t[:, None], ends))
    return t, {name: FlightState(*(part[:, i] for part in states)) for i, name in enumerate(arcs)}


def _until(t: np.ndarray, arc: Arc, values: np.ndarray) -> np.ndarray:
    return np.where(t <= arc.time * (1.0 + 1e-12), values, np.nan)


def _with_envelope(answer: Answer, scene: Scene, arcs: dict[str, Arc], state: State, live: bool) -> Scene:
    for name in arcs:
        answer.name(f"{name} arc" if len(arcs) > 1 else "the arc", ROLES[name])
    if not state["envelope"] or not arcs:
        return scene
    points = envelope_of.within(live, state["mass"], state["drag"], state["gravity"], float(arcs["low"].speed))
    if points is None:
        answer.complete = False
        return scene
    answer.name("limit of the reach", "muted", dashed=True)
    return scene.curve(points, role="muted", dashed=True)


def _handles(answer: Answer, arcs: dict[str, Arc], state: State, size: float) -> None:
    said = f"x {state['target_x']:.1f}, y {state['target_y']:.1f} m"
    place = (state["target_x"], state["target_y"])
    answer.handles.append(Handle("target", "Target", place, step=0.005 * size, value=said))
    angle = state["angle"] if state["by"] == "angle" or not arcs else float(arcs["low"].angle)
    tip = (SHAFT * size * math.cos(angle), SHAFT * size * math.sin(angle))
    said = f"{math.degrees(angle):.0f} degrees"
    answer.handles.append(Handle("launch", "Direction of the launch", tip, step=0.01, about=(0.0, 0.0), value=said))


def _read_arcs(answer: Answer, arcs: dict[str, Arc], flown: dict[str, FlightState], live: bool) -> None:
    for name, arc in arcs.items():
        group = f"{name.capitalize()} arc"
        answer.read(f"{name}_angle", "launch angle", float(arc.angle), "rad", group)
        answer.read(f"{name}_degrees", "launch angle", math.degrees(arc.angle), "deg", group)
        answer.read(f"{name}_speed", "launch speed", float(arc.speed), "m/s", group)
        answer.read(f"{name}_time", "flight time", float(arc.time), "s", group)
        way = flown[name]
        answer.read(f"{name}_end_speed", "speed at the end", float(way.speed[-1]), "m/s", group)
        answer.read(f"{name}_end_angle", "impact angle", float(way.angle[-1]), "rad", group)
        if not live:
            answer.read(f"{name}_apex", "highest point", float(arc.shot.apex().y), "m", group)
            _sensitivity(answer, name, arc, group)


def _read_reach(answer: Answer, aim: Aim, arcs: dict[str, Arc], state: State, live: bool) -> None:
    answer.read("furthest", "reach towards the target", float(aim.furthest), "m", "Reach")
    answer.read("shortfall", "short by", float(aim.shortfall), "m", "Reach")
    answer.read("terminal_speed", "terminal speed", float(aim.projectile.terminal_speed), "m/s", "Reach")
    known = furthest_of.within(live, state["mass"], state["drag"], state["gravity"], _speed(arcs)) if arcs else None
    if known is not None:
        answer.read("level_reach", "reach on level ground", known[0], "m", "Reach")
        answer.read("level_angle", "its launch angle", known[1], "rad", "Reach")
    if not live:
        answer.read("least_speed", "least speed that hits", float(aim.least_speed), "m/s", "Reach")
    answer.complete = answer.complete and not live


def _speed(arcs: dict[str, Arc]) -> float:
    return float(arcs["low"].speed)


def _sensitivity(answer: Answer, name: str, arc: Arc, group: str) -> None:
    moved = arc.shot.sensitivity(arc.time)
    for key, vector, unit in (("by_speed", moved.by_speed, "m per m/s"), ("by_angle", moved.by_angle, "m/rad")):
        words = key.replace("_", " ")
        for axis, value in zip("xy", vector.tolist(), strict=True):
            answer.read(f"{name}_{key}_{axis}", f"moves in {axis}, {words}", value, unit, group)


def _say(answer: Answer, aim: Aim, live: bool) -> None:
    answer.say(TONES.get(aim.status, "warn"), aim.sentence())
    if aim.status is AimStatus.OUT_OF_REACH and not live:
        answer.say("note", f"the least speed that reaches the target is {aim.least_speed:.4g} m/s")
