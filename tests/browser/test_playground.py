"""The playground's page in a real browser: what is drawn is what Python says, by mouse, touch and keys."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from coplanar import scenarios
from coplanar.arms import Arm
from tests.browser.conftest import playing, rest, state_of, until
from tests.browser.hands import answered, centre_of, copied, drag, drawn_near, pixel_of, walked

AXE = Path(__file__).parents[2] / "tools" / "web" / "node_modules" / "axe-core" / "axe.min.js"


def test_every_tab_shows_what_python_says(visit):
    page = visit("lab")
    for tab in walked(page):
        _shows_what_python_says(page, tab)


def _shows_what_python_says(page, tab):
    answer = answered(page)
    assert page.locator("[role=tab][aria-selected=true]").inner_text().lower() == tab
    assert page.locator("#sentences li > span:last-child").all_inner_texts() == [s["text"] for s in answer["sentences"]]
    shown = page.locator("[data-readout]").all_inner_texts()
    assert sorted(text.replace("\u2212", "-") for text in shown) == sorted(r["value"] for r in answer["readouts"])
    assert page.locator(".picture canvas").count() == len(answer["pictures"])
    assert page.locator(".chart").count() == len(answer["series"])
    named = [line["label"] for lines in answer["legends"].values() for line in lines]
    assert page.locator(".legend li").all_inner_texts() == named
    for handle in answer["handles"]:
        assert centre_of(page, handle["id"]) == pytest.approx(pixel_of(page, handle["at"], handle["picture"]), abs=1.0)


def test_the_drawn_tool_is_within_a_pixel_of_pythons_answer(visit):
    """Also where the target is out of reach: then the tool is at the nearest point."""
    page = visit("arm")
    for to in ((0.4, 1.1), (-0.9, -0.5), (1.25, 1.3)):
        drag(page, "tool", to)
        state = state_of(page)
        assert (state["target_x"], state["target_y"]) == pytest.approx(to, abs=0.02)
        tool = Arm([state["l1"], state["l2"]]).forward([state["q1"], state["q2"]]).position.tolist()
        x, y = pixel_of(page, tool)
        drawn_x, drawn_y, count = drawn_near(page, "trail", x, y)
        assert count > 20
        assert (drawn_x, drawn_y) == pytest.approx((x, y), abs=1.0)
    assert float(page.locator("[data-readout=gap]").inner_text()) > 0.05


def test_the_target_of_a_shot_follows_the_mouse(visit):
    page = visit("shoot")
    drag(page, "target", (40.0, 12.0))
    assert (state_of(page)["target_x"], state_of(page)["target_y"]) == pytest.approx((40.0, 12.0), abs=1.0)


def test_numbers_and_sliders_are_those_of_the_last_answer_while_a_handle_is_held(visit):
    page = visit("base")
    page.get_by_role("combobox", name="Layout").select_option("mecanum")
    rest(page)
    page.mouse.move(*centre_of(page, "wheel_1"))
    page.mouse.down()
    page.mouse.move(*pixel_of(page, (0.45, 0.12)), steps=9)
    until(page, "!playground.desk.busy && !playground.desk.wish && !playground.beside.work")
    assert page.evaluate("playground.stage.held()")
    state = state_of(page)
    assert state["layout"] == page.get_by_role("combobox", name="Layout").input_value() == "custom"
    assert [state["wheels"][0][axis] for axis in "xy"] == pytest.approx([0.45, 0.12], abs=0.02)
    boxes = [float(page.locator(f"#control-wheels-0-{axis}-box").input_value()) for axis in "xy"]
    assert boxes == pytest.approx([state["wheels"][0][axis] for axis in "xy"], rel=1e-4)
    shown = page.locator("[data-readout]").all_inner_texts()
    page.mouse.up()
    rest(page)
    assert page.locator("[data-readout]").all_inner_texts() == shown


def test_arrow_keys_move_a_focused_handle(visit):
    page = visit("arm")
    handle = page.get_by_role("slider", name="Tool")
    before = state_of(page)
    handle.focus()
    for key in ("ArrowRight", "ArrowRight", "ArrowUp", "Shift+ArrowLeft"):
        page.keyboard.press(key)
    rest(page)
    after = state_of(page)
    assert after["target_x"] - before["target_x"] == pytest.approx(-8 * 0.02, abs=1e-9)
    assert after["target_y"] - before["target_y"] == pytest.approx(0.02, abs=1e-9)
    assert handle.evaluate("(element) => element === document.activeElement")
    assert f"x {after['target_x']:.2f}" in handle.get_attribute("aria-valuetext")


def test_a_finger_moves_a_handle_and_does_not_scroll(visit):
    page = visit("arm", viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    touch = page.context.new_cdp_session(page)
    start, end = centre_of(page, "tool"), pixel_of(page, (0.3, 0.9))

    def send(kind, *points):
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in points]})

    send("touchStart", start)
    for part in range(1, 11):
        send("touchMove", tuple(a + part / 10 * (b - a) for a, b in zip(start, end, strict=True)))
        page.wait_for_timeout(16)
    send("touchEnd")
    rest(page)
    assert (state_of(page)["target_x"], state_of(page)["target_y"]) == pytest.approx((0.3, 0.9), abs=0.03)
    assert page.evaluate("scrollY") == 0


def test_sliders_boxes_and_reset(visit):
    page = visit("arm")
    page.get_by_role("slider", name="Link 1").focus()
    page.keyboard.press("ArrowRight")
    rest(page)
    assert state_of(page)["l1"] == 1.01
    box = page.get_by_role("spinbutton", name="Link 1 in m")
    box.fill("1.234")
    box.press("Enter")
    rest(page)
    assert state_of(page)["l1"] == 1.234
    page.get_by_role("button", name="Reset Link 1 to 1 m").click()
    rest(page)
    assert state_of(page)["l1"] == 1.0


def test_a_number_out_of_range_is_refused_in_words(visit):
    page = visit("arm")
    box = page.get_by_role("spinbutton", name="Link 1 in m")
    box.fill("99")
    box.press("Enter")
    until(page, "!playground.notice.hidden")
    assert "l1 = 99" in page.locator("#notice").inner_text()
    assert state_of(page)["l1"] == 1.0
    assert box.input_value() == "1"


def test_a_share_link_restores_exactly(visit):
    page, other = visit("lab"), visit("arm")
    for tab in walked(page):
        handle = page.locator("#stage .handle").first
        if handle.count():
            handle.focus()
            for key in ("ArrowRight", "ArrowUp", "ArrowUp"):
                page.keyboard.press(key)
            rest(page)
        page.get_by_role("button", name="Share").click()
        link = page.locator("#copied-text").input_value()
        page.get_by_role("button", name="Close").click()
        assert link.startswith(page.url.split("#")[0])
        other.goto("about:blank")
        other.goto(link)
        other.wait_for_selector(f"html[data-tab={tab}]")
        rest(other)
        assert state_of(other) == state_of(page)
        assert other.locator("#sentences").inner_text() == page.locator("#sentences").inner_text()


def test_a_bad_link_is_told_and_defaults_are_shown(visit, address):
    page = visit("arm")
    defaults = state_of(page)
    bad = (("arm=%%%", "damaged"), ("arm=e30x!", "damaged"), ("dance", "no tab"), ("arm=eyJsMSI6OTl9", "l1 = 99"))
    for fragment, words in bad:
        page.goto("about:blank")
        page.goto(f"{address}#{fragment}")
        page.wait_for_selector("html[data-tab=arm]")
        until(page, "!playground.notice.hidden")
        assert words in page.locator("#notice").inner_text()
        rest(page)
        assert state_of(page) == defaults


def test_back_and_forward_walk_through_what_was_done(visit):
    page = visit("arm")
    first = state_of(page)
    drag(page, "tool", (0.5, 1.0))
    second = state_of(page)
    page.get_by_role("tab", name="Lab").click()
    page.wait_for_selector("html[data-tab=lab]")
    rest(page)
    page.go_back()
    page.wait_for_selector("html[data-tab=arm]")
    rest(page)
    assert state_of(page) == second
    page.go_back()
    rest(page)
    assert state_of(page) == first
    page.go_forward()
    rest(page)
    assert state_of(page) == second


def test_the_player_plays_pauses_steps_and_scrubs(visit):
    page = visit("motion")
    clock = "playground.clock.time"
    end = page.evaluate("playground.clock.end")
    assert page.evaluate(clock) == end
    page.get_by_role("combobox", name="Speed").select_option("4")
    page.get_by_role("button", name="Play").click()
    until(page, f"{clock} > 0.2 && {clock} < {end}")
    page.get_by_role("button", name="Pause").click()
    held = page.evaluate(clock)
    page.wait_for_timeout(120)
    assert page.evaluate(clock) == held
    page.get_by_role("button", name="Step back").click()
    assert page.evaluate(clock) == pytest.approx(max(0.0, held - end / 100))
    page.get_by_role("slider", name="Time").fill("500")
    assert page.evaluate(clock) == pytest.approx(0.5 * end)
    until(
        page,
        """playground.charts.charts.filter((c) => c.timed).every((c) =>
        Math.abs(c.plot.cursor.left - c.plot.valToPos(playground.clock.time, "x")) < 1)""",
    )


def test_a_click_on_a_curve_moves_the_time(visit):
    page = visit("motion")
    over = page.locator(".chart .u-over").first
    over.scroll_into_view_if_needed()
    box = over.bounding_box()
    page.mouse.click(box["x"] + 0.25 * box["width"], box["y"] + 0.5 * box["height"])
    assert page.evaluate("playground.clock.part") == pytest.approx(0.25, abs=0.02)


def test_wheels_are_added_and_taken_away(visit):
    page = visit("base")
    count = len(state_of(page)["wheels"])
    page.get_by_role("button", name="Add a wheel").click()
    rest(page)
    assert len(state_of(page)["wheels"]) == count + 1
    page.get_by_role("button", name=f"Take away wheel {count + 1}").click()
    rest(page)
    assert len(state_of(page)["wheels"]) == count


def test_the_keyboard_reaches_everything(visit):
    page = visit("arm")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.id") == "skip"
    page.keyboard.press("Enter")
    assert page.evaluate("document.activeElement.id") == "panel"
    page.get_by_role("tab", name="Arm").focus()
    page.keyboard.press("ArrowRight")
    page.wait_for_selector("html[data-tab=drive]")
    assert page.evaluate("document.activeElement.id") == "tab-drive"
    page.keyboard.press("End")
    page.wait_for_selector("html[data-tab=lab]")
    page.keyboard.press("ArrowRight")
    page.wait_for_selector("html[data-tab=arm]")
    page.keyboard.press("Tab")
    assert page.evaluate("getComputedStyle(document.activeElement).outlineStyle") == "solid"


def test_light_and_dark_follow_the_reader(visit):
    page = visit("arm", color_scheme="dark")
    surface = "getComputedStyle(document.documentElement).getPropertyValue('--surface').trim()"
    assert page.evaluate(surface) == "#12171f"
    page.get_by_role("button", name="Light or dark").click()
    assert page.evaluate(surface) == "#ffffff"
    page.reload()
    page.wait_for_selector("html[data-tab=arm]")
    assert page.evaluate(surface) == "#ffffff"


def test_nothing_is_loaded_from_elsewhere(visit):
    page = visit("arm")
    loaded = page.evaluate("performance.getEntriesByType('resource').map((entry) => entry.name)")
    assert len(loaded) > 10
    assert {"/".join(url.split("/")[:3]) for url in loaded} == {"/".join(page.url.split("/")[:3])}


def test_without_a_clipboard_the_text_is_selected(visit):
    page = visit("arm")
    page.evaluate("() => { navigator.clipboard.writeText = () => Promise.reject(new Error('no')); }")
    page.get_by_role("button", name="Python").click()
    until(page, "document.querySelector('#copied-status').textContent.includes('selected')")
    text = page.locator("#copied-text")
    assert text.evaluate("(t) => t.selectionEnd - t.selectionStart === t.value.length && t.value.length > 50")


def test_the_page_comes_back_when_the_server_does(visit):
    with playing() as (_, at):
        page = visit("arm", at=at)
        drag(page, "tool", (0.5, 1.0))
        state = state_of(page)
    until(page, "!playground.notice.hidden && playground.notice.textContent.includes('connection')")
    page.locator("[data-handle=tool]").focus()
    page.keyboard.press("ArrowRight")
    with playing(port=int(at.rsplit(":", 1)[1].strip("/"))):
        until(page, "document.documentElement.dataset.connection === 'open'", 15)
        rest(page)
        assert page.locator("#notice").is_hidden()
        assert state_of(page)["target_x"] == pytest.approx(state["target_x"] + 0.02)
        page.close()
    assert all("ERR_CONNECTION_REFUSED" in error for error in visit.errors)
    visit.errors.clear()


def test_copied_python_runs_and_agrees_with_the_page(visit):
    page, codes, numbers = visit("arm"), [], []
    for _ in walked(page):
        codes.append(copied(page, "Python"))
        numbers.append({entry["key"]: entry["number"] for entry in answered(page)["readouts"] if "number" in entry})
    runner = "import json, sys\nfor code in json.load(sys.stdin):\n    exec(code, {})\n    print('----')\n"
    done = subprocess.run(
        [sys.executable, "-c", runner], input=json.dumps(codes), capture_output=True, text=True, check=True
    )
    for output, wanted in zip(done.stdout.split("----\n"), numbers, strict=False):
        printed = dict(line.split(" = ", 1) for line in output.splitlines() if " = " in line)
        shared = printed.keys() & wanted.keys()
        assert len(shared) >= 2
        for key in shared:
            assert float(printed[key]) == pytest.approx(wanted[key], rel=1e-12, abs=1e-12), key


def test_copied_yaml_is_a_scenario_that_measures(visit, tmp_path):
    page = visit("arm")
    for tab in walked(page):
        path = tmp_path / f"{tab}.yaml"
        path.write_text(copied(page, "YAML"), "utf-8")
        assert scenarios.load(path).measure()


@pytest.mark.parametrize("width", [360, 800])
def test_narrow_screens_do_not_scroll_sideways(visit, width):
    page = visit("lab", viewport={"width": width, "height": 740}, is_mobile=width < 400, has_touch=width < 400)
    for _ in walked(page):
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        outside = page.evaluate(
            """(width) => [...document.querySelectorAll("main *")]
                .filter((e) => e.offsetParent && !e.closest(".handles") && e.getBoundingClientRect().right > width + 1)
                .map((e) => e.outerHTML.slice(0, 80))""",
            width,
        )
        assert outside == []


@pytest.mark.skipif(not AXE.exists(), reason="NOT RUN: axe-core is not installed (npm ci in tools/web)")
def test_axe_finds_nothing_serious(visit):
    page = visit("lab", bypass_csp=True)
    page.add_script_tag(path=str(AXE))
    for tab in walked(page):
        for scheme in ("light", "dark"):
            page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
            found = page.evaluate("axe.run(document, { resultTypes: ['violations'] })")["violations"]
            serious = [
                (violation["id"], violation["help"], [node["html"][:120] for node in violation["nodes"]][:4])
                for violation in found
                if violation["impact"] in ("serious", "critical")
            ]
            assert json.dumps([tab, scheme, serious]) == json.dumps([tab, scheme, []])
