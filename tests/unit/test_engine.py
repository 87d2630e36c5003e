"""The evaluator: what goes in, what comes out, and what it leaves alone."""

from __future__ import annotations

import threading

import numpy as np
import pytest

from coplanar.engine import components, cos, evaluator, is_foreign, namespace_of, sin, stack
from coplanar.errors import InvalidShape
from coplanar.laws import motion, se2
from tests.engines import ARRAY_ENGINES, NEEDS_JAX, NEEDS_NUMBA, on_engine

act = evaluator(se2.act)


def same_and_constant(x, y):
    """Returns an argument as it is, twice, and a constant."""
    return x, x, 0.5


def ring(radius, angle):
    return radius * cos(angle), radius * sin(angle)


def at(*args):
    return [np.asarray(a).tolist() for a in act(*args)]


ONE = [3.5, 5.0]  # act(1, 2, 0, 2.5, 3)


@pytest.mark.parametrize("angle", [0, False, 0.0, np.float64(0.0), np.float32(0.0), np.int64(0), np.zeros(())])
def test_any_single_number_gives_floats(angle):
    answer = act(1, 2.0, angle, np.float64(2.5), 3)
    assert list(answer) == ONE
    assert [type(a) for a in answer] == [float, float]


def test_a_wholly_integer_law_gives_floats():
    assert [type(v) for v in (evaluator(se2.coordinate)(1, 2, 3, 4), *evaluator(se2.during)(1, 2, 3, 4))] == [float] * 4


def test_what_math_refuses_is_infinite_or_nan():
    assert evaluator(se2.over)(1.0, -1.0, 0.0, 0.0)[:2] == (np.inf, -np.inf)
    assert np.isnan(evaluator(se2.over)(1.0, -1.0, 0.0, 0.0)[2])
    assert np.isnan(evaluator(se2.rotate)(np.inf, 1.0, 0.0)).all()
    assert np.isnan(evaluator(se2.wrap)(np.inf))


@pytest.mark.parametrize("engine", ARRAY_ENGINES)
@pytest.mark.parametrize(
    "shapes",
    [
        ((), (), (), (), (5,)),
        ((1,), (), (), (), ()),
        ((1,), (1, 1), (), (), ()),
        ((4, 1), (3,), (), (1,), (4, 3)),
        ((2, 1, 3), (5, 1), (1, 1, 1), (), (3,)),
        ((0,), (1,), (), (), (0,)),
        ((0, 3), (3,), (), (), ()),
    ],
    ids=str,
)
def test_every_shape_broadcasts(engine, shapes):
    rng = np.random.default_rng(0)
    args = [rng.uniform(-1.0, 1.0, shape) for shape in shapes]
    whole = np.broadcast_shapes(*shapes)
    expected = se2.act(*(np.broadcast_to(a, whole) for a in args))
    for answer, right in zip(on_engine(engine, se2.act, *args), expected, strict=True):
        assert answer.shape == whole
        assert np.allclose(answer, right, rtol=0.0, atol=1e-15)


@NEEDS_NUMBA
def test_a_batch_is_the_same_whichever_way_it_lies_in_memory():
    rng = np.random.default_rng(1)
    args = [rng.uniform(-3.0, 3.0, (300, 400)) for _ in range(5)]
    straight = act.on_compiled(*args)
    askew = [np.asfortranarray(args[0]), args[1][::-1][::-1], args[2].T.copy().T, args[3].copy(), args[4]]
    askew[3] = np.repeat(askew[3], 2, axis=1)[:, ::2]
    swapped = [a.astype(a.dtype.newbyteorder()) for a in args]
    packed = np.zeros((300, 400), dtype=[("pad", "i1"), ("x", "f8")])
    packed["x"] = args[0]
    frozen = [a.copy() for a in args]
    for a in frozen:
        a.flags.writeable = False
    for other in (askew, swapped, frozen, [packed["x"], *args[1:]]):
        for one, two in zip(act.on_compiled(*other), straight, strict=True):
            assert np.array_equal(one, two)
    column, row = rng.uniform(size=(300, 1)), rng.uniform(size=400)
    for one, two in zip(
        act.on_compiled(column, row, 0.5, *args[3:]), act.on_text(column, row, 0.5, *args[3:]), strict=True
    ):
        assert np.allclose(one, two, rtol=0.0, atol=1e-14)


@NEEDS_NUMBA
@pytest.mark.parametrize("rows", [1, 2, 4095, 4096, 4097, 70_001, 210_000])
def test_no_row_is_lost_between_blocks_and_threads(rows):
    angle = np.linspace(-9.0, 9.0, rows)
    for column in (angle, np.repeat(angle, 2)[::2]):
        for one, two in zip(evaluator(ring).on_compiled(2.0, column), evaluator(ring).on_text(2.0, angle), strict=True):
            assert np.allclose(one, two, rtol=0.0, atol=1e-14)


