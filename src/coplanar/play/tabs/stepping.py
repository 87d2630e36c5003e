"""The same motion by the integrators of ``integrate_ode``, to be drawn beside the exact one."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from coplanar.integrators import integrate_ode
from coplanar.motion import Segment
from coplanar.se2 import Pose

Path = tuple[np.ndarray, np.ndarray]  # times (n,) and poses (n, 3)


def segments_by(segments: Iterable[Segment], start: Pose, step: float, method: str) -> Path:
    """Segments one after another, each in equal steps of at most ``step`` [s]: no step goes over a joint."""
    begin, state = 0.0, start.as_array()
    times, states = [np.zeros(1)], [state[None]]
    for segment in segments:
        if segment.duration > 0.0:
            t = np.linspace(0.0, segment.duration, math.ceil(segment.duration / step - 1e-9) + 1)
            table = segment_by(segment, state, t, method)
            times.append(begin + t[1:])
            states.append(table[1:])
            begin, state = begin + segment.duration, table[-1]
    return np.concatenate(times), np.concatenate(states)


def segment_by(segment: Segment, start: np.ndarray, t: np.ndarray, method: str) -> np.ndarray:
    """The poses (n, 3) at the times t of one segment."""

    def rates(time: float, pose: np.ndarray) -> np.ndarray:
        return segment.twist(float(time)).in_world(float(pose[2]))

    return integrate_ode(rates, t, start, method=method)


def half_width(points: np.ndarray, least: float = 1.0) -> float:
    """A power of two that holds the points (n, 2): a view that jumps seldom."""
    reach = max(1.15 * float(np.abs(points).max(initial=0.0)), least)
    return 2.0 ** math.ceil(math.log2(reach))
