"""The evaluators of a law, by name, for tests that run over all of them."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from coplanar.engine import evaluator, reproducible

HAS_JAX = importlib.util.find_spec("jax") is not None
HAS_NUMBA = importlib.util.find_spec("numba") is not None
NEEDS_JAX = pytest.mark.skipif(not HAS_JAX, reason="JAX is not installed: pip install 'coplanar[jax]'")
NEEDS_NUMBA = pytest.mark.skipif(not HAS_NUMBA, reason="Numba is not installed: the NumPy text answers every batch")

ARRAY_ENGINES = [
    "text",
    pytest.param("compiled", marks=NEEDS_NUMBA),
    pytest.param("jax", marks=NEEDS_JAX),
]
ENGINES = ["floats", *ARRAY_ENGINES]

BATCH_SHAPES = [(), (1,), (3, 1, 2)]


def on_floats(law: Callable[..., Any], *args: Any) -> tuple[np.ndarray, ...]:
    """The law row by row with Python floats."""
    columns = np.broadcast_arrays(*args)
    with reproducible():  # by math, whatever was warmed up before
        rows = [evaluator(law)(*(float(c) for c in row)) for row in zip(*(c.ravel() for c in columns), strict=True)]
    table = np.array([r if isinstance(r, tuple) else (r,) for r in rows])
    return tuple(column.reshape(columns[0].shape) for column in table.T)


def on_engine(name: str, law: Callable[..., Any], *args: Any) -> tuple[np.ndarray, ...]:
    """The law on arrays by the named evaluator, as NumPy arrays."""
    if name == "floats":
        return on_floats(law, *args)
    if name == "jax":
        import jax

        with jax.enable_x64(True):
            answer = evaluator(law)(*(jax.numpy.asarray(a) for a in args))
    else:
        answer = getattr(evaluator(law), f"on_{name}")(*args)
    return tuple(np.asarray(a) for a in (answer if isinstance(answer, tuple) else (answer,)))
