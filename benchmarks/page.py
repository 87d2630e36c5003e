"""The tables: the same lines for the terminal and for the page of the documentation."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from benchmarks.features import Level
from benchmarks.fresh import Start
from benchmarks.limits import Limits
from benchmarks.measure import Result, Timing, ratio
from benchmarks.memory import Peak
from benchmarks.sizes import RESOLVED, Row
from benchmarks.ulps import Ulps

LEVEL = 1.1  # two medians nearer than this are level


@dataclass(slots=True)
class Findings:
    """All that was measured."""

    machine: list[tuple[str, str]]
    peers: dict[str, str]
    limits: Limits
    quick: bool
    results: list[Result] = field(default_factory=list)
    sizes: list[Row] = field(default_factory=list)
    imports: list[Start] = field(default_factory=list)
    calls: list[Start] = field(default_factory=list)
    memory: list[Peak] = field(default_factory=list)
    ulps: list[Ulps] = field(default_factory=list)
    levels: list[Level] = field(default_factory=list)


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    """A Markdown table whose columns stand one below another in a terminal, too."""
    lines = [list(head), *map(list, rows)]
    widths = [max(len(line[k]) for line in lines) for k in range(len(head))]
    text = ["| " + " | ".join(cell.ljust(w) for cell, w in zip(line, widths, strict=True)) + " |" for line in lines]
    return [text[0], "|" + "|".join("-" * (w + 2) for w in widths) + "|", *text[1:], ""]


def duration(nanoseconds: float) -> str:
    """With a unit that fits."""
    if not math.isfinite(nanoseconds):
        return "—"
    for size, unit in ((1e9, "s"), (1e6, "ms"), (1e3, "µs")):
        if nanoseconds >= size:
            return f"{nanoseconds / size:.3g} {unit}"
    return f"{nanoseconds:.3g} ns"


def times(value: float) -> str:
    """How many times."""
    return "—" if not math.isfinite(value) else f"{value:.2g}" if value < 100 else f"{value:.0f}"


def error(value: float | None) -> str:
    """An absolute error."""
    return "—" if value is None or not math.isfinite(value) else f"{value:.1e}"


def summary(findings: Findings) -> list[str]:
    """One line a workload: Coplanar's public way, the best peer, the limit, the goal, the errors."""
    head = ("workload", "per", "Coplanar 1 thread", "2 threads", "best peer", "its time", "peer/Coplanar", "limit",
            "Coplanar/limit", "goal 1 / 2 threads", "worst error", "peer's")  # fmt: skip
    return table(head, [_summary_row(result, findings.limits) for result in findings.results])


def _summary_row(result: Result, limits: Limits) -> list[str]:
    work, peer, ours = result.workload, result.best_peer, [t for t in result.headline if t.rounds]
    goal = " / ".join(duration(ns) for ns in work.goal.values()) or "—"
    if not ours:
        return [work.title, work.per, *["—"] * 7, goal, result.timings[0].problem, "—"]
    best = min(ours, key=lambda t: t.median)
    limit = result.limit(limits, best.contender.threads)
    lead = ratio(peer, best) if peer else float("nan")
    second = duration(ours[1].median) if len(ours) > 1 else "—"
    beside = [peer.contender.name, duration(peer.median)] if peer else ["none", "—"]
    compared = [times(lead), duration(limit), times(best.median / limit), goal]
    return [work.title, work.per, duration(ours[0].median), second, *beside, *compared, error(best.error),
            error(peer.error if peer else None)]  # fmt: skip


def detail(result: Result, limits: Limits) -> list[str]:
    """Everybody who took part in a workload."""
    head = ("contender", "threads", f"median a {result.workload.per}", "lowest ... highest", "over Coplanar",
            "over limit", "differs by", "worst error")  # fmt: skip
    rows = [_detail_row(result, timing, limits) for timing in result.timings]
    rows += [[name, "", "absent", reason, "", "", "", ""] for name, reason in result.absent.items()]
    return table(head, rows)


