"""What a hand and an eye do on the page."""

from __future__ import annotations

from coplanar.play import Session
from tests.browser.conftest import rest, state_of, until

TABS = ("arm", "drive", "base", "motion", "shoot", "lab")
LEFT, RIGHT, TOP, BOTTOM = 44, 14, 14, 30  # margins of a picture [px]


def pixel_of(page, place, picture="main"):
    """Where a place of the plane is on the screen, by what the page says it shows: equal axes, centred."""
    bounds, box = page.evaluate(
        """(name) => {
            const { framing, canvas } = playground.stage.pictures.get(name);
            const { x, y, width, height } = canvas.getBoundingClientRect();
            return [framing.bounds, { x, y, width, height }];
        }""",
        picture,
    )
    xmin, xmax, ymin, ymax = bounds
    width, height = box["width"] - LEFT - RIGHT, box["height"] - TOP - BOTTOM
    scale = min(width / (xmax - xmin), height / (ymax - ymin))
    x = box["x"] + LEFT + 0.5 * width + scale * (place[0] - 0.5 * (xmin + xmax))
    y = box["y"] + TOP + 0.5 * height - scale * (place[1] - 0.5 * (ymin + ymax))
    return x, y


def centre_of(page, handle):
    box = page.locator(f"[data-handle={handle}]").bounding_box()
    return box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]


def drawn_near(page, colour, x, y):
    """Centre of the pixels of a colour within 16 pixels of a point of the main picture."""
    return page.evaluate(
        """([role, x, y]) => {
            const { canvas } = playground.stage.pictures.get("main");
            const box = canvas.getBoundingClientRect();
            const [left, top] = [Math.round(x - box.x) - 16, Math.round(y - box.y) - 16];
            const copy = new OffscreenCanvas(33, 33).getContext("2d");
            copy.drawImage(canvas, left, top, 33, 33, 0, 0, 33, 33);
            const data = copy.getImageData(0, 0, 33, 33).data;
            const wanted = getComputedStyle(canvas).getPropertyValue("--" + role).trim().slice(1);
            const rgb = [0, 2, 4].map((i) => parseInt(wanted.slice(i, i + 2), 16));
            let [sx, sy, n] = [0, 0, 0];
            for (let i = 0; i < 33 * 33; i++) {
                if (rgb.some((v, k) => Math.abs(v - data[4 * i + k]) > 12)) continue;
                sx += (i % 33) + 0.5; sy += Math.floor(i / 33) + 0.5; n += 1;
            }
            return n ? [left + sx / n + box.x, top + sy / n + box.y, n] : [NaN, NaN, 0];
        }""",
        [colour, x, y],
    )


def drag(page, handle, to):
    """Take a handle by the mouse and let it go at a place of the plane."""
    page.mouse.move(*centre_of(page, handle))
    page.mouse.down()
    page.mouse.move(*pixel_of(page, to), steps=12)
    page.mouse.up()
    rest(page)


def answered(page):
    """What Python says of the state that the page holds."""
    answer = Session().handle(
        {"id": 0, "do": "show", "tab": page.evaluate("playground.desk.tab"), "state": state_of(page)}
    )
    assert answer["ok"], answer
    return answer


def walked(page):
    """Every tab in turn, by its button."""
    for tab in TABS:
        page.locator(f"#tab-{tab}").click()
        page.wait_for_selector(f"html[data-tab={tab}]")
        rest(page)
        yield tab


def copied(page, button):
    """The text that a button offers."""
    page.get_by_role("button", name=button).click()
    until(page, "document.querySelector('#copied').open && document.querySelector('#copied-status').textContent !== ''")
    text = page.locator("#copied-text").input_value()
    page.get_by_role("button", name="Close").click()
    return text
