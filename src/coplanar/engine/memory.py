"""Memory of large results, used again when nobody holds it any more.

The system clears every page that it hands out, which takes longer than most laws take to fill it. So what large results
leave behind is kept, ``KEPT`` bytes at the most, and the next result of about the same size takes it.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

LARGE = 1 << 18  # [bytes] from which memory is used again; less comes from the heap, and is not cleared
KEPT = 1 << 26  # [bytes] that wait for the next result
SPARE = 4  # a result may take memory that is longer by one part in so many

# Oldest first. Threads, forks and arrays that end in the middle of anything need no lock: each change is one step.
_waiting: dict[int, np.ndarray] = {}
_FLOAT64 = np.dtype(np.float64)


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
        _waiting[id(self._memory)] = self._memory
        spare = sum(memory.nbytes for memory in list(_waiting.values())) - KEPT
        for key, memory in list(_waiting.items()):
            if spare <= 0:
                break
            spare -= memory.nbytes
            _waiting.pop(key, None)


def empty(shape: tuple[int, ...], dtype: Any = _FLOAT64) -> np.ndarray:
    """An array with no values yet, as ``np.empty``; a view of it that is read-only is so for good.

    Example:
        >>> empty((2, 3)).shape
        (2, 3)
    """
    size = math.prod(shape) * (8 if dtype is _FLOAT64 else np.dtype(dtype).itemsize)
    if size < LARGE:
        return np.empty(shape, dtype)
    whole = np.asarray(Lent(_found(size)))
    array: np.ndarray = whole[:size].view(dtype).reshape(shape)
    whole.flags.writeable = False  # its views keep what they may do
    return array


def _found(size: int) -> np.ndarray:
    """Memory that waits and is long enough, but not by much; else new memory."""
    for key, memory in list(_waiting.items()):
        if size <= memory.nbytes <= size + size // SPARE and _waiting.pop(key, None) is not None:
            return memory
    return np.empty(size, np.uint8)
