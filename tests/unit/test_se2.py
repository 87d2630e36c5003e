"""Poses, twists, displacements: edges, batches, what cannot be changed, what is refused and how."""

from __future__ import annotations

import copy
import dataclasses
import math
import operator
import pickle

import numpy as np
import pytest

from coplanar import Displacement, Pose, Twist, unwrap_angles, wrap_angle
from coplanar.errors import InvalidShape, InvalidValue, UnknownName
from tests.engines import BATCH_SHAPES, NEEDS_JAX

KINDS = [Pose, Twist, Displacement]
every_kind = pytest.mark.parametrize("kind", KINDS)


def batch(kind, *shape, seed=0):
    return kind(*np.random.default_rng(seed).uniform(-2.0, 2.0, (3, *shape)))


# Construction


@every_kind
def test_nothing_given_is_the_identity(kind):
    assert kind() == kind(0.0, 0.0, 0.0)
    assert kind().shape == ()
    assert [type(part) for part in kind(1, np.float32(2.0), np.int64(3)).parts] == [float] * 3


@every_kind
def test_fields_broadcast_and_keep_their_own_shape(kind):
    many = kind(np.zeros((4, 1)), [1.0, 2.0, 3.0], 0.5)
    assert many.shape == (4, 3)
    assert many.parts[2] == 0.5
    assert many.as_array().shape == (4, 3, 3)
    assert kind.from_array(many.as_array()) == many


@every_kind
@pytest.mark.parametrize("bad", [math.nan, math.inf, "1", None, 1j, [1.0, "x"], [[1.0], [1.0, 2.0]], True])
def test_what_is_no_number_is_refused_by_field(kind, bad):
    for k, name in enumerate(kind.names):
        parts: list = [0.0, 0.0, 0.0]
        parts[k] = bad
        with pytest.raises(InvalidValue, match=rf"^{name} = .*: needed (finite|real) numbers"):
            kind(*parts)


@every_kind
def test_fields_that_do_not_broadcast_are_refused(kind):
    first, second, third = kind.names
    with pytest.raises(InvalidShape, match=rf"{first}, {second}, {third} with shapes \(3,\), \(4,\), \(\)"):
        kind(np.zeros(3), np.zeros(4), 0.0)
    for wrong in ([1.0, 2.0], np.zeros((3, 2)), 1.0, [], np.zeros((3, 0))):
        with pytest.raises(InvalidShape, match=r"array with shape .*: needed shape \(\.\.\., 3\)"):
            kind.from_array(wrong)


# Nobody can change a value


@every_kind
def test_the_caller_s_arrays_are_copied(kind):
    mine = np.ones((2, 3))
    for value in (kind(*mine.T), kind.from_array(mine), kind(mine[:, 0], 0.0, 0.0)):
        before = value.as_array().tolist()
        mine += 1.0
        assert value.as_array().tolist() == before


def test_results_are_read_only_and_do_not_hang_on_the_caller():
    rates, heading, points = np.ones((4, 3)), np.zeros(4), np.ones((4, 2))
    pose, twist = batch(Pose, 4), batch(Twist, 4)
    values = [
        pose, pose @ pose, pose.inverse(), pose.between(pose), pose.wrapped, pose.log(), pose.step(pose.log()),
        Pose.exp(pose.log()), pose.transform(twist), twist.during(2.0), pose.log().over(2.0), pose[1:],
        Twist.from_world(rates, heading), Twist.from_world(rates, 0.0), Pose.from_matrix(pose.as_matrix()),
        pose.interpolate(pose, 0.5), pose.interpolate(pose, heading, path="decoupled"),
    ]  # fmt: skip
    for value in values:
        for part in value.parts:
            assert not part.flags.writeable
            assert not any(np.may_share_memory(part, mine) for mine in (rates, heading))
    answer = pose @ points
    assert answer.flags.writeable
    assert not np.may_share_memory(answer, points)


@every_kind
def test_it_is_frozen(kind):
    value = kind(1.0, 2.0, 3.0)
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(value, kind.names[0], 2.0)
    with pytest.raises(dataclasses.FrozenInstanceError):
        delattr(value, kind.names[0])
    with pytest.raises((AttributeError, TypeError)):
        value.other = 1.0
    assert not hasattr(value, "__dict__")


