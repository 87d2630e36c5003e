"""Small systems of equations by damped least squares (Levenberg-Marquardt) or Newton, one or many at a time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.errors import InvalidShape, InvalidValue, NoSolution
from coplanar.solving.report import Report
from coplanar.solving.search import Limits, Problem, Search, Settings
from coplanar.solving.status import Status, code_of, count_by_status, status_of

METHODS = ("damped", "newton")


@dataclass(frozen=True, slots=True)
class LeastSquaresResult:
    """Where the search ended, how, and what is left.

    Attributes:
        function: The residual function.
        parameters: What it was called with beside x.
        x: Shape (..., n).
        value: The residual there, shape (..., m).
        code: Place of the status in ``Status``, an int or an array of them.
        iterations: Steps tried, an int or an array.
        evaluations: Calls of the residual function for the row, those for differences among them; an int or an array.
        report: The iterations, for a single problem; empty for a batch.
    """

    function: Callable[..., Any]
    parameters: tuple[Any, ...]
    x: np.ndarray
    value: np.ndarray
    code: Any
    iterations: Any
    evaluations: Any
    report: Report

    @property
    def status(self) -> Any:
        """A ``Status``, or an object array of them for a batch."""
        return status_of(Status, self.code)

    @property
    def converged(self) -> Any:
        """Whether the residual is within its tolerance; an array of bool for a batch."""
        return self.code == code_of(Status.CONVERGED)

    def residual(self) -> Real:
        """Norm of the residual at ``x``, computed anew: a float, or an array for a batch."""
        norms = np.linalg.norm(self.function(self.x, *self.parameters), axis=-1)
        return float(norms) if norms.ndim == 0 else norms

    def or_raise(self) -> LeastSquaresResult:
        """This result if every row converged.

        Raises:
            NoSolution: With the sentence and this result, if a row did not.
        """
        if not np.all(self.converged):
            raise NoSolution(count_by_status(Status, self.code), self)
        return self


def least_squares(
    function: Callable[..., Any],
    start: ArrayLike,
    *,
    jacobian: Callable[..., Any] | None = None,
    parameters: Sequence[ArrayLike] = (),
    bounds: tuple[ArrayLike, ArrayLike] | None = None,
    method: str = "damped",
    tolerance: float = 1e-12,
    step_tolerance: float = 1e-14,
    damping: float = 0.1,
    longest_step: float = np.inf,
    iterations: int = 100,
) -> LeastSquaresResult:
    """Solve F(x) = 0 or minimise |F|: step = -J^T (J J^T + lambda I)^-1 F, lambda = damping |F|^2, adapted.

    The damping falls where the linear model predicts the residual well and rises where it does not, so far steps
    are short and near ones are Newton's. All rows of a batch advance together; those that are done drop out.

    Args:
        function: F(x, *parameters) of shapes (k, n) and (k, ...) to (k, m), row by row; (n,) to (m,) as well.
        start: First guess, shape (..., n).
        jacobian: dF/dx with the same arguments, shape (k, m, n); central differences when None.
        parameters: Arrays whose leading axes are those of ``start``.
        bounds: Lower and upper bound of x, each of shape (n,), infinite ones allowed.
        method: "damped", or "newton" for undamped full steps that are always taken (minimum norm where n > m).
        tolerance: |F| at which a row has converged [unit of F].
        step_tolerance: |step| below which a row has stalled, relative to 1 + |x|.
        damping: First lambda/|F|^2.
        longest_step: Longer steps are shortened to this norm [unit of x].
        iterations: Budget.

    Returns:
        x, residual, a status for each row, and for a single problem the report of every iteration.

    Raises:
        InvalidShape: If start, bounds or the function's answer do not fit together.
        InvalidValue: If start or a tolerance is not finite, or negative.
        UnknownName: If the method is neither.

    Source: Fan and Yuan 2005, Computing 74, 23-39 (lambda from |F|); Sugihara 2011, IEEE T-RO 27, 984 (for arms).

    Example:
        >>> def circle_and_line(x):
        ...     return np.stack([x[..., 0] ** 2 + x[..., 1] ** 2 - 2.0, x[..., 0] - x[..., 1]], axis=-1)
        >>> answer = least_squares(circle_and_line, [2.0, 0.5])
        >>> answer.x.round(9).tolist(), answer.status.name
        ([1.0, 1.0], 'CONVERGED')
    """
    x = np.asarray(checks.vector("start", start))
    checks.choice("method", method, METHODS)
    small = checks.not_negative("step_tolerance", step_tolerance)
    if iterations < 0 or not longest_step > 0.0:
        raise InvalidValue("iterations, longest_step", (iterations, longest_step), "0 or more, and above 0")
    settings = Settings(
        method,
        checks.not_negative("tolerance", tolerance),
        small,
        checks.not_negative("damping", damping),
        longest_step,
    )
    lead, n = x.shape[:-1], x.shape[-1]
    columns = tuple(_flat(p, lead) for p in parameters)
    problem = Problem(function, jacobian, Limits.of(bounds, n))
    with np.errstate(all="ignore"):  # what is not finite becomes a status
        search = Search(problem, x.reshape(-1, n), columns, single=not lead)
        search.run(settings, iterations)
    return _result(search, lead, tuple(np.asarray(p) for p in parameters))


def _flat(parameter: ArrayLike, lead: tuple[int, ...]) -> np.ndarray:
    """The parameter with its leading axes made one."""
    array = np.asarray(parameter)
    if array.shape[: len(lead)] != lead:
        raise InvalidShape("parameters", f"shape {array.shape}", f"leading axes {lead}, those of start")
    return array.reshape(-1, *array.shape[len(lead) :])


def _result(search: Search, lead: tuple[int, ...], parameters: tuple[np.ndarray, ...]) -> LeastSquaresResult:
    x, value = search.x.reshape(*lead, -1), search.value.reshape(*lead, -1)
    counts = (search.code, search.used, search.calls)
    code, used, calls = (c.reshape(lead) if lead else int(c[0]) for c in counts)
    report = Report(tuple(search.lines))
    return LeastSquaresResult(search.problem.function, parameters, x, value, code, used, calls, report)
