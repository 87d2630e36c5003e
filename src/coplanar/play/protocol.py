"""What goes over the wire: strict JSON both ways, bounded in size and depth.

Every request carries the whole state of its tab, so that an answer depends on nothing but the request.

    {"id": n, "do": "describe"}
        -> {"id", "ok": true, "tabs": [{"name", "title", "about", "controls": [...]}]}
    {"id": n, "do": "show", "tab": "arm", "state": {...}, "live": true, "changed": "q1",
     "drag": {"handle": "tool", "to": [x, y]}}
        ``state``: missing keys take their defaults. ``changed``: the key that was just set by hand, where it matters
        what follows what. ``drag`` or ``nudge`` {"handle": "tool", "by": [1, 0]} (arrow keys: right, up; whole numbers
        of the handle's own step) move a handle. ``live`` asks for an answer in time for the next frame.
        -> {"id", "ok": true, "tab", "state": {complete}, "complete": true,
            "pictures": {"main": scene, ...},
            "handles": [{"id", "label", "at": [x, y], "picture", "keys": {"step", "unit"}, "value"}],
            "readouts": [{"key", "label", "value", "unit", "group", "number"}],
            "sentences": [{"tone": "good|note|warn|no", "text"}],
            "series": [{"title", "unit", "x": {"label", "values"}, "lines": [{"label", "values", "role"}]}],
            "legends": {"main": [{"label", "role", "dashed"}]}}
        ``complete`` is false where a live answer left something out: ask again with the returned state, not live, when
        the hand rests. ``value`` of a readout is text; ``number``, where present, the number that it was made from.
        A scene is described by ``coplanar.viz.scene``. ``null`` among the values of a series is a gap. A series has
        "log": true where both axes are logarithmic; the ``role`` of a line is its colour, empty for the next one.
    {"id": n, "do": "copy", "as": "python" | "yaml", "tab", "state"}
        -> {"id", "ok": true, "text"}
    anything else
        -> {"id", "ok": false, "error": {"sentence", "key", "given", "needed"}}
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

from coplanar.errors import CoplanarError, InvalidInput, InvalidShape, InvalidValue

LONGEST = 64 * 1024  # characters of a request
DEEPEST = 6  # levels of nesting of a request
ENTRIES = 4000  # of all lists and mappings of a request together
NAMED = 80  # characters of what was given that an error repeats


def read(message: str | bytes | Mapping[str, Any]) -> dict[str, Any]:
    """The request: a mapping from strings to plain values.

    Raises:
        InvalidInput: If it is too long, not strict JSON, no mapping, too deep or too large.
    """
    if isinstance(message, str | bytes):
        message = _parsed(message)
    if not isinstance(message, Mapping):
        raise InvalidValue("message", message, "a mapping with an id and what to do")
    _bounded(message)
    return dict(message)


def written(answer: Mapping[str, Any]) -> str:
    """The answer as strict JSON, without blanks.

    Raises:
        ValueError: If a number is not finite.
    """
    return json.dumps(answer, separators=(",", ":"), allow_nan=False, ensure_ascii=False)


def refusal(identity: int | None, error: CoplanarError) -> dict[str, Any]:
    """The answer to what cannot be answered."""
    given = getattr(error, "given", None)
    about = {
        "sentence": str(error),
        "key": str(getattr(error, "name", "")),
        "given": given if isinstance(given, bool | int | str) or _finite(given) else " ".join(repr(given).split()),
        "needed": str(getattr(error, "needed", "")),
    }
    about = {
        name: value[:NAMED] if name == "given" and isinstance(value, str) else value for name, value in about.items()
    }
    if isinstance(about["given"], int) and abs(about["given"]) > 2**53:
        about["given"] = "a number of too many digits"
    return {"id": identity, "ok": False, "error": about}


def identity_of(request: Mapping[str, Any]) -> int | None:
    """The request's id where it is a whole number that every JSON reader keeps, otherwise None."""
    number = request.get("id")
    fine = isinstance(number, int) and not isinstance(number, bool) and abs(number) <= 2**53
    return number if fine else None


def plain(value: float) -> float | None:
    """A number that JSON can hold: None where it is not finite."""
    return float(value) if math.isfinite(value) else None


def _parsed(text: str | bytes) -> Any:
    if len(text) > LONGEST:
        raise InvalidShape("message", f"{len(text)} characters", f"at most {LONGEST} characters")
    try:
        return json.loads(text, parse_constant=_no_constant)
    except (ValueError, RecursionError):
        raise InvalidInput("message", text[:40], "JSON (without NaN and Infinity)") from None


def _no_constant(name: str) -> float:
    raise ValueError(name)


def _bounded(message: Any) -> None:
    """Refuse what is deeper or larger than any honest request."""
    level, count = [message], 0
    for _ in range(DEEPEST + 1):
        inner: list[Any] = []
        for value in level:
            inner += _entries(value)
        count += len(inner)
        if count > ENTRIES:
            raise InvalidShape("message", "too many entries", f"at most {ENTRIES} in all")
        level = inner
    if level:
        raise InvalidShape("message", f"more than {DEEPEST} levels", f"at most {DEEPEST} levels of nesting")


def _entries(value: Any) -> list[Any]:
    if isinstance(value, Mapping):
        if not all(isinstance(key, str) for key in value):
            raise InvalidValue("message", value, "text as keys")
        return list(value.values())
    if isinstance(value, list | tuple):
        return list(value)
    if isinstance(value, float) and not math.isfinite(value):
        raise InvalidValue("message", value, "finite numbers")
    if value is None or isinstance(value, bool | int | float | str):
        return []
    raise InvalidValue("message", type(value).__name__, "what JSON can hold")


def _finite(value: Any) -> bool:
    return isinstance(value, float) and math.isfinite(value)