@every_kind
@pytest.mark.parametrize("shape", BATCH_SHAPES)
@pytest.mark.parametrize("travel", [copy.copy, copy.deepcopy, lambda v: pickle.loads(pickle.dumps(v))])
def test_copies_and_pickles_are_equal_and_read_only(kind, shape, travel):
    value = batch(kind, *shape)
    there = travel(value)
    assert type(there) is kind
    assert there == value
    for part in there.parts:
        assert type(part) is float or not part.flags.writeable


def test_replace_and_repr_and_match():
    pose = Pose(1.0, 2.0, 0.5)
    assert dataclasses.replace(pose, theta=0.0) == Pose(1.0, 2.0, 0.0)
    assert repr(pose) == "Pose(x=1.0, y=2.0, theta=0.5)"
    assert eval(repr(pose), {"Pose": Pose}) == pose
    assert repr(Pose(np.zeros(2), 1.0)) == "Pose(x=array([0., 0.]), y=1.0, theta=0.0)"
    match pose:
        case Pose(x, y, theta):
            assert (x, y, theta) == pose.parts


# Equal and close


@every_kind
def test_equality_is_of_the_numbers(kind):
    assert kind(1, 2, 3) == kind(1.0, 2.0, 3.0)
    assert kind(1, 2, 3) != kind(1.0, 2.0, math.nextafter(3.0, 4.0))
    assert hash(kind(1, 2, 3)) == hash(kind(1.0, 2.0, 3.0))
    assert kind(0.0, 0.0, 0.0) == kind(-0.0, 0.0, 0.0)


@every_kind
def test_equality_of_batches_is_one_answer(kind):
    many = batch(kind, 4)
    assert many == kind(*many.parts)
    assert many != batch(kind, 4, seed=1)
    assert many != many[:2]
    assert many[:1] != many[0]
    assert kind(np.zeros(2), 0.0, 1.0) == kind(np.zeros(2), np.zeros(2), np.ones(2))
    with pytest.raises(TypeError, match="unhashable"):
        hash(many)


def test_kinds_differ():
    assert len({Pose(1, 2, 3), Twist(1, 2, 3), Displacement(1, 2, 3), Pose(1, 2, 3)}) == 3
    assert Pose(1, 2, 3) != Twist(1, 2, 3)
    assert Pose(1, 2, 3) != (1.0, 2.0, 3.0)
    assert Pose(1, 2, 3) != "pose"


def test_close_is_a_distance_and_an_angle():
    pose = Pose(1.0, 2.0, math.pi)
    room = {"distance": 1e-3, "angle": 1e-3}
    assert pose.is_close(Pose(1.0 + 6e-4, 2.0 - 6e-4, -math.pi), **room) is True
    assert pose.is_close(Pose(1.0 + 8e-4, 2.0 - 8e-4, -math.pi), **room) is False
    assert pose.is_close(Pose(1.0, 2.0, 3 * math.pi - 2e-3), **room) is False
    assert pose.is_close(Pose(1.0, [2.0, 3.0], math.pi), **room).tolist() == [True, False]
    assert pose.is_close(pose, distance=0.0, angle=0.0)
    for name in room:
        with pytest.raises(InvalidValue, match=rf"{name} = -1.0: needed 0 or more"):
            pose.is_close(pose, **{**room, name: -1.0})
    with pytest.raises(TypeError, match="keyword-only"):
        pose.is_close(pose)
    with pytest.raises(InvalidValue, match=r"other = .*: needed a Pose"):
        pose.is_close((1.0, 2.0, 3.0), **room)


# Not a sequence


@every_kind
def test_an_index_takes_leading_axes(kind):
    many = batch(kind, 4, 3)
    assert many[1].shape == (3,)
    assert many[1, 2].as_array().tolist() == many.as_array()[1, 2].tolist()
    assert [type(part) for part in many[1, 2].parts] == [float] * 3
    assert many[:, 1:].shape == (4, 2)
    assert many[..., None].shape == (4, 3, 1)
    assert many[many.parts[0] > 0.0].shape == (np.count_nonzero(many.parts[0] > 0.0),)
    assert kind(np.arange(3.0), 1.0, 2.0)[2] == kind(2.0, 1.0, 2.0)
    with pytest.raises(IndexError):
        many[4]


