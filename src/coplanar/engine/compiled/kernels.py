"""One compiled kernel per law: the law bound to compiled primitives, inside the loops of ``loops``."""

from __future__ import annotations

import hashlib
import math
import os
import threading
from types import FunctionType

import numpy as np
from numba import njit

from coplanar.engine.arrays import Integral
from coplanar.engine.binding import bind
from coplanar.engine.compiled import loops, rounds, scans
from coplanar.engine.compiled.cache import in_folder
from coplanar.engine.compiled.doubt import shows_every_nan
from coplanar.engine.compiled.elementary import FLAGS, inline
from coplanar.engine.compiled.primitives import FAST, SAFE

PARALLEL_FROM = 200_000  # rows; below, starting threads costs more than they save

_fast_laws: dict = {}
_safe_laws: dict = {}
_threads = threading.Lock()
_process = os.getpid()


class Loops:
    """Laws inside compiled loops: each loop is compiled at its first call, with the laws under the names given here."""

    def __init__(self, laws, texts) -> None:
        """Laws by the names that the loops know them by, and for every kind of loop the module that holds it."""
        self._laws = laws
        self._texts = texts
        self._lock = threading.Lock()
        self._loops: dict = {}
        self._parts: dict = {}

    def loop(self, kind, arguments, work, rows, constants=()):
        """Threads where they pay and are free; a forked child never touches the parent's threads."""
        threads_pay = work >= PARALLEL_FROM and rows >= 2 * scans.BLOCK and os.getpid() == _process
        if threads_pay and _threads.acquire(blocking=False):
            try:
                self._call(kind, f"{kind}_parallel", constants, arguments)
            finally:
                _threads.release()
        else:
            self._call(kind, f"{kind}_serial", constants, arguments)

    def _call(self, kind, loop, constants, arguments):
        try:
            self._compiled(kind, loop, constants)(*arguments)
        except OSError:  # the cache folder went away, or is full
            with self._lock:
                self._loops[loop, constants] = self._compile(kind, loop, constants, cached=False)
            self._loops[loop, constants](*arguments)

    def _compiled(self, kind, loop, constants):
        with self._lock:
            if (loop, constants) not in self._loops:
                self._loops[loop, constants] = self._compile(kind, loop, constants)
            return self._loops[loop, constants]

    def _compile(self, kind, loop, constants, *, cached=True):
        """A loop over these laws; the loops of a kind share their parts."""
        label = _label(self._laws, constants)
        if (kind, constants) not in self._parts:
            self._parts[kind, constants] = _parts(self._laws, self._texts[kind], label, dict(constants))
        with in_folder() as writeable:
            return njit(
                _template(getattr(self._texts[kind], loop), label, self._parts[kind, constants]),
                fastmath=FLAGS, error_model="numpy", nogil=True,
                cache=cached and writeable, parallel=loop.endswith("parallel"),
            )  # fmt: skip

    def fill(self, kind, inputs, columns, shape, *, more=(), work=1, constants=()):
        """Run a loop over rows of inputs that broadcast to the shape of the flat output columns.

        Inputs that have to be spread first are, a part at a time.
        """
        rows = math.prod(shape)
        ready = [_column(a, shape, rows) for a in inputs]
        if all(column is not None for column, _ in ready):
            ins, steps = zip(*ready, strict=True)
            self.loop(kind, (ins, steps, columns, rows, *more), work * rows, rows, constants)
            return
        whole = [np.broadcast_to(a, shape).flat for a in inputs]
        steps = tuple(step for _, step in ready)
        span = 16 * loops.BLOCK
        for start in range(0, rows, span):
            stop = min(start + span, rows)
            ins = tuple(
                _read_only(flat[start:stop]) if column is None else column[start:stop] if step else column
                for (column, step), flat in zip(ready, whole, strict=True)
            )
            outs = tuple(c[start:stop] for c in columns)
            self.loop(kind, (ins, steps, outs, stop - start, *more), work * (stop - start), stop - start, constants)


