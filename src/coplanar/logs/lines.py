"""Whole lines of a stream of bytes of any length, in constant memory; gzip is seen by its content."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterator
from itertools import chain
from typing import NamedTuple

from coplanar.errors import InvalidValue

BLOCK = 1 << 18  # [bytes] of text that is worked on at once
PACKED = 1 << 14  # [bytes] of gzip at once: at most 1032 times as much comes out
LONGEST = 1 << 18  # [bytes] of a line
GZIP, ZIP = b"\x1f\x8b", b"PK\x03\x04"
UTF8, UTF16 = b"\xef\xbb\xbf", (b"\xff\xfe", b"\xfe\xff")

WITH_HEADER = zlib.MAX_WBITS + 16

Reader = Callable[[int], bytes]


class Lines(NamedTuple):
    """Some whole lines.

    Attributes:
        first: Number of the first one, counted from 1.
        text: Their bytes; the last one ends with a newline too.
    """

    first: int
    text: bytes


def whole_lines(read: Reader, name: str) -> Iterator[Lines]:
    r"""The lines of a stream, in blocks of some thousands.

    Args:
        read: Gives up to so many bytes, as soon as there are any, and none at the end.
        name: What an error calls the stream.

    Raises:
        InvalidValue: Naming the line at which gzip breaks off, a line is endless, or the bytes are not text.

    Example:
        >>> from io import BytesIO
        >>> list(whole_lines(BytesIO(b"1 2\n3 4").read, "log"))
        [Lines(first=1, text=b'1 2\n'), Lines(first=2, text=b'3 4\n')]
    """
    first, rest = 1, b""
    try:
        for piece in _unpacked(read):
            rest += piece
            end = rest.rfind(b"\n") + 1
            yield from _blocks(first, rest[:end], name)
            first, rest = first + rest.count(b"\n", 0, end), rest[end:]
            _check_length(rest, first, name)
    except (zlib.error, EOFError) as error:
        needed = "gzip that can be unpacked to its end"
        raise InvalidValue(f"line {first} of {name}", str(error), needed) from None
    if rest:
        yield from _blocks(first, rest + b"\n", name)


def _unpacked(read: Reader) -> Iterator[bytes]:
    """The bytes, unpacked if they begin as gzip does."""
    head = _head(read)
    if not head.startswith(GZIP):
        yield from chain([head], iter(lambda: read(BLOCK), b""))
        return
    machine, complete = zlib.decompressobj(WITH_HEADER), False
    for packed in chain([head], iter(lambda: read(PACKED), b"")):
        while packed := packed.lstrip(b"\0") if complete else packed:  # zeros fill tapes
            yield machine.decompress(packed)
            complete, packed = machine.eof, machine.unused_data
            if complete:  # another member may follow
                machine = zlib.decompressobj(WITH_HEADER)
    if not complete:
        raise EOFError("the gzip data break off")


def _head(read: Reader) -> bytes:
    """The first bytes: as many as tell what they are."""
    head = b""
    while len(head) < len(ZIP) and (more := read(PACKED)):
        head += more
    return head


def _blocks(first: int, text: bytes, name: str) -> Iterator[Lines]:
    """Whole lines in blocks of about ``BLOCK`` bytes."""
    begin = 0
    while begin < len(text):
        end = text.rfind(b"\n", begin, begin + BLOCK) + 1
        if end == 0:
            end = text.index(b"\n", begin) + 1
        block = text[begin:end].removeprefix(UTF8) if first == 1 else text[begin:end]
        _check_text(block, first, name)
        yield Lines(first, block)
        first += block.count(b"\n")
        begin = end


def _check_length(rest: bytes, line: int, name: str) -> None:
    if len(rest) > LONGEST:
        _check_text(rest, line, name)
        raise InvalidValue(f"line {line} of {name}", rest[:20], f"lines of at most {LONGEST} bytes", "is it a table?")


def _check_text(text: bytes, first: int, name: str) -> None:
    """Refuse bytes that no table of numbers has."""
    if first == 1 and text.startswith(UTF16):
        raise InvalidValue(f"line 1 of {name}", "UTF-16", "UTF-8", "save the table as UTF-8")
    if first == 1 and text.startswith(ZIP):
        raise InvalidValue(f"line 1 of {name}", "a ZIP archive", "text, or gzip of it", "unpack the archive first")
    place = text.find(b"\0")
    if place >= 0:
        line = first + text.count(b"\n", 0, place)
        raise InvalidValue(f"line {line} of {name}", "bytes that are not text", "lines of numbers")
