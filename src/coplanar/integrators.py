"""Integrators of ordinary differential equations: a method is a row of a table, or one of SciPy's.

Sources: Butcher 2016, Numerical Methods for Ordinary Differential Equations, ch. 3; Hairer, Norsett, Wanner 1993,
Solving Ordinary Differential Equations I, sec. II.1.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike
from coplanar.errors import InvalidShape, InvalidValue, NoSolution

Rates = Callable[..., ArrayLike]

SCIPY_METHODS = ("RK23", "RK45", "DOP853", "Radau", "BDF", "LSODA")


@dataclass(frozen=True, slots=True)
class ButcherTableau:
    """An explicit Runge-Kutta method: k_i = f(t + c_i h, y + h sum_j a_ij k_j), y' = y + h sum_i b_i k_i.

    Attributes:
        name: What it is called.
        order: The error of a step is of the order h^(order + 1).
        a: Row i holds the weights of the slopes before slope i; the first row is empty.
        b: Weight of each slope.
        c: When each slope is taken, as a fraction of the step.

    Raises:
        InvalidShape: If the table is not one of an explicit method.
        InvalidValue: If the weights do not sum to 1, or a row not to its c (to 1e-12).

    Example:
        >>> METHODS["rk4"].step(lambda t, y: y, 0.0, 1.0, 0.1)
        1.1051708333333332
    """

    name: str
    order: int
    a: tuple[tuple[float, ...], ...]
    b: tuple[float, ...]
    c: tuple[float, ...]

    def __post_init__(self) -> None:
        if not len(self.a) == len(self.b) == len(self.c) or any(len(row) != i for i, row in enumerate(self.a)):
            given = (self.a, self.b, self.c)
            raise InvalidShape("a, b, c", given, "s weights, s times, and rows of 0, 1 ... s - 1 entries")
        sums = (sum(self.b) - 1.0, *(sum(row) - c for row, c in zip(self.a, self.c, strict=True)))
        if max(map(abs, sums)) > 1e-12:
            raise InvalidValue("a, b, c", (self.a, self.b, self.c), "sum(b) = 1 and sum(a_i) = c_i")

    def step(self, rates: Rates, t: float, y: Any, h: float) -> Any:
        """The state after one step of length h [s], which may be negative.

        Args:
            rates: ``rates(t, y)``, of the state's shape.
            t: Time [s].
            y: State.
            h: Step [s].
        """
        slopes: list[Any] = []
        for row, c in zip(self.a, self.c, strict=True):
            slopes.append(rates(t + c * h, _moved(y, h, row, slopes)))
        return _moved(y, h, self.b, slopes)


def _moved(y: Any, h: float, weights: tuple[float, ...], slopes: list[Any]) -> Any:
    """The state moved along the weighted slopes for the time h."""
    for weight, slope in zip(weights, slopes, strict=True):
        y = y + (h * weight) * slope if weight else y
    return y


METHODS: Mapping[str, ButcherTableau] = MappingProxyType(
    {
        method.name: method
        for method in (
            ButcherTableau("euler", 1, ((),), (1.0,), (0.0,)),
            ButcherTableau("midpoint", 2, ((), (0.5,)), (0.0, 1.0), (0.0, 0.5)),
            ButcherTableau("heun", 2, ((), (1.0,)), (0.5, 0.5), (0.0, 1.0)),
            ButcherTableau(
                "rk4", 4, ((), (0.5,), (0.0, 0.5), (0.0, 0.0, 1.0)), (1 / 6, 1 / 3, 1 / 3, 1 / 6), (0.0, 0.5, 0.5, 1.0)
            ),
        )
    }
)


def integrate_ode(
    rates: Rates,
    t: ArrayLike,
    y0: ArrayLike,
    *,
    method: str | ButcherTableau = "rk4",
    held: ArrayLike | None = None,
    relative_tolerance: float = 1e-10,
    absolute_tolerance: float = 1e-12,
) -> np.ndarray:
    """Solve y' = rates(t, y) from y(t[0]) = y0 at the times t.

    Args:
        rates: ``rates(t, y)``, or ``rates(t, y, u)`` where inputs are held; of the state's shape.
        t: Strictly increasing or decreasing times [s], shape (n,). A table's method takes one step for each interval.
        y0: State at t[0], any shape.
        method: A name of ``METHODS`` or ``SCIPY_METHODS``, or a table of your own.
        held: Inputs that are constant between two times, shape (n - 1, ...).
        relative_tolerance: Of SciPy's methods, per state [1].
        absolute_tolerance: Of SciPy's methods [unit of the state].

    Returns:
        States at the times, shape (n, ...).

    Raises:
        InvalidShape: If the rates are not of the state's shape, found at the first step; or ``held`` is not n - 1 long.
        InvalidValue: If the times are not strictly monotone, or a state is no longer finite.
        UnknownName: If there is no such method.
        NoSolution: If a method of SciPy gives up; it holds SciPy's answer.

    Example:
        >>> integrate_ode(lambda t, y: -y, [0.0, 0.5, 1.0], 1.0, method="euler").tolist()
        [1.0, 0.5, 0.25]
    """
    times, first = checks.monotone("t", t), np.asarray(checks.real("y0", y0))
    inputs = None if held is None else _held(held, times.size)
    table = method if isinstance(method, ButcherTableau) else METHODS.get(method)
    if table is None:
        checks.choice("method", str(method), (*METHODS, *SCIPY_METHODS))
    _check_rates(rates, times[0], first, inputs)
    states = np.empty((times.size, *first.shape))
    states[0] = first
    with np.errstate(over="ignore", invalid="ignore"):
        if table is not None:
            _by_table(table, rates, times, states, inputs)
        else:
            _by_scipy(str(method), rates, times, states, inputs, (relative_tolerance, absolute_tolerance))
    return _finite(times, states)


def _held(held: ArrayLike, count: int) -> np.ndarray:
    inputs = np.asarray(checks.real("held", held))
    if inputs.ndim == 0 or inputs.shape[0] != count - 1:
        raise InvalidShape("held", f"shape {inputs.shape}", f"shape ({count - 1}, ...)", "one input for each interval")
    return inputs


def _check_rates(rates: Rates, t: float, y: np.ndarray, inputs: np.ndarray | None) -> None:
    """Report rates of another shape than the state's before the first step."""
    given = np.shape(rates(t, y) if inputs is None else rates(t, y, inputs[0]))
    if given != y.shape:
        raise InvalidShape("rates", f"shape {given} at t = {t:g}", f"shape {y.shape}, that of the state")


