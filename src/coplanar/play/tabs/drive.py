"""Drive: a point on the robot follows a reference; what its gains will do is seen before it runs."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from coplanar import checks
from coplanar.control import Limits, PointTracker, Unicycle
from coplanar.curves import HeldPoint, Reference
from coplanar.errors import InvalidValue
from coplanar.play.answer import Answer
from coplanar.play.controls import AnyControl, Choice, Slider, State, Switch, clipped
from coplanar.play.tabs import drive_copy, drive_view, strokes
from coplanar.run import Run
from coplanar.se2 import Pose, wrap_angle
from coplanar.simulation import simulate

MOST_STEPS = 2000  # of one run
LIVE_STEPS = 250  # while something is dragged: the beginning of the run
METHODS = (("euler", "Euler"), ("midpoint", "midpoint"), ("heun", "Heun"), ("rk4", "RK4"), ("exact", "exact arcs"))
COMPARED = ("euler", "rk4", "exact")


class DriveTab:
    """A point fixed on a unicycle follows a reference."""

    name: ClassVar[str] = "drive"
    title: ClassVar[str] = "Drive"
    about: ClassVar[str] = "A point on the robot follows a curve. The poles say what the gains will do before it runs."
    controls: ClassVar[tuple[AnyControl, ...]] = (
        *strokes.controls((("point", "a resting point"),), default="astroid", size=1.0),
        Slider("duration", "Duration", group="Curve", unit="s", low=1.0, high=30.0, step=0.5, default=10.0),
        Slider("px", "P ahead of the axle", group="Robot", unit="m", low=-0.5, high=0.5, step=0.005, default=0.1,
               help="Negative: behind; at 0 no command moves P sideways."),
        Slider("py", "P to the left", group="Robot", unit="m", low=-0.5, high=0.5, step=0.005, default=0.0),
        Slider("kp", "kp", group="Controller", unit="1/s", low=0.1, high=200.0, step=0.1, default=8.0, scale="log"),
        Slider("kd", "kd", group="Controller", low=-1.2, high=1.2, step=0.01, default=0.0),
        Slider("ki", "ki", group="Controller", unit="1/s^2", low=0.0, high=100.0, step=0.1, default=0.0),
        Switch("feedforward", "Feed-forward", group="Controller", default=False,
               help="Adds the velocity of the reference."),
        Choice("error_against", "Error against the reference", group="Controller", default="current",
               options=(("current", "now"), ("next", "at the next step"))),
        Slider("step", "Step h", group="Integrator", unit="s", low=0.002, high=0.2, step=0.001, default=0.02,
               scale="log"),
        Choice("method", "Integrator", group="Integrator", options=METHODS, default="euler"),
        Switch("compare", "Compare Euler, RK4, exact", group="Integrator", default=False),
        Switch("limited", "Limits", group="Limits", default=False),
        Slider("v_limit", "Largest |v|", group="Limits", unit="m/s", low=0.05, high=5.0, step=0.05, default=0.8,
               only={"limited": (True,)}),
        Slider("omega_limit", "Largest |omega|", group="Limits", unit="rad/s", low=0.1, high=30.0, step=0.1,
               default=4.0, only={"limited": (True,)}),
        Choice("mode", "Saturation", group="Limits", default="scale", only={"limited": (True,)},
               options=(("scale", "scale both"), ("clip", "clip each"), ("keep_omega", "keep omega"))),
        Choice("start", "Start", group="Start", options=(("reference", "P on the reference"), ("free", "anywhere")),
               default="reference"),
        Slider("start_x", "Start x", group="Start", unit="m", low=-6.0, high=6.0, step=0.01, default=0.5,
               only={"start": ("free",)}),
        Slider("start_y", "Start y", group="Start", unit="m", low=-6.0, high=6.0, step=0.01, default=-0.6,
               only={"start": ("free",)}),
        Slider("heading", "Start heading", group="Start", unit="rad", low=-3.15, high=3.15, step=0.01, default=0.0,
               only={"start": ("free",)}),
    )  # fmt: skip

    def settled(self, state: State, changed: str) -> State:
        """A start that was set by hand counts."""
        if changed in ("start_x", "start_y", "heading"):
            return state | {"start": "free"}
        return state

    def moved(self, state: State, handle: str, to: list[float]) -> State:
        """The reference's centre, the start, or the heading there, under the hand."""
        checks.choice("handle", handle, ("curve", "start", "heading"))
        if handle == "curve":
            placed = zip(("curve_x", "curve_y"), to, strict=True)
            return state | {name: clipped(self.controls, name, v) for name, v in placed}
        start = start_of(state, tracker_of(state), reference_of(state))
        x, y, heading = start.parts
        if handle == "start":
            x, y = to
        else:
            heading = math.atan2(to[1] - y, to[0] - x)
        pose = {"start_x": x, "start_y": y, "heading": wrap_angle(heading)}
        return state | {"start": "free"} | {name: clipped(self.controls, name, v) for name, v in pose.items()}

    def show(self, state: State, *, live: bool) -> Answer:
        """The run, its poles, its commands and errors."""
        answer, tracker, reference = Answer(), tracker_of(state), reference_of(state)
        count = steps_of(state)
        methods = COMPARED if state["compare"] and not live else ()
        answer.complete = not (live and (count > LIVE_STEPS or state["compare"]))
        duration = state["step"] * LIVE_STEPS if live and count > LIVE_STEPS else state["duration"]
        start = start_of(state, tracker, reference)
        runs = {
            method: run_of(state, tracker, reference, method=method, duration=duration)
            for method in {state["method"]: None, **dict.fromkeys(methods)}
        }
        drive_view.show(answer, state, (tracker, reference, start), runs, live=live)
        return answer

    def python(self, state: State) -> str:
        """A program with the same tracker, reference and run."""
        steps_of(state)
        return drive_copy.python(state)

    def scenario(self, state: State) -> dict[str, Any]:
        """The same as a scenario file holds it."""
        return drive_copy.scenario(state)


