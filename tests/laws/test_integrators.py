"""Orders of convergence, the conditions on the tables, and the shapes that integrators keep."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar.integrators import METHODS, SCIPY_METHODS, integrate_ode

SHAPES = [(), (1,), (3, 1, 2)]
ERROR_OF = {"euler": 1, "midpoint": 2, "heun": 2, "rk4": 4}


def trees(A, b, c):
    """Butcher's conditions up to order 4: (order, sum over the table, what it must be)."""
    return [
        (1, b.sum(), 1.0),
        (2, b @ c, 1 / 2),
        (3, b @ c**2, 1 / 3),
        (3, b @ A @ c, 1 / 6),
        (4, b @ c**3, 1 / 4),
        (4, (b * c) @ A @ c, 1 / 8),
        (4, b @ A @ c**2, 1 / 12),
        (4, b @ A @ A @ c, 1 / 24),
    ]


@pytest.mark.parametrize("name", METHODS)
def test_tables_meet_the_conditions_of_their_order_and_not_of_the_next(name):
    table = METHODS[name]
    assert table.order == ERROR_OF[name]
    stages = len(table.b)
    A = np.array([[*row, *[0.0] * (stages - len(row))] for row in table.a])
    b, c = np.array(table.b), np.array(table.c)
    np.testing.assert_allclose(A.sum(axis=1), c, atol=1e-15)
    for order, total, needed in trees(A, b, c):
        if order <= table.order:
            np.testing.assert_allclose(total, needed, atol=1e-15)
    beyond = [abs(total - needed) for order, total, needed in trees(A, b, c) if order == table.order + 1]
    assert not beyond or max(beyond) > 1e-3


@pytest.mark.parametrize("name", METHODS)
def test_orders_of_convergence(name):
    """Halving the step divides the error by 2^order, on a problem that changes with time and state."""

    def error(steps):
        t = np.linspace(0.0, 2.0, steps + 1)
        return abs(integrate_ode(lambda t, y: y * np.cos(t), t, 1.0, method=name)[-1] - np.exp(np.sin(2.0)))

    assert abs(np.log2(error(200) / error(400)) - METHODS[name].order) < 0.1


@pytest.mark.parametrize("method", [*METHODS, *SCIPY_METHODS])
@pytest.mark.parametrize("shape", SHAPES)
def test_any_shape_up_and_down(method, shape):
    rng = np.random.default_rng(1)
    y0, t = rng.uniform(0.5, 1.0, shape), np.concatenate([np.linspace(0.0, 1.0, 80), [1.01, 1.05]])
    for times in (t, t[::-1]):
        states = integrate_ode(lambda t, y: -y * t, times, y0, method=method, relative_tolerance=1e-6)
        assert states.shape == (82, *shape)
        exact = y0 * np.exp(0.5 * (times[0] ** 2 - times[-1] ** 2))
        np.testing.assert_allclose(states[-1], exact, rtol=2e-2 if method == "euler" else 1e-3)


@given(seed=st.integers(0, 2**32 - 1), name=st.sampled_from(list(METHODS)))
@settings(deadline=None, max_examples=30)
def test_there_and_back(seed, name):
    """A step back undoes a step to the order of the method."""
    rng = np.random.default_rng(seed)
    t = np.cumsum(rng.uniform(0.005, 0.01, 20))
    y0 = rng.uniform(-1, 1, 2)
    there = integrate_ode(_pendulum, t, y0, method=name)[-1]
    back = integrate_ode(_pendulum, t[::-1], there, method=name)[-1]
    np.testing.assert_allclose(back, y0, atol=0.3 * 0.01 ** METHODS[name].order + 1e-9)


@pytest.mark.parametrize("method", [*METHODS, "DOP853", "LSODA"])
def test_held_inputs_do_not_leak_into_the_next_interval(method):
    """With y' = u every method is exact, if it holds u to the very end of each interval."""
    t, u = np.array([0.0, 0.5, 2.0, 2.25]), np.array([1.0, -2.0, 8.0])
    states = integrate_ode(lambda _, y, u: u + 0.0 * y, t, 0.0, method=method, held=u)
    np.testing.assert_allclose(states, [0.0, 0.5, -2.5, -0.5], atol=1e-9)


@pytest.mark.parametrize("method", [*METHODS, *SCIPY_METHODS])
def test_all_methods_agree(method):
    t = np.linspace(0.0, 1.0, 4001 if method in ("euler", "midpoint", "heun") else 201)
    end = integrate_ode(_pendulum, t, [0.4, 0.0], method=method, relative_tolerance=1e-9)[-1]
    reference = integrate_ode(_pendulum, [0.0, 1.0], [0.4, 0.0], method="DOP853", relative_tolerance=1e-12)[-1]
    np.testing.assert_allclose(end, reference, atol=2e-4 if method == "euler" else 1e-6)


def _pendulum(t, y):
    return np.array([y[1], -np.sin(y[0])])
