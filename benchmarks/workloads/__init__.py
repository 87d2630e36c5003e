"""The workloads, in the order of the table."""

from benchmarks.measure import Workload
from benchmarks.workloads import arcs, chains, inverse, rollouts, segments, shots, tracking

ALL: tuple[Workload, ...] = (
    arcs.ONCE,
    inverse.ONCE,
    segments.ONCE,
    arcs.BATCH,
    inverse.BATCH,
    segments.BATCH,
    chains.FORWARD,
    chains.SEARCH,
    tracking.END,
    tracking.KEPT,
    rollouts.ROLLS,
    rollouts.LOG,
    shots.IMPACT,
    shots.AIM,
)
