"""Curves that a tab can follow: the named ones, and the line drawn by hand."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from coplanar.curves import Astroid, Circle, Curve, Ellipse, Lemniscate, Line, Spline
from coplanar.play import copying
from coplanar.play.controls import Choice, Slider, State, Stroke
from coplanar.se2 import Pose

NAMES = (
    ("circle", "circle"),
    ("ellipse", "ellipse"),
    ("lemniscate", "lemniscate"),
    ("astroid", "astroid"),
    ("line", "line"),
    ("stroke", "drawn by hand"),
)
FEWEST = 4  # points of a stroke that make a curve


def controls(
    first: Sequence[tuple[str, str]] = (), *, default: str, size: float, at: tuple[float, float] = (0.0, 0.0)
) -> tuple[Choice | Slider | Stroke, ...]:
    """Choice of the curve, its size, place and tilt, and the stroke."""
    named = {"curve": ("circle", "ellipse", "lemniscate", "astroid", "line")}
    return (
        Choice("curve", "Curve", group="Curve", options=(*first, *NAMES), default=default),
        Slider("size", "Size", group="Curve", unit="m", low=0.05, high=5.0, step=0.05, default=size, only=named,
               help="Radius, half length, or distance of the cusps from the centre."),
        Slider("curve_x", "Centre x", group="Curve", unit="m", low=-6.0, high=6.0, step=0.05, default=at[0],
               only=named),
        Slider("curve_y", "Centre y", group="Curve", unit="m", low=-6.0, high=6.0, step=0.05, default=at[1],
               only=named),
        Slider("tilt", "Tilt", group="Curve", unit="rad", low=-3.15, high=3.15, step=0.01, default=0.0,
               only={"curve": ("ellipse", "lemniscate", "astroid", "line")}),
        Stroke("stroke", "Draw", group="Curve", only={"curve": ("stroke",)},
               help="Draw on the picture with mouse, finger or pen; a smooth curve through the points is followed. "
                    "By keys: the arrows move the pen, further with Shift; Space or Enter puts it down and lifts it."),
    )  # fmt: skip


def curve_of(state: State) -> Curve | None:
    """The chosen curve; None for none, and for a stroke that is too short to be one."""
    if state["curve"] == "stroke":
        points = _thinned(state["stroke"])
        return Spline(points) if len(points) >= FEWEST else None
    size, centre, tilt = state["size"], (state["curve_x"], state["curve_y"]), state["tilt"]
    kinds: dict[str, Callable[[], Curve]] = {
        "circle": lambda: Circle(size, center=centre),
        "ellipse": lambda: Ellipse(size, 0.5 * size, center=centre, tilt=tilt),
        "lemniscate": lambda: Lemniscate(size, center=centre, tilt=tilt),
        "astroid": lambda: Astroid(size, center=centre, tilt=tilt),
        "line": lambda: Line(*_ends(state)),
    }
    return kinds[state["curve"]]() if state["curve"] in kinds else None


def code_of(state: State) -> str:
    """The curve as an expression; its classes come from ``coplanar``."""
    size, tilt = copying.number(state["size"]), copying.number(state["tilt"])
    centre = copying.numbers((state["curve_x"], state["curve_y"]))
    if state["curve"] == "stroke":
        return f"coplanar.Spline({copying.points(_thinned(state['stroke']))})"
    if state["curve"] == "line":
        start, end = (copying.numbers(end) for end in _ends(state))
        return f"coplanar.Line({start}, {end})"
    if state["curve"] == "circle":
        return f"coplanar.Circle({size}, center={centre})"
    if state["curve"] == "ellipse":
        return f"coplanar.Ellipse({size}, {copying.number(0.5 * state['size'])}, center={centre}, tilt={tilt})"
    return f"coplanar.{state['curve'].capitalize()}({size}, center={centre}, tilt={tilt})"


def data_of(state: State) -> dict[str, Any]:
    """The curve as a scenario file holds it; a point that rests where there is none."""
    name, centre = state["curve"], [state["curve_x"], state["curve_y"]]
    if curve_of(state) is None:
        return {"type": "point", "point": centre}
    if name == "stroke":
        return {"type": "spline", "points": _thinned(state["stroke"])}
    if name == "line":
        start, end = _ends(state)
        return {"type": "line", "start": start, "end": end}
    sizes: dict[str, Any] = {"radius": state["size"]} if name == "circle" else {"a": state["size"]}
    if name == "ellipse":
        sizes["b"] = 0.5 * state["size"]
    tilt = {} if name == "circle" else {"tilt": state["tilt"]}
    return {"type": name, **sizes, "center": centre, **tilt}


def _ends(state: State) -> list[list[float]]:
    """The ends of a line of the size to both sides of its centre."""
    middle = Pose(state["curve_x"], state["curve_y"], state["tilt"])
    ends: list[list[float]] = (middle @ np.array([(-state["size"], 0.0), (state["size"], 0.0)])).tolist()
    return ends


def _thinned(stroke: list[list[float]]) -> list[list[float]]:
    """Every other point of a long stroke, and its last: a hand trembles from pixel to pixel."""
    stride = max(1, len(stroke) // 60)
    return [*stroke[:-1:stride], stroke[-1]] if stroke else []
