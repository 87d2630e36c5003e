"""``play``: from the address that it prints to Ctrl-C."""

from __future__ import annotations

import base64
import json
import os
import re
import signal
import socket
import subprocess
import sys

import pytest
from typer.testing import CliRunner
from websockets.sync.client import connect

from coplanar.cli import app as cli
from coplanar.errors import InvalidInput, InvalidValue
from coplanar.play import Session, app
from coplanar.play.app import play
from coplanar.play.scenarios import opened
from coplanar.scenarios import load

posix = pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")


@pytest.fixture
def running():
    """The playground in a process of its own, and its address."""
    command = [sys.executable, "-W", "error", "-m", "coplanar.play"]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, **pipes) as process:
        yield process, re.search(r"http://127\.0\.0\.1:\d+/", process.stdout.readline())[0]
        if process.poll() is None:
            process.kill()


@posix
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_it_stops_cleanly_while_pages_are_open(running, number):
    process, address = running
    place = address.removeprefix("http://")
    with connect(f"ws://{place}session", origin=f"http://{place}"[:-1]) as page:
        page.send('{"id": 1, "do": "show", "tab": "arm"}')
        page.recv(timeout=30)
        process.send_signal(number)
        output, errors = process.communicate(timeout=15)
    assert errors == ""
    if number == signal.SIGINT:
        assert process.returncode == 0
        assert output.endswith("Stopped.\n")


def test_a_taken_port_is_named():
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        with pytest.raises(InvalidValue, match=rf"'127.0.0.1:{port}': needed a free port of this machine; .*--port 0"):
            play(port=port, browser=False)


@pytest.mark.parametrize("host", ["no.such.host.invalid", "192.0.2.1"])
def test_an_address_of_another_machine_is_refused(host):
    with pytest.raises(InvalidValue):
        play(host=host, browser=False)


@pytest.fixture
def told(monkeypatch):
    """What is said when the server is ready, without serving."""
    said, shown = [], []
    monkeypatch.setattr(app.Playground, "run", lambda server, **_: server.ready())
    monkeypatch.setattr("webbrowser.open", shown.append)

    def tell(**options):
        play(say=said.append, **options)
        return said, shown

    return tell


def test_only_this_machine_is_served_unless_asked(told):
    said, _ = told(browser=False)
    assert re.fullmatch(r"The playground is at http://127\.0\.0\.1:\d+/", said[0])
    assert "everybody" not in " ".join(said)


def test_a_host_that_others_reach_is_said_to_be_one(told):
    said, _ = told(host="0.0.0.0", browser=False)
    assert said[0].startswith("The playground is at http://localhost:")
    assert "everybody who reaches this machine" in said[1]


def test_the_browser_opens_the_address_where_there_is_a_screen(told, monkeypatch):
    monkeypatch.setattr(app, "_has_screen", lambda: True)
    said, shown = told()
    assert shown == [said[0].removeprefix("The playground is at ")]


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="these always have a screen")
def test_no_browser_takes_over_a_terminal(told, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    assert told()[1] == []


class TestScenario:
    @staticmethod
    def state_of(address):
        tab, code = address.split("#")[1].split("=")
        return tab, json.loads(base64.urlsafe_b64decode(code + "=" * (-len(code) % 4)))

    def test_the_page_begins_with_a_scenario_of_the_catalog(self, told):
        said, _ = told(scenario="track-astroid", browser=False)
        tab, state = self.state_of(said[0])
        assert (tab, state) == opened(load("track-astroid"))

    def test_or_with_a_file(self, told, tmp_path):
        path = tmp_path / "mine.yaml"
        path.write_text(Session().handle({"id": 1, "do": "copy", "as": "yaml", "tab": "shoot", "state": {}})["text"])
        assert self.state_of(told(scenario=path, browser=False)[0][0])[0] == "shoot"

    def test_a_kind_without_a_tab_is_refused_by_name(self, told):
        with pytest.raises(InvalidInput, match=r"one that the playground can show: .*arm"):
            told(scenario="frames", browser=False)


@posix
def test_the_command_serves_a_scenario_and_ends_with_ctrl_c():
    command = [sys.executable, "-m", "coplanar", "play", "track-astroid", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert re.fullmatch(r"The playground is at http://127\.0\.0\.1:\d+/#drive=[\w-]+\n", process.stdout.readline())
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=15)
    assert (process.returncode, errors) == (0, "")
    assert output.endswith("Stopped.\n")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["no-such-scenario"], "no-such-scenario"),
        (["frames"], "the playground can show"),
        (["--port", "70000"], "--port"),
        (["--host", "192.0.2.1"], "192.0.2.1"),
    ],
)
def test_what_cannot_be_served_ends_with_2(arguments, words):
    result = CliRunner().invoke(cli, ["play", "--no-browser", *arguments])
    assert result.exit_code == 2
    assert words in result.output
    assert "Traceback" not in result.output