def _detail_row(result: Result, timing: Timing, limits: Limits) -> list[str]:
    who, first = timing.contender, result.timings[0]
    name = f"{who.name} ({who.note})" if who.note else who.name
    threads = "own" if who.threads is None else str(who.threads)
    if timing.problem:
        return [name, threads, "not timed", timing.problem, "", "", error(timing.difference), error(timing.error)]
    spread = f"{duration(min(timing.rounds))} ... {duration(max(timing.rounds))}"
    over = times(ratio(timing, first)) if first.rounds else "—"
    limit = times(timing.median / result.limit(limits, who.threads if who.ours else 1))
    return [name, threads, duration(timing.median), spread, over, limit, error(timing.difference), error(timing.error)]


def misses(findings: Findings) -> list[str]:
    """What is slower than its goal, than the best peer, or than both evaluators."""
    lines = []
    for result in findings.results:
        ours = [t for t in result.headline if t.rounds]
        for timing, goal in zip(ours, result.workload.goal.values(), strict=False):
            if timing.median > LEVEL * goal:
                lines.append(f"- {result.workload.title}, {timing.contender.threads or 1} thread(s): "
                             f"{duration(timing.median)}, {times(timing.median / goal)} times the goal")  # fmt: skip
        peer = result.best_peer
        if ours and peer and ratio(min(ours, key=lambda t: t.median), peer) > LEVEL:
            slower = ratio(min(ours, key=lambda t: t.median), peer)
            lines.append(f"- {result.workload.title}: {times(slower)} times the time of {peer.contender.name}")
    lines += [
        f"- {row.law}, {row.rows} rows: what the engine picks takes {times(row.excess)} times the faster evaluator"
        for row in findings.sizes
        if row.is_slower
    ]
    return lines or ["- nothing"]


def sizes(findings: Findings) -> list[str]:
    """Cost against size."""
    head = ("law", "rows", "NumPy text", "compiled", "picked", "picked/faster", "public method", "a row")
    return table(head, [_size_row(row) for row in findings.sizes])


def _size_row(row: Row) -> list[str]:
    text, compiled, picked, whole = (1e9 * row.seconds[k] for k in ("text", "compiled", "picked", "object"))
    ways = [duration(text), duration(compiled), duration(picked), times(row.excess)]
    return [row.law, f"10^{len(str(row.rows)) - 1}", *ways, duration(whole), duration(whole / row.rows)]


def starts(lines: list[Start]) -> list[str]:
    """Start-up."""
    return table(("what", "median"), [[s.what, s.problem or duration(1e9 * s.seconds)] for s in lines])


def memory(findings: Findings) -> list[str]:
    """Memory."""
    head = ("call", "rows", "inputs", "outputs", "peak over inputs", "peak/outputs", "resident")
    return table(head, [
        [p.what, str(p.rows), p.problem, *[""] * 4] if p.problem else
        [p.what, str(p.rows), *(f"{v:.0f} MB" for v in (p.inputs, p.outputs, p.traced)), times(p.traced / p.outputs),
         f"{p.resident:.0f} MB"]
        for p in findings.memory
    ])  # fmt: skip


def levels(findings: Findings) -> list[str]:
    """Cost of a row by instruction set."""
    laws = next((list(level.cost) for level in findings.levels if level.cost), [])
    missing = [""] * (len(laws) - 1)
    return table(("compiled for", *laws), [
        [level.name, *([level.problem, *missing] if level.problem else map(duration, level.cost.values()))]
        for level in findings.levels
    ])  # fmt: skip


def ulps(findings: Findings) -> list[str]:
    """Accuracy of the primitives."""
    head = ("primitive", "arguments", "floats", "NumPy text", "compiled")
    return table(
        head, [[u.primitive, u.range, *(f"{v:.2f}" for v in (u.floats, u.text, u.compiled))] for u in findings.ulps]
    )


