"""What a base looks like from above, what it cannot do, and where it drives."""

from __future__ import annotations

import math

import numpy as np

from coplanar.arms import Arc
from coplanar.play.answer import Answer, Handle
from coplanar.play.controls import State
from coplanar.se2 import Pose, Twist
from coplanar.viz.scene import Scene
from coplanar.wheels import FeasibleTwist, Finding, FindingKind, Icr, WheeledBase
from coplanar.wheels.slip import SlipStatus

VIEW = 1.1  # half the width of the picture of the base [m]
SHAFT = 0.5  # length drawn for a speed of 1 [s]
GRIP = 0.17  # from a wheel to the handle that turns it [m]
GHOST = 0.35  # how long a forbidden unit motion is followed [s]
SEEN = 0.05  # part of a unit motion that has to be missing for it to be drawn
NEAR = 3.0  # how far a centre of rotation is drawn [m]
FRAMES = 121
LIVE_FRAMES = 61


def show(answer: Answer, base: WheeledBase, wanted: Twist, state: State, *, live: bool) -> None:
    """Everything about one base and one motion."""
    possible = base.feasible(wanted)
    answer.pictures["main"] = _from_above(base, possible)
    _drive(answer, base, possible.twist, state, LIVE_FRAMES if live else FRAMES)
    _handles(answer, base, wanted)
    rates = base.inverse(possible.twist)
    _read(answer, base, possible, rates)
    _say(answer, base, possible)
    _slip(answer, base, rates, state)


def _from_above(base: WheeledBase, possible: FeasibleTwist) -> Scene:
    scene = Scene(view=(-VIEW, VIEW, -VIEW, VIEW))
    hull = outline(base)
    for missing in forbidden(base):
        pose = Pose.exp(missing.during(GHOST)).as_array()
        scene = scene.body(pose, hull, role="no", opacity=0.3).cross(pose[:2], role="no", size=9.0, opacity=0.7)
        scene = scene.arrows([0.0, 0.0, *pose[:2]], role="no", crossed=True, opacity=0.6)
    scene = scene.body([0.0, 0.0, 0.0], hull)
    scene = _with_centre(scene, base, possible.twist)
    scene = carried(scene, base, np.zeros((1, 3)))
    for i, wheel in enumerate(base.wheels, 1):
        scene = scene.text(str(i), [0.72 * wheel.x, 0.72 * wheel.y], role="muted")
    ways = base.wheel_velocities(possible.twist)
    places = np.array([(w.x, w.y) for w in base.wheels])
    scene = scene.arrows(np.column_stack((places, 0.5 * SHAFT * ways)).ravel(), role="third", opacity=0.8)
    return _with_motion(scene, possible)


def outline(base: WheeledBase) -> np.ndarray:
    """A body around the wheels: a rounded square that holds them all, shape (n, 2) [m]."""
    reach = max(max(abs(w.x), abs(w.y)) for w in base.wheels) + 0.06
    cut = 0.25 * reach
    corners = [(reach, cut - reach), (reach, reach - cut), (reach - cut, reach), (cut - reach, reach),
               (-reach, reach - cut), (-reach, cut - reach), (cut - reach, -reach), (reach - cut, -reach)]  # fmt: skip
    return np.array(corners)


def carried(scene: Scene, base: WheeledBase, poses: np.ndarray) -> Scene:
    """The wheels, and the roller that touches the ground across each, on the moving body."""
    tyres, rollers = [], []
    for wheel in base.wheels:
        angle, r = wheel.drive_angle, wheel.radius
        tyres += _bar(wheel.x, wheel.y, angle, r)
        if wheel.roller_angle is not None:
            rollers += _bar(wheel.x, wheel.y, angle + wheel.roller_angle, 0.45 * r)
    scene = scene.carried(poses, tyres, role="ink", width=8.0)
    return scene.carried(poses, rollers, role="second", width=2.5) if rollers else scene


def forbidden(base: WheeledBase) -> list[Twist]:
    """What is missing of a unit of each motion, where it is worth drawing."""
    units = Twist.from_array(np.diag([1.0, 1.0, 1.0 / base.mobility.length]))
    possible = base.feasible(units)
    missing, sizes = possible.infeasible.as_array(), np.asarray(possible.gap)
    return [Twist.from_array(row) for row, size in zip(missing, sizes.tolist(), strict=True) if size > SEEN]


def _bar(x: float, y: float, angle: float, half: float) -> list[float]:
    dx, dy = half * math.cos(angle), half * math.sin(angle)
    return [x - dx, y - dy, x + dx, y + dy]


def _with_motion(scene: Scene, possible: FeasibleTwist) -> Scene:
    """The wanted motion, what is driven of it, and what is missing struck out."""
    missing, driven = possible.infeasible, possible.twist
    scene = scene.arrows([0.0, 0.0, SHAFT * driven.vx, SHAFT * driven.vy], role="trail")
    if not possible.is_feasible and math.hypot(missing.vx, missing.vy) > 1e-9:
        tail = [SHAFT * driven.vx, SHAFT * driven.vy, SHAFT * missing.vx, SHAFT * missing.vy]
        scene = scene.arrows(tail, role="no", crossed=True)
    if abs(driven.omega) > 1e-9:
        low, sweep = (0.0, driven.omega) if driven.omega > 0.0 else (driven.omega, -driven.omega)
        line = Arc((0.0, 0.0), 0.3, low, sweep).points(25)
        line = line if driven.omega > 0.0 else line[::-1]
        scene = scene.curve(line, role="trail").arrows([*line[-2], *(line[-1] - line[-2])], role="trail")
    return scene


