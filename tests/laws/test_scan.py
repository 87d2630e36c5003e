"""A law carried from step to step is the law called step by step, by every evaluator."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar.engine import Scan, evaluator, log, sin, sincos, where
from tests.engines import BATCH_SHAPES, NEEDS_JAX, NEEDS_NUMBA

EPS = np.finfo(float).eps
WIDTHS = [1, 5, 31, 32, 33, 255, 256, 257, 263, 265, 512, 513, 530]  # about the blocks and the vectors within them


def drive(x, y, theta, v, omega, dt):
    s, c = sincos(theta + 0.5 * omega * dt)
    return x + v * dt * c, y + v * dt * s, theta + omega * dt


def bounce(height, side, push, scale):
    """Hangs on the sign of a sine whose angle grows beyond what the fast sine holds for."""
    return height + push * scale, where(sin(height) > 0.0, 1.0, -1.0) + 0.0 * side


def worth(x, gain):
    return (log(x) + gain,)


def step_by_step(law, initial, inputs, parameters, keep):
    """The definition: a Python loop over the steps."""
    shapes = [np.shape(a) for a in (*initial, *parameters)] + [np.shape(t)[1:] for t in inputs]
    rows = np.broadcast_shapes(*shapes)
    now = [np.broadcast_to(s, rows) for s in initial]
    history = [now]
    for k in range(len(inputs[0])):
        now = evaluator(law).on_text(*now, *(t[k] for t in inputs), *parameters)
        history.append(now)
    return [np.array(column) for column in zip(*history, strict=True)] if keep == "all" else list(now)


def on(engine, law, initial, inputs, parameters, keep):
    if engine == "jax":
        import jax

        with jax.enable_x64(True):
            answer = Scan(law)([jax.numpy.asarray(s) for s in initial], inputs, parameters, keep=keep)
        return [np.asarray(a) for a in answer]
    if engine == "call":
        return Scan(law)(initial, inputs, parameters, keep=keep)
    arrays = [[np.asarray(a, dtype=float) for a in group] for group in (initial, inputs, parameters)]
    shapes = [a.shape for a in (*arrays[0], *arrays[2])] + [t.shape[1:] for t in arrays[1]]
    return getattr(Scan(law), f"on_{engine}")(*arrays, np.broadcast_shapes(*shapes), keep)


ALL = pytest.mark.parametrize(
    "engine", ["call", "text", pytest.param("compiled", marks=NEEDS_NUMBA), pytest.param("jax", marks=NEEDS_JAX)]
)


@ALL
@pytest.mark.parametrize("keep", ["all", "end"])
@pytest.mark.parametrize("shape", [*BATCH_SHAPES, (700,)])
@pytest.mark.parametrize("own", [False, True], ids=["shared", "own"])
def test_it_is_the_loop(engine, keep, shape, own):
    rng = np.random.default_rng(0)
    initial = list(rng.uniform(-1.0, 1.0, (3, *shape)))
    inputs = [rng.uniform(-1.0, 1.0, (30, *(shape if own else ()))), rng.uniform(-1.0, 1.0, 30)]
    answers = on(engine, drive, initial, inputs, [0.1], keep)
    for answer, right in zip(answers, step_by_step(drive, initial, inputs, [0.1], keep), strict=True):
        assert np.shape(answer) == np.shape(right)
        assert np.max(np.abs(answer - right)) <= 30 * EPS


@ALL
def test_the_state_may_broadcast_to_the_rows(engine):
    inputs, parameters = [np.linspace(0.0, 1.0, 20), np.linspace(-1.0, 1.0, 20)], [np.array([0.1, 0.2, 0.3])]
    answers = on(engine, drive, [0.0, np.zeros(1), 0.5], inputs, parameters, "all")
    for answer, right in zip(answers, step_by_step(drive, [0.0, 0.0, 0.5], inputs, parameters, "all"), strict=True):
        assert answer.shape == (21, 3)
        assert np.max(np.abs(answer - right)) <= 30 * EPS


@ALL
def test_a_large_angle_is_not_hidden_by_a_comparison(engine):
    initial = [np.array([0.3, 1.1, 2e5]), np.zeros(3)]
    answers = on(engine, bounce, initial, [np.full(60, 977.0)], [40.0], "all")
    right = step_by_step(bounce, initial, [np.full(60, 977.0)], [40.0], "all")
    assert np.array_equal(answers[1], right[1])


@ALL
def test_a_row_that_ends_in_nan_or_infinity_is_alone(engine):
    initial = [np.array([0.5, 3.0, 0.0, -1.0, np.nan])]
    answers = on(engine, worth, initial, [np.array([0.1, 2.0, 0.3])], [], "all")
    right = step_by_step(worth, initial, [np.array([0.1, 2.0, 0.3])], [], "all")
    assert np.allclose(answers[0], right[0], rtol=1e-13, atol=0.0, equal_nan=True)


def test_a_single_row_of_floats_may_leave_the_domain():
    answers = Scan(worth)([0.5], [np.zeros(4)])
    assert np.isnan(answers[0][-1])


@ALL
def test_what_comes_out_is_new(engine):
    initial, inputs = [np.ones(3), np.ones(3), np.ones(3)], [np.ones(2), np.ones(2)]
    for keep in ("all", "end"):
        answers = on(engine, drive, initial, inputs, [0.5], keep)
        assert not any(np.may_share_memory(a, b) for a in answers for b in (*initial, *inputs))
    assert all(np.array_equal(a, np.ones(a.shape)) for a in (*initial, *inputs))


@ALL
@pytest.mark.parametrize("shape", [(), (4,)])
def test_no_steps_leave_the_state(engine, shape):
    initial = [np.full(shape, float(k)) for k in range(3)]
    inputs = [np.empty(0), np.empty(0)]
    every, end = (on(engine, drive, initial, inputs, [0.5], keep) for keep in ("all", "end"))
    for k in range(3):
        assert np.shape(every[k]) == (1, *shape)
        assert np.shape(end[k]) == shape
        assert np.all(end[k] == float(k))
        assert not np.may_share_memory(np.asarray(end[k]), initial[k])


@ALL
@pytest.mark.parametrize("shape", [(), (3,), (600,)])
@pytest.mark.parametrize("keep", [(), (0,), (2,), (0, 2), (0, 1, 2)], ids=str)
def test_what_is_kept_is_what_all_would_keep(engine, shape, keep):
    rng = np.random.default_rng(4)
    initial, inputs = list(rng.uniform(-1.0, 1.0, (3, *shape))), [rng.uniform(-1.0, 1.0, 9) for _ in range(2)]
    whole = on(engine, drive, initial, inputs, [0.1], "all")
    some = on(engine, drive, initial, inputs, [0.1], keep)
    for k, (column, part) in enumerate(zip(whole, some, strict=True)):
        assert np.array_equal(part, column if k in keep else column[-1])


def drives(width, steps=11, *, own=False):
    """So many robots of the same draws: initial states, inputs, one of them a robot's own if asked for, parameters."""
    rng = np.random.default_rng(6)
    initial = list(rng.uniform(-1.0, 1.0, (3, width)))
    return initial, [rng.uniform(-1.0, 1.0, (steps, width) if own else steps), rng.uniform(-1.0, 1.0, steps)], [0.1]


