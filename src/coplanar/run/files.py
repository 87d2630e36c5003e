"""Tables of numbers as text."""

from __future__ import annotations

import csv
import os
import secrets
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from coplanar.errors import InvalidValue


def write_table(path: Path, columns: Mapping[str, Sequence[Any] | np.ndarray]) -> Path:
    """Columns (rows,) of numbers or words as comma-separated values with a header, 17 significant digits.

    The text goes to a file beside ``path`` that then takes its place, so that nobody ever sees half a table.
    """
    part = path.with_name(f".{path.name}.{secrets.token_hex(4)}.part")
    try:
        with part.open("x", encoding="utf-8", newline="") as file:
            file.write(",".join(columns) + "\n")
            for row in zip(*(np.asarray(c).tolist() for c in columns.values()), strict=True):
                file.write(",".join(map(_cell, row)) + "\n")
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
    return path


def read_table(path: Path) -> dict[str, np.ndarray]:
    """Columns by name of a table with a header.

    Raises:
        InvalidValue: Naming the line and what is wrong with it.
        OSError: If the file cannot be read.
    """
    with path.open(encoding="utf-8", newline="") as file:
        rows = [row for row in enumerate(csv.reader(file), 1) if row[1]]
    names = [name.strip() for name in rows[0][1]] if rows else []
    if len(rows) < 2 or len(set(names)) != len(names):
        raise InvalidValue("path", str(path), "a header of different names and at least one row of numbers")
    return dict(zip(names, np.array([_numbers(path, names, *row) for row in rows[1:]]).T, strict=True))


def _cell(value: Any) -> str:
    return value if isinstance(value, str) else format(value, ".17g")


def _numbers(path: Path, names: list[str], line: int, cells: list[str]) -> list[float]:
    if len(cells) != len(names):
        raise InvalidValue(f"line {line} of {path}", cells, f"{len(names)} cells", f"it has {len(cells)}")
    try:
        return [float(cell) for cell in cells]
    except ValueError as error:
        raise InvalidValue(f"line {line} of {path}", cells, "numbers", str(error)) from None
