"""Curves through given points: straight pieces, or a cubic spline."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.curves.base import Curve, as_points, repeated
from coplanar.engine import evaluator
from coplanar.errors import InvalidValue
from coplanar.laws import curves as laws

_line = (evaluator(laws.line), evaluator(laws.line_rate), evaluator(laws.line_second))


@dataclass(frozen=True, slots=True)
class Polyline(Curve):
    """Straight pieces from point to point; the parameter is the length run [m].

    At a corner the derivative is that of the piece that begins there, and the bend is not in the second derivative.

    Attributes:
        points: Shape (n, 2) [m]; neighbours differ.
        closed: Whether a last piece leads back to the first point.

    Example:
        >>> square = Polyline([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True)
        >>> square.interval, square.position([0.5, 3.5]).tolist()
        ((0.0, 4.0), [[0.5, 0.0], [0.0, 0.5]])
    """

    points: ArrayLike
    closed: bool = field(default=False, kw_only=True)
    interval: tuple[float, float] = field(init=False)
    _knots: np.ndarray = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        points = as_points(_closing(self.points) if self.closed else self.points, 2)
        knots = _lengths(points)
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "interval", (0.0, float(knots[-1])))
        object.__setattr__(self, "_knots", knots)

    def _at(self, parameter: Real, order: int) -> tuple[Real, Real]:
        s = repeated(parameter, self.interval) if self.closed else parameter
        piece = np.clip(np.searchsorted(self._knots, s, side="right") - 1, 0, len(self._knots) - 2)
        start, end = self.points[piece], self.points[piece + 1]
        length = self._knots[piece + 1] - self._knots[piece]
        ends = start[..., 0], start[..., 1], end[..., 0], end[..., 1]
        x, y = _line[order]((s - self._knots[piece]) / length, *ends)
        return (x / length, y / length) if order else (x, y)


@dataclass(frozen=True, slots=True)
class Spline(Curve):
    """The cubic spline through points, continuous in position and two derivatives (SciPy's ``CubicSpline``).

    Attributes:
        points: Shape (n, 2) [m]; neighbours differ.
        knots: The parameter at each point, increasing; the summed straight distances [m] unless given.
        closed: Whether it comes back to the first point as smoothly as elsewhere (periodic).
        ends: Of an open spline: "natural" (no bend at the ends), "not-a-knot" or "clamped" (rest at the ends).

    Example:
        >>> Spline([(0, 0), (1, 0), (3, 0)]).position(2.0).tolist()
        [2.0, 0.0]
    """

    points: ArrayLike
    knots: ArrayLike | None = field(default=None, kw_only=True)
    closed: bool = field(default=False, kw_only=True)
    ends: str = field(default="natural", kw_only=True)
    interval: tuple[float, float] = field(init=False)
    _spline: Any = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        from scipy.interpolate import CubicSpline

        ends = checks.choice("ends", self.ends, ("natural", "not-a-knot", "clamped"))
        points = as_points(_closing(self.points) if self.closed else self.points, 3 if self.closed else 2)
        knots = _lengths(points) if self.knots is None else _as_knots(self.knots, len(points))
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "knots", checks.frozen(knots))
        object.__setattr__(self, "interval", (float(knots[0]), float(knots[-1])))
        object.__setattr__(self, "_spline", CubicSpline(knots, points, bc_type="periodic" if self.closed else ends))

    def _at(self, parameter: Real, order: int) -> tuple[Real, Real]:
        vector = self._spline(repeated(parameter, self.interval) if self.closed else parameter, order)
        return vector[..., 0], vector[..., 1]


def _as_knots(knots: ArrayLike, count: int) -> np.ndarray:
    known = checks.monotone("knots", knots)
    if len(known) != count or known[0] > known[-1]:
        raise InvalidValue(
            "knots", knots, f"{count} increasing numbers", "a closed spline also needs the one where it closes"
        )
    return known


def _closing(points: ArrayLike) -> np.ndarray:
    path = as_points(points, 3)
    return path if (path[0] == path[-1]).all() else np.concatenate([path, path[:1]])


def _lengths(points: np.ndarray) -> np.ndarray:
    """Summed straight distances from the first point."""
    pieces = np.diff(points, axis=0)
    return np.concatenate([[0.0], np.cumsum(np.hypot(pieces[:, 0], pieces[:, 1]))])
