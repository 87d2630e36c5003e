"""Every law gives the same values by every evaluator, to a few ulp, wherever it is evaluated."""

from __future__ import annotations

import inspect
import pkgutil
from importlib import import_module

import numpy as np
import pytest

import coplanar.laws
import tests.laws
from coplanar.engine import evaluator
from coplanar.laws import motion, se2
from tests.engines import ARRAY_ENGINES, NEEDS_NUMBA, on_engine, on_floats

LAWS = [
    law
    for module in pkgutil.iter_modules(coplanar.laws.__path__)
    for _, law in inspect.getmembers(import_module(f"coplanar.laws.{module.name}"), inspect.isfunction)
    if law.__module__ == f"coplanar.laws.{module.name}"
]
DOMAIN = {
    law: inside
    for module in pkgutil.iter_modules(tests.laws.__path__)
    if module.name.startswith("domains_")
    for law, inside in import_module(f"tests.laws.{module.name}").DOMAIN.items()
}
SPECIAL = (np.nan, np.inf, -np.inf)

# All tests of a law run in one process, so that its loops are compiled once.
every_law = pytest.mark.parametrize(
    "law",
    [
        pytest.param(law, id=name, marks=pytest.mark.xdist_group(name))
        for law, name in ((law, f"{law.__module__.rpartition('.')[2]}.{law.__name__}") for law in LAWS)
    ],
)


def columns(law, seed=0, rows=300):
    """Arguments near one, with zeros, tiny and large ones among them, where the law is defined."""
    rng = np.random.default_rng(seed)
    spread = 10.0 ** rng.integers(-12, 1, size=(len(inspect.signature(law).parameters), rows))
    table = rng.uniform(-3.0, 3.0, size=spread.shape) * np.where(rng.random(spread.shape) < 0.3, spread, 1.0)
    table[rng.random(spread.shape) < 0.05] = 0.0
    inside = DOMAIN.get(law, tuple)
    return tuple(np.asarray(column, dtype=float) for column in inside(list(table)))


def agree(answers, expected, room):
    """Row by row: within room of a size of at least 1, or both NaN, or the same infinity."""
    rows = np.ones(np.shape(expected[0]), dtype=bool)
    for one, other in zip(answers, expected, strict=True):
        with np.errstate(invalid="ignore"):
            near = np.abs(one - other) <= room * np.maximum(1.0, np.abs(other))
        rows &= near | (one == other) | (np.isnan(one) & np.isnan(other))
    return rows


def where_not(rows, *tables):
    return [[np.asarray(column)[~rows][:3].tolist() for column in table] for table in tables]


@every_law
@pytest.mark.parametrize("engine", ARRAY_ENGINES)
def test_engines_agree(law, engine):
    args = columns(law)
    expected, answers = on_floats(law, *args), on_engine(engine, law, *args)
    # Sums of products of a few roundings each; where a law divides, both sides carry the same condition.
    rows = agree(answers, expected, 1e-12)
    assert rows.all(), where_not(rows, args, answers, expected)


@every_law
def test_floats_in_floats_out(law):
    answer = evaluator(law)(*(float(column[0]) for column in columns(law, rows=1)))
    assert {float} == set(map(type, answer if isinstance(answer, tuple) else (answer,)))


@every_law
def test_a_law_has_a_docstring_and_plain_arguments(law):
    first = (law.__doc__ or "").partition("\n")[0]
    assert 0 < len(first) <= 120
    assert all(p.default is p.empty and p.annotation is p.empty for p in inspect.signature(law).parameters.values())


@every_law
@pytest.mark.parametrize("engine", ["text", pytest.param("compiled", marks=NEEDS_NUMBA)])
def test_a_bad_row_stays_alone_and_is_as_in_math(law, engine):
    args = columns(law, rows=120)
    clean = on_engine(engine, law, *args)
    rng = np.random.default_rng(1)
    bad = np.arange(0, 120, 5)
    spoilt = [column.copy() for column in args]
    for row in bad:
        spoilt[rng.integers(len(args))][row] = SPECIAL[rng.integers(len(SPECIAL))]
    answers = on_engine(engine, law, *spoilt)
    good = np.setdiff1d(np.arange(120), bad)
    rows = agree([a[good] for a in answers], [c[good] for c in clean], 1e-13)
    assert rows.all(), where_not(rows, [c[good] for c in spoilt])
    expected = on_floats(law, *(column[bad] for column in spoilt))
    rows = agree([a[bad] for a in answers], expected, 1e-12)
    assert rows.all(), where_not(rows, [c[bad] for c in spoilt], [a[bad] for a in answers], expected)


def float32_fits(law, engine):
    single = tuple(column.astype(np.float32) for column in columns(law, rows=50))
    answers = on_engine(engine, law, *single)
    assert {np.dtype(np.float32)} == {a.dtype for a in answers}
    double = on_engine("text", law, *(column.astype(np.float64) for column in single))
    # float32 has 7 digits; a law may lose a few where it subtracts, and a jump may fall on the other side.
    rows = agree(answers, double, 1e-3)
    assert rows.mean() >= 0.9, where_not(rows, single, answers, double)


@every_law
def test_float32_in_float32_out(law):
    float32_fits(law, "text")


@NEEDS_NUMBA
@pytest.mark.parametrize("law", [se2.act, se2.log, se2.step, se2.wrap, motion.segment], ids=lambda law: law.__name__)
def test_float32_in_float32_out_of_the_compiled_loop(law):
    float32_fits(law, "compiled")