@every_kind
def test_a_single_one_has_no_index_and_none_is_iterable(kind):
    with pytest.raises(InvalidShape, match=rf"{kind.__name__} with shape \(\): needed a leading axis .* parts"):
        kind(1.0, 2.0, 3.0)[0]
    for value in (kind(1.0, 2.0, 3.0), batch(kind, 3)):
        with pytest.raises(TypeError, match=r"not iterable|cannot unpack"):
            _x, _y, _theta = value
        with pytest.raises(TypeError):
            len(value)


def test_integrate_is_the_step_of_the_twist_over_the_time():
    pose, twist = Pose(1.0, -2.0, 0.3), Twist(0.7, -0.2, 1.1)
    assert pose.integrate(twist, 0.4) == pose.step(twist.during(0.4))
    np.testing.assert_allclose(pose.integrate(twist, [0.1, 0.4]).x, [pose.integrate(twist, t).x for t in (0.1, 0.4)])
    with pytest.raises(InvalidValue, match="twist"):
        pose.integrate(twist.during(1.0), 0.4)


# Operators


def test_poses_compose_over_batches():
    many, one = batch(Pose, 4), Pose(1.0, -2.0, 0.3)
    assert (many @ one).shape == (one @ many).shape == (4,)
    assert (batch(Pose, 3, 1) @ many).shape == (3, 4)
    np.testing.assert_allclose((many @ one)[2].as_array(), (many[2] @ one).as_array(), rtol=0.0, atol=1e-15)
    with pytest.raises(InvalidShape, match=r"with shapes \(4,\), \(4,\), \(4,\), \(3,\)"):
        many @ batch(Pose, 3)


@pytest.mark.parametrize(
    ("poses", "points", "result"),
    [((), (2,), (2,)), ((), (5, 2), (5, 2)), ((4,), (2,), (4, 2)), ((4,), (4, 2), (4, 2)), ((4,), (7, 1, 2), (7, 4, 2)),
     ((3, 1, 2), (2, 2), (3, 1, 2, 2)), ((), (0, 2), (0, 2)), ((1,), (2,), (1, 2))],
)  # fmt: skip
def test_poses_take_points_over_batches(poses, points, result):
    T = batch(Pose, *poses)
    p = np.random.default_rng(3).uniform(-1.0, 1.0, points)
    moved = T @ p
    assert moved.shape == result
    right = np.einsum("...ij,...j->...i", T.as_matrix()[..., :2, :2], p) + T.position
    assert np.allclose(moved, right, rtol=0.0, atol=1e-15)
    assert p.size == 0 or (T @ p.tolist()).tolist() == moved.tolist()
    assert np.array_equal(np.stack(T.act(p[..., 0], p[..., 1]), -1), moved)


def test_what_is_no_pose_and_no_point_is_refused():
    pose = Pose(1.0, 2.0, 0.5)
    for wrong in (Displacement(1.0, 0.0, 0.0), Twist(1.0, 0.0, 0.0)):
        with pytest.raises(InvalidValue, match=r"right of @ = .*: needed a Pose or points .*; step\(\) takes"):
            pose @ wrong
    for wrong in (1.0, [1.0, 2.0, 3.0], np.zeros((2, 3))):
        with pytest.raises(InvalidShape, match=r"points with shape .*: needed shape \(\.\.\., 2\)"):
            pose @ wrong
    for wrong in ("ab", None, [1.0, math.nan]):
        with pytest.raises(InvalidValue, match=r"points = .*: needed (real|finite) numbers"):
            pose @ wrong


@every_kind
@pytest.mark.parametrize("operate", [operator.matmul, operator.add, operator.mul])
def test_an_array_on_the_left_is_refused(kind, operate):
    for left in (np.zeros(2), np.float64(1.0)):
        with pytest.raises(TypeError):
            operate(left, kind())


