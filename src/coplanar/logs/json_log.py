"""A run as one JSON object: its description and its columns.

    {"coplanar": 1, "kind": ..., "index": "t", "status": ..., "warnings": [...], "info": {...},
     "columns": {"t": [...], "x": [...]}}

Strict JSON: NaN is null (and the status says DIVERGED), and an infinite number is written 1e999, which every reader
of doubles takes for infinity. Numbers have as many digits as it takes to be read back bit by bit.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from coplanar.logs.description import description_of, run_of
from coplanar.logs.files import Source, json_of, refuse
from coplanar.run import Run

_NUMBERS = {float, int, type(None)}


def write(run: Run, path: Path) -> None:
    """Write the object, a column a line."""
    head = json.dumps(description_of(run), allow_nan=False)
    columns = ",\n".join(f"{json.dumps(name)}: {_text(values)}" for name, values in run.columns.items())
    path.write_text(f'{head[:-1]}, "columns": {{\n{columns}\n}}}}\n', encoding="utf-8", newline="\n")


def read(source: Source) -> Run:
    """The run of such an object.

    Raises:
        InvalidValue: Naming the line, or the column that is none.
    """
    path, table = source.path, json_of(source.path, source.data)
    if not isinstance(table, dict) or not isinstance(table.get("columns"), dict):
        refuse(path, "", table, "an object with columns, as write_log writes it")
    columns = {name: _column(path, name, values) for name, values in table.pop("columns").items()}
    return run_of(path, columns, table)


def _text(values: np.ndarray) -> str:
    """Numbers in brackets, as deep as the array."""
    if np.isfinite(values).all():
        return json.dumps(values.tolist())
    cells = map(_text, values) if values.ndim > 1 else map(_word, values.tolist())
    return "[" + ", ".join(cells) + "]"


def _word(value: float) -> str:
    if math.isnan(value):
        return "null"
    return repr(value) if math.isfinite(value) else f"{'-' if value < 0 else ''}1e999"


def _column(path: Path, name: str, values: Any) -> np.ndarray:
    place = f"column {name!r}"
    if not isinstance(values, list):
        refuse(path, place, values, "a list of numbers")
    try:
        table = np.array(values, dtype=object)
        kinds = {type(value) for value in table.ravel().tolist()}
        if kinds <= _NUMBERS:
            return table.astype(np.float64)
    except (ValueError, OverflowError) as error:
        refuse(path, place, str(error), "numbers that a double holds, as many in every row")
    wrong = ", ".join(sorted(kind.__name__ for kind in kinds - _NUMBERS))
    return refuse(path, place, f"{wrong} among its entries", "numbers and null, as many in every row")
