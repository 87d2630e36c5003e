"""The playground's server on real sockets: who is let in, and what a hostile visitor costs the others."""

from __future__ import annotations

import http.client
import json
import socket
import statistics
import sys
import threading
import time
from contextlib import ExitStack, contextmanager
from html.parser import HTMLParser

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from coplanar.play.app import Playground, settings
from coplanar.play.doors import HEADERS, Doors
from coplanar.play.files import files
from coplanar.play.limits import Limits
from coplanar.play.server import application
from coplanar.play.session import Session

SHOW = json.dumps({"id": 1, "do": "show", "tab": "arm", "live": True})


@contextmanager
def serving(answer=None, limits=None, doors=None):
    """A running server; gives its port."""
    limits = limits or Limits()
    app = application(answer or Session().answer, doors or Doors.of("127.0.0.1"), limits)
    listener = socket.create_server(("127.0.0.1", 0))
    ready = threading.Event()
    server = Playground(settings(app, limits), ready.set)
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    try:
        if not ready.wait(10):
            raise TimeoutError("the server did not start")
        yield listener.getsockname()[1]
    finally:
        server.should_exit = True
        thread.join(15)
        listener.close()


def opened(port, **more):
    """A browser's WebSocket."""
    more = {"origin": f"http://127.0.0.1:{port}", "compression": None, "max_size": None, "close_timeout": 2} | more
    return connect(f"ws://127.0.0.1:{port}/session", **more)


def asked(port, path="/", method="GET", **headers):
    """Status, headers and body of one HTTP request."""
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=10)
    try:
        connection.request(method, path, headers=headers)
        response = connection.getresponse()
        return response.status, dict(response.getheaders()), response.read().decode()
    finally:
        connection.close()


def latencies(port, times=60, message=SHOW):
    """Round trips of an honest visitor [ms]."""
    found = []
    with opened(port) as client:
        for _ in range(times):
            start = time.perf_counter()
            client.send(message)
            client.recv(timeout=30)
            found.append(1000.0 * (time.perf_counter() - start))
    return found


@pytest.fixture(scope="module")
def port():
    with serving() as number:
        yield number


class TestPage:
    def test_every_listed_file_is_sent_with_the_security_headers(self, port):
        for path, file in files().items():
            status, headers, body = asked(port, path)
            assert status == 200
            assert body.encode() == file.content
            assert headers["content-type"].startswith(file.media_type)
            assert {name: headers[name.lower()] for name in HEADERS} == HEADERS

    def test_the_policy_allows_nothing_inline_and_no_other_host(self):
        policy = dict(part.strip().split(" ", 1) for part in HEADERS["Content-Security-Policy"].split(";"))
        assert policy["default-src"] == policy["base-uri"] == policy["frame-ancestors"] == "'none'"
        assert {policy[name] for name in ("script-src", "style-src", "connect-src", "img-src")} == {"'self'"}

    def test_the_page_itself_keeps_to_the_policy(self):
        class Page(HTMLParser):
            links, inline = [], []

            def handle_starttag(self, tag, attributes):
                given = dict(attributes)
                self.inline += [name for name in given if name == "style" or name.startswith("on")]
                self.inline += [tag] * (tag == "style" or (tag == "script" and "src" not in given))
                self.links += [v for k, v in attributes if k in ("src", "href") and v[0] != "#"]

        page = Page()
        page.feed(files()["/"].content.decode())
        assert page.inline == []
        assert set(page.links) <= set(files())

    @pytest.mark.parametrize(
        "path",
        [
            "/index.html",
            "/../pyproject.toml",
            "/%2e%2e/%2e%2e/etc/passwd",
            "//etc/passwd",
            "/static/app.js",
            "/app.js/",
        ],
    )
    def test_no_other_path_exists(self, port, path):
        assert asked(port, path)[0] in (404, 307)
        assert "[project]" not in asked(port, path)[2]

    def test_nothing_is_taken(self, port):
        assert asked(port, "/", "POST")[0] == 405


