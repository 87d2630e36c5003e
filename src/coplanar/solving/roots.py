"""Roots between two ends: Brent's method for one function of floats, Chandrupatla's for arrays of brackets."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.errors import InvalidValue, NoSolution
from coplanar.solving.status import Status, code_of, count_by_status, status_of

EPSILON = float(np.finfo(np.float64).eps)
_BRACKETED = code_of(Status.BRACKETED)
_NO_SIGN_CHANGE = code_of(Status.NO_SIGN_CHANGE)
_BUDGET_SPENT = code_of(Status.BUDGET_SPENT)
_NOT_FINITE = code_of(Status.NOT_FINITE)


@dataclass(frozen=True, slots=True)
class RootResult:
    """A root between two ends, or an honest no.

    Attributes:
        function: The function whose root was asked for.
        x: The root; where there is none, the end with the smaller absolute value of the function.
        value: The function at ``x``. Far from 0 at a converged ``x``, the sign changes by a jump and not by a root.
        lower: First end, as given.
        upper: Other end, as given.
        code: Place of the status in ``Status``, an int or an array of them.
        iterations: An int or an array.
        evaluations: Calls of the function.
    """

    function: Callable[[Any], Any]
    x: Real
    value: Real
    lower: Real
    upper: Real
    code: Any
    iterations: Any
    evaluations: int

    @property
    def status(self) -> Any:
        """A ``Status``, or an object array of them for a batch."""
        return status_of(Status, self.code)

    @property
    def converged(self) -> Any:
        """Whether a root is bracketed to within the tolerance; an array of bool for a batch."""
        return self.code == _BRACKETED

    def residual(self) -> Real:
        """The function at ``x``, computed anew."""
        return self.function(self.x)

    def or_raise(self) -> RootResult:
        """This result if every row has its root.

        Raises:
            NoSolution: With the sentence and this result, if a row has none.

        Example:
            >>> bracketed_root(lambda x: x * x - 2.0, 0.0, 2.0).or_raise().x
            1.41421356237...
        """
        if not np.all(self.converged):
            raise NoSolution(count_by_status(Status, self.code), self)
        return self


def bracketed_root(
    function: Callable[[Any], Any],
    lower: ArrayLike,
    upper: ArrayLike,
    *,
    tolerance: float = 1e-12,
    iterations: int = 100,
) -> RootResult:
    """Root x of f(x) = 0 in [lower, upper], where f changes its sign between the ends.

    Floats are solved by Brent's method; arrays by Chandrupatla's, all rows at once, ``function`` being called on the
    whole broadcast shape. Rows that are done are asked again at the same place.

    Args:
        function: Takes a float and returns one; or takes an array and returns one of the same shape, row by row.
        lower: One end, in either order [unit of x].
        upper: The other end.
        tolerance: Width of the last bracket [unit of x]; never below 4 roundings of x.
        iterations: Budget.

    Returns:
        Root, value, status, iterations; ``.or_raise()`` for those who prefer an exception.

    Raises:
        InvalidValue: If an end is not finite, or the tolerance or the budget is negative.
        InvalidShape: If the ends do not broadcast.

    Source: Brent 1973, ch. 4; Chandrupatla 1997, Advances in Engineering Software 28, 145-149.

    Example:
        >>> answer = bracketed_root(lambda x: x**3 - 2.0, np.zeros(2), np.array([2.0, 1.0]))
        >>> answer.x.round(9).tolist(), [s.name for s in answer.status]
        ([1.25992105, 1.0], ['BRACKETED', 'NO_SIGN_CHANGE'])
    """
    a, b = checks.real("lower", lower), checks.real("upper", upper)
    shape = checks.broadcast(lower=a, upper=b)
    width = checks.not_negative("tolerance", tolerance)
    if iterations < 1:
        raise InvalidValue("iterations", iterations, "1 or more")
    if not shape:
        return _brent(function, float(a), float(b), width, iterations)
    return _chandrupatla(function, np.broadcast_to(a, shape), np.broadcast_to(b, shape), width, iterations)


class _NotANumber(Exception):
    """The function answered NaN, at ``args[0]``."""


def _brent(function: Callable[[float], float], a: float, b: float, tolerance: float, budget: int) -> RootResult:
    fa, fb = float(function(a)), float(function(b))
    code = _code_of_ends(fa, fb)
    x, used = (b if abs(fb) < abs(fa) else a), 0
    seen = {a: fa, b: fb}
    if code == _BUDGET_SPENT:
        from scipy.optimize import brentq

        width = max(tolerance, 4 * EPSILON * max(abs(a), abs(b), EPSILON))
        settings = {"xtol": width, "rtol": 4 * EPSILON, "maxiter": budget, "full_output": True, "disp": False}
        try:
            x, info = brentq(_remembering(function, seen), a, b, **settings)
            code, used = (_BRACKETED if info.converged else _BUDGET_SPENT), info.iterations
        except _NotANumber as place:
            x, code = place.args[0], _NOT_FINITE
    calls = len(seen)
    return RootResult(function, x, seen.get(x, np.nan), a, b, code, used, calls)


def _remembering(function: Callable[[float], float], seen: dict[float, float]) -> Callable[[float], float]:
    """The function, asked once at each place."""

    def at(x: float) -> float:
        if x not in seen:
            seen[x] = float(function(x))
        if seen[x] != seen[x]:
            raise _NotANumber(x)
        return seen[x]

    return at


def _code_of_ends(fa: float, fb: float) -> int:
    """What the ends alone say; the budget counts as spent until a search says otherwise."""
    if fa != fa or fb != fb:
        return _NOT_FINITE
    if fa == 0.0 or fb == 0.0:
        return _BRACKETED
    return _NO_SIGN_CHANGE if (fa > 0.0) == (fb > 0.0) else _BUDGET_SPENT


def _chandrupatla(function: Any, a: np.ndarray, b: np.ndarray, tolerance: float, budget: int) -> RootResult:
    with np.errstate(all="ignore"):
        rows = _Brackets(function, a, b)
        for _ in range(budget):
            if not rows.open.any():
                break
            rows.narrow(tolerance)
        rows.close(tolerance)
    x, value = rows.best()
    return RootResult(function, x, value, a, b, rows.code, rows.used, rows.calls)


class _Brackets:
    """Brackets that shrink: (x1, x2) holds the sign change, x3 is the point that was dropped last."""

    def __init__(self, function: Any, a: np.ndarray, b: np.ndarray) -> None:
        self.function, self.calls = function, 2
        self.x1, self.x2, self.x3 = a.astype(float), b.astype(float), b.astype(float)
        self.f1, self.f2 = self._at(self.x1), self._at(self.x2)
        self.f3 = self.f2.copy()
        self.part = np.full(a.shape, 0.5)
        self.used = np.zeros(a.shape, dtype=int)
        self.code = np.full(a.shape, _BUDGET_SPENT)
        self.code[np.sign(self.f1) == np.sign(self.f2)] = _NO_SIGN_CHANGE
        self.code[np.isnan(self.f1) | np.isnan(self.f2)] = _NOT_FINITE
        self.code[(self.f1 == 0.0) | (self.f2 == 0.0)] = _BRACKETED

    @property
    def open(self) -> np.ndarray:
        return np.asarray(self.code == _BUDGET_SPENT)

    def _at(self, x: np.ndarray) -> np.ndarray:
        value = np.asarray(self.function(x.copy()), dtype=float)
        return np.array(np.broadcast_to(value, x.shape))

    def best(self) -> tuple[np.ndarray, np.ndarray]:
        """The end with the smaller absolute value; the first end where that is NaN."""
        first = ~(np.abs(self.f2) < np.abs(self.f1))
        return np.where(first, self.x1, self.x2), np.where(first, self.f1, self.f2)

    def narrow(self, tolerance: float) -> None:
        """Ask at the next point of every open row and keep the half with the sign change."""
        going = self.open
        x, _ = self.best()
        x = np.where(going, self.x1 + self.part * (self.x2 - self.x1), x)
        f = self._at(x)
        self.calls += 1
        self.used += going
        same = np.sign(f) == np.sign(self.f1)
        self.x3 = np.where(going, np.where(same, self.x1, self.x2), self.x3)
        self.f3 = np.where(going, np.where(same, self.f1, self.f2), self.f3)
        turn = going & ~same
        self.x2, self.f2 = np.where(turn, self.x1, self.x2), np.where(turn, self.f1, self.f2)
        self.x1, self.f1 = np.where(going, x, self.x1), np.where(going, f, self.f1)
        self.code[going & np.isnan(f)] = _NOT_FINITE
        self.close(tolerance)
        self._aim(tolerance)

    def close(self, tolerance: float) -> None:
        """Note the rows that are narrow enough or have hit the root."""
        x, f = self.best()
        narrow = np.abs(self.x2 - self.x1) <= np.maximum(tolerance, 4 * EPSILON * np.abs(x))
        self.code[self.open & (narrow | (f == 0.0))] = _BRACKETED

    def _aim(self, tolerance: float) -> None:
        """Where to ask next, as a part of the bracket: inverse quadratic where it is safe, else the middle."""
        x, _ = self.best()
        f1, f2, f3 = self.f1, self.f2, self.f3
        width = self.x2 - self.x1
        least = np.minimum(0.5, (2 * EPSILON * np.abs(x) + 0.5 * tolerance) / np.abs(width))
        xi, phi = (self.x1 - self.x2) / (self.x3 - self.x2), (f1 - f2) / (f3 - f2)
        safe = (phi**2 < xi) & ((1.0 - phi) ** 2 < 1.0 - xi)
        quadratic = f1 / (f2 - f1) * f3 / (f2 - f3) + (self.x3 - self.x1) / width * f1 / (f3 - f1) * f2 / (f3 - f2)
        part = np.where(safe & np.isfinite(quadratic), quadratic, 0.5)
        self.part = np.clip(part, least, 1.0 - least)
