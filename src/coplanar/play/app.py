"""``coplanar play``: the server on a socket of its own, from its address to Ctrl-C."""

from __future__ import annotations

import os
import socket
import sys
import threading
import webbrowser
from collections.abc import Callable
from functools import partial

import uvicorn
from starlette.types import ASGIApp

from coplanar.errors import InvalidValue
from coplanar.play.doors import Doors, is_local
from coplanar.play.limits import Limits
from coplanar.play.server import application
from coplanar.play.session import Session
from coplanar.play.wire import PromptHttp, PromptSocket

SWITCH = 0.001  # [s] how long a computing thread keeps the interpreter from the event loop


def play(
    *,
    host: str = "127.0.0.1",
    port: int = 0,
    browser: bool = True,
    fragment: str = "",
    limits: Limits | None = None,
    say: Callable[[str], object] | None = None,
) -> None:
    """Serve the playground until Ctrl-C.

    Args:
        host: The address to listen at; other machines reach it only if this is not a loopback address.
        port: The port; any free one for 0.
        browser: Whether to open the page.
        fragment: What the page shows first: the part of a share link after ``#``.
        limits: What one browser may ask for.
        say: Takes sentences for the user; standard output if None.

    Raises:
        InvalidValue: If nothing can listen at that address and port.
    """
    say, limits = say or _say, limits or Limits()
    listener = _listener(host, port)
    address = _address(listener, host) + (f"#{fragment}" if fragment else "")
    session = Session()
    app = application(session.answer, Doors.of(host), limits)
    server = Playground(settings(app, limits), partial(_welcome, address, host, browser, say))
    switch = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH)
    threading.Thread(target=session.warm, daemon=True).start()
    try:
        server.run(sockets=[listener])
    except KeyboardInterrupt:
        say("Stopped.")
    finally:
        sys.setswitchinterval(switch)
        listener.close()


class Playground(uvicorn.Server):
    """A server that says so when it listens."""

    def __init__(self, config: uvicorn.Config, ready: Callable[[], None]) -> None:
        super().__init__(config)
        self.ready = ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Listen, then call ``ready``."""
        await super().startup(sockets)
        self.ready()


def settings(app: ASGIApp, limits: Limits) -> uvicorn.Config:
    """How uvicorn serves an application within the limits: no logs, no compression, nothing waited for without end."""
    return uvicorn.Config(
        app,
        http=partial(PromptHttp, patience=limits.patience),  # type: ignore[arg-type]
        ws=partial(PromptSocket, patience=limits.patience),  # type: ignore[arg-type]
        loop="asyncio",
        lifespan="off",
        log_config=None,
        access_log=False,
        server_header=False,
        proxy_headers=False,
        ws_max_size=limits.message_bytes,
        ws_per_message_deflate=False,
        h11_max_incomplete_event_size=16384,
        timeout_graceful_shutdown=max(1, round(limits.farewell)),
    )


def _listener(host: str, port: int) -> socket.socket:
    try:
        family, kind, protocol, _, place = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
        listener = socket.socket(family, kind, protocol)
    except (OSError, OverflowError) as error:
        raise InvalidValue("host", host, "an address of this machine", str(error)) from None
    try:
        if os.name == "posix":
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(place)
    except OSError as error:
        listener.close()
        remedy = f"{error.strerror or error}; --port 0 takes any free port"
        raise InvalidValue("host and port", f"{host}:{port}", "a free port of this machine", remedy) from None
    return listener


def _address(listener: socket.socket, host: str) -> str:
    port = listener.getsockname()[1]
    if host in ("0.0.0.0", "::"):
        host = "localhost"
    return f"http://[{host}]:{port}/" if ":" in host else f"http://{host}:{port}/"


def _welcome(address: str, host: str, browser: bool, say: Callable[[str], object]) -> None:
    say(f"The playground is at {address}")
    if not is_local(host):
        say(
            f"It listens at {host}: everybody who reaches this machine can open it, unencrypted and without a password."
        )
        say("Nobody can read files or run code through it, but its visitors share this machine's processor.")
    say("Ctrl-C stops it.")
    if browser and _has_screen():
        threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()


def _has_screen() -> bool:
    """Whether a browser can show itself: without a screen, one that runs in the terminal would take it over."""
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def _say(sentence: str) -> None:
    sys.stdout.write(sentence + "\n")
    sys.stdout.flush()
