"""A moving picture as data: layers of shapes in metres and their frames in time.

The canvas renderer ``player.js`` draws it; nothing here knows pixels or colours. A layer's ``role`` names its colour in
the page's palette: "reference", "trail", "link", "body", "target", "first" ... "sixth".
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike
from coplanar.errors import InvalidShape
from coplanar.viz.web import player_source as player_source


@dataclass(frozen=True, slots=True)
class Scene:
    """Frames at ``times`` [s] and the layers drawn at each; adding a layer returns a new scene.

    Attributes:
        times: Increasing, shape (frames,).
        layers: What has been added, bottom first.
        unit: The unit of both axes.

    Example:
        >>> scene = Scene([0.0, 1.0]).moving_point([(0, 0), (1, 2)], role="target")
        >>> scene.layers[0]["kind"], scene.bounds()
        ('point', (0.0, 1.0, 0.0, 2.0))
    """

    times: ArrayLike
    layers: tuple[dict[str, Any], ...] = field(default=())
    unit: str = "m"

    def __post_init__(self) -> None:
        times = checks.monotone("times", self.times)
        object.__setattr__(self, "times", checks.frozen(times))

    def curve(self, points: ArrayLike, *, role: str = "reference", dashed: bool = False, fill: bool = False) -> Scene:
        """A line that does not move, through points (n, 2) [m]."""
        return self._with("curve", role, points=_rounded("points", points, 2), dashed=dashed, fill=fill)

    def trail(self, points: ArrayLike, *, role: str = "trail") -> Scene:
        """A line that grows with time, one point per frame, shape (frames, 2) [m]."""
        return self._with("trail", role, points=self._framed("points", points, 2))

    def moving_point(self, points: ArrayLike, *, role: str = "target", size: float = 5.0) -> Scene:
        """A dot at one point per frame, shape (frames, 2) [m]; ``size`` is its radius in pixels."""
        return self._with("point", role, points=self._framed("points", points, 2), size=size)

    def linkage(self, joints: ArrayLike, *, role: str = "link") -> Scene:
        """Links between joints, shape (frames, joints, 2) [m]."""
        table = checks.vector("joints", joints, 2)
        return self._with("linkage", role, joints=self._framed("joints", table.reshape(len(table), -1), None))

    def body(self, poses: ArrayLike, outline: ArrayLike, *, role: str = "body") -> Scene:
        """A rigid outline (n, 2) [m] carried by poses (frames, 3) [m, m, rad]; headings are unwrapped here."""
        table = np.array(checks.vector("poses", poses, 3))
        table[:, 2] = np.unwrap(table[:, 2])
        return self._with(
            "body", role, poses=self._framed("poses", table, 3), outline=_rounded("outline", outline, 2)
        )  # fmt: skip

    def bounds(self) -> tuple[float, float, float, float]:
        """The smallest box around everything: xmin, xmax, ymin, ymax [m]."""
        corners = np.concatenate([_extent(layer) for layer in self.layers])
        low, high = corners.min(axis=0), corners.max(axis=0)
        return float(low[0]), float(high[0]), float(low[1]), float(high[1])

    def as_json(self) -> str:
        """The scene as the renderer reads it."""
        times = [float(f"{t:.6g}") for t in self.times]
        data = {"times": times, "bounds": self.bounds(), "unit": self.unit, "layers": self.layers}
        return json.dumps(data, separators=(",", ":"))

    def _with(self, kind: str, role: str, **content: Any) -> Scene:
        return replace(self, layers=(*self.layers, {"kind": kind, "role": role, **content}))

    def _framed(self, name: str, values: ArrayLike, width: int | None) -> list[list[float]]:
        if len(values) != len(self.times):
            raise InvalidShape(name, f"{len(values)} frames", f"{len(self.times)} frames, one per time")
        return _rounded(name, values, width)


def _rounded(name: str, values: ArrayLike, width: int | None) -> list[list[float]]:
    """Six significant digits: far below a pixel, and a third of the size."""
    table = checks.vector(name, values, width)
    return [[float(f"{v:.6g}") for v in row] for row in table.tolist()]


def _extent(layer: dict[str, Any]) -> np.ndarray:
    if layer["kind"] == "linkage":
        return np.asarray(layer["joints"]).reshape(-1, 2)
    if layer["kind"] == "body":
        reach = float(np.hypot(*np.asarray(layer["outline"]).T).max())
        centres = np.asarray(layer["poses"])[:, :2]
        return np.concatenate([centres - reach, centres + reach])
    return np.asarray(layer["points"])
