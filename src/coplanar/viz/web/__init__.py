"""The canvas renderer as the browser gets it: ES modules, a style sheet, and the palette of the figures.

A page that a server sends loads the modules as they are. A page that opens from disk, a notebook or an animation file
gets the same text inlined.
"""

from __future__ import annotations

import re
from importlib import resources

from coplanar.viz.style import DARK, LIGHT, Theme

_MODULES = ("view.js", "grid.js", "draw.js", "player.js")
_NAMES = ("first", "second", "third", "fourth", "fifth", "sixth")


def player_source() -> tuple[str, str]:
    """The player's JavaScript and style sheet, to inline in a page; it plays in every element ``.player``."""
    modules = "\n".join(_inlined(_text(name)) for name in _MODULES)
    return f'(() => {{\n"use strict";\n{modules}\nstartPlayers(document);\n}})();\n', palette_css() + _text(
        "player.css"
    )


def palette_css() -> str:
    """The themes as CSS custom properties: the system's choice, unless ``data-theme`` on the root says otherwise.

    Example:
        >>> "--surface: #12171f;" in palette_css()
        True
    """
    light, dark = _properties(LIGHT), _properties(DARK)
    return (
        f":root {{ color-scheme: light; {light} }}\n"
        f':root[data-theme="dark"] {{ color-scheme: dark; {dark} }}\n'
        "@media (prefers-color-scheme: dark) {\n"
        f'  :root:not([data-theme="light"]) {{ color-scheme: dark; {dark} }}\n'
        "}\n"
    )


def _properties(theme: Theme) -> str:
    plain = {name: getattr(theme, name) for name in ("surface", "ink", "muted", "grid")}
    return " ".join(
        f"--{name}: {colour};" for name, colour in (plain | dict(zip(_NAMES, theme.series, strict=True))).items()
    )


def _inlined(module: str) -> str:
    """A module's text without its imports and exports: all of them are in one scope."""
    return re.sub(r"^export ", "", re.sub(r"^import [^;]*;\n", "", module, flags=re.MULTILINE), flags=re.MULTILINE)


def _text(name: str) -> str:
    return (resources.files("coplanar.viz.web") / name).read_text("utf-8")
