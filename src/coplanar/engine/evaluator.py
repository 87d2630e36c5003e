"""How a law is evaluated: the arguments decide.

Python floats                 the ``math`` module over the law's own code; compiled after a ``warm_up``
NumPy arrays, few rows        the law as it is written
NumPy arrays, many rows       a compiled loop over the law's own code (where Numba is installed)
JAX, PyTorch, CuPy arrays     the law's own code over their namespace
"""

from __future__ import annotations

import functools
import math
import threading
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from coplanar.engine import memory, scalars
from coplanar.engine.binding import PRIMITIVES, array_primitives, bind, operations
from coplanar.engine.foreign import alike, broadcast_shape, is_foreign
from coplanar.engine.policy import AT_ONCE, COMPILED_ROWS, LONG, can_compile, mode, pays
from coplanar.errors import InvalidShape

_FLOAT = frozenset((float,))
_NUMBERS = frozenset((float, np.ndarray))
_FLOAT64 = np.dtype(np.float64)
_FLOAT_PRIMITIVES = {name: getattr(scalars, name) for name in (*PRIMITIVES, "integral")}
_float_laws: dict[Any, Any] = {}


class _Facts(NamedTuple):
    """How many rows a compiled loop pays from, how many results there are, and whether they come as a tuple."""

    least: int
    results: int
    many: bool


class Evaluator:
    """A law that can be called with floats, NumPy arrays or arrays of another library.

    Scalars in, floats out; arrays in, arrays of the broadcast shape out.

    Attributes:
        law: The text: a valid NumPy function.
        on_floats: The same text over ``math``.

    Example:
        >>> from coplanar.engine import arrays
        >>> def ring(radius, angle):
        ...     return radius * cos(angle), radius * sin(angle)
        >>> ring.__globals__.update(cos=arrays.cos, sin=arrays.sin)
        >>> Evaluator(ring)(2.0, 0.0)
        (2.0, 0.0)
        >>> Evaluator(ring)(np.array([1.0, 2.0]), 0.0)[0].tolist()
        [1.0, 2.0]
    """

    def __init__(self, law: Callable[..., Any]) -> None:
        self.law = law
        self.on_floats: Callable[..., Any] = bind(law, _FLOAT_PRIMITIVES, bound=_float_laws)
        self._kernel: Any = None
        self._one: Callable[..., Any] | None = None
        self._ready = False  # whether a batch has been through the compiled loop
        self._lock = threading.Lock()
        self._known: _Facts | None = None
        functools.update_wrapper(self, law, updated=())

    def __call__(self, *args: Any) -> Any:
        """Evaluate the law; see the class for what comes out.

        Raises:
            InvalidShape: If the arguments do not broadcast.
        """
        if self._one is not None and not mode.get():
            try:
                return self._one(args)
            except TypeError:  # not all of them are floats
                return self._on_any(args)
        return self._on_any(args)

    def _on_any(self, args: tuple[Any, ...]) -> Any:
        """By what the arguments are."""
        if _FLOAT.issuperset(map(type, args)):
            return self._on_numbers(args)
        if not _NUMBERS.issuperset(map(type, args)) and any(is_foreign(a) for a in args):
            return self._on_foreign(args)
        inputs = _as_arrays(args)
        shape = self._shape(inputs)
        if not shape:
            return self(*(float(a) for a in inputs))
        return self._compiled(inputs, shape) if self._compiles(math.prod(shape)) else self._text(inputs, shape)

    def on_text(self, *args: Any) -> Any:
        """The law as it is written, on NumPy arrays."""
        inputs = _as_arrays(args)
        return self._text(inputs, self._shape(inputs))

    def _text(self, inputs: tuple[np.ndarray, ...], shape: tuple[int, ...]) -> Any:
        with np.errstate(all="ignore"):
            answer = self.law(*inputs)
        if isinstance(answer, tuple):
            return _full(answer, shape, inputs)
        return _full((answer,), shape, inputs)[0]

    def on_compiled(self, *args: Any, out: tuple[np.ndarray, ...] | None = None) -> Any:
        """The law in a compiled loop, on NumPy arrays.

        Args:
            *args: Numbers and arrays that broadcast.
            out: Where to write: one array for each result, of the broadcast shape and the float type of the arguments.

        Raises:
            InvalidShape: If the arguments do not broadcast, or ``out`` is not as it should be.
        """
        inputs = _as_arrays(args)
        if out is None:
            return self._compiled(inputs, self._shape(inputs))
        self._compiled_into(out, inputs)
        return out if self._facts.many else out[0]

    def _compiled_into(self, out: tuple[np.ndarray, ...], inputs: tuple[np.ndarray, ...], finite: bool = False) -> int:
        """Returns in how many rows a NaN shows, or something that is not finite."""
        shape = self._shape(inputs)
        _check_out(out, self._facts.results, shape, inputs[0].dtype)
        rows: int = self.kernel().run_into(out, inputs, shape, finite=finite)
        self._ready = True
        return rows

    def _compiled(self, inputs: tuple[np.ndarray, ...], shape: tuple[int, ...]) -> Any:
        outs = tuple([memory.empty(shape, inputs[0].dtype) for _ in range(self._facts.results)])
        self.kernel().run(inputs, outs, shape)
        self._ready = True
        return outs if self._facts.many else outs[0]

    def into(self, out: tuple[np.ndarray, ...], *args: Any, finite: bool = False) -> bool:
        """Evaluate NumPy rows and write them into these arrays: one for each result, of the broadcast shape.

        Args:
            out: Float64 arrays.
            *args: Numbers and arrays, not all of them numbers.
            finite: Whether infinities count as NaN does.

        Returns:
            True if no result is NaN; False perhaps without need where infinities cancel, or finite sums overflow.
        """
        if self._compiles(out[0].size):
            return not self._compiled_into(out, _as_arrays(args), finite)
        answer = self.on_text(*args)
        for array, part in zip(out, answer if isinstance(answer, tuple) else (answer,), strict=True):
            array[...] = part
        return all(np.isfinite(array).all() if finite else not np.isnan(array).any() for array in out)

    def _compiles(self, rows: int) -> bool:
        return pays(rows, self._ready, least=self._facts.least)

    def _on_numbers(self, args: tuple[float, ...]) -> Any:
        if mode.get() == AT_ONCE and self._facts.least == 1 and can_compile():
            if self._one is None:
                self._one = self.kernel().one("rows", len(args))
            return self._one(args)
        try:
            return self.on_floats(*args)
        except (ArithmeticError, ValueError):  # where math raises, arrays answer inf or NaN
            return self._by_arrays(args)

    def _by_arrays(self, args: tuple[float, ...]) -> Any:
        answer = self.on_text(*args)
        return tuple(float(a) for a in answer) if isinstance(answer, tuple) else float(answer)

    def on_namespace(self, namespace: Any) -> Callable[..., Any]:
        """The law over another array library's namespace."""
        return _foreign_law(self.law, namespace)

    @property
    def _facts(self) -> _Facts:
        """Of the law; found out once."""
        if self._known is None:
            answer = self._by_arrays((0.5,) * self.law.__code__.co_argcount)
            many = isinstance(answer, tuple)
            least = 1 if operations(self.law) >= LONG else COMPILED_ROWS
            self._known = _Facts(least, len(answer) if many else 1, many)
        return self._known

    def kernel(self) -> Any:
        """The law's compiled loops; made once."""
        if self._kernel is None:
            from coplanar.engine.compiled.kernels import Kernel

            with self._lock:
                self._kernel = self._kernel or Kernel(self.law)
        return self._kernel

    def _shape(self, arrays: Any) -> tuple[int, ...]:
        shapes = {a.shape for a in arrays}
        if len(shapes) == 1:
            return tuple(shapes.pop())
        try:
            return broadcast_shape(arrays)
        except ValueError:
            names = self.law.__code__.co_varnames[: len(arrays)]
            given = "shapes " + ", ".join(str(tuple(a.shape)) for a in arrays)
            raise InvalidShape(", ".join(names), given, "shapes that broadcast as in NumPy") from None

    def _on_foreign(self, args: tuple[Any, ...]) -> Any:
        xp, arrays = alike(args)
        shape = self._shape(arrays)
        answer = self.on_namespace(xp)(*arrays)
        if isinstance(answer, tuple):
            return tuple(xp.broadcast_to(xp.asarray(a), shape) for a in answer)
        return xp.broadcast_to(xp.asarray(answer), shape)


