"""Cost against size: the text, the compiled loop, what the engine picks, and what the object adds."""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from benchmarks.measure import Effort
from benchmarks.workloads import arcs, inverse, segments
from coplanar import Arm, Displacement, Pose, Segment
from coplanar.engine import evaluator
from coplanar.laws import arms, motion, se2

RESOLVED = 1.25  # a ratio below this is within the noise of such a measurement
LONGEST = {False: 2.0, True: 0.1}  # [s] of a single call; beyond, the size is left out


@dataclass(frozen=True, slots=True)
class Row:
    """One law at one size: seconds a call in every round by name, none where it was left out."""

    law: str
    rows: int
    rounds: dict[str, list[float]]

    @property
    def seconds(self) -> dict[str, float]:
        """Median of the rounds, NaN where it was left out."""
        return {name: statistics.median(times) if times else math.nan for name, times in self.rounds.items()}

    @property
    def excess(self) -> float:
        """What the engine's pick takes over the faster of text and compiled: the median of the ratios by round."""
        return statistics.median(self._ratios())

    @property
    def is_slower(self) -> bool:
        """Whether the pick is slower than both, in every round: what is not so in every round is noise."""
        return self.excess > RESOLVED and min(self._ratios()) > 1.0

    def _ratios(self) -> list[float]:
        others = [times for name, times in self.rounds.items() if name in ("text", "compiled") and times]
        return [
            picked / min(times) for picked, times in zip(self.rounds["picked"], zip(*others, strict=True), strict=True)
        ]


def cost_against_size(effort: Effort) -> list[Row]:
    """Every law at 1, 10, ... rows."""
    table = []
    for name, prepare in (("arc", _arc), ("2R inverse", _inverse), ("segment", _segment)):
        known: dict[str, float] = {}
        for power in range(6 if effort.quick else 8):
            calls = prepare(10**power)
            small = {k: c for k, c in calls.items() if not 10.0 * known.get(k, 0.0) > LONGEST[effort.quick]}
            rounds = _rounds(small, effort)
            table.append(Row(name, 10**power, {k: rounds.get(k, []) for k in calls}))
            known = table[-1].seconds
    return table


def _rounds(calls: dict[str, Callable[[], Any]], effort: Effort) -> dict[str, list[float]]:
    """Interleaved."""
    counts = {}
    for name, call in calls.items():
        call()
        start = time.perf_counter()
        call()
        counts[name] = max(1, min(2000, round(0.15 * effort.slice / (time.perf_counter() - start))))
    rounds: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(2 * effort.rounds - 1):
        for name, call in calls.items():
            start = time.perf_counter()
            for _ in range(counts[name]):
                call()
            rounds[name].append((time.perf_counter() - start) / counts[name])
    return rounds


def _ways(law: Any, arguments: Any, whole: Callable[[], Any]) -> dict[str, Callable[[], Any]]:
    run = evaluator(law)
    return {
        "text": lambda: run.on_text(*arguments),
        "compiled": lambda: run.on_compiled(*arguments),
        "picked": lambda: run(*arguments),
        "object": whole,
    }


def _arc(rows: int) -> dict[str, Callable[[], Any]]:
    data = arcs.steps(rows)
    poses, increments = Pose(*data[:3]), Displacement(*data[3:])
    return _ways(se2.step, data, lambda: poses.step(increments))


def _inverse(rows: int) -> dict[str, Callable[[], Any]]:
    data = inverse.targets(rows)
    arm, points = Arm((inverse.L1, inverse.L2)), np.column_stack(data)
    return _ways(arms.two_link_inverse, (*data, inverse.L1, inverse.L2, 1.0), lambda: arm.inverse(points))


def _segment(rows: int) -> dict[str, Callable[[], Any]]:
    data = segments.moves(rows)
    whole, start = Segment(*data[3:7], duration=data.t), Pose(*data[:3])
    return _ways(motion.segment, data, lambda: whole.end(start))
