"""What one browser may ask of the playground, so that it costs nothing to the others."""

from __future__ import annotations

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
        reserve: Computing done at once after a pause [s]; who has spent half of it shares one thread with others like that.
        workers: Threads that compute for everybody else.
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
    workers: int = 4
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

    def is_low(self) -> bool:
        """Whether less than half is left: only who rests comes out of that again."""
        self.spend(0.0)
        return self.level < 0.5 * self.most

    def spend(self, amount: float) -> float:
        """Take an amount out, and say how long to wait until the bucket is out of debt [s]."""
        now = self.clock()
        self.level = min(self.most, self.level + self.rate * (now - self.seen)) - amount
        self.seen = now
        return max(0.0, -self.level / self.rate)
