"""Arrays of other libraries: how they are recognised, and which namespace answers for them."""

from __future__ import annotations

import importlib
import types
from typing import Any

import numpy as np


def is_foreign(value: object) -> bool:
    """Whether ``value`` is an array of another library, such as JAX or PyTorch."""
    if isinstance(value, np.ndarray | np.generic | float | int):
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


def stack(parts: Any, axis: int = -1) -> Any:
    """The parts side by side on a new axis, broadcast to one shape.

    Args:
        parts: Floats or arrays.
        axis: Where the new axis stands.

    Example:
        >>> stack((1.0, np.zeros(3))).shape
        (3, 2)
    """
    xp = next((namespace_of(p) for p in parts if is_foreign(p)), np)
    broadcast = getattr(xp, "broadcast_arrays", None) or xp.broadcast_tensors
    return xp.stack(broadcast(*(xp.asarray(p) for p in parts)), axis)


def _root(value: object) -> str:
    return type(value).__module__.partition(".")[0]
