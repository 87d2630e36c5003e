"""What a run says beside its columns, as a plain dictionary that JSON holds, and the run again from it.

    {"coplanar": 1, "kind": "unicycle", "index": "t", "status": "COMPLETE", "warnings": [...], "info": {...}}

``kind`` is a name, or the five lists of a ``Kind``. In ``info`` tuples and arrays become lists, numbers that are not
finite their words, and what JSON has no form for its text. ``shapes`` holds the shape of each column that is a batch
where the format itself does not keep it.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from coplanar.errors import InvalidValue
from coplanar.logs.files import Source, refuse
from coplanar.run import Kind, Run, RunStatus
from coplanar.run.files import blaming

VERSION = 1
_DEEPEST = 32  # axes of a column, the most that any NumPy holds


def description_of(run: Run) -> dict[str, Any]:
    """Everything but the columns, ready for JSON.

    Example:
        >>> description_of(Run({"t": [0.0, 1.0]}))["status"]
        'COMPLETE'
    """
    kind = run.kind if isinstance(run.kind, str) else {k: list(v) for k, v in run.kind._asdict().items()}
    return {
        "coplanar": VERSION,
        "kind": kind,
        "index": run.index,
        "status": run.status.name,
        "warnings": list(run.warnings),
        "info": _plain(dict(run.info)),
    }


def described(run: Run) -> str:
    """The description as one line of JSON, with the shapes of columns that are batches."""
    shapes = {name: list(values.shape[1:]) for name, values in run.columns.items() if values.ndim > 1}
    return json.dumps(description_of(run) | ({"shapes": shapes} if shapes else {}), allow_nan=False)


def run_of(path: Path, columns: Mapping[str, Any], description: Any) -> Run:
    """The run of these columns and a description that a file held.

    Raises:
        InvalidValue: Naming the file and what in the description, or in the columns, cannot be.
    """
    if not isinstance(description, dict) or description.get("coplanar") != VERSION:
        refuse(path, "description", description, f"a run's description with coplanar: {VERSION}")
    words = {"index": str, "status": str, "warnings": list, "info": dict}
    for key, form in words.items():
        if not isinstance(description.get(key), form):
            refuse(path, f"{key} of the description", description.get(key), f"a {form.__name__}")
    if description["status"] not in RunStatus.__members__:
        refuse(path, "status", description["status"], "one of " + ", ".join(RunStatus.__members__))
    if not all(isinstance(warning, str) for warning in description["warnings"]):
        refuse(path, "warnings", description["warnings"], "sentences")
    with blaming(path):
        return Run(
            columns,
            _kind_of(description.get("kind")),
            index=description["index"],
            status=RunStatus[description["status"]],
            warnings=tuple(description["warnings"]),
            info=description["info"],
        )


def bare_run(source: Source, columns: Mapping[str, Any]) -> Run:
    """The run of columns that nothing is said about; diverged if an entry is not finite.

    Raises:
        InvalidValue: Naming the file.
    """
    finite = all(np.isfinite(values).all() for values in columns.values())
    status = RunStatus.COMPLETE if finite else RunStatus.DIVERGED
    with blaming(source.path):
        return Run(columns, source.kind or "table", index=source.index or "t", status=status)


def column_of(path: Path, name: str, raw: bytes | bytearray, rows: int, description: Any) -> np.ndarray:
    """A column (rows, ...) of little-endian doubles, in the shape that the description gives its rows.

    Raises:
        InvalidValue: If there are not as many as rows and shape say.
    """
    shapes = description.get("shapes", {}) if isinstance(description, dict) else {}
    shape = shapes.get(name, []) if isinstance(shapes, dict) else shapes
    known = isinstance(shape, list) and len(shape) < _DEEPEST and all(type(n) is int and n >= 0 for n in shape)
    if not known or len(raw) != 8 * rows * math.prod(shape):
        refuse(path, f"column {name!r}", f"{len(raw)} bytes in {rows} rows", f"8 bytes for each of the shape {shape}")
    return np.frombuffer(bytes(raw), "<f8").reshape(rows, *shape).astype(np.float64, copy=False)


def _kind_of(kind: Any) -> str | Kind:
    if not isinstance(kind, dict):
        return kind if isinstance(kind, str) else str(kind)
    roles = {role: kind.get(role) for role in Kind._fields}
    wrong = [names for names in roles.values() if not _are_names(names)]
    if wrong or set(kind) != set(roles):
        raise InvalidValue("kind", kind, "a name, or lists of names for " + ", ".join(Kind._fields))
    return Kind(**{role: tuple(names) for role, names in roles.items() if names is not None})


def _are_names(names: Any) -> bool:
    return isinstance(names, list) and all(isinstance(name, str) for name in names)


def _plain(value: Any) -> Any:
    """What JSON has a form for."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, float):
        return value if math.isfinite(value) else str(value)
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, Mapping):
        return {str(key): _plain(held) for key, held in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(held) for held in value]
    return str(value)