def _with_centre(scene: Scene, base: WheeledBase, twist: Twist) -> Scene:
    """The centre of rotation and the lines from the wheels to it, where it is near."""
    centre = Icr(twist)
    if not centre.exists or not math.hypot(*centre.body) < NEAR:
        return scene
    x, y = centre.body.tolist()
    lines = [part for wheel in base.wheels for part in (wheel.x, wheel.y, x, y)]
    scene = scene.segments(lines, role="muted", dashed=True, width=1.0, opacity=0.7)
    return scene.moving_point([x, y], role="fourth").text("ICR", [x, y], role="fourth", shift=(0, -10))


def _drive(answer: Answer, base: WheeledBase, twist: Twist, state: State, frames: int) -> None:
    t = np.linspace(0.0, state["duration"], frames)
    poses = Pose.exp(twist.during(t)).as_array()
    reach = float(np.abs(poses[:, :2]).max()) + VIEW
    half = 2.0 ** math.ceil(math.log2(reach))
    scene = Scene(t, view=(-half, half, -half, half)).trail(poses[:, :2]).body(poses, outline(base))
    answer.pictures["drive"] = carried(scene, base, poses)
    answer.plot("Position", "m", ("time [s]", t), {"x": poses[:, 0], "y": poses[:, 1]})
    answer.plot("Heading", "rad", ("time [s]", t), {"theta": poses[:, 2]})
    for name, value in zip(("x", "y", "theta"), poses[-1].tolist(), strict=True):
        answer.read(f"end_{name}", f"{name} at the end", value, "rad" if name == "theta" else "m", "Driven")


def _handles(answer: Answer, base: WheeledBase, wanted: Twist) -> None:
    for i, wheel in enumerate(base.wheels, 1):
        here = (wheel.x, wheel.y)
        grip = (wheel.x + GRIP * math.cos(wheel.drive_angle), wheel.y + GRIP * math.sin(wheel.drive_angle))
        said = f"{math.degrees(wheel.drive_angle):.0f} degrees"
        answer.handles.append(Handle(f"wheel_{i}", f"Wheel {i}", here, step=0.01))
        answer.handles.append(
            Handle(f"turn_{i}", f"Drive direction of wheel {i}", grip, step=0.05, about=here, value=said)
        )
    tip = (SHAFT * float(wanted.vx), SHAFT * float(wanted.vy))
    said = f"vx {wanted.vx:.2f}, vy {wanted.vy:.2f} m/s"
    answer.handles.append(Handle("velocity", "Wanted velocity", tip, step=0.01, value=said))


def _read(answer: Answer, base: WheeledBase, possible: FeasibleTwist, rates: np.ndarray) -> None:
    answer.read("rank", "rank", base.rank, "", "Rank")
    answer.read("condition", "condition number", base.condition, "", "Rank")
    answer.read("control", "degrees of control", base.degrees_of_control, "", "Rank")
    answer.read("configuration", "degrees of configuration", base.degrees_of_configuration, "", "Rank")
    for i, value in enumerate(base.singular_values.tolist(), 1):
        answer.read(f"sigma{i}", f"singular value {i}", value, "", "Rank")
    for i, (name, rate) in enumerate(base.by_name(rates).items(), 1):
        answer.read(f"rate{i}", name.replace("_", " "), rate, "rad/s", "Wheel rates")
    driven = possible.twist
    for key, unit in (("vx", "m/s"), ("vy", "m/s"), ("omega", "rad/s")):
        answer.read(f"driven_{key}", f"driven {key}", getattr(driven, key), unit, "Driven")
    answer.read("gap", "missing", float(possible.gap), "m/s", "Driven")
    centre = Icr(driven)
    if centre.exists:
        x, y = centre.body.tolist()
        answer.read("icr_x", "ICR x (body)", x, "m", "Driven")
        answer.read("icr_y", "ICR y (body)", y, "m", "Driven")


def _say(answer: Answer, base: WheeledBase, possible: FeasibleTwist) -> None:
    answer.say("good" if possible.is_feasible else "no", possible.status.value)
    for finding in base.diagnose():
        answer.say(_tone(finding), str(finding))
    answer.say("note", Icr(possible.twist).status.value)


def _tone(finding: Finding) -> str:
    if finding.kind is FindingKind.FORBIDDEN:
        return "warn"
    return "no" if finding.is_fault else "note"


def _slip(answer: Answer, base: WheeledBase, rates: np.ndarray, state: State) -> None:
    """What the redundant wheels say when one of them is off."""
    number = round(state["slipping"])
    measured = rates.copy()
    if number <= len(measured):
        measured[number - 1] += state["slip"]
    elif state["slip"]:
        answer.say("note", f"there is no wheel {number} to slip")
    seen = base.slip(measured, state["noise"])
    answer.read("slip_statistic", "slip statistic", float(seen.statistic), "", "Slip")
    answer.read("slip_threshold", "threshold", seen.threshold, "", "Slip")
    tones = {SlipStatus.ROLLING: "good", SlipStatus.SLIPPING: "no", SlipStatus.BLIND: "note"}
    if state["slip"] or seen.status is not SlipStatus.BLIND:
        answer.say(tones[seen.status], seen.status.value)
