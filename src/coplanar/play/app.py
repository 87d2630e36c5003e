"""``coplanar play``: the server on a socket of its own, from its address to Ctrl-C."""

from __future__ import annotations

import base64
import gc
import json
import os
import socket
import sys
import threading
import webbrowser
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import uvicorn
from starlette.types import ASGIApp

from coplanar.errors import InvalidValue
from coplanar.play.controls import State
from coplanar.play.doors import Doors, is_local
from coplanar.play.limits import Limits
from coplanar.play.scenarios import opened
from coplanar.play.server import application
from coplanar.play.session import Session
from coplanar.play.wire import PromptHttp, PromptSocket

if TYPE_CHECKING:
    from coplanar.scenarios import Scenario

SWITCH = 0.001  # [s] how long a computing thread keeps the interpreter from the event loop


def play(
    scenario: Scenario | str | Path | None = None,
    *,
    host: str = "127.0.0.1",
    port: int = 0,
    browser: bool = True,
    limits: Limits | None = None,
    say: Callable[[str], object] | None = None,
) -> None:
    """Serve the playground until Ctrl-C.

    Args:
        scenario: What the page shows first: a scenario, its file, or its name in the catalog; the Arm tab if None.
        host: The address to listen at; other machines reach it only if this is not a loopback address.
        port: The port; any free one for 0.
        browser: Whether to open the page.
        limits: What one browser may ask for.
        say: Takes sentences for the user; standard output if None.

    Raises:
        InvalidValue: If nothing can listen at that address and port.
        InvalidInput: If the playground cannot show the scenario.
    """
    say, limits = say or _say, limits or Limits()
    fragment = "" if scenario is None else fragment_of(*_opened(scenario))
    listener = _listener(host, port)
    address = _address(listener, host) + fragment
    session = Session()
    app = application(session.answer, Doors.of(host), limits)
    server = Playground(settings(app, limits), partial(_welcome, address, host, browser, say))
    switch = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH)
    threading.Thread(target=_warm, args=(session,), daemon=True).start()
    try:
        server.run(sockets=[listener])
    except KeyboardInterrupt:
        say("Stopped.")
    finally:
        gc.unfreeze()
        sys.setswitchinterval(switch)
        listener.close()


def _warm(session: Session) -> None:
    """Answer everything once; what is there then stays, and the collector need not look through it between answers."""
    session.warm()
    gc.collect()
    gc.freeze()


class Playground(uvicorn.Server):
    """A server that says so when it listens."""

    def __init__(self, config: uvicorn.Config, ready: Callable[[], None]) -> None:
        super().__init__(config)
        self.ready = ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Listen, then call ``ready``."""
        await super().startup(sockets)
        self.ready()


def fragment_of(tab: str, state: State) -> str:
    """The end of a link to a tab in a state, as the page writes it.

    Example:
        >>> fragment_of("arm", {"l1": 2.0})
        '#arm=eyJsMSI6Mi4wfQ'
    """
    code = base64.urlsafe_b64encode(json.dumps(state, separators=(",", ":")).encode())
    return f"#{tab}={code.decode().rstrip('=')}"


def _opened(scenario: Scenario | str | Path) -> tuple[str, State]:
    from coplanar.scenarios import load

    return opened(load(scenario) if isinstance(scenario, str | Path) else scenario)


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
