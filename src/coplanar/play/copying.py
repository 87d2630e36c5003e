"""Code that does again what a tab shows: text from fixed words and formatted numbers alone."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from coplanar.errors import InvalidValue


def number(value: float) -> str:
    """A finite number as Python reads it, to the last bit.

    Raises:
        InvalidValue: If it is not finite.

    Example:
        >>> number(0.1), number(2)
        ('0.1', '2.0')
    """
    if not math.isfinite(value):
        raise InvalidValue("number", value, "a finite number")
    return repr(float(value))


def numbers(values: Iterable[float]) -> str:
    """A tuple of numbers.

    Example:
        >>> numbers([1, 2.5]), numbers([1])
        ('(1.0, 2.5)', '(1.0,)')
    """
    parts = [number(v) for v in values]
    return f"({parts[0]},)" if len(parts) == 1 else f"({', '.join(parts)})"


def points(values: Sequence[Sequence[float]]) -> str:
    """A list of points, a few a line."""
    parts = [f"({number(x)}, {number(y)})" for x, y in values]
    rows = [", ".join(parts[i : i + 4]) for i in range(0, len(parts), 4)]
    return "[\n    " + ",\n    ".join(rows) + ",\n]"


def program(imports: Iterable[str], lines: Iterable[str], shown: Iterable[tuple[str, str]]) -> str:
    """Imports, lines, and one ``key = value`` printed for every pair (key, expression)."""
    prints = [f'print("{key} =", repr(float({expression})))' for key, expression in shown]
    return "\n".join((*imports, "", *lines, "", *prints, ""))
