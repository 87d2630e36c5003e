"""Curves with a formula: line, circle, ellipse, lemniscate, astroid."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.curves.base import Curve, as_interval
from coplanar.engine import TAU, components, evaluator
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.laws import curves as laws
from coplanar.laws import se2

_act = evaluator(se2.act)
_rotate = evaluator(se2.rotate)
Laws = tuple[Callable[..., Any], Callable[..., Any], Callable[..., Any]]

_ELLIPSE: Laws = (evaluator(laws.ellipse), evaluator(laws.ellipse_rate), evaluator(laws.ellipse_second))
_LEMNISCATE: Laws = (evaluator(laws.lemniscate), evaluator(laws.lemniscate_rate), evaluator(laws.lemniscate_second))
_ASTROID: Laws = (evaluator(laws.astroid), evaluator(laws.astroid_rate), evaluator(laws.astroid_second))
_LINE: Laws = (evaluator(laws.line), evaluator(laws.line_rate), evaluator(laws.line_second))


@dataclass(frozen=True, slots=True)
class Line(Curve):
    """P0 + phi (P1 - P0), phi from 0 to 1.

    Attributes:
        start: P0 [m].
        end: P1 [m].

    Example:
        >>> Line((0, 0), (4, 2)).position(0.25).tolist()
        [1.0, 0.5]
    """

    start: ArrayLike
    end: ArrayLike
    interval: tuple[float, float] = field(default=(0.0, 1.0), kw_only=True)

    def __post_init__(self) -> None:
        for name in ("start", "end"):
            object.__setattr__(self, name, as_point(name, getattr(self, name)))
        object.__setattr__(self, "interval", as_interval(self.interval))
        if self.start == self.end:
            raise InvalidValue("end", self.end, "another point than start", "use HeldPoint for a reference that rests")

    @property
    def closed(self) -> bool:
        """A line never closes."""
        return False

    def _at(self, parameter: Real, order: int) -> tuple[Real, Real]:
        x, y = _LINE[order](parameter, *self.start, *self.end)
        return x, y


@dataclass(frozen=True, slots=True, kw_only=True)
class Placed(Curve):
    """A curve with a formula about its own centre, put somewhere: R(tilt) P(phi) + centre.

    Sizes, centres and tilts of any leading shape make many curves, which parameters broadcast with.

    Attributes:
        center: Where its middle stands, shape (..., 2) [m].
        tilt: How far it is turned counterclockwise [rad].
        interval: Of phi; all of it, 0 to 2 pi, closes the curve.
    """

    laws: ClassVar[Laws]
    sizes: ClassVar[tuple[str, ...]]
    center: ArrayLike = (0.0, 0.0)
    tilt: Real = 0.0
    interval: tuple[float, float] = (0.0, TAU)

    def __post_init__(self) -> None:
        for name in self.sizes:
            object.__setattr__(self, name, checks.frozen(checks.positive(name, getattr(self, name))))
        center = checks.vector("center", self.center, 2)
        object.__setattr__(self, "center", tuple(map(checks.frozen, components(center))))
        object.__setattr__(self, "tilt", checks.frozen(checks.real("tilt", self.tilt)))
        object.__setattr__(self, "interval", as_interval(self.interval))
        checks.broadcast(**{name: getattr(self, name) for name in (*self.sizes, "tilt")}, center=self.center[0])

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading shape of its sizes, centre and tilt, () for one curve."""
        return np.broadcast_shapes(*map(np.shape, (*self._sizes(), self.tilt, self.center[0])))

    @property
    def closed(self) -> bool:
        """Whether the interval holds whole turns."""
        turns = (self.interval[1] - self.interval[0]) / TAU
        return turns >= 1.0 and math.isclose(turns, round(turns), rel_tol=1e-12)

    def _at(self, parameter: Real, order: int) -> tuple[Real, Real]:
        own = self.laws[order](parameter, *self._sizes())
        x, y = _rotate(self.tilt, *own) if order else _act(*self.center, self.tilt, *own)
        return x, y

    def _sizes(self) -> tuple[Real, ...]:
        return tuple(getattr(self, name) for name in self.sizes)


@dataclass(frozen=True, slots=True)
class Circle(Placed):
    """(r cos phi, r sin phi).

    Attributes:
        radius: r [m].

    Example:
        >>> Circle(0.5, center=(1.0, 0.5)).position(0.0).tolist()
        [1.5, 0.5]
    """

    laws: ClassVar[Laws] = _ELLIPSE
    sizes: ClassVar[tuple[str, ...]] = ("radius",)
    radius: Real

    def _sizes(self) -> tuple[Real, ...]:
        return self.radius, self.radius


@dataclass(frozen=True, slots=True)
class Ellipse(Placed):
    """(a cos phi, b sin phi).

    Attributes:
        a: Half its length [m].
        b: Half its width [m].

    Example:
        >>> Ellipse(2.0, 1.0).position(0.0).tolist()
        [2.0, 0.0]
    """

    laws: ClassVar[Laws] = _ELLIPSE
    sizes: ClassVar[tuple[str, ...]] = ("a", "b")
    a: Real
    b: Real


@dataclass(frozen=True, slots=True)
class Lemniscate(Placed):
    """(a cos phi, b cos phi sin phi), the lemniscate of Gerono; it crosses its centre at phi = pi/2 and 3 pi/2.

    Attributes:
        a: Half its length [m].
        b: Its height [m]; as ``a`` unless given.

    Example:
        >>> Lemniscate(1.0).position(0.0).tolist()
        [1.0, 0.0]
    """

    laws: ClassVar[Laws] = _LEMNISCATE
    sizes: ClassVar[tuple[str, ...]] = ("a", "b")
    a: Real = 1.0
    b: Real = None

    def __post_init__(self) -> None:
        if self.b is None:
            object.__setattr__(self, "b", self.a)
        Placed.__post_init__(self)


@dataclass(frozen=True, slots=True)
class Astroid(Placed):
    """(a cos^3 phi, a sin^3 phi): four cusps, where a reference in time stops and reverses.

    Attributes:
        a: Distance of the cusps from the centre [m].

    Example:
        >>> Astroid(1.0).derivative(0.0).tolist() == [0.0, 0.0]
        True
    """

    laws: ClassVar[Laws] = _ASTROID
    sizes: ClassVar[tuple[str, ...]] = ("a",)
    a: Real = 1.0


def as_point(name: str, point: ArrayLike) -> tuple[float, float]:
    """One point (x, y).

    Raises:
        InvalidShape: If it is not two numbers.
    """
    xy = checks.vector(name, point, 2)
    if xy.ndim != 1:
        raise InvalidShape(name, f"shape {xy.shape}", "one point (x, y)")
    x, y = xy.tolist()
    return x, y


def as_number(name: str, value: ArrayLike) -> float:
    """One finite number.

    Raises:
        InvalidShape: If it is an array.
    """
    number = checks.real(name, value)
    if np.ndim(number):
        raise InvalidShape(name, f"shape {np.shape(number)}", "one number", "make one curve for each")
    return float(number)
