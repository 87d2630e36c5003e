"""Frames in a tree and coordinates in a basis: laws over random trees and random bases."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar import Pose
from coplanar.frames import FrameTree, coordinates, from_coordinates

SHAPES = [(), (1,), (3, 1, 2)]
EPS = np.finfo(float).eps
seeds = st.integers(0, 2**32 - 1)


def poses(rng, shape):
    return Pose(rng.normal(size=shape), rng.normal(size=shape), rng.uniform(-7, 7, size=shape))


def random_tree(rng, shape, count=6):
    """Every frame hangs on a random one that is there already; some poses are single, some are batches."""
    tree = FrameTree("root")
    for i in range(count):
        tree = tree.with_frame(f"f{i}", str(rng.choice(tree.names)), poses(rng, shape if rng.random() < 0.5 else ()))
    return tree


def matrix_to_root(tree, name):
    """T_root_name by multiplying homogeneous matrices along the way."""
    T = np.eye(3)
    while (parent := tree.parent(name)) is not None:
        T = next(f.pose for f in tree.frames if f.name == name).as_matrix() @ T
        name = parent
    return T


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds)
@settings(deadline=None, max_examples=15)
def test_poses_in_a_tree(shape, seed):
    rng = np.random.default_rng(seed)
    tree = random_tree(rng, shape)
    a, b, c = rng.choice(tree.names, size=3)
    T_a_b, T_b_c, T_a_c = tree.pose(b, a), tree.pose(c, b), tree.pose(c, a)
    T = np.linalg.inv(matrix_to_root(tree, a)) @ matrix_to_root(tree, b)
    # A handful of products of lengths below ten.
    np.testing.assert_allclose(*np.broadcast_arrays(T_a_b.as_matrix(), T), rtol=0, atol=500 * EPS)
    np.testing.assert_allclose(
        *np.broadcast_arrays((T_a_b @ T_b_c).as_array(), T_a_c.as_array()), rtol=0, atol=500 * EPS
    )
    np.testing.assert_allclose(
        *np.broadcast_arrays(tree.pose(a, b).as_array(), T_a_b.inverse().as_array()), rtol=0, atol=500 * EPS
    )
    np.testing.assert_array_equal(tree.pose(a, a).as_array(), np.zeros_like(tree.pose(a, a).as_array()))


@pytest.mark.parametrize("shape", SHAPES)
@given(seed=seeds, angle=st.floats(-7, 7), flipped=st.booleans())
@settings(deadline=None, max_examples=15)
def test_basis_coordinates(shape, seed, angle, flipped):
    """Coordinates rebuild the vector, keep lengths and angles, and are R^T p for a turned basis."""
    rng = np.random.default_rng(seed)
    p, q = rng.normal(size=(2, *shape, 2))
    turn = angle + rng.uniform(-pi, pi, size=shape)
    sign = -1.0 if flipped else 1.0
    x1 = np.stack([np.cos(turn), np.sin(turn)], -1)
    x2 = sign * np.stack([-np.sin(turn), np.cos(turn)], -1)
    basis = np.stack([x1, x2], axis=-2)
    c = coordinates(p, basis)
    assert c.shape == p.shape
    np.testing.assert_allclose(from_coordinates(c, basis), p, rtol=0, atol=20 * EPS)
    np.testing.assert_allclose(c, (basis @ p[..., None])[..., 0], rtol=0, atol=20 * EPS)
    np.testing.assert_allclose(np.sum(c * coordinates(q, basis), -1), np.sum(p * q, -1), rtol=0, atol=100 * EPS)
    if not flipped:
        np.testing.assert_allclose(
            c, np.stack(Pose(0.0, 0.0, turn).act_inverse(p[..., 0], p[..., 1]), -1), rtol=0, atol=20 * EPS
        )
