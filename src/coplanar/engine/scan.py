"""Sequential work: a law that carries a state from step to step, over many rows at once.

The law reads ``new_state = law(*state, *inputs of the step, *parameters)``. As with ``Evaluator`` the arguments decide
who evaluates it: floats step by step in Python, NumPy rows by the text or by a compiled loop, JAX by its own scan.
"""

from __future__ import annotations

import functools
import importlib
import math
from collections.abc import Callable, Collection, Sequence
from typing import Any

import numpy as np

from coplanar.engine import memory
from coplanar.engine.evaluator import Evaluator, evaluator
from coplanar.engine.foreign import alike, is_foreign
from coplanar.engine.policy import pays

Columns = Sequence[Any]
Keep = str | Collection[int]


class Scan:
    """A law folded over the leading axis of its inputs.

    Example:
        >>> def grow(total, amount, rate):
        ...     return (total + rate * amount,)
        >>> Scan(grow)([0.0], [np.array([1.0, 2.0, 3.0])], [10.0])[0].tolist()
        [0.0, 10.0, 30.0, 60.0]
        >>> Scan(grow)([0.0], [np.array([1.0, 2.0, 3.0])], [np.array([1.0, 10.0])], keep="end")[0].tolist()
        [6.0, 60.0]
        >>> def coast(way, speed, push):
        ...     return way + speed, speed + push
        >>> [a.tolist() for a in map(np.asarray, Scan(coast)([0.0, 1.0], [np.array([1.0, 1.0])], keep=[0]))]
        [[0.0, 1.0, 3.0], 3.0]
    """

    def __init__(self, law: Callable[..., Any]) -> None:
        self._evaluator: Evaluator = evaluator(law)
        functools.update_wrapper(self, law)

    def __call__(self, initial: Columns, inputs: Columns, parameters: Columns = (), *, keep: Keep = "all") -> Any:
        """Carry the state through all steps.

        Args:
            initial: The state before the first step: numbers, or arrays that broadcast to the rows' shape.
            inputs: One array per input, shape (steps,) or (steps, *rows).
            parameters: Numbers, or arrays that broadcast to the rows' shape.
            keep: "all" for the state before the first step and after every step, "end" for the last one only, or the
                places of the entries of the state that are kept at every step, the others at the end.

        Returns:
            A tuple with one array per entry of the state: shape (steps + 1, *rows) where it is kept at every step, else
            (*rows), a float for rows of shape ().
        """
        given = (*initial, *inputs, *parameters)
        if any(map(is_foreign, given)):
            return self._on_foreign(initial, inputs, parameters, keep)
        state = [np.asarray(s, np.float64) for s in initial]
        tables = [np.asarray(t, np.float64) for t in inputs]
        constants = [np.asarray(c, np.float64) for c in parameters]
        tails = [t.shape[1:] for t in tables]
        rows = np.broadcast_shapes(*(a.shape for a in (*state, *constants)), *tails)
        work = math.prod(rows) * len(tables[0])
        if pays(work, False):
            return self.on_compiled(state, tables, constants, rows, keep)
        return self.on_text(state, tables, constants, rows, keep)

    def on_text(self, state: Columns, tables: Columns, constants: Columns, rows: tuple[int, ...], keep: Keep) -> Any:
        """One call of the law per step: floats for a single row, the NumPy text for more."""
        law = self._evaluator.on_text if rows else self._evaluator
        now = tuple(np.broadcast_to(s, rows).copy() if rows else float(s) for s in state)
        fixed = tuple(constants) if rows else tuple(float(c) for c in constants)
        steps = zip(*(table if rows else table.tolist() for table in tables), strict=True)
        kept = _kept(keep, len(now))
        histories = [[entry] for entry in now]
        for step in steps:
            now = law(*now, *step, *fixed)
            for k in kept:
                histories[k].append(now[k])
        return tuple(np.array(histories[k]) if k in kept else end for k, end in enumerate(now))

    def on_compiled(
        self, state: Columns, tables: Columns, constants: Columns, rows: tuple[int, ...], keep: Keep
    ) -> Any:
        """All steps in one compiled loop; what is kept at every step lies in one memory."""
        count, width = len(tables[0]), math.prod(rows)
        kept = _kept(keep, len(state))
        histories = iter(memory.empty((len(kept), count + 1, *rows)))
        whole = tuple(next(histories) if k in kept else np.empty(rows) for k in range(len(state)))
        self._evaluator.kernel().scan(
            [_column(s, rows) for s in state], [_table(t, rows) for t in tables],
            [_column(c, rows) for c in constants], tuple(out.reshape(-1) for out in whole), (count, width),
        )  # fmt: skip
        return tuple(out if k in kept or rows else float(out) for k, out in enumerate(whole))

    def _on_foreign(self, initial: Columns, inputs: Columns, parameters: Columns, keep: Keep) -> Any:
        xp, arrays = alike((*initial, *inputs, *parameters))
        law = self._evaluator.on_namespace(xp)
        first, last = len(initial), len(initial) + len(inputs)
        state, tables, fixed = arrays[:first], arrays[first:last], arrays[last:]
        rows = np.broadcast_shapes(*(tuple(a.shape) for a in (*state, *fixed)), *(tuple(t.shape[1:]) for t in tables))
        now = tuple(xp.broadcast_to(s, rows) for s in state)
        history = _fold(xp, lambda state, step: law(*state, *step, *fixed), now, tables)
        whole = tuple(xp.concatenate([n[None], h], 0) for n, h in zip(now, history, strict=True))
        kept = _kept(keep, len(whole))
        return tuple(h if k in kept else h[-1] for k, h in enumerate(whole))


def _kept(keep: Keep, entries: int) -> Collection[int]:
    """The places of the entries of the state that are kept at every step."""
    if isinstance(keep, str):
        return range(entries) if keep == "all" else ()
    return keep


def _fold(xp: Any, step: Callable[..., Any], state: Any, tables: Sequence[Any]) -> Any:
    """The states after every step: by ``jax.lax.scan``, or step by step for other libraries."""
    if xp.__name__ == "jax.numpy":
        lax = importlib.import_module("jax.lax")
        _, history = lax.scan(lambda now, rows: (step(now, rows),) * 2, state, tuple(tables))
        return history
    states = []
    for rows in zip(*tables, strict=True):
        state = step(state, rows)
        states.append(state)
    return tuple(xp.stack(column) for column in zip(*states, strict=True))


def _column(array: np.ndarray, rows: tuple[int, ...]) -> np.ndarray:
    if array.size == 1:
        return array.reshape(1)
    return np.ascontiguousarray(array if array.shape == rows else np.broadcast_to(array, rows)).reshape(-1)


def _table(array: np.ndarray, rows: tuple[int, ...]) -> np.ndarray:
    if array.size == len(array):
        return np.ascontiguousarray(array.reshape(-1))
    return np.ascontiguousarray(np.broadcast_to(array, (len(array), *rows))).reshape(-1)