class TestDoors:
    @pytest.mark.parametrize(
        "host", ["evil.example", "evil.example:80", "127.0.0.1.evil.example", "127.0.0.1@evil.example", "", "127.0.0.2"]
    )
    def test_another_name_is_refused(self, port, host):
        status, headers, _ = asked(port, "/", Host=host)
        assert status == 403
        assert "content-security-policy" in headers

    def test_the_names_of_this_machine_are_taken(self, port):
        assert asked(port, "/", Host=f"localhost:{port}")[0] == asked(port, "/", Host="[::1]:9000")[0] == 200

    @pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1:1", "http://localhost", None])
    def test_another_origin_opens_no_socket(self, port, origin):
        with pytest.raises(InvalidStatus) as refused:
            opened(port, origin=origin)
        assert refused.value.response.status_code == 403

    def test_a_rebound_name_opens_no_socket(self, port):
        """Host and Origin agree, but the name is somebody else's."""
        with pytest.raises(InvalidStatus) as refused, socket.create_connection(("127.0.0.1", port)) as line:
            connect(f"ws://evil.example:{port}/session", origin=f"http://evil.example:{port}", sock=line)
        assert refused.value.response.status_code == 403

    def test_open_to_others_it_takes_addresses_but_no_names(self):
        doors = Doors.of("0.0.0.0")
        assert doors.admit("192.168.1.7:8000")
        assert doors.admit("[fe80::1]:8000")
        assert doors.admit(socket.gethostname())
        assert not doors.admit("evil.example:8000")
        assert not Doors.of("127.0.0.1").admit("192.168.1.7:8000")


class TestConversation:
    def test_the_session_answers(self, port):
        with opened(port) as client:
            client.send(SHOW)
            answer = json.loads(client.recv(timeout=30))
        assert answer["ok"]
        assert answer["tab"] == "arm"

    @pytest.mark.parametrize(
        "garbage", ["", "{", "[]", "null", '{"id": NaN}', "[" * 20000, '{"do": "eval"}', "\x00\ud7ff"]
    )
    def test_garbage_gets_a_clear_error_and_the_line_stays(self, port, garbage):
        with opened(port) as client:
            client.send(garbage)
            answer = json.loads(client.recv(timeout=30))
            assert not answer["ok"]
            assert answer["error"]["sentence"]
            client.send(SHOW)
            assert json.loads(client.recv(timeout=30))["ok"]

    def test_bytes_are_refused(self, port):
        with opened(port) as client:
            client.send(b"\x00\x01")
            with pytest.raises(ConnectionClosed) as closed:
                client.recv(timeout=10)
        assert closed.value.rcvd.code == 1003

    def test_a_message_that_is_too_long_closes_its_line_only(self, port):
        with opened(port) as other, opened(port) as client:
            client.send("x" * (Limits().message_bytes + 1))
            with pytest.raises(ConnectionClosed) as closed:
                client.recv(timeout=10)
            assert closed.value.rcvd.code == 1009
            other.send(SHOW)
            assert json.loads(other.recv(timeout=30))["ok"]

    def test_the_newest_message_takes_the_place_of_those_that_wait(self):
        begun, go_on = threading.Event(), threading.Event()

        def answer(text):
            begun.set()
            go_on.wait(10)
            return text

        with serving(answer) as port, opened(port) as client:
            client.send("first")
            assert begun.wait(10)
            for number in range(20):
                client.send(f"waiting {number}")
            client.ping().wait(10)
            time.sleep(0.2)
            go_on.set()
            assert client.recv(timeout=10) == "first"
            assert client.recv(timeout=10) == "waiting 19"
            with pytest.raises(TimeoutError):
                client.recv(timeout=0.2)

    def test_a_visitor_who_asks_nothing_is_let_go(self):
        with (
            serving(limits=Limits(idle=0.3)) as port,
            opened(port) as client,
            pytest.raises(ConnectionClosed) as closed,
        ):
            client.recv(timeout=10)
        assert closed.value.rcvd.code == 4000

    def test_there_is_room_for_so_many_and_room_again(self):
        with serving(limits=Limits(sessions=3)) as port:
            with ExitStack() as stack:
                for _ in range(3):
                    stack.enter_context(opened(port))
                with opened(port) as one_more, pytest.raises(ConnectionClosed) as closed:
                    one_more.recv(timeout=10)
                assert closed.value.rcvd.code == 1013
                assert "3 pages are open" in closed.value.rcvd.reason
            time.sleep(0.3)
            assert max(latencies(port, 1)) > 0.0