def machine(findings: Findings) -> list[str]:
    """Where it ran, and what that machine can do."""
    limits = findings.limits
    rates = ", ".join(f"{rate:.0f} GB/s on {n} thread(s)" for n, rate in limits.bandwidth.items())
    costs = ", ".join(f"{name} {ns:.2f}" for name, ns in limits.cost.items())
    rows = [
        *findings.machine,
        ("peers", ", ".join(f"{name} {version}" for name, version in findings.peers.items())),
        ("memory traffic", rates),
        ("primitives in cache", f"{costs} ns a row on one thread; sqrt counts a root and a quotient"),
        ("call of a C function", f"{limits.call:.0f} ns with six floats"),
    ]
    return [*(f"- {what}: {value}" for what, value in rows), ""]


def page(findings: Findings) -> str:
    """The page of the documentation."""
    run = "python -m benchmarks --quick" if findings.quick else "python -m benchmarks"
    lines = ["# Benchmarks", "", f"This page is written by `{run}`; no number in it is typed by hand.", ""]
    lines += [*INTRODUCTION.strip().splitlines(), "", *machine(findings)]
    lines += ["## Summary", "", *summary(findings)]
    lines += ["### Where Coplanar is behind", "", BEHIND, "", *misses(findings), ""]
    for result in findings.results:
        lines += [
            f"## {result.workload.title[0].upper()}{result.workload.title[1:]}",
            "",
            _limit_line(result, findings.limits),
            "",
        ]
        lines += detail(result, findings.limits)
    parts = (
        ("Cost against size", SIZES, sizes(findings), findings.sizes),
        ("Start-up", STARTS, [*starts(findings.imports), *starts(findings.calls)], findings.imports),
        ("Memory", MEMORY, memory(findings), findings.memory),
        ("Instruction sets", LEVELS, levels(findings), findings.levels),
        ("Accuracy of the primitives", ULPS, ulps(findings), findings.ulps),
    )
    for title, words, body, measured in parts:
        lines += [f"## {title}", "", words, "", *body] if measured else []
    return "\n".join(lines).rstrip() + "\n"


def _limit_line(result: Result, limits: Limits) -> str:
    words = (result.workload.floor.__doc__ or "").strip().splitlines()[0]
    return f"Limit on one thread: {duration(result.limit(limits, 1))}. {words}"


INTRODUCTION = """
Every workload runs beside its peers in one process on the same inputs. First the answers are compared: the worst
difference from Coplanar's is printed, and a contender whose answers disagree is not timed. Then at least five rounds
follow in which every contender has its turn, in rotating order, after a call that is not timed; a time is the median of
the rounds, a ratio the median of the ratios round by round. Compare ratios, not figures: the machine may be shared, and
its speed changes. A peer without a call for batches runs a loop over the first few of the same rows. "own" threads are
as many as the peer takes.

A limit is the larger of two floors that are measured in the same run: the memory traffic of the row (8 bytes a number,
written numbers counted twice, as a cache line is read before it is written), and the cost of the sines, arc tangents
and roots that the row cannot do without. For a single call it is the call of a C function.

Errors are absolute [m, rad], the worst over a sample against mpmath at fifty digits. One unit in the last place
of 1 m is 2.2e-16.
"""
BEHIND = "Slower than its goal, than the best peer, or than the evaluator that the engine did not pick."
SIZES = (
    "A law by the NumPy text, by the compiled loop, and by what the engine picks; then the public method, a call and a "
    "row. Where the engine switches it must not be slower than both; a ratio below "
    f"{RESOLVED} is not resolved. — stands where a call would take too long."
)
STARTS = "Each in a fresh process. Small batches never wait for a compiler; the disk cache is kept for each user."
MEMORY = (
    "A fresh process for each. Outputs are what the answer holds; the peak is the most that Python and NumPy had on "
    "top of the inputs; resident is how far the process's highest resident size rose."
)
LEVELS = (
    "The same laws compiled for one level of x86-64 after the other, a fresh process each; a row of a block in cache, "
    "one thread, without the price of the call. That the cost falls with the width of the vectors is what shows that "
    "the loops are vector code. A machine's own level also schedules for its own units."
)
ULPS = "Worst error in units of the last place of the true value, over random arguments."
