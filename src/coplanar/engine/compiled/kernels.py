"""One compiled kernel per law: the law bound to compiled primitives, inside the loops of ``loops``."""

from __future__ import annotations

import math
import os
import threading
from types import FunctionType

import numpy as np
from numba import get_num_threads, njit

from coplanar.engine import memory
from coplanar.engine.binding import bind
from coplanar.engine.compiled import layout, loops, scans, stretches, walks
from coplanar.engine.compiled.cache import in_folder
from coplanar.engine.compiled.columns import WIDTH
from coplanar.engine.compiled.digest import digest_of
from coplanar.engine.compiled.door import row_of
from coplanar.engine.compiled.doubt import shows_every_nan
from coplanar.engine.compiled.elementary import FLAGS, inline
from coplanar.engine.compiled.lanes import LANES
from coplanar.engine.compiled.primitives import FAST, SAFE, SINGLE
from coplanar.engine.compiled.single import in_single

SPREAD_ROWS = 1 << 18  # rows that are laid out at a time where an array does not lie as the loop reads it
FEW = 8  # rows; fewer cannot be shared evenly as whole rows
CACHES = 1 << 24  # [bytes] of results that still pay to keep in the caches
PARALLEL_FROM = 200_000  # rows; below, starting threads costs more than they save

_fast_laws: dict = {}
_safe_laws: dict = {}
_single_laws: dict = {}
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
        """Threads where they pay and are free; a forked child never touches the parent's threads.

        Returns what the loop returns.
        """
        threads_pay = work >= PARALLEL_FROM and rows >= 2 * WIDTH and os.getpid() == _process
        if threads_pay and _threads.acquire(blocking=False):
            try:
                return self._call(kind, f"{kind}_parallel", constants, arguments)
            finally:
                _threads.release()
        return self._call(kind, f"{kind}_serial", constants, arguments)

    def one(self, kind, count, more=(), constants=()):
        """The function of a kind for a row of so many Python floats, and arguments of more types.

        It refuses anything else by a TypeError.
        """
        signature = (row_of(count), *more)
        try:
            return self._compiled(kind, f"{kind}_one", constants).compile(signature)
        except OSError:  # the cache folder went away, or is full
            return self._compile(kind, f"{kind}_one", constants, cached=False).compile(signature)

    def _call(self, kind, loop, constants, arguments):
        try:
            return self._compiled(kind, loop, constants)(*arguments)
        except OSError:  # the cache folder went away, or is full
            with self._lock:
                self._loops[loop, constants] = self._compile(kind, loop, constants, cached=False)
            return self._loops[loop, constants](*arguments)

    def _compiled(self, kind, loop, constants):
        if (loop, constants) not in self._loops:
            with self._lock:
                if (loop, constants) not in self._loops:
                    self._loops[loop, constants] = self._compile(kind, loop, constants)
        return self._loops[loop, constants]

    def _compile(self, kind, loop, constants, *, cached=True):
        """A loop over these laws; the loops of a kind share their parts."""
        label, texts = _label(self._laws, constants), self._texts[kind]
        if (kind, constants) not in self._parts:
            self._parts[kind, constants] = _parts(self._laws, texts, label, dict(constants))
        with in_folder() as writeable:
            return njit(
                _template(getattr(texts, loop), label, self._parts[kind, constants]), fastmath=FLAGS,
                error_model="numpy", nogil=not loop.endswith("one"), cache=cached and writeable,
                parallel=loop.endswith("parallel"),
            )  # fmt: skip

    def fill(self, kind, inputs, ready, columns, shape, *, more=(), work=1, constants=()):
        """Run a loop over the rows of inputs that broadcast to the shape of the flat output columns.

        Inputs that are not ready (see ``layout.columns``) are laid out, a part at a time. Returns the sum of what the
        loop returns.
        """
        rows = math.prod(shape)
        ins, steps = ready
        if None not in steps:
            return self.loop(kind, (ins, steps, columns, rows, *more), work * rows, rows, constants)
        steps = tuple(1 if step is None else step for step in steps)
        whole = [np.broadcast_to(a, shape) for a in inputs]
        room = [None if column is not None else np.empty(min(rows, SPREAD_ROWS), a.dtype.newbyteorder("="))
                for column, a in zip(ready[0], inputs, strict=True)]  # fmt: skip
        start = total = 0
        for index in layout.slabs(shape, SPREAD_ROWS):
            count = whole[0][index].size
            ins = tuple(
                layout.part(column, step, array[index], space)
                for column, step, array, space in zip(*ready, whole, room, strict=True)
            )
            outs = tuple(c[start : start + count] for c in columns)
            total += self.loop(kind, (ins, steps, outs, count, *more), work * count, count, constants)
            start += count
        return total