def _by_table(
    table: ButcherTableau, rates: Rates, times: np.ndarray, states: np.ndarray, inputs: np.ndarray | None
) -> None:
    for i, h in enumerate(np.diff(times)):
        states[i + 1] = table.step(_during(rates, inputs, i), times[i], states[i], h)


def _by_scipy(
    method: str,
    rates: Rates,
    times: np.ndarray,
    states: np.ndarray,
    inputs: np.ndarray | None,
    tol: tuple[float, float],
) -> None:
    """One solution over all times, or one for each interval where inputs are held."""
    from scipy.integrate import solve_ivp

    last = times.size - 1
    spans = [(0, last)] if inputs is None else [(i, i + 1) for i in range(last)]
    for begin, end in spans:
        during = _during(rates, inputs, begin)
        answer = solve_ivp(
            functools.partial(_flat_rates, during, states.shape[1:]), (times[begin], times[end]), states[begin].ravel(),
            method=method, t_eval=times[begin : end + 1], rtol=tol[0], atol=tol[1],
        )  # fmt: skip
        if not answer.success:
            raise NoSolution(
                f"{method} stopped within t = {times[begin]:g} ... {times[end]:g}: {answer.message}", answer
            )
        states[begin + 1 : end + 1] = answer.y.T[1:].reshape(states[begin + 1 : end + 1].shape)


def _flat_rates(rates: Rates, shape: tuple[int, ...], t: float, y: np.ndarray) -> np.ndarray:
    return np.ravel(rates(t, y.reshape(shape)))


def _during(rates: Rates, inputs: np.ndarray | None, i: int) -> Rates:
    """The rates within interval i, as a function of time and state."""
    return rates if inputs is None else functools.partial(_with_input, rates, inputs[i])


def _with_input(rates: Rates, u: np.ndarray, t: float, y: np.ndarray) -> ArrayLike:
    return rates(t, y, u)


def _finite(times: np.ndarray, states: np.ndarray) -> np.ndarray:
    """The states, or an error that says when they left the finite numbers."""
    good = np.isfinite(states).reshape(times.size, -1).all(axis=1)
    if not good.all():
        i = int(np.argmin(good))
        raise InvalidValue(
            "state", states[i], "finite numbers", f"it diverged at t = {times[i]:g} (step {i}): take shorter steps"
        )
    return states
