"""Joint rates for a velocity of the tool: exact, damped, and what each leaves undone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.arms.chain import TASKS, Chain
from coplanar.checks import ArrayLike
from coplanar.engine import evaluator
from coplanar.laws import arms as laws

EPSILON = float(np.finfo(np.float64).eps)

_damped_gain = evaluator(laws.damped_gain)


@dataclass(frozen=True, slots=True)
class Rates:
    """Two answers to one wanted velocity: exact, J^+ v, and damped, J^T (J J^T + lambda^2 I)^-1 v.

    The exact rates grow as 1/sigma near a singular posture; the damped ones stay below |v|/(2 lambda) and lag behind
    instead. Rows and columns in metres and in radians are weighed as they are.

    Attributes:
        exact: J^+ v: the exact rates for n = m, of minimum norm for n > m, least squares for n < m and where J has
            lost rank, shape (..., n) [rad/s, m/s].
        damped: J^T (J J^T + lambda^2 I)^-1 v, shape (..., n).
        jacobian: Of the task, shape (..., m, n).
        velocity: What was asked for, shape (..., m) [m/s, rad/s].
        singular_values: Of J, largest first, shape (..., min(m, n)).
        rank: How many of them count, an int or an array.
        damping: lambda [m/rad].
    """

    exact: np.ndarray
    damped: np.ndarray
    jacobian: np.ndarray
    velocity: np.ndarray
    singular_values: np.ndarray
    rank: Any
    damping: float

    @property
    def exists(self) -> Any:
        """Whether the rank is full; where it is not, ``exact`` is a least-squares answer with an ``exact_error``."""
        return self.rank == min(self.jacobian.shape[-2:])

    def exact_error(self) -> np.ndarray:
        """J exact - v: rounding where the arm can move as asked, shape (..., m)."""
        return self._error(self.exact)

    def damped_error(self) -> np.ndarray:
        """J damped - v: the bias that the damping costs, shape (..., m)."""
        return self._error(self.damped)

    def _error(self, rates: np.ndarray) -> np.ndarray:
        error: np.ndarray = np.einsum("...mn,...n->...m", self.jacobian, rates) - self.velocity
        return error


def resolve_rates(
    chain: Chain,
    q: Any,
    velocity: ArrayLike,
    *,
    task: str,
    damping: float | None,
    null_rate: ArrayLike | None,
) -> Rates:
    """The rates at checked joints q; see ``Arm.rates``."""
    checks.choice("task", task, TASKS)
    wanted = np.asarray(checks.vector("velocity", velocity, 2 if task == "position" else 3))
    spare = np.zeros(chain.n) if null_rate is None else chain.checked_joints("null_rate", null_rate)
    checks.broadcast(q=q[..., 0], velocity=wanted[..., 0], null_rate=spare[..., 0])
    strength = 0.05 * sum(chain.links) if damping is None else checks.not_negative("damping", damping)
    jacobian = chain.jacobian(q, task=task)
    left, values, right = np.linalg.svd(jacobian, full_matrices=False)
    floor = max(jacobian.shape[-2:]) * EPSILON * values[..., :1]
    rank = (values > floor).sum(axis=-1)
    inverse = np.where(values > floor, _damped_gain(values, 0.0), 0.0)
    exact, damped = (_through(left, gain, right, wanted) for gain in (inverse, _damped_gain(values, strength)))
    free = spare - np.einsum("...kn,...k,...kj,...j->...n", right, (values > floor).astype(float), right, spare)
    rank = int(rank) if rank.ndim == 0 else rank
    return Rates(exact + free, damped + free, jacobian, wanted, values, rank, strength)


def _through(left: np.ndarray, gain: Any, right: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """V diag(gain) U^T v."""
    rates: np.ndarray = np.einsum("...kn,...k,...mk,...m->...n", right, gain, left, velocity)
    return rates
