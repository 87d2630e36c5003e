"""The Base tab as a program and as a scenario."""

from __future__ import annotations

from typing import Any

from coplanar.play import copying
from coplanar.play.controls import State
from coplanar.wheels import Wheel, WheeledBase

SHOWN = (
    ("rank", "base.rank"),
    ("control", "base.degrees_of_control"),
    ("configuration", "base.degrees_of_configuration"),
    ("driven_vx", "possible.twist.vx"),
    ("driven_vy", "possible.twist.vy"),
    ("driven_omega", "possible.twist.omega"),
    ("gap", "possible.gap"),
    ("end_x", "end.x"),
    ("end_y", "end.y"),
    ("end_theta", "end.theta"),
)


def python(state: State, base: WheeledBase) -> str:
    """A program with the same base and motion."""
    wanted = copying.numbers((state["vx"], state["vy"], state["omega"]))
    lines = [
        *_base(state, base),
        f"possible = base.feasible(coplanar.Twist{wanted})",
        "rates = base.inverse(possible.twist)",
        f"end = coplanar.Pose.exp(possible.twist.during({copying.number(state['duration'])}))",
        "for finding in base.diagnose():",
        "    print(finding)",
        "print(possible.status.value)",
    ]
    rates = [(f"rate{i + 1}", f"rates[{i}]") for i in range(len(base.wheels))]
    slip = [("slip_statistic", "base.slip(measured, noise).statistic")]
    number = round(state["slipping"])
    lines += ["measured = rates.copy()"]
    lines += [f"measured[{number - 1}] += {copying.number(state['slip'])}"] if number <= len(base.wheels) else []
    lines += [f"noise = {copying.number(state['noise'])}"]
    return copying.program(["import coplanar"], lines, (*SHOWN, *rates, *slip))


def _base(state: State, base: WheeledBase) -> list[str]:
    n = {key: copying.number(state[key]) for key in ("half_length", "half_width", "distance", "radius")}
    layout = state["layout"]
    if layout == "differential":
        return [f"base = coplanar.WheeledBase.differential(half_track={n['half_width']}, radius={n['radius']})"]
    if layout in ("omni3", "omni4"):
        sizes = f"wheel_distance={n['distance']}, radius={n['radius']}"
        return [f"base = coplanar.WheeledBase.omni({int(layout[-1])}, {sizes})"]
    if layout == "mecanum":
        sizes = f"half_length={n['half_length']}, half_width={n['half_width']}, radius={n['radius']}"
        return [f'base = coplanar.WheeledBase.mecanum({sizes}, rollers="{state["rollers"]}")']
    return ["base = coplanar.WheeledBase((", *(f"    {_wheel(wheel)}," for wheel in base.wheels), "))"]


def _wheel(wheel: Wheel) -> str:
    placed = copying.numbers((wheel.x, wheel.y, wheel.drive_angle, wheel.radius))[1:-1]
    roller = "" if wheel.roller_angle is None else f", {copying.number(wheel.roller_angle)}"
    return f"coplanar.Wheel({placed}{roller})"


def scenario(state: State, base: WheeledBase) -> dict[str, Any]:
    """The same as a scenario."""
    twist = {key: state[key] for key in ("vx", "vy", "omega")}
    return {"type": "wheels", "base": _layout(state, base), "twist": twist, "duration": state["duration"]}


def _layout(state: State, base: WheeledBase) -> dict[str, Any]:
    layout, radius = state["layout"], {"radius": state["radius"]}
    if layout == "differential":
        return {"type": layout, "half_track": state["half_width"]} | radius
    if layout in ("omni3", "omni4"):
        return {"type": "omni", "count": int(layout[-1]), "wheel_distance": state["distance"]} | radius
    if layout == "mecanum":
        return {"type": layout} | {key: state[key] for key in ("half_length", "half_width", "rollers")} | radius
    keys = ("x", "y", "drive_angle", "radius", "roller_angle")
    rows = [{key: getattr(wheel, key) for key in keys if getattr(wheel, key) is not None} for wheel in base.wheels]
    return {"type": "wheels", "wheels": rows}
