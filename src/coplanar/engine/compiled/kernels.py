"""One compiled kernel per law: the law bound to compiled primitives, inside the loops of ``loops``."""

from __future__ import annotations

import math
import os
import threading
from types import FunctionType

import numpy as np
from numba import njit

from coplanar.engine.binding import bind
from coplanar.engine.compiled import loops
from coplanar.engine.compiled.cache import in_folder
from coplanar.engine.compiled.primitives import FAST, FLAGS, SAFE, inline, out_of_line

PARALLEL_FROM = 200_000  # rows; below, starting threads costs more than they save

_fast_laws: dict = {}
_safe_laws: dict = {}
_threads = threading.Lock()
_process = os.getpid()


class Kernel:
    """A law as a loop over rows: ``run(inputs, outputs, shape)`` fills the outputs."""

    def __init__(self, law) -> None:
        self._law = law
        self._lock = threading.Lock()
        self._loops: dict = {}

    def run(self, inputs, outputs, shape):
        """Evaluate the law on every row of the broadcast inputs.

        Args:
            inputs: Arrays of one float type that broadcast to ``shape``.
            outputs: C-contiguous arrays of ``shape`` and that type.
            shape: The common shape.
        """
        rows = math.prod(shape)
        columns = tuple(out.reshape(-1) for out in outputs)
        ready = [_column(a, shape) for a in inputs]
        if all(column is not None for column, _ in ready):
            ins, steps = zip(*ready, strict=True)
            self._loop(ins, steps, columns, rows)
            return
        whole = [np.broadcast_to(a, shape).flat for a in inputs]
        span = 16 * loops.BLOCK
        for start in range(0, rows, span):
            stop = min(start + span, rows)
            ins = tuple(
                (column[start:stop] if step else column) if column is not None else np.asarray(flat[start:stop])
                for (column, step), flat in zip(ready, whole, strict=True)
            )
            steps = tuple(step if column is not None else 1 for column, step in ready)
            self._loop(ins, steps, tuple(c[start:stop] for c in columns), stop - start)

    def _loop(self, ins, steps, columns, rows):
        """Threads where they pay and are free; a forked child never touches the parent's threads."""
        if rows >= PARALLEL_FROM and os.getpid() == _process and _threads.acquire(blocking=False):
            try:
                self._compiled("parallel")(ins, steps, columns, rows)
            finally:
                _threads.release()
        else:
            self._compiled("serial")(ins, steps, columns, rows)

    def _compiled(self, kind):
        with self._lock:
            if kind not in self._loops:
                self._loops[kind] = _compile(self._law, kind)
            return self._loops[kind]


def _column(array, shape):
    """The array as a flat column and its step, or None where it has to be spread first."""
    if array.size == 1:
        return np.full(loops.BLOCK, array.reshape(-1)[0], array.dtype), 0
    if array.shape == shape and array.flags.c_contiguous:
        return array.reshape(-1), 1
    return None, 1


def _compile(law, kind):
    names = {
        "law": bind(law, FAST, inline, _fast_laws),
        "safe_law": bind(law, SAFE, out_of_line, _safe_laws),
    }
    names["block"] = njit(_template(loops.block, law, names), fastmath=FLAGS, error_model="numpy", nogil=True)
    with in_folder() as cached:
        return njit(
            _template(getattr(loops, kind), law, names),
            fastmath=FLAGS, error_model="numpy", nogil=True, cache=cached, parallel=kind == "parallel",
        )  # fmt: skip


def _template(text, law, names):
    """The loop's code over this law's names; its own qualified name keeps the caches of two laws apart."""
    name = f"{text.__name__}_{law.__module__.rpartition('.')[2]}_{law.__name__}"
    function = FunctionType(text.__code__, {**vars(loops), **names}, name)
    function.__qualname__ = name
    return function