@pytest.mark.parametrize("engine", ARRAY_ENGINES[:2])
def test_results_are_new_arrays_even_where_a_law_returns_its_argument(engine):
    x, y = np.arange(3.0), np.zeros(3)
    for answers in (on_engine(engine, same_and_constant, x, y), on_engine(engine, se2.exp, x, y, y)):
        for k, answer in enumerate(answers):
            assert answer.flags.writeable
            assert not any(np.may_share_memory(answer, other) for other in (x, y, *answers[:k]))
    assert np.array_equal(on_engine(engine, same_and_constant, x, 0.0)[2], [0.5] * 3)


@NEEDS_NUMBA
def test_results_go_where_they_are_told():
    rng = np.random.default_rng(2)
    args = [rng.uniform(-3.0, 3.0, (40, 30)) for _ in range(5)]
    args[2][3, 4] = 1e9  # a row that is evaluated twice
    right = act.on_text(*args)
    room = np.empty((2, 40, 60))
    for out in (
        (np.empty((40, 30)), np.empty((40, 30))),
        (np.empty((30, 40)).T, np.empty((30, 40)).T),
        (room[0, :, ::2], room[1, :, ::2]),
        (args[2].copy(), args[0].copy()),
    ):
        answer = act.on_compiled(*args, out=out)
        assert answer is out
        for one, two in zip(out, right, strict=True):
            assert np.allclose(one, two, rtol=0.0, atol=1e-14)


@NEEDS_NUMBA
def test_results_may_overwrite_the_arguments():
    rng = np.random.default_rng(3)
    args = [rng.uniform(-3.0, 3.0, 5000) for _ in range(5)]
    args[2][::7] = 1e9  # rows that are evaluated twice, the second time from what the first left of the arguments
    right = act.on_text(*args)
    act.on_compiled(*args, out=(args[2], args[3]))
    assert np.allclose(args[2], right[0], rtol=0.0, atol=1e-14)
    assert np.allclose(args[3], right[1], rtol=0.0, atol=1e-14)


@NEEDS_NUMBA
@pytest.mark.parametrize(
    "out",
    [
        (np.empty(3),),
        (np.empty(3), np.empty(4)),
        (np.empty(3), np.empty((3, 1))),
        (np.empty(3), np.empty(3, np.float32)),
        (np.empty(3), np.broadcast_to(0.0, 3)),
    ],
    ids=["too few", "wrong length", "wrong shape", "wrong type", "read-only"],
)
def test_an_unfit_out_is_refused(out):
    with pytest.raises(InvalidShape, match=r"out with .*: needed 2 writeable arrays of shape \(3,\), type float64"):
        act.on_compiled(1.0, 2.0, np.zeros(3), 0.0, 0.0, out=out)


@pytest.mark.parametrize("engine", ARRAY_ENGINES)
def test_shapes_that_do_not_broadcast_are_named(engine):
    with pytest.raises(InvalidShape, match=r"x, y, theta, px, py with shapes \(3,\), \(4,\), \(\)"):
        on_engine(engine, se2.act, np.zeros(3), np.zeros(4), np.zeros(()), np.zeros(()), np.zeros(()))
    with pytest.raises(InvalidShape, match="broadcast"):
        act(np.zeros(3), np.zeros(4), 0.0, 0.0, 0.0)


def test_float32_stays_unless_a_wider_array_joins():
    single, double = np.ones(4, np.float32), np.ones(4)
    assert {a.dtype for a in act(single, 0.1, 2, single, np.float64(0.5))} == {np.dtype(np.float32)}
    assert {a.dtype for a in act(single, 0.1, 2, double, 0.5)} == {np.dtype(np.float64)}
    assert {a.dtype for a in act(np.arange(4), 0.1, 2, single, 0.5)} == {np.dtype(np.float64)}


def test_a_law_has_one_evaluator():
    assert evaluator(se2.act) is act
    assert act.__name__ == "act"
    assert act.__doc__ == se2.act.__doc__


@NEEDS_NUMBA
def test_several_threads_at_once():
    angle = np.linspace(-3.0, 3.0, 250_000)  # enough for compiled threads
    right, wrong = evaluator(ring).on_text(2.0, angle), []

    def work():
        for _ in range(4):
            answers = evaluator(ring)(2.0, angle)
            if not all(np.allclose(a, r, rtol=0.0, atol=1e-14) for a, r in zip(answers, right, strict=True)):
                wrong.append(threading.get_ident())

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


