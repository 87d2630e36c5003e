"""How a law is evaluated: the arguments decide.

Python floats                 the ``math`` module over the law's own code
NumPy arrays, few rows        the law as it is written
NumPy arrays, many rows       a compiled loop over the law's own code (where Numba is installed)
JAX, PyTorch, CuPy arrays     the law's own code over their namespace
"""

from __future__ import annotations

import functools
import importlib.util
import math
import threading
from collections.abc import Callable
from typing import Any

import numpy as np

from coplanar.engine import scalars
from coplanar.engine.binding import PRIMITIVES, array_primitives, bind
from coplanar.engine.foreign import is_foreign, namespace_of

FIRST_COMPILED_ROWS = 20_000  # below this a batch never waits for the compiler
COMPILED_ROWS = 100  # from here the compiled loop wins, once it is there

_NUMBERS = frozenset((float, int, bool))
_FLOAT_PRIMITIVES = {name: getattr(scalars, name) for name in (*PRIMITIVES, "integral")}
_float_laws: dict[Any, Any] = {}


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
        self._lock = threading.Lock()
        functools.update_wrapper(self, law)

    def __call__(self, *args: Any) -> Any:
        """Evaluate the law; see the class for what comes out."""
        if _NUMBERS.issuperset(map(type, args)):
            try:
                return self.on_floats(*args)
            except (ArithmeticError, ValueError):  # where math raises, arrays answer inf or NaN
                return self._on_one_row(args)
        if any(is_foreign(a) for a in args):
            return self._on_foreign(args)
        inputs = _as_arrays(args)
        shape = np.broadcast_shapes(*(a.shape for a in inputs))
        if not shape:
            return self(*(float(a) for a in inputs))
        rows = math.prod(shape)
        if rows >= (FIRST_COMPILED_ROWS if self._kernel is None else COMPILED_ROWS) and can_compile():
            return self.on_compiled(*inputs)
        return self.on_text(*inputs)

    def on_text(self, *args: Any) -> Any:
        """The law as it is written, on NumPy arrays."""
        inputs = _as_arrays(args)
        shape = np.broadcast_shapes(*(a.shape for a in inputs))
        with np.errstate(all="ignore"):
            answer = self.law(*inputs)
        if isinstance(answer, tuple):
            return tuple(_full(a, shape) for a in answer)
        return _full(answer, shape)

    def on_compiled(self, *args: Any, out: tuple[np.ndarray, ...] | None = None) -> Any:
        """The law in a compiled loop, on NumPy arrays.

        Args:
            *args: Numbers and arrays that broadcast.
            out: Where to write: one C-contiguous array of the broadcast shape for each result.
        """
        inputs = _as_arrays(args)
        shape = np.broadcast_shapes(*(a.shape for a in inputs))
        first = self(*(float(a.reshape(-1)[0]) if a.size else 0.0 for a in inputs))
        dtype = inputs[0].dtype
        outs = out or tuple(np.empty(shape, dtype) for _ in (first if isinstance(first, tuple) else (first,)))
        self.kernel().run(inputs, outs, shape)
        return outs if isinstance(first, tuple) else outs[0]

    def on_namespace(self, namespace: Any) -> Callable[..., Any]:
        """The law over another array library's namespace."""
        return _foreign_law(self.law, namespace)

    def kernel(self) -> Any:
        """The law's compiled loops; made once."""
        with self._lock:
            if self._kernel is None:
                from coplanar.engine.compiled.kernels import Kernel

                self._kernel = Kernel(self.law)
            return self._kernel

    def _on_one_row(self, args: tuple[Any, ...]) -> Any:
        answer = self.on_text(*args)
        return tuple(float(a) for a in answer) if isinstance(answer, tuple) else float(answer)

    def _on_foreign(self, args: tuple[Any, ...]) -> Any:
        xp = namespace_of(next(a for a in args if is_foreign(a)))
        return self.on_namespace(xp)(*(xp.asarray(a) for a in args))


@functools.cache
def evaluator(law: Callable[..., Any]) -> Evaluator:
    """The evaluator of a law; the same one for every caller."""
    return Evaluator(law)


@functools.cache
def can_compile() -> bool:
    """Whether Numba is installed here; without it the NumPy text answers every batch."""
    return importlib.util.find_spec("numba") is not None


@functools.cache
def _foreign_law(law: Callable[..., Any], namespace: Any) -> Callable[..., Any]:
    bound: Callable[..., Any] = bind(law, _foreign_primitives(namespace))
    return bound


@functools.cache
def _foreign_primitives(namespace: Any) -> dict[str, Any]:
    return array_primitives(namespace)


def _as_arrays(args: tuple[Any, ...]) -> tuple[np.ndarray, ...]:
    """Arrays of one float type: float32 where every array is, otherwise float64."""
    arrays = [np.asarray(a) for a in args]
    single = [a.dtype == np.float32 for a in arrays if a.ndim]
    dtype = np.float32 if single and all(single) else np.float64
    return tuple(a.astype(dtype, copy=False) for a in arrays)


def _full(answer: Any, shape: tuple[int, ...]) -> np.ndarray:
    array = np.asarray(answer)
    return array if array.shape == shape else np.broadcast_to(array, shape).copy()
