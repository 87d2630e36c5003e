"""Runs: what every simulation returns, a table in time that can be resampled, summed up and saved."""

from coplanar.run.table import KINDS, Kind, Run, RunStatus

__all__ = ["KINDS", "Kind", "Run", "RunStatus"]
