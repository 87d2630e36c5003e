"""What this machine can do: memory traffic, and what a row of each primitive costs; measured in the same run."""

from __future__ import annotations

import struct
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar.engine import atan2, evaluator, exp, log1p, sincos, sqrt

STREAM_ROWS = 4_000_000  # three arrays of 32 MB: no cache holds them
CACHE_ROWS = 8192  # three arrays of 64 KB: the second-level cache holds them


def triad(b, c, scale):
    """B + scale c: the classical measure of memory traffic."""
    return b + scale * c


def only_sincos(x, y):
    """Sine plus cosine of an angle."""
    s, c = sincos(x)
    return s + c * y


def only_atan2(x, y):
    """Angle of a direction."""
    return atan2(x, y)


def only_sqrt(x, y):
    """A root and a quotient."""
    return sqrt(x * x + y * y) / (1.0 + y * y)


def only_exp(x, y):
    """An exponential."""
    return exp(x) * y


def only_log(x, y):
    """A logarithm."""
    return log1p(x * x) * y


@dataclass(frozen=True, slots=True)
class Limits:
    """What was measured of the machine.

    Attributes:
        bandwidth: Memory traffic by number of threads, write-allocate included [B/ns].
        cost: Nanoseconds of one primitive in one lane, by name, on one thread.
        call: One call of a C function with six Python floats [ns].
    """

    bandwidth: dict[int, float]
    cost: dict[str, float]
    call: float

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


def machine_limits(quick: bool) -> Limits:
    """Measure them."""
    from benchmarks.measure import threads

    repeats = 3 if quick else 9
    bandwidth = {}
    b, c = np.linspace(0.0, 1.0, STREAM_ROWS), np.linspace(1.0, 2.0, STREAM_ROWS)
    out = (np.empty(STREAM_ROWS),)
    stream = evaluator(triad)
    for count in (1, 2):
        with threads(count):
            ns = _per_row(lambda: stream.on_compiled(b, c, 3.0, out=out), STREAM_ROWS, 1, repeats)
        bandwidth[count] = max(32.0 / ns, bandwidth.get(1, 0.0))  # the second core may be busy with something else
    with threads(1):
        laws = (only_sincos, only_atan2, only_sqrt, only_exp, only_log)
        cost = {law.__name__.removeprefix("only_"): _cost(law, repeats) for law in laws}
    pack = struct.Struct("6d").pack
    call = _per_row(lambda: pack(1.0, 2.0, 3.0, 0.1, 0.2, 0.3), 1, 20_000, repeats)
    return Limits(bandwidth, cost, call)


def _cost(law: Any, repeats: int) -> float:
    """Of a row in cache: what more rows take, so that the price of a call is not in it."""
    x, y = np.linspace(-3.0, 3.0, CACHE_ROWS), np.linspace(1.0, 2.0, CACHE_ROWS)
    out, short = (np.empty(CACHE_ROWS),), (np.empty(8),)
    run = evaluator(law)
    whole = _per_row(lambda: run.on_compiled(x, y, out=out), 1, 200, repeats)
    start = _per_row(lambda: run.on_compiled(x[:8], y[:8], out=short), 1, 200, repeats)
    return max(whole - start, 0.0) / (CACHE_ROWS - 8)


def _per_row(call: Callable[[], Any], rows: int, calls: int, repeats: int) -> float:
    call()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        for _ in range(calls):
            call()
        times.append((time.perf_counter() - start) / (calls * rows) * 1e9)
    return min(times)  # a limit is what the machine can do when nobody else is at it
