"""The boundary: what is let in, in which form, and what an error says of the rest."""

from __future__ import annotations

import math

import numpy as np
import pytest

from coplanar import checks
from coplanar.errors import InvalidShape, InvalidValue, UnknownName
from tests.engines import NEEDS_JAX

NUMBER_CHECKS = [checks.real, checks.positive, checks.not_negative]


@pytest.mark.parametrize("check", NUMBER_CHECKS)
@pytest.mark.parametrize("value", [2, 2.0, np.float64(2.0), np.float32(2.0), np.int8(2), np.array(2.0), np.array(2)])
def test_a_single_number_becomes_a_float(check, value):
    assert check("x", value) == 2.0
    assert type(check("x", value)) is float


@pytest.mark.parametrize("check", [*NUMBER_CHECKS, checks.vector])
@pytest.mark.parametrize("value", [[1, 2], (1.0, 2), np.array([1, 2]), np.array([1, 2], np.float32), range(1, 3)])
def test_more_become_a_float64_array(check, value):
    array = check("x", value)
    assert array.dtype == np.float64
    assert array.tolist() == [1.0, 2.0]


def test_a_float64_array_is_not_copied_until_it_is_kept():
    array = np.ones(3)
    assert checks.real("x", array) is array


@pytest.mark.parametrize("check", [*NUMBER_CHECKS, checks.vector])
@pytest.mark.parametrize(
    "value",
    [
        "1.0", b"1", None, 1 + 2j, [1.0, "2"], [[1.0], [1.0, 2.0]], [None], object(), {1.0}, {"a": 1.0},
        True, np.array([True, False]), np.array([1j]), np.array(["1"]), np.datetime64("2020-01-01"),
        np.array([1.0, None]), 10**400, lambda: 1.0,
        np.ma.masked_array([1.0, 2.0], [False, True]),
    ],
    ids=lambda value: type(value).__name__,
)  # fmt: skip
def test_what_is_no_real_number_is_refused_by_name(check, value):
    with pytest.raises(InvalidValue, match=r"^gain = .*: needed real numbers .*; give it in metres$"):
        check("gain", value, remedy="give it in metres")


@pytest.mark.parametrize("check", NUMBER_CHECKS)
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, np.float64("nan"), np.float32("inf")])
def test_what_is_not_finite_is_refused(check, bad):
    with pytest.raises(InvalidValue, match=r"gain = .*: needed finite numbers$"):
        check("gain", bad)
    with pytest.raises(InvalidValue, match=r"needed finite numbers \(entry 2 is -?(nan|inf)\)"):
        check("gain", [1.0, 2.0, bad])
    with pytest.raises(InvalidValue, match=r"needed finite numbers \(entry \(1, 0\) is -?(nan|inf)\)"):
        check("gain", [[1.0, 2.0], [bad, 3.0]])


@pytest.mark.parametrize("zero", [0, 0.0, -0.0, np.float64(0.0)])
def test_zero_is_not_negative_and_not_positive(zero):
    assert checks.not_negative("drag", zero) == 0.0
    with pytest.raises(InvalidValue, match=r"radius = .*: needed greater than 0; measure it"):
        checks.positive("radius", zero, remedy="measure it")


def test_the_first_wrong_entry_is_told():
    with pytest.raises(InvalidValue, match=r"needed greater than 0 \(entry 1 is 0.0\)"):
        checks.positive("radius", [1.0, 0.0, -1.0])
    with pytest.raises(InvalidValue, match=r"needed 0 or more \(entry 2 is -1.0\)"):
        checks.not_negative("radius", [1.0, 0.0, -1.0])
    with pytest.raises(InvalidValue, match=r"needed 0 or more$"):
        checks.not_negative("radius", -5e-324)
    assert checks.positive("radius", 5e-324) == 5e-324


def test_empty_batches_pass():
    for check in NUMBER_CHECKS:
        assert check("x", []).shape == (0,)
    assert checks.vector("points", np.empty((0, 2)), 2).shape == (0, 2)


@pytest.mark.parametrize("value", [1.0, [1.0, 2.0, 3.0], np.zeros((2, 3)), [[1.0]], [], np.empty((2, 0))])
def test_a_vector_of_another_length_is_refused(value):
    with pytest.raises(InvalidShape, match=r"point with shape \(.*\): needed shape \(\.\.\., 2\); two numbers"):
        checks.vector("point", value, 2, remedy="two numbers")


def test_a_vector_of_any_length_has_at_least_one_entry():
    assert checks.vector("joints", [1.0]).shape == (1,)
    for value in (1.0, [], np.empty((3, 0))):
        with pytest.raises(InvalidShape, match=r"needed shape \(\.\.\., n\)"):
            checks.vector("joints", value)


