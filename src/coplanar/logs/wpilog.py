"""A run as a WPILOG: what AdvantageScope and WPILib's tools open.

| entry | type | what |
|---|---|---|
| /columns/NAME | double, or double[] for a batch | every column as it is, t among them |
| /pose | struct:Pose2d, or struct:Pose2d[] for a batch | x, y, theta, where there are these columns |
| /speeds | struct:ChassisSpeeds, or an array of them | the commands, in the robot's own frame |
| /joints | double[] | q1 ... qn of an arm |
| /run | json | kind, index, status, warnings, info |

Every row is stamped with its time in whole microseconds (a run that begins before 0 is shifted to begin at 0, for
viewers take no negative stamps); the time itself, to the last bit, is in /columns/t. The types Pose2d and ChassisSpeeds
are described by their own entries below /.schema, as the format's structs want it.

Source: WPILib Data Log File Format Specification 1.0; WPILib Packed Struct Serialization Specification 1.0.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from coplanar.logs.description import column_of, described, run_of
from coplanar.logs.files import Source, parsed_json, refuse
from coplanar.logs.stamps import stamps_of
from coplanar.logs.wpilog_records import Entry, entries_of, finish, header, record, start
from coplanar.run import Run
from coplanar.run.files import text_of

MICROSECONDS = 1_000_000  # a second
SCHEMAS = {
    "Translation2d": "double x;double y",
    "Rotation2d": "double value",
    "Pose2d": "Translation2d translation;Rotation2d rotation",
    "ChassisSpeeds": "double vx;double vy;double omega",
}
_COLUMNS = "/columns/"


class _Series(NamedTuple):
    """An entry of the log with its doubles, one row for each row of the run."""

    name: str
    type: str
    values: np.ndarray


def write(run: Run, path: Path) -> None:
    """Write the log.

    Raises:
        InvalidValue: If the times are beyond 64 bits of microseconds.
    """
    stamps = stamps_of(run, MICROSECONDS, bits=63)
    first, last = int(stamps[0]), int(stamps[-1])
    series = [*_columns(run), *_poses(run), *_speeds(run), *_joints(run)]
    texts = [(f"/.schema/struct:{name}", "structschema", text) for name, text in SCHEMAS.items()]
    texts.append(("/run", "json", described(run)))
    with path.open("xb") as file:
        file.write(header())
        for entry, (name, kind, text) in enumerate(texts, 1):
            file.write(start(entry, name, kind, first) + record(entry, first, text.encode()))
        numbers = range(len(texts) + 1, len(texts) + 1 + len(series))
        for entry, one in zip(numbers, series, strict=True):
            file.write(start(entry, one.name, one.type, first))
        file.write(_rows(series, numbers, stamps))
        for entry in range(1, numbers.stop):
            file.write(finish(entry, last))


def read(source: Source) -> Run:
    """The run of such a log.

    Raises:
        InvalidValue: Naming the byte where the log breaks off, or the entry that is missing or of another form.
    """
    path, entries = source.path, entries_of(source.path, source.data)
    if "/run" not in entries or entries["/run"].type != "json":
        refuse(path, "", f"entries {list(entries)[:8]}", "an entry /run, as write_log writes it")
    description = parsed_json(path, text_of(path, bytes(entries["/run"].payload)))
    columns = {
        name.removeprefix(_COLUMNS): _column(path, name, entry, description)
        for name, entry in entries.items()
        if name.startswith(_COLUMNS)
    }
    return run_of(path, columns, description)


def _column(path: Path, name: str, entry: Entry, description: object) -> np.ndarray:
    if entry.type not in ("double", "double[]") or not entry.even:
        refuse(path, f"entry {name}", entry.type, "doubles, as many in every record")
    return column_of(path, name.removeprefix(_COLUMNS), entry.payload, entry.count, description)


def _rows(series: list[_Series], numbers: range, stamps: np.ndarray) -> bytes:
    """All records of all rows: they are of one length, so that a row is one packed structure."""
    most = 8 * max(math.prod(one.values.shape[1:]) for one in series)
    entry_bytes, size_bytes, stamp_bytes = (_bytes_for(n) for n in (numbers[-1], most, int(stamps.max())))
    lengths = (entry_bytes - 1) | (size_bytes - 1) << 2 | (stamp_bytes - 1) << 4
    fields: list[tuple[str, str, tuple[int, ...]]] = []
    for entry, one in zip(numbers, series, strict=True):
        fields.append((f"head{entry}", "u1", (1 + entry_bytes + size_bytes,)))
        fields.append((f"stamp{entry}", "u1", (stamp_bytes,)))
        fields.append((f"data{entry}", "<f8", one.values.shape[1:]))
    table = np.empty(len(stamps), np.dtype(fields))
    stamped = stamps.astype("<u8").view("u1").reshape(-1, 8)[:, :stamp_bytes]
    for entry, one in zip(numbers, series, strict=True):
        size = table.dtype[f"data{entry}"].itemsize
        head = bytes([lengths]) + entry.to_bytes(entry_bytes, "little") + size.to_bytes(size_bytes, "little")
        table[f"head{entry}"] = np.frombuffer(head, "u1")
        table[f"stamp{entry}"] = stamped
        table[f"data{entry}"] = one.values
    return table.tobytes()


def _bytes_for(number: int) -> int:
    return max(1, (number.bit_length() + 7) // 8)


def _columns(run: Run) -> Iterator[_Series]:
    for name, values in run.columns.items():
        yield _Series(_COLUMNS + name, "double[]" if values.ndim > 1 else "double", values)


def _poses(run: Run) -> Iterator[_Series]:
    if {"x", "y", "theta"} <= set(run.columns):
        yield _structs(run, "/pose", "Pose2d", ("x", "y", "theta"))


def _speeds(run: Run) -> Iterator[_Series]:
    commands = set(run.names.commands)
    if {"v", "omega"} <= commands:
        yield _structs(run, "/speeds", "ChassisSpeeds", ("v", None, "omega"))
    elif {"vx", "vy", "omega"} <= commands:
        yield _structs(run, "/speeds", "ChassisSpeeds", ("vx", "vy", "omega"))


def _joints(run: Run) -> Iterator[_Series]:
    if run.kind == "arm" and run.names.states and not run.shape:
        yield _Series("/joints", "double[]", run.states)


def _structs(run: Run, name: str, struct: str, columns: tuple[str | None, ...]) -> _Series:
    """Structs of doubles side by side; one array of them for the robots of a batch."""
    shape = (len(run), *run.shape)
    parts = [np.zeros(shape) if c is None else np.broadcast_to(_aligned(run, c), shape) for c in columns]
    table = np.stack(parts, axis=-1).reshape(len(run), len(parts) * math.prod(run.shape))
    return _Series(name, f"struct:{struct}{'[]' if run.shape else ''}", table)


def _aligned(run: Run, name: str) -> np.ndarray:
    """A column with as many axes as the batch."""
    values = run[name]
    return values.reshape(len(run), *(1,) * (len(run.shape) - values.ndim + 1), *values.shape[1:])
