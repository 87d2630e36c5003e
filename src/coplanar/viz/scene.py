"""A moving picture as data: layers of shapes in metres and their frames in time.

The canvas renderer draws it; nothing here knows pixels or colours. A layer's ``role`` names its colour in the page's
palette: "reference", "trail", "link", "body", "target", "muted", "good", "warn", "no", "first" ... "sixth".

What a layer holds, beside ``kind`` and ``role``:

    opacity   0 to 1, for ghosts; 1 where it is absent. It multiplies whatever the kind does to its fill.
    dashed    true for a dashed stroke; absent otherwise.
    fill      true to tint the inside of what closes; absent otherwise.

A *framed* field is a list of rows, one for each of ``times``; or a single row, which holds for every frame. Between
two frames each number of a row is interpolated. Several shapes of one kind lie side by side in a row: four numbers for
each arrow, two for each point. The kinds are described by the methods of ``Scene`` that add them.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike
from coplanar.errors import InvalidShape
from coplanar.viz.web import player_source as player_source

DIGITS = 6  # of the largest number of a layer: far below a pixel


@dataclass(frozen=True, slots=True)
class Scene:
    """Frames at ``times`` [s] and the layers drawn at each; adding a layer returns a new scene.

    Attributes:
        times: Increasing, shape (frames,); a single time for a picture that does not move.
        layers: What has been added, bottom first.
        unit: The unit of both axes; empty for numbers without one.
        view: xmin, xmax, ymin, ymax of what is shown; around everything when None. A view that does not depend on what
            is dragged keeps the picture from jumping.

    Example:
        >>> scene = Scene([0.0, 1.0]).moving_point([(0, 0), (1, 2)], role="target")
        >>> scene.layers[0]["kind"], scene.bounds()
        ('point', (0.0, 1.0, 0.0, 2.0))
    """

    times: ArrayLike = (0.0,)
    layers: tuple[dict[str, Any], ...] = field(default=())
    unit: str = "m"
    view: tuple[float, float, float, float] | None = None

    def __post_init__(self) -> None:
        one = np.size(self.times) == 1
        times = checks.vector("times", self.times, 1) if one else checks.monotone("times", self.times)
        object.__setattr__(self, "times", checks.frozen(times))

    def curve(self, points: ArrayLike, *, role: str = "reference", **look: Any) -> Scene:
        """A line that does not move: ``points`` [[x, y], ...]; with ``fill`` its inside is tinted.

        Args:
            points: Shape (n, 2).
            role: Of its colour.
            **look: ``dashed``, ``fill``, ``opacity``.
        """
        return self._with("curve", role, look, points=_rounded(checks.vector("points", points, 2)))

    def region(self, rings: Sequence[ArrayLike], *, role: str = "reference", **look: Any) -> Scene:
        """A filled area with holes: ``rings`` [[[x, y], ...], ...], closed lines, filled by the even-odd rule.

        Args:
            rings: Arrays (n, 2).
            role: Of its colour, of fill and edge.
            **look: ``opacity``.
        """
        return self._with("region", role, look, rings=[_rounded(checks.vector("rings", r, 2)) for r in rings])

    def trail(self, points: ArrayLike, *, role: str = "trail", **look: Any) -> Scene:
        """A line that grows with time: ``points`` [[x, y], ...], exactly one for each frame."""
        if len(points) != len(self.times):
            raise InvalidShape("points", f"{len(points)} frames", f"{len(self.times)} frames, one per time")
        return self._with("trail", role, look, points=self._framed("points", points, 2))

    def moving_point(self, points: ArrayLike, *, role: str = "target", size: float = 5.0, **look: Any) -> Scene:
        """Dots: framed ``points``, rows [x, y, x, y, ...]; ``size`` is their radius in pixels."""
        return self._with("point", role, look, points=self._framed("points", points, 2), size=size)

    def cross(self, points: ArrayLike, *, role: str = "target", size: float = 6.0, **look: Any) -> Scene:
        """Upright-standing crosses (x): framed ``points``, rows [x, y, x, y, ...]; ``size``: half a width in pixels."""
        return self._with("cross", role, look, points=self._framed("points", points, 2), size=size)

    def discs(self, circles: ArrayLike, *, role: str = "body", **look: Any) -> Scene:
        """Circles in metres: framed ``circles``, rows [x, y, radius, ...]; stroked, with ``fill`` tinted."""
        return self._with("discs", role, look, circles=self._framed("circles", circles, 3))

    def outline(self, points: ArrayLike, *, role: str = "first", **look: Any) -> Scene:
        """A closed line that changes its shape (an ellipse, a sector): framed ``points``, rows [x, y, x, y, ...].

        Args:
            points: Shape (n, 2) for one shape, or (frames, n, 2).
            role: Of its colour.
            **look: ``dashed``, ``fill``, ``opacity``.
        """
        table = checks.vector("points", points, 2)
        rows = table.reshape(1, -1) if table.ndim == 2 else table.reshape(len(table), -1)
        return self._with("outline", role, look, points=self._framed("points", rows, 2))

    def segments(self, ends: ArrayLike, *, role: str = "muted", width: float = 1.8, **look: Any) -> Scene:
        """Straight pieces: framed ``ends``, rows [x0, y0, x1, y1, ...]; ``width`` is the stroke's in pixels."""
        return self._with("segments", role, look, ends=self._framed("ends", ends, 4), width=width)

    def arrows(self, vectors: ArrayLike, *, role: str = "first", crossed: bool = False, **look: Any) -> Scene:
        """Arrows: framed ``vectors``, rows [x, y, dx, dy, ...], tail and shaft in the axes' unit.

        ``crossed``: true where the arrow is struck out at its middle, a motion that cannot be made.
        """
        return self._with("arrows", role, look | {"crossed": crossed}, vectors=self._framed("vectors", vectors, 4))

    def text(
        self, words: str, points: ArrayLike, *, role: str = "ink", align: str = "center", shift: ArrayLike = (0, 0)
    ) -> Scene:
        """Words at a place: framed ``points``, rows [x, y]; ``text``, ``align`` and ``shift`` as in the arguments.

        Args:
            words: What is written, as text and never as markup.
            points: Shape (2,), or (frames, 2).
            role: Of its colour.
            align: "left", "center" or "right".
            shift: [right, down] in pixels.
        """
        at = self._framed("points", points, 2)
        return self._with("text", role, {}, points=at, text=words, align=align, shift=[float(s) for s in shift])

    def linkage(self, joints: ArrayLike, *, role: str = "link", **look: Any) -> Scene:
        """Links between joints: framed ``joints``, rows [x, y, x, y, ...], base first.

        Args:
            joints: Shape (joints, 2) for one posture, or (frames, joints, 2).
            role: Of its colour.
            **look: ``dashed``, ``opacity``.
        """
        table = checks.vector("joints", joints, 2)
        rows = table.reshape(1, -1) if table.ndim == 2 else table.reshape(len(table), -1)
        return self._with("linkage", role, look, joints=self._framed("joints", rows, 2))

    def body(self, poses: ArrayLike, outline: ArrayLike, *, role: str = "body", **look: Any) -> Scene:
        """A rigid ``outline`` [[x, y], ...] carried by framed ``poses``, rows [x, y, theta].

        The outline closes, is tinted and stroked, and a line shows the heading. Headings are unwrapped here.
        """
        table = np.atleast_2d(np.array(checks.vector("poses", poses, 3)))
        table[:, 2] = np.unwrap(table[:, 2])
        shape = _rounded(checks.vector("outline", outline, 2))
        return self._with("body", role, look, poses=self._framed("poses", table, 3), outline=shape)

    def carried(
        self, poses: ArrayLike, ends: ArrayLike, *, role: str = "ink", width: float = 3.0, **look: Any
    ) -> Scene:
        """Straight pieces fixed on a body (wheels): ``ends`` [x0, y0, x1, y1, ...] carried by framed ``poses``.

        Args:
            poses: Rows [x, y, theta].
            ends: Four numbers a piece, in the body's frame.
            role: Of their colour.
            width: Of the stroke, in pixels.
            **look: ``opacity``.
        """
        table = np.atleast_2d(np.array(checks.vector("poses", poses, 3)))
        table[:, 2] = np.unwrap(table[:, 2])
        flat = _rounded(np.reshape(checks.real("ends", ends), (1, -1)))[0]
        return self._with("carried", role, look, poses=self._framed("poses", table, 3), ends=flat, width=width)

    def bounds(self) -> tuple[float, float, float, float]:
        """The view; where there is none the smallest box around everything: xmin, xmax, ymin, ymax."""
        if self.view is not None:
            return self.view
        corners = np.concatenate([_extent(layer) for layer in self.layers])
        low, high = corners.min(axis=0), corners.max(axis=0)
        return float(low[0]), float(high[0]), float(low[1]), float(high[1])

    def as_mapping(self) -> dict[str, Any]:
        """What the renderer reads: ``times``, ``bounds``, ``unit`` and ``layers``."""
        times = [float(f"{t:.6g}") for t in self.times]
        bounds = [float(f"{b:.6g}") for b in self.bounds()]
        return {"times": times, "bounds": bounds, "unit": self.unit, "layers": self.layers}

    def as_json(self) -> str:
        """The mapping as text."""
        return json.dumps(self.as_mapping(), separators=(",", ":"), allow_nan=False)

    def _with(self, kind: str, role: str, look: dict[str, Any], **content: Any) -> Scene:
        shown = {name: value for name, value in look.items() if value is not False and value is not None}
        return replace(self, layers=(*self.layers, {"kind": kind, "role": role, **content, **shown}))

    def _framed(self, name: str, values: ArrayLike, width: int) -> list[list[float]]:
        """One row for each time, or one for all, of whole shapes of ``width`` numbers."""
        table = np.atleast_2d(checks.vector(name, values))
        if len(table) not in (1, len(self.times)):
            raise InvalidShape(name, f"{len(table)} frames", f"{len(self.times)} frames, one per time, or a single one")
        if table.shape[-1] % width:
            raise InvalidShape(name, f"shape {table.shape}", f"rows of {width} numbers for each shape")
        return _rounded(table)


