"""Shoot: drag the target; low and high arc, the envelope, and how short a shot falls."""

from __future__ import annotations

import math
from typing import Any, ClassVar

from coplanar import checks
from coplanar.flight import Aim, Projectile
from coplanar.play.answer import Answer
from coplanar.play.controls import AnyControl, Choice, Slider, State, Switch, clipped
from coplanar.play.tabs import shoot_copy, shoot_view

FORMS = (("speed", "the speed"), ("time", "the flight time"), ("angle", "the angle"), ("least", "nothing: least speed"))


class ShootTab:
    """A projectile with quadratic drag, and a target."""

    name: ClassVar[str] = "shoot"
    title: ClassVar[str] = "Shoot"
    about: ClassVar[str] = "Drag the target: both arcs that hit it, the limit of the reach, and how drag bends it."
    controls: ClassVar[tuple[AnyControl, ...]] = (
        Slider("mass", "Mass m", group="Projectile", unit="kg", low=0.01, high=10.0, step=0.01, default=1.0,
               scale="log"),
        Slider("drag", "Drag C", group="Projectile", unit="kg/m", low=0.0, high=0.5, step=0.001, default=0.01,
               help="The force is -C |v| v; 0 flies a parabola."),
        Slider("gravity", "Gravity g", group="Projectile", unit="m/s^2", low=0.5, high=25.0, step=0.01, default=9.81),
        Slider("target_x", "Target x", group="Target", unit="m", low=0.5, high=200.0, step=0.1, default=30.0),
        Slider("target_y", "Target y", group="Target", unit="m", low=-40.0, high=150.0, step=0.1, default=6.0),
        Choice("by", "Given", group="Launch", options=FORMS, default="speed"),
        Slider("speed", "Speed", group="Launch", unit="m/s", low=1.0, high=120.0, step=0.1, default=30.0,
               only={"by": ("speed",)}),
        Slider("time", "Flight time", group="Launch", unit="s", low=0.1, high=20.0, step=0.05, default=2.5,
               only={"by": ("time",)}),
        Slider("angle", "Angle", group="Launch", unit="rad", low=-1.5, high=1.57, step=0.005, default=0.9,
               only={"by": ("angle",)}),
        Switch("envelope", "Envelope", group="Show", default=True),
    )  # fmt: skip

    def settled(self, state: State, changed: str) -> State:
        """A number that was set by hand is the one that is given."""
        return state | {"by": changed} if changed in ("speed", "time", "angle") else state

    def moved(self, state: State, handle: str, to: list[float]) -> State:
        """The target, or the direction of the launch, under the hand."""
        checks.choice("handle", handle, ("target", "launch"))
        if handle == "launch":
            return state | {"by": "angle", "angle": clipped(self.controls, "angle", math.atan2(to[1], to[0]))}
        names = ("target_x", "target_y")
        return state | {name: clipped(self.controls, name, v) for name, v in zip(names, to, strict=True)}

    def show(self, state: State, *, live: bool) -> Answer:
        """The arcs and what is in the way."""
        answer = Answer()
        shoot_view.show(answer, aim_of(state), state, live=live)
        return answer

    def python(self, state: State) -> str:
        """A program with the same projectile and target."""
        return shoot_copy.python(state, aim_of(state))

    def scenario(self, state: State) -> dict[str, Any]:
        """The same as a scenario file holds it."""
        return shoot_copy.scenario(state)


def aim_of(state: State) -> Aim:
    """The launch through the target of a state."""
    projectile = Projectile(mass=state["mass"], drag=state["drag"], gravity=state["gravity"])
    given = {} if state["by"] == "least" else {state["by"]: state[state["by"]]}
    return projectile.aim((state["target_x"], state["target_y"]), **given)
