"""What a reader starts from: bytes of bounded number, JSON without surprises, a refusal that names the place."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

from coplanar.errors import InvalidValue
from coplanar.run import Kind
from coplanar.run.files import text_of

LARGEST = 2**30  # bytes of a log that is read unless told otherwise
_PIECE = 2**20  # bytes read at a time


@dataclass(frozen=True, slots=True)
class Source:
    """What a reader works on.

    Attributes:
        path: The file.
        data: What it holds.
        kind: What kind of run to suppose where the file does not say.
        index: Its monotone column where the file does not say.
        largest: The most memory that a part of it, unpacked, may take [bytes].
    """

    path: Path
    data: bytes
    kind: str | Kind | None = None
    index: str | None = None
    largest: int = LARGEST


def contents(path: Path, largest: int) -> bytes:
    """All bytes of a file, if they are not more than ``largest``.

    Raises:
        InvalidValue: If it cannot be read, or is longer.
    """
    pieces, length = [], 0
    try:
        with path.open("rb") as file:
            while length <= largest and (piece := file.read(_PIECE)):
                pieces.append(piece)
                length += len(piece)
    except (OSError, ValueError) as error:
        raise InvalidValue("path", str(path), f"a file that can be read ({_reason(error)})") from None
    if length > largest:
        raise InvalidValue("path", str(path), f"a file of at most {largest} bytes", "allow more by largest=")
    return b"".join(pieces)


def refuse(path: Path, place: str, given: object, needed: str, remedy: str = "") -> NoReturn:
    """Refuse a file for what stands at a place in it.

    Raises:
        InvalidValue: Always.
    """
    raise InvalidValue(f"{place} of {path}" if place else str(path), given, needed, remedy)


def parsed_json(path: Path, text: str) -> Any:
    """What strict JSON says: NaN and Infinity are no JSON.

    Raises:
        InvalidValue: Naming the line.
    """
    try:
        return json.loads(text, parse_constant=_no_constant)
    except json.JSONDecodeError as error:
        refuse(path, f"line {error.lineno}", _around(text, error.pos), f"JSON ({error.msg})")
    except RecursionError:
        refuse(path, "", "lists within lists without end", "JSON of a sensible depth")
    except ValueError as error:
        refuse(path, "", str(error), "JSON")


def json_of(path: Path, data: bytes) -> Any:
    """What a file of strict JSON says.

    Raises:
        InvalidValue: Naming the byte or the line.
    """
    return parsed_json(path, text_of(path, data))


def _no_constant(word: str) -> NoReturn:
    raise ValueError(f"{word} is no number in JSON")


def _around(text: str, position: int) -> str:
    return text[max(0, position - 10) : position + 10]


def _reason(error: OSError | ValueError) -> str:
    return getattr(error, "strerror", None) or str(error)
