"""A scene as one HTML page that plays it: opens from disk, fetches nothing, and nothing in it can be fetched."""

from __future__ import annotations

import base64
import hashlib
import html
from dataclasses import dataclass
from string import Template

from coplanar import checks
from coplanar.viz.scene import Scene
from coplanar.viz.style import THEMES
from coplanar.viz.web import player_source

PAGE = Template("""<!doctype html>
<html lang="en"$theme>
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; base-uri 'none'; form-action 'none'; \
script-src $script_hash; style-src $style_hash">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>$style</style>
</head>
<body>
<main>
<div class="player">
  <canvas tabindex="0" role="img" aria-label="Animation of $title; space plays, arrow keys step"></canvas>
  <div class="controls">
    <button type="button">Play</button>
    <input type="range" min="0" max="1000" value="0" aria-label="Time in $title">
    <output>0.00 s</output>
    <select aria-label="Speed"><option value="0.25">&frac14;&times;</option><option value="1" selected>1&times;</option>
      <option value="4">4&times;</option></select>
  </div>
  <script type="application/json">$scene</script>
</div>
</main>
<script>$script</script>
</body>
</html>
""")

STYLE = """
* { box-sizing: border-box; }
body { margin: 0; background: var(--surface); color: var(--ink); font: 15px/1.5 system-ui, -apple-system, "Segoe UI", sans-serif; }
main { max-width: calc((100vh - 4.5rem) * 4 / 3); min-width: 18rem; margin: 0 auto; padding: .75rem; }
"""  # noqa: E501


@dataclass(frozen=True, slots=True)
class Player:
    """A scene that shows itself in a notebook; ``page`` is the whole page as text.

    Attributes:
        scene: What is played.
        title: Of the page, for readers who do not see it too.
        theme: "light" or "dark"; the reader's own choice if None.

    Raises:
        UnknownName: If there is no such theme.

    Example:
        >>> player = Player(Scene([0.0, 1.0]).moving_point([(0, 0), (1, 1)]))
        >>> player.page().startswith("<!doctype html>"), "<iframe" in player._repr_html_()
        (True, True)
    """

    scene: Scene
    title: str = "a motion"
    theme: str | None = None

    def __post_init__(self) -> None:
        if self.theme is not None:
            checks.choice("theme", self.theme, THEMES)

    def page(self) -> str:
        """The page's HTML: its script and its style are in it, and only they may run."""
        script, style = player_source()
        style += STYLE
        return PAGE.substitute(
            theme=f' data-theme="{self.theme}"' if self.theme else "",
            title=html.escape(self.title, quote=True),
            script=script, style=style, script_hash=_hash(script), style_hash=_hash(style),
            scene=self.scene.as_json().replace("<", "\\u003c"),
        )  # fmt: skip

    def _repr_html_(self) -> str:
        """For notebooks: the page in a frame of its own, so that several live in one notebook."""
        inside = html.escape(self.page(), quote=True)
        return (
            f'<iframe srcdoc="{inside}" sandbox="allow-scripts" title="{html.escape(self.title, quote=True)}" '
            'style="width: 100%; max-width: 640px; aspect-ratio: 8 / 7; border: 0" loading="lazy"></iframe>'
        )


def _hash(text: str) -> str:
    """The source expression of an inline script or style."""
    digest = hashlib.sha256(text.encode("utf-8")).digest()
    return f"'sha256-{base64.b64encode(digest).decode('ascii')}'"
