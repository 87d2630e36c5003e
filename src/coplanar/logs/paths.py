"""Paths of points in a text file: x, y and perhaps headings, as planners, spreadsheets and surveys write them."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from coplanar import checks
from coplanar.curves import Polyline, Spline
from coplanar.errors import InvalidShape
from coplanar.logs.files import LARGEST, contents, refuse
from coplanar.run.files import blaming, number, text_of

_ALIASES = {"yaw": "theta", "heading": "theta", "psi": "theta", "angle": "theta"}
_UNITS = {"x": ("", "m"), "y": ("", "m"), "theta": ("", "rad")}
_NAME = re.compile(r"([a-z]+?)[ _]*[\[(]?(m|cm|mm|ft|in|rad|deg)?[\])]?", re.IGNORECASE)
_COMMENTS = "#%"


@dataclass(frozen=True, slots=True, eq=False)
class Waypoints:
    """Points of a path, in order, and headings where there are any.

    Attributes:
        points: Shape (n, 2) [m]; read-only. ``Polyline``, ``Spline`` and ``DrivingHistory`` take them as they are.
        theta: Headings, shape (n,) [rad]; None where the file has none.

    Example:
        >>> Waypoints([(0, 0), (3, 4)]).polyline().interval
        (0.0, 5.0)
    """

    points: checks.ArrayLike
    theta: checks.ArrayLike | None = None

    def __post_init__(self) -> None:
        points = checks.vector("points", self.points, 2)
        if points.ndim != 2:
            raise InvalidShape("points", f"shape {points.shape}", "shape (n, 2)")
        object.__setattr__(self, "points", checks.frozen(points))
        if self.theta is not None:
            object.__setattr__(self, "theta", checks.frozen(checks.vector("theta", self.theta, len(points))))

    def polyline(self, *, closed: bool = False) -> Polyline:
        """Straight from point to point.

        Raises:
            InvalidValue: If neighbours coincide.
        """
        return Polyline(self.points, closed=closed)

    def spline(self, *, closed: bool = False) -> Spline:
        """Smoothly through the points.

        Raises:
            InvalidValue: If neighbours coincide.
        """
        return Spline(self.points, closed=closed)


class _Row(NamedTuple):
    line: int
    cells: list[str]


def read_path(path: str | os.PathLike[str], *, largest: int = LARGEST) -> Waypoints:
    r"""Read the points of a path from a text file.

    One point a line, its numbers separated by commas, semicolons, tabs or spaces (the first line of them decides).
    A header names the columns in any order: x, y and theta (or yaw, heading, psi, angle), with a unit behind
    (``x_m``, ``theta [rad]``) or without; other columns are left alone. The header may be a comment. Without one, two
    columns are x, y and three are x, y, theta. Comments begin with # or % anywhere in a line; empty lines are skipped.

    Args:
        path: The file.
        largest: The most bytes it may have.

    Raises:
        InvalidValue: If it cannot be read, or a line is not what it should be, naming the line.

    Example:
        >>> import pathlib, tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     file = pathlib.Path(folder, "path.csv")
        ...     _ = file.write_text("y, x  # metres\n0, 0\n1, 2\n")
        ...     read_path(file).points.tolist()
        [[0.0, 0.0], [2.0, 1.0]]
    """
    file = Path(path)
    rows, comment = _rows(text_of(file, contents(file, largest)))
    if not rows:
        refuse(file, "", "no numbers", "a point in each line")
    first = rows[0]
    names = _header(file, first) if not _is_number(first.cells[0]) else _commented(comment, len(first.cells))
    rows = rows[1:] if not _is_number(first.cells[0]) else rows
    if not rows:
        refuse(file, f"line {first.line}", first.cells, "points below the header")
    if names is None:
        names = dict(zip(("x", "y", "theta"), range(len(first.cells)), strict=False))
        if len(first.cells) not in (2, 3):
            refuse(file, f"line {first.line}", first.cells, "x, y or x, y, theta", "name the columns in a header")
    width = len(first.cells)
    table = np.array([_numbers(file, row, width, names) for row in rows]).reshape(-1, len(names))
    columns = dict(zip(names, table.T, strict=True))
    with blaming(file):
        return Waypoints(np.stack([columns["x"], columns["y"]], axis=-1), columns.get("theta"))


def _rows(text: str) -> tuple[list[_Row], list[str]]:
    """Lines with something in them, as cells, and the comment nearest above the first."""
    rows: list[_Row] = []
    comment, separator = "", None
    for line, raw in enumerate(text.splitlines(), 1):
        kept = re.split(f"[{_COMMENTS}]", raw, maxsplit=1)[0].strip()
        if kept:
            separator = _separator(kept) if separator is None else separator
            rows.append(_Row(line, [cell.strip() for cell in re.split(separator, kept)]))
        elif not rows and raw.strip():
            comment = raw.strip().lstrip(_COMMENTS + " ")
    return rows, [cell.strip() for cell in re.split(separator, comment)] if separator else []


def _separator(line: str) -> str:
    """What separates cells, as a pattern: the first of comma, semicolon, tab that is there, else space."""
    return next((mark for mark in ",;\t" if mark in line), r"\s+")


def _header(file: Path, row: _Row) -> dict[str, int]:
    """Where x, y and theta stand.

    Raises:
        InvalidValue: If x or y is missing, twice there, or in another unit.
    """
    where = f"line {row.line}"
    places: dict[str, int] = {}
    for place, cell in enumerate(row.cells):
        name, unit = _named(cell)
        if name in places:
            refuse(file, where, row.cells, f"one column for {name}")
        if name in _UNITS:
            if unit not in _UNITS[name]:
                refuse(file, where, cell, f"{name} in {_UNITS[name][1]}", "convert it first")
            places[name] = place
    if not {"x", "y"} <= set(places):
        refuse(file, where, row.cells, "numbers, or a header that names x and y")
    return places


def _commented(cells: Sequence[str], width: int) -> dict[str, int] | None:
    """Where x, y and theta stand, if a comment names all columns and says so."""
    places = {name: place for place, (name, unit) in enumerate(map(_named, cells)) if unit in _UNITS.get(name, ())}
    return places if len(cells) == width and {"x", "y"} <= set(places) else None


def _named(cell: str) -> tuple[str, str]:
    """The name of a column, without its unit, and the unit."""
    found = _NAME.fullmatch(cell.strip().strip('"').strip())
    if found is None:
        return "", ""
    name = found[1].lower()
    return _ALIASES.get(name, name), (found[2] or "").lower()


def _is_number(cell: str) -> bool:
    try:
        number(cell)
    except ValueError:
        return False
    return True


def _numbers(file: Path, row: _Row, width: int, names: dict[str, int]) -> list[float]:
    where = f"line {row.line}"
    if len(row.cells) != width:
        refuse(file, where, row.cells, f"{width} numbers", f"it has {len(row.cells)}")
    try:
        values = [number(row.cells[place]) for place in names.values()]
    except ValueError as error:
        refuse(file, where, row.cells, "numbers", str(error))
    if not np.isfinite(values).all():
        refuse(file, where, row.cells, "finite numbers")
    return values
