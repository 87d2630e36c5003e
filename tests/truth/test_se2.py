"""exp, log, their Jacobians and the wrapped angle against 50 digits, and against WPILib where it is exact."""

from __future__ import annotations

import math

import numpy as np
import pytest

from coplanar import Displacement
from coplanar.laws import se2
from tests.engines import ENGINES, on_engine
from tests.truth.golden import golden, relative_error

TRUTH = golden("se2")


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("kind", ["exp", "log"])
def test_every_entry_is_right_to_the_last_digits(kind, engine):
    given, truth = TRUTH.column("given", kind).T, TRUTH.column("result", kind).T
    x, y, turn = on_engine(engine, getattr(se2, kind), *given)
    assert np.array_equal(turn, truth[2])
    pure = (given[0] == 0.0) | (given[1] == 0.0)  # one number in: no sum in which anything could cancel
    assert pure.sum() > 100
    for value, right in ((x, truth[0]), (y, truth[1])):
        assert np.max(relative_error(value, right)[pure]) <= TRUTH.tolerance[kind]
    assert np.max(np.hypot(x - truth[0], y - truth[1]) / np.hypot(truth[0], truth[1])) <= TRUTH.tolerance[kind]


def test_jacobians():
    given, limit = TRUTH.column("given", "jacobian").T, TRUTH.tolerance["jacobian"]
    xi = Displacement(*given)
    assert np.max(np.abs(xi.exp_jacobian() - TRUTH.column("exp", "jacobian"))) <= limit
    assert np.max(np.abs(xi.right_jacobian() - TRUTH.column("right", "jacobian"))) <= limit


@pytest.mark.parametrize("engine", ENGINES)
def test_wrap_is_exact(engine):
    (wrapped,) = on_engine(engine, se2.wrap, TRUTH.column("given", "wrap"))
    assert np.array_equal(wrapped, TRUTH.column("result", "wrap"))


@pytest.mark.parametrize("kind", ["exp", "log"])
def test_wpilib_agrees_where_it_is_exact(kind):
    """WPILib's own error against 50 digits is noted case by case; it loses digits at small angles, and only there."""
    given, wpilib = TRUTH.column("given", kind).T, TRUTH.column("wpilib", kind).T
    limit = TRUTH.tolerance["wpilib"]
    exact = TRUTH.column("off", kind) <= limit
    ours = on_engine("text", getattr(se2, kind), *given)
    for value, theirs in zip(ours[:2], wpilib[:2], strict=True):
        assert np.max(relative_error(value, theirs)[exact]) <= 2.0 * limit
    assert exact.mean() > 0.8
    assert np.max(np.abs(given[2][~exact])) <= 1e-3


def test_wpilib_loses_the_lateral_part_of_a_tiny_turn():
    case = next(c for c in TRUTH.of("exp") if c["given"] == [1.0, 0.0, 1e-8])
    assert relative_error(case["wpilib"][1], case["result"][1]) == pytest.approx(1.0)
    assert relative_error(se2.exp(*map(np.asarray, case["given"]))[1], case["result"][1]) < math.ulp(1.0)