class TestHostility:
    """What others do costs an honest visitor little; the bounds are generous, the numbers are printed."""

    @staticmethod
    def report(what, alone, beside):
        numbers = (statistics.median(alone), statistics.median(beside), max(beside))
        sys.stdout.write("\n{}: median {:.1f} ms alone, {:.1f} ms beside, worst {:.1f} ms\n".format(what, *numbers))

    def test_a_flood_stays_in_its_own_socket(self, port):
        alone, stop = latencies(port), threading.Event()

        def flood():
            with opened(port) as client:
                try:
                    while not stop.is_set():
                        client.send(SHOW)
                except ConnectionClosed:
                    pass

        sender = threading.Thread(target=flood, daemon=True)
        sender.start()
        try:
            beside = latencies(port)
        finally:
            stop.set()
        self.report("flood", alone, beside)
        assert statistics.median(beside) < 250.0

    def test_expensive_questions_are_rationed(self):
        """Sixteen visitors ask for 50 ms each, as fast as they can; another one's millisecond goes on."""

        def answer(text):
            end = time.thread_time() + (0.05 if text == "dear" else 0.001)
            while time.thread_time() < end:
                sum(range(100))
            return text

        stop = threading.Event()

        def insist(port):
            with opened(port) as client:
                while not stop.is_set():
                    client.send("dear")
                    client.recv(timeout=60)

        with serving(answer, Limits()) as port:
            alone = latencies(port, message="cheap")
            threads = [threading.Thread(target=insist, args=(port,)) for _ in range(16)]
            for thread in threads:
                thread.start()
            try:
                time.sleep(1.0)
                beside = latencies(port, message="cheap")
            finally:
                stop.set()
                for thread in threads:
                    thread.join(30)
        self.report("expensive", alone, beside)
        assert statistics.median(beside) < 250.0

    def test_a_reader_who_does_not_read_is_dropped(self):
        limits = Limits(sessions=1, patience=0.5)
        with serving(lambda _: "x" * 8_000_000, limits) as port, socket.create_connection(("127.0.0.1", port)) as line:
            line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            shake(line, port)
            send_text(line, b"more")
            time.sleep(1.5)
            with opened(port) as another:
                another.send("more")
                assert len(another.recv(timeout=10)) == 8_000_000

    def test_pings_whose_answers_are_not_read_end_the_line(self):
        with serving() as port, socket.create_connection(("127.0.0.1", port)) as line:
            line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            shake(line, port)
            ping = bytes([0x89, 0x80 | 125]) + bytes(4) + bytes(125)
            line.settimeout(10)
            with pytest.raises(OSError):  # noqa: PT012
                for _ in range(2000):
                    line.sendall(ping * 100)

    def test_a_request_that_never_comes_is_not_waited_for(self):
        with serving(limits=Limits(patience=0.3)) as port, socket.create_connection(("127.0.0.1", port)) as line:
            line.sendall(b"GET / HTTP/1.1\r\nHost: 127")
            line.settimeout(10)
            assert drained(line) == 0

    def test_a_page_of_headers_is_refused(self, port):
        with socket.create_connection(("127.0.0.1", port)) as line:
            line.sendall(b"GET / HTTP/1.1\r\nX: " + b"x" * 60000)
            line.settimeout(10)
            assert line.recv(100).startswith(b"HTTP/1.1 400")


def shake(line, port):
    """Open a WebSocket by hand."""
    line.sendall(
        f"GET /session HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nOrigin: http://127.0.0.1:{port}\r\nUpgrade: websocket\r\n"
        "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n".encode()
    )
    head = b""
    while not head.endswith(b"\r\n\r\n"):
        head += line.recv(1)
    assert head.startswith(b"HTTP/1.1 101")


def send_text(line, text):
    """A short text frame, masked with zeros."""
    line.sendall(bytes([0x81, 0x80 | len(text)]) + bytes(4) + text)


def drained(line):
    """How many bytes come until the other side closes."""
    count = 0
    while True:
        try:
            piece = line.recv(65536)
        except ConnectionResetError:
            return count
        if not piece:
            return count
        count += len(piece)
