"""Who may come in: the names under which the server is reached, and the pages that may talk to it.

A page of another site that runs in the same browser reaches 127.0.0.1 as well. It is told from our own page by two
headers that a page cannot choose: ``Host``, the name that the browser looked up (a name of somebody else that points
here is a rebinding attack), and ``Origin``, the site that the page came from.
"""

from __future__ import annotations

import ipaddress
import re
import socket
from dataclasses import dataclass

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from starlette.websockets import WebSocket

_AUTHORITY = re.compile(r"(?P<name>\[[0-9A-Fa-f:.]+\]|[A-Za-z0-9.-]+)(:[0-9]{1,5})?")

HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; "
    "connect-src 'self'; form-action 'none'; frame-ancestors 'none'; base-uri 'none'",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Cache-Control": "no-cache",
}


@dataclass(frozen=True, slots=True)
class Doors:
    """The names that the server answers to.

    Attributes:
        names: Host names and addresses, in lower case.
        any_address: Whether every numeric address is taken too (a name can be rebound, an address cannot).

    Example:
        >>> doors = Doors.of("127.0.0.1")
        >>> doors.admit("localhost:8000"), doors.admit("evil.example:8000"), doors.admit("127.0.0.1@evil.example")
        (True, False, False)
    """

    names: frozenset[str]
    any_address: bool = False

    @classmethod
    def of(cls, host: str) -> Doors:
        """The names of a server that listens at ``host``."""
        names = {host.lower(), "localhost", "127.0.0.1", "::1"}
        if is_local(host):
            return cls(frozenset(names))
        return cls(frozenset(names | {socket.gethostname().lower()}), any_address=True)

    def admit(self, authority: str | None) -> bool:
        """Whether a ``Host`` header names this server."""
        found = _AUTHORITY.fullmatch(authority or "")
        if found is None:
            return False
        name = found["name"].lower().strip("[]")
        return name in self.names or (self.any_address and _is_address(name))


def is_local(host: str) -> bool:
    """Whether only programs of this machine reach a server that listens at ``host``."""
    return host == "localhost" or (_is_address(host) and ipaddress.ip_address(host).is_loopback)


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


@dataclass(frozen=True, slots=True)
class Guarded:
    """An application behind its doors: Host and Origin are checked, and every answer carries the headers above."""

    app: ASGIApp
    doors: Doors

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request or one WebSocket."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        if refusal is None:
            await self.app(scope, receive, _with_headers(send))
        elif scope["type"] == "http":
            await PlainTextResponse(refusal, 403)(scope, receive, _with_headers(send))
        else:
            await WebSocket(scope, receive, send).send_denial_response(PlainTextResponse(refusal, 403))

    def _refusal(self, scope: Scope) -> str | None:
        headers = Headers(scope=scope)
        host, origin = headers.get("host"), headers.get("origin")
        if not self.doors.admit(host):
            return "This server does not go by that name (Host).\n"
        ours = {f"http://{host}", f"https://{host}"}
        if scope["type"] == "websocket" and origin not in ours:
            return "Only the page that this server sent may open a connection (Origin).\n"
        return None


def _with_headers(send: Send) -> Send:
    async def sending(message: Message) -> None:
        if message["type"] == "http.response.start":
            MutableHeaders(scope=message).update(HEADERS)
        await send(message)

    return sending
