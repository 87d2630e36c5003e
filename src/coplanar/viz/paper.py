"""Axes with a theme, and the marks that every picture is made of.

Colours are set when a mark is made, not looked up when the figure is rendered, so that a figure keeps its appearance
outside of ``drawn_in``. Figures are Matplotlib's own ``Figure``: no window system is asked for, none is needed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar.checks import ArrayLike
from coplanar.viz.style import Theme, theme_on, theme_set

Axes = Any  # matplotlib.axes.Axes; Matplotlib is imported when something is drawn
LARGEST = 1e150  # of a number that is drawn: the ticks of larger ones overflow
FEW = 6  # members of a batch that are told apart by colour; more share one


@dataclass(frozen=True, slots=True)
class Paper:
    """What is drawn on, and in which colours.

    Attributes:
        ax: Matplotlib's axes.
        theme: Read from the axes' background.
    """

    ax: Axes
    theme: Theme

    @classmethod
    def on(cls, ax: Axes | None, *, xlabel: str = "", ylabel: str = "", title: str = "") -> Paper:
        """The given axes, or those of a new figure, with labels where any are given."""
        ax = panels(new_figure(), 1, 1)[0, 0] if ax is None else ax
        if xlabel:
            ax.set_xlabel(xlabel)
        if ylabel:
            ax.set_ylabel(ylabel)
        paper = cls(ax, theme_on(ax))
        if title:
            paper.title(title)
        return paper

    @classmethod
    def plane(cls, ax: Axes | None, title: str = "") -> Paper:
        """Axes of the plane: x and y in metres at the same scale."""
        paper = cls.on(ax, xlabel="x [m]", ylabel="y [m]", title=title)
        paper.ax.set_aspect("equal", adjustable="datalim")
        return paper

    def title(self, text: str) -> None:
        """The title, at the left."""
        self.ax.set_title(text, loc="left", fontsize=10, fontweight="bold", color=self.theme.ink)

    def next_colour(self) -> str:
        """The first colour of the series that no line has yet, and again from the start once all are taken."""
        from matplotlib.colors import same_color

        used = [sum(same_color(line.get_color(), colour) for line in self.ax.lines) for colour in self.theme.series]
        return self.theme.series[int(np.argmin(used))]

    def styled(self, options: dict[str, Any], colour: Any = None) -> dict[str, Any]:
        """Matplotlib's keywords of a line with the theme's colour, the given one or the next one free."""
        own = {"c": "color", "lw": "linewidth", "ls": "linestyle"}
        named = {own.get(k, k): v for k, v in options.items() if v is not None}
        style = {"linewidth": 1.8, "solid_capstyle": "round"} | named
        given = style.get("color", colour)
        style["color"] = self.next_colour() if given is None else self.theme.colour(given)
        return style

    def line(self, points: ArrayLike, colour: Any = None, **options: Any) -> Any:
        """A line through points (n, 2), as far as they can be drawn; the line's colour is returned."""
        xy = np.asarray(points, np.float64)
        xy = np.where(np.abs(xy) < LARGEST, xy, np.nan)
        style = self.styled(options, colour)
        self.ax.plot(xy[..., 0], xy[..., 1], **style)
        return style["color"]

    def lines(self, members: np.ndarray, colour: Any = None, **options: Any) -> list[Any]:
        """Lines (k, n, 2), one a member of a batch; a few are told apart by colour, many share one. Their colours."""
        if len(members) <= FEW:
            return [self.line(xy, colour, **options) for xy in members]
        from matplotlib.collections import LineCollection

        style = self.styled(options, colour)
        style.pop("solid_capstyle")
        bundle = LineCollection(list(members), alpha=style.pop("alpha", 0.45), capstyle="round", **style)
        self.ax.add_collection(bundle)
        self.ax.autoscale_view()
        return [style["color"]] * len(members)

    def dots(self, points: ArrayLike, colour: Any = "first", *, marker: str = "o", size: float = 5.0,
             hollow: bool = False, **options: Any) -> None:  # fmt: skip
        """Marks at points (..., 2)."""
        xy = np.asarray(points, np.float64).reshape(-1, 2)
        drawn = self.theme.colour(colour)
        fill = self.theme.surface if hollow else drawn
        style = {"markeredgewidth": 1.6, "zorder": 4, "linestyle": "none"} | options
        self.ax.plot(
            xy[:, 0], xy[:, 1], marker=marker, markersize=size, color=drawn, markerfacecolor=fill, **style
        )  # fmt: skip

    def cross(self, points: ArrayLike, colour: Any = "target", *, size: float = 9.0, **options: Any) -> None:
        """Crosses at points (..., 2), as targets are marked."""
        self.dots(points, colour, marker="x", size=size, **({"markeredgewidth": 2.2, "zorder": 5} | options))

    def region(self, *outlines: np.ndarray, colour: Any = "first", alpha: float = 0.12, edge: float = 0.0) -> None:
        """A region inside closed outlines (n, 2); an outline inside another that turns the other way is a hole."""
        from matplotlib.patches import PathPatch
        from matplotlib.path import Path

        shape = Path.make_compound_path(*(Path(np.vstack([o, o[:1]]), closed=True) for o in outlines))
        drawn = self.theme.colour(colour)
        self.ax.add_patch(PathPatch(shape, facecolor=drawn, edgecolor="none", alpha=alpha, zorder=1))
        if edge:
            self.ax.add_patch(PathPatch(shape, facecolor="none", edgecolor=drawn, linewidth=edge, zorder=2))
        self.ax.autoscale_view()

    def arrow(self, start: ArrayLike, end: ArrayLike, colour: Any = "ink", *, width: float = 1.8, head: float = 11.0,
              bend: float = 0.0, zorder: float = 4.0) -> None:  # fmt: skip
        """An arrow from one point to another; ``bend`` is the height of its arc over its length."""
        from matplotlib.patches import FancyArrowPatch

        points = np.array([start, end], np.float64)
        self.ax.add_patch(FancyArrowPatch(
            *map(tuple, points), arrowstyle="-|>", mutation_scale=head, linewidth=width, zorder=zorder, shrinkA=0,
            shrinkB=0, color=self.theme.colour(colour), connectionstyle=f"arc3,rad={bend}", joinstyle="miter",
        ))  # fmt: skip
        self.ax.update_datalim(points)
        self.ax.autoscale_view()

    def text(self, text: str, at: ArrayLike, colour: Any = "ink", *, offset: tuple[float, float] = (0.0, 0.0),
             size: float = 8.5, align: str = "center", **options: Any) -> None:  # fmt: skip
        """Words at a point, moved by ``offset`` in printer's points, with a halo that keeps them legible over lines."""
        from matplotlib.patheffects import withStroke

        halo = [withStroke(linewidth=2.6, foreground=self.theme.surface)]
        self.ax.annotate(
            text, tuple(np.asarray(at, np.float64)), xytext=offset, textcoords="offset points", ha=align, va="center",
            color=self.theme.colour(colour), fontsize=size, path_effects=halo, zorder=6, annotation_clip=False,
            **options,
        )  # fmt: skip

    def legend(self, **options: Any) -> None:
        """A legend of what has a label, each once, if anything has one, where it hides least."""
        handles = {label: handle for handle, label in zip(*self.ax.get_legend_handles_labels(), strict=True)}
        if handles:
            style = {"fontsize": 8.5, "frameon": True, "framealpha": 0.85, "edgecolor": "none", "loc": "best",
                     "facecolor": self.theme.surface, "labelcolor": self.theme.ink, "borderpad": 0.3}  # fmt: skip
            self.ax.legend(handles.values(), handles.keys(), **(style | options))


def new_figure(width: float = 6.4, height: float = 4.6) -> Any:
    """A figure [inches] in the theme that is set; it belongs to no window."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), facecolor=theme_set().surface, layout="constrained")


def dressed(ax: Axes, theme: Theme) -> Axes:
    """New axes in a theme: thin grid behind, two spines, quiet numbers."""
    ax.set_facecolor(theme.surface)
    ax.set_axisbelow(True)
    ax.grid(True, color=theme.grid, linewidth=0.8)
    ax.tick_params(colors=theme.muted, labelsize=8.5, width=0.8)
    for name, spine in ax.spines.items():
        spine.set(color=theme.grid, visible=name in ("left", "bottom"))
    for axis in (ax.xaxis, ax.yaxis):
        axis.label.set(color=theme.muted, fontsize=9.5)
    return ax


def panels(figure: Any, *shape: int, **options: Any) -> Any:
    """New axes on a figure, in the theme of the figure's background, shape (rows, columns)."""
    axes = figure.subplots(*shape, squeeze=False, **options)
    for ax in axes.flat:
        ax.set_facecolor(figure.get_facecolor())
        dressed(ax, theme_on(ax))
    return axes
