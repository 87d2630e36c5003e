"""Columns of numbers as text, of any length: comma, semicolon, space or tab separated, # comments, a header or none."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from coplanar.errors import InvalidValue, UnknownName
from coplanar.logs.lines import Lines, Reader, whole_lines

SEPARATORS = (",", ";")  # else blanks and tabs
MOST = 1 << 14  # rows given at once

_COMMENT = re.compile(rb"#[^\n]*")
_UNIT = re.compile(r"[\[(].*")
_NEWLINE, _BLANK = 10, 32


class Rows(NamedTuple):
    """Some rows.

    Attributes:
        values: The columns asked for, shape (rows, columns); finite.
        lines: In which line each row stands, shape (rows,).
    """

    values: np.ndarray
    lines: np.ndarray


@dataclass(frozen=True, slots=True)
class Wanted:
    """Which columns are read.

    Attributes:
        names: What they are called in a header, and what an error calls them; in the order of the answer.
        columns: Where they stand instead: names in the header, or numbers counted from 1.
        optional: The first of them may be absent.
    """

    names: tuple[str, ...]
    columns: tuple[str, ...] | None = None
    optional: bool = False


@dataclass(frozen=True, slots=True)
class Layout:
    """How a row is cut.

    Attributes:
        separator: "," or ";", or "" for blanks and tabs.
        width: How many cells a row has.
        places: Index of each column that is read.
        names: What they are called.
        header: The line of the header; 0 where there is none.
        first: The line that was cut first.
        name: Of the stream.
    """

    separator: str
    width: int
    places: tuple[int, ...]
    names: tuple[str, ...]
    header: int
    first: int
    name: str


def read_columns(read: Reader, wanted: Wanted, name: str) -> Iterator[Rows]:
    r"""Rows of numbers of a stream, some thousands at a time.

    Args:
        read: Gives up to so many bytes, as soon as there are any, and none at the end.
        wanted: Which columns.
        name: What an error calls the stream.

    Raises:
        InvalidValue: Naming the line and what is wrong with it; or if there is no row.
        UnknownName: If the header has no such column.

    Example:
        >>> from io import BytesIO
        >>> log = BytesIO(b"# from the robot\nt,v,omega\n0,1,0.5\n1,1,-0.5\n")
        >>> for rows in read_columns(log.read, Wanted(("t", "omega")), "log"):
        ...     print(rows.values.tolist(), rows.lines.tolist())
        [[0.0, 0.5], [1.0, -0.5]] [3, 4]
    """
    layout, count = None, 0
    for block in whole_lines(read, name):
        clean = Lines(block.first, _COMMENT.sub(b"", block.text) if b"#" in block.text else block.text)
        if layout is None:
            layout = layout_of(clean, wanted, name)
            if layout is None:
                continue
        if clean.first <= layout.header:
            clean = _without_header(clean, layout.header)
        rows, fault = parse(clean, layout)
        count += len(rows.lines)
        for begin in range(0, len(rows.lines), MOST):
            yield Rows(rows.values[begin : begin + MOST], rows.lines[begin : begin + MOST])
        if fault is not None:
            raise fault
    if not count:
        raise InvalidValue(name, "no row of numbers", "one row or more")


def parse(block: Lines, layout: Layout) -> tuple[Rows, InvalidValue | None]:
    """The rows of a block up to the first that is wrong, and what is; by vector code where all cells are numbers."""
    rows, fault = _at_once(block, layout), None
    if rows is None:
        rows, fault = _cell_by_cell(block, layout)
    finite = np.isfinite(rows.values)
    if finite.all():
        return rows, fault
    i, j = np.argwhere(~finite)[0]
    where = f"{layout.names[j]} in line {rows.lines[i]} of {layout.name}"
    return Rows(rows.values[:i], rows.lines[:i]), InvalidValue(where, float(rows.values[i, j]), "a finite number")


def _at_once(block: Lines, layout: Layout) -> Rows | None:
    """Every cell of the block as a number; None unless every row has its cells and each of them is one."""
    text = block.text.translate(_blanked(layout.separator))
    codes = np.frombuffer(text, np.uint8)
    blank = codes <= _BLANK
    starts = np.flatnonzero(~blank & np.concatenate(([True], blank[:-1])))
    counts = np.diff(np.searchsorted(starts, np.flatnonzero(codes == _NEWLINE)), prepend=0)
    full = counts == layout.width
    if not np.all(full | (counts == 0)) or not _alternates(block.text, starts, layout):
        return None
    numbers = _numbers(text)
    if numbers.size != starts.size:
        return None
    table = numbers.reshape(-1, layout.width)
    return Rows(table[:, layout.places], block.first + np.flatnonzero(full))


def _numbers(text: bytes) -> np.ndarray:
    """The numbers of a text of nothing else; none if there is something else."""
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)  # says that it stopped before the end
        try:
            return np.fromstring(text, sep=" ")
        except (DeprecationWarning, ValueError):
            return np.empty(0)


def _alternates(text: bytes, starts: np.ndarray, layout: Layout) -> bool:
    """Whether there is one separator between two cells of a row, and none elsewhere."""
    if not layout.separator:
        return True
    marks = np.flatnonzero(np.frombuffer(text, np.uint8) == ord(layout.separator))
    cells = starts.reshape(-1, layout.width)
    if marks.size != cells.shape[0] * (layout.width - 1):
        return False
    between = marks.reshape(-1, layout.width - 1)
    return bool(np.all((cells[:, :-1] < between) & (between < cells[:, 1:])))


def _cell_by_cell(block: Lines, layout: Layout) -> tuple[Rows, InvalidValue | None]:
    """The columns that are read, whatever the others hold."""
    values, lines, fault = list[list[float]](), list[int](), None
    for line, text in enumerate(block.text.split(b"\n")[:-1], block.first):
        row = _decoded(text).strip()
        if row:
            try:
                values.append(_row(row, line, layout))
            except InvalidValue as error:
                fault = error
                break
            lines.append(line)
    table = np.array(values).reshape(-1, len(layout.places))
    return Rows(table, np.array(lines, dtype=np.int64)), fault


def _row(row: str, line: int, layout: Layout) -> list[float]:
    """The numbers of one row.

    Raises:
        InvalidValue: Naming the line, and the column or how many cells there should be.
    """
    cells = _cells(row, layout.separator)
    if len(cells) != layout.width:
        needed = f"{layout.width} cells, as in line {layout.first}"
        raise InvalidValue(f"line {line} of {layout.name}", row, needed, f"it has {len(cells)}")
    columns = zip(layout.places, layout.names, strict=True)
    return [_number(cells[i], line, column, layout) for i, column in columns]


def _number(cell: str, line: int, column: str, layout: Layout) -> float:
    try:
        if "_" in cell:  # Python reads 1_000
            raise ValueError
        return float(cell)
    except ValueError:
        comma = layout.separator != "," and "," in cell
        remedy = "write a decimal point" if comma else ""
        raise InvalidValue(f"{column} in line {line} of {layout.name}", cell, "a number", remedy) from None


def layout_of(block: Lines, wanted: Wanted, name: str) -> Layout | None:
    """How rows are cut, by the first line with anything in it; None where there is none."""
    for line, text in enumerate(block.text.split(b"\n")[:-1], block.first):
        row = _decoded(text).strip()
        if row:
            separator = next((mark for mark in SEPARATORS if mark in row), "")
            cells = _cells(row, separator)
            header = cells if not any(map(_is_number, cells)) else None
            names, places = _places(cells, header, wanted, f"line {line} of {name}")
            return Layout(separator, len(cells), places, names, line if header else 0, line, name)
    return None


def _places(
    cells: Sequence[str], header: Sequence[str] | None, wanted: Wanted, where: str
) -> tuple[tuple[str, ...], tuple[int, ...]]:
    """Names and indices of the columns that are read."""
    if wanted.columns is not None:
        return _chosen(cells, header, wanted, where)
    if header is None:
        short = wanted.optional and len(cells) == len(wanted.names) - 1
        names = wanted.names[1:] if short else wanted.names
        if len(cells) < len(names):
            raise InvalidValue(where, " ".join(cells), f"columns {', '.join(names)}", f"it has {len(cells)} cells")
        return names, tuple(range(len(names)))
    known = [_UNIT.sub("", cell).strip().lower() for cell in header]
    names = wanted.names[1:] if wanted.optional and wanted.names[0] not in known else wanted.names
    return names, tuple(_index(n, known, where) for n in names)


def _chosen(
    cells: Sequence[str], header: Sequence[str] | None, wanted: Wanted, where: str
) -> tuple[tuple[str, ...], tuple[int, ...]]:
    """The columns that the user names or counts."""
    columns = wanted.columns or ()
    names = wanted.names[len(wanted.names) - len(columns) :] if wanted.optional else wanted.names
    if len(columns) != len(names):
        raise InvalidValue("columns", ", ".join(columns), f"one for each of {', '.join(wanted.names)}")
    places = []
    for column in columns:
        if header is not None and column in header:
            places.append(header.index(column))
        elif column.isdecimal() and 1 <= int(column) <= len(cells):
            places.append(int(column) - 1)
        elif column.isdecimal() or header is None:
            needed = f"numbers of columns, 1 to {len(cells)}"
            raise InvalidValue("columns", column, needed, "" if header else f"{where} is no header with names")
        else:
            raise UnknownName(f"column in {where}", column, header)
    return names, tuple(places)


def _index(name: str, known: Sequence[str], where: str) -> int:
    if name not in known:
        raise UnknownName(f"column in {where}", name, known)
    if known.count(name) > 1:
        raise InvalidValue(where, ", ".join(known), f"one column called {name}", "say which by its number")
    return known.index(name)


def _without_header(block: Lines, line: int) -> Lines:
    """The block with the header's line, and what is before it, empty."""
    parts = block.text.split(b"\n", line - block.first + 1)
    return Lines(block.first, b"\n" * (len(parts) - 1) + parts[-1])


def _cells(row: str, separator: str) -> list[str]:
    return [cell.strip().strip('"') for cell in (row.split(separator) if separator else row.split())]


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _decoded(text: bytes) -> str:
    return text.decode("utf-8", "backslashreplace")


def _blanked(separator: str) -> bytes:
    """The table of ``bytes.translate`` that makes separators blank; control characters become no number."""
    blanks = b"\r\t" + separator.encode()
    return bytes(_BLANK if code in blanks else code for code in range(256))
