"""Trajectories of Choreo: ``.traj`` files of 2025 and later."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any

import numpy as np

from coplanar.logs.files import LARGEST, contents, json_of, refuse
from coplanar.run import Run
from coplanar.run.files import blaming
from coplanar.se2 import Pose

VERSIONS = (0, 1, 2, 3, "v2025.0.0")
_SWERVE = ("t", "x", "y", "heading", "vx", "vy", "omega")
_DIFFERENTIAL = ("t", "x", "y", "heading", "vl", "vr", "omega")


def read_choreo(path: str | os.PathLike[str], *, largest: int = LARGEST) -> Run:
    """Read the samples of a Choreo trajectory as a run of the kind "body".

    Choreo gives velocities in the field's frame, a run of this kind in the robot's own: vx forward, vy to the left.
    The field's come along as vx_field, vy_field for a swerve drive. A differential drive has the speeds of its two
    sides: vx is their mean, vy is 0, and vl, vr come along. Accelerations and forces are left alone.

    Args:
        path: A ``.traj`` file with generated samples.
        largest: The most bytes it may have.

    Returns:
        A run with the columns t, x, y, theta, vx, vy, omega (and as above), in seconds, metres and radians; ``info``
        holds the name, the version of the format, the sample type, and the times of the waypoints.

    Raises:
        InvalidValue: If it cannot be read, is of an unknown version, has no samples, or one lacks something; naming
            the line or the sample.

    Source: Choreo, trajectory schema versions 0 to 3.
    """
    file = Path(path)
    table = json_of(file, contents(file, largest))
    trajectory = _trajectory(file, table)
    samples = trajectory["samples"]
    differential = isinstance(samples[0], dict) and "vl" in samples[0]
    names = _DIFFERENTIAL if differential else _SWERVE
    columns = dict(zip(names, np.array([_numbers(file, i, s, names) for i, s in enumerate(samples)]).T, strict=True))
    info = {
        "name": str(table.get("name", "")),
        "version": table["version"],
        "sample_type": "Differential" if differential else "Swerve",
        "waypoints": trajectory.get("waypoints", []),
    }
    with blaming(file):
        return Run((_by_sides if differential else _by_field)(columns), "body", info=info)


def _trajectory(file: Path, table: Any) -> dict[str, Any]:
    """The trajectory of the file, with samples."""
    trajectory = table.get("trajectory") if isinstance(table, dict) else None
    if not isinstance(trajectory, dict) or not isinstance(trajectory.get("samples"), list):
        refuse(file, "", table, "an object with trajectory.samples, as Choreo 2025 writes it")
    if table.get("version") not in VERSIONS or isinstance(table.get("version"), bool):
        refuse(file, "version", table.get("version"), "one of " + ", ".join(map(str, VERSIONS)))
    if not trajectory["samples"]:
        refuse(file, "trajectory.samples", [], "at least one sample", "generate the trajectory in Choreo first")
    return trajectory


def _by_field(given: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Columns of a run from velocities in the field."""
    heading = Pose(0.0, 0.0, given["heading"])
    own = heading.inverse() @ np.stack([given["vx"], given["vy"]], axis=-1)
    body = {"vx": own[:, 0], "vy": own[:, 1], "omega": given["omega"]}
    return _posed(given) | body | {"vx_field": given["vx"], "vy_field": given["vy"]}


def _by_sides(given: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Columns of a run from the speeds of a robot's two sides."""
    forward = 0.5 * (given["vl"] + given["vr"])
    body = {"vx": forward, "vy": np.zeros_like(forward), "omega": given["omega"]}
    return _posed(given) | body | {"vl": given["vl"], "vr": given["vr"]}


def _posed(given: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    return {"t": given["t"], "x": given["x"], "y": given["y"], "theta": given["heading"]}


def _numbers(file: Path, place: int, sample: Any, names: tuple[str, ...]) -> list[float]:
    where = f"sample {place}"
    if not isinstance(sample, dict):
        refuse(file, where, sample, "an object")
    for name in names:
        value = sample.get(name)
        if isinstance(value, bool) or not isinstance(value, int | float) or not _is_finite(value):
            remedy = "" if name in sample else "open and save the trajectory with a newer Choreo"
            refuse(file, f"{name} of {where}", value, "a finite number", remedy)
    return [float(sample[name]) for name in names]


def _is_finite(value: float) -> bool:
    try:
        return math.isfinite(value)
    except OverflowError:
        return False
