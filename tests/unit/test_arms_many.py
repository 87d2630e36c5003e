"""Many postures and targets at once: the compiled loops answer as NumPy does, in no more memory than the answers."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from coplanar import Pose
from coplanar.arms import Arm, Reach, numerical
from coplanar.arms.posture import Posture, columns, linkage
from coplanar.engine import evaluator, reproducible
from coplanar.errors import InvalidValue
from coplanar.laws import arms as laws
from coplanar.solving import Status, code_of
from tests.engines import NEEDS_NUMBA

ROUNDING = 1e-13
ROWS = 700  # more than two blocks of the loops, and a part of one

CHAINS = [
    Arm((1.0, 0.9, 0.8, 0.7, 0.6, 0.5)),
    Arm((1.0, 0.8), angles="absolute", base=Pose(0.3, -0.2, 0.7), tool=Pose(0.1, 0.2, 0.3), bends=(0.1, -0.4)),
    Arm((1.0, 0.5, 0.3), joints="RPR", tool=Pose(0.1, 0.2, 0.3)),
    Arm((0.4, 0.2, 0.5), joints="PRR", angles="absolute", base=Pose(1.0, 2.0, -0.4), bends=(0.3, 0.0, 0.2)),
    Arm((0.0, 0.2), joints="PP", bends=(0.0, np.pi / 2)),
    Arm((0.7,)),
]
every_chain = pytest.mark.parametrize("arm", CHAINS, ids=lambda a: f"{a.joints}-{a.angles}")


def joints(arm, seed=0, rows=ROWS):
    q = np.random.default_rng(seed).uniform(-3.0, 3.0, (rows, arm.n))
    q[5::97, 0] = [1e6 + k for k in range(len(q[5::97]))]  # beyond what the fast sine holds for
    return q


def by_loops(arm, q, height=3):
    pose, points, jacobian = np.empty((3, len(q))), np.empty((len(q), arm.n + 2, 2)), np.empty((len(q), height, arm.n))
    linkage.places(arm.plan.table, q, pose, points, jacobian)
    return pose, points, jacobian


@NEEDS_NUMBA
@every_chain
def test_the_loop_of_places_answers_as_numpy_does(arm):
    q = joints(arm)
    pose, points, jacobian = by_loops(arm, q)
    posture = Posture.of(arm, q)
    size = 1.0 + np.abs(q).max(axis=1, keepdims=True)
    room = 1e3 * np.finfo(float).eps * size  # a large angle has large roundings, and a long slide too
    x, y = np.stack(posture.tip)
    assert np.all(np.abs(pose.T - np.stack((x, y, posture.angles[-1] + arm.tool.theta), axis=-1)) <= room)
    corners = np.stack([np.stack(np.broadcast_arrays(*p, q[:, 0])[:2], axis=-1) for p in [*posture.points, (x, y)]])
    assert np.all(np.abs(points - corners.swapaxes(0, 1)) <= room[:, None])
    table = np.stack([np.stack(np.broadcast_arrays(*c, q[:, 0])[:3]) for c in columns(arm, posture)])
    assert np.all(np.abs(jacobian - table.T) <= room[:, None])
    assert np.array_equal(by_loops(arm, q, 2)[2], jacobian[:, :2])


@every_chain
@pytest.mark.parametrize("lead", [(), (3,), (2, 1, 3), (40, 50)])
def test_kinematics_are_forward_and_jacobian_at_once(arm, lead):
    q = np.random.default_rng(1).uniform(-3.0, 3.0, (*lead, arm.n))
    for task in ("pose", "position"):
        pose, jacobian = arm.kinematics(q, task=task)
        assert pose == arm.forward(q)
        assert np.array_equal(jacobian, arm.jacobian(q, task=task))
        assert jacobian.shape == (*lead, 3 if task == "pose" else 2, arm.n)


@NEEDS_NUMBA
def test_a_large_batch_is_its_rows_whatever_its_shape_and_order():
    arm, q = CHAINS[0], joints(CHAINS[0], rows=24_000)
    pose, jacobian = arm.kinematics(q.reshape(4, 6000, 6))
    assert pose.shape == (4, 6000)
    assert jacobian.shape == (4, 6000, 3, 6)
    backwards = np.asfortranarray(q)
    backwards.flags.writeable = False
    assert np.array_equal(arm.jacobian(backwards), jacobian.reshape(-1, 3, 6))
    assert np.array_equal(arm.points(q.reshape(4, 6000, 6))[3, -1, -1], pose[3, -1].position)
    for row in (0, 5, 102, 23_999):
        assert np.allclose(arm.jacobian(q[row]), jacobian.reshape(-1, 3, 6)[row], atol=1e-9)
        assert arm.forward(q[row]).is_close(arm.forward(q)[row], distance=1e-9, angle=1e-9)


def searches(task, start, aims, tolerance=1e-9, iterations=100):
    """Both ways: joints, norm of the error, code, iterations."""
    both = [
        way(task, start, aims, tolerance, iterations, False)[:4] for way in (numerical._by_loops, numerical._by_rows)
    ]
    return [[np.asarray(part) for part in answer] for answer in both]


def problem(arm, rows, seed=0):
    """Generator, first guesses and targets that a free arm reaches."""
    rng = np.random.default_rng(seed)
    q = rng.uniform(-2.0, 2.0, (ROWS, arm.n))
    aims = arm.forward(q).as_array().T[:rows].copy()
    return rng, q + rng.normal(0.0, 0.3, q.shape), aims


SIX = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5)
SEARCHED = [
    Arm(SIX),
    Arm(SIX, limits=[(-1.5, 1.5)] * 6, base=Pose(0.3, -0.2, 0.7), tool=Pose(0.1, 0.2, 0.3)),
    Arm((1.0, 0.5, 0.3, 0.2), joints="RPRR", angles="absolute", limits=[None, (-0.2, 0.6), None, (-1.0, 1.0)]),
    Arm((1.0, 0.8)),
]


@NEEDS_NUMBA
@pytest.mark.parametrize("rows", [2, 3], ids=["position", "pose"])
@pytest.mark.parametrize("arm", SEARCHED, ids=lambda a: f"{a.joints}-{'free' if a.limits is None else 'limited'}")
def test_the_loop_of_searches_takes_the_steps_that_numpy_takes(arm, rows):
    if arm.n < rows:
        pytest.skip("fewer joints than equations are searched by NumPy alone")
    with reproducible():  # whatever another test has compiled
        _, start, aims = problem(arm, rows)
        loops, text = searches(numerical.Task(arm, rows), start, aims)
    reached = text[2] == code_of(Status.CONVERGED)
    assert reached.mean() > 0.15
    assert np.array_equal(loops[2] == code_of(Status.CONVERGED), reached)
    assert np.array_equal(loops[3][reached], text[3][reached])
    assert np.abs(loops[0] - text[0])[reached].max() < 1e-9
    # At a minimum out of reach the last steps are roundings: where they end is the same, not when.
    assert np.abs(loops[1] - text[1]).max() < ROUNDING
    assert (loops[2] == text[2]).mean() > 0.98
    assert np.all((loops[0] >= arm.lower) & (loops[0] <= arm.upper))


@NEEDS_NUMBA
@pytest.mark.parametrize("iterations", [0, 1, 3])
def test_a_spent_budget_says_so_row_by_row(iterations):
    arm = SEARCHED[0]
    _, start, aims = problem(arm, 2)
    aims[:, 7] = arm.forward(start[7]).position
    loops, text = searches(numerical.Task(arm, 2), start, aims, iterations=iterations)
    assert np.array_equal(loops[2], text[2])
    assert np.array_equal(loops[3], text[3])
    assert loops[2][7] == code_of(Status.CONVERGED)
    assert loops[3][7] == 0
    assert np.abs(loops[0] - text[0]).max() < ROUNDING * 10
    assert set(loops[3][loops[2] == code_of(Status.BUDGET_SPENT)].tolist()) == {iterations}


@NEEDS_NUMBA
def test_far_targets_singular_starts_and_large_angles_end_as_in_numpy():
    arm = SEARCHED[0]
    _, start, aims = problem(arm, 3)
    start[::3] = 0.0  # stretched along the x axis: J has not full rank
    aims[:, 1::3] = [[50.0], [0.0], [0.0]]  # out of reach
    start[2::3, 0] += 2e5 * np.pi  # beyond the fast sine
    loops, text = searches(numerical.Task(arm, 3), start, aims)
    assert np.isfinite(loops[0]).all()
    assert np.isfinite(loops[1]).all()
    assert (loops[2] == text[2]).mean() > 0.97
    assert np.all(loops[1][1::3] > 40.0)
    assert (loops[2] == code_of(Status.CONVERGED))[2::3].mean() > 0.9


@NEEDS_NUMBA
def test_many_targets_are_answered_with_a_status_each():
    arm = Arm(SIX)
    rng = np.random.default_rng(3)
    q = rng.uniform(-2.0, 2.0, (3000, 6))
    targets = arm.forward(q).position
    targets[::10] += 20.0
    for near in (None, q + rng.normal(0.0, 0.1, q.shape)):
        answer = arm.inverse(targets.reshape(3, 1000, 2), near=None if near is None else near.reshape(3, 1000, 6))
        code = answer.code.reshape(-1)
        assert np.all(code[::10] == code_of(Reach.TOO_FAR))
        assert np.delete(code, np.s_[::10]).max() == code_of(Reach.REACHED)
        assert np.allclose(answer.position_error(), answer.gap, atol=2e-9)
        assert answer.iterations.shape == (3, 1000)
        assert len(answer.report) == 0


def memory(call):
    """Bytes at the peak of a call, and what it returns."""
    call()
    tracemalloc.start()
    answer = call()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak, answer


@NEEDS_NUMBA
@pytest.mark.parametrize(
    ("ask", "bytes_per_row"),
    [
        # Answers, the columns that are kept of the targets, and a truth value for every number that is checked.
        (lambda q: Arm((1.0, 0.8)).inverse(q[:, :2]), 8 * (2 + 2) + 2),
        (lambda q: Arm(SIX).forward(q), 8 * 3 + 6),
        (lambda q: Arm(SIX).jacobian(q), 8 * 18 + 6),
        (lambda q: Arm(SIX).kinematics(q, task="position"), 8 * 15 + 6),
        (lambda q: Arm(SIX).points(q), 8 * 14 + 6),
    ],
    ids=["inverse", "forward", "jacobian", "kinematics", "points"],
)
def test_memory_is_that_of_the_answers(ask, bytes_per_row):
    q = np.random.default_rng(0).uniform(-1.0, 1.0, (100_000, 6))
    peak, _ = memory(lambda: ask(q))
    assert peak < 1.02 * bytes_per_row * len(q) + 500_000


ASKED = [
    {},
    {"elbow": -1},
    {"near": (3.0, -9.0)},
    {"near": (3.0, -9.0), "elbow": 1},
    {"tolerance": 0.1},
]
TWO = [
    Arm((1.0, 0.8)),
    Arm((1.0, 1.0), angles="absolute", base=Pose(0.3, -0.2, 0.7), tool=Pose(0.1, 0.2, 0.3), bends=(0.1, -0.4)),
    Arm((1.0, 0.8), limits=[(-1.0, 2.0), (-2.5, -0.2)]),
]
# Seen from the base every direction is as near, and limits leave out the base: which of their ends is taken there hangs
# on a rounding, how far off it is does not.
SURE_ON_THE_BASE = ("code", "gap", "iterations", "target")
ON_THE_BASE = 300
FIELDS = ("q", "branches", "allowed", "elbow", "code", "gap", "iterations", "target", "nearest")


@pytest.mark.parametrize("wish", ASKED, ids=str)
@pytest.mark.parametrize("arm", TWO, ids=["plain", "dressed", "limited"])
def test_one_target_is_answered_like_a_row_of_many(arm, wish):
    rng = np.random.default_rng(4)
    targets = np.concatenate((rng.uniform(-2.0, 2.0, (300, 2)), [[0.0, 0.0], [1.8, 0.0], [0.2, 0.0], [5.0, 1.0]]))
    many = arm.inverse(targets, **wish)
    for row in (*range(0, 300, 29), ON_THE_BASE, 301, 302, 303):
        for one in (arm.inverse(targets[row], **wish), arm.inverse(tuple(targets[row].tolist()), **wish)):
            for field in SURE_ON_THE_BASE if row == ON_THE_BASE and arm.limits is not None else FIELDS:
                ours, theirs = getattr(one, field), getattr(many, field)[row]
                assert np.shape(ours) == np.shape(theirs), field
                assert np.allclose(ours, theirs, atol=1e-12), (field, row)
            assert one.status is many.status[row]


@pytest.mark.parametrize("rows", [3, 30_000, 300_000])
@pytest.mark.parametrize("place", [(0,), (1,), (0, 1)], ids=str)
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_target_that_is_not_finite_is_refused_however_many_there_are(rows, place, value):
    targets = np.random.default_rng(6).uniform(-1.0, 1.0, (rows, 2))
    targets[rows // 2, place] = value
    for arm in (Arm((1.0, 0.8)), Arm((1.0, 0.8), base=Pose(1.0, 0.0, 0.3)), Arm((1.0, 0.8), limits=[(-1.0, 2.0)] * 2)):
        with pytest.raises(InvalidValue, match=rf"target.*finite numbers \(entry \({rows // 2}, {place[0]}\)"):
            arm.inverse(targets)


def test_targets_whose_sums_overflow_are_numbers():
    targets = np.full((30_000, 2), 1.7e308)
    assert set(Arm((1.0, 0.8)).inverse(targets).status) == {Reach.TOO_FAR}


def test_what_is_worked_out_later_does_not_see_what_became_of_the_callers_arrays():
    arm, targets = Arm((1.0, 0.8)), np.random.default_rng(5).uniform(-1.0, 1.0, (50, 2))
    expected = arm.inverse(targets.copy())
    answer = arm.inverse(targets)
    targets[:] = 0.0
    for field in FIELDS:
        assert np.array_equal(getattr(answer, field), getattr(expected, field)), field
    for field in ("q", "branches", "gap", "target"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(answer, field)[...] = 0.0


def test_the_chosen_branch_is_one_of_the_branches_to_the_last_bit():
    rng = np.random.default_rng(6)
    targets, elbow = rng.uniform(-1.0, 1.0, (200, 2)), np.where(rng.random(200) < 0.5, 1, -1)
    for wish in ({}, {"elbow": elbow}, {"near": rng.uniform(-3.0, 3.0, (200, 2))}):
        answer = Arm((1.0, 0.8)).inverse(targets, **wish)
        place = (1 - answer.elbow) // 2
        assert np.array_equal(answer.q, answer.branches[np.arange(200), place])


def test_an_answer_shows_how_it_ended():
    assert "REACHED" not in repr(Arm((1.0, 0.8)).inverse((1.0, 0.0)))
    assert (
        repr(Arm((1.0, 0.8)).inverse([[1.0, 0.0], [3.0, 0.0]])) == "Solution(1 REACHED, 1 TOO_FAR; q of shape (2, 2))"
    )


def test_sums_of_joints_that_overflow_are_not_a_mistake_of_math():
    assert np.isnan(Arm((1.0, 1.0)).forward([1.7e308, 1.7e308]).x)


@pytest.mark.parametrize("rows", [3, 30_000])
def test_results_are_written_where_the_caller_wants_them(rows):
    if rows > 1000:
        pytest.importorskip("numba")
    law = evaluator(laws.link)
    angle = np.linspace(-3.0, 3.0, rows)
    table = np.empty((2, rows))
    law.into((table[0], table[1]), 0.5, 0.0, angle, 2.0)
    assert np.allclose(table, [0.5 + 2.0 * np.cos(angle), 2.0 * np.sin(angle)], atol=1e-14)


@NEEDS_NUMBA
def test_the_laws_of_arms_that_serve_batches_are_compiled_with_the_fast_primitives():
    from coplanar.engine.compiled.doubt import shows_every_nan

    served = (laws.two_link_turns, laws.two_link_reach, laws.joint_near, laws.joint_within, laws.joint_link)
    assert all(shows_every_nan(law) for law in served)