def test_a_rate_is_no_increment():
    pose, twist, step = Pose(1.0, 2.0, 0.5), Twist(1.0, 0.0, 0.0), Displacement(1.0, 0.0, 0.0)
    with pytest.raises(InvalidValue, match=r"increment = Twist.*: needed a Displacement; a Twist makes one by during"):
        pose.step(twist)
    with pytest.raises(InvalidValue, match=r"displacement = Twist.*: needed a Displacement"):
        Pose.exp(twist)
    with pytest.raises(InvalidValue, match=r"twist = Displacement.*: needed a Twist"):
        pose.transform(step)
    for method in (pose.between, lambda other: pose.interpolate(other, 0.5)):
        with pytest.raises(InvalidValue, match=r"other = Twist.*: needed a Pose"):
            method(twist)


# Verbs


def test_arguments_of_verbs_are_checked():
    pose, twist, step = Pose(1.0, 2.0, 0.5), Twist(1.0, 0.0, 0.0), Displacement(1.0, 0.0, 0.0)
    with pytest.raises(InvalidValue, match=r"px = nan: needed finite"):
        pose.act(math.nan, 0.0)
    with pytest.raises(InvalidValue, match=r"py = 'a': needed real"):
        pose.act_inverse(0.0, "a")
    with pytest.raises(InvalidValue, match=r"fraction = inf: needed finite"):
        pose.interpolate(pose, math.inf)
    with pytest.raises(UnknownName, match=r"path = 'lerp': needed one of decoupled, screw"):
        pose.interpolate(pose, 0.5, path="lerp")
    with pytest.raises(InvalidValue, match=r"duration = 0.0: needed greater than 0"):
        step.over(0.0)
    with pytest.raises(InvalidValue, match=r"duration = nan: needed finite"):
        twist.during(math.nan)
    with pytest.raises(InvalidValue, match=r"heading = None: needed real"):
        twist.in_world(None)
    with pytest.raises(InvalidShape, match=r"rates with shape \(2,\): needed shape \(\.\.\., 3\)"):
        Twist.from_world([1.0, 2.0], 0.0)
    with pytest.raises(InvalidShape, match="broadcast"):
        batch(Twist, 3).during(np.ones(4))


def test_a_twist_goes_back_in_negative_time():
    assert Twist(1.0, 2.0, 3.0).during(-2.0) == Displacement(-2.0, -4.0, -6.0)


def test_a_heading_keeps_its_turns_until_it_is_wrapped():
    pose = Pose(1.0, 2.0, 7.0)
    assert (pose @ Pose(0.0, 0.0, 7.0)).theta == 14.0
    assert pose.step(Displacement(0.0, 0.0, 7.0)).theta == 14.0
    assert pose.wrapped == Pose(1.0, 2.0, 7.0 - math.tau)
    assert pose.wrapped.wrapped == pose.wrapped
    assert Pose(0.0, 0.0, -math.pi).wrapped.theta == math.pi


def test_positions_and_matrices_have_the_leading_shape():
    for shape in BATCH_SHAPES:
        pose, xi = batch(Pose, *shape), batch(Displacement, *shape)
        assert pose.position.shape == (*shape, 2)
        for matrix in (pose.as_matrix(), pose.adjoint(), xi.exp_jacobian(), xi.right_jacobian()):
            assert matrix.shape == (*shape, 3, 3)


