"""What is varied: values one after another, or draws from a distribution."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.errors import InvalidValue

MOST_VALUES = 1_000_000
FORMS = "lo:hi:n, lo:hi:n:log, a,b,c, lo:hi (uniform draws) or mean+-deviation (normal draws)"


@dataclass(frozen=True, slots=True)
class Values:
    """Each of these, one after another.

    Attributes:
        values: Numbers, truth values or words.
    """

    values: tuple[Any, ...]

    def __post_init__(self) -> None:
        values = tuple(v.item() if isinstance(v, np.generic) else v for v in self.values)
        if not values:
            raise InvalidValue("values", values, "one value at least")
        object.__setattr__(self, "values", values)


@dataclass(frozen=True, slots=True)
class Uniform:
    """Draws that are equally likely anywhere from ``low`` to ``high``.

    Attributes:
        low: As the key takes it: a number in SI units, or a text with a unit.
        high: The same.
    """

    low: Any
    high: Any


@dataclass(frozen=True, slots=True)
class Normal:
    """Draws from the normal distribution.

    Attributes:
        mean: As the key takes it: a number in SI units, or a text with a unit.
        deviation: Standard deviation, in SI units.
    """

    mean: Any
    deviation: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "deviation", checks.not_negative("deviation", self.deviation))


@dataclass(frozen=True, slots=True)
class Span:
    """A number of values from ``low`` to ``high``, both included, equally apart or in equal ratios.

    Attributes:
        low: As the key takes it.
        high: The same.
        count: How many.
        ratio: Whether neighbours stand in one ratio, and not at one distance.
    """

    low: Any
    high: Any
    count: int
    ratio: bool = False

    def between(self, low: float, high: float) -> Values:
        """The values, from bounds in SI units.

        Raises:
            InvalidValue: If ratios are asked of bounds that are not both positive or both negative.
        """
        if self.ratio and low * high <= 0.0:
            raise InvalidValue("bounds", (low, high), "two of one sign for equal ratios")
        spread = np.geomspace if self.ratio else np.linspace
        return Values(tuple(float(v) for v in spread(low, high, self.count)))


Vary = Values | Uniform | Normal | Span


def read_vary(text: str) -> Vary:
    """What a text says is to be varied.

    Args:
        text: ``lo:hi:n`` equally spaced, ``lo:hi:n:log`` in equal ratios, ``a,b,c`` these; ``lo:hi`` uniform draws,
            ``mean+-deviation`` normal draws. Bounds and values may have units.

    Raises:
        InvalidValue: If it is none of these.

    Example:
        >>> read_vary("0:10 deg:3"), read_vary("euler,rk4")
        (Span(low='0', high='10 deg', count=3, ratio=False), Values(values=('euler', 'rk4')))
    """
    low, *rest = (part.strip() for part in text.split(":"))
    if not all((low, *rest)):
        raise InvalidValue("vary", text, FORMS)
    if not rest:
        return _listed(text)
    if len(rest) == 1:
        return Uniform(low, rest[0])
    if len(rest) > 3 or not re.fullmatch(r"[0-9]{1,7}", rest[1]) or rest[2:] not in ([], ["log"]):
        raise InvalidValue("vary", text, FORMS)
    count = int(rest[1])
    if not 1 <= count <= MOST_VALUES:
        raise InvalidValue("vary", text, f"1 to {MOST_VALUES} values")
    return Span(low, rest[0], count, rest[2:] == ["log"])


def as_vary(given: Any) -> Vary:
    """A text as ``read_vary`` takes it, a list or array of values, or one of the classes above."""
    if isinstance(given, Values | Uniform | Normal | Span):
        return given
    if isinstance(given, str):
        return read_vary(given)
    if isinstance(given, Sequence) or (isinstance(given, np.ndarray) and given.ndim == 1):
        return Values(tuple(given))
    raise InvalidValue("vary", given, "a list of values, a text, Uniform or Normal")


def _listed(text: str) -> Vary:
    mean, sign, deviation = text.replace("±", "+-").partition("+-")
    if not sign:
        values = tuple(value.strip() for value in text.split(","))
        if not all(values):
            raise InvalidValue("vary", text, FORMS)
        return Values(values)
    try:
        return Normal(mean.strip(), float(deviation))
    except ValueError:
        raise InvalidValue("vary", text, "mean+-deviation, the deviation a number in SI units") from None
