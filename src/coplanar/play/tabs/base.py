"""Base: place and turn wheels; see what they can do, what they cannot, and drive it."""

from __future__ import annotations

import math
from typing import Any, ClassVar

from coplanar import checks
from coplanar.play.answer import Answer
from coplanar.play.controls import AnyControl, Choice, Rows, Slider, State, clipped
from coplanar.play.kept import Kept
from coplanar.play.tabs import base_copy, base_view
from coplanar.se2 import Twist, wrap_angle
from coplanar.wheels import Wheel, WheeledBase

LAYOUTS = (
    ("differential", "differential"),
    ("omni3", "three omni wheels"),
    ("omni4", "four omni wheels"),
    ("mecanum", "mecanum"),
    ("swerve", "swerve: four steered wheels"),
    ("custom", "my own wheels"),
)
CORNERS = ((1, 1), (1, -1), (-1, 1), (-1, -1))
FIELDS = (
    Slider("x", "x", unit="m", low=-0.8, high=0.8, step=0.01, default=0.0),
    Slider("y", "y", unit="m", low=-0.8, high=0.8, step=0.01, default=0.0),
    Slider("drive_angle", "Drive angle", unit="rad", low=-3.15, high=3.15, step=0.01, default=0.0),
    Slider("radius", "Radius", unit="m", low=0.02, high=0.3, step=0.005, default=0.1),
    Choice("kind", "Kind", options=(("ordinary", "ordinary"), ("rollers", "with rollers")), default="ordinary"),
    Slider("roller_angle", "Roller angle", unit="rad", low=-1.5, high=1.5, step=0.01, default=0.0,
           only={"kind": ("rollers",)}, help="0 is a plain omni wheel, +-0.785 mecanum."),
)  # fmt: skip
PAIR = [
    {"x": 0.0, "y": y, "drive_angle": 0.0, "radius": 0.1, "kind": "ordinary", "roller_angle": 0.0} for y in (0.3, -0.3)
]


class BaseTab:
    """A body on up to eight wheels."""

    name: ClassVar[str] = "base"
    title: ClassVar[str] = "Base"
    about: ClassVar[str] = "Place and turn wheels. Rank, what the base cannot do, and the rates that drive it."
    controls: ClassVar[tuple[AnyControl, ...]] = (
        Choice("layout", "Layout", group="Wheels", options=LAYOUTS, default="differential"),
        Slider("half_length", "Half length", group="Wheels", unit="m", low=0.05, high=0.8, step=0.01, default=0.3,
               only={"layout": ("mecanum", "swerve")}),
        Slider("half_width", "Half width (half track)", group="Wheels", unit="m", low=0.05, high=0.8, step=0.01,
               default=0.3, only={"layout": ("differential", "mecanum", "swerve")}),
        Slider("distance", "Distance of the wheels", group="Wheels", unit="m", low=0.05, high=0.8, step=0.01,
               default=0.35, only={"layout": ("omni3", "omni4")}),
        Slider("radius", "Wheel radius", group="Wheels", unit="m", low=0.02, high=0.3, step=0.005, default=0.1,
               only={"layout": ("differential", "omni3", "omni4", "mecanum", "swerve")}),
        Choice("rollers", "Rollers from above", group="Wheels", options=(("X", "X (right)"), ("O", "O (wrong)")),
               default="X", only={"layout": ("mecanum",)}),
        Rows("wheels", "Wheels", group="Wheels", fields=FIELDS, default=PAIR, most=8, row="wheel",
             help="Drag a wheel or its drive direction, or edit the table: it becomes your own layout."),
        Slider("vx", "Forward vx", group="Motion", unit="m/s", low=-1.5, high=1.5, step=0.01, default=0.6),
        Slider("vy", "Leftward vy", group="Motion", unit="m/s", low=-1.5, high=1.5, step=0.01, default=0.2),
        Slider("omega", "Turn rate omega", group="Motion", unit="rad/s", low=-3.0, high=3.0, step=0.01, default=0.5),
        Slider("duration", "Duration", group="Motion", unit="s", low=0.5, high=12.0, step=0.5, default=5.0),
        Slider("slipping", "Wheel that slips", group="Slip", low=1.0, high=8.0, step=1.0, default=1.0),
        Slider("slip", "Its error", group="Slip", unit="rad/s", low=-5.0, high=5.0, step=0.05, default=0.0,
               help="Added to the measured rate of that wheel; the others tell."),
        Slider("noise", "Noise of the rates", group="Slip", unit="rad/s", low=0.01, high=1.0, step=0.01, default=0.1),
    )  # fmt: skip

    def settled(self, state: State, changed: str) -> State:
        """The table of wheels of a named layout; a table that was edited is a layout of one's own."""
        if changed == "wheels":
            state = state | {"layout": "custom"}
        if state["layout"] != "custom":
            state = state | {"wheels": [_row(wheel) for wheel in base_of(state).wheels]}
        return state

    def moved(self, state: State, handle: str, to: list[float]) -> State:
        """A wheel, its drive direction or the wanted velocity under the hand."""
        state = self.settled(state, "")
        count = len(state["wheels"])
        names = [f"{part}_{i}" for i in range(1, count + 1) for part in ("wheel", "turn")]
        checks.choice("handle", handle, ("velocity", *names))
        if handle == "velocity":
            parts = zip(("vx", "vy"), to, strict=True)
            return state | {name: clipped(self.controls, name, v / base_view.SHAFT) for name, v in parts}
        part, number = handle.split("_")
        wheels = [dict(row) for row in state["wheels"]]
        row = wheels[int(number) - 1]
        if part == "wheel":
            row |= {name: clipped(FIELDS, name, v) for name, v in zip(("x", "y"), to, strict=True)}
        else:
            row["drive_angle"] = math.atan2(to[1] - row["y"], to[0] - row["x"])
        return state | {"layout": "custom", "wheels": wheels}

    def show(self, state: State, *, live: bool) -> Answer:
        """The base from above, and driven."""
        answer = Answer()
        base = base_of(state)
        base_view.show(answer, base, twist_of(state), state, live=live)
        return answer

    def python(self, state: State) -> str:
        """A program with the same base and motion."""
        return base_copy.python(state, base_of(state))

    def scenario(self, state: State) -> dict[str, Any]:
        """The same as a scenario file holds it."""
        return base_copy.scenario(state, base_of(state))


