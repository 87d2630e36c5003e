"""Memory of large results, used again when nobody holds it any more.

The system clears every page that it hands out, which takes longer than most laws take to fill it. So what large results
leave behind is kept, ``KEPT`` bytes at the most, and the next result of about the same size takes it.
"""

from __future__ import annotations

import math
import threading
from typing import Any

import numpy as np

LARGE = 1 << 18  # [bytes] from which memory is used again; less comes from the heap, and is not cleared
KEPT = 1 << 26  # [bytes] that wait for the next result
SPARE = 4  # a result may take memory that is longer by one part in so many

_waiting: list[np.ndarray] = []  # oldest first
_lock = threading.RLock()  # the end of an array may come in the middle of anything, in this thread too


class Lent:
    """Memory under arrays. When the last of them ends, it waits for the next result."""

    __slots__ = ("_memory",)

    def __init__(self, memory: np.ndarray) -> None:
        self._memory = memory

    @property
    def __array_interface__(self) -> dict[str, Any]:
        """The bytes, as NumPy reads them."""
        return self._memory.__array_interface__

    def __del__(self) -> None:
        with _lock:
            _waiting.append(self._memory)
            while sum(memory.nbytes for memory in _waiting) > KEPT:
                del _waiting[0]


_FLOAT64 = np.dtype(np.float64)


def empty(shape: tuple[int, ...], dtype: Any = _FLOAT64) -> np.ndarray:
    """An array with no values yet, as ``np.empty``; a view of it that is read-only is so for good.

    Example:
        >>> empty((2, 3)).shape
        (2, 3)
    """
    size = math.prod(shape) * (8 if dtype is _FLOAT64 else np.dtype(dtype).itemsize)
    if size < LARGE:
        return np.empty(shape, dtype)
    found = _found(size)
    whole = np.asarray(Lent(np.empty(size, np.uint8) if found is None else found))
    array: np.ndarray = whole[:size].view(dtype).reshape(shape)
    whole.flags.writeable = False  # its views keep what they may do
    return array


def _found(size: int) -> np.ndarray | None:
    """Memory that waits and is long enough, but not by much."""
    with _lock:
        fits = (memory for memory in _waiting if size <= memory.nbytes <= size + size // SPARE)
        found = next(fits, None)
        _waiting[:] = [memory for memory in _waiting if memory is not found]
    return found
