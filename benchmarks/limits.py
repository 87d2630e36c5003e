"""What this machine can do: memory traffic, and what a row of each primitive costs; measured in the same run."""

from __future__ import annotations

import struct
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from coplanar.engine import atan2, evaluator, exp, log1p, sincos, sqrt

STREAM_ROWS = 4_000_000  # three arrays of 32 MB: no cache holds them
CACHE_ROWS = 8192  # three arrays of 64 KB: the second-level cache holds them


def triad(b: Any, c: Any, scale: Any) -> Any:
    """B + scale c: the classical measure of memory traffic."""
    return b + scale * c


def only_sincos(x: Any, y: Any) -> Any:
    """Sine plus cosine of an angle."""
    s, c = sincos(x)
    return s + c * y


def only_atan2(x: Any, y: Any) -> Any:
    """Angle of a direction."""
    return atan2(x, y)


def only_sqrt(x: Any, y: Any) -> Any:
    """A root and a quotient."""
    return sqrt(x * x + y * y) / (1.0 + y * y)


def only_exp(x: Any, y: Any) -> Any:
    """An exponential."""
    return exp(x) * y


def only_log(x: Any, y: Any) -> Any:
    """A logarithm."""
    return log1p(x * x) * y


@dataclass(frozen=True, slots=True)
class Limits:
    """What was measured of the machine.

    Attributes:
        bandwidth: Memory traffic by number of threads, write-allocate included [B/ns].
        block: A call of each primitive on ``CACHE_ROWS`` rows, one thread [ns].
        empty: The same call on next to no rows [ns].
        call: One call of a C function with six Python floats [ns].
    """

    bandwidth: dict[int, float]
    block: dict[str, float]
    empty: dict[str, float]
    call: float

    @property
    def cost(self) -> dict[str, float]:
        """Nanoseconds of a row of each primitive on one thread: what more rows take, without the price of a call."""
        return {name: (ns - self.empty[name]) / CACHE_ROWS for name, ns in self.block.items()}

    def floor(self, threads: int, *, read: int, written: int, **primitives: float) -> float:
        """The larger of the traffic and the arithmetic of a row [ns].

        Args:
            threads: How many threads share the work.
            read: Numbers of 8 bytes that are read.
            written: Numbers that are written; each is read into the cache first.
            **primitives: How many of each.
        """
        traffic = 8 * (read + 2 * written) / self.bandwidth[threads]
        arithmetic = sum(count * self.cost[name] for name, count in primitives.items()) / threads
        return max(traffic, arithmetic)


def machine_limits(before: Limits | None = None) -> Limits:
    """Measure them, and keep the best of this and of before: others may be at work on the machine."""
    now = Limits(_bandwidths(), *_costs(), _call())
    if before is None:
        return now
    return Limits(
        {n: max(rate, before.bandwidth[n]) for n, rate in now.bandwidth.items()},
        {name: min(ns, before.block[name]) for name, ns in now.block.items()},
        {name: min(ns, before.empty[name]) for name, ns in now.empty.items()},
        min(now.call, before.call),
    )


def _bandwidths() -> dict[int, float]:
    from benchmarks.measure import threads

    b, c = np.linspace(0.0, 1.0, STREAM_ROWS), np.linspace(1.0, 2.0, STREAM_ROWS)
    out, stream = (np.empty(STREAM_ROWS),), evaluator(triad)
    rates: dict[int, float] = {}
    for count in (1, 2):
        with threads(count):
            ns = _fastest(lambda: stream.on_compiled(b, c, 3.0, out=out), 1, 5) / STREAM_ROWS
        rates[count] = max(32.0 / ns, rates.get(1, 0.0))  # the second core may be busy with something else
    return rates


def _costs() -> tuple[dict[str, float], dict[str, float]]:
    """A call on a block of rows in cache, and on next to none, for each primitive."""
    from benchmarks.measure import threads

    x, y = np.linspace(-3.0, 3.0, CACHE_ROWS), np.linspace(1.0, 2.0, CACHE_ROWS)
    out, short = (np.empty(CACHE_ROWS),), (np.empty(8),)
    block: dict[str, float] = {}
    empty: dict[str, float] = {}
    with threads(1):
        for law in (only_sincos, only_atan2, only_sqrt, only_exp, only_log):
            run, name = evaluator(law).on_compiled, law.__name__.removeprefix("only_")
            block[name] = _fastest(partial(run, x, y, out=out), 5, 40)
            empty[name] = _fastest(partial(run, x[:8], y[:8], out=short), 5, 40)
    return block, empty


def _call() -> float:
    pack = struct.Struct("6d").pack
    return _fastest(lambda: pack(1.0, 2.0, 3.0, 0.1, 0.2, 0.3), 5000, 10)


def _fastest(call: Callable[[], Any], calls: int, repeats: int) -> float:
    """The fastest repeat [ns a call]: a limit is what the machine can do when nobody else is at it."""
    call()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        for _ in range(calls):
            call()
        times.append((time.perf_counter() - start) / calls * 1e9)
    return min(times)