@NEEDS_NUMBA
def test_threads_that_compile_the_same_law_at_once():
    def fresh(x, y):
        return x * y + 0.125, x - y

    x, answers = np.linspace(0.0, 1.0, 500), []
    threads = [threading.Thread(target=lambda: answers.append(evaluator(fresh).on_compiled(x, 2.0))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 4
    assert all(np.array_equal(a[0], x * 2.0 + 0.125) for a in answers)


def test_parts_of_points():
    assert components([1, 2]) == (1.0, 2.0)
    assert [type(c) for c in components((1, 2))] == [float, float]
    assert [c.tolist() for c in components([[1, 2], [3, 4]])] == [[1.0, 3.0], [2.0, 4.0]]
    assert stack((1.0, 2.0)).tolist() == [1.0, 2.0]
    assert stack((np.zeros((2, 1)), np.ones(3), 2.0)).shape == (2, 3, 3)
    assert stack((np.zeros((2, 1)), np.ones(3), 2.0), 0).shape == (3, 2, 3)


def test_numbers_and_numpy_arrays_are_not_foreign():
    assert not any(map(is_foreign, (1, 1.0, True, np.float64(1.0), np.zeros(2), [1.0], (1.0,), "1", None)))
    assert namespace_of(np.zeros(2)).__name__ == "numpy"


@NEEDS_JAX
def test_numbers_take_the_type_of_foreign_arrays():
    import jax

    jnp = jax.numpy
    with jax.enable_x64(True):
        single = jnp.ones(3, jnp.float32)
        assert {a.dtype for a in act(single, 0.1, 2, single, np.float64(0.5))} == {jnp.dtype("float32")}
        assert {a.dtype for a in act(single, 0.1, 2, jnp.ones(3), 0.5)} == {jnp.dtype("float64")}
        assert {a.dtype for a in act(jnp.arange(3), 0.1, 2, 0.5, 0.5)} == {jnp.dtype("float64")}
        assert {a.dtype for a in act(single, np.ones(3), 2, 0.5, 0.5)} == {jnp.dtype("float64")}
        assert stack((single, 0.1)).dtype == jnp.float32
        # a number must not be rounded to float32 on its way to arrays of float64
        assert float(evaluator(se2.coordinate)(jnp.ones(1), 0.0, 0.1, 0.0)[0]) == 0.1


@NEEDS_JAX
def test_foreign_results_have_the_common_shape():
    import jax

    jnp = jax.numpy
    assert [a.shape for a in evaluator(se2.exp)(jnp.ones((2, 1)), jnp.ones(3), 0.5)] == [(2, 3)] * 3
    assert [a.shape for a in evaluator(same_and_constant)(jnp.ones(3), 1.0)] == [(3,)] * 3


class Torchlike:
    """An array as PyTorch's are: no ``__array_namespace__``, known by the name of its module."""

    __module__ = "torch._tensor"


def test_pytorch_is_known_by_its_name():
    assert is_foreign(Torchlike())


@NEEDS_NUMBA
@pytest.mark.parametrize(
    "shapes",
    [
        ((700, 1), (600,), (), (700, 600), (1, 600)),
        ((2, 1, 3), (300_000, 1), (), (2, 300_000, 3), (1,)),
        ((300_000, 1), (3,), (3,), (300_000, 1), (300_000, 3)),
        ((5, 1), (270_000,), (), (5, 1), (270_000,)),
    ],
    ids=str,
)
def test_large_batches_that_broadcast(shapes):
    rng = np.random.default_rng(6)
    args = [rng.uniform(-3.0, 3.0, shape) for shape in shapes]
    for one, two in zip(act.on_compiled(*args), act.on_text(*args), strict=True):
        assert np.allclose(one, two, rtol=0.0, atol=1e-14)


@NEEDS_NUMBA
def test_one_number_for_all_rows_is_read_as_one():
    same = np.broadcast_to(np.float64(0.5), (300, 40))
    for one, two in zip(
        act.on_compiled(same, same, same, 0.1, 0.2), act.on_text(same, same, same, 0.1, 0.2), strict=True
    ):
        assert one.shape == (300, 40)
        assert np.allclose(one, two, rtol=0.0, atol=1e-15)


@pytest.mark.parametrize("rows", [5, 30_000, 500_000])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_what_is_written_tells_whether_it_is_finite(rows, value):
    law, column, out = evaluator(motion.covered), np.full(rows, 2.0), np.empty(rows)
    assert law.into((out,), column, 3.0)
    assert law.into((out,), column, 3.0, finite=True)
    assert np.all(out == 6.0)
    column[rows // 2] = value
    assert law.into((out,), column, 3.0) is (not np.isnan(value))
    assert not law.into((out,), column, 3.0, finite=True)
    assert np.array_equal(out, 3.0 * column, equal_nan=True)
