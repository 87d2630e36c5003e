"""Numbers as people write them."""

from __future__ import annotations

from math import pi

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic_core import PydanticCustomError

from coplanar.scenarios import quantities as q
from coplanar.scenarios.arithmetic import UNITS, measured


@pytest.mark.parametrize(
    ("dimension", "given_", "value"),
    [
        (q.LENGTH, 2, 2.0),
        (q.LENGTH, "0.5 m", 0.5),
        (q.LENGTH, "20cm", 0.2),
        (q.LENGTH, "12 in", 0.3048),
        (q.LENGTH, "1e-3", 1e-3),
        (q.LENGTH, "-1.5e2 mm", -0.15),
        (q.ANGLE, "30 deg", pi / 6),
        (q.ANGLE, "-90°", -pi / 2),
        (q.ANGLE, "pi/2", pi / 2),
        (q.ANGLE, "2*pi", 2 * pi),
        (q.ANGLE, "-(1/4 + 0.5) * π rad", -0.75 * pi),
        (q.ANGLE, "1 rev", 2 * pi),
        (q.TURN_RATE, "90 deg/s", pi / 2),
        (q.TURN_RATE, "60 rpm", 2 * pi),
        (q.SPEED, "3.6 km/h", 1.0),
        (q.SPEED, "1 m / s", 1.0),
        (q.ACCELERATION, "2 m/s^2", 2.0),
        (q.ACCELERATION, "2 m/s²", 2.0),
        (q.ACCELERATION, "2 m/s2", 2.0),
        (q.TURN_ACCELERATION, "180 deg/s^2", pi),
        (q.TIME, "10 ms", 0.01),
        (q.TIME, "2 min", 120.0),
        (q.MASS, "150 g", 0.15),
        (q.DRAG, "20 g/m", 0.02),
        (q.AREA, "12 cm^2", 12e-4),
        (q.RATE, "100/s", 100.0),
        (q.RATE, "100 1/s", 100.0),
        (q.DRAG_PER_MASS, "0.02/m", 0.02),
        (q.DENSITY, "1.2 kg/m^3", 1.2),
        (q.NUMBER, "3/4", 0.75),
        (q.JOINT, "10 cm", 0.1),
        (q.JOINT, "180 deg", pi),
    ],
)
def test_read(dimension, given_, value):
    assert q.Quantity(dimension).read(given_) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    ("dimension", "given_", "words"),
    [
        (q.LENGTH, "30 deg", "its unit is that of an angle; write it like '20 cm'"),
        (q.ANGLE, "3 m/s", "that of a speed"),
        (q.LENGTH, "3 m^3", "another one"),
        (q.LENGTH, "3 metres", "no unit that is known here"),
        (q.ANGLE, "30 dge", "did you mean 'deg'?"),
        (q.LENGTH, True, "yes and no are no numbers"),
        (q.LENGTH, None, ""),
        (q.LENGTH, [1], ""),
        (q.LENGTH, float("nan"), "finite"),
        (q.LENGTH, float("-inf"), "finite"),
        (q.LENGTH, 10**400, "finite"),
        (q.LENGTH, "1e400", "finite"),
        (q.LENGTH, "1/0", "divides by 0"),
        (q.LENGTH, "", "nothing"),
        (q.LENGTH, "1 +", "nothing"),
        (q.LENGTH, "(1", "bracket"),
        (q.LENGTH, "1 m (2)", "unit should end"),
        (q.LENGTH, "1 m^9", "exponent"),
        (q.LENGTH, "1 m/", "no unit"),
        (q.LENGTH, "__import__('os')", "belongs to no number"),
        (q.LENGTH, "1" * 100, "at most 80 characters"),
    ],
)
def test_refused(dimension, given_, words):
    with pytest.raises(PydanticCustomError) as caught:
        q.Quantity(dimension).read(given_)
    assert words in caught.value.context["remedy"]
    assert caught.value.context["needed"].startswith(dimension.name)


@pytest.mark.parametrize(
    ("quantity", "good", "bad", "words"),
    [
        (q.Quantity(q.LENGTH, above=0.0), 1e-9, 0.0, "above 0"),
        (q.Quantity(q.LENGTH, least=0.0), 0.0, -1e-9, "at least 0"),
        (q.Quantity(q.LENGTH, below=2.0), 1.9, 2.0, "below 2"),
        (q.Quantity(q.LENGTH, most=2.0), 2.0, 2.1, "at most 2"),
    ],
)
def test_bounds(quantity, good, bad, words):
    assert quantity.read(good) == good
    with pytest.raises(PydanticCustomError) as caught:
        quantity.read(bad)
    assert words in caught.value.context["needed"]


@settings(deadline=None, max_examples=60)
@given(st.floats(-1e9, 1e9), st.sampled_from(sorted(UNITS)))
def test_a_unit_is_a_factor(number, unit):
    read = measured(f"{number!r} {unit}")
    assert read.value == pytest.approx(number * UNITS[unit][0], rel=1e-15)
    assert read.dimensions == UNITS[unit][1]


@settings(deadline=None, max_examples=60)
@given(st.lists(st.tuples(st.sampled_from("+-*/"), st.floats(0.1, 10.0)), min_size=1, max_size=4), st.floats(0.1, 10.0))
def test_arithmetic_is_that_of_python(rest, first):
    """Only texts made here are given to Python's own arithmetic."""
    text = f"{first:.2f}" + "".join(f"{sign}{value:.2f}" for sign, value in rest)
    assert measured(text).value == pytest.approx(eval(text), rel=1e-12, abs=1e-12)
