"""Start-up, each time in a fresh process: the import, the first compiled call without and with the disk cache."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass

from benchmarks.measure import Effort

IMPORTS = {
    "import coplanar": "import coplanar",
    "import coplanar, a Pose, an Arm, a Segment": (
        "from coplanar import Arm, Pose, Segment; Arm((1.0, 0.7)).inverse((1.0, 1.0)); "
        "Segment(1.0, 1.0, duration=1.0).end(Pose())"
    ),
    "import numpy": "import numpy",
    "import scipy.optimize": "import scipy.optimize",
    "import numba": "import numba",
    "WPILib": "import wpimath.geometry, wpimath.kinematics",
    "pinocchio": "import pinocchio",
    "jaxlie": "import jaxlie",
    "pyclothoids": "import pyclothoids",
    "py-ballisticcalc": "import py_ballisticcalc",
    "spatialmath": "import spatialmath",
    "ikpy": "import ikpy.chain",
    "Robotics Toolbox": "import roboticstoolbox",
}

FIRST_CALL = """
import time, numpy as np
from coplanar import Displacement, Pose
from coplanar.engine import can_compile
column = np.linspace(-1.0, 1.0, {rows})
poses, ways = Pose(column, column, column), Displacement(column, column, column)
start = time.perf_counter(); poses.step(ways); first = time.perf_counter() - start
start = time.perf_counter(); poses.step(ways); again = time.perf_counter() - start
start = time.perf_counter(); poses.inverse(); second = time.perf_counter() - start
print(first, again, second)
"""


@dataclass(frozen=True, slots=True)
class Start:
    """One line: what, seconds (median), a problem instead where there is one."""

    what: str
    seconds: float
    problem: str = ""


def start_up(effort: Effort) -> tuple[list[Start], list[Start]]:
    """Imports, and first calls."""
    rounds = 2 if effort.quick else 5
    names = dict(list(IMPORTS.items())[: 4 if effort.quick else None])
    times: dict[str, list[float]] = {name: [] for name in names}
    problems: dict[str, str] = {}
    for _ in range(rounds):
        for name, code in names.items():
            answer = _python(f"import time; s = time.perf_counter()\n{code}\nprint(time.perf_counter() - s)", None)
            if answer.returncode:
                problems[name] = answer.stderr.strip().splitlines()[-1][:120]
            else:
                times[name].append(float(answer.stdout.split()[-1]))
    imports = [Start(n, statistics.median(t) if t else float("nan"), problems.get(n, "")) for n, t in times.items()]
    return imports, _first_calls(1 if effort.quick else 3)


def _first_calls(rounds: int) -> list[Start]:
    """First call of a law at 100 000 rows, of a second law, and at 1000 rows, where nobody waits for a compiler."""
    large, small = FIRST_CALL.format(rows=100_000), FIRST_CALL.format(rows=1000)
    table: dict[str, list[float]] = {}
    for _ in range(rounds):
        with tempfile.TemporaryDirectory() as cache:
            for name, code in (("cold", large), ("from the disk cache", large), ("small batch", small)):
                words = _python(code, cache).stdout.split()
                for what, value in zip(("first call", "next call", "first call of the next law"), words, strict=False):
                    table.setdefault(f"{name}: {what}", []).append(float(value))
    return [Start(name, statistics.median(values)) for name, values in table.items()]


def _python(code: str, cache: str | None) -> subprocess.CompletedProcess[str]:
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    if cache:
        environment["COPLANAR_CACHE"] = cache
    return subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code], capture_output=True, text=True, check=False, env=environment
    )
