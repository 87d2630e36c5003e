"""How often the page shows an answer while a hand drags; the numbers are for the reader, the order is not."""

from __future__ import annotations

import statistics
import sys
import time

from coplanar.play import Session
from tests.browser.conftest import rest, state_of
from tests.browser.hands import answered, centre_of, walked

HANDLES = {"arm": "tool", "drive": "curve", "base": "velocity", "motion": "end", "shoot": "target", "lab": "launch"}
SECONDS = {"warm": 0.2, "measured": 0.7}
DRAG = """([name, seconds]) => new Promise((done) => {
    const { desk, stage, connection } = playground;
    const handle = document.querySelector(`[data-handle=${name}]`);
    const box = handle.getBoundingClientRect();
    const [x, y, start] = [box.x + 0.5 * box.width, box.y + 0.5 * box.height, performance.now()];
    const event = (kind, right, down) => new PointerEvent(kind, {
        bubbles: true, cancelable: true, pointerId: 1, button: 0, buttons: 1, clientX: x + right, clientY: y + down,
    });
    handle.setPointerCapture = () => {};
    handle.dispatchEvent(event("pointerdown", 0, 0));
    const [answers, paints] = [desk.answers, stage.frames];
    let [frames, most, shown, fresh] = [0, 0, desk.answers, 0];
    const move = () => {
        fresh += desk.answers > shown;
        shown = desk.answers;
        const now = performance.now();
        if (now - start >= 1000 * seconds) {
            handle.dispatchEvent(event("pointerup", 0, 0));
            const spent = (now - start) / 1000;
            done([(desk.answers - answers) / spent, fresh / spent, frames / spent, most]);
            return;
        }
        frames += 1;
        handle.dispatchEvent(event("pointermove", 30 * Math.sin(0.1 * frames), 20 * Math.sin(0.13 * frames)));
        most = Math.max(most, connection.inFlight.length);
        requestAnimationFrame(move);
    };
    requestAnimationFrame(move);
})"""


def processor_time(tab, state, handle):
    """Median of answering a live drag [ms]."""
    session, spent = Session(), []
    at = next(one["at"] for one in session.handle({"do": "show", "tab": tab, "state": state})["handles"]
              if one["id"] == handle)  # fmt: skip
    for i in range(15):
        to = [at[0] + 0.01 * i, at[1] + 0.005 * i]
        request = {"id": i, "do": "show", "tab": tab, "state": state, "drag": {"handle": handle, "to": to}}
        start = time.thread_time()
        session.answer(request)
        spent.append(1000.0 * (time.thread_time() - start))
    return statistics.median(spent)


def test_answers_a_second_while_dragging(visit, capsys):
    """A hand that moves with every frame, as a browser hands out the moves of a mouse: one a frame."""
    page = visit("lab")
    page.get_by_role("combobox", name="Motion").select_option("shot")
    rest(page)
    for tab in walked(page):
        handle = HANDLES[tab]
        for seconds in SECONDS.values():
            answers, drawn, paints, most = page.evaluate(DRAG, [handle, seconds])
        rest(page)
        spent = processor_time(tab, state_of(page), handle)
        with capsys.disabled():
            sys.stdout.write(
                f"\n{tab}: {answers:.0f} answers a second, {drawn:.0f} of {paints:.0f} frames show a new one, "
                f"{spent:.1f} ms of a processor each"
            )
        assert 1 <= most <= 2  # in flight: nothing piles up
        texts = page.locator("#sentences li > span:last-child").all_inner_texts()
        assert texts == [sentence["text"] for sentence in answered(page)["sentences"]]
        x, y = centre_of(page, handle)
        page.mouse.move(x, y)  # nothing is in the hand any more
        assert not page.evaluate("playground.stage.held()")
