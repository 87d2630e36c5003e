"""Edges and error messages of the integrators."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar.errors import InvalidShape, InvalidValue, NoSolution, UnknownName
from coplanar.integrators import METHODS, ButcherTableau, integrate_ode


def decay(t, y):
    return -y


@pytest.mark.parametrize("t", [[0.0, 1.0, 1.0], [0.0, 1.0, 0.5], [0.0, 0.0]])
def test_times_must_be_monotone(t):
    with pytest.raises(InvalidValue, match="strictly monotone"):
        integrate_ode(decay, t, 1.0)


@pytest.mark.parametrize("t", [[0.0], 1.0, [[0.0, 1.0]]])
def test_times_must_be_a_vector(t):
    with pytest.raises(InvalidShape, match=r"^t with shape"):
        integrate_ode(decay, t, 1.0)


@pytest.mark.parametrize("t", [[0.0, np.nan], [0.0, np.inf]])
def test_times_must_be_finite(t):
    with pytest.raises(InvalidValue, match="finite"):
        integrate_ode(decay, t, 1.0)


def test_state_must_be_finite():
    with pytest.raises(InvalidValue, match="y0"):
        integrate_ode(decay, [0.0, 1.0], [1.0, np.nan])


@pytest.mark.parametrize("method", ["euler", "RK45"])
def test_rates_of_another_shape_are_reported_at_the_first_step(method):
    calls = []

    def wrong(t, y):
        calls.append(t)
        return y[:2]

    with pytest.raises(InvalidShape, match=r"rates with .*\(2,\).* at t = 3.*needed shape \(3,\), that of the state"):
        integrate_ode(wrong, [3.0, 4.0, 5.0], np.zeros(3), method=method)
    assert calls == [3.0]


def test_rates_that_broadcast_are_reported_too():
    with pytest.raises(InvalidShape, match="rates"):
        integrate_ode(lambda *_: 1.0, [0.0, 1.0], np.zeros(3))


def test_methods_have_names():
    with pytest.raises(UnknownName, match=r"euler, heun, midpoint, rk4; did you mean 'rk4'"):
        integrate_ode(decay, [0.0, 1.0], 1.0, method="rk44")


def test_divergence_says_when():
    with pytest.raises(InvalidValue, match=r"diverged at t = 20 \(step 2\): take shorter steps"):
        integrate_ode(lambda _, y: y**3, np.arange(0.0, 60.0, 10.0), 1e60, method="euler")


def test_a_method_that_gives_up_keeps_its_answer():
    with pytest.raises(NoSolution, match=r"RK45 stopped within t = 0 \.\.\. 3") as caught:
        integrate_ode(lambda _, y: y**2, [0.0, 3.0], 1.0, method="RK45")
    assert not caught.value.result.success


@pytest.mark.parametrize("held", [[1.0], [1.0, 2.0, 3.0], 1.0])
def test_held_inputs_are_one_for_each_interval(held):
    with pytest.raises(InvalidShape, match="one input for each interval"):
        integrate_ode(lambda *_: 0.0, [0.0, 1.0, 2.0], 0.0, held=held)


def test_tables_are_checked():
    with pytest.raises(InvalidShape, match="rows of 0, 1"):
        ButcherTableau("implicit", 1, ((1.0,),), (1.0,), (1.0,))
    with pytest.raises(InvalidValue, match=r"sum\(b\) = 1"):
        ButcherTableau("light", 1, ((),), (0.9,), (0.0,))
    with pytest.raises(InvalidValue, match=r"sum\(a_i\) = c_i"):
        ButcherTableau("late", 2, ((), (0.5,)), (0.0, 1.0), (0.0, 1.0))


def test_a_table_of_your_own():
    ralston = ButcherTableau("ralston", 2, ((), (2 / 3,)), (0.25, 0.75), (0.0, 2 / 3))
    states = integrate_ode(decay, np.linspace(0.0, 1.0, 101), 1.0, method=ralston)
    np.testing.assert_allclose(states[-1], np.exp(-1.0), atol=1e-5)


def test_tables_cannot_be_changed():
    with pytest.raises(TypeError):
        METHODS["rk4"] = METHODS["euler"]
    with pytest.raises(AttributeError):
        METHODS["rk4"].order = 5


def test_the_state_of_the_caller_is_left_alone():
    y0 = np.ones(2)
    integrate_ode(decay, [0.0, 1.0], y0)
    assert y0.tolist() == [1.0, 1.0]
