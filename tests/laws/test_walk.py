"""A pose carried along a row of steps is the law called step by step, by every evaluator."""

from __future__ import annotations

import math

import numpy as np
import pytest

from coplanar import Odometry
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
TILE = 1056  # steps that the compiled loop takes at once, of one row or of a few
EDGES = [((), TILE - 1), ((), TILE), ((), TILE + 1), ((2,), 2 * TILE + 9), ((TILE + 1,), 1), ((70,), 31), ((67,), 32)]
SHARED = [
    ((2100,), 100),
    ((), 210_000),
    ((), 8 * TILE * 32),
    ((), 8 * TILE * 32 + 1),
    ((3,), 8 * TILE * 9 + 1),
    ((7,), 30_011),
]


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


@NEEDS_NUMBA
@pytest.mark.parametrize(("lead", "steps"), EDGES, ids=str)
def test_it_is_the_loop_at_the_edges_of_tiles(lead, steps):
    test_it_is_the_loop("compiled", lead, steps)


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


def on_threads(count, begin, inputs, keep="all"):
    import numba

    if count > numba.config.NUMBA_NUM_THREADS:
        pytest.skip("one processor")
    before = numba.get_num_threads()
    numba.set_num_threads(count)
    try:
        return on("compiled", se2.step, begin, inputs, keep)
    finally:
        numba.set_num_threads(before)


@NEEDS_NUMBA
@pytest.mark.parametrize(("lead", "steps"), SHARED, ids=str)
def test_threads_change_no_bit(lead, steps):
    rng = np.random.default_rng(3)
    begin = list(rng.uniform(-1.0, 1.0, (3, *lead)))
    inputs = [rng.uniform(-1.0, 1.0, (*lead, steps)), 0.1, rng.uniform(-1.0, 1.0, (*lead, steps))]
    text = on("text", se2.step, begin, inputs, "all")
    for keep in ("all", "end"):
        one, two = (on_threads(count, begin, inputs, keep) for count in (1, 2))
        assert all(np.array_equal(a, b) for a, b in zip(one, two, strict=True))
        for answer, column in zip(one, text, strict=True):
            right = column if keep == "all" else column[..., -1]
            assert np.max(np.abs(answer - right)) <= steps * EPS * np.max(np.abs(column))


@NEEDS_NUMBA
@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e7])
def test_threads_change_no_bit_of_what_the_fast_law_leaves(bad):
    turn = np.full(300_000, 0.1)
    turn[[150_000, 250_000]] = bad, -bad
    inputs = [np.linspace(0.0, 1.0, turn.size), 0.0, turn]
    one, two = (on_threads(count, [0.0, 0.0, 0.0], inputs) for count in (1, 2))
    with np.errstate(invalid="ignore"):
        text = on("text", se2.step, [0.0, 0.0, 0.0], inputs, "all")
    for a, b, right in zip(one, two, text, strict=True):
        assert np.array_equal(a, b, equal_nan=True)
        assert np.array_equal(np.isfinite(a), np.isfinite(right))
    assert np.isfinite(one[0][150_000])


@NEEDS_NUMBA
def test_a_long_log_rounds_little():
    """Turns whose sums are exact, so that headings are; places against sums that round once."""
    rng = np.random.default_rng(4)
    way, turn = rng.uniform(-0.005, 0.02, 1_000_000), rng.integers(-(2**20), 2**20 + 9000, 1_000_000) * 2.0**-26
    heading = np.concatenate(([0.0], np.cumsum(turn)))
    ways = evaluator(se2.step).on_text(0.0, 0.0, heading[:-1], way, 0.0, turn)
    *places, turned = on("compiled", se2.step, [0.0, 0.0, 0.0], [way, 0.0, turn], "all")
    assert np.array_equal(turned, heading)
    for place, column in zip(places, ways, strict=False):
        error = max(abs(place[k] - math.fsum(column[:k])) for k in range(0, turn.size + 1, 20_000))
        assert error <= 8 * EPS * np.max(np.abs(place))


@NEEDS_NUMBA
def test_velocities_of_many_robots_are_those_of_each():
    rng = np.random.default_rng(5)
    v, omega, t = rng.uniform(-1.0, 1.0, (2, 5, 900, 101)), rng.uniform(-1.0, 1.0, 101), np.cumsum(rng.random(101))
    increments = Odometry.from_velocities(v, omega, t).increments
    assert np.array_equal(increments.dx, v[..., :-1] * np.diff(t))
    assert np.array_equal(increments.dtheta, omega[:-1] * np.diff(t))


@ALL
def test_what_comes_out_is_new(engine):
    begin, inputs = [np.ones(2), np.ones(2), np.zeros(2)], [np.ones((2, 3)), np.zeros((2, 3)), np.zeros((2, 3))]
    for keep in ("all", "end"):
        answers = on(engine, se2.step, begin, inputs, keep)
        assert not any(np.may_share_memory(a, b) for a in answers for b in (*begin, *inputs))


def test_a_single_row_ends_in_floats():
    assert [type(end) for end in Walk(se2.step)([0.0, 0.0, 0.0], [np.ones(3), 0.0, 0.0], keep="end")] == [float] * 3
    assert [type(e) for e in Walk(se2.step)([0.0, 0.0, 0.0], [np.ones(30_000), 0.0, 0.0], keep="end")] == [float] * 3
