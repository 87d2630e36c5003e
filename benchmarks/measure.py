"""How a workload is measured: first whether the answers agree, then round after round, each contender in turn."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from itertools import repeat
from typing import Any

import numpy as np

from benchmarks.limits import Limits


def table(columns: Any) -> np.ndarray:
    """Columns, or a pose, as an array (rows, columns)."""
    parts = columns.parts if hasattr(columns, "parts") else columns
    return np.column_stack(np.broadcast_arrays(*(np.atleast_1d(np.asarray(p, float)) for p in parts)))


@dataclass(frozen=True, slots=True)
class Contender:
    """Something that does a workload.

    Attributes:
        name: What it is called in the table.
        call: Does its rows once.
        rows: How many rows that is; a slow peer does the first few of the same inputs.
        read: The answer of ``call`` as an array (rows, columns).
        ours: Whether it is Coplanar.
        threads: How many threads it may use; None where it runs as it comes.
        slack: How far its answers may lie from ours and still count as the same work; the workload's where None.
        note: What is different about it.
        counts: Whether it may be the best peer; one that loses digits is timed all the same.
    """

    name: str
    call: Callable[[], Any]
    rows: int
    read: Callable[[Any], np.ndarray] = table
    ours: bool = False
    threads: int | None = None
    slack: float | None = None
    note: str = ""
    counts: bool = True


Builder = Callable[[Any], Contender]


@dataclass(frozen=True, slots=True)
class Workload:
    """One line of the comparison.

    Attributes:
        name: For the command line.
        title: What is done.
        per: What a time is divided by.
        prepare: Makes the inputs of so many rows.
        rows: Full size and the size of a quick run.
        ours: Builders of Coplanar's contenders.
        peers: Names and builders of the others; a builder that cannot import its peer makes it absent.
        floor: The limit [ns] from what was measured of the machine, by number of threads.
        goal: What is aimed at [ns], by number of threads.
        agree: How far two answers may lie apart [m, rad].
        truth: The first rows of the answer by mpmath.
        sample: How many rows the truth is asked for, full and quick.
        about: What was measured, in words.
    """

    name: str
    title: str
    per: str
    prepare: Callable[[int], Any]
    rows: tuple[int, int]
    ours: Sequence[Builder]
    peers: Mapping[str, Builder]
    floor: Callable[[Limits, int, Any], float]
    goal: Mapping[int, float]
    agree: float
    truth: Callable[[Any, int], np.ndarray] | None = None
    sample: tuple[int, int] = (200, 20)
    threads: tuple[int | None, ...] = (1, 2)
    about: str = ""


@dataclass(slots=True)
class Timing:
    """What came out for one contender.

    Attributes:
        contender: Who.
        difference: Worst difference from Coplanar's first contender on the common rows; 0 for that one.
        error: Worst absolute error against mpmath; None where there is no truth.
        rounds: Time per row of every round [ns]; empty where it disagrees.
        problem: Why it was not timed.
    """

    contender: Contender
    difference: float = 0.0
    error: float | None = None
    rounds: list[float] = field(default_factory=list)
    problem: str = ""

    @property
    def median(self) -> float:
        """Median of the rounds [ns]."""
        return statistics.median(self.rounds) if self.rounds else float("nan")


@dataclass(slots=True)
class Result:
    """A measured workload: its inputs, the timings, and peers that are absent with the reason."""

    workload: Workload
    data: Any
    timings: list[Timing]
    absent: dict[str, str]

    def limit(self, limits: Limits, count: int | None) -> float:
        """The limit on so many threads [ns]."""
        return self.workload.floor(limits, count or 1, self.data)

    @property
    def headline(self) -> list[Timing]:
        """Coplanar's first contender, the public way, on each number of threads."""
        first = self.timings[0].contender.name
        return [t for t in self.timings if t.contender.ours and t.contender.name == first]

    @property
    def best_peer(self) -> Timing | None:
        """The fastest of the others whose answers agree."""
        timed = [t for t in self.timings if t.rounds and not t.contender.ours and t.contender.counts]
        return min(timed, key=lambda t: t.median, default=None)