@pytest.mark.parametrize("times", [[0, 1, 3], [3.0, 1.0, -2.0], [-1e308, 1e308], [0.0, 5e-324]])
def test_monotone_times_go_up_or_down(times):
    assert checks.monotone("t", times).tolist() == [float(t) for t in times]


@pytest.mark.parametrize(
    ("times", "where"),
    [
        ([0, 0, 1], r"entries 0 and 1 are 0.0, 0.0"),
        ([0, 1, 1], r"entries 1 and 2 are 1.0, 1.0"),
        ([0, 1, 0.5], r"entries 1 and 2 are 1.0, 0.5"),
        ([3, 2, 2.5, 1], r"entries 1 and 2 are 2.0, 2.5"),
    ],
)
def test_times_that_stop_or_turn_are_refused(times, where):
    with pytest.raises(InvalidValue, match=rf"t = .*strictly monotone vector \({where}\); sort the times"):
        checks.monotone("t", times)


@pytest.mark.parametrize("times", [[1.0], [[0.0, 1.0]], np.zeros((2, 2))])
def test_times_are_a_vector_of_two_or_more(times):
    with pytest.raises(InvalidShape, match=r"t with shape .*: needed a vector of two or more times"):
        checks.monotone("t", times)


def test_a_choice_is_one_of_the_names():
    assert checks.choice("path", "screw", ("screw", "decoupled")) == "screw"
    with pytest.raises(UnknownName, match=r"path = 'skrew': needed one of decoupled, screw; did you mean 'screw'\?"):
        checks.choice("path", "skrew", ("screw", "decoupled"))
    for odd in (None, 3, "", "SCREW", ["screw"]):
        with pytest.raises(UnknownName, match="needed one of"):
            checks.choice("path", odd, ("screw", "decoupled"))


def test_values_that_do_not_broadcast_are_named():
    assert checks.broadcast(x=1.0, y=np.zeros((3, 1)), z=np.zeros(2)) == (3, 2)
    with pytest.raises(
        InvalidShape, match=r"^x, y with shapes \(3,\), \(4,\): needed shapes that broadcast as in NumPy"
    ):
        checks.broadcast(x=np.zeros(3), y=np.zeros(4))


def test_another_kind_is_refused_by_name():
    checks.instance("x", 1.0, float)
    with pytest.raises(InvalidValue, match=r"x = 'a': needed a float; type it"):
        checks.instance("x", "a", float, remedy="type it")


class TestFrozen:
    def test_the_caller_cannot_change_what_is_kept(self):
        mine = np.ones(3)
        kept = checks.frozen(mine)
        mine[0] = 5.0
        assert kept.tolist() == [1.0, 1.0, 1.0]
        with pytest.raises(ValueError, match="read-only"):
            kept[0] = 2.0

    def test_a_read_only_view_of_memory_that_can_be_written_is_copied(self):
        mine = np.ones(3)
        view = mine.view()
        view.flags.writeable = False
        for borrowed in (view, np.broadcast_to(mine, (2, 3)), view[1:]):
            kept = checks.frozen(borrowed)
            assert not np.may_share_memory(kept, mine)
            assert not kept.flags.writeable

    def test_memory_of_others_is_copied(self):
        memory = bytearray(np.ones(3).tobytes())
        view = np.frombuffer(memory)
        view.flags.writeable = False
        kept = checks.frozen(view)
        memory[:8] = b"\0" * 8
        assert kept.tolist() == [1.0, 1.0, 1.0]

    def test_what_nobody_can_change_is_not_copied(self):
        kept = checks.frozen(np.ones(3))
        assert checks.frozen(kept) is kept
        part = kept[1:]
        assert checks.frozen(part) is part
        assert checks.frozen(2.0) == 2.0


@NEEDS_JAX
def test_arrays_of_other_libraries_pass_even_while_they_are_traced():
    import jax

    jnp = jax.numpy

    def through(x):
        for check in (*NUMBER_CHECKS, checks.vector, lambda _, v: checks.frozen(v)):
            x = check("x", x)
        assert checks.broadcast(x=x, y=1.0) == (2,)
        return x

    x = jnp.asarray([1.0, -1.0])
    assert through(x) is x
    assert jax.jit(through)(x).tolist() == [1.0, -1.0]
    with pytest.raises(InvalidShape):
        checks.vector("points", jnp.zeros(3), 2)


@pytest.mark.parametrize("size", [3, 5000])
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("place", [0, 1, -1])
def test_an_entry_that_is_not_finite_is_found_among_many(size, bad, place):
    values = np.full((size, 2), 1e300)
    checks.real("x", values)
    values[place, 1] = bad
    for given in (values, values[:, 1], values.T):
        with pytest.raises(InvalidValue, match="finite"):
            checks.real("x", given)
