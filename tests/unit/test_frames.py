"""Frame trees and bases: names, edges, batches, messages."""

from __future__ import annotations

import dataclasses
import pickle

import numpy as np
import pytest

from coplanar import Pose
from coplanar.errors import InvalidShape, InvalidValue, UnknownName
from coplanar.frames import Frame, FrameTree, coordinates, from_coordinates


@pytest.fixture
def tree():
    return (
        FrameTree("world")
        .with_frame("robot", "world", Pose(1.0, 2.0, np.pi / 2))
        .with_frame("camera", "robot", Pose(0.5, 0.0, 0.0))
        .with_frame("gripper", "robot", Pose(0.0, 0.25, 0.0))
    )


def test_siblings_meet_at_their_nearest_ancestor(tree):
    """A batch or a huge pose above the common ancestor does not enter."""
    far = tree.with_pose("robot", Pose(1e16, 0.0, np.zeros(7)))
    assert far.pose("gripper", "camera").as_array().tolist() == [-0.5, 0.25, 0.0]
    assert far.pose("gripper", "world").shape == (7,)


def test_points_and_poses_point_the_same_way(tree):
    """T_world_camera takes camera coordinates to world coordinates."""
    np.testing.assert_allclose(tree.convert((1.0, 0.0), from_="camera", to="world"), [1.0, 3.5], rtol=0, atol=1e-15)
    np.testing.assert_allclose(tree.pose("camera", "world").position, [1.0, 2.5], rtol=0, atol=1e-15)


def test_a_tree_is_a_value(tree):
    grown = tree.with_frame("lens", "camera", Pose())
    assert "lens" in grown.names
    assert "lens" not in tree.names
    with pytest.raises(dataclasses.FrozenInstanceError):
        tree.root = "other"
    assert tree.lineage("camera") == ("camera", "robot", "world")
    assert (tree.parent("camera"), tree.parent("world")) == ("robot", None)
    assert pickle.loads(pickle.dumps(tree)) == tree
    assert FrameTree(frames=[Frame("a", "world", Pose())]).frames == (Frame("a", "world", Pose()),)


def test_unknown_names_are_told_with_the_nearest(tree):
    for call in (
        lambda: tree.pose("camara", "world"),
        lambda: tree.pose("world", "camara"),
        lambda: tree.with_frame("lens", "camara", Pose()),
        lambda: tree.with_pose("camara", Pose()),
        lambda: tree.parent("camara"),
        lambda: tree.lineage("camara"),
    ):
        with pytest.raises(UnknownName, match="did you mean 'camera'"):
            call()
    with pytest.raises(UnknownName):
        tree.with_pose("world", Pose())


def test_names_come_once_and_cycles_cannot_be_built(tree):
    for name in ("robot", "world"):
        with pytest.raises(InvalidValue, match="not taken"):
            tree.with_frame(name, "camera", Pose())
    with pytest.raises(UnknownName, match="parent"):
        FrameTree("world", (Frame("a", "b", Pose()), Frame("b", "a", Pose())))
    with pytest.raises(UnknownName, match="parent"):
        FrameTree("world", (Frame("a", "a", Pose()),))
    for name in ("", 3):
        with pytest.raises(InvalidValue, match="letter"):
            tree.with_frame(name, "world", Pose())
    with pytest.raises(InvalidValue, match="root"):
        FrameTree("")


def test_batches_that_do_not_broadcast_are_named(tree):
    batched = tree.with_pose("camera", Pose(np.zeros(2), 0.0, 0.0)).with_pose("gripper", Pose(np.zeros(3), 0.0, 0.0))
    with pytest.raises(InvalidShape, match="gripper, camera"):
        batched.pose("gripper", "camera")


def test_a_basis_must_be_orthonormal():
    for basis in ([(1, 0), (1, 0)], [(1, 0), (0, 2)], [(1, 0), (0.1, 1)], [(0, 0), (0, 1)]):
        for call in (coordinates, from_coordinates):
            with pytest.raises(InvalidValue, match="unit vectors at right angles"):
                call((1.0, 2.0), basis)
    assert coordinates((1.0, 2.0), [(1, 0), (0.1, 1)], tolerance=0.11).tolist() == [1.0, 2.1]


def test_shapes_of_a_basis():
    with pytest.raises(InvalidShape, match="basis vector in each row"):
        coordinates((1.0, 2.0), (1.0, 0.0))
    with pytest.raises(InvalidShape):
        coordinates((1.0, 2.0, 3.0), np.eye(2))
    with pytest.raises(InvalidShape):
        coordinates((1.0, 2.0), np.eye(3))
    with pytest.raises(InvalidValue):
        coordinates((np.nan, 2.0), np.eye(2))
    assert coordinates(np.zeros((5, 2)), np.broadcast_to(np.eye(2), (4, 1, 2, 2))).shape == (4, 5, 2)
