"""Memory of a call on a million rows: its outputs, and how much more there is at the peak."""

from __future__ import annotations

import contextlib
import json
import subprocess
import sys
import tracemalloc
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.measure import Effort

MEGABYTE = 1e6


@dataclass(frozen=True, slots=True)
class Peak:
    """One line, in megabytes.

    Attributes:
        what: The call.
        rows: How many.
        inputs: What was there before.
        outputs: What is there afterwards and was not before.
        traced: The highest that NumPy and Python had on top of the inputs.
        resident: How far the process's highest resident size rose.
        problem: Why there is nothing.
    """

    what: str
    rows: int
    inputs: float = 0.0
    outputs: float = 0.0
    traced: float = 0.0
    resident: float = 0.0
    problem: str = ""


def _arcs(rows: int) -> Callable[[], Any]:
    from benchmarks.workloads import arcs
    from coplanar import Displacement, Pose

    data = arcs.steps(rows)
    poses, increments = Pose(*data[:3]), Displacement(*data[3:])
    return lambda: poses.step(increments)


def _inverses(rows: int) -> Callable[[], Any]:
    from benchmarks.workloads import inverse
    from coplanar import Arm

    arm, points = Arm((inverse.L1, inverse.L2)), np.column_stack(inverse.targets(rows))
    return lambda: arm.inverse(points)


def _segments(rows: int) -> Callable[[], Any]:
    from benchmarks.workloads import segments
    from coplanar import Pose, Segment

    data = segments.moves(rows)
    whole, start = Segment(*data[3:7], duration=data.t), Pose(*data[:3])
    return lambda: whole.end(start)


def _kinematics(rows: int) -> Callable[[], Any]:
    from benchmarks.workloads import chains
    from coplanar import Arm

    arm, q = Arm(chains.LINKS), chains.postures(rows).q
    return lambda: (arm.forward(q), arm.jacobian(q))


def _log(rows: int) -> Callable[[], Any]:
    from benchmarks.workloads import rollouts
    from coplanar import Odometry, Pose

    data = rollouts.log(rows)
    return lambda: Odometry.from_wheels(data.left, data.right, track=rollouts.TRACK).path(Pose())


def _rolls(rows: int) -> Callable[[], Any]:
    from benchmarks.workloads import rollouts
    from coplanar import Odometry, Pose

    data = rollouts.commands(rows // rollouts.STEPS)
    odometry = Odometry.from_velocities(data.v, data.omega, rollouts.DT * np.arange(rollouts.STEPS + 1))
    return lambda: odometry.end(Pose())


def _tracked(keep: str) -> Callable[[int], Callable[[], Any]]:
    def prepare(rows: int) -> Callable[[], Any]:
        from benchmarks.workloads import tracking

        return tracking.closed_loop(tracking.robots(rows // tracking.STEPS), keep=keep)

    return prepare


def _impacts(rows: int) -> Callable[[], Any]:
    from benchmarks.workloads import shots

    data = shots.shots(rows)
    return lambda: shots.BALL.launch(speed=data.speed, angle=data.angle).impact()


CALLS = {
    "poses.step(increments)": (_arcs, 1_000_000),
    "arm.inverse(targets), 2R": (_inverses, 1_000_000),
    "segments.end(starts)": (_segments, 1_000_000),
    "arm.forward(q), arm.jacobian(q), 6R": (_kinematics, 1_000_000),
    "Odometry.from_wheels(...).path(start)": (_log, 1_000_000),
    "odometry.end(start)": (_rolls, 1_000_000),
    "simulate(...)": (_tracked("all"), 1_000_000),
    "simulate(..., keep='end')": (_tracked("end"), 1_000_000),
    "launch(...).impact()": (_impacts, 100_000),
}


def peaks(effort: Effort) -> list[Peak]:
    """Every call in a fresh process."""
    table = []
    for name, (_, rows) in list(CALLS.items())[: 2 if effort.quick else None]:
        size = rows // 5 if effort.quick else rows
        command = [sys.executable, "-W", "ignore", "-m", "benchmarks.memory", name, str(size)]
        answer = subprocess.run(command, capture_output=True, text=True, check=False)
        if answer.returncode:
            table.append(Peak(name, size, problem=answer.stderr.strip().splitlines()[-1][:120]))
        else:
            table.append(Peak(name, size, **json.loads(answer.stdout.splitlines()[-1])))
    return table


def _measure(prepare: Callable[[int], Callable[[], Any]], rows: int) -> dict[str, float]:
    prepare(25_000)()  # compiled, imported
    tracemalloc.start()
    call = prepare(rows)
    held = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    before = _forget_peak()
    answer = call()
    resident = _status("VmHWM") - before
    del answer
    tracemalloc.start()
    answer = call()
    outputs, highest = tracemalloc.get_traced_memory()
    del answer
    found = {"inputs": held, "outputs": outputs, "traced": highest, "resident": resident}
    return {name: value / MEGABYTE for name, value in found.items()}


def _forget_peak() -> float:
    """Let the highest resident size begin anew where the system can do that, and return what it is [B]."""
    with contextlib.suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
    return _status("VmHWM")


def _status(name: str) -> float:
    """A size of this process [B]; NaN where the system does not say."""
    with contextlib.suppress(OSError):
        for line in Path("/proc/self/status").read_text(encoding="ascii").splitlines():
            if line.startswith(name):
                return 1024.0 * float(line.split()[1])
    return float("nan")


if __name__ == "__main__":
    print(json.dumps(_measure(CALLS[sys.argv[1]][0], int(sys.argv[2]))))
