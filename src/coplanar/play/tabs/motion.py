"""Motion: line, circle, clothoid and cusp from the same four sliders; segments joined; integrators beside the truth."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from coplanar import checks
from coplanar.errors import InvalidValue
from coplanar.motion import Program, Segment
from coplanar.play.answer import Answer
from coplanar.play.controls import AnyControl, Choice, Rows, Slider, State, Switch, clipped
from coplanar.play.tabs import motion_copy, motion_view
from coplanar.se2 import Pose, wrap_angle
from coplanar.solving import least_squares

PARTS = ("v", "omega", "a", "alpha")
PRESETS: dict[str, tuple[float, float, float, float, float]] = {
    "line": (1.0, 0.0, 0.0, 0.0, 3.0),
    "circle": (1.0, 1.0, 0.0, 0.0, 2.0 * math.pi),
    "clothoid": (1.0, -1.0, 0.0, 0.6, 5.0),
    "cusp": (1.2, 0.8, -0.6, 0.0, 4.0),
    "spin": (0.0, 1.0, 0.0, 0.0, 3.0),
    "general": (0.4, -0.6, 0.3, 0.5, 4.0),
}
SEARCH = 6  # iterations by which the end follows the hand in one frame
MOST_STEPS = 800  # of the integrators that are compared


def _sliders(*, group: str) -> tuple[Slider, ...]:
    return (
        Slider("v", "v", group=group, unit="m/s", low=-2.0, high=2.0, step=0.01, default=1.0),
        Slider("omega", "omega", group=group, unit="rad/s", low=-3.0, high=3.0, step=0.01, default=-1.0),
        Slider("a", "a", group=group, unit="m/s^2", low=-1.0, high=1.0, step=0.01, default=0.0),
        Slider("alpha", "alpha", group=group, unit="rad/s^2", low=-1.0, high=1.0, step=0.01, default=0.6),
        Slider("duration", "Duration", group=group, unit="s", low=0.1, high=10.0, step=0.1, default=5.0),
    )


class MotionTab:
    """Segments of constant accelerations, one after another."""

    name: ClassVar[str] = "motion"
    title: ClassVar[str] = "Motion"
    about: ClassVar[str] = "Constant accelerations drive lines, circles, clothoids and cusps; chain them."
    controls: ClassVar[tuple[AnyControl, ...]] = (
        Choice("preset", "Curve", group="Segment", default="clothoid",
               options=(*((name, name) for name in PRESETS), ("custom", "my own"))),
        *_sliders(group="Segment"),
        Rows("then", "Segments after it", group="Chain", fields=_sliders(group=""), default=[], most=7, least=0,
             row="segment", first=2, help="Each begins where the one before ends."),
        Slider("start_x", "Start x", group="Start", unit="m", low=-6.0, high=6.0, step=0.01, default=0.0),
        Slider("start_y", "Start y", group="Start", unit="m", low=-6.0, high=6.0, step=0.01, default=0.0),
        Slider("heading", "Start heading", group="Start", unit="rad", low=-3.15, high=3.15, step=0.01, default=0.0),
        Switch("compare", "Compare Euler and RK4", group="Integrator", default=True),
        Slider("step", "Their step", group="Integrator", unit="s", low=0.02, high=1.0, step=0.01, default=0.25,
               scale="log", only={"compare": (True,)}),
    )  # fmt: skip

    def settled(self, state: State, changed: str) -> State:
        """The sliders of a named curve; a slider that was moved makes it one's own."""
        keys = (*PARTS, "duration")
        if changed == "preset" and state["preset"] in PRESETS:
            return state | dict(zip(keys, PRESETS[state["preset"]], strict=True))
        if changed in keys:
            return state | {"preset": "custom"}
        return state

    def moved(self, state: State, handle: str, to: list[float]) -> State:
        """The start, its heading, or the end of the last segment under the hand."""
        checks.choice("handle", handle, ("start", "heading", "end"))
        if handle == "end":
            return _with_end(state, to)
        if handle == "start":
            placed = dict(zip(("start_x", "start_y"), to, strict=True))
        else:
            placed = {"heading": wrap_angle(math.atan2(to[1] - state["start_y"], to[0] - state["start_x"]))}
        return state | {key: clipped(self.controls, key, value) for key, value in placed.items()}

    def show(self, state: State, *, live: bool) -> Answer:
        """The path, its velocities, and what integrators make of it."""
        _check_step(state)
        segments = segments_of(state)
        answer = Answer(complete=not (live and state["compare"] and motion_view.is_long(segments, state)))
        motion_view.show(answer, segments, start_of(state), state, live=live)
        return answer

    def python(self, state: State) -> str:
        """A program with the same segments."""
        _check_step(state)
        return motion_copy.python(state, segments_of(state))

    def scenario(self, state: State) -> dict[str, Any]:
        """The same as a scenario file holds it."""
        return motion_copy.scenario(state, segments_of(state))


def start_of(state: State) -> Pose:
    """Where the motion starts."""
    return Pose(state["start_x"], state["start_y"], state["heading"])


def segments_of(state: State) -> list[Segment]:
    """The segments of a state, the one of the sliders first."""
    return [Segment(*(row[part] for part in PARTS), duration=row["duration"]) for row in (state, *state["then"])]


def _check_step(state: State) -> None:
    total = sum(segment.duration for segment in segments_of(state))
    if state["compare"] and total / state["step"] > MOST_STEPS:
        needed = f"at least {total / MOST_STEPS:.3g} s for {total:g} s: at most {MOST_STEPS} steps"
        raise InvalidValue("step", state["step"], needed)


def _with_end(state: State, to: list[float]) -> State:
    """The v and omega of the last segment with which it ends at a point, or as near as the sliders allow."""
    *before, last = segments_of(state)
    start = Program(before).end(start_of(state)) if before else start_of(state)

    def miss(x: np.ndarray) -> np.ndarray:
        driven = Segment(x[..., 0], x[..., 1], last.a, last.alpha, duration=last.duration)
        off: np.ndarray = driven.end(start).position - np.array(to)
        return off

    def slope(x: np.ndarray) -> np.ndarray:
        driven = Segment(x[..., 0], x[..., 1], last.a, last.alpha, duration=last.duration)
        return driven.jacobians(start)[1][..., :2, :2]

    bounds = [[getattr(slider, end) for slider in _sliders(group="")[:2]] for end in ("low", "high")]
    found = least_squares(
        miss, [last.v, last.omega], jacobian=slope, bounds=(bounds[0], bounds[1]), iterations=SEARCH
    ).x.tolist()
    changed = dict(zip(PARTS, found, strict=False))
    if before:
        return state | {"then": [*state["then"][:-1], state["then"][-1] | changed]}
    return state | changed | {"preset": "custom"}
