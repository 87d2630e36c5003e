"""The files of the page, read once: no path that comes over the wire ever reaches the disk."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import resources

from coplanar.viz.web import palette_css

_TYPES = {"html": "text/html", "css": "text/css", "js": "text/javascript", "svg": "image/svg+xml", "txt": "text/plain"}
_OWN = (
    "index.html", "page.css", "controls.css", "icon.svg", "theme.js", "app.js", "address.js", "charts.js",
    "connection.js", "controls.js", "copying.js", "desk.js", "elements.js", "framing.js", "handles.js", "ink.js",
    "legend.js", "pace.js", "readings.js", "shade.js", "stage.js", "tabs.js", "transport.js", "types.js", "widgets.js",
)  # fmt: skip
_SHARED = ("view.js", "grid.js", "draw.js", "player.js", "player.css")
_VENDORED = ("uPlot.esm.js", "uPlot.min.css", "uPlot.LICENSE.txt")


@dataclass(frozen=True, slots=True)
class File:
    """What is sent for one path."""

    content: bytes
    media_type: str


def files() -> dict[str, File]:
    """Every path that is answered, and with what.

    Example:
        >>> files()["/"].media_type
        'text/html'
    """
    play, web = resources.files("coplanar.play") / "static", resources.files("coplanar.viz") / "web"
    listed = {name: play / name for name in _OWN} | {name: web / name for name in _SHARED}
    listed |= {name: play / "vendor" / name for name in _VENDORED}
    found = {f"/{name}": File(path.read_bytes(), _type(name)) for name, path in listed.items()}
    found["/palette.css"] = File(palette_css().encode(), _TYPES["css"])
    found["/"] = found.pop("/index.html")
    return found


def _type(name: str) -> str:
    return _TYPES[name.rpartition(".")[2]]
