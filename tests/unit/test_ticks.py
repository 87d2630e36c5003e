"""Rows of a log as odometry: the same path in pieces as in one, counters that wrap, times that do not go on."""

from __future__ import annotations

import re
from math import tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar.errors import InvalidValue
from coplanar.logs.columns import Rows
from coplanar.logs.ticks import Encoders, Velocities, WheelRates, reckon
from coplanar.motion import Odometry, OdometryNoise, Reckoning
from coplanar.se2 import Pose
from coplanar.wheels import WheeledBase

BASE = WheeledBase.differential(track=0.4, left_radius=0.05, right_radius=0.051)
START = Pose(1.0, -2.0, 0.5)
NOISE = OdometryNoise(forward=0.05, sideways=0.01, turn_per_metre=0.02, turn_per_radian=0.03)
ROUNDING = 1e-12  # of metres and radians after some hundred ticks


def pieces(values, cuts=()):
    lines = np.arange(len(values)) + 1
    for part in np.split(np.arange(len(values)), sorted(cuts)):
        yield Rows(values[part], lines[part])


def path(values, measured, cuts=(), **options):
    reckoning = options.pop("reckoning", Reckoning(START))
    got = [p for p in reckon(pieces(values, cuts), measured, reckoning, **options)]
    return np.concatenate([p.poses.as_array() for p in got]), got


def drive(seed, count=80):
    rng = np.random.default_rng(seed)
    return np.cumsum(rng.uniform(0.01, 0.1, count)), rng.normal(size=(count, 2))


cuts = st.lists(st.integers(0, 80), max_size=8)
seeds = st.integers(0, 2**32 - 1)


@settings(deadline=None, max_examples=40)
@given(seeds, cuts)
def test_velocities_in_pieces_are_one_call_to_the_last_bit(seed, cuts):
    t, u = drive(seed)
    values = np.column_stack((t, u))
    whole = Odometry.from_velocities(u[:, 0], u[:, 1], t)
    got, parts = path(values, Velocities(), cuts, reckoning=Reckoning(START, noise=NOISE))
    assert np.array_equal(got, whole.path(START).as_array())
    spread = np.concatenate([p.covariances for p in parts])
    assert np.array_equal(spread, whole.covariances(START, NOISE))
    assert np.array_equal(np.concatenate([p.times for p in parts]), t)
    assert np.array_equal(parts[-1].onward.pose.as_array(), got[-1])


@settings(deadline=None, max_examples=40)
@given(seeds, cuts, st.sampled_from([None, 8, 16, 32]), st.booleans(), st.booleans())
def test_counters_wrap_and_turn_back(seed, cuts, bits, timed, signed):
    rng = np.random.default_rng(seed)
    ways = rng.integers(-100, 101, (79, 2))
    totals = np.cumsum(np.concatenate(([[3, -5]], ways)), axis=0)
    counts = totals.astype(float)
    if bits:
        counts = np.mod(counts, 2.0**bits) - (2.0 ** (bits - 1) if signed else 0.0)
    if timed:
        counts = np.column_stack((np.arange(80.0), counts))
    radii = np.array([0.05, 0.051])
    left, right = (totals[1:] - totals[:-1]).T * (radii * tau / 360.0)[:, None]
    expected = Odometry.from_wheels(left, right, track=0.4).path(START).as_array()
    got, parts = path(counts, Encoders(BASE, ticks_per_turn=360.0, bits=bits), cuts)
    assert got == pytest.approx(expected, abs=ROUNDING)
    assert (parts[0].times is not None) is timed


@settings(deadline=None, max_examples=30)
@given(seeds, cuts)
def test_counts_since_the_last_row_are_totals_less_one_row(seed, cuts):
    steps = np.random.default_rng(seed).integers(-50, 51, (80, 2)).astype(float)
    totals = np.concatenate((np.zeros((1, 2)), np.cumsum(steps, axis=0)))
    each, _ = path(steps, Encoders(BASE, ticks_per_turn=100.0, since_last=True), cuts)
    summed, _ = path(totals, Encoders(BASE, ticks_per_turn=100.0))
    assert each == pytest.approx(summed[1:], abs=ROUNDING)


