"""What every curve can do: position and two derivatives over an interval of its parameter."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import stack
from coplanar.errors import InvalidShape, InvalidValue

if TYPE_CHECKING:
    from coplanar.curves.reference import Reference

ROUNDING = 1e-12  # of the interval's length: a parameter this far outside is rounding, and is taken as the end


class Curve(ABC):
    """A curve of the plane by one parameter, with its first and second derivative.

    A closed curve repeats itself outside its interval. On an open one a parameter outside is an error.

    Attributes:
        interval: First and last value of the parameter.
    """

    __slots__ = ()
    interval: tuple[float, float]

    @property
    @abstractmethod
    def closed(self) -> bool:
        """Whether the curve ends where, and as, it starts."""

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading shape of what it is made of, () for one curve."""
        return ()

    @abstractmethod
    def _at(self, parameter: Real, order: int) -> tuple[Real, Real]:
        """The derivative of this order at parameters inside the interval."""

    def position(self, parameter: ArrayLike) -> np.ndarray:
        """P(phi) [m], shape (..., 2).

        Args:
            parameter: Shape (...), in the units of the curve's interval.

        Raises:
            InvalidValue: If a parameter is not finite, or outside the interval of an open curve.

        Example:
            >>> from coplanar.curves import Circle
            >>> Circle(2.0).position([0.0, 0.5]).round(3).tolist()
            [[2.0, 0.0], [1.755, 0.959]]
        """
        return self._derivative(parameter, 0)

    def derivative(self, parameter: ArrayLike) -> np.ndarray:
        """dP/dphi [m per unit of phi], shape (..., 2).

        Raises:
            InvalidValue: As ``position``.
        """
        return self._derivative(parameter, 1)

    def second_derivative(self, parameter: ArrayLike) -> np.ndarray:
        """d2P/dphi2 [m per unit of phi squared], shape (..., 2).

        Raises:
            InvalidValue: As ``position``.
        """
        return self._derivative(parameter, 2)

    def parameters(self, count: int) -> np.ndarray:
        """``count`` equally spaced parameters from one end of the interval to the other, shape (count,).

        Raises:
            InvalidValue: If the count is below 2.

        Example:
            >>> from coplanar.curves import Line
            >>> Line((0, 0), (1, 0)).parameters(3).tolist()
            [0.0, 0.5, 1.0]
        """
        if count < 2:
            raise InvalidValue("count", count, "2 or more")
        return np.linspace(*self.interval, count)

    def over(
        self, duration: float, *, start_time: float = 0.0, laps: float = 1.0, profile: str = "uniform"
    ) -> Reference:
        """The curve as a reference in time: run through in ``duration`` [s]; see ``Reference``.

        Example:
            >>> from coplanar.curves import Astroid
            >>> Astroid(1.0).over(10.0).position(5.0).round(12).tolist()
            [-1.0, 0.0]
        """
        from coplanar.curves.reference import Reference

        return Reference(self, duration, start_time=start_time, laps=laps, profile=profile)

    def _derivative(self, parameter: ArrayLike, order: int) -> np.ndarray:
        vector: np.ndarray = stack(self._at(self._inside(parameter), order))
        return vector

    def _inside(self, parameter: ArrayLike) -> Real:
        phi = checks.real("parameter", parameter)
        low, high = self.interval
        if self.closed:
            return phi
        slack = ROUNDING * (high - low)
        if np.any(np.less(phi, low - slack)) or np.any(np.greater(phi, high + slack)):
            raise InvalidValue("parameter", parameter, f"{low:g} to {high:g}: the curve is open")
        return np.clip(phi, low, high)


def as_interval(interval: ArrayLike) -> tuple[float, float]:
    """An interval of parameters (first, last), first < last.

    Raises:
        InvalidShape: If it is not two numbers.
        InvalidValue: If they do not increase.
    """
    ends = checks.vector("interval", interval, 2)
    if ends.ndim != 1:
        raise InvalidShape("interval", f"shape {ends.shape}", "two numbers (first, last)")
    low, high = ends.tolist()
    if not low < high:
        raise InvalidValue("interval", interval, "first < last")
    return low, high


def as_points(points: ArrayLike, fewest: int) -> np.ndarray:
    """A path of points, shape (n, 2), of which no neighbours coincide.

    Raises:
        InvalidShape: If it is not (n, 2), or too short.
        InvalidValue: If neighbours coincide.
    """
    path = checks.vector("points", points, 2)
    if path.ndim != 2 or len(path) < fewest:
        raise InvalidShape("points", f"shape {path.shape}", f"shape (n, 2) with n of at least {fewest}")
    same = np.flatnonzero((path[1:] == path[:-1]).all(-1))
    if same.size:
        raise InvalidValue("points", path[same[0]].tolist(), "neighbours that differ", f"remove point {same[0] + 1}")
    frozen: np.ndarray = checks.frozen(path)
    return frozen


def repeated(parameter: Real, interval: tuple[float, float]) -> Real:
    """The parameter of a closed curve brought into its interval by whole turns; both ends stay as they are.

    Example:
        >>> repeated(2.5, (0.0, 1.0)).tolist(), repeated(1.0, (0.0, 1.0)).tolist()
        (0.5, 1.0)
    """
    low, high = interval
    place = np.real(parameter)
    turns = np.where((place < low) | (place > high), np.floor((place - low) / (high - low)), 0.0)
    return parameter - (high - low) * turns
