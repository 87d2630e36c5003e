"""What one browser may ask of the playground, so that it costs nothing to the others."""

from __future__ import annotations

import asyncio
import heapq
import itertools
import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Limits:
    """The bounds of a server.

    Attributes:
        sessions: Connections open at once.
        message_bytes: Longest message taken [bytes]; a longer one closes its connection.
        rate: Messages read from one connection [1/s]; more are left waiting in the sender's own socket.
        burst: Messages read at once after a pause.
        share: Computing done for one connection [s of a processor per s]; then its answers come later.
        reserve: Computing done at once after a pause [s].
        workers: Threads that compute, at least 2; who has used least goes first.
        idle: A connection that asks for nothing is closed after this time [s].
        patience: Time to send a first request, and to take an answer [s].
        farewell: Time that open connections are given when the server stops [s].
    """

    sessions: int = 64
    message_bytes: int = 65536
    rate: float = 150.0
    burst: float = 150.0
    share: float = 0.75
    reserve: float = 0.5
    workers: int = 2
    idle: float = 1800.0
    patience: float = 10.0
    farewell: float = 2.0


@dataclass(slots=True)
class Allowance:
    """A bucket that fills by ``rate`` per second up to ``most``; what is spent beyond it has to be waited for.

    Example:
        >>> clock = iter([0.0, 0.0, 0.0, 1.0]).__next__
        >>> bucket = Allowance(rate=2.0, most=3.0, clock=clock)
        >>> bucket.spend(3.0), bucket.spend(1.0), bucket.spend(1.0)
        (0.0, 0.5, 0.0)
    """

    rate: float
    most: float
    clock: Callable[[], float] = time.monotonic
    level: float = field(init=False)
    seen: float = field(init=False)

    def __post_init__(self) -> None:
        self.level, self.seen = self.most, self.clock()

    def spend(self, amount: float) -> float:
        """Take an amount out, and say how long to wait until the bucket is out of debt [s]."""
        now = self.clock()
        self.level = min(self.most, self.level + self.rate * (now - self.seen)) - amount
        self.seen = now
        return max(0.0, -self.level / self.rate)


@dataclass(slots=True)
class Use:
    """Processor time used of late [s], forgotten with a time constant ``memory`` [s].

    Example:
        >>> clock = iter([0.0, 0.0, 2.0]).__next__
        >>> use = Use(memory=2.0, clock=clock)
        >>> use.add(1.0), round(use.add(0.0), 6)
        (1.0, 0.367879)
    """

    memory: float = 2.0
    clock: Callable[[], float] = time.monotonic
    amount: float = 0.0
    seen: float = field(init=False)

    def __post_init__(self) -> None:
        self.seen = self.clock()

    def add(self, seconds: float) -> float:
        """Add what was used, and say what counts now."""
        now = self.clock()
        self.amount = self.amount * math.exp((self.seen - now) / self.memory) + seconds
        self.seen = now
        return self.amount


class Turns:
    """Slots for computing; of those who wait, whoever has used least goes first.

    The last slot is kept for somebody who has used less than half of what anybody computing has: a light visitor does
    not wait until a heavy one has finished.
    """

    def __init__(self, slots: int) -> None:
        self.free = max(2, slots)
        self.computing: list[float] = []
        self.waiting: list[tuple[float, int, asyncio.Future[None]]] = []
        self.order = itertools.count()

    async def take(self, used: float) -> None:
        """Wait for a slot; it has to be given back, with the same number."""
        turn = asyncio.get_running_loop().create_future()
        heapq.heappush(self.waiting, (used, next(self.order), turn))
        self._admit()
        try:
            await turn
        except asyncio.CancelledError:
            if turn.done() and not turn.cancelled():
                self.give(used)
            raise

    def give(self, used: float) -> None:
        """Give a slot back."""
        self.free += 1
        self.computing.remove(used)
        self._admit()

    def _admit(self) -> None:
        while self.waiting and (self.free > 1 or (self.free == 1 and self.waiting[0][0] < 0.5 * min(self.computing))):
            used, _, turn = heapq.heappop(self.waiting)
            if not turn.done():
                self.free -= 1
                self.computing.append(used)
                turn.set_result(None)
