"""Any curve that can be written as a Python function."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import Real
from coplanar.curves.base import Curve, as_interval, repeated
from coplanar.errors import InvalidShape, InvalidValue

# Fourth-order differences of five values, h apart: offsets and weights of h f' and of h^2 f''.
_MIDDLE = ((-2, 1 / 12, -1 / 12), (-1, -2 / 3, 4 / 3), (0, 0.0, -5 / 2), (1, 2 / 3, 4 / 3), (2, -1 / 12, -1 / 12))
# From one end; the second derivative is of third order.
_ONE_SIDED = (
    (0, -25 / 12, 35 / 12), (1, 4.0, -26 / 3), (2, -3.0, 19 / 2), (3, 4 / 3, -14 / 3), (4, -1 / 4, 11 / 12),
)  # fmt: skip
_STEPS = (0.0, 1e-3, 3e-3)  # of the scale: near eps^(1/5) for the first derivative, eps^(1/6) for the second
_EPS = 2.220446049250313e-16


@dataclass(frozen=True, slots=True)
class FreeCurve(Curve):
    """A curve given by a function phi -> (x, y).

    Derivatives that are not given are taken by five-point differences. For a function that is smooth over ``scale``
    (its fifth and sixth derivatives about 1/scale^5 and 1/scale^6 of its size) the first is good to 1e-11 of
    size/scale, the second to 1e-8 of size/scale^2 and 1e-6 at the ends of an open one;
    ``derivative_error`` estimates the first for the function at hand. With ``differences="complex"`` the first
    derivative is Im f(phi + i h)/h, good to rounding, for functions that accept complex numbers and are analytic
    there (no ``abs``, no comparisons).

    Attributes:
        function: phi of shape (...) -> the two arrays (x, y), or one array (..., 2).
        interval: First and last phi.
        first: dP/dphi, a function of the same form.
        second: d2P/dphi2, a function of the same form.
        closed: Whether it ends where, and as, it starts.
        scale: The change of phi over which the curve changes by its size; an eighth of the interval unless given.
        differences: "central" or "complex".

    Example:
        >>> parabola = FreeCurve(lambda u: (u, u * u), (-1.0, 1.0))
        >>> parabola.derivative(0.5).round(9).tolist()
        [1.0, 1.0]
    """

    function: Callable[..., Any]
    interval: tuple[float, float]
    first: Callable[..., Any] | None = None
    second: Callable[..., Any] | None = None
    closed: bool = False
    scale: float = 0.0
    differences: str = "central"

    def __post_init__(self) -> None:
        low, high = as_interval(self.interval)
        checks.choice("differences", self.differences, ("central", "complex"))
        scale = checks.not_negative("scale", self.scale) or (high - low) / 8.0
        for name in ("function", "first", "second"):
            given = getattr(self, name)
            if not (callable(given) or (given is None and name != "function")):
                raise InvalidValue(name, given, "a function phi -> (x, y)")
        object.__setattr__(self, "interval", (low, high))
        object.__setattr__(self, "scale", min(scale, (high - low) / 8.0))
        self._at(low, 0)

    def derivative_error(self, parameter: Real) -> Real:
        """An estimate of the error of ``derivative`` [m per unit of phi], shape (...).

        Differences with the step and with twice the step differ by 15 times the truncation error of the first;
        rounding adds at most 11 eps |P|/h. Zero where the derivative was given.

        Example:
            >>> circle = FreeCurve(lambda u: (np.cos(u), np.sin(u)), (0.0, 6.0))
            >>> bool(circle.derivative_error(1.0) < 1e-10)
            True
        """
        phi = self._inside(parameter)
        if self.first is not None:
            return 0.0 * phi
        size = np.abs(self._values(phi)).max(-1)
        if self.differences == "complex":
            return _EPS * size / self.scale
        step = _STEPS[1] * self.scale
        apart = np.abs(self._differences(phi, 1, 2.0 * step) - self._differences(phi, 1, step)).max(-1)
        return apart / 15.0 + 11.0 * _EPS * size / step

    def _at(self, parameter: Real, order: int) -> tuple[Real, Real]:
        given = (self.function, self.first, self.second)[order]
        if given is not None:
            vector = self._values(parameter, given)
        elif order == 1 and self.differences == "complex":
            tiny = 1e-30 * self.scale
            vector = self._values(parameter + 1j * tiny, dtype=np.complex128).imag / tiny
        else:
            vector = self._differences(parameter, order, _STEPS[order] * self.scale)
        return vector[..., 0], vector[..., 1]

    def _differences(self, phi: Real, order: int, step: float) -> np.ndarray:
        low, high = self.interval
        if self.closed:
            return self._stencil(_MIDDLE, phi, order, step)
        inward = np.where(phi - low < 2.0 * step, step, -step)
        at_an_end = (phi - low < 2.0 * step) | (high - phi < 2.0 * step)
        middle = np.clip(phi, low + 2.0 * step, high - 2.0 * step)
        from_end = self._stencil(_ONE_SIDED, np.where(at_an_end, phi, 0.5 * (low + high)), order, inward)
        return np.where(np.expand_dims(at_an_end, -1), from_end, self._stencil(_MIDDLE, middle, order, step))

    def _stencil(self, table: tuple[tuple[float, ...], ...], phi: Real, order: int, step: Real) -> np.ndarray:
        total = sum(row[order] * self._values(phi + row[0] * step) for row in table)
        divided: np.ndarray = total / np.expand_dims(np.power(step, order), -1)
        return divided

    def _values(self, phi: Real, function: Callable[..., Any] | None = None, dtype: Any = np.float64) -> np.ndarray:
        """What the function says at phi, as an array (..., 2)."""
        phi = repeated(np.asarray(phi), self.interval) if self.closed else np.asarray(phi)
        answer = (function or self.function)(phi)
        parts = tuple(answer) if isinstance(answer, tuple | list) else (np.asarray(answer),)
        try:
            vector = np.stack([np.broadcast_to(p, phi.shape) for p in parts], -1) if len(parts) == 2 else parts[0]
            vector = np.asarray(vector, dtype)
        except (TypeError, ValueError):
            vector = np.empty(0, dtype)
        if vector.shape != (*phi.shape, 2):
            raise InvalidShape("function", _shapes(parts), f"(x, y) of shape {phi.shape} each", "use NumPy functions")
        if not np.isfinite(vector).all():
            raise InvalidValue("function", vector.tolist(), f"finite points for phi in {self.interval}")
        return vector


def _shapes(parts: tuple[Any, ...]) -> str:
    return "shapes " + ", ".join(str(np.shape(p)) for p in parts)
