"""Open loop: a law of a pose's step along a row of steps, with no loop over steps.

The law reads ``x, y, theta = law(x, y, theta, *inputs of the step)``. It turns the heading by what does not hang on the
pose, and moves the place by what hangs on the heading alone: so headings are running sums of turns, and places running
sums of ways. As with ``Evaluator`` the arguments decide who evaluates it.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from coplanar.engine import memory
from coplanar.engine.evaluator import Evaluator, evaluator
from coplanar.engine.foreign import is_foreign, namespace_of
from coplanar.engine.policy import pays

Columns = Sequence[Any]


def running_sum(increments: Any, before: Any = None) -> Any:
    """0, then the sums of the first 1, 2 ... n entries of the last axis: shape (..., n + 1).

    Args:
        increments: Shape (..., n).
        before: Start with this sum in place of 0, shape (...): sums that go on round as if they never stopped.

    Example:
        >>> running_sum(np.array([1.0, 2.0])).tolist()
        [0.0, 1.0, 3.0]
        >>> running_sum(np.array([3.0]), 3.0).tolist()
        [3.0, 6.0]
    """
    xp, column = namespace_of(increments) if is_foreign(increments) else np, (*increments.shape[:-1], 1)
    if before is not None:
        first = xp.broadcast_to(xp.asarray(before)[..., None], column)
        return xp.cumsum(xp.concat((first, increments), axis=-1), axis=-1)
    return xp.concat((xp.zeros(column, dtype=increments.dtype), xp.cumsum(increments, axis=-1)), axis=-1)


class Walk:
    """A law of a pose's step, folded over the last axis of its inputs.

    Example:
        >>> def amble(x, y, theta, way, turn):
        ...     return x + way, y + 0.0 * theta, theta + turn
        >>> x, y, theta = Walk(amble)([1.0, 0.0, 0.0], [np.array([1.0, 2.0]), 0.5])
        >>> x.tolist(), theta.tolist()
        ([1.0, 2.0, 4.0], [0.0, 0.5, 1.0])
    """

    def __init__(self, law: Callable[..., Any]) -> None:
        self._evaluator: Evaluator = evaluator(law)
        functools.update_wrapper(self, law)

    def __call__(self, begin: Columns, inputs: Columns, *, keep: str = "all", out: np.ndarray | None = None) -> Any:
        """Carry poses through all steps.

        Args:
            begin: x, y and theta before the first step: numbers, or arrays that broadcast to the leading shape.
            inputs: Numbers, or arrays that broadcast to shape (..., steps); one of them at least has that last axis.
            keep: "all" for the pose before the first step and after every step, "end" for the last one only.
            out: Where all poses are written: float64, shape (3, ..., steps + 1).

        Returns:
            x, y and theta, each of shape (..., steps + 1) or (...); a float for shape (). Not to be written.
        """
        given = (*begin, *inputs)
        if any(map(is_foreign, given)):
            return self.on_text(begin, inputs, keep)  # these libraries do not write
        first, tables = ([np.asarray(a, np.float64) for a in group] for group in (begin, inputs))
        shape = np.broadcast_shapes(*(a.shape for a in tables), *((*a.shape, 1) for a in first))
        if pays(math.prod(shape), False):
            fits = out is not None and out.flags.c_contiguous and not any(np.may_share_memory(out, a) for a in given)
            poses = self.on_compiled(first, tables, shape, keep, out if fits else None)
        else:
            fits, poses = False, self.on_text(begin, inputs, keep)
        return poses if out is None or fits else written(out, poses)

    def on_text(self, begin: Columns, inputs: Columns, keep: str) -> Any:
        """By running sums over whole arrays."""
        x, y, theta = (b[..., None] if np.ndim(b) else b for b in begin)
        law = self._evaluator
        heading = theta + running_sum(law(0.0, 0.0, 0.0, *inputs)[2])
        dx, dy, _ = law(0.0, 0.0, heading[..., :-1], *inputs)
        poses = x + running_sum(dx), y + running_sum(dy), heading
        if keep == "all":
            return poses
        return tuple(float(e) if isinstance(e, np.ndarray) and not e.ndim else e for e in (p[..., -1] for p in poses))

    def on_compiled(
        self, begin: Columns, inputs: Columns, shape: tuple[int, ...], keep: str, out: np.ndarray | None = None
    ) -> Any:
        """Tile by tile in one compiled loop, into contiguous memory apart from the inputs where it is given."""
        lead, steps = shape[:-1], shape[-1]
        rows = math.prod(lead)
        whole = memory.empty((3, *lead, steps + 1) if keep == "all" else (3, *lead)) if out is None else out
        self._evaluator.kernel().walk(
            [_flat(b, lead) for b in begin], [_along(a, shape) for a in inputs],
            tuple(whole.reshape(3, -1)), (rows, steps),
        )  # fmt: skip
        return tuple(whole) if whole.ndim > 1 else tuple(map(float, whole))


def written(out: np.ndarray, poses: Sequence[Any]) -> Any:
    """The poses where they are wanted."""
    for row, part in zip(out, poses, strict=True):
        row[...] = part
    return tuple(out)


def _flat(array: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    return array.reshape(1) if array.size == 1 else np.ascontiguousarray(np.broadcast_to(array, shape)).reshape(-1)


def _along(array: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """One number, one row of steps, or all rows."""
    if not any(s for s, n in zip(array.strides, array.shape, strict=True) if n > 1):
        return np.array([array.flat[0]])
    if array.size == shape[-1] == array.shape[-1]:
        return np.ascontiguousarray(array.reshape(-1))
    return np.ascontiguousarray(np.broadcast_to(array, shape)).reshape(-1)