def steps_of(state: State) -> int:
    """How many steps the run takes.

    Raises:
        InvalidValue: If they are more than ``MOST_STEPS``.
    """
    count: int = math.ceil(state["duration"] / state["step"])
    if count > MOST_STEPS:
        least = state["duration"] / MOST_STEPS
        needed = f"at least {least:g} s for {state['duration']:g} s: at most {MOST_STEPS} steps"
        raise InvalidValue("step", state["step"], needed)
    return count


def tracker_of(state: State) -> PointTracker:
    """The controller of a state."""
    return PointTracker(
        (state["px"], state["py"]), state["kp"], state["kd"], state["ki"],
        feedforward=state["feedforward"], error_against=state["error_against"],
    )  # fmt: skip


def reference_of(state: State) -> Reference | HeldPoint:
    """What P follows; a point that rests until something is drawn."""
    curve = strokes.curve_of(state)
    if curve is None:
        return HeldPoint((state["curve_x"], state["curve_y"]))
    return curve.over(state["duration"])


def start_of(state: State, tracker: PointTracker, reference: Reference | HeldPoint) -> Pose:
    """Where the robot starts."""
    if state["start"] == "free":
        return Pose(state["start_x"], state["start_y"], state["heading"])
    pose = tracker.start(reference, 0.0)
    return Pose(*(float(part) for part in pose.parts))


def run_of(state: State, tracker: PointTracker, reference: Any, *, method: str, duration: float) -> Run:
    """The closed loop by one method."""
    limits = None
    if state["limited"]:
        limits = Limits(v=state["v_limit"], omega=state["omega_limit"], mode=state["mode"])
    start = start_of(state, tracker, reference)
    with np.errstate(all="ignore"):  # a loop that diverges says so in its status
        return simulate(
            Unicycle(), tracker, reference, duration=duration, step=state["step"], method=method, limits=limits,
            start=start,
        )  # fmt: skip
