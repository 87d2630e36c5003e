"""What Pose, Twist and Displacement share: three numbers, or arrays of them, that broadcast together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Self

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import components, stack


@dataclass(frozen=True, slots=True)
class Triple:
    """Three numbers that broadcast together.

    A subclass names them in ``names`` and has a field for each.
    """

    names: ClassVar[tuple[str, str, str]]

    def __post_init__(self) -> None:
        values = dict(zip(self.names, map(checks.real, self.names, self.parts), strict=True))
        checks.broadcast(**values)
        for name, value in values.items():
            object.__setattr__(self, name, checks.frozen(value))

    @classmethod
    def _of(cls, a: Real, b: Real, c: Real) -> Self:
        """The value without the checks, for results of laws."""
        new = object.__new__(cls)
        first, second, third = cls.names
        object.__setattr__(new, first, a)
        object.__setattr__(new, second, b)
        object.__setattr__(new, third, c)
        return new

    @classmethod
    def from_array(cls, array: ArrayLike) -> Self:
        """From an array of shape (..., 3).

        Raises:
            InvalidShape: If the last axis is not 3 long.
            InvalidValue: If an entry is not finite.

        Example:
            >>> from coplanar import Pose
            >>> Pose.from_array([1, 2, 0.5])
            Pose(x=1.0, y=2.0, theta=0.5)
        """
        return cls(*components(checks.vector("array", array, 3)))

    def as_array(self) -> np.ndarray:
        """The three numbers on the last axis, shape (..., 3).

        Example:
            >>> from coplanar import Pose
            >>> Pose(1, 2, 0.5).as_array().tolist()
            [1.0, 2.0, 0.5]
        """
        array: np.ndarray = stack(self.parts)
        return array

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading shape, () for a single one."""
        return np.broadcast_shapes(*(np.shape(v) for v in self.parts))

    @property
    def parts(self) -> tuple[Real, Real, Real]:
        """The three fields, in order."""
        first, second, third = self.names
        return getattr(self, first), getattr(self, second), getattr(self, third)

    def __getitem__(self, index: Any) -> Self:
        """The same slice of all three."""
        whole = np.broadcast_arrays(*self.parts)
        return self._of(*(checks.frozen(checks.real(n, a[index])) for n, a in zip(self.names, whole, strict=True)))


def matrix_of(*rows: tuple[Real, ...]) -> np.ndarray:
    """Matrices of shape (..., rows, columns) from their entries."""
    flat = stack([entry for row in rows for entry in row])
    matrix: np.ndarray = flat.reshape((*flat.shape[:-1], len(rows), len(rows[0])))
    return matrix
