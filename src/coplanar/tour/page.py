"""The tour as one page that opens from disk: a table of results, then a card for every demonstration."""

from __future__ import annotations

import html
from collections.abc import Sequence
from pathlib import Path
from string import Template

from coplanar.scenarios import Outcome
from coplanar.viz.outcomes import scene_of
from coplanar.viz.scene import player_source

_HERE = Path(__file__).parent

_PLAYER = """
<div class="player">
  <canvas tabindex="0" role="img" aria-label="Animation of {label}; space plays, arrow keys step"></canvas>
  <div class="controls">
    <button type="button">Play</button>
    <input type="range" min="0" max="1000" value="0" aria-label="Time in {label}">
    <output>0.00 s</output>
    <select aria-label="Speed"><option value="0.25">&frac14;&times;</option><option value="1" selected>1&times;</option>
      <option value="4">4&times;</option></select>
  </div>
  <script type="application/json">{scene}</script>
</div>"""


def page(demos: Sequence[Outcome]) -> str:
    """The page's HTML.

    Args:
        demos: What was run, in the order of the table.
    """
    script, style = player_source()
    template = Template((_HERE / "page.html").read_text("utf-8"))
    held = sum(demo.passed for demo in demos)
    return template.substitute(
        style=style + (_HERE / "page.css").read_text("utf-8"),
        script=script,
        verdict=f"{held} of {len(demos)} checks hold",
        rows="\n".join(map(_row, demos)),
        cards="\n".join(map(_card, demos)),
    )


def _row(demo: Outcome) -> str:
    mark = '<td class="holds">holds</td>' if demo.passed else '<td class="fails">fails</td>'
    cells = "".join(f"<td>{html.escape(text)}</td>" for text in (demo.title, demo.headline, demo.check))
    return f'<tr><th scope="row"><a href="#{demo.name}">{demo.name}</a></th>{cells}{mark}</tr>'


def _card(demo: Outcome) -> str:
    label = html.escape(demo.title, quote=True)
    moving = scene_of(demo)
    scene = "" if moving is None else _PLAYER.format(label=label, scene=moving.as_json())
    files = " &middot; ".join(f'<a href="{demo.name}/{file}">{file}</a>' for file in demo.tables)
    return f"""
<article id="{demo.name}" class="{"wide" if scene else ""}">
  <header><h2>{html.escape(demo.title)}</h2><p class="name">{demo.name}</p></header>
  <p>{html.escape(demo.story)}</p>
  <p class="headline">{html.escape(demo.headline)}</p>
  <div class="pictures">
    <picture><source srcset="{demo.name}/figure-dark.svg" media="(prefers-color-scheme: dark)">
      <img src="{demo.name}/figure-light.svg" alt="Figure of {label}" loading="lazy"></picture>{scene}
  </div>
  <footer>{files}</footer>
</article>"""
