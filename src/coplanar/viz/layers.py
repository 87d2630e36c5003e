"""One way of drawing with Matplotlib for each kind of layer that a ``Scene`` has; see ``Scene`` for what they hold."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from coplanar.se2 import Pose
from coplanar.viz.regions import turned
from coplanar.viz.style import Theme

Layer = Mapping[str, Any]
Moment = tuple[int, int, float]
Drawn = tuple[list[Any], Callable[[Moment], None]]

TINT = 0.14  # of the inside of what is filled
BARB = 9.0  # length of an arrow's head [pixels]


class Pen(NamedTuple):
    """What a layer is drawn with.

    Attributes:
        ax: Matplotlib's axes.
        theme: The colours.
        scale: Pixels per unit of the axes.
        point: Printer's points per pixel.
    """

    ax: Any
    theme: Theme
    scale: float
    point: float

    def line(self, layer: Layer, width: float, *, dashed: bool = False) -> Any:
        """An empty line [pixels wide]."""
        (line,) = self.ax.plot([], [], **self.stroke(layer, width, dashed=dashed), solid_capstyle="round")
        return line

    def stroke(self, layer: Layer, width: float, *, dashed: bool = False) -> dict[str, Any]:
        """Matplotlib's keywords of a stroke."""
        return {
            "color": self.theme.colour(layer["role"]), "linewidth": width * self.point,
            "alpha": layer.get("opacity", 1.0), "linestyle": (0, (5.0 / width, 4.0 / width)) if dashed else "-",
        }  # fmt: skip

    def dots(self, layer: Layer, radius: float, *, marker: str = "o", hollow: bool = False) -> Any:
        """Empty marks [pixels]."""
        colour = self.theme.colour(layer["role"])
        (dots,) = self.ax.plot(
            [], [], marker, markersize=2.0 * radius * self.point, color=colour, alpha=layer.get("opacity", 1.0),
            markerfacecolor=self.theme.surface if hollow else colour, markeredgewidth=2.0 * self.point,
        )  # fmt: skip
        return dots

    def area(self, layer: Layer, share: float, width: float) -> tuple[list[Any], Callable[[list[np.ndarray]], None]]:
        """A closed shape: its tint, if share is above 0, and its edge; and what gives it its outlines."""
        from matplotlib.patches import PathPatch
        from matplotlib.path import Path

        colour, opacity = self.theme.colour(layer["role"]), layer.get("opacity", 1.0)
        dash = (0, (5.0 / width, 4.0 / width)) if layer.get("dashed") else "-"
        nothing = Path(np.zeros((1, 2)))
        tint = PathPatch(nothing, facecolor=colour, edgecolor="none", alpha=share * opacity)
        edge = PathPatch(nothing, facecolor="none", edgecolor=colour, linewidth=width * self.point, alpha=opacity,
                         linestyle=dash)  # fmt: skip
        patches = [tint, edge] if share > 0.0 else [edge]
        for patch in patches:
            self.ax.add_patch(patch)

        def shape(outlines: list[np.ndarray]) -> None:
            path = Path.make_compound_path(*(Path(np.vstack([o, o[:1]]), closed=True) for o in outlines))
            for patch in patches:
                patch.set_path(path)

        return patches, shape


def _row(values: Any) -> Callable[[Moment], np.ndarray]:
    """The row of a framed field at a moment; a single row holds for all of them."""
    table = np.asarray(values, np.float64)

    def at(moment: Moment) -> np.ndarray:
        if len(table) == 1:
            return np.asarray(table[0])
        before, after, part = moment
        return np.asarray((1.0 - part) * table[before] + part * table[after])

    return at


def _curve(pen: Pen, layer: Layer) -> Drawn:
    points = np.asarray(layer["points"], np.float64)
    line = pen.line(layer, 1.5, dashed=bool(layer.get("dashed")))
    line.set_data(*points.T)
    if not layer.get("fill"):
        return [line], _still
    patches, shape = pen.area(layer, TINT, 1e-3)
    shape([points])
    return [*patches, line], _still


def _region(pen: Pen, layer: Layer) -> Drawn:
    """Rings by the even-odd rule: a ring inside an odd number of others turns the other way."""
    patches, shape = pen.area(layer, 0.08, 1.2)
    shape(turned([np.asarray(ring, np.float64) for ring in layer["rings"]]))
    return patches, _still


def _trail(pen: Pen, layer: Layer) -> Drawn:
    points, row, line = np.asarray(layer["points"], np.float64), _row(layer["points"]), pen.line(layer, 2.2)

    def update(at: Moment) -> None:
        line.set_data(*np.vstack([points[: at[0] + 1], row(at)]).T)

    return [line], update


def _point(pen: Pen, layer: Layer) -> Drawn:
    return _marks(pen.dots(layer, layer.get("size", 5.0)), layer)


def _cross(pen: Pen, layer: Layer) -> Drawn:
    return _marks(pen.dots(layer, layer.get("size", 6.0), marker="x"), layer)


def _marks(dots: Any, layer: Layer) -> Drawn:
    row = _row(layer["points"])

    def update(at: Moment) -> None:
        dots.set_data(*row(at).reshape(-1, 2).T)

    return [dots], update


