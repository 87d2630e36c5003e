"""A run in numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from coplanar.run.table import Run


def summary_of(run: Run) -> dict[str, Any]:
    """What ``Run.summary`` returns: floats, or arrays over a batch."""
    kind = run.kind if isinstance(run.kind, str) else "custom"
    first, last = float(run.t[0]), float(run.t[-1])
    facts: dict[str, Any] = {"kind": kind, "status": run.status.value, "rows": len(run), "robots": run.shape}
    facts |= {"start": first, "duration": last - first, "warnings": run.warnings}
    if {"x", "y"} <= set(run.columns):
        pieces = np.hypot(np.diff(run["x"], axis=0), np.diff(run["y"], axis=0))
        facts["distance"] = _number(pieces.sum(0))
    facts |= {f"final_{name}": _number(run[name][-1]) for name in run.names.states}
    facts |= {f"largest_{name}": _number(np.abs(run[name]).max(0)) for name in run.names.commands}
    if run.names.errors[:2] == ("ex", "ey"):
        sizes = np.hypot(run["ex"], run["ey"])
        facts |= {"largest_error": _number(sizes.max(0)), "rms_error": _number(np.sqrt((sizes**2).mean(0)))}
    return facts


def _number(value: Any) -> Any:
    return float(value) if np.ndim(value) == 0 else value
