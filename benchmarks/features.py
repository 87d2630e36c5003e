"""Whether the loops become vector code: the same laws compiled for the levels of x86-64, from narrow to wide vectors.

Each in a fresh process with a compiler's cache of its own. A level that the processor does not have is reported so.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from benchmarks.measure import Effort
from coplanar.engine import evaluator
from coplanar.laws import arms, motion, se2

ROWS = 8192  # in cache: arithmetic, not memory
LEVELS = {
    "x86-64 (SSE2, 128 bits)": "x86-64",
    "x86-64-v2 (SSE4.2, 128 bits)": "x86-64-v2",
    "x86-64-v3 (AVX2, 256 bits)": "x86-64-v3",
    "x86-64-v4 (AVX-512)": "x86-64-v4",
    "this machine": "",
}
LAWS = {"arc": se2.step, "2R inverse": arms.two_link_inverse, "segment": motion.segment}


@dataclass(frozen=True, slots=True)
class Level:
    """One line: nanoseconds a row by law and precision, or why there are none."""

    name: str
    cost: dict[str, float] = field(default_factory=dict)
    problem: str = ""


def vector_levels(effort: Effort) -> list[Level]:
    """Every level; a quick run takes the narrowest and this machine's own."""
    names = [name for name in LEVELS if not effort.quick or LEVELS[name] in ("x86-64", "")]
    return [_level(name, effort.quick) for name in names]


def _level(name: str, quick: bool) -> Level:
    environment = {k: v for k, v in os.environ.items() if not k.startswith("NUMBA_CPU")}
    if LEVELS[name]:
        environment |= {"NUMBA_CPU_NAME": LEVELS[name], "NUMBA_CPU_FEATURES": ""}
    with tempfile.TemporaryDirectory() as cache:
        command = [sys.executable, "-W", "ignore", "-m", "benchmarks.features", *(["quick"] if quick else [])]
        answer = subprocess.run(
            command, capture_output=True, text=True, check=False, env=environment | {"COPLANAR_CACHE": cache}
        )
    if answer.returncode:
        words = answer.stderr.strip().splitlines() or [f"ended with code {answer.returncode}"]
        return Level(name, problem=words[-1][:120])
    return Level(name, json.loads(answer.stdout.splitlines()[-1]))


def _costs(laws: dict[str, Any]) -> dict[str, float]:
    """Nanoseconds a row: what more rows take, without the price of a call."""
    rng = np.random.default_rng(9)
    found = {}
    for name, law in laws.items():
        columns = rng.uniform(0.1, 1.0, (law.__code__.co_argcount, ROWS))
        for kind in (np.float64, np.float32):
            long, short = (_fastest(law, columns[:, :rows].astype(kind)) for rows in (ROWS, 8))
            found[f"{name}, {kind.__name__}"] = (long - short) / (ROWS - 8)
    return found


def _fastest(law: Any, columns: np.ndarray) -> float:
    """The fastest of many calls [ns]."""
    run, arguments = evaluator(law).on_compiled, tuple(columns)
    out = run(*arguments)
    times = []
    for _ in range(200):
        start = time.perf_counter()
        run(*arguments, out=out)
        times.append(time.perf_counter() - start)
    return 1e9 * min(times)


if __name__ == "__main__":
    print(json.dumps(_costs(dict(list(LAWS.items())[: 1 if "quick" in sys.argv else None]))))
