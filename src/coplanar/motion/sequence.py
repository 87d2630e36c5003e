"""Things that follow one another along the last axis: running sums, which one it is at a time, and its fields."""

from __future__ import annotations

from typing import Any

import numpy as np

from coplanar.checks import Real
from coplanar.engine import is_foreign, namespace_of


def piece_at(knots: Any, t: Any) -> Any:
    """Which piece holds at time t: the last one that has begun, the first one before.

    Args:
        knots: Shape (..., n + 1), not decreasing.
        t: Broadcasts with the leading shape.

    Example:
        >>> piece_at(np.array([0.0, 1.0, 3.0]), np.array([-1.0, 0.5, 1.0, 9.0])).tolist()
        [0, 0, 1, 1]
    """
    xp = _namespace(knots)
    inner, times = knots[..., 1:-1], xp.asarray(t)
    if inner.ndim == 1:
        return xp.searchsorted(inner, times, side="right")
    return (times[..., None] >= inner).sum(-1)


def pick(field: Any, index: Any) -> Any:
    """The entry ``index`` of the last axis of a field, for every leading index.

    Example:
        >>> pick(np.array([[1.0, 2.0], [3.0, 4.0]]), np.array(1)).tolist()
        [2.0, 4.0]
    """
    if field.ndim == 1:
        return field[index]
    xp = _namespace(field)
    shape = np.broadcast_shapes(field.shape[:-1], index.shape)
    whole = xp.broadcast_to(field, (*shape, field.shape[-1]))
    return xp.take_along_axis(whole, xp.broadcast_to(index, shape)[..., None], axis=-1)[..., 0]


def along(field: Real, count: int) -> Any:
    """The field with a last axis of this length."""
    xp = _namespace(field)
    array = xp.asarray(field)
    return xp.broadcast_to(array, np.broadcast_shapes(array.shape, (count,)))


def joined(first: Any, second: Any) -> Any:
    """One after the other along the last axis; leading axes broadcast.

    Example:
        >>> joined(np.array([1.0]), np.array([[2.0], [3.0]])).tolist()
        [[1.0, 2.0], [1.0, 3.0]]
    """
    xp = _namespace(first) if is_foreign(first) else _namespace(second)
    shape = np.broadcast_shapes(first.shape[:-1], second.shape[:-1])
    return xp.concat([xp.broadcast_to(part, (*shape, part.shape[-1])) for part in (first, second)], axis=-1)


def before_last_axis(value: Real) -> Real:
    """The value with a last axis of length 1, so that it stands before a sequence; a float stays."""
    return value[..., None] if np.ndim(value) else value


def _namespace(value: Any) -> Any:
    return namespace_of(value) if is_foreign(value) else np
