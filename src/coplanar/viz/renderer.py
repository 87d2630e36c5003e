"""Draws a ``Scene`` with Matplotlib, frame by frame, as the canvas player does: for animations that are files.

What does not move is drawn once; every frame starts from that picture and adds the rest.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.viz.layers import KINDS, Pen
from coplanar.viz.paper import dressed
from coplanar.viz.scene import Scene
from coplanar.viz.style import Theme

DPI = 100.0
PAD = 0.08  # of the larger extent: free room around a scene
MARGINS = (46.0, 14.0, 34.0, 14.0)  # left, right, bottom, top [pixels]

Moment = tuple[int, int, float]


class SceneRenderer:
    """A scene ready to be drawn at any time.

    Args:
        scene: What to draw.
        theme: In which colours.
        size: Width and height [pixels].

    Raises:
        UnknownName: If the scene has a kind of layer that is not known here.

    Example:
        >>> from coplanar.viz.style import LIGHT
        >>> scene = Scene([0.0, 1.0]).moving_point([(0, 0), (1, 1)])
        >>> SceneRenderer(scene, LIGHT, (320, 240)).frame(0.5).shape
        (240, 320, 3)
    """

    def __init__(self, scene: Scene, theme: Theme, size: tuple[int, int]) -> None:
        for layer in scene.layers:
            checks.choice("layer", layer["kind"], KINDS)
        self.times = np.asarray(scene.times, np.float64)
        self.canvas = _canvas(theme, size)
        self.ax, scale = _axes(self.canvas.figure, scene, theme, size)
        pen = Pen(self.ax, theme, scale, 72.0 / DPI)
        self.moving: list[tuple[list[Any], Callable[[Moment], None]]] = []
        for layer in scene.layers:
            artists, update = KINDS[layer["kind"]](pen, layer)
            update((0, 0, 0.0))
            for artist in artists:
                artist.set_zorder(10 + len(self.moving))
            if self.moving or _moves(layer):
                self.moving.append((artists, update))
        self.clock = self._clock(theme) if len(self.times) > 1 else None
        for artist in self._artists():
            artist.set_animated(True)
        self.canvas.draw()
        self.still = self.canvas.copy_from_bbox(self.canvas.figure.bbox)

    def frame(self, t: float) -> np.ndarray:
        """The picture at time t, clipped to the scene's times, shape (height, width, 3), one byte a colour."""
        at = self._moment(t)
        self.canvas.restore_region(self.still)
        for _, update in self.moving:
            update(at)
        if self.clock is not None:
            self.clock.set_text(f"{min(max(t, self.times[0]), self.times[-1]):.2f} s")
        for artist in self._artists():
            self.ax.draw_artist(artist)
        return np.array(self.canvas.buffer_rgba())[..., :3]

    def _artists(self) -> list[Any]:
        moving = [artist for artists, _ in self.moving for artist in artists]
        return moving if self.clock is None else [*moving, self.clock]

    def _moment(self, t: float) -> Moment:
        """The frames before and after a time, and the fraction of the way between them."""
        last = len(self.times) - 1
        if last < 1:
            return 0, 0, 0.0
        i = int(np.clip(np.searchsorted(self.times, t, side="right") - 1, 0, last - 1))
        part = (t - self.times[i]) / (self.times[i + 1] - self.times[i])
        return i, i + 1, float(np.clip(part, 0.0, 1.0))

    def _clock(self, theme: Theme) -> Any:
        return self.ax.text(
            0.995, 0.99, "", transform=self.ax.transAxes, ha="right", va="top", color=theme.muted, fontsize=8.5,
            family="monospace", zorder=1000,
        )  # fmt: skip


def _canvas(theme: Theme, size: tuple[int, int]) -> Any:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    return FigureCanvasAgg(Figure(figsize=(size[0] / DPI, size[1] / DPI), dpi=DPI, facecolor=theme.surface))


def _moves(layer: dict[str, Any]) -> bool:
    """Whether a layer has more than one frame."""
    framed = {"linkage": "joints", "body": "poses", "carried": "poses", "discs": "circles", "segments": "ends",
              "arrows": "vectors", "curve": "", "region": ""}  # fmt: skip
    name = framed.get(layer["kind"], "points")
    return bool(name) and len(layer[name]) > 1


def _axes(figure: Any, scene: Scene, theme: Theme, size: tuple[int, int]) -> tuple[Any, float]:
    """Axes at one scale for both directions, filling the picture, and that scale [pixels per unit]."""
    left, right, bottom, top = MARGINS
    width, height = size[0] - left - right, size[1] - bottom - top
    xmin, xmax, ymin, ymax = scene.bounds()
    pad = PAD * max(xmax - xmin, ymax - ymin, 1e-9)
    scale = min(width / (xmax - xmin + 2.0 * pad), height / (ymax - ymin + 2.0 * pad))
    ax = figure.add_axes((left / size[0], bottom / size[1], width / size[0], height / size[1]))
    half = 0.5 * width / scale, 0.5 * height / scale
    middle = 0.5 * (xmin + xmax), 0.5 * (ymin + ymax)
    ax.set(xlim=(middle[0] - half[0], middle[0] + half[0]), ylim=(middle[1] - half[1], middle[1] + half[1]))
    dressed(ax, theme)
    if scene.unit:
        ax.text(1.0, -26.0 / height, f"[{scene.unit}]", transform=ax.transAxes, ha="right", va="center",
                color=theme.muted, fontsize=8.5)  # fmt: skip
    ax.tick_params(labelsize=8, length=0)
    return ax, scale if math.isfinite(scale) else 1.0
