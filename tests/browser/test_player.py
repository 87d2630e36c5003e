"""The player inlined in a page that opens from disk."""

from __future__ import annotations

import numpy as np

from coplanar.viz.scene import Scene, player_source
from tests.browser.conftest import until

PAGE = """<!doctype html><html lang="en"><head><meta charset="utf-8"><title>player</title>
<style>{style}</style></head><body>
<div class="player"><canvas tabindex="0" role="img" aria-label="scene"></canvas>
<div class="controls"><button type="button">Play</button>
<input type="range" min="0" max="1000" value="0" aria-label="Time">
<output></output><select aria-label="Speed"><option value="1">1</option></select></div>
<script type="application/json">{scene}</script></div><script>{script}</script></body></html>"""


def scene_of_every_kind():
    t = np.linspace(0.0, 1.0, 11)
    points = np.column_stack((t, t * t))
    poses = np.column_stack((t, t, 3.0 * t))
    square = [(0.1, 0.1), (-0.1, 0.1), (-0.1, -0.1), (0.1, -0.1)]
    scene = (
        Scene(t).region([[(0, 0), (2, 0), (2, 2), (0, 2)], square], role="muted").curve(points, dashed=True, fill=True)
    )
    scene = (
        scene.trail(points).moving_point(points).cross(points).discs(np.column_stack((points, 0.1 + 0 * t)), fill=True)
    )
    scene = scene.outline(square, fill=True).segments([0, 0, 1, 1]).arrows([0, 0, 1, 0.5], crossed=True, opacity=0.5)
    scene = scene.text("words", (0.5, 0.5)).linkage([(0, 0), (1, 0), (1, 1)]).body(poses, square)
    return scene.carried(poses, [0.0, 0.1, 0.1, 0.1])


def test_it_opens_from_disk_and_draws_every_kind_of_layer(browser, tmp_path):
    script, style = player_source()
    scene = scene_of_every_kind()
    kinds = {layer["kind"] for layer in scene.layers}
    assert len(kinds) == 13
    path = tmp_path / "page.html"
    path.write_text(PAGE.format(style=style, script=script, scene=scene.as_json()), "utf-8")
    page, errors = browser.new_page(), []
    page.on("console", lambda message: errors.append(message.text))
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(path.as_uri())
    until(page, "document.querySelector('output').textContent !== '0.00 s'")
    page.get_by_role("button", name="Pause").click()
    colours = page.evaluate(
        """() => { const c = document.querySelector("canvas");
            const d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
            return new Set(new Uint32Array(d.buffer)).size; }"""
    )
    assert colours > 20
    page.locator("canvas").focus()
    before = page.locator("output").inner_text()
    page.keyboard.press("ArrowRight")
    assert page.locator("output").inner_text() != before
    page.close()
    assert errors == []
