"""What a sampled loop will do, said before it runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any, Self

import numpy as np

from coplanar.checks import Real
from coplanar.engine import evaluator, stack
from coplanar.errors import NoSolution
from coplanar.laws import control as laws

_pd_poles = evaluator(laws.pd_poles)
_pid_polynomial = evaluator(laws.pid_polynomial)
_lateral_polynomial = evaluator(laws.lateral_polynomial)
_lateral_margin = evaluator(laws.lateral_margin)
_largest_step = evaluator(laws.largest_step)
NO_STEP = 1e-9  # of the highest step: a loop that is not stable above this is stable for no step


class Stability(Enum):
    """What the poles of a loop say; the value is the sentence."""

    STABLE = "stable: every error dies out"
    BOUNDARY = "exactly on the stability boundary: an error neither grows nor dies out"
    UNSTABLE = "unstable: errors grow"


@dataclass(frozen=True, slots=True, eq=False)
class StabilityReport:
    """The poles of a sampled loop and what follows from them.

    Attributes:
        step: Sampling time h [s].
        method: How the plant is stepped.
        poles: Discrete poles of the error along the reference, shape (..., m), complex.
        lateral_poles: Those of error and heading across a reference that moves at ``speed``; None at speed 0.
        speed: Of the reference [m/s].
        margin: 1 - |largest pole|; positive where stable.
        largest_step: The loop is stable for every step below this [s]; 0 where for none.
        status: One ``Stability``; for arrays of gains an object array of them.
        conditions: What is required, by name, each true or false.
        numbers: What the sentences speak of, by name.
        warnings: What to expect and what to do, as sentences.
    """

    step: Real
    method: str
    poles: np.ndarray
    lateral_poles: np.ndarray | None
    speed: Real
    margin: Real
    largest_step: Real
    status: Any
    conditions: Mapping[str, Any]
    numbers: Mapping[str, Any]
    warnings: tuple[str, ...]

    @property
    def stable(self) -> Any:
        """Whether every error dies out; an array for arrays of gains."""
        return self.status == Stability.STABLE

    def or_raise(self) -> Self:
        """The report itself if the loop is stable.

        Raises:
            NoSolution: With the sentences, if it is not.
        """
        if not np.all(self.stable):
            raise NoSolution(str(self), self)
        return self

    @property
    def sentences(self) -> tuple[str, ...]:
        """The status (of an array, the worst), then the warnings."""
        worst: Stability = max(np.ravel(self.status), key=list(Stability).index)
        return (worst.value, *self.warnings)

    def __str__(self) -> str:
        """The sentences, one a line."""
        return "\n".join(self.sentences)


def loop_poles(step: Real, kp: Real, kd: Real, ki: Real) -> np.ndarray:
    """Poles of the error of a tracked point, shape (..., 2), or (..., 3) with an integral.

    Roots of z^2 - (1 - h kp - kd) z - kd, in closed form; with ki those of a cubic.
    """
    if not np.any(ki):
        re1, im1, re2, im2 = _pd_poles(step, kp, kd)
        poles: np.ndarray = stack((re1 + 1j * np.asarray(im1), re2 + 1j * np.asarray(im2)))
        return poles
    return _roots(stack(_pid_polynomial(step, kp, kd, ki)))


def moving_poles(step: Real, gains: tuple[Real, Real, Real], turn: Real, lead: float) -> np.ndarray:
    """Poles of error and heading across a straight reference, shape (..., 4).

    Args:
        step: h [s].
        gains: kp, kd, ki.
        turn: g = h V/|px|.
        lead: Of the plant's Butcher row.
    """
    return _roots(stack(_lateral_polynomial(step, *gains, turn, lead)))


def stable_below(gains: tuple[Real, Real, Real], px: Real, speed: Real, lead: float) -> Real:
    """The largest step below which the loop of a tracked point is stable [s]: in closed form at speed 0."""
    still = _largest_step(*gains)
    if not np.any(speed):
        return still
    moving = first_exit(lambda h: _lateral_margin(h, *gains, speed, px, lead), np.add(still, np.zeros(np.shape(px))))
    step = np.where(np.greater(speed, 0.0), moving, still)
    return float(step) if not step.ndim else step


def first_exit(margin: Callable[[Real], Real], highest: Real, *, samples: int = 256) -> Real:
    """The smallest step at which a margin is no longer above 0 [s], or the highest; 0 if it never is above.

    The first of ``samples`` even steps up to the highest at which it is not, refined by bisection to the last bit.
    """
    shape = np.broadcast_shapes(np.shape(margin(highest)), np.shape(highest))
    top = np.broadcast_to(highest, shape)
    fractions = (np.arange(1, samples + 1) / samples).reshape(-1, *(1 for _ in shape))
    out = np.less_equal(margin(fractions * top), 0.0)
    first = np.where(out.any(0), out.argmax(0), samples - 1)
    low, high = first / samples * top, (first + 1.0) / samples * top
    for _ in range(60):
        middle = 0.5 * (low + high)
        beyond = np.less_equal(margin(middle), 0.0)
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    step = np.where(out.any(0), np.where(high < NO_STEP * top, 0.0, high), top)
    return float(step) if not shape else step


def margin_of(poles: np.ndarray, across: np.ndarray | None, turn: Real) -> Real:
    """1 - |largest pole|; those across count where the reference moves (turn > 0)."""
    largest = np.abs(poles).max(-1)
    if across is not None:
        largest = np.where(np.greater(turn, 0.0), np.maximum(largest, np.abs(across).max(-1)), largest)
    return 1.0 - largest if np.ndim(largest) else float(1.0 - largest)


def quadratic_roots(trace: Real, det: Real) -> np.ndarray:
    """Roots of z^2 - trace z + det, shape (..., 2), complex."""
    return _roots(stack((1.0, -trace, det)))


def judge(margin: Real, tolerance: float) -> Any:
    """The status for a margin: on the boundary within ``tolerance`` [1]; an object array for arrays."""
    codes = np.where(np.abs(margin) <= tolerance, 1, np.where(np.greater(margin, 0.0), 0, 2))
    known = np.array(list(Stability), dtype=object)
    return known[codes] if codes.ndim else known[int(codes)]


def _roots(coefficients: np.ndarray) -> np.ndarray:
    """Roots of monic polynomials, shape (..., n + 1) -> (..., n), as eigenvalues of companion matrices."""
    degree = coefficients.shape[-1] - 1
    companion = np.zeros((*coefficients.shape[:-1], degree, degree))
    companion[..., 0, :] = -coefficients[..., 1:]
    companion[..., np.arange(1, degree), np.arange(degree - 1)] = 1.0
    return np.asarray(np.linalg.eigvals(companion), dtype=np.complex128)
