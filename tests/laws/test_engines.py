"""Every law gives the same values by every evaluator, to a few ulp, wherever it is evaluated."""

from __future__ import annotations

import inspect
import pkgutil
from importlib import import_module

import numpy as np
import pytest

import coplanar.laws
from tests.engines import ARRAY_ENGINES, on_engine, on_floats

LAWS = [
    law
    for module in pkgutil.iter_modules(coplanar.laws.__path__)
    for _, law in inspect.getmembers(import_module(f"coplanar.laws.{module.name}"), inspect.isfunction)
    if law.__module__ == f"coplanar.laws.{module.name}"
]


def columns(law, seed=0, rows=300):
    """Arguments near one, with zeros, tiny and large ones among them."""
    rng = np.random.default_rng(seed)
    spread = 10.0 ** rng.integers(-12, 1, size=(len(inspect.signature(law).parameters), rows))
    table = rng.uniform(-3.0, 3.0, size=spread.shape) * np.where(rng.random(spread.shape) < 0.3, spread, 1.0)
    table[rng.random(spread.shape) < 0.05] = 0.0
    return tuple(table)


@pytest.mark.parametrize("engine", ARRAY_ENGINES)
@pytest.mark.parametrize("law", LAWS, ids=lambda law: f"{law.__module__.rpartition('.')[2]}.{law.__name__}")
def test_engines_agree(law, engine):
    args = columns(law)
    with np.errstate(all="ignore"):
        expected = on_floats(law, *args)
        for one, other in zip(on_engine(engine, law, *args), expected, strict=True):
            # Sums of products of a few roundings each; where a law divides, both sides carry the same condition.
            scale = np.maximum(1.0, np.abs(other))
            same = (np.abs(one - other) <= 1e-12 * scale) | (one == other) | (np.isnan(one) & np.isnan(other))
            assert same.all(), (args and [a[~same][:3] for a in args], one[~same][:3], other[~same][:3])
