"""Odometry in pieces is odometry in one piece; a method of steps is the integrator of that name."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar.engine import reproducible
from coplanar.integrators import METHODS, integrate_ode
from coplanar.laws.motion import unicycle_rates
from coplanar.motion import Odometry, OdometryNoise, Reckoning
from coplanar.motion.odometry import PATH_METHODS
from coplanar.se2 import Displacement, Pose

ROUNDING = 1e-12  # of sums of some hundred numbers of the order of one
NOISE = OdometryNoise(forward=0.1, sideways=0.02, turn_per_metre=0.03, turn_per_radian=0.05)


def ticks(seed, shape):
    rng = np.random.default_rng(seed)
    return Displacement(*rng.normal(size=(3, *shape)))


def pieces(increments, cuts):
    edges = [0, *sorted(cuts), increments.shape[-1]]
    for begin, end in pairwise(edges):
        yield Odometry(Displacement(*(part[..., begin:end] for part in increments.parts)))


def walk(reckoning, odometries):
    rows, spreads = [], []
    for odometry in odometries:
        poses, covariances, reckoning = reckoning.follow(odometry)
        rows.append(poses.as_array()[..., 1:, :])
        if covariances is not None:
            spreads.append(covariances[..., 1:, :, :])
    return np.concatenate(rows, axis=-2), np.concatenate(spreads, axis=-3) if spreads else None, reckoning


@settings(deadline=None, max_examples=40)
@given(
    st.integers(0, 2**32 - 1),
    st.sampled_from([(60,), (1, 60), (3, 2, 60)]),
    st.lists(st.integers(0, 60), max_size=6),
    st.sampled_from(PATH_METHODS),
)
def test_pieces_are_the_whole_to_the_last_bit(seed, shape, cuts, method):
    increments, start = ticks(seed, shape), Pose(0.3, -7.0, 2.0)
    with reproducible():  # evaluators differ in the last bit, and the length of a piece may choose among them
        path = Odometry(increments).path(start, method=method)
        rows, spreads, end = walk(Reckoning(start, method=method), pieces(increments, cuts))
    assert spreads is None
    assert np.array_equal(rows, path.as_array()[..., 1:, :])
    assert np.array_equal(end.pose.as_array(), rows[..., -1, :])


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 2**32 - 1), st.sampled_from([(60,), (3, 60)]), st.lists(st.integers(0, 60), max_size=6))
def test_covariances_of_pieces_are_those_of_the_whole(seed, shape, cuts):
    increments, start = ticks(seed, shape), Pose(0.3, -7.0, 2.0)
    initial = np.diag([0.1, 0.2, 0.01])
    _, spreads, _ = walk(Reckoning(start, noise=NOISE, initial=initial), pieces(increments, cuts))
    assert np.array_equal(spreads, Odometry(increments).covariances(start, NOISE, initial)[..., 1:, :, :])


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 2**32 - 1), st.sampled_from(list(METHODS)))
def test_a_method_of_steps_is_the_integrator_of_that_name(seed, method):
    rng = np.random.default_rng(seed)
    v, omega, times = rng.normal(size=40), rng.normal(size=40), np.cumsum(rng.uniform(0.01, 0.5, 41))
    stepped = integrate_ode(
        lambda _, pose, u: np.array(unicycle_rates(pose[2], *u)), times, [1.0, 2.0, 0.5],
        method=method, held=np.stack((v, omega), axis=-1),
    )  # fmt: skip
    path = Odometry.from_velocities(v, omega, times).path(Pose(1.0, 2.0, 0.5), method=method)
    assert path.as_array() == pytest.approx(stepped, rel=ROUNDING, abs=ROUNDING)


def test_the_error_of_a_method_falls_with_its_order():
    for name, method in METHODS.items():
        errors = []
        for count in (20, 40):
            arc = Odometry(Displacement(np.full(count, 2.0 / count), 0.0, np.full(count, 1.5 / count)))
            gap = arc.path(Pose(), method=name).position - arc.path(Pose()).position
            errors.append(np.hypot(*gap[-1]))
        assert np.log2(errors[0] / errors[1]) == pytest.approx(method.order, abs=0.05)


def test_what_cannot_be_reckoned_is_refused():
    with pytest.raises(ValueError, match=r"method = 'rk5'.*did you mean 'rk4'"):
        Reckoning(Pose(), method="rk5")
    with pytest.raises(ValueError, match="symmetric"):
        Reckoning(Pose(), initial=np.triu(np.ones((3, 3))))
    with pytest.raises(ValueError, match="a Pose"):
        Reckoning((0.0, 0.0, 0.0))
    with pytest.raises(ValueError, match="method"):
        Odometry(Displacement([1.0], 0.0, 0.0)).path(Pose(), method="eulr")