def twist_of(state: State) -> Twist:
    """The wanted motion."""
    return Twist(state["vx"], state["vy"], state["omega"])


def base_of(state: State) -> WheeledBase:
    """The base of a state; kept, because an answer asks for the same one several times."""
    sizes = tuple(state[key] for key in ("half_length", "half_width", "distance", "radius", "rollers"))
    motion = tuple(state[key] for key in ("vx", "vy", "omega")) if state["layout"] == "swerve" else ()
    table = tuple(tuple(row.items()) for row in state["wheels"]) if state["layout"] == "custom" else ()
    return _bases((state["layout"], sizes, motion, table))


def _made(key: tuple[Any, ...]) -> WheeledBase:
    layout, sizes, motion, table = key
    if layout == "custom":
        return WheeledBase(tuple(_wheel(dict(row)) for row in table))
    length, width, distance, radius, rollers = sizes
    if layout == "differential":
        return WheeledBase.differential(half_track=width, radius=radius)
    if layout in ("omni3", "omni4"):
        return WheeledBase.omni(int(layout[-1]), wheel_distance=distance, radius=radius)
    if layout == "mecanum":
        return WheeledBase.mecanum(radius=radius, rollers=rollers, half_length=length, half_width=width)
    return _swerve(length, width, radius, Twist(*motion))


_bases = Kept(_made, most=64)


def _swerve(length: float, width: float, radius: float, twist: Twist) -> WheeledBase:
    """Ordinary wheels at the corners, each steered along its own velocity; straight ahead where it stands."""
    corners = [(front * length, left * width) for front, left in CORNERS]
    straight = WheeledBase(tuple(Wheel(x, y, 0.0, radius) for x, y in corners))
    ways = straight.wheel_velocities(twist).tolist()
    return WheeledBase(
        tuple(Wheel(x, y, math.atan2(vy, vx), radius) for (x, y), (vx, vy) in zip(corners, ways, strict=True))
    )


def _wheel(row: State) -> Wheel:
    roller = row["roller_angle"] if row["kind"] == "rollers" else None
    return Wheel(row["x"], row["y"], row["drive_angle"], row["radius"], roller)


def _row(wheel: Wheel) -> dict[str, Any]:
    return {
        "x": wheel.x, "y": wheel.y, "drive_angle": wrap_angle(wheel.drive_angle), "radius": wheel.radius,
        "kind": "ordinary" if wheel.is_ordinary else "rollers", "roller_angle": wheel.roller_angle or 0.0,
    }  # fmt: skip
