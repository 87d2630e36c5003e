"""Drive: a point on the robot follows a reference, or the robot drives to a pose; the gains tell before it runs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, ClassVar

from coplanar import checks
from coplanar.play.answer import Answer
from coplanar.play.controls import AnyControl, Choice, Slider, State, Switch, clipped
from coplanar.play.tabs import drive_copy, drive_view, strokes
from coplanar.play.tabs.drive_loop import FORMS, LIVE_STEPS, controller_of, reference_of, run_of, start_of, steps_of
from coplanar.se2 import wrap_angle

METHODS = (("euler", "Euler"), ("midpoint", "midpoint"), ("heun", "Heun"), ("rk4", "RK4"), ("exact", "exact arcs"))
COMPARED = ("euler", "rk4", "exact")
POINT, POLAR = {"controller": ("point",)}, {"controller": ("polar",)}
LIMITED, NOISY, FREE = {"limited": (True,)}, {"noisy": (True,)}, {"start": ("free",)}


def _curves() -> Iterator[AnyControl]:
    """What a point can follow."""
    for control in strokes.controls((("point", "a resting point"),), default="astroid", size=1.0):
        yield replace(control, only={**(control.only or {}), **POINT})


def _gains() -> tuple[Slider, ...]:
    rho, alpha, beta = FORMS["linear"]
    return (
        Slider("k_rho", "k rho", group="Controller", unit="1/s", low=0.1, high=10.0, step=0.05, default=rho, only=POLAR,
               help="Speed by the distance to the goal."),
        Slider("k_alpha", "k alpha", group="Controller", unit="1/s", low=0.1, high=20.0, step=0.1, default=alpha,
               only=POLAR, help="Turn rate by the bearing of the goal."),
        Slider("k_beta", "k beta", group="Controller", low=-10.0, high=10.0, step=0.1, default=beta, only=POLAR,
               help="Pull to the goal's heading: negative in the linear law [1/s], positive in the smooth one."),
    )  # fmt: skip


def _spread(key: str, label: str, unit: str, high: float, default: float) -> Slider:
    return Slider(key, label, group="Noise", unit=unit, low=0.0, high=high, step=high / 500.0, default=default,
                  only=NOISY)  # fmt: skip


class DriveTab:
    """A unicycle and its controller."""

    name: ClassVar[str] = "drive"
    title: ClassVar[str] = "Drive"
    about: ClassVar[str] = "A point follows a curve, or the robot drives to a pose; the poles foretell what gains do."
    controls: ClassVar[tuple[AnyControl, ...]] = (
        Choice("controller", "The robot", group="Controller", default="point",
               options=(("point", "follows a curve"), ("polar", "drives to a pose"))),
        Slider("kp", "kp", group="Controller", unit="1/s", low=0.1, high=200.0, step=0.1, default=8.0, scale="log",
               only=POINT),
        Slider("kd", "kd", group="Controller", low=-1.2, high=1.2, step=0.01, default=0.0, only=POINT),
        Slider("ki", "ki", group="Controller", unit="1/s^2", low=0.0, high=100.0, step=0.1, default=0.0, only=POINT),
        Switch("feedforward", "Feed-forward", group="Controller", default=False, only=POINT,
               help="Adds the velocity of the reference."),
        Choice("error_against", "Error against the reference", group="Controller", default="current", only=POINT,
               options=(("current", "now"), ("next", "at the next step"))),
        Choice("form", "Law", group="Controller", options=(("linear", "linear"), ("smooth", "smooth")),
               default="linear", only=POLAR, help="Linear near the goal (Siegwart), or from everywhere (Aicardi)."),
        *_gains(),
        Choice("direction", "Drives", group="Controller", default="forward", only=POLAR,
               options=(("forward", "forward"), ("backward", "backward"), ("nearest", "as it stands"))),
        Slider("arrive_within", "Arrives within", group="Controller", unit="m", low=1e-6, high=0.2, step=1e-6,
               default=0.01, scale="log", only=POLAR, help="Nearer than that only the heading is turned."),
        Slider("goal_x", "Goal x", group="Goal", unit="m", low=-6.0, high=6.0, step=0.01, default=1.2, only=POLAR),
        Slider("goal_y", "Goal y", group="Goal", unit="m", low=-6.0, high=6.0, step=0.01, default=0.8, only=POLAR),
        Slider("goal_heading", "Goal heading", group="Goal", unit="rad", low=-3.15, high=3.15, step=0.01, default=1.57,
               only=POLAR),
        *_curves(),
        Slider("px", "P ahead of the axle", group="Robot", unit="m", low=-0.5, high=0.5, step=0.005, default=0.1,
               only=POINT, help="Negative: behind; at 0 no command moves P sideways."),
        Slider("py", "P to the left", group="Robot", unit="m", low=-0.5, high=0.5, step=0.005, default=0.0, only=POINT),
        Slider("duration", "Duration", group="Integrator", unit="s", low=1.0, high=30.0, step=0.5, default=10.0),
        Slider("step", "Step h", group="Integrator", unit="s", low=0.002, high=0.2, step=0.001, default=0.02,
               scale="log"),
        Choice("method", "Integrator", group="Integrator", options=METHODS, default="euler"),
        Switch("compare", "Compare Euler, RK4, exact", group="Integrator", default=False),
        Switch("limited", "Limits", group="Limits", default=False),
        Slider("v_limit", "Largest |v|", group="Limits", unit="m/s", low=0.05, high=5.0, step=0.05, default=0.8,
               only=LIMITED),
        Slider("omega_limit", "Largest |omega|", group="Limits", unit="rad/s", low=0.1, high=30.0, step=0.1,
               default=4.0, only=LIMITED),
        Choice("mode", "Saturation", group="Limits", default="scale", only=LIMITED,
               options=(("scale", "scale both"), ("clip", "clip each"), ("keep_omega", "keep omega"))),
        Switch("noisy", "Noise", group="Noise", default=False,
               help="Normally distributed, at every step; the same seed gives the same run."),
        _spread("noise_position", "Measured x and y", "m", 0.05, 0.005),
        _spread("noise_heading", "Measured heading", "rad", 0.1, 0.01),
        _spread("noise_v", "Driven v", "m/s", 0.5, 0.02),
        _spread("noise_omega", "Driven omega", "rad/s", 2.0, 0.1),
        Slider("seed", "Seed", group="Noise", low=0.0, high=99.0, step=1.0, default=0.0, only=NOISY),
        Choice("start", "Start", group="Start", options=(("reference", "P on the reference"), ("free", "anywhere")),
               default="reference", only=POINT),
        Slider("start_x", "Start x", group="Start", unit="m", low=-6.0, high=6.0, step=0.01, default=0.5, only=FREE),
        Slider("start_y", "Start y", group="Start", unit="m", low=-6.0, high=6.0, step=0.01, default=-0.6, only=FREE),
        Slider("heading", "Start heading", group="Start", unit="rad", low=-3.15, high=3.15, step=0.01, default=0.0,
               only=FREE),
    )  # fmt: skip

    def settled(self, state: State, changed: str) -> State:
        """A start that was set by hand counts; a goal says nothing of the start; each law has gains of its own."""
        if changed == "controller" and state["controller"] == "point":
            return state | {"start": "reference"}
        if changed == "form":
            state = state | dict(zip(("k_rho", "k_alpha", "k_beta"), FORMS[state["form"]], strict=True))
        if state["controller"] == "polar" or changed in ("start_x", "start_y", "heading"):
            return state | {"start": "free"}
        return state

    def moved(self, state: State, handle: str, to: list[float]) -> State:
        """The reference's centre or the goal, the start, or a heading there, under the hand."""
        state = self.settled(state, "")
        polar = state["controller"] == "polar"
        checks.choice("handle", handle, (*(("goal", "goal_turn") if polar else ("curve",)), "start", "heading"))
        if handle in ("curve", "goal"):
            return self._clipped(state, zip((f"{handle}_x", f"{handle}_y"), to, strict=True))
        if handle == "goal_turn":
            turned = math.atan2(to[1] - state["goal_y"], to[0] - state["goal_x"])
            return self._clipped(state, [("goal_heading", wrap_angle(turned))])
        x, y, heading = start_of(state, controller_of(state), reference_of(state)).parts
        if handle == "start":
            x, y = to
        else:
            heading = math.atan2(to[1] - y, to[0] - x)
        pose = (("start_x", x), ("start_y", y), ("heading", wrap_angle(heading)))
        return self._clipped(state | {"start": "free"}, pose)

    def _clipped(self, state: State, pairs: Any) -> State:
        return state | {name: clipped(self.controls, name, value) for name, value in pairs}

    def show(self, state: State, *, live: bool) -> Answer:
        """The run, its poles, its commands and errors."""
        answer, controller, reference = Answer(), controller_of(state), reference_of(state)
        count = steps_of(state)
        methods = COMPARED if state["compare"] and not live else ()
        answer.complete = not (live and (count > LIVE_STEPS or state["compare"]))
        duration = state["step"] * LIVE_STEPS if live and count > LIVE_STEPS else state["duration"]
        start = start_of(state, controller, reference)
        runs = {
            method: run_of(state, controller, reference, method=method, duration=duration)
            for method in {state["method"]: None, **dict.fromkeys(methods)}
        }
        drive_view.show(answer, state, (controller, reference, start), runs, live=live)
        return answer

    def python(self, state: State) -> str:
        """A program with the same controller, reference and run."""
        steps_of(state)
        return drive_copy.python(state)

    def scenario(self, state: State) -> dict[str, Any]:
        """The same as a scenario file holds it."""
        return drive_copy.scenario(state)