@functools.cache
def evaluator(law: Callable[..., Any]) -> Evaluator:
    """The evaluator of a law; the same one for every caller."""
    return Evaluator(law)


@functools.cache
def _foreign_law(law: Callable[..., Any], namespace: Any) -> Callable[..., Any]:
    bound: Callable[..., Any] = bind(law, _foreign_primitives(namespace))
    return bound


@functools.cache
def _foreign_primitives(namespace: Any) -> dict[str, Any]:
    return array_primitives(namespace)


def _as_arrays(args: tuple[Any, ...]) -> tuple[np.ndarray, ...]:
    """Arrays of one float type: float32 where every array is, otherwise float64."""
    if all([type(a) is float or (type(a) is np.ndarray and a.dtype is _FLOAT64) for a in args]):
        return tuple([np.asarray(a) if type(a) is float else a for a in args])
    arrays = [np.asarray(a) for a in args]
    single = [a.dtype == np.float32 for a in arrays if a.ndim]
    dtype = np.float32 if single and all(single) else np.float64
    return tuple(a.astype(dtype, copy=False) for a in arrays)


def _full(answer: tuple[Any, ...], shape: tuple[int, ...], inputs: tuple[np.ndarray, ...]) -> tuple[np.ndarray, ...]:
    """The answers as arrays of their own, of one shape and the type of the inputs."""
    taken = list(inputs)
    for part in answer:
        array = np.asarray(part, inputs[0].dtype)
        if array.shape != shape or any(array is a for a in taken):
            array = np.broadcast_to(array, shape).copy()
        taken.append(array)
    return tuple(taken[len(inputs) :])


def _check_out(outs: tuple[np.ndarray, ...], results: int, shape: tuple[int, ...], dtype: Any) -> None:
    fits = [a.shape == shape and a.dtype == dtype and a.flags.writeable for a in outs]
    if len(outs) != results or not all(fits):
        given = "shapes and types " + ", ".join(f"{a.shape} {a.dtype}" for a in outs)
        raise InvalidShape("out", given, f"{results} writeable arrays of shape {shape}, type {dtype}")
