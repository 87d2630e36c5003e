"""The server: a fixed list of files, and one WebSocket whose answers are computed off the event loop.

A connection has one message under way and one waiting; a newer one takes the place of the one that waits. Reading
stops where the sender is ahead of its rate, so a flood stays in the sender's own socket. Computing is rationed by
processor time: who asks for more than a share waits, and of those who wait whoever has used least goes first.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp
from starlette.websockets import WebSocket, WebSocketDisconnect

from coplanar.play.doors import Doors, Guarded
from coplanar.play.files import File, files
from coplanar.play.limits import Allowance, Limits, Turns, Use

Answer = Callable[[str], str]

NOT_TEXT, IDLE, FULL = 1003, 4000, 1013


def application(answer: Answer, doors: Doors, limits: Limits) -> ASGIApp:
    """The ASGI application of the playground.

    Args:
        answer: Answers a message: text in, text out, never raising; called from several threads.
        doors: The names that the server goes by.
        limits: The bounds.
    """
    server = Server(answer, limits)
    routes = [Route(path, _sender(file), methods=["GET"]) for path, file in files().items()]
    return Guarded(Starlette(routes=[*routes, WebSocketRoute("/session", server.connect)]), doors)


def _sender(file: File) -> Callable[[Request], Response]:
    async def send(_: Request) -> Response:
        return Response(file.content, media_type=file.media_type)

    return send  # type: ignore[return-value]


@dataclass(slots=True)
class Server:
    """The open connections and the threads that they share."""

    answer: Answer
    limits: Limits
    open: int = 0
    pool: ThreadPoolExecutor = field(init=False)
    turns: Turns = field(init=False)

    def __post_init__(self) -> None:
        self.pool = ThreadPoolExecutor(self.limits.workers, thread_name_prefix="coplanar-play")
        self.turns = Turns(self.limits.workers)

    async def connect(self, socket: WebSocket) -> None:
        """Serve one WebSocket until it closes."""
        await socket.accept()
        if self.open >= self.limits.sessions:
            await socket.close(FULL, f"{self.open} pages are open already; close one of them")
            return
        self.open += 1
        connection = Connection(socket, self)
        try:
            await connection.serve()
        finally:
            await connection.settle()
            self.open -= 1


@dataclass(slots=True)
class Connection:
    """One browser: what it asked last, what is being computed for it, and what it may still spend."""

    socket: WebSocket
    server: Server
    newest: str = ""
    arrived: asyncio.Event = field(default_factory=asyncio.Event)
    computing: asyncio.Future[tuple[str, float]] | None = None

    async def serve(self) -> None:
        """Read and answer until either ends."""
        tasks = {asyncio.create_task(self._read()), asyncio.create_task(self._reply())}
        try:
            ended, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
        for task in ended:
            with suppress(WebSocketDisconnect):
                task.result()

    async def settle(self) -> None:
        """Wait for the computation that nobody waits for any more: until then it counts as a connection."""
        if self.computing is not None:
            await asyncio.wait([self.computing])

    async def _read(self) -> None:
        limits = self.server.limits
        messages = Allowance(limits.rate, limits.burst)
        while True:
            try:
                async with asyncio.timeout(limits.idle):
                    message = await self.socket.receive()
            except TimeoutError:
                await self.socket.close(IDLE, "nothing was asked for a long time")
                return
            if message["type"] == "websocket.disconnect":
                return
            text = message.get("text")
            if text is None:
                await self.socket.close(NOT_TEXT, "messages are text")
                return
            self.newest = text
            self.arrived.set()
            await asyncio.sleep(messages.spend(1.0))

    async def _reply(self) -> None:
        server, loop = self.server, asyncio.get_running_loop()
        processor, use = Allowance(server.limits.share, server.limits.reserve), Use()
        while True:
            await self.arrived.wait()
            used = use.add(0.0)
            await server.turns.take(used)
            self.arrived.clear()
            self.computing = loop.run_in_executor(server.pool, _timed, server.answer, self.newest)
            self.computing.add_done_callback(partial(_give, server.turns, used))
            text, seconds = await asyncio.shield(self.computing)
            use.add(seconds)
            await self.socket.send_text(text)
            await asyncio.sleep(processor.spend(seconds))


def _give(turns: Turns, used: float, _: object) -> None:
    turns.give(used)


def _timed(answer: Answer, text: str) -> tuple[str, float]:
    start = time.thread_time()
    reply = answer(text)
    return reply, time.thread_time() - start
