"""A single wheel: edges and messages."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar.errors import InvalidValue
from coplanar.wheels import RollingWheel


@pytest.mark.parametrize("radius", [0.0, -0.1, np.nan, np.inf, "wide", [0.1, 0.0]])
def test_radius_must_be_positive(radius):
    with pytest.raises(InvalidValue, match="radius"):
        RollingWheel(radius)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_nothing_that_is_not_finite_comes_out(bad):
    wheel = RollingWheel(0.1)
    for call in (wheel.centre_speed, wheel.rate, wheel.contact_velocity, wheel.rim_position, wheel.rim_path):
        with pytest.raises(InvalidValue):
            call(bad)
    for call in (wheel.slip, wheel.rim_velocity):
        with pytest.raises(InvalidValue):
            call(1.0, bad)
    with pytest.raises(InvalidValue, match="slip"):
        wheel.centre_speed(1.0, slip=bad)


def test_signs_of_slip():
    """A spinning wheel is ahead of its centre: negative; a locked one is dragged: positive."""
    wheel = RollingWheel(0.1)
    assert wheel.slip(0.0, 10.0) == -1.0
    assert wheel.slip(1.0, 0.0) == 1.0
    assert wheel.contact_velocity(0.0, slip=1.0).tolist() == [1.0, 0.0]


def test_wheels_of_many_sizes():
    wheel = RollingWheel([0.1, 0.2])
    assert wheel.centre_speed(10.0).tolist() == [1.0, 2.0]
    assert wheel.rim_velocity(np.zeros((3, 1)), 0.0).shape == (3, 2, 2)
    assert not wheel.radius.flags.writeable
    assert type(RollingWheel(1).centre_speed(2)) is float