@NEEDS_NUMBA
@pytest.mark.parametrize("own", [False, True], ids=["shared", "own"])
@pytest.mark.parametrize("width", WIDTHS)
def test_every_width_is_the_loop_of_each_row(width, own):
    initial, inputs, _ = drives(width, own=own)
    gains = [np.linspace(0.1, 0.2, width)]
    whole = on("compiled", drive, initial, inputs, gains, "all")
    for answer, right in zip(whole, step_by_step(drive, initial, inputs, gains, "all"), strict=True):
        assert np.max(np.abs(answer - right)) <= 30 * EPS
    for answer, column in zip(on("compiled", drive, initial, inputs, gains, "end"), whole, strict=True):
        assert np.array_equal(answer, column[-1])
    for k in {0, width // 2, width - 1}:
        one, steps = [s[k] for s in initial], [t[:, k] if t.ndim > 1 else t for t in inputs]
        floats = on("text", drive, one, steps, [gains[0][k]], "end")
        for answer, right in zip(whole, floats, strict=True):
            assert abs(answer[-1, k] - right) <= 30 * EPS


@NEEDS_NUMBA
@pytest.mark.parametrize("own", [False, True], ids=["shared", "own"])
@pytest.mark.parametrize("width", [528, 530, 700, 1001])
def test_threads_change_no_bit(width, own, monkeypatch):
    from coplanar.engine.compiled import kernels

    given = drives(width, own=own)
    monkeypatch.setattr(kernels, "PARALLEL_FROM", 1 << 60)
    alone = on("compiled", drive, *given, "all")
    monkeypatch.setattr(kernels, "PARALLEL_FROM", 0)
    for a, b in zip(alone, on("compiled", drive, *given, "all"), strict=True):
        assert np.array_equal(a, b)


@NEEDS_NUMBA
@pytest.mark.parametrize("keep", ["all", (1,)], ids=str)
@pytest.mark.parametrize("width", WIDTHS)
def test_results_beyond_the_caches_are_the_same(width, keep, monkeypatch):
    from coplanar.engine.compiled import kernels

    given = drives(width)
    near = on("compiled", drive, *given, keep)
    monkeypatch.setattr(kernels, "CACHES", 0)
    for a, b in zip(near, on("compiled", drive, *given, keep), strict=True):
        assert np.array_equal(a, b)


@NEEDS_NUMBA
@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("odd", [3e6, np.nan, np.inf], ids=str)
def test_one_odd_row_changes_no_other(width, odd):
    initial, inputs, parameters = drives(width)
    usual = on("compiled", drive, initial, inputs, parameters, "all")
    for k in {0, width // 2, width - 1}:
        angles = initial[2].copy()
        angles[k] = odd
        answers = on("compiled", drive, [*initial[:2], angles], inputs, parameters, "all")
        right = step_by_step(drive, [*initial[:2], angles], inputs, parameters, "all")
        others = np.arange(width) != k
        for answer, column, whole in zip(answers, right, usual, strict=True):
            assert np.array_equal(answer[:, others], whole[:, others])
            assert np.allclose(answer[:, k], column[:, k], rtol=1e-15, atol=30 * EPS, equal_nan=True)
