"""The search behind ``least_squares``: rows of small problems that advance together until each is done."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar.engine import evaluator
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.laws import squares as laws
from coplanar.solving.report import Iteration
from coplanar.solving.status import Status, code_of

DIFFERENCE = float(np.finfo(np.float64).eps) ** (1 / 3)  # central differences: truncation and rounding meet here
FEW = 3  # equations or unknowns that a closed form serves

_adapted = evaluator(laws.adapted)
_damping = evaluator(laws.damping)
_free = evaluator(laws.free)
_gain = evaluator(laws.gain)
_shortening = evaluator(laws.shortening)
_solve_three = evaluator(laws.solve_three)
_still = evaluator(laws.still)

_OPEN = code_of(Status.BUDGET_SPENT)


@dataclass(frozen=True, slots=True)
class Limits:
    """Bounds of x, each of shape (n,)."""

    lower: np.ndarray
    upper: np.ndarray

    @classmethod
    def of(cls, bounds: tuple[Any, Any] | None, n: int) -> Limits:
        """From a pair of numbers or vectors; infinite when None."""
        low, high = bounds if bounds is not None else (-np.inf, np.inf)
        try:
            lower, upper = (np.broadcast_to(np.asarray(b, dtype=float), (n,)) for b in (low, high))
        except ValueError:
            raise InvalidShape("bounds", f"{np.shape(low)}, {np.shape(high)}", f"two vectors of {n}") from None
        if not np.all(lower <= upper):
            raise InvalidValue("bounds", bounds, "lower <= upper in every entry")
        return cls(lower, upper)


@dataclass(frozen=True, slots=True)
class Problem:
    """Residual, Jacobian and bounds."""

    function: Callable[..., Any]
    jacobian: Callable[..., Any] | None
    limits: Limits

    def residual(self, x: np.ndarray, parameters: tuple[np.ndarray, ...], single: bool) -> np.ndarray:
        """F, shape (k, m)."""
        if single:
            return np.asarray(self.function(x[0], *(p[0] for p in parameters)), dtype=float).reshape(1, -1)
        value = np.asarray(self.function(x, *parameters), dtype=float)
        if value.ndim != 2 or value.shape[0] != x.shape[0]:
            raise InvalidShape("function", f"an answer of shape {value.shape}", f"shape ({x.shape[0]}, m), row by row")
        return value

    def slopes(self, x: np.ndarray, parameters: tuple[np.ndarray, ...], single: bool) -> tuple[np.ndarray, int]:
        """dF/dx, shape (k, m, n), and how many calls of the function it took."""
        if self.jacobian is None:
            return self._differences(x, parameters, single), 2 * x.shape[-1]
        if single:
            return np.asarray(self.jacobian(x[0], *(p[0] for p in parameters)), dtype=float)[None], 0
        return np.asarray(self.jacobian(x, *parameters), dtype=float), 0

    def _differences(self, x: np.ndarray, parameters: tuple[np.ndarray, ...], single: bool) -> np.ndarray:
        columns = []
        for i in range(x.shape[-1]):
            ahead, behind = x.copy(), x.copy()
            ahead[:, i] += DIFFERENCE * np.maximum(1.0, np.abs(x[:, i]))
            behind[:, i] -= DIFFERENCE * np.maximum(1.0, np.abs(x[:, i]))
            rise = self.residual(ahead, parameters, single) - self.residual(behind, parameters, single)
            columns.append(rise / (ahead - behind)[:, i, None])
        return np.stack(columns, axis=-1)


@dataclass(frozen=True, slots=True)
class Settings:
    """What the caller of ``least_squares`` chose."""

    method: str
    tolerance: float
    step_tolerance: float
    damping: float
    longest_step: float


class Search:
    """Where every row is; ``run`` moves those that are still open."""

    def __init__(
        self, problem: Problem, start: np.ndarray, parameters: tuple[np.ndarray, ...], *, single: bool
    ) -> None:
        self.problem, self.parameters, self.single = problem, parameters, single
        self.x = np.clip(start, problem.limits.lower, problem.limits.upper)
        rows = len(self.x)
        self.value = problem.residual(self.x, parameters, single)
        self.code = np.full(rows, _OPEN)
        self.used, self.calls = np.zeros(rows, dtype=int), np.ones(rows, dtype=int)
        self.lines: list[Iteration] = []

    def run(self, settings: Settings, budget: int) -> None:
        """Iterate until every row is done or the budget is spent."""
        tolerance = settings.tolerance
        self.factor = np.full(len(self.x), settings.damping)
        self._note(np.zeros(len(self.x)), np.zeros(len(self.x)), np.ones(len(self.x), dtype=bool))
        self.code[~np.isfinite(self.value).all(axis=-1)] = code_of(Status.NOT_FINITE)
        self._close(np.arange(len(self.x)), tolerance)
        for _ in range(budget):
            rows = np.flatnonzero(self.code == _OPEN)
            if not rows.size:
                break
            self._advance(rows, settings)
            self._close(rows, tolerance)

    def _advance(self, rows: np.ndarray, settings: Settings) -> None:
        """One step of the open rows."""
        x, value = self.x[rows], self.value[rows]
        parameters = tuple(p[rows] for p in self.parameters)
        slopes, calls = self.problem.slopes(x, parameters, self.single)
        step, damping = self._step(rows, slopes, settings)
        trial = np.clip(x + step, self.problem.limits.lower, self.problem.limits.upper)
        there = self.problem.residual(trial, parameters, self.single)
        expected = _square(value + np.einsum("kmn,kn->km", slopes, trial - x))
        gained = _gain(_square(value), expected, _square(there))
        self.factor[rows], fine = _adapted(self.factor[rows], gained)
        taken = np.isfinite(there).all(axis=-1) & ((fine > 0.0) | (settings.method == "newton"))
        length = np.sqrt(_square(np.where(np.isfinite(step), trial - x, np.inf)))
        self.calls[rows] += 1 + calls
        self.used[rows] += 1
        self.x[rows[taken]], self.value[rows[taken]] = trial[taken], there[taken]
        self._stop(rows, length, settings.step_tolerance)
        self._note(length, damping, taken)

    def _step(self, rows: np.ndarray, slopes: np.ndarray, settings: Settings) -> tuple[np.ndarray, np.ndarray]:
        """The step of every row, no longer than allowed, and its damping."""
        value = self.value[rows]
        if settings.method == "newton":
            damping, step = np.zeros(len(rows)), _newton_step(slopes, value)
        else:
            free = self._without_blocked(self.x[rows], value, slopes)
            damping = _damping(self.factor[rows], _square(value), _square(free.reshape(len(rows), -1)))
            step = _damped_step(free, value, damping)
        return step * _shortening(np.sqrt(_square(step)), settings.longest_step)[:, None], damping

    def _without_blocked(self, x: np.ndarray, value: np.ndarray, slopes: np.ndarray) -> np.ndarray:
        """The Jacobian without the columns of entries that stand at a bound and want to pass it."""
        limits, slope = self.problem.limits, np.einsum("kmn,km->kn", slopes, value)
        return np.asarray(slopes * _free(x, limits.lower, limits.upper, slope)[:, None, :])

    def _stop(self, rows: np.ndarray, length: np.ndarray, small: float) -> None:
        """Rows whose steps have become nothing, or do not exist."""
        still = _still(length, np.sqrt(_square(self.x[rows])), small)
        self.code[rows[still > 0.0]] = code_of(Status.STALLED)
        self.code[rows[~np.isfinite(length)]] = code_of(Status.SINGULAR)

    def _close(self, rows: np.ndarray, tolerance: float) -> None:
        done = _square(self.value[rows]) <= tolerance * tolerance
        self.code[rows[done]] = code_of(Status.CONVERGED)

    def _note(self, length: np.ndarray, damping: np.ndarray, taken: np.ndarray) -> None:
        if not self.single:
            return
        norm = float(np.sqrt(_square(self.value)[0]))
        numbers = int(self.used[0]), int(self.calls[0]), norm, float(length[0]), float(damping[0]), bool(taken[0])
        self.lines.append(Iteration(*numbers, tuple(self.x[0].tolist())))


def _square(rows: np.ndarray) -> np.ndarray:
    """|row|^2."""
    squares: np.ndarray = np.einsum("ki,ki->k", rows, rows)
    return squares


def _damped_step(slopes: np.ndarray, value: np.ndarray, damping: np.ndarray) -> np.ndarray:
    """-(J^T J + lambda I)^-1 J^T F, by the smaller of the two systems that give it."""
    m, n = slopes.shape[-2:]
    turned = slopes.swapaxes(-1, -2)
    if n >= m:
        return np.asarray(-(turned @ _solved(slopes @ turned, damping, value)[..., None])[..., 0])
    return -_solved(turned @ slopes, damping, (turned @ value[..., None])[..., 0])


def _solved(matrix: np.ndarray, damping: np.ndarray, right: np.ndarray) -> np.ndarray:
    """(matrix + lambda I)^-1 right, for each row; a system of up to three equations by its closed form."""
    size = matrix.shape[-1]
    if size > FEW:
        return np.asarray(np.linalg.solve(matrix + damping[:, None, None] * np.eye(size), right[..., None])[..., 0])
    whole, load = np.zeros((len(matrix), FEW, FEW)), np.zeros((len(matrix), FEW))
    whole[:, :size, :size], load[:, :size] = matrix, right
    a, b, c, d, e, f = (whole[:, i, j] for i, j in zip(*np.triu_indices(FEW), strict=True))
    parts = _solve_three(a + damping, b, c, d + damping, e, f + damping, *load.T)
    return np.stack(parts[:size], axis=-1)


def _newton_step(slopes: np.ndarray, value: np.ndarray) -> np.ndarray:
    """-J^+ F; infinite where J has not full rank."""
    rank = np.linalg.matrix_rank(slopes)
    step = -np.einsum("knm,km->kn", np.linalg.pinv(slopes), value)
    return np.where((rank < min(slopes.shape[-2:]))[:, None], np.inf, step)
