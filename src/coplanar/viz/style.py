"""One palette for everything that is drawn: figures, animations, pages; light and dark.

The series colours keep a contrast of at least 3 : 1 against their surface and a CIEDE2000 distance of at least 12 from
one another, for normal sight and without the long, the middle or the short cones.  [Machado 2009; CIE 142:2001]
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from coplanar import checks

ORDER = ("first", "second", "third", "fourth", "fifth", "sixth")
ROLES = {
    "link": "first", "body": "first", "trail": "second", "target": "fourth", "reference": "sixth",
    "good": "third", "warn": "second", "no": "fourth",
}  # fmt: skip


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

    def colour(self, name: Any) -> Any:
        """The colour of a role ("trail"), of a place ("first", "C0"), of a field ("ink"); others are Matplotlib's.

        Example:
            >>> LIGHT.colour("trail") == LIGHT.colour("second") == LIGHT.colour("C1") == LIGHT.series[1]
            True
        """
        if not isinstance(name, str):
            return name
        if name in ("surface", "ink", "muted", "grid"):
            return getattr(self, name)
        place = ROLES.get(name, name)
        if place in ORDER:
            return self.series[ORDER.index(place)]
        return self.series[int(name[1:]) % len(self.series)] if name[:1] == "C" and name[1:].isdigit() else name


LIGHT = Theme(
    "#ffffff", "#1c2430", "#5b6675", "#e3e7ed", ("#075cdd", "#cf5b11", "#077960", "#a93782", "#684b00", "#424a54")
)
DARK = Theme(
    "#12171f", "#e6ebf2", "#97a3b3", "#2a323e", ("#6ea6fe", "#ee9e67", "#45e0bb", "#e3599c", "#fed42f", "#aabacf")
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


def theme_set() -> Theme:
    """The theme whose colours Matplotlib's settings carry, as within ``drawn_in``; otherwise the light one."""
    import matplotlib as mpl

    colours = tuple(mpl.rcParams["axes.prop_cycle"].by_key().get("color", ()))
    return next((theme for theme in THEMES.values() if theme.series == colours), LIGHT)


def theme_on(ax: Any) -> Theme:
    """The theme that can be read on these axes: dark where they are darker than a middle grey."""
    from matplotlib.colors import to_rgba

    own, behind = to_rgba(ax.get_facecolor()), to_rgba(ax.figure.figure.get_facecolor())
    seen = [own[3] * a + (1.0 - own[3]) * (behind[3] * b + 1.0 - behind[3]) for a, b in zip(own, behind, strict=True)]
    return DARK if 0.2126 * seen[0] + 0.7152 * seen[1] + 0.0722 * seen[2] < 0.5 else LIGHT


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
