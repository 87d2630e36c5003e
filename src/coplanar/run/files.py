"""Tables of numbers as text, and files that appear whole or not at all."""

from __future__ import annotations

import csv
import io
import os
import secrets
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from coplanar.errors import InvalidInput, InvalidValue


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """A file beside ``path`` to write to; at the end it takes its place, so that nobody ever sees half of it.

    What was there before stays if anything fails on the way.
    """
    part = path.with_name(f".{path.name}.{secrets.token_hex(4)}.part")
    try:
        yield part
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


@contextmanager
def blaming(path: Path) -> Iterator[None]:
    """Name the file in what is refused inside: a value that came from it is its fault."""
    try:
        yield
    except InvalidInput as error:
        raise InvalidValue(f"{error.name} of {path}", error.given, error.needed, error.remedy) from None


def write_table(path: Path, columns: Mapping[str, Sequence[Any] | np.ndarray]) -> Path:
    """Columns (rows,) of numbers or words as comma-separated values with a header, 17 significant digits; whole."""
    with written_whole(path) as part, part.open("x", encoding="utf-8", newline="") as file:
        file.write(",".join(columns) + "\n")
        for row in zip(*(np.asarray(c).tolist() for c in columns.values()), strict=True):
            file.write(",".join(map(_cell, row)) + "\n")
    return path


def read_table(path: Path) -> dict[str, np.ndarray]:
    """Columns by name of a table with a header.

    Raises:
        InvalidValue: Naming the line and what is wrong with it.
        OSError: If the file cannot be read.
    """
    return table_of(path, path.read_bytes())


def table_of(path: Path, data: bytes) -> dict[str, np.ndarray]:
    """Columns by name of a table with a header, from what its file holds.

    Raises:
        InvalidValue: Naming the line and what is wrong with it.
    """
    rows = _rows(path, data)
    names = [name.strip() for name in rows[0][1]] if rows else []
    if len(rows) < 2 or len(set(names)) != len(names):
        raise InvalidValue("path", str(path), "a header of different names and at least one row of numbers")
    return dict(zip(names, np.array([_numbers(path, names, *row) for row in rows[1:]]).T, strict=True))


def text_of(path: Path, data: bytes) -> str:
    """The text of a file, UTF-8 with or without a mark.

    Raises:
        InvalidValue: Naming the byte that is not.
    """
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        wrong = error.object[error.start : error.start + 4]
        raise InvalidValue(f"byte {error.start} of {path}", bytes(wrong), "text in UTF-8") from None


def _rows(path: Path, data: bytes) -> list[tuple[int, list[str]]]:
    """Rows that are not empty, with the line in which they end."""
    reader = csv.reader(io.StringIO(text_of(path, data), newline=""))
    try:
        return [(reader.line_num, row) for row in reader if row]
    except csv.Error as error:
        raise InvalidValue(f"line {reader.line_num} of {path}", str(error), "comma-separated values") from None


def _cell(value: Any) -> str:
    return value if isinstance(value, str) else format(value, ".17g")


def _numbers(path: Path, names: list[str], line: int, cells: list[str]) -> list[float]:
    if len(cells) != len(names):
        raise InvalidValue(f"line {line} of {path}", cells, f"{len(names)} cells", f"it has {len(cells)}")
    try:
        return [number(cell) for cell in cells]
    except ValueError as error:
        raise InvalidValue(f"line {line} of {path}", cells, "numbers", str(error)) from None


def number(word: str) -> float:
    """The number that a word is, as every other program reads it: without the underscores that Python allows.

    Raises:
        ValueError: If it is none.

    Example:
        >>> number("1e-3")
        0.001
    """
    if "_" in word:
        raise ValueError(f"could not convert string to float: {word!r}")
    return float(word)
