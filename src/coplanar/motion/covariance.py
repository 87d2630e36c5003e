"""How sure odometry is: covariances of (x, y, theta), carried along a path."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import evaluator
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.laws import motion as laws
from coplanar.motion.sequence import before_last_axis
from coplanar.se2 import Displacement, Pose
from coplanar.se2.triple import matrix_of

_increment_variances = evaluator(laws.increment_variances)
_step_jacobian = evaluator(laws.step_jacobian)


@dataclass(frozen=True, slots=True)
class OdometryNoise:
    """Independent errors whose variance grows with the way and the turn, whatever the rate of the ticks.

    Attributes:
        forward: Standard deviation along the path after 1 m [m].
        sideways: Across the path after 1 m [m].
        turn_per_metre: Of the heading after 1 m [rad].
        turn_per_radian: Of the heading after turning by 1 rad [rad].

    Raises:
        InvalidValue: If one of them is negative or not finite.

    Example:
        >>> OdometryNoise(forward=0.1).covariances(Displacement(4.0, 0.0, 0.0))[0].round(12).tolist()
        [0.04, 0.0, 0.0]
    """

    forward: Real = 0.0
    sideways: Real = 0.0
    turn_per_metre: Real = 0.0
    turn_per_radian: Real = 0.0

    def __post_init__(self) -> None:
        for name in self.__slots__:
            object.__setattr__(self, name, checks.frozen(checks.not_negative(name, getattr(self, name))))

    def covariances(self, increments: Displacement) -> np.ndarray:
        """Q of each increment (dx, dy, dtheta): s^2 per metre or radian, on the diagonal; shape (..., 3, 3)."""
        along_, across, turn = _increment_variances(
            *increments.parts, self.forward, self.sideways, self.turn_per_metre, self.turn_per_radian
        )
        return matrix_of((along_, 0.0, 0.0), (0.0, across, 0.0), (0.0, 0.0, turn))


def about(path: Pose, start: Pose) -> np.ndarray:
    """The lever from the start to each pose, shape (..., n + 1, 3, 3)."""
    return lever(path.x - before_last_axis(start.x), path.y - before_last_axis(start.y))


def summed_about(path: Pose, start: Pose, increments: Displacement, Q: np.ndarray, first: np.ndarray) -> np.ndarray:
    """Covariances of all ticks so far as if each had swung the path about the start, shape (..., n + 1, 3, 3)."""
    a, b, u, w, _, _ = _step_jacobian(path.theta[..., :-1], *increments.parts)
    G = matrix_of((a, -b, u), (b, a, w), (0.0, 0.0, 1.0))
    x, y = path.x[..., 1:] - before_last_axis(start.x), path.y[..., 1:] - before_last_axis(start.y)
    added = carried(lever(-x, -y) @ G, Q)
    shape = np.broadcast_shapes(first.shape[:-2], added.shape[:-3])
    rows = np.concatenate(
        (
            np.broadcast_to(first[..., None, :, :], (*shape, 1, 3, 3)),
            np.broadcast_to(added, (*shape, *added.shape[-3:])),
        ),
        axis=-3,
    )
    sums: np.ndarray = np.cumsum(rows, axis=-3)
    return sums


def lever(dx: Real, dy: Real) -> np.ndarray:
    """How a pose's error moves to a point (dx, dy) away: [[1, 0, -dy], [0, 1, dx], [0, 0, 1]], shape (..., 3, 3)."""
    return matrix_of((1.0, 0.0, -dy), (0.0, 1.0, dx), (0.0, 0.0, 1.0))


def carried(jacobian: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """J P J^T.

    Example:
        >>> carried(lever(0.0, 2.0), np.diag([0.0, 0.0, 1.0])).tolist()
        [[4.0, 0.0, -2.0], [0.0, 0.0, 0.0], [-2.0, 0.0, 1.0]]
    """
    product: np.ndarray = jacobian @ covariance @ jacobian.swapaxes(-1, -2)
    return product


def checked_covariance(name: str, value: ArrayLike) -> np.ndarray:
    """Symmetric matrices of shape (..., 3, 3)."""
    matrix: np.ndarray = checks.vector(name, value, 3)
    if matrix.ndim < 2 or matrix.shape[-2] != 3:
        raise InvalidShape(name, f"shape {matrix.shape}", "shape (..., 3, 3)")
    if not np.allclose(matrix, matrix.swapaxes(-1, -2), rtol=1e-9, atol=0.0):
        raise InvalidValue(name, value, "symmetric matrices")
    return matrix
