"""Runs: what every simulation returns, a table in time that can be resampled, summed up and saved."""

from coplanar.run.kinds import KINDS, Kind, RunStatus
from coplanar.run.table import Run

__all__ = ["KINDS", "Kind", "Run", "RunStatus"]
