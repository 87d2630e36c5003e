"""Arrays of other libraries: how they are recognised, and which namespace answers for them."""

from __future__ import annotations

import functools
import importlib
import types
from collections.abc import Iterable
from typing import Any

import numpy as np

_OURS = (float, np.ndarray, int, np.generic)


def is_foreign(value: object) -> bool:
    """Whether ``value`` is an array of another library, such as JAX or PyTorch."""
    if isinstance(value, _OURS):
        return False
    return hasattr(value, "__array_namespace__") or _root(value) == "torch"


def namespace_of(value: Any) -> types.ModuleType:
    """The array namespace of a foreign array: ``jax.numpy`` for JAX, ``torch`` for PyTorch.

    Example:
        >>> namespace_of(np.zeros(2)).__name__
        'numpy'
    """
    if hasattr(value, "__array_namespace__"):
        namespace: types.ModuleType = value.__array_namespace__()
        return namespace
    return importlib.import_module("torch")


def components(points: Any) -> tuple[Any, ...]:
    """The entries of the last axis, each a float or an array of the leading shape.

    Example:
        >>> components((1.0, 2.0))
        (1.0, 2.0)
    """
    if not is_foreign(points):
        points = np.asarray(points, dtype=np.float64)
        if points.ndim == 1:
            return tuple(points.tolist())
    return tuple(points[..., i] for i in range(points.shape[-1]))


def alike(values: Iterable[Any]) -> tuple[types.ModuleType, list[Any]]:
    """The values as arrays of the foreign library among them, of one float type: the arrays', not the numbers'.

    A number joins arrays as in NumPy: it takes their type. (PyTorch would make a float32 of 0.1 on its own.)
    """
    values = list(values)
    xp = next(namespace_of(v) for v in values if is_foreign(v))
    types_met = [xp.asarray(v).dtype for v in values if is_foreign(v) or np.ndim(v)]
    floats = [t for t in types_met if "float" in str(t)] or [xp.asarray(1.0).dtype]
    dtype = functools.reduce(xp.promote_types, floats)
    return xp, [xp.asarray(v, dtype=dtype) for v in values]


def stack(parts: Any, axis: int = -1) -> Any:
    """The parts side by side on a new axis, broadcast to one shape.

    Args:
        parts: Floats or arrays.
        axis: Where the new axis stands.

    Example:
        >>> stack((1.0, np.zeros(3))).shape
        (3, 2)
    """
    parts = tuple(parts)
    if all(type(p) is float for p in parts):
        return np.array(parts)
    if any(is_foreign(p) for p in parts):
        xp, arrays = alike(parts)
        return xp.stack([xp.broadcast_to(a, broadcast_shape(arrays)) for a in arrays], axis)
    return np.stack(np.broadcast_arrays(*parts), axis)


def broadcast_shape(arrays: Iterable[Any]) -> tuple[int, ...]:
    """The common shape of arrays of any library."""
    return np.broadcast_shapes(*(tuple(a.shape) for a in arrays))


def _root(value: object) -> str:
    return type(value).__module__.partition(".")[0]
