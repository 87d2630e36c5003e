"""The evaluators of a law, by name, for tests that run over all of them."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from typing import Any

import numpy as np

from coplanar.engine import evaluator

HAS_JAX = importlib.util.find_spec("jax") is not None
ARRAY_ENGINES = ["text", "compiled"] + (["jax"] if HAS_JAX else [])


def on_floats(law: Callable[..., Any], *args: Any) -> tuple[np.ndarray, ...]:
    """The law row by row with Python floats."""
    columns = np.broadcast_arrays(*args)
    rows = [evaluator(law)(*(float(c) for c in row)) for row in zip(*(c.ravel() for c in columns), strict=True)]
    table = np.array([r if isinstance(r, tuple) else (r,) for r in rows])
    return tuple(column.reshape(columns[0].shape) for column in table.T)


def on_engine(name: str, law: Callable[..., Any], *args: Any) -> tuple[np.ndarray, ...]:
    """The law on arrays by the named evaluator, as NumPy arrays."""
    if name == "jax":
        import jax

        with jax.enable_x64(True):
            answer = evaluator(law)(*(jax.numpy.asarray(a) for a in args))
    else:
        answer = getattr(evaluator(law), f"on_{name}")(*args)
    return tuple(np.asarray(a) for a in (answer if isinstance(answer, tuple) else (answer,)))