class Kernel(Loops):
    """A law inside compiled loops: ``run`` over rows, ``scan`` over steps of rows, ``walk`` along rows of steps."""

    def __init__(self, law) -> None:
        super().__init__({"law": law}, {"rows": loops, "scan": scans, "walk": walks, "stretch": stretches})

    def scan(self, initial, inputs, parameters, outputs, size):
        """Carry the state from step to step.

        Args:
            initial: Arrays of one entry or of as many as there are rows.
            inputs: Arrays of ``steps`` entries, or of ``steps`` times ``rows``.
            parameters: Arrays like ``initial``.
            outputs: For every entry of the state a flat array of ``rows`` entries for the end, or of (steps + 1) times
                ``rows`` for every step.
            size: Steps and rows.
        """
        count, width = size
        begin, fixed = (tuple(layout.read_only(a) for a in group) for group in (initial, parameters))
        walk, hold = (tuple(int(a.size > 1) for a in group) for group in (begin, fixed))
        owned = [array.size != count for array in inputs]
        shared, own = (
            tuple(layout.read_only(a) for a, mine in zip(inputs, owned, strict=True) if mine == which)
            for which in (False, True)
        )
        kept, large = _bits(out.size > width for out in outputs), 8 * sum(out.size for out in outputs) > CACHES
        ends = (1 << len(outputs)) - 1 - kept
        arguments = (begin, walk, shared, own, fixed, hold, outputs, (count, width, large))
        constants = (("STATES", len(outputs)), ("FIXED", len(fixed)), ("PATTERN", _bits(owned)), ("KEPT", kept),
                     ("ENDS", ends))  # fmt: skip
        self.loop("scan", arguments, count * width, width, constants)

    def walk(self, begin, inputs, outputs, size):
        """Carry poses along rows of steps.

        Args:
            begin: x, y and heading of the first poses: arrays of one entry or of as many as there are rows.
            inputs: Arrays of 1, ``steps``, or ``rows`` times ``steps`` entries.
            outputs: Flat arrays of ``rows`` entries for the end, or of ``rows`` times (steps + 1).
            size: Rows and steps.
        """
        rows, steps = size
        group = _group(steps)
        first, hold = zip(*(layout.column(a, (rows,), rows) for a in begin), strict=True)
        paces = tuple(int(array.size > 1) for array in inputs)
        strides = tuple(steps if array.size > steps else 0 for array in inputs)
        ins = tuple(
            layout.read_only(a if stride else _repeated(a, group) if pace else layout.spread(a, walks.TILE))
            for a, stride, pace in zip(inputs, strides, paces, strict=True)
        )
        constants = (("KEEP", outputs[0].size > rows),)
        long = rows < FEW and rows * steps >= PARALLEL_FROM and _has_threads()
        self.loop("stretch" if long else "walk", (first, hold, ins, strides, paces, outputs, (*size, group)),
                  rows * steps, rows * steps if long else WIDTH * rows, constants)  # fmt: skip

    def run_into(self, outputs, inputs, shape, *, finite=False):
        """``run`` where the outputs may lie in memory as they like, over the inputs too; returns the same."""
        tables = [a for a in inputs if a.ndim]
        fit = [layout.may_be_written(out, tables) for out in outputs]
        targets = [out if fits else memory.empty(shape, out.dtype) for out, fits in zip(outputs, fit, strict=True)]
        left = self.run(inputs, targets, shape, finite=finite)
        for out, target in zip(outputs, targets, strict=True):
            if out is not target:
                out[...] = target
        return left

    def run(self, inputs, outputs, shape, *, finite=False):
        """Evaluate the law on every row of the broadcast inputs.

        Args:
            inputs: Arrays of one float type that broadcast to ``shape``.
            outputs: Arrays of ``shape`` and that type, contiguous and apart from the inputs.
            shape: The common shape.
            finite: Whether infinities are counted too.

        Returns:
            How many rows show a NaN (or infinities that cancel).
        """
        ready, block = layout.columns(inputs, shape), loops.BLOCK
        if None in ready[1]:
            ready, block = layout.repeated(inputs, ready, shape)
        pairs = _bits(step == 2 for step in ready[1]) if 2 in ready[1] else 0
        constants = (("PAIRS", pairs), ("FINITE", finite))
        if inputs[0].dtype == np.float32:
            constants = (("SINGLE", True), *constants)
        columns = tuple([o.ravel() for o in outputs])
        return self.fill("rows", inputs, ready, columns, shape, more=(block,), constants=constants)


def _bits(flags):
    return sum(1 << k for k, flag in enumerate(flags) if flag)


def _has_threads():
    """Whether there is more than one thread to share the work; a forked child has one."""
    return os.getpid() == _process and get_num_threads() > 1


def _repeated(row, times):
    return np.tile(row, times) if times > 1 else row


def _group(steps):
    """How many whole rows of steps make a tile: a count of steps that fills vectors, if one does."""
    most = max(1, walks.TILE // max(1, steps))
    even = LANES // math.gcd(steps, LANES)
    return most - most % even if most >= even else most


def _label(laws, constants):
    """What tells the loops of these laws from all others."""
    first = next(iter(laws.values()))
    digest = digest_of(*laws.values())
    return "_".join([first.__module__.rpartition(".")[2], first.__name__, *(f"{k}{v}" for k, v in constants), digest])


def _parts(laws, texts, label, names):
    """The parts of loops over these laws by name; beside each law stands its safe form under the name ``safe_...``."""
    single = names.get("SINGLE", False)
    for name, law in laws.items():
        safe_law = bind(law, SAFE, _out_of_line, _safe_laws)
        names[f"safe_{name}"] = safe_law
        names[name] = _fast_law(law, single=single) if shows_every_nan(law) else safe_law
    for part in texts.PARTS:
        names[part.__name__] = njit(_template(part, label, names), fastmath=FLAGS, error_model="numpy", nogil=True)
    return names


def _fast_law(law, *, single):
    return bind(law, SINGLE, in_single, _single_laws) if single else bind(law, FAST, inline, _fast_laws)


def _template(text, label, names):
    """The loop's code over these names; its own qualified name keeps the caches of two laws apart."""
    name = f"{text.__name__}_{label}"
    function = FunctionType(text.__code__, {**text.__globals__, **names}, name)
    function.__qualname__ = name
    return function


def _out_of_line(function):
    """The safe law is rare: compiled once beside the loop, not melted into it."""
    return njit(function, fastmath=FLAGS, error_model="numpy")
