"""A pose carried along a row of steps is the law called step by step, by every evaluator."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar.engine import Walk, evaluator
from coplanar.laws import motion, se2
from tests.engines import NEEDS_JAX, NEEDS_NUMBA

EPS = np.finfo(float).eps


def step_by_step(law, begin, inputs, lead):
    """The definition: a Python loop over the steps, rows (..., steps + 1)."""
    shape = np.broadcast_shapes(*(np.shape(a) for a in inputs), (*lead, 1))
    tables = [np.broadcast_to(a, shape) for a in inputs]
    now = tuple(np.broadcast_to(b, shape[:-1]).astype(float) for b in begin)
    history = [now]
    for k in range(shape[-1]):
        now = evaluator(law).on_text(*now, *(t[..., k] for t in tables))
        history.append(now)
    return [np.stack(column, axis=-1) for column in zip(*history, strict=True)]


def on(engine, law, begin, inputs, keep):
    walk = Walk(law)
    if engine == "jax":
        import jax

        with jax.enable_x64(True):
            answer = walk([jax.numpy.asarray(b) for b in begin], inputs, keep=keep)
            return [np.asarray(a) for a in answer]
    if engine == "call":
        return walk(begin, inputs, keep=keep)
    if engine == "text":
        return walk.on_text(begin, inputs, keep)
    first, tables = ([np.asarray(a, float) for a in group] for group in (begin, inputs))
    shape = np.broadcast_shapes(*(a.shape for a in tables), *((*a.shape, 1) for a in first))
    return walk.on_compiled(first, tables, shape, keep)


ALL = pytest.mark.parametrize(
    "engine", ["call", "text", pytest.param("compiled", marks=NEEDS_NUMBA), pytest.param("jax", marks=NEEDS_JAX)]
)
SIZES = [((), 1), ((), 7), ((), 1100), ((1,), 255), ((3,), 1), ((50,), 10), ((7,), 100), ((2, 1, 3), 257), ((40,), 33)]


@ALL
@pytest.mark.parametrize(("lead", "steps"), SIZES, ids=str)
def test_it_is_the_loop(engine, lead, steps):
    rng = np.random.default_rng(0)
    begin = list(rng.uniform(-1.0, 1.0, (3, *lead)))
    way, turn = rng.uniform(-1.0, 1.0, (*lead, steps)), rng.uniform(-1.0, 1.0, steps)
    for inputs in ([way, 0.0, turn], [way[..., :1], turn, turn], [0.3, turn, way]):
        right = step_by_step(se2.step, begin, inputs, lead)
        whole = on(engine, se2.step, begin, inputs, "all")
        for answer, column in zip(whole, right, strict=True):
            lever = max(1.0, np.max(np.abs(column)))  # what the rounding of a heading swings
            assert np.max(np.abs(answer - column)) <= 4 * steps * EPS * lever
        for answer, column in zip(on(engine, se2.step, begin, inputs, "end"), whole, strict=True):
            assert np.array_equal(np.broadcast_to(answer, lead), np.broadcast_to(column[..., -1], lead))


@ALL
def test_another_law(engine):
    rng = np.random.default_rng(1)
    v, omega = rng.uniform(-1.0, 1.0, (2, 4, 30))
    begin, inputs = [0.0, 0.5, np.linspace(0.0, 3.0, 4)], [v, omega, 0.1]
    for answer, right in zip(
        on(engine, motion.arc, begin, inputs, "all"), step_by_step(motion.arc, begin, inputs, (4,)), strict=True
    ):
        assert np.max(np.abs(answer - right)) <= 120 * EPS


@ALL
def test_steps_that_lie_as_they_like(engine):
    rng = np.random.default_rng(2)
    way, turn = rng.uniform(-1.0, 1.0, (6, 90)), rng.uniform(-1.0, 1.0, (90, 6)).T
    inputs = [np.repeat(way, 2, axis=1)[:, ::2], np.broadcast_to(0.1, (6, 90)), turn]
    right = step_by_step(se2.step, [0.0, 0.0, 0.0], inputs, (6,))
    for answer, column in zip(on(engine, se2.step, [0.0, 0.0, 0.0], inputs, "all"), right, strict=True):
        assert np.max(np.abs(answer - column)) <= 360 * EPS


@NEEDS_NUMBA
def test_headings_that_wind_beyond_the_fast_sine():
    turn = np.full((3, 400), 0.1)
    turn[1, 200] = 3e5
    turn[2, 399] = -1e7
    begin, inputs = [0.0, 0.0, np.array([0.0, 0.0, 5e6])], [np.full((3, 400), 0.01), 0.0, turn]
    heading_error = 400 * 1e7 * EPS  # a rounding of the largest heading at every step
    right = step_by_step(se2.step, begin, inputs, (3,))
    for answer, column in zip(on("compiled", se2.step, begin, inputs, "all"), right, strict=True):
        assert np.allclose(answer, column, rtol=0.0, atol=0.01 * 400 * heading_error)


@NEEDS_NUMBA
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_what_is_not_finite_stays_in_its_row(bad):
    turn = np.full((5, 40), 0.1)
    turn[3, 20] = bad
    x, _, heading = on("compiled", se2.step, [0.0, 0.0, 0.0], [np.ones((5, 40)), 0.0, turn], "all")
    assert np.isfinite(x[3, :21]).all()
    assert not np.isfinite(heading[3, 21:]).any()
    assert np.isfinite(x[[0, 1, 2, 4]]).all()


@ALL
def test_what_comes_out_is_new(engine):
    begin, inputs = [np.ones(2), np.ones(2), np.zeros(2)], [np.ones((2, 3)), np.zeros((2, 3)), np.zeros((2, 3))]
    for keep in ("all", "end"):
        answers = on(engine, se2.step, begin, inputs, keep)
        assert not any(np.may_share_memory(a, b) for a in answers for b in (*begin, *inputs))


def test_a_single_row_ends_in_floats():
    assert [type(end) for end in Walk(se2.step)([0.0, 0.0, 0.0], [np.ones(3), 0.0, 0.0], keep="end")] == [float] * 3
    assert [type(e) for e in Walk(se2.step)([0.0, 0.0, 0.0], [np.ones(30_000), 0.0, 0.0], keep="end")] == [float] * 3
