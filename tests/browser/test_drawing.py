"""Lines drawn by hand: by the mouse, and by the keys alone."""

from __future__ import annotations

from itertools import pairwise

import pytest

from tests.browser.conftest import rest, state_of, until
from tests.browser.hands import pixel_of


@pytest.mark.parametrize("tab", ["arm", "drive"])
def test_a_line_drawn_by_hand_is_followed(visit, tab):
    page = visit(tab)
    page.get_by_role("combobox", name="Curve").select_option("stroke")
    until(page, "document.querySelector('canvas.drawing') !== null")
    rest(page)
    places = [(0.5 + 0.05 * i, 0.6 + 0.02 * i) for i in range(12)]
    page.mouse.move(*pixel_of(page, places[0]))
    page.mouse.down()
    for place in places[1:]:
        page.mouse.move(*pixel_of(page, place), steps=3)
    page.mouse.up()
    rest(page)
    stroke = state_of(page)["stroke"]
    assert len(stroke) > 10
    assert stroke[0] == pytest.approx(places[0], abs=0.02)
    assert stroke[-1] == pytest.approx(places[-1], abs=0.05)
    assert page.evaluate("playground.clock.end > 0")
    assert page.locator("canvas.drawing").count() == 0


def waiting(visit):
    """The Drive tab, waiting for a line."""
    page = visit("drive")
    page.get_by_role("combobox", name="Curve").select_option("stroke")
    until(page, "document.querySelector('canvas.drawing') !== null")
    rest(page)
    return page


def pressed(page, *keys):
    for key in keys:
        page.keyboard.press(key)


def test_a_line_is_drawn_by_the_keys_alone(visit):
    page = waiting(visit)
    page.get_by_role("button", name="Draw on the picture").focus()
    pressed(page, "Enter")
    rest(page)
    pen = page.get_by_role("application", name="Pen")
    assert pen.evaluate("(pen) => pen === document.activeElement")
    pressed(page, "ArrowLeft", "ArrowLeft", "Space", *["ArrowRight"] * 4, "Shift+ArrowUp", "ArrowDown")
    assert "x " in pen.evaluate("(pen) => pen.nextSibling.textContent")
    assert state_of(page)["stroke"] == []
    pressed(page, "Space")
    until(page, "playground.desk.state.stroke.length > 0")
    rest(page)
    stroke = state_of(page)["stroke"]
    x, y = zip(*stroke, strict=True)
    step = x[1] - x[0]
    assert len(stroke) == 1 + 4 + 5 + 1
    assert step > 0.0
    assert [b - a for a, b in pairwise(x[:5])] == pytest.approx([step] * 4, abs=2e-4)
    assert y[9] - y[0] == pytest.approx(5.0 * step, abs=5e-4)
    assert y[10] - y[0] == pytest.approx(4.0 * step, abs=5e-4)
    assert x[0] == pytest.approx(-2.0 * step, abs=5e-4)  # the pen starts in the middle
    assert page.locator(".pen").first.is_hidden()
    assert page.evaluate("document.activeElement.textContent") == "Draw on the picture"
    assert page.evaluate("playground.clock.end > 0")


def test_a_line_can_be_taken_away_again(visit):
    page = waiting(visit)
    page.get_by_role("application", name="Pen").focus()
    pressed(page, "Enter", "ArrowUp", "ArrowUp", "Escape", "ArrowUp", "Tab")
    rest(page)
    assert state_of(page)["stroke"] == []
    assert page.locator(".pen.down").count() == 0
    pressed(page, "Shift+Tab", "Enter", "Enter")  # put down and lifted at once
    rest(page)
    assert state_of(page)["stroke"] == []
    assert page.get_by_role("application", name="Pen").is_visible()
