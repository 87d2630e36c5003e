"""Arm: drag the tool, see both elbows, what the arm reaches and how well; let it draw a curve."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any, ClassVar

import numpy as np

from coplanar import checks
from coplanar.arms import Arm, Solution
from coplanar.curves import Curve
from coplanar.play.answer import Answer
from coplanar.play.controls import AnyControl, Choice, Slider, State, Switch, clipped
from coplanar.play.tabs import arm_copy, arm_trace, arm_view, strokes
from coplanar.tracing import Trace, trace

LIVE_ROWS = 61  # of a trace, while something is dragged
LIVE_STEPS = 5  # of resolved rates, by which three limited links follow the hand
TURN = 2.0 * math.pi
KEPT = 64  # arms and solutions


def _joint(i: int, q: float, limit: float) -> tuple[Slider, Slider, Slider]:
    three = {"links": ("3",)} if i == 3 else {}
    return (
        Slider(f"q{i}", f"Joint {i}", group="Joints", unit="rad", low=-TURN, high=TURN, step=0.01, default=q,
               only=three or None, help="From the link before, counterclockwise."),
        Slider(f"lower{i}", f"Lower limit {i}", group="Limits", unit="rad", low=-math.pi, high=math.pi, step=0.01,
               default=-limit, only={"limited": (True,), **three}),
        Slider(f"upper{i}", f"Upper limit {i}", group="Limits", unit="rad", low=-math.pi, high=math.pi, step=0.01,
               default=limit, only={"limited": (True,), **three}),
    )  # fmt: skip


def _length(i: int, default: float) -> Slider:
    return Slider(f"l{i}", f"Link {i}", group="Arm", unit="m", low=0.1, high=2.0, step=0.01, default=default,
                  only={"links": ("3",)} if i == 3 else None)  # fmt: skip


class ArmTab:
    """Two or three links under the hand."""

    name: ClassVar[str] = "arm"
    title: ClassVar[str] = "Arm"
    about: ClassVar[str] = "Drag the tool. Both elbows, what is out of reach, and how well the arm moves there."
    controls: ClassVar[tuple[AnyControl, ...]] = (
        Choice("links", "Links", group="Arm", options=(("2", "two"), ("3", "three")), default="2"),
        *(_length(i, default) for i, default in ((1, 1.0), (2, 0.7), (3, 0.4))),
        Choice("follow", "The arm follows", group="Joints", default="target",
               options=(("target", "the target"), ("joints", "the joints")),
               help="Inverse kinematics from the target, or forward from the joint angles."),
        *(one for i, q, limit in ((1, 0.2, 2.0), (2, 1.2, 2.4), (3, 0.3, 1.8)) for one in _joint(i, q, limit)),
        Choice("elbow", "Elbow", group="Joints", options=(("+1", "left (+)"), ("-1", "right (-)")), default="+1",
               only={"links": ("2",)}, help="The sign of the sine at the elbow."),
        Slider("target_x", "Target x", group="Target", unit="m", low=-8.0, high=8.0, step=0.01, default=0.9),
        Slider("target_y", "Target y", group="Target", unit="m", low=-8.0, high=8.0, step=0.01, default=0.8),
        Switch("limited", "Joint limits", group="Limits", default=False),
        Choice("ellipse", "Ellipse", group="Show", default="velocity",
               options=(("velocity", "velocity"), ("force", "force"), ("none", "none")),
               help="Where unit joint rates take the tool, or what force unit torques hold."),
        *strokes.controls((("none", "none"),), default="none", size=0.4, at=(0.9, 0.4)),
        Choice("at_singular", "Where branches meet", group="Curve", default="through",
               options=(("through", "go through"), ("bounce", "keep the elbow"), ("stop", "stop")),
               only={"links": ("2",), "curve": tuple(name for name, _ in strokes.NAMES)}),
        Slider("points", "Points of the trace", group="Curve", low=11.0, high=401.0, step=10.0, default=121.0,
               only={"curve": tuple(name for name, _ in strokes.NAMES)}),
        Slider("duration", "Duration", group="Curve", unit="s", low=1.0, high=20.0, step=0.5, default=6.0,
               only={"curve": tuple(name for name, _ in strokes.NAMES)}),
    )  # fmt: skip

    def settled(self, state: State, changed: str) -> State:
        """The arm follows what was touched last: joints from the target, or the target from the tool."""
        return _settled(state, changed)

    def moved(self, state: State, handle: str, to: list[float]) -> State:
        """The target under the hand, the joints the nearest that reach it; or the curve's centre."""
        checks.choice("handle", handle, ("tool", "curve"))
        names = ("curve_x", "curve_y") if handle == "curve" else ("target_x", "target_y")
        state = state | {name: clipped(self.controls, name, v) for name, v in zip(names, to, strict=True)}
        if _is_slow(state):
            return state if handle == "curve" else _followed(state | {"follow": "target"})
        return _settled(state, names[0])

    def show(self, state: State, *, live: bool) -> Answer:
        """The arm where it is, or its way along the curve."""
        arm, answer = arm_of(state), Answer()
        curve = strokes.curve_of(state)
        answer.complete = not (live and (state["links"] == "3" or curve is not None))
        lost = None if curve is None or live or not _is_slow(state) else _lost(arm, curve, state)
        if curve is not None and lost is None and not (live and arm.n == 3):
            arm_trace.show(answer, self._trace(state, arm, curve, live), state)
            return answer
        aimed = state["follow"] == "target" and not (live and _is_slow(state))
        solution = solved(arm, state) if aimed else None
        arm_view.show(answer, (arm, joints_of(state)), solution, state, live=live)
        if curve is not None:
            arm_trace.outline(answer, curve, state, lost)
        elif state["curve"] == "stroke":
            answer.say("note", "draw a curve for the tool to follow")
        return answer

    def python(self, state: State) -> str:
        """A program with the same arm, target or curve."""
        return arm_copy.python(state, arm_of(state), strokes.curve_of(state))

    def scenario(self, state: State) -> dict[str, Any]:
        """The same as a scenario file holds it."""
        return arm_copy.scenario(state, arm_of(state), strokes.curve_of(state))

    def _trace(self, state: State, arm: Arm, curve: Curve, live: bool) -> Trace:
        """The arm along the curve."""
        singular, rows = state["at_singular"], round(state["points"])
        return trace(arm, curve, min(rows, LIVE_ROWS) if live else rows, near=joints_of(state), at_singular=singular)