class TestFromMatrix:
    def test_it_undoes_as_matrix(self):
        for shape in BATCH_SHAPES:
            pose = batch(Pose, *shape)
            back = Pose.from_matrix(pose.as_matrix())
            assert back.shape == shape
            assert np.all(back.is_close(pose, distance=0.0, angle=1e-15))

    def test_half_a_turn_is_plus_pi(self):
        for zero in (0.0, -0.0):
            assert Pose.from_matrix([[-1.0, -zero, 0.0], [zero, -1.0, 0.0], [0.0, 0.0, 1.0]]).theta == math.pi

    @pytest.mark.parametrize(
        "matrix",
        [
            [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]],
            [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]],
            [[1.0, 0.1, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0]],
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [3.0, 4.0, 1.0]],
            [np.eye(3), np.diag([1.0, -1.0, 1.0])],
        ],
        ids=["reflection", "scale", "shear", "zero", "weight", "transposed", "one of two"],
    )
    def test_what_is_no_rigid_motion_is_refused(self, matrix):
        with pytest.raises(InvalidValue, match=r"matrix = .*: needed \[\[R, p\], \[0, 0, 1\]\] with a rotation R"):
            Pose.from_matrix(matrix)

    def test_how_far_it_may_be_off_is_an_argument(self):
        rough = np.round(Pose(1.0, 2.0, 0.5).as_matrix(), 4)
        with pytest.raises(InvalidValue, match="rotation"):
            Pose.from_matrix(rough)
        assert abs(Pose.from_matrix(rough, rotation_error=1e-3).theta - 0.5) < 1e-3

    @pytest.mark.parametrize("matrix", [np.eye(2), np.eye(4), np.zeros((2, 3)), np.zeros(3), 1.0])
    def test_another_shape_is_refused(self, matrix):
        with pytest.raises(InvalidShape, match=r"matrix with shape .*: needed shape \(\.\.\., 3"):
            Pose.from_matrix(matrix)


# Angles


def test_angles_wrap_and_unwrap():
    assert wrap_angle([0.0, math.tau, -math.pi]).tolist() == [0.0, 0.0, math.pi]
    turning = np.linspace(0.0, 30.0, 100)
    assert np.allclose(unwrap_angles(wrap_angle(turning)), turning, rtol=0.0, atol=1e-13)
    table = np.stack([turning, -turning])
    assert np.allclose(unwrap_angles(wrap_angle(table)), table, rtol=0.0, atol=1e-13)
    assert np.allclose(unwrap_angles(wrap_angle(table.T), axis=0), table.T, rtol=0.0, atol=1e-13)
    with pytest.raises(InvalidValue, match="angle = nan"):
        wrap_angle(math.nan)
    with pytest.raises(InvalidShape, match="angles"):
        unwrap_angles(1.0)


# JAX


@NEEDS_JAX
class TestJax:
    def test_poses_of_foreign_arrays_work_inside_jit(self):
        import jax

        def there(x, theta):
            pose = Pose(x, 2.0, theta) @ Pose.exp(Displacement(1.0, 0.5, theta))
            pose = pose.step(Twist(1.0, 0.0, theta).during(0.5)).inverse().interpolate(Pose(x, x, theta), 0.25)
            return (pose @ (0.1, 0.2)), pose[0].theta, pose.position, pose.as_matrix(), pose.log().as_array()

        with jax.enable_x64(True):
            x, theta = jax.numpy.asarray([1.0, 2.0]), jax.numpy.asarray([0.3, -2.0])
            for one, two in zip(jax.jit(there)(x, theta), there(np.asarray(x), np.asarray(theta)), strict=True):
                assert np.shape(one) == np.shape(two)
                assert np.allclose(np.asarray(one), two, rtol=0.0, atol=1e-14)

    def test_gradients_go_through_exp_and_log(self):
        import jax

        def forth_and_back(theta):
            return Pose.exp(Displacement(1.0, 0.5, theta)).log().dtheta

        def height(theta):
            return Pose.exp(Displacement(1.0, 0.5, theta)).y

        with jax.enable_x64(True):
            for theta in (0.0, 1e-9, 0.5, -2.0):
                at = jax.numpy.asarray(theta)
                slope = Displacement(1.0, 0.5, theta).exp_jacobian()[1, 2]
                assert abs(float(jax.grad(height)(at)) - slope) < 1e-14
                assert abs(float(jax.grad(forth_and_back)(at)) - 1.0) < 1e-14

    def test_they_keep_their_library(self):
        import jax

        pose = Pose(jax.numpy.zeros(3), 1.0, 0.5)
        assert pose.shape == (3,)
        for part in (*(pose @ pose).parts, *pose.inverse().parts, pose.position, pose.as_matrix(), pose[1].x):
            assert isinstance(part, jax.Array)
        assert pose == Pose(np.zeros(3), 1.0, 0.5)