@dataclass(frozen=True, slots=True)
class Effort:
    """How long to measure: rounds, the least time of one contender in a round [s], whether the run is quick."""

    rounds: int
    slice: float
    quick: bool


FULL = Effort(5, 0.02, False)
QUICK = Effort(5, 0.002, True)


def ratio(a: Timing, b: Timing) -> float:
    """Median over the rounds of how many times longer a takes than b."""
    return statistics.median(p / q for p, q in zip(a.rounds, b.rounds, strict=True))


def measure(workload: Workload, effort: Effort) -> Result:
    """Build, compare, time."""
    data = workload.prepare(workload.rows[effort.quick])
    contenders, absent = _build(workload, data)
    timings = _compare(workload, contenders, data, effort)
    _time([t for t in timings if not t.problem], effort)
    return Result(workload, data, timings, absent)


def _build(workload: Workload, data: Any) -> tuple[list[Contender], dict[str, str]]:
    ours = [replace(builder(data), ours=True) for builder in workload.ours]
    contenders = [
        replace(c, threads=n) for c in ours for n in (workload.threads if c.threads is None else (c.threads,))
    ]
    absent: dict[str, str] = {}
    for name, builder in workload.peers.items():
        try:
            contenders.append(builder(data))
        except Exception as reason:  # a peer may fail in any way of its own; the table says how
            absent[name] = f"{type(reason).__name__}: {reason}".splitlines()[0][:160]
    return contenders, absent


def _compare(workload: Workload, contenders: list[Contender], data: Any, effort: Effort) -> list[Timing]:
    sample = workload.sample[effort.quick]
    truth = workload.truth(data, sample) if workload.truth else None
    reference: np.ndarray | None = None
    timings = []
    for contender in contenders:
        timing = Timing(contender)
        timings.append(timing)
        try:
            with threads(contender.threads):
                answer = contender.read(contender.call())
        except Exception as reason:  # likewise
            timing.problem = f"{type(reason).__name__}: {reason}".splitlines()[0][:160]
            continue
        reference = answer if reference is None else reference
        timing.difference = _apart(answer, reference)
        timing.error = None if truth is None else _apart(answer, truth)
        slack = workload.agree if contender.slack is None else contender.slack
        if not timing.difference <= slack:
            timing.problem = f"disagrees by {timing.difference:.1e}, allowed {slack:.0e}: not timed"
    return timings


def _apart(a: np.ndarray, b: np.ndarray) -> float:
    """Worst difference on the rows and columns that both have; NaN is as far as it gets."""
    rows, columns = min(len(a), len(b)), min(a.shape[1], b.shape[1])
    worst = float(np.abs(a[:rows, :columns] - b[:rows, :columns]).max(initial=0.0))
    return worst if worst == worst else float("inf")


def _time(timings: list[Timing], effort: Effort) -> None:
    """Rounds in which every contender has its turn; the order rotates."""
    counts = [_calls(t.contender, effort.slice) for t in timings]
    for number in range(effort.rounds):
        turn = list(range(len(timings)))
        shift = number % max(1, len(turn))
        for k in turn[shift:] + turn[:shift]:
            contender = timings[k].contender
            seconds = _elapsed(contender, counts[k])
            timings[k].rounds.append(seconds / (counts[k] * contender.rows) * 1e9)


def _calls(contender: Contender, slice_: float) -> int:
    once = _elapsed(contender, 1)
    if once > slice_:
        return 1
    once = _elapsed(contender, 10) / 10
    return max(1, round(slice_ / once))


def _elapsed(contender: Contender, calls: int) -> float:
    call = contender.call
    with threads(contender.threads):
        call()  # what the contender before left in the caches, the heap and the threads counts for nobody
        start = time.perf_counter()
        for _ in repeat(None, calls):
            call()
        return time.perf_counter() - start


@contextmanager
def threads(count: int | None) -> Iterator[None]:
    """Compiled loops use so many threads in this block; None leaves them as they are."""
    if count is None:
        yield
        return
    import numba

    before = numba.get_num_threads()
    numba.set_num_threads(min(count, numba.config.NUMBA_NUM_THREADS))
    try:
        yield
    finally:
        numba.set_num_threads(before)