class Kernel(Loops):
    """A law inside compiled loops: ``run`` over rows, ``scan`` over steps of rows."""

    def __init__(self, law) -> None:
        super().__init__({"law": law}, {"rows": loops, "scan": scans})

    def scan(self, initial, inputs, parameters, outputs, size):
        """Carry the state from step to step.

        Args:
            initial: Arrays of one entry or of as many as there are rows.
            inputs: Arrays of ``steps`` entries, or of ``steps`` times ``rows``.
            parameters: Arrays like ``initial``.
            outputs: Flat arrays of ``rows`` entries for the end, or of (steps + 1) times ``rows``.
            size: Steps and rows.
        """
        count, width = size
        owned = [array.size != count for array in inputs]
        begin, walk = zip(*(_column(a, (width,), width) for a in initial), strict=True)
        held = [_column(a, (width,), width) for a in parameters]
        shared = tuple(_read_only(a) for a, own in zip(inputs, owned, strict=True) if not own)
        own = tuple(_read_only(a) for a, own in zip(inputs, owned, strict=True) if own)
        pattern = sum(1 << k for k, own in enumerate(owned) if own)
        arguments = (
            begin, walk, shared, own, tuple(c for c, _ in held), tuple(s for _, s in held), outputs, (count, width)
        )  # fmt: skip
        constants = (("KEEP", outputs[0].size > width), ("PATTERN", pattern))
        self.loop("scan", arguments, count * width, width, constants)

    def run(self, inputs, outputs, shape):
        """Evaluate the law on every row of the broadcast inputs.

        Args:
            inputs: Arrays of one float type that broadcast to ``shape``.
            outputs: Arrays of ``shape`` and that type, which may lie in memory as they like, over the inputs too.
            shape: The common shape.
        """
        fit = [_may_be_written(out, inputs) for out in outputs]
        targets = [out if fits else np.empty(shape, out.dtype) for out, fits in zip(outputs, fit, strict=True)]
        self.fill("rows", inputs, tuple(t.reshape(-1) for t in targets), shape)
        for out, target in zip(outputs, targets, strict=True):
            if out is not target:
                out[...] = target


class SearchKernel(Loops):
    """The laws of a search inside the loops of ``rounds``."""

    def __init__(self, laws, sizes) -> None:
        super().__init__(laws, {"rounds": rounds})
        more = {"WITH": 1 + sizes["ROW"], "SPAN": 3 + sizes["ARGS"]}
        self._constants = tuple({**sizes, **more}.items())
        self.one = None  # from a tuple of numbers and the rounds to the answer; there after the first batch

    def run(self, inputs, outputs, shape, rounds_at_most):
        """Search every row of the broadcast inputs; the outputs are new arrays of ``shape``."""
        columns = tuple(out.reshape(-1) for out in outputs)
        more = (rounds_at_most,)
        self.fill("rounds", inputs, columns, shape, more=more, work=rounds.WORK, constants=self._constants)
        if self.one is None:
            self._call("rounds", "rounds_one", self._constants, ((0.5,) * len(inputs), 1))
            self.one = self._compiled("rounds", "rounds_one", self._constants)


def _column(array, shape, rows):
    """The array as a flat column and its step, or None where it has to be spread first.

    All columns are read-only, so that a loop is compiled once whether or not the caller's arrays are.
    """
    if array.size == 1:
        return _read_only(np.full(min(rows, loops.BLOCK), array.item(), array.dtype)), 0
    if array.shape == shape and array.flags.c_contiguous and array.flags.aligned:
        return _read_only(array.reshape(-1)), 1
    return None, 1


def _read_only(array):
    column = array.view()
    column.flags.writeable = False
    return column


def _may_be_written(out, inputs):
    """Whether the loop can write into ``out`` itself: a row may be read again after it was written."""
    return out.flags.c_contiguous and out.flags.aligned and not any(np.may_share_memory(out, a) for a in inputs)


def _label(laws, constants):
    """What tells the loops of these laws from all others."""
    first = next(iter(laws.values()))
    digest = _digest(*laws.values())
    return "_".join([first.__module__.rpartition(".")[2], first.__name__, *(f"{k}{v}" for k, v in constants), digest])


def _parts(laws, texts, label, names):
    """The parts of loops over these laws by name; beside each law stands its safe form under the name ``safe_...``."""
    for name, law in laws.items():
        safe_law = bind(law, SAFE, _out_of_line, _safe_laws)
        names[f"safe_{name}"] = safe_law
        names[name] = bind(law, FAST, inline, _fast_laws) if shows_every_nan(law) else safe_law
    for part in texts.PARTS:
        names[part.__name__] = njit(_template(part, label, names), fastmath=FLAGS, error_model="numpy", nogil=True)
    return names


def _template(text, label, names):
    """The loop's code over these names; its own qualified name keeps the caches of two laws apart."""
    name = f"{text.__name__}_{label}"
    function = FunctionType(text.__code__, {**text.__globals__, **names}, name)
    function.__qualname__ = name
    return function


def _digest(*laws):
    """Of laws as they are in memory, with those they call: one may be newer or older than its file, or have none."""
    digest = hashlib.sha256()
    for law in laws:
        _add_text(law, digest, set())
    return digest.hexdigest()[:12]


def _add_text(law, digest, seen):
    seen.add(law)
    code = law.__code__
    digest.update(repr((code.co_code, code.co_consts, code.co_names)).encode())
    for name in code.co_names:
        value = law.__globals__.get(name)
        if isinstance(value, Integral):
            digest.update(str(value.points).encode())
            value = value.integrand
        if isinstance(value, FunctionType):
            if value not in seen:
                _add_text(value, digest, seen)
        elif isinstance(value, float | int | str | tuple):
            digest.update(repr((name, value)).encode())


def _out_of_line(function):
    """The safe law is rare: compiled once beside the loop, not melted into it."""
    return njit(function, fastmath=FLAGS, error_model="numpy")
