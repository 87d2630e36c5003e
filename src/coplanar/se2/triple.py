"""What Pose, Twist and Displacement share: three numbers, or arrays of them, that broadcast together."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite
from operator import attrgetter
from typing import Any, ClassVar, Self

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import components, is_foreign, namespace_of, stack
from coplanar.errors import InvalidShape

_new = object.__new__


@dataclass(frozen=True, slots=True, eq=False)
class Triple:
    """Three numbers that broadcast together.

    A subclass names them in ``names`` and has a field for each. Two are equal if they are of one class and shape and
    hold the same numbers. A triple is not a sequence: ``parts`` has the three numbers, an index takes leading axes.
    """

    names: ClassVar[tuple[str, str, str]]
    _setters: ClassVar[tuple[Callable[..., None], Callable[..., None], Callable[..., None]]]
    _read: ClassVar[Callable[[Any], tuple[Real, Real, Real]]]
    __array_ufunc__: ClassVar[None] = None  # an array beside an operator leaves it to the triple
    __iter__: ClassVar[None] = None

    def __init_subclass__(cls) -> None:
        if "__slots__" in vars(cls):  # the dataclass decorator makes the class twice, with slots the second time
            first, second, third = (getattr(cls, name).__set__ for name in cls.names)
            cls._setters = first, second, third
            cls._read = attrgetter(*cls.names)  # in one call of C

    def _fill(self, a: ArrayLike, b: ArrayLike, c: ArrayLike) -> None:
        """Check and keep the three numbers; floats soonest, as control loops make a triple in every tick."""
        if type(a) is type(b) is type(c) is float and isfinite(a + b + c):
            first, second, third = self._setters
            first(self, a)
            second(self, b)
            third(self, c)
            return
        values = [checks.real(name, part) for name, part in zip(self.names, (a, b, c), strict=True)]
        if any(type(value) is not float for value in values):
            checks.broadcast(**dict(zip(self.names, values, strict=True)))
        for put, value in zip(self._setters, values, strict=True):
            put(self, checks.frozen(value))

    @classmethod
    def _of(cls, a: Real, b: Real, c: Real) -> Self:
        """The value without the checks, for results of laws, which become read-only."""
        new = _new(cls)
        first, second, third = cls._setters
        first(new, a if type(a) is float else _settled(a))
        second(new, b if type(b) is float else _settled(b))
        third(new, c if type(c) is float else _settled(c))
        return new

    @classmethod
    def _into(cls, out: Any, law: Any, *args: Real) -> Self:
        """The value of a law of three results, or their rows written into ``out``, shape (3, ...)."""
        if out is None:
            return cls._of(*law(*args))
        shape = np.broadcast_shapes(*(np.shape(a) for a in args))
        columns = checks.output(out, (3, *shape))
        if not shape:
            columns[:] = law(*args)
            return cls._of(*columns.tolist())
        law.into(tuple(columns), *args)
        return cls._of(*columns)

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
        arrays = [v for v in self.parts if type(v) is not float]
        return np.broadcast_shapes(*map(np.shape, arrays)) if arrays else ()

    @property
    def parts(self) -> tuple[Real, Real, Real]:
        """The three fields, in order."""
        return type(self)._read(self)

    def __getitem__(self, index: Any) -> Self:
        """The same slice of the leading axes of all three.

        Raises:
            InvalidShape: If there are no leading axes.
            IndexError: If the index is outside of them.
        """
        shape = self.shape
        if not shape:
            kind = type(self).__name__
            raise InvalidShape(
                kind, "shape ()", "a leading axis to index", "parts and as_array() have the three numbers"
            )
        return self._of(*(_spread(part, shape)[index] for part in self.parts))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Triple) or type(other) is not type(self):
            return NotImplemented
        return self.shape == other.shape and all(map(_same, self.parts, other.parts))

    def __hash__(self) -> int:
        return hash((type(self), self.parts))

    def __reduce__(self) -> tuple[Callable[..., Self], tuple[Real, Real, Real]]:
        return self._of, self.parts


def matrix_of(*rows: tuple[Real, ...]) -> np.ndarray:
    """Matrices of shape (..., rows, columns) from their entries."""
    flat = stack([entry for row in rows for entry in row])
    matrix: np.ndarray = flat.reshape((*flat.shape[:-1], len(rows), len(rows[0])))
    return matrix


def _settled(value: Real) -> Real:
    if isinstance(value, np.ndarray):
        value.flags.writeable = False
    elif isinstance(value, np.generic):
        return float(value)
    return value


def _spread(part: Real, shape: tuple[int, ...]) -> Any:
    return (namespace_of(part) if is_foreign(part) else np).broadcast_to(part, shape)


def _same(part: Real, other: Real) -> bool:
    if type(part) is float and type(other) is float:
        return part == other
    return bool(np.all(np.equal(part, other)))