@settings(deadline=None, max_examples=30)
@given(seeds, cuts)
def test_wheel_rates_are_velocities_of_the_base(seed, cuts):
    t, rates = drive(seed)
    twist = BASE.forward(rates)
    got, _ = path(np.column_stack((t, rates)), WheelRates(BASE), cuts)
    expected, _ = path(np.column_stack((t, twist.vx, twist.omega)), Velocities())
    assert got == pytest.approx(expected, abs=ROUNDING)


def test_an_omni_base_is_reckoned_too():
    base = WheeledBase.omni(3, wheel_distance=0.2, radius=0.05)
    turns = np.array([[0.0, 0.0, 0.0], [10.0, 10.0, 10.0]])
    got, _ = path(turns, Encoders(base, ticks_per_turn=100.0))
    assert got[-1].tolist() == pytest.approx([1.0, -2.0, 0.5 + 0.1 * tau * 0.05 / 0.2], abs=ROUNDING)


def test_one_row_is_the_start():
    got, parts = path(np.array([[7.0, 1.0, 1.0]]), Velocities())
    assert got.tolist() == [list(START.parts)]
    assert parts[0].times.tolist() == [7.0]


@pytest.mark.parametrize("cuts", [(), (1,), (2,), (1, 2)])
@pytest.mark.parametrize(
    ("times", "message"),
    [
        ([0.0, 2.0, 1.0], r"t in line 3 of log = 1.0: needed a time after 2, that of the row before$"),
        ([0.0, 1.0, 1.0], r"t in line 3 of log = 1.0: needed a time after 1, .*; rows of equal times can be accepted"),
    ],
)
def test_time_goes_on(times, message, cuts):
    values = np.column_stack((times, np.ones(3), np.zeros(3)))
    seen, error = until_refused(values, cuts)
    assert re.search(message, error)
    assert seen.tolist() == [0.0, times[1]]


def until_refused(values, cuts):
    """The x of the poses before the error, and what it says."""
    seen = np.empty(0)
    try:
        for piece in reckon(pieces(values, cuts), Velocities()):
            seen = np.concatenate((seen, piece.poses.x))
    except InvalidValue as error:
        return seen, str(error)
    raise AssertionError


def test_equal_times_may_be_accepted():
    values = np.column_stack(([0.0, 1.0, 1.0, 2.0], [1.0, 5.0, 2.0, 0.0], np.zeros(4)))
    got, _ = path(values, Velocities(), equal_times=True, reckoning=Reckoning())
    assert got[:, 0].tolist() == [0.0, 1.0, 1.0, 3.0]
    with pytest.raises(InvalidValue, match=r"line 2 of log = -0.5: needed a time of at least 0.5"):
        path(values * [-1.0, 1.0, 1.0] + [0.5, 0.0, 0.0], Velocities(), equal_times=True)


def test_what_cannot_have_been_counted_is_refused():
    for bits, value, words in (
        (None, 1.5, "at most 2"),
        (8, 256.0, "8 bits"),
        (8, -129.0, "8 bits"),
        (None, 2.0**54, "at most"),
    ):
        values = np.array([[0.0, 0.0], [1.0, value]])
        with pytest.raises(InvalidValue, match=f"right in line 2 of log = .* a whole count of {words}"):
            path(values, Encoders(BASE, ticks_per_turn=100.0, bits=bits))
    with pytest.raises(InvalidValue, match="left in line 1"):
        path(np.array([[0.0, 0.5, 1.0]]), Encoders(BASE, ticks_per_turn=100.0))
    with pytest.raises(InvalidValue, match="ticks_per_turn"):
        Encoders(BASE, ticks_per_turn=0.0)
    for bits in (1, 54):
        with pytest.raises(InvalidValue, match="bits"):
            Encoders(BASE, ticks_per_turn=1.0, bits=bits)


@pytest.mark.parametrize("cuts", [(), (1,), (2,)])
def test_a_path_that_leaves_the_numbers_is_refused(cuts):
    values = np.column_stack(([0.0, 1.0, 2.0, 3.0], [1e308, 1e308, 1e308, 0.0], np.zeros(4)))
    seen, error = until_refused(values, cuts)
    assert "path at line 3 of log" in error
    assert seen.tolist() == [0.0, 1e308]
