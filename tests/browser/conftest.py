"""A headless Chromium, the playground in a process of its own, and pages that tolerate no error."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import pytest

HERE = Path(__file__).parent
NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
FLAGS = (
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage",
)  # fmt: skip
WIDE = {"width": 1280, "height": 800}


def pytest_collection_modifyitems(items):
    """Mark what is in this folder; say why where it cannot run."""
    reason = None
    if "PYTEST_XDIST_WORKER" in os.environ:
        reason = "a browser is driven by one process alone: pytest -n0 tests/browser"
    elif not any(map(shutil.which, NAMES)):
        reason = "NOT RUN: there is no Chromium on PATH"
    for item in items:
        if HERE in item.path.parents:
            item.add_marker(pytest.mark.browser)
            if reason:
                item.add_marker(pytest.mark.skip(reason=reason))


@contextmanager
def playing(port=0):
    """The playground's process and address."""
    code = f"from coplanar.play import play; play(port={port}, browser=False)"
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        try:
            yield process, re.search(r"http://\S+", process.stdout.readline())[0]
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
                process.wait(15)


@pytest.fixture(scope="session")
def address():
    """Of a playground for all tests."""
    with playing() as (_, address):
        yield address


@pytest.fixture(scope="session")
def browser():
    """A headless Chromium."""
    sync_api = pytest.importorskip("playwright.sync_api")
    path = next(filter(None, map(shutil.which, NAMES)))
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield browser
        browser.close()


@pytest.fixture
def visit(browser, address):
    """Opens a tab of the playground in a context of its own; afterwards nothing may have gone wrong in it."""
    contexts, errors = [], []

    def visit(fragment="arm", *, at=address, **options):
        context = browser.new_context(**{"viewport": WIDE, "reduced_motion": "reduce"} | options)
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda message: message.type in ("error", "warning") and errors.append(message.text))
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto(f"{at}#{fragment}")
        page.wait_for_selector(f"html[data-tab={re.match('[a-z]+', fragment)[0]}]", timeout=20_000)
        rest(page)
        return page

    visit.errors = errors
    yield visit
    for context in contexts:
        context.close()
    assert errors == []


def until(page, expression, seconds=10.0):
    """Wait until an expression holds (the page's policy forbids Playwright's own way)."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = page.evaluate(expression)
        if found:
            return found
        page.wait_for_timeout(20)
    raise TimeoutError(expression)


def rest(page):
    """Wait until nothing is asked, nothing is missing, and the view stands still."""
    quiet = (
        "!playground.desk.busy && !playground.desk.wish && !playground.desk.timer && !playground.stage.asked"
        " && !playground.beside.work"
    )
    until(page, quiet)
    page.wait_for_timeout(30)
    until(page, quiet)


def state_of(page):
    """The state of the open tab."""
    return page.evaluate("playground.desk.state")
