"""Results in memory of the caller's: of any size, by every evaluator, over the inputs too; and what does not fit."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar import Arm, Displacement, Odometry, Pose, Segment, Twist
from coplanar.errors import InvalidShape

ROWS = [(), (1,), (5,), (2, 3), (30_000,)]


def column(rows, seed):
    values = np.random.default_rng(seed).uniform(-1.0, 1.0, rows)
    return values if rows else float(values)


def triple(kind, rows, seed=0):
    return kind(*(column(rows, seed + k) for k in range(3)))


def step(rows):
    return lambda out: triple(Pose, rows).step(triple(Displacement, rows, 3), out=out)


def integrate(rows):
    return lambda out: triple(Pose, rows).integrate(triple(Twist, rows, 3), 0.5, out=out)


def end(rows):
    segment = Segment(*(column(rows, k) for k in range(4)), duration=0.7)
    return lambda out: segment.end(triple(Pose, rows, 5), out=out)


def at(rows):
    return lambda out: Segment(1.0, 0.5, 0.2, 0.1, duration=0.7).pose(triple(Pose, rows, 5), 0.3, out=out)


def forward(rows):
    q = np.random.default_rng(0).uniform(-3.0, 3.0, (*rows, 3))
    return lambda out: Arm((1.0, 0.5, 0.3), tool=Pose(0.1, 0.2, 0.3)).forward(q, out=out)


def path(rows, **how):
    *lead, n = rows
    odometry = Odometry(triple(Displacement, (*lead, n - 1)))
    return lambda out: odometry.path(Pose(0.5, 0.2, 0.1), out=out, **how)


def euler(rows):
    return path(rows, method="euler")


CALLS = [step, integrate, end, at, forward, path, euler]


@pytest.mark.parametrize("rows", ROWS, ids=str)
@pytest.mark.parametrize("make", CALLS)
def test_a_pose_is_written_where_the_caller_wants_it(make, rows):
    if make in (path, euler) and not (rows and rows[-1] > 1):
        pytest.skip("a path has two poses or more")
    call, out = make(rows), np.empty((3, *rows))
    expected, answer = call(None), call(out)
    assert answer == expected
    assert np.array_equal(out, [np.broadcast_to(part, rows) for part in expected.parts])
    if rows:
        assert all(np.shares_memory(part, out) and not part.flags.writeable for part in answer.parts)
        assert out.flags.writeable
    else:
        assert {type(part) for part in answer.parts} == {float}


@pytest.mark.parametrize("rows", ROWS[2:], ids=str)
@pytest.mark.parametrize("make", CALLS)
def test_the_memory_may_lie_as_it_likes(make, rows):
    call, table = make(rows), np.zeros((*rows, 4))
    out = np.moveaxis(table[..., :3], -1, 0)
    assert call(out) == call(None)
    assert not table[..., 3].any()


@pytest.mark.parametrize("rows", [(6,), (30_000,)])
def test_a_step_may_be_written_over_its_own_pose(rows):
    state, way = np.stack(triple(Pose, rows).parts), triple(Displacement, rows, 3)
    state.flags.writeable = True
    expected = Pose(*state).step(way).step(way)
    pose = Pose(*state).step(way, out=state)
    assert pose.step(way, out=state) == expected


@pytest.mark.parametrize("task", ["pose", "position"])
@pytest.mark.parametrize("rows", ROWS, ids=str)
def test_a_jacobian_is_written_where_the_caller_wants_it(rows, task):
    arm, q = Arm((1.0, 0.5, 0.3)), np.random.default_rng(0).uniform(-3.0, 3.0, (*rows, 3))
    expected = arm.jacobian(q, task=task)
    for out in (np.empty(expected.shape), np.empty(expected.shape, order="F")):
        assert arm.jacobian(q, task=task, out=out) is out or np.shares_memory(arm.jacobian(q, task=task, out=out), out)
        assert np.array_equal(out, expected)


def test_a_jacobian_may_be_written_over_its_joints():
    arm, q = Arm((1.0, 0.5, 0.3)), np.random.default_rng(0).uniform(-3.0, 3.0, (30_000, 3))
    memory = np.zeros((30_000, 3, 3))
    memory[:, 0] = q
    expected = arm.jacobian(q)
    arm.jacobian(memory[:, 0], out=memory)
    assert np.array_equal(memory, expected)


WRONG = [
    (np.empty((3, 4)), "float64 array of shape (3, 4)"),
    (np.empty((5, 3)), "shape (5, 3)"),
    (np.empty((3, 5), np.float32), "float32"),
    ([[0.0] * 5] * 3, "list"),
    (np.broadcast_to(0.0, (3, 5)), "read-only"),
]


@pytest.mark.parametrize(("out", "given"), WRONG)
@pytest.mark.parametrize("make", CALLS)
def test_memory_that_does_not_fit_is_refused(make, out, given):
    with pytest.raises(InvalidShape) as refused:
        make((5,))(out)
    assert given in str(refused.value)
    assert "np.empty((3, 5))" in str(refused.value)
