"""The peers: what they are called, what is imported, which version is here."""

from __future__ import annotations

import contextlib
import importlib
import io
import warnings
from importlib import metadata
from typing import Any

DISTRIBUTIONS = (
    "robotpy-wpimath",
    "roboticstoolbox-python",
    "spatialmath-python",
    "pin",
    "ikpy",
    "pyclothoids",
    "scipy",
    "py-ballisticcalc",
    "py-ballisticcalc.exts",
    "ballistic-solver",
    "jaxlie",
    "jax",
    "mpmath",
)


def load(module: str) -> Any:
    """A peer's module; what it prints while it is imported is dropped.

    Raises:
        ImportError: If it is not here, or does not work with what is here.
    """
    with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
        warnings.simplefilter("ignore")
        return importlib.import_module(module)


def versions() -> dict[str, str]:
    """Version of every peer; "absent" where there is none."""
    found = {}
    for name in DISTRIBUTIONS:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            found[name] = "absent"
    return found


def jax64() -> tuple[Any, Any]:
    """JAX and its NumPy with 64-bit floats, as everybody else here has them."""
    jax = load("jax")
    jax.config.update("jax_enable_x64", True)
    return jax, load("jax.numpy")
