"""The closed loop of the Drive tab: controller, reference, start, noise and run of a state."""

from __future__ import annotations

import math
from functools import lru_cache
from types import MappingProxyType
from typing import Any

import numpy as np

from coplanar.control import Limits, PointTracker, PolarController, StabilityReport, Unicycle
from coplanar.curves import HeldPoint, Reference
from coplanar.errors import InvalidValue
from coplanar.play.controls import State
from coplanar.play.tabs import strokes
from coplanar.run import Run
from coplanar.se2 import Pose
from coplanar.simulation import Noise, simulate

MOST_STEPS = 2000  # of one run
LIVE_STEPS = 250  # while something is dragged: the beginning of the run
KEPT_REPORTS = 64
FORMS = MappingProxyType({"linear": (3.0, 8.0, -1.5), "smooth": (3.0, 6.0, 1.0)})  # usual gains
POINT = ("px", "py", "kp", "kd", "ki", "feedforward", "error_against")
POLAR = ("goal_x", "goal_y", "goal_heading", "k_rho", "k_alpha", "k_beta", "form", "direction", "arrive_within")
NOISE = ("position", "heading", "v", "omega")

AnyController = PointTracker | PolarController
AnyReference = Reference | HeldPoint | None


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


def controller_of(state: State) -> AnyController:
    """The controller of a state."""
    return _made(state["controller"], *(state[key] for key in _keys(state)))


def _keys(state: State) -> tuple[str, ...]:
    return POLAR if state["controller"] == "polar" else POINT


def _made(kind: str, first: float, second: float, *others: Any) -> AnyController:
    if kind == "polar":
        heading, *gains = others
        return PolarController(Pose(first, second, heading), *gains)
    kp, kd, ki, ahead, against = others
    return PointTracker((first, second), kp, kd, ki, feedforward=ahead, error_against=against)


def report_of(state: State, speed: float) -> StabilityReport:
    """What the loop will do, at a speed of the reference [m/s]."""
    values = (state[key] for key in _keys(state))
    return _report(state["step"], state["method"], speed, state["controller"], *values)


@lru_cache(maxsize=KEPT_REPORTS)
def _report(step: float, method: str, speed: float, *controller: Any) -> StabilityReport:
    """Kept, because a drag of the reference or the start asks for the same one every frame."""
    return _made(*controller).stability(step, method=method, speed=speed)


def reference_of(state: State) -> AnyReference:
    """What P follows, a point that rests until something is drawn; nothing on the way to a pose."""
    if state["controller"] == "polar":
        return None
    curve = strokes.curve_of(state)
    if curve is None:
        return HeldPoint((state["curve_x"], state["curve_y"]))
    return curve.over(state["duration"])


def start_of(state: State, controller: AnyController, reference: AnyReference) -> Pose:
    """Where the robot starts."""
    if reference is None or state["start"] == "free":
        return Pose(state["start_x"], state["start_y"], state["heading"])
    pose = controller.start(reference, 0.0)
    return Pose(*(float(part) for part in pose.parts))


def noise_of(state: State) -> Noise | None:
    """What sensors and motors add; the beginning of a run is the same however long it is."""
    if not state["noisy"]:
        return None
    return Noise(**{key: state[f"noise_{key}"] for key in NOISE}, seed=round(state["seed"]))


def run_of(
    state: State, controller: AnyController, reference: AnyReference, *, method: str, duration: float
) -> Run:  # fmt: skip
    """The closed loop by one method."""
    limits = None
    if state["limited"]:
        limits = Limits(v=state["v_limit"], omega=state["omega_limit"], mode=state["mode"])
    start = start_of(state, controller, reference)
    with np.errstate(all="ignore"):  # a loop that diverges says so in its status
        return simulate(
            Unicycle(), controller, reference, duration=duration, step=state["step"], method=method, limits=limits,
            start=start, noise=noise_of(state),
        )  # fmt: skip
