"""The renderer's text: one palette with the figures, and the same modules inlined."""

from __future__ import annotations

import re

import pytest

from coplanar.viz.scene import player_source
from coplanar.viz.style import DARK, LIGHT
from coplanar.viz.web import palette_css


@pytest.mark.parametrize(("theme", "blocks"), [(LIGHT, 1), (DARK, 2)])
def test_the_palette_is_the_one_of_the_figures(theme, blocks):
    """Dark stands twice: where the system asks for it, and where the reader does."""
    css = palette_css()
    for colour in (theme.surface, theme.ink, theme.muted, theme.grid, *theme.series):
        assert len(re.findall(rf": {colour};", css)) >= blocks


def test_inlined_modules_import_and_export_nothing():
    script, style = player_source()
    assert not re.search(r"^\s*(import|export)\b", script, re.MULTILINE)
    assert "startPlayers(document);" in script
    assert "</script" not in script
    assert "</style" not in style


def test_inlined_modules_do_not_share_a_name():
    script, _ = player_source()
    names = re.findall(r"^(?:function|class|const|let) (\w+)", script, re.MULTILINE)
    assert len(names) == len(set(names)) > 10
