"""Integrators side by side: how far each is off at which step, its observed order, the largest step that will do."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.integrators import METHODS, Rates, integrate_ode

COUNTS = (8, 16, 32, 64, 128, 256)
ROUNDING = 1e-12  # of the largest state: an error below this is rounding and says nothing of the order


@dataclass(frozen=True, slots=True, eq=False)
class IntegratorComparison:
    """The answer of ``compare_integrators``.

    Attributes:
        rates: ``rates(t, y)``.
        duration: From 0 [s].
        start: State at 0, shape (n,).
        exact: States at times (k,), shape (k, n).
        measured: Which entries of the state make up the distance.
        methods: Names, from ``integrators.METHODS``.
        counts: Numbers of equal steps, increasing.
        errors: Largest distance from the exact states at any step, shape (methods, counts); infinite where a state is
            no longer finite.
    """

    rates: Rates
    duration: float
    start: np.ndarray
    exact: Callable[[np.ndarray], np.ndarray]
    measured: tuple[int, ...]
    methods: tuple[str, ...]
    counts: tuple[int, ...]
    errors: np.ndarray

    @property
    def steps(self) -> np.ndarray:
        """Lengths of the steps, shape (counts,) [s]."""
        return self.duration / np.array(self.counts)

    def times(self, count: int) -> np.ndarray:
        """The ends of ``count`` equal steps, and 0, shape (count + 1,) [s]."""
        return np.linspace(0.0, self.duration, count + 1)

    def path(self, method: str, count: int) -> np.ndarray:
        """The states of a method after each of ``count`` equal steps, shape (count + 1, n).

        Raises:
            InvalidValue: If a state is no longer finite.
        """
        return integrate_ode(self.rates, self.times(count), self.start, method=method)

    def error(self, method: str, count: int) -> float:
        """Largest distance of a method from the exact states at any of ``count`` steps; infinite if it diverges."""
        try:
            states = self.path(method, count)
        except InvalidValue:
            return float("inf")
        off = (states - self.exact(self.times(count)))[:, self.measured]
        return float(np.sqrt((off * off).sum(axis=1)).max())

    def order(self, method: str) -> float | None:
        """The slope of the error over the step, both logarithmic, at the smallest errors above rounding; None without.

        Raises:
            UnknownName: If the method was not compared.
        """
        row = self.errors[self.methods.index(checks.choice("method", method, self.methods))]
        floor = ROUNDING * max(1.0, float(np.abs(self.exact(self.times(16))).max()))
        seen = [(n, e) for n, e in zip(self.counts, row.tolist(), strict=True) if floor < e < float("inf")]
        if len(seen) < 2:
            return None
        (n1, e1), (n2, e2) = seen[-2:]
        return float(np.log(e1 / e2) / np.log(n2 / n1))

    def largest_step(
        self, method: str, tolerance: float = 1e-3, *, most: int = 100_000, precision: float = 1e-3
    ) -> float:
        """The longest of equal steps whose error is within a tolerance [s]; 0 if it takes more than ``most`` of them.

        Args:
            method: A name of ``integrators.METHODS``.
            tolerance: Largest distance [m, the unit of what is measured]: 1e-3 is a millimetre.
            most: How many steps are tried at most.
            precision: How well the number of steps is found, as a part of it [-].

        Raises:
            InvalidValue: If the tolerance is not positive.

        Example:
            >>> decay = compare_integrators(lambda t, y: -y, 1.0, [1.0], exact=lambda t: np.exp(-t)[:, None])
            >>> round(1.0 / decay.largest_step("euler")), round(1.0 / decay.largest_step("rk4"))
            (185, 2)
        """
        allowed = checks.positive("tolerance", tolerance)
        few, many = 0, 1
        while (error := self.error(method, many)) > allowed:
            if many >= most:
                return 0.0
            few, many = many, min(most, _next_count(METHODS[method].order, many, error / allowed))
        while many - few > max(1.0, precision * many):
            middle = (few + many) // 2
            few, many = (few, middle) if self.error(method, middle) <= allowed else (middle, many)
        return self.duration / many


def compare_integrators(
    rates: Rates, duration: float, y0: ArrayLike, *, exact: Callable[[np.ndarray], Any] | None = None,
    methods: Sequence[str] = ("euler", "midpoint", "heun", "rk4"), counts: Sequence[int] = COUNTS,
    measured: Sequence[int] | None = None,
) -> IntegratorComparison:  # fmt: skip
    """Integrate y' = rates(t, y) by several methods and numbers of steps, and measure how far each is off.

    Args:
        rates: ``rates(t, y)`` of the state's shape (n,).
        duration: From 0 [s].
        y0: State at 0, shape (n,).
        exact: The true states at times (k,), shape (k, n); DOP853 at 1e-13 if None.
        methods: Names of ``integrators.METHODS``.
        counts: Numbers of equal steps, increasing.
        measured: Which entries of the state make up the distance, (0, 1) for the position of a pose; all if None.

    Raises:
        InvalidShape: If the state is no vector, or the exact states are of another shape.
        InvalidValue: If the duration is not positive or the counts do not increase from 1 or more.
        UnknownName: If a method is not known.

    Example:
        >>> answer = compare_integrators(lambda t, y: -y, 1.0, [1.0], exact=lambda t: np.exp(-t)[:, None])
        >>> [round(answer.order(method), 1) for method in answer.methods]
        [1.0, 2.0, 2.0, 4.0]
    """
    length, start = float(checks.positive("duration", duration)), np.asarray(checks.vector("y0", y0))
    if start.ndim != 1:
        raise InvalidShape("y0", f"shape {start.shape}", "a vector (n,)")
    for method in methods:
        checks.choice("method", method, METHODS)
    whole = _increasing(counts)
    truth = exact or _by_dop853(rates, start)
    given = np.shape(truth(np.array([0.0, length])))
    if given != (2, start.size):
        raise InvalidShape("exact", f"shape {given} at two times", f"shape (2, {start.size})")
    entries = tuple(range(start.size)) if measured is None else tuple(measured)
    bare = IntegratorComparison(rates, length, start, truth, entries, tuple(methods), whole, np.empty(0))
    errors = np.array([[bare.error(method, count) for count in whole] for method in methods])
    return IntegratorComparison(rates, length, start, truth, entries, bare.methods, whole, checks.frozen(errors))


def _increasing(counts: Sequence[int]) -> tuple[int, ...]:
    whole = tuple(int(count) for count in counts)
    if not whole or whole[0] < 1 or any(b <= a for a, b in itertools.pairwise(whole)):
        raise InvalidValue("counts", counts, "whole numbers that increase from 1 or more")
    return whole


def _next_count(order: int, count: int, too_much: float) -> int:
    """Where the error would be small enough by the order of the method; between one and eight times as many."""
    grown = too_much ** (1.0 / order) if too_much < 1e12 else 8.0
    return 1 + int(count * min(8.0, 1.005 * grown))


def _by_dop853(rates: Rates, start: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    def states(t: np.ndarray) -> np.ndarray:
        tight = {"relative_tolerance": 1e-13, "absolute_tolerance": 1e-14}
        return integrate_ode(rates, t, start, method="DOP853", **tight)

    return states
