"""The records of a WPILOG: how one is written, and what a log holds.

A log is a header and records; a record is a byte of lengths, an entry's number, the size of the payload, a stamp in
microseconds, the payload; all integers are little-endian and as long as the byte says. Records of entry 0 control the
others: start (0), finish (1), set metadata (2). Nothing that a log says of its own lengths is believed: every length
is held against the bytes that are there.

Source: WPILib Data Log File Format Specification 1.0.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from pathlib import Path

from coplanar.logs.files import refuse

MAGIC = b"WPILOG"
VERSION = 0x0100
START, FINISH, SET_METADATA = range(3)


@dataclass(slots=True)
class Entry:
    """What a log holds of one entry, while it is read.

    Attributes:
        type: The name of its type.
        payload: The payloads of its records, one after the other.
        count: How many records there are.
        size: How long the payload of the first is [bytes].
        even: Whether all are as long as the first.
    """

    type: str
    payload: bytearray = field(default_factory=bytearray)
    count: int = 0
    size: int = 0
    even: bool = True

    def add(self, payload: memoryview) -> None:
        """Another record."""
        if not self.count:
            self.size = len(payload)
        self.even = self.even and len(payload) == self.size
        self.count += 1
        self.payload += payload


def header(extra: str = "") -> bytes:
    """The beginning of a log."""
    text = extra.encode()
    return MAGIC + struct.pack("<HI", VERSION, len(text)) + text


def record(entry: int, stamp: int, payload: bytes) -> bytes:
    """One record, its integers as short as they can be.

    Example:
        >>> record(1, 1_000_000, b"").hex()
        '20010040420f'
    """
    parts = [_integer(entry), _integer(len(payload)), _integer(stamp)]
    lengths = sum(len(part) - 1 << shift for part, shift in zip(parts, (0, 2, 4), strict=True))
    return bytes([lengths]) + b"".join(parts) + payload


def start(entry: int, name: str, type: str, stamp: int, metadata: str = "") -> bytes:
    """The record that begins an entry."""
    texts = b"".join(_prefixed(text.encode()) for text in (name, type, metadata))
    return record(0, stamp, struct.pack("<BI", START, entry) + texts)


def finish(entry: int, stamp: int) -> bytes:
    """The record that ends an entry."""
    return record(0, stamp, struct.pack("<BI", FINISH, entry))


def entries_of(path: Path, data: bytes) -> dict[str, Entry]:
    """What a log holds, by the names of its entries.

    Raises:
        InvalidValue: If it is no log, or ends within a record, or names what is not there; with the byte.
    """
    view = memoryview(data)
    place = _after_header(path, view)
    entries: dict[str, Entry] = {}
    active: dict[int, Entry] = {}
    while place < len(view):
        number, payload, after = _record_at(path, view, place)
        if number == 0:
            _control(path, place, payload, entries, active)
        elif number in active:
            active[number].add(payload)
        else:
            refuse(path, f"byte {place}", f"a record of entry {number}", "a record that starts the entry first")
        place = after
    return entries


def _after_header(path: Path, view: memoryview) -> int:
    if len(view) < 12 or view[:6] != MAGIC:
        refuse(path, "byte 0", bytes(view[:12]), "a WPILOG header of 12 bytes")
    version, extra = struct.unpack_from("<HI", view, 6)
    if version >> 8 != VERSION >> 8:
        refuse(path, "byte 6", f"version {version >> 8}.{version & 0xFF}", "version 1 of the format")
    if extra > len(view) - 12:
        refuse(path, "byte 8", f"{extra} bytes of extra header", f"at most {len(view) - 12}, for the file ends there")
    return 12 + int(extra)


def _record_at(path: Path, view: memoryview, place: int) -> tuple[int, memoryview, int]:
    """The number of the entry, the payload, and where the next record begins."""
    lengths = view[place]
    sizes = (lengths & 3) + 1, (lengths >> 2 & 3) + 1, (lengths >> 4 & 7) + 1
    begin = place + 1 + sum(sizes)
    number = int.from_bytes(view[place + 1 : place + 1 + sizes[0]], "little")
    size = int.from_bytes(view[place + 1 + sizes[0] : place + 1 + sizes[0] + sizes[1]], "little")
    if begin + size > len(view):
        refuse(
            path, f"byte {place}", f"a record of {begin - place + size} bytes", f"{len(view) - place}: the file ends"
        )
    return number, view[begin : begin + size], begin + size


def _control(
    path: Path, place: int, payload: memoryview, entries: dict[str, Entry], active: dict[int, Entry]
) -> None:  # fmt: skip
    where = f"byte {place}"
    if len(payload) < 5 or payload[0] > SET_METADATA:
        refuse(path, where, bytes(payload[:8]), "a control record: start, finish or set metadata")
    kind, number = struct.unpack_from("<BI", payload)
    if kind == START:
        name, after = _text(path, where, payload, 5)
        type, after = _text(path, where, payload, after)
        _text(path, where, payload, after)
        if name in entries or number in active:
            refuse(path, where, f"entry {number}, {name!r}", "a number and a name that are not taken")
        entries[name] = active[number] = Entry(type)
    elif number not in active:
        refuse(path, where, f"entry {number}", "an entry that was started")
    elif kind == FINISH:
        del active[number]


def _text(path: Path, where: str, payload: memoryview, begin: int) -> tuple[str, int]:
    """A text with its length before it, and where it ends."""
    size = struct.unpack_from("<I", payload, begin)[0] if len(payload) >= begin + 4 else len(payload)
    end = begin + 4 + int(size)
    if end > len(payload):
        refuse(path, where, f"a text of {size} bytes", f"at most {len(payload)}: the record ends")
    try:
        return str(payload[begin + 4 : end], "utf-8"), end
    except UnicodeDecodeError:
        refuse(path, where, bytes(payload[begin + 4 : end]), "text in UTF-8")


def _integer(value: int) -> bytes:
    return value.to_bytes(max(1, (value.bit_length() + 7) // 8), "little")


def _prefixed(text: bytes) -> bytes:
    return struct.pack("<I", len(text)) + text
