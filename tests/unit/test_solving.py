"""Root finders: what they find, what they say when there is nothing to find, what they refuse."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import optimize

from coplanar.errors import InvalidShape, InvalidValue, NoSolution, UnknownName
from coplanar.solving import Status, bracketed_root, count_by_status, least_squares


def two_link_miss(q):
    a, b = q[..., 0], q[..., 0] + q[..., 1]
    return np.stack((0.5 * np.cos(a) + 0.5 * np.cos(b) - 0.5, 0.5 * np.sin(a) + 0.5 * np.sin(b)), axis=-1)


def two_link_slope(q):
    a, b = q[..., 0], q[..., 0] + q[..., 1]
    first = np.stack((-0.5 * np.sin(a) - 0.5 * np.sin(b), -0.5 * np.sin(b)), axis=-1)
    second = np.stack((0.5 * np.cos(a) + 0.5 * np.cos(b), 0.5 * np.cos(b)), axis=-1)
    return np.stack((first, second), axis=-2)


@settings(deadline=None, max_examples=60)
@given(root=st.floats(-5, 5), below=st.floats(1e-3, 10), above=st.floats(1e-3, 10), power=st.sampled_from([1, 3, 5]))
def test_a_bracketed_root_is_found_by_either_method(root, below, above, power):
    def f(x):
        return (x - root) ** power + 0.1 * (x - root)

    one = bracketed_root(f, root - below, root + above)
    many = bracketed_root(f, np.array([root - below, root + above]), np.array([root + above, root - below]))
    assert isinstance(one.x, float)
    assert abs(one.x - root) <= 2e-12
    assert np.abs(many.x - root).max() <= 2e-12
    assert one.converged
    assert many.converged.all()
    assert one.residual() == one.value


def test_an_end_that_is_the_root_is_the_answer():
    for lower, upper in ((0.0, 1.0), (-1.0, 0.0), (0.0, 0.0)):
        one = bracketed_root(lambda x: x, lower, upper)
        many = bracketed_root(lambda x: x, np.array([lower]), np.array([upper]))
        assert (one.x, one.status, one.iterations) == (0.0, Status.BRACKETED, 0)
        assert (many.x[0], many.status[0]) == (0.0, Status.BRACKETED)


def test_without_a_sign_change_the_answer_is_no():
    one = bracketed_root(lambda x: x * x + 1.0, -1.0, 2.0)
    assert one.status is Status.NO_SIGN_CHANGE
    assert (one.x, one.value) == (-1.0, 2.0)
    with pytest.raises(NoSolution, match="one sign at both ends") as refusal:
        one.or_raise()
    assert refusal.value.result is one
    many = bracketed_root(lambda x: x * x - 1.0, np.array([0.0, 2.0]), np.array([3.0, 3.0]))
    assert [s.name for s in many.status] == ["BRACKETED", "NO_SIGN_CHANGE"]
    assert many.x.tolist() == pytest.approx([1.0, 2.0])
    with pytest.raises(NoSolution, match="1 BRACKETED, 1 NO_SIGN_CHANGE"):
        many.or_raise()


def test_what_is_not_a_number_is_said_to_be_none():
    def f(x):
        return np.where(np.abs(x - 0.5) < 0.2, np.nan, x - 0.5)

    assert bracketed_root(f, 0.0, 1.0).status is Status.NOT_FINITE
    assert bracketed_root(f, 0.0, 0.5).status is Status.NOT_FINITE
    batch = bracketed_root(f, np.zeros(2), np.array([1.0, 0.5]))
    assert [s.name for s in batch.status] == ["NOT_FINITE", "NOT_FINITE"]


def test_a_spent_budget_says_so():
    assert bracketed_root(math.sin, 3.0, 4.0, iterations=1).status is Status.BUDGET_SPENT
    assert bracketed_root(np.sin, np.full(3, 3.0), np.full(3, 4.0), iterations=1).status[0] is Status.BUDGET_SPENT


def test_a_jump_shows_in_its_value():
    jump = bracketed_root(lambda x: 1.0 / (x - 0.3), np.zeros(1), np.ones(1))
    assert jump.x[0] == pytest.approx(0.3)
    assert abs(jump.value[0]) > 1e9


def test_a_batch_of_brackets_has_the_shape_of_its_ends():
    c = np.linspace(0.1, 5.0, 12).reshape(3, 1, 4)
    answer = bracketed_root(lambda x: x**3 - c, np.zeros((3, 1, 4)), 3.0)
    assert np.allclose(answer.x, np.cbrt(c), atol=1e-12)
    assert answer.iterations.shape == answer.code.shape == c.shape
    assert answer.iterations.max() < 15


def test_errors_of_the_user_s_function_are_the_users():
    def f(x):
        if 0.2 < x < 0.8:
            raise ValueError("mine")
        return x - 0.5

    with pytest.raises(ValueError, match="mine"):
        bracketed_root(f, 0.0, 1.0)


@pytest.mark.parametrize(
    ("ask", "error"),
    [
        (lambda: bracketed_root(math.sin, float("nan"), 1.0), InvalidValue),
        (lambda: bracketed_root(math.sin, 0.0, 1.0, tolerance=-1.0), InvalidValue),
        (lambda: bracketed_root(math.sin, 0.0, 1.0, iterations=0), InvalidValue),
        (lambda: bracketed_root(np.sin, np.zeros(2), np.zeros(3)), InvalidShape),
        (lambda: least_squares(two_link_miss, [np.inf, 0.0]), InvalidValue),
        (lambda: least_squares(two_link_miss, 1.0), InvalidShape),
        (lambda: least_squares(two_link_miss, [0.1, 0.1], method="gauss"), UnknownName),
        (lambda: least_squares(two_link_miss, [0.1, 0.1], tolerance=-1.0), InvalidValue),
        (lambda: least_squares(two_link_miss, [0.1, 0.1], iterations=-1), InvalidValue),
        (lambda: least_squares(two_link_miss, [0.1, 0.1], longest_step=0.0), InvalidValue),
        (lambda: least_squares(two_link_miss, [0.1, 0.1], bounds=(1.0, 0.0)), InvalidValue),
        (lambda: least_squares(two_link_miss, [0.1, 0.1], bounds=(np.zeros(3), 1.0)), InvalidShape),
        (lambda: least_squares(two_link_miss, np.zeros((3, 2)), parameters=(np.zeros(4),)), InvalidShape),
        (lambda: least_squares(lambda x: x.sum(), np.zeros((3, 2))), InvalidShape),
    ],
)
def test_what_cannot_be_solved_is_refused(ask, error):
    with pytest.raises(error):
        ask()


@pytest.mark.parametrize("method", ["damped", "newton"])
@pytest.mark.parametrize("slope", [None, two_link_slope])
def test_the_demo_converges_and_every_iteration_is_in_the_report(method, slope):
    answer = least_squares(two_link_miss, [0.1, 0.1], jacobian=slope, method=method)
    assert answer.status is Status.CONVERGED
    assert answer.residual() < 1e-12
    assert len(answer.report) == answer.iterations + 1
    assert answer.report[-1].x == tuple(answer.x.tolist())
    calls = [i.evaluations for i in answer.report]
    assert calls == [1 + k * (1 if slope else 5) for k in range(len(calls))]
    assert answer.report.rows[0][:3] == (0, 1, pytest.approx(float(np.hypot(*two_link_miss(np.array([0.1, 0.1]))))))
    assert all(i.damping == 0.0 for i in answer.report) == (method == "newton")


def test_near_a_root_convergence_is_quadratic():
    report = least_squares(two_link_miss, [-1.0, 2.0], jacobian=two_link_slope, tolerance=1e-14).report
    norms = [i.residual for i in report]
    assert norms[2] < 20 * norms[1] ** 2


def test_agrees_with_scipy_on_an_overdetermined_fit():
    t = np.linspace(0.0, 2.0, 9)
    data = 2.0 * np.exp(-1.3 * t) + 0.05 * np.cos(9.0 * t)

    def miss(x):
        return x[..., 0, None] * np.exp(x[..., 1, None] * t) - data

    ours = least_squares(miss, [1.0, 0.0], iterations=200)
    theirs = optimize.least_squares(miss, [1.0, 0.0], xtol=1e-15, ftol=1e-15, gtol=1e-15)
    assert ours.status is Status.STALLED
    assert np.allclose(ours.x, theirs.x, atol=1e-6)


def test_bounds_hold_the_answer_and_agree_with_scipy():
    bounds = (np.array([-0.5, -0.5]), np.array([0.5, 1.5]))
    ours = least_squares(two_link_miss, [0.1, 0.1], jacobian=two_link_slope, bounds=bounds)
    theirs = optimize.least_squares(two_link_miss, [0.1, 0.1], bounds=bounds)
    assert np.allclose(ours.x, theirs.x, atol=1e-6)
    assert not ours.converged
    with pytest.raises(NoSolution, match="no small step"):
        ours.or_raise()


def test_a_batch_is_the_same_as_its_rows_and_takes_parameters():
    def miss(x, goal):
        return np.stack((x[..., 0] ** 2 + x[..., 1], x[..., 1] - x[..., 0]), axis=-1) - goal

    start = np.full((2, 3, 2), 2.0)
    goals = np.random.default_rng(0).uniform(0.0, 1.0, (2, 3, 2)) + np.array([3.0, 0.0])
    batch = least_squares(miss, start, parameters=(goals,))
    assert batch.x.shape == (2, 3, 2)
    assert batch.converged.all()
    assert len(batch.report) == 0
    assert batch.residual().max() < 1e-12
    for index in np.ndindex(2, 3):
        one = least_squares(miss, start[index], parameters=(goals[index],))
        assert np.allclose(one.x, batch.x[index], atol=1e-9)
    assert batch.or_raise() is batch
    assert count_by_status(Status, batch.code) == "6 CONVERGED"


def test_newton_says_that_the_jacobian_is_singular_and_the_damped_step_stalls_there():
    straight = [0.0, 0.0]
    assert least_squares(two_link_miss, straight, jacobian=two_link_slope, method="newton").status is Status.SINGULAR
    damped = least_squares(two_link_miss, straight, jacobian=two_link_slope)
    assert damped.status is Status.STALLED
    assert damped.x.tolist() == straight


def test_a_residual_that_is_not_finite_is_said_to_be_none():
    answer = least_squares(lambda x: np.log(x), [-1.0])
    assert answer.status is Status.NOT_FINITE
    shy = least_squares(lambda x: np.where(x > 0.0, np.log(np.abs(x)), np.nan), [8.0], damping=1e-6)
    assert shy.converged
    assert shy.x[0] == pytest.approx(1.0)


def test_steps_are_no_longer_than_asked():
    report = least_squares(two_link_miss, [0.1, 0.1], longest_step=0.3).report
    assert max(i.step for i in report) <= 0.3 + 1e-15


def test_a_table_has_a_line_for_every_iteration():
    report = least_squares(two_link_miss, [0.1, 0.1], jacobian=two_link_slope).report
    lines = report.table().splitlines()
    assert len(lines) == len(report) + 1
    assert lines[0].split()[:2] == ["Iteration", "Evaluations"]
    assert [int(line.split()[0]) for line in lines[1:]] == list(range(len(report)))


@pytest.mark.parametrize("rows", [1, 2, 3])
def test_the_damped_step_is_the_one_of_the_normal_equations(rows):
    slopes = np.random.default_rng(rows).uniform(-1.0, 1.0, (rows, 2))

    def miss(x):
        return x @ slopes.T - np.ones(rows)

    report = least_squares(miss, [0.3, -0.2], jacobian=lambda _: slopes, damping=0.3).report
    start, lam = np.array(report[0].x), report[1].damping
    expected = np.linalg.solve(slopes.T @ slopes + lam * np.eye(2), -slopes.T @ miss(start))
    assert lam == pytest.approx(0.3 * miss(start) @ miss(start))
    assert np.allclose(np.array(report[1].x) - start, expected, atol=1e-14)


@pytest.mark.parametrize("corner", [(0.0, 0.0), (3.0, 3.0), (0.0, 3.0)])
def test_a_start_at_a_bound_leaves_it_and_a_blocked_entry_lets_the_others_go_on(corner):
    def miss(x):
        return np.stack((x[..., 0] - 1.0, x[..., 1] - 2.0), axis=-1)

    assert least_squares(miss, corner, bounds=(0.0, 3.0)).converged

    def bent(x):
        return np.stack((x[..., 0] + x[..., 1] - 5.0, x[..., 0] - x[..., 1]), axis=-1)

    held = least_squares(bent, [1.0, 0.0], bounds=([0.0, 0.0], [1.0, 9.0]))
    assert np.allclose(held.x, [1.0, 2.5], atol=1e-6)
    assert held.iterations < 20
