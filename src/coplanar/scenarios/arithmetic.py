"""Numbers as people write them: "pi/2", "30 deg", "3 km/h". A tiny grammar, nothing is evaluated as code.

value = number, pi, + - * / and parentheses; unit = factors like m, km/h, m/s^2, 1/s.
"""

from __future__ import annotations

import math
import re
from typing import NamedTuple

Dimensions = tuple[int, int, int, int]  # exponents of length, time, mass, angle

LONGEST = 80  # characters of a number with its unit: more is no number

_PLAIN = (0, 0, 0, 0)
_L, _T, _M, _A = (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)
UNITS: dict[str, tuple[float, Dimensions]] = {
    "m": (1.0, _L), "mm": (1e-3, _L), "cm": (1e-2, _L), "km": (1e3, _L),
    "in": (0.0254, _L), "inch": (0.0254, _L), "ft": (0.3048, _L), "yd": (0.9144, _L), "mi": (1609.344, _L),
    "s": (1.0, _T), "ms": (1e-3, _T), "us": (1e-6, _T), "min": (60.0, _T), "h": (3600.0, _T),
    "kg": (1.0, _M), "g": (1e-3, _M), "t": (1e3, _M), "lb": (0.45359237, _M), "oz": (0.028349523125, _M),
    "rad": (1.0, _A), "mrad": (1e-3, _A), "deg": (math.pi / 180.0, _A), "rev": (math.tau, _A), "turn": (math.tau, _A),
    "rpm": (math.tau / 60.0, (0, -1, 0, 1)), "mph": (0.44704, (1, -1, 0, 0)), "kn": (1852.0 / 3600.0, (1, -1, 0, 0)),
}  # fmt: skip
_SPELLINGS = str.maketrans({"²": "^2", "³": "^3", "°": "deg", "−": "-", "·": "*", "π": "pi", "µ": "u", "μ": "u"})
_TOKEN = re.compile(r"[ \t]*(?:((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|([A-Za-z]+)|([-+*/^()]))", re.ASCII)


class Measured(NamedTuple):
    """A number and the unit that was written with it.

    Attributes:
        value: In SI units and radians.
        dimensions: Exponents of length, time, mass and angle; None where no unit was written.
    """

    value: float
    dimensions: Dimensions | None


def measured(text: str) -> Measured:
    """The number that a text says.

    Raises:
        ValueError: With what is wrong, in words.

    Example:
        >>> measured("2*pi").dimensions, measured("20 cm"), measured("pi/2 rad/s").dimensions
        (None, Measured(value=0.2, dimensions=(1, 0, 0, 0)), (0, -1, 0, 1))
    """
    if len(text) > LONGEST:
        raise ValueError(f"a number has at most {LONGEST} characters")
    reader = _Reader(_tokens(text.translate(_SPELLINGS)))
    value = reader.sum()
    if not reader.tokens:
        return Measured(value, None)
    factor, dimensions = reader.unit()
    return Measured(value * factor, dimensions)


def _tokens(text: str) -> list[str]:
    found, place, end = [], 0, len(text.rstrip())
    while place < end:
        match = _TOKEN.match(text, place)
        if match is None:
            raise ValueError(f"{text[place:].strip()[:1]!r} belongs to no number")
        found.append(match[1] or match[2] or match[3])
        place = match.end()
    return found[::-1]


class _Reader:
    """Takes tokens off the end of a reversed list."""

    def __init__(self, tokens: list[str]) -> None:
        self.tokens = tokens

    def next(self) -> str:
        return self.tokens[-1] if self.tokens else ""

    def sum(self) -> float:
        total = self.product()
        while self.next() in ("+", "-"):
            sign = 1.0 if self.tokens.pop() == "+" else -1.0
            total += sign * self.product()
        return total

    def product(self) -> float:
        total = self.factor()
        while self.next() in ("*", "/") and not self._unit_follows():
            if self.tokens.pop() == "*":
                total *= self.factor()
                continue
            divisor = self.factor()
            if divisor == 0.0:
                raise ValueError("it divides by 0")
            total /= divisor
        return total

    def factor(self) -> float:
        token = self.tokens.pop() if self.tokens else "nothing"
        if token in ("+", "-"):
            return self.factor() if token == "+" else -self.factor()
        if token == "(":
            inside = self.sum()
            if not self.tokens or self.tokens.pop() != ")":
                raise ValueError("a bracket is not closed")
            return inside
        if token == "pi":
            return math.pi
        if token[0].isdigit() or token[0] == ".":
            return float(token)
        raise ValueError(f"{token!r} stands where a number should")

    def _unit_follows(self) -> bool:
        after = self.tokens[-2] if len(self.tokens) > 1 else ""
        return after in UNITS

    def unit(self) -> tuple[float, Dimensions]:
        """The rest as a unit: names with exponents, joined by * and /."""
        factor, dimensions, power = 1.0, _PLAIN, 1
        if self.next() == "1":
            self.tokens.pop()
        elif self.next() not in ("*", "/"):
            self.tokens.append("*")
        while self.tokens:
            sign = self.tokens.pop()
            if sign not in ("*", "/"):
                raise ValueError(f"{sign!r} stands where a unit should end")
            size, own = self._named()
            power = (1 if sign == "*" else -1) * self._exponent()
            factor *= size**power
            dimensions = tuple(a + power * b for a, b in zip(dimensions, own, strict=True))  # type: ignore[assignment]
        return factor, dimensions

    def _named(self) -> tuple[float, Dimensions]:
        name = self.tokens.pop() if self.tokens else "nothing"
        if name not in UNITS:
            raise ValueError(f"{name!r} is no unit that is known here")
        return UNITS[name]

    def _exponent(self) -> int:
        if self.next() == "^":
            self.tokens.pop()
        elif not self.next().isdigit():
            return 1
        power = self.tokens.pop() if self.tokens else ""
        if power not in ("1", "2", "3"):
            raise ValueError(f"{power!r} is no exponent of a unit")
        return int(power)
