"""One palette for everything that is drawn: figures, animations, pages; light and dark.

The series colours stay apart for the colour-blind (they differ in lightness as well as in hue) and keep a contrast of
at least 3 : 1 against their surface.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from coplanar import checks


@dataclass(frozen=True, slots=True)
class Theme:
    """The colours of one appearance, as hex strings.

    Attributes:
        surface: What is drawn upon.
        ink: Text and outlines.
        muted: Axes, labels of lesser weight.
        grid: Grid lines.
        series: Colours of data, in the order in which they are taken.
    """

    surface: str
    ink: str
    muted: str
    grid: str
    series: tuple[str, ...]


LIGHT = Theme(
    "#ffffff", "#1c2430", "#5b6675", "#e3e7ed", ("#1f5fc4", "#c4520a", "#0b7a62", "#a1306f", "#7a5a00", "#4d5a6b")
)
DARK = Theme(
    "#12171f", "#e6ebf2", "#97a3b3", "#2a323e", ("#6fa8ff", "#ff9a57", "#3fcfae", "#f07fbd", "#e0bd4a", "#a9b6c8")
)
THEMES = {"light": LIGHT, "dark": DARK}


def theme_named(name: str) -> Theme:
    """The theme "light" or "dark".

    Raises:
        UnknownName: If it is neither.

    Example:
        >>> theme_named("light").surface
        '#ffffff'
    """
    return THEMES[checks.choice("theme", name, THEMES)]


def rc_params(theme: Theme) -> dict[Any, Any]:
    """Matplotlib's settings for a theme."""
    from cycler import cycler

    return {
        "figure.facecolor": theme.surface, "axes.facecolor": theme.surface, "savefig.facecolor": theme.surface,
        "text.color": theme.ink, "axes.labelcolor": theme.muted, "axes.edgecolor": theme.grid,
        "xtick.color": theme.muted, "ytick.color": theme.muted, "grid.color": theme.grid, "axes.grid": True,
        "axes.axisbelow": True, "axes.spines.top": False, "axes.spines.right": False, "axes.titlesize": 11,
        "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.labelsize": 9.5, "xtick.labelsize": 8.5,
        "ytick.labelsize": 8.5, "legend.fontsize": 8.5, "legend.frameon": False, "legend.labelcolor": theme.ink,
        "lines.linewidth": 1.8, "lines.solid_capstyle": "round", "font.size": 10, "svg.fonttype": "path",
        "svg.hashsalt": "coplanar", "axes.prop_cycle": cycler(color=theme.series),
        "figure.constrained_layout.use": True,
    }  # fmt: skip


@contextmanager
def drawn_in(name: str) -> Iterator[Theme]:
    """Figures made in this block have the named theme; Matplotlib's own settings come back afterwards."""
    import matplotlib as mpl

    theme = theme_named(name)
    with mpl.rc_context(rc_params(theme)):
        yield theme