def _rounded(table: ArrayLike) -> list[list[float]]:
    """The numbers to ``DIGITS`` digits of the largest: far below a pixel, and a third of the size."""
    values = np.asarray(table)
    largest = float(np.abs(values).max(initial=0.0))
    places = DIGITS - 1 - math.floor(math.log10(largest)) if largest > 1e-300 else 0
    rows: list[list[float]] = (np.round(values, min(places, 300)) + 0.0).tolist()
    return rows


def _extent(layer: dict[str, Any]) -> np.ndarray:
    """Corners of what a layer covers, shape (n, 2)."""
    if layer["kind"] in ("body", "carried"):
        shape = np.reshape(layer["outline" if layer["kind"] == "body" else "ends"], (-1, 2))
        reach = float(np.hypot(*shape.T).max())
        centres = np.asarray(layer["poses"])[:, :2]
        return np.concatenate([centres - reach, centres + reach])
    if layer["kind"] == "discs":
        discs = np.reshape(layer["circles"], (-1, 3))
        return np.concatenate([discs[:, :2] - discs[:, 2:], discs[:, :2] + discs[:, 2:]])
    if layer["kind"] == "arrows":
        ends = np.reshape(layer["vectors"], (-1, 4))
        return np.concatenate([ends[:, :2], ends[:, :2] + ends[:, 2:]])
    if layer["kind"] == "region":
        return np.concatenate([np.reshape(ring, (-1, 2)) for ring in layer["rings"]])
    name = {"linkage": "joints", "segments": "ends"}.get(layer["kind"], "points")
    return np.reshape(layer[name], (-1, 2))