def _discs(pen: Pen, layer: Layer) -> Drawn:
    row, (patches, shape) = _row(layer["circles"]), pen.area(layer, TINT if layer.get("fill") else 0.0, 1.5)
    turn = np.linspace(0.0, 2.0 * np.pi, 61)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])

    def update(at: Moment) -> None:
        shape([disc[:2] + max(disc[2], 0.0) * circle for disc in row(at).reshape(-1, 3)])

    return patches, update


def _outline(pen: Pen, layer: Layer) -> Drawn:
    row, (patches, shape) = _row(layer["points"]), pen.area(layer, TINT if layer.get("fill") else 0.0, 1.6)

    def update(at: Moment) -> None:
        shape([row(at).reshape(-1, 2)])

    return patches, update


def _pieces(pen: Pen, layer: Layer, width: float) -> tuple[Any, Callable[[np.ndarray], None]]:
    """Straight pieces in one artist, and what sets their ends (n, 2, 2)."""
    from matplotlib.collections import LineCollection

    style = pen.stroke(layer, width, dashed=bool(layer.get("dashed")))
    bundle: Any = LineCollection([], capstyle="round", **style)
    pen.ax.add_collection(bundle, autolim=False)
    return bundle, bundle.set_segments


def _segments(pen: Pen, layer: Layer) -> Drawn:
    row, (bundle, put) = _row(layer["ends"]), _pieces(pen, layer, layer.get("width", 1.8))

    def update(at: Moment) -> None:
        put(row(at).reshape(-1, 2, 2))

    return [bundle], update


def _arrows(pen: Pen, layer: Layer) -> Drawn:
    row, (shafts, put) = _row(layer["vectors"]), _pieces(pen, layer, 2.0)
    heads, put_heads = _pieces(pen, {**layer, "dashed": False}, 2.0)
    marks = [pen.dots(layer, 7.0, marker="x")] if layer.get("crossed") else []

    def update(at: Moment) -> None:
        tails, ways = row(at).reshape(-1, 2, 2).transpose(1, 0, 2)
        put(np.stack([tails, tails + ways], axis=1))
        put_heads(_barbs(tails + ways, ways, pen.scale))
        for mark in marks:
            mark.set_data(*(tails + 0.5 * ways).T)

    return [shafts, heads, *marks], update


def _barbs(tips: np.ndarray, ways: np.ndarray, scale: float) -> np.ndarray:
    """Both strokes of every arrow's head, shape (2 n, 2, 2)."""
    lengths = np.hypot(*ways.T)
    size = np.minimum(BARB / scale, 0.6 * lengths) / np.where(lengths > 0.0, lengths, 1.0)
    across = 0.5 * np.column_stack([ways[:, 1], -ways[:, 0]])
    ends = [tips - size[:, None] * (ways + sign * across) for sign in (1.0, -1.0)]
    return np.concatenate([np.stack([end, tips], axis=1) for end in ends])


def _text(pen: Pen, layer: Layer) -> Drawn:
    from matplotlib.patheffects import withStroke

    right, down = layer.get("shift", (0.0, 0.0))
    words = pen.ax.annotate(
        layer["text"].replace("$", r"\$"), (0.0, 0.0), xytext=(right * pen.point, -down * pen.point),
        textcoords="offset points", ha=layer.get("align", "center"), va="center", fontsize=12.0 * pen.point,
        color=pen.theme.colour(layer["role"]), alpha=layer.get("opacity", 1.0), annotation_clip=False,
        path_effects=[withStroke(linewidth=4.0 * pen.point, foreground=pen.theme.surface)],
    )  # fmt: skip
    row = _row(layer["points"])

    def update(at: Moment) -> None:
        words.xy = tuple(row(at))

    return [words], update


def _linkage(pen: Pen, layer: Layer) -> Drawn:
    row, dashed = _row(layer["joints"]), bool(layer.get("dashed"))
    line, dots = pen.line(layer, 2.0 if dashed else 7.0, dashed=dashed), pen.dots(layer, 4.5, hollow=True)

    def update(at: Moment) -> None:
        joints = row(at).reshape(-1, 2).T
        line.set_data(*joints)
        dots.set_data(*joints)

    return [line, dots], update


def _body(pen: Pen, layer: Layer) -> Drawn:
    row, outline = _row(layer["poses"]), np.asarray(layer["outline"], np.float64)
    (patches, shape), line = pen.area(layer, 0.22, 1.8), pen.line(layer, 1.8)
    nose = np.array([(0.0, 0.0), (float(outline[:, 0].max()), 0.0)])

    def update(at: Moment) -> None:
        pose = Pose(*row(at))
        shape([pose @ outline])
        line.set_data(*(pose @ nose).T)

    return [*patches, line], update


def _carried(pen: Pen, layer: Layer) -> Drawn:
    row, ends = _row(layer["poses"]), np.reshape(np.asarray(layer["ends"], np.float64), (-1, 2, 2))
    bundle, put = _pieces(pen, layer, layer.get("width", 3.0))

    def update(at: Moment) -> None:
        put(Pose(*row(at)) @ ends)

    return [bundle], update


def _still(_: Moment) -> None:
    """What does not move."""


KINDS: Mapping[str, Callable[[Pen, Layer], Drawn]] = MappingProxyType(
    {
        "curve": _curve, "region": _region, "trail": _trail, "point": _point, "cross": _cross, "discs": _discs,
        "outline": _outline, "segments": _segments, "arrows": _arrows, "text": _text, "linkage": _linkage,
        "body": _body, "carried": _carried,
    }
)  # fmt: skip
