"""Write a run to a file that another program opens, and read it back."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

from coplanar import checks
from coplanar.errors import InvalidShape, InvalidValue, UnknownName
from coplanar.logs import json_log, mcap_log, parquet, wpilog
from coplanar.logs.description import bare_run
from coplanar.logs.files import LARGEST, Source, contents
from coplanar.run import Kind, Run
from coplanar.run.files import table_of, written_whole


class Format(NamedTuple):
    """One form of a log.

    Attributes:
        write: Puts a run into a new file.
        read: Makes the run of what a file holds.
    """

    write: Callable[[Run, Path], object]
    read: Callable[[Source], Run]


FORMATS: Mapping[str, Format] = MappingProxyType(
    {
        "csv": Format(Run.to_csv, lambda source: bare_run(source, table_of(source.path, source.data))),
        "json": Format(json_log.write, json_log.read),
        "mcap": Format(mcap_log.write, mcap_log.read),
        "parquet": Format(parquet.write, parquet.read),
        "wpilog": Format(wpilog.write, wpilog.read),
    }
)


def write_log(run: Run, path: str | os.PathLike[str], format: str | None = None) -> Path:
    """Write a run to a file; it appears whole or not at all, and what was there before stays if anything fails.

    | format | opens in | keeps | time |
    |---|---|---|---|
    | csv | everything | one robot's columns, 17 digits; not kind, status, warnings and info | as it is |
    | json | everything | all | as it is |
    | wpilog | AdvantageScope, WPILib | all | stamps of 1e-6 s; as it is in /columns/t |
    | mcap | Foxglove, Lichtblick, PlotJuggler, ROS 2 | all, of one robot | stamps of 1e-9 s; as it is in /columns/t |
    | parquet | pandas, Polars, DuckDB | all | as it is |

    Args:
        run: What to write.
        path: Where to.
        format: One of ``FORMATS``; by the suffix of the path unless given. MCAP and Parquet need the extra ``logs``.

    Returns:
        Where it was written.

    Raises:
        UnknownName: If the format is not known.
        InvalidShape: If the format holds one robot and the run is a batch, or the run has no rows or no robots.
        InvalidValue: If it cannot be written there, or the times are beyond what the format's stamps hold.
        MissingExtra: If the format needs a package that is not installed.

    Example:
        >>> import tempfile
        >>> run = Run({"t": [0.0, 0.1], "x": [0.0, 1 / 3]}, info={"gain": 2.0})
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     back = read_log(write_log(run, f"{folder}/run.json"))
        >>> back["x"].tolist() == run["x"].tolist(), dict(back.info)
        (True, {'gain': 2.0})
    """
    checks.instance("run", run, Run)
    target = Path(path)
    chosen = _format_of(target, format)
    _check(run)
    if not target.name or "\0" in target.name:
        raise InvalidValue("path", str(path), "the name of a file")
    try:
        with written_whole(target) as part:
            chosen.write(run, part)
    except OSError as error:
        raise InvalidValue("path", str(path), f"a place that can be written ({error.strerror})") from None
    return target


def read_log(
    path: str | os.PathLike[str],
    format: str | None = None,
    *,
    kind: str | Kind | None = None,
    index: str | None = None,
    largest: int = LARGEST,
) -> Run:
    """Read a run from a file that ``write_log`` wrote, or from any table of numbers in CSV or Parquet.

    Args:
        path: The file.
        format: One of ``FORMATS``; by the suffix of the path unless given.
        kind: What kind of run it is where the file does not say; "table" unless given.
        index: Its monotone column where the file does not say; "t" unless given.
        largest: The most memory that the file, and each of its parts unpacked, may take [bytes].

    Returns:
        The run that was written: columns bit by bit, kind, index, status, warnings, info. CSV keeps only the columns.

    Raises:
        UnknownName: If the format is not known.
        InvalidValue: If the file cannot be read or is not what it should be, naming the file and the line, byte or
            column.
        MissingExtra: If the format needs a package that is not installed.
    """
    file = Path(path)
    chosen = _format_of(file, format)
    if not isinstance(largest, int) or largest < 1:
        raise InvalidValue("largest", largest, "a number of bytes, 1 or more")
    return chosen.read(Source(file, contents(file, largest), kind, index, largest))


def _format_of(path: Path, format: str | None) -> Format:
    name = path.suffix.lstrip(".").lower() if format is None else format
    if name not in FORMATS:
        raise UnknownName("suffix of the path" if format is None else "format", name, FORMATS)
    return FORMATS[name]


def _check(run: Run) -> None:
    """Refuse what no log holds."""
    if not len(run) or 0 in run.shape:
        raise InvalidShape("run", f"{len(run)} rows of shape {run.shape}", "at least one row and one robot")
    for name in run.columns:
        try:
            name.encode()
        except UnicodeEncodeError:
            raise InvalidValue("columns", name, "names that UTF-8 can hold") from None
