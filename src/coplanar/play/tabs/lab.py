"""Lab: Euler, RK2, RK4 and the exact motion drawn over one another; error against step, order, a step for 1 mm."""

from __future__ import annotations

import math
from typing import Any, ClassVar

from coplanar import checks
from coplanar.errors import InvalidValue
from coplanar.play.answer import Answer
from coplanar.play.controls import AnyControl, Choice, Slider, State, clipped
from coplanar.play.tabs import lab_copy, lab_view
from coplanar.play.tabs.problems import key_of, problem_of

MOST_STEPS = 500  # that are drawn
DRIVEN = ("arc", "clothoid", "cusp", "custom")
PRESETS = {
    "arc": {"v": 1.0, "omega": 1.0, "a": 0.0, "alpha": 0.0, "duration": 6.0},
    "clothoid": {"v": 1.0, "omega": -1.0, "a": 0.0, "alpha": 0.6, "duration": 5.0},
    "cusp": {"v": 1.2, "omega": 0.8, "a": -0.6, "alpha": 0.0, "duration": 4.0},
    "shot": {"duration": 2.5},
}


class LabTab:
    """Integrators side by side."""

    name: ClassVar[str] = "lab"
    title: ClassVar[str] = "Lab"
    about: ClassVar[str] = "The same motion by Euler, RK2, RK4 and exactly. What a step costs, and what it buys."
    controls: ClassVar[tuple[AnyControl, ...]] = (
        Choice("motion", "Motion", group="Motion", default="arc",
               options=(("arc", "circular arc"), ("clothoid", "clothoid"), ("cusp", "cusp"),
                        ("custom", "constant accelerations"), ("shot", "shot with drag"))),
        Slider("v", "v", group="Motion", unit="m/s", low=-2.0, high=2.0, step=0.01, default=1.0,
               only={"motion": DRIVEN}),
        Slider("omega", "omega", group="Motion", unit="rad/s", low=-3.0, high=3.0, step=0.01, default=1.0,
               only={"motion": DRIVEN}),
        Slider("a", "a", group="Motion", unit="m/s^2", low=-1.0, high=1.0, step=0.01, default=0.0,
               only={"motion": DRIVEN}),
        Slider("alpha", "alpha", group="Motion", unit="rad/s^2", low=-1.0, high=1.0, step=0.01, default=0.0,
               only={"motion": DRIVEN}),
        Slider("speed", "Launch speed", group="Motion", unit="m/s", low=1.0, high=60.0, step=0.1, default=25.0,
               only={"motion": ("shot",)}),
        Slider("angle", "Launch angle", group="Motion", unit="rad", low=-1.5, high=1.57, step=0.01, default=0.9,
               only={"motion": ("shot",)}),
        Slider("drag", "Drag C over mass", group="Motion", unit="1/m", low=0.0, high=0.5, step=0.001, default=0.03,
               only={"motion": ("shot",)}),
        Slider("duration", "Duration", group="Motion", unit="s", low=0.5, high=10.0, step=0.1, default=6.0),
        Slider("step", "Step h", group="Integrator", unit="s", low=0.005, high=2.0, step=0.005, default=0.5,
               scale="log"),
    )  # fmt: skip

    def settled(self, state: State, changed: str) -> State:
        """The sliders of a named motion; a slider that was moved makes it one's own."""
        if changed == "motion" and state["motion"] in PRESETS:
            return state | PRESETS[state["motion"]]
        if changed in ("v", "omega", "a", "alpha") and state["motion"] != "shot":
            return state | {"motion": "custom"}
        return state

    def moved(self, state: State, handle: str, to: list[float]) -> State:
        """The launch angle of a shot under the hand."""
        checks.choice("handle", handle, ("launch",) if state["motion"] == "shot" else ())
        return state | {"angle": clipped(self.controls, "angle", math.atan2(to[1], to[0]))}

    def show(self, state: State, *, live: bool) -> Answer:
        """The paths, their distances, the errors against the step."""
        answer = Answer()
        lab_view.show(answer, state, count_of(state), live=live)
        return answer

    def python(self, state: State) -> str:
        """A program with the same motion and steps."""
        return lab_copy.python(state, count_of(state), problem_of(key_of(state)))

    def scenario(self, state: State) -> dict[str, Any]:
        """The same as a scenario file holds it."""
        return lab_copy.scenario(state)


def count_of(state: State) -> int:
    """How many equal steps of at most the given one the motion takes.

    Raises:
        InvalidValue: If they are more than ``MOST_STEPS``.
    """
    count: int = math.ceil(state["duration"] / state["step"] - 1e-9)
    if count > MOST_STEPS:
        least = state["duration"] / MOST_STEPS
        needed = f"at least {least:.3g} s for {state['duration']:g} s: at most {MOST_STEPS} steps"
        raise InvalidValue("step", state["step"], needed)
    return count
