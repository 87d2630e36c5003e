"""The boundary: what enters is checked once; what is inside is trusted.

Every check returns the value in the form the library works with: a Python float for a scalar,
a float64 array for anything longer, and arrays of other libraries (JAX, PyTorch) as they are.
A constructor passes what it keeps through ``frozen``, so that nobody can change it afterwards.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import isfinite
from typing import Any

import numpy as np

from coplanar.engine import is_foreign, memory
from coplanar.errors import InvalidShape, InvalidValue, UnknownName

Real = Any  # a float, or an array of any library that follows the array API
ArrayLike = Any

_FLOAT = frozenset((float,))
MANY = 1000  # entries from which a test of them all without a table of its own is worth its call


def real(name: str, value: ArrayLike, *, remedy: str = "") -> Real:
    """A finite number or array of finite numbers.

    Args:
        name: What to call it in the error.
        value: A number, a sequence, an array.
        remedy: What to do when it is refused.

    Returns:
        A float for shape (), otherwise a float64 array (the same one where it was float64 already).

    Raises:
        InvalidValue: If something is not a real number, or is NaN or infinite; truth values, complex numbers, text
            and masked entries are not real numbers.

    Example:
        >>> real("speed", 2), real("speed", [1, 2]).tolist()
        (2.0, [1.0, 2.0])
    """
    if type(value) is float and isfinite(value):
        return value
    if type(value) is np.float64 and isfinite(value):
        return float(value)
    if is_foreign(value):
        return value
    array = _as_float64(name, value, remedy)
    finite(name, value, array, remedy=remedy)
    return float(array) if array.ndim == 0 else array


def finite(name: str, value: Any, array: np.ndarray, *, remedy: str = "") -> None:
    """Refuse NaN and infinity.

    Args:
        name: What to call it in the error.
        value: What was given.
        array: Its numbers.
        remedy: What to do when it is refused.

    Raises:
        InvalidValue: With the first entry that is one.
    """
    if not _all_finite(array):
        raise InvalidValue(name, value, _where("finite numbers", array, np.isfinite(array)), remedy)


def reals(name: str, value: ArrayLike, *, remedy: str = "") -> Any:
    """A float64 array, in which NaN and infinity are yet to be looked for by ``finite``; others' arrays as they are.

    Raises:
        InvalidValue: As ``real``.
    """
    return value if is_foreign(value) else _as_float64(name, value, remedy)


def plain(*values: Any) -> bool:
    """Whether all are finite floats, which need no other check and no copy.

    Example:
        >>> plain(1.0, 2.0), plain(1.0, 2), plain(1.0, float("nan"))
        (True, False, False)
    """
    return _FLOAT.issuperset(map(type, values)) and all(map(isfinite, values))


def positive(name: str, value: ArrayLike, *, remedy: str = "") -> Real:
    """A finite number, or array, greater than zero.

    Raises:
        InvalidValue: If an entry is zero, negative, NaN or infinite.

    Example:
        >>> positive("radius", 0.1)
        0.1
    """
    checked = real(name, value, remedy=remedy)
    demand(checked > 0.0, name, value, checked, "greater than 0", remedy)
    return checked


def not_negative(name: str, value: ArrayLike, *, remedy: str = "") -> Real:
    """A finite number, or array, of at least zero.

    Raises:
        InvalidValue: If an entry is negative, NaN or infinite.

    Example:
        >>> not_negative("drag", 0)
        0.0
    """
    checked = real(name, value, remedy=remedy)
    demand(checked >= 0.0, name, value, checked, "0 or more", remedy)
    return checked


def vector(name: str, value: ArrayLike, length: int | None = None, *, remedy: str = "") -> Any:
    """An array of shape ``(..., length)``, finite.

    Args:
        name: What to call it in the error.
        value: The array.
        length: The size of the last axis; any (but at least 1) when None.
        remedy: What to do when it is refused.

    Raises:
        InvalidShape: If the last axis is not ``length`` long.
        InvalidValue: If something is NaN or infinite.

    Example:
        >>> vector("point", (1, 2), 2).shape
        (2,)
    """
    return ending_in(length, name, value if is_foreign(value) else real(name, value, remedy=remedy), remedy=remedy)


def ending_in(length: int | None, name: str, checked: Any, *, remedy: str = "") -> Any:
    """The array if its last axis is so long; any length but 0 when None.

    Raises:
        InvalidShape: If it is not.
    """
    shape = np.shape(checked)
    if not shape or (length is not None and shape[-1] != length) or shape[-1] == 0:
        needed = f"shape (..., {'n' if length is None else length})"
        raise InvalidShape(name, f"shape {shape}", needed, remedy)
    return checked


def monotone(name: str, value: ArrayLike) -> np.ndarray:
    """A strictly increasing or strictly decreasing vector of at least two times.

    Raises:
        InvalidShape: If it is not a vector of two or more entries.
        InvalidValue: If two neighbours are equal or the direction changes.

    Example:
        >>> monotone("t", [0, 1, 3]).tolist()
        [0.0, 1.0, 3.0]
    """
    times = np.asarray(vector(name, value))
    if times.ndim != 1 or times.size < 2:
        raise InvalidShape(name, f"shape {times.shape}", "a vector of two or more times")
    onward = times[1:] > times[:-1] if times[1] > times[0] else times[1:] < times[:-1]
    if not onward.all():
        i = int(np.argmin(onward))
        needed = f"a strictly monotone vector (entries {i} and {i + 1} are {times[i]}, {times[i + 1]})"
        raise InvalidValue(name, value, needed, "sort the times and remove repeated ones")
    return times


def choice(name: str, value: str, known: Iterable[str]) -> str:
    """One of the known names.

    Raises:
        UnknownName: With the list, and the nearest name when there is one.

    Example:
        >>> choice("method", "rk4", ["euler", "rk4"])
        'rk4'
    """
    known = list(known)
    if value not in known:
        raise UnknownName(name, value, known)
    return value


def broadcast(**values: Real) -> tuple[int, ...]:
    """The common shape of the named values.

    Raises:
        InvalidShape: Naming every value and its shape, if they do not broadcast.

    Example:
        >>> broadcast(x=1.0, y=np.zeros(3))
        (3,)
    """
    if {*map(type, values.values())} == {float}:
        return ()
    try:
        return np.broadcast_shapes(*(np.shape(v) for v in values.values()))
    except ValueError:
        shapes = ", ".join(str(np.shape(v)) for v in values.values())
        raise InvalidShape(", ".join(values), f"shapes {shapes}", "shapes that broadcast as in NumPy") from None


def demand(fine: Any, name: str, value: Any, checked: Real, needed: str, remedy: str = "") -> None:
    """Refuse a value unless the condition on it holds, entry by entry.

    Args:
        fine: The condition; not asked of arrays of other libraries, whose numbers may not be there yet.
        name: What to call the value in the error.
        value: What was given.
        checked: What the condition was asked of, of its shape.
        needed: The condition in words.
        remedy: What to do when it is refused.

    Raises:
        InvalidValue: With the first entry that is refused.
    """
    if fine is True or is_foreign(checked):
        return
    if not np.all(fine):
        raise InvalidValue(name, value, _where(needed, checked, fine), remedy)


def instance(name: str, value: object, kind: type, *, remedy: str = "") -> None:
    """Refuse what is not of this kind.

    Raises:
        InvalidValue: Naming the kind that was needed.
    """
    if not isinstance(value, kind):
        raise InvalidValue(name, value, f"a {kind.__name__}", remedy)


def output(out: Any, shape: tuple[int, ...]) -> np.ndarray:
    """Memory that a result is to be written into.

    Raises:
        InvalidShape: If it is no writeable float64 array of this shape.

    Example:
        >>> output(np.zeros((3, 2)), (3, 2)).shape
        (3, 2)
    """
    if isinstance(out, np.ndarray) and out.shape == shape and out.dtype == np.float64 and out.flags.writeable:
        return out
    given = type(out).__name__
    if isinstance(out, np.ndarray):
        given = f"{'a' if out.flags.writeable else 'a read-only'} {out.dtype} array of shape {out.shape}"
    raise InvalidShape("out", given, f"a float64 array of shape {shape} that may be written", f"np.empty({shape})")


def frozen(value: Real) -> Real:
    """The value itself if nobody can change it, otherwise a read-only copy.

    Example:
        >>> frozen(np.zeros(2)).flags.writeable
        False
    """
    if isinstance(value, np.ndarray) and not _is_immutable(value):
        copy = memory.empty(value.shape, value.dtype)
        copy[...] = value
        copy.flags.writeable = False
        return copy
    return value


def _is_immutable(array: np.ndarray) -> bool:
    """Read-only itself, and not a view of memory that somebody else may write to."""
    owner: Any = array
    while isinstance(owner, np.ndarray):
        if owner.flags.writeable:
            return False
        owner = owner.base
    return owner is None or isinstance(owner, bytes | memory.Lent)


def _where(needed: str, checked: Real, fine: Any) -> str:
    """What was needed, and for an array the first entry that is not so."""
    if not np.ndim(checked):
        return needed
    index = tuple(int(i) for i in np.argwhere(~fine)[0])
    return f"{needed} (entry {index[0] if len(index) == 1 else index} is {checked[index]})"


def _all_finite(array: np.ndarray) -> bool:
    """Whether every entry is: of many their sum, or else the lowest and the highest, which takes no memory."""
    if array.size > MANY:
        if array.flags.c_contiguous and isfinite(np.einsum("i->", array.reshape(-1))):
            return True
        return isfinite(array.min()) and isfinite(array.max())
    return bool(np.isfinite(array).all())


def _as_float64(name: str, value: ArrayLike, remedy: str) -> np.ndarray:
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "iuf" or np.ma.is_masked(value):
            raise TypeError
    except (TypeError, ValueError):
        raise InvalidValue(name, value, "real numbers (an equal count in every row)", remedy) from None
    return array if array.dtype == np.float64 else array.astype(np.float64)
