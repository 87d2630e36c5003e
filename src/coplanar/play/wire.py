"""Connections that nobody can hold open for nothing: uvicorn's two protocols with their waiting bounded."""

from __future__ import annotations

import asyncio
from typing import Any

from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol


class PromptHttp(H11Protocol):
    """HTTP whose first request has to be complete within ``patience`` [s]."""

    def __init__(self, *args: Any, patience: float, **settings: Any) -> None:
        super().__init__(*args, **settings)
        self.patience = patience

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Start the clock."""
        super().connection_made(transport)
        self.loop.call_later(self.patience, self._expect_request)

    def _expect_request(self) -> None:
        if self.scope is None:
            self.transport.abort()


class PromptSocket(WebSocketsSansIOProtocol):
    """A WebSocket whose peer has to take what it asked for within ``patience`` [s]."""

    def __init__(self, *args: Any, patience: float, **settings: Any) -> None:
        super().__init__(*args, **settings)
        self.patience = patience
        self.deadline: asyncio.TimerHandle | None = None

    def pause_writing(self) -> None:
        """The peer does not read: start the clock."""
        super().pause_writing()
        self.deadline = self.loop.call_later(self.patience, self.transport.abort)

    def resume_writing(self) -> None:
        """The peer reads again."""
        super().resume_writing()
        if self.deadline is not None:
            self.deadline.cancel()

    def handle_ping(self) -> None:
        """Answer a ping, unless the peer has not read the answers to those before."""
        if self.writable.is_set():
            super().handle_ping()
        else:
            self.transport.abort()

    def shutdown(self) -> None:
        """Say goodbye; wait for nobody who does not read."""
        super().shutdown()
        if not self.writable.is_set():
            self.transport.abort()