def arm_of(state: State) -> Arm:
    """The arm of a state."""
    n = int(state["links"])
    limits = tuple((state[f"lower{i}"], state[f"upper{i}"]) for i in range(1, n + 1)) if state["limited"] else None
    return _arm(tuple(state[f"l{i}"] for i in range(1, n + 1)), limits)


@lru_cache(maxsize=KEPT)
def _arm(links: tuple[float, ...], limits: tuple[tuple[float, float], ...] | None) -> Arm:
    return Arm(links, limits=limits)


def joints_of(state: State) -> np.ndarray:
    """The joints of a state [rad]."""
    return np.array([state[f"q{i}"] for i in range(1, int(state["links"]) + 1)])


def solved(arm: Arm, state: State) -> Solution:
    """Joints for the target, near those of the state and on its elbow."""
    elbow = int(state["elbow"]) if arm.n == 2 else None
    target = (state["target_x"], state["target_y"])
    return _solved(tuple(arm.links), arm.limits, target, tuple(joints_of(state).tolist()), elbow)


@lru_cache(maxsize=KEPT)
def _solved(
    links: tuple[float, ...], limits: Any, target: tuple[float, float], near: tuple[float, ...], elbow: int | None
) -> Solution:
    """Kept, because the same one settles the state and is shown, and stays where something else is dragged."""
    return _arm(links, limits).inverse(target, near=near, elbow=elbow)


def _lost(arm: Arm, curve: Curve, state: State) -> np.ndarray | None:
    """Where no posture within the limits reaches the curve, shape (n, 2): a trace would search long at each of them."""
    points = curve.position(curve.parameters(round(state["points"])))
    reached = np.asarray(arm.inverse(points).reached)
    return None if reached.all() else points[~reached]


def _ordered(state: State, changed: str) -> State:
    """The limits of the joint whose limit was moved past the other one: that one goes along."""
    end, joint = changed[:-1], changed[-1:]
    if end not in ("lower", "upper") or state[f"lower{joint}"] <= state[f"upper{joint}"]:
        return state
    return state | {f"{other}{joint}": state[changed] for other in ("lower", "upper")}


def _settled(state: State, changed: str) -> State:
    state = _ordered(state, changed)
    follow = state["follow"]
    if changed in ("target_x", "target_y", "elbow"):
        follow = "target"
    elif changed in ("q1", "q2", "q3"):
        follow = "joints"
    state = state | {"follow": follow}
    if changed == "elbow":
        state["q2"] = -state["q2"]  # the other elbow is looked for on the other side
    arm = arm_of(state)
    if follow == "joints":
        x, y = arm.forward(joints_of(state)).position.tolist()
        elbow = "-1" if math.sin(state["q2"]) < 0.0 else "+1"
        return state | {"target_x": x, "target_y": y, "elbow": elbow}
    q = [v - math.copysign(TURN, v) if abs(v) > TURN else v for v in solved(arm, state).q.tolist()]
    return state | {f"q{i}": v for i, v in enumerate(q, 1)}


def _is_slow(state: State) -> bool:
    """Whether the inverse may search from many postures: three links within limits."""
    return state["links"] == "3" and bool(state["limited"])


def _followed(state: State) -> State:
    """Joints a few steps of damped rates nearer to the target, within the limits: in time for the next frame."""
    arm, q = arm_of(state), joints_of(state)
    for _ in range(LIVE_STEPS):
        way = (state["target_x"], state["target_y"]) - arm.forward(q).position
        q = np.clip(q + arm.rates(q, way).damped, arm.lower, arm.upper)
    return state | {f"q{i}": v for i, v in enumerate(q.tolist(), 1)}
