"""Tables of wheels: constructors, names, conventions, batches, messages."""

from __future__ import annotations

import dataclasses
import pickle
from math import cos, pi, sin

import numpy as np
import pytest

from coplanar import Displacement, Twist
from coplanar.errors import InvalidShape, InvalidValue, UnknownName
from coplanar.wheels import Wheel, WheeledBase


def mecanum(**kwargs):
    return WheeledBase.mecanum(**{"radius": 0.1, "half_length": 0.3, "half_width": 0.2, **kwargs})


def differential(**kwargs):
    return WheeledBase.differential(**{"radius": 0.1, "half_track": 0.25, **kwargs})


def test_half_track_and_track():
    """The half and the whole are told apart by name; a mix-up would double omega."""
    assert differential() == WheeledBase.differential(track=0.5, radius=0.1)
    assert differential().forward([0.0, 10.0]).omega == pytest.approx(2.0)
    assert WheeledBase.differential(half_track=0.5, radius=0.1).forward([0.0, 10.0]).omega == pytest.approx(1.0)
    for lengths in ({}, {"track": 0.5, "half_track": 0.25}):
        with pytest.raises(InvalidValue, match="track is twice half_track"):
            WheeledBase.differential(radius=0.1, **lengths)


def test_halves_of_a_mecanum_base():
    assert mecanum() == WheeledBase.mecanum(radius=0.1, wheelbase=0.6, track=0.4)
    for lengths in ({"half_length": 0.3}, {"half_width": 0.3}, {"half_length": 0.3, "half_width": 0.2, "track": 0.4}):
        with pytest.raises(InvalidValue, match="exactly one of them"):
            WheeledBase.mecanum(radius=0.1, **lengths)


def test_left_and_right():
    """A faster right wheel turns to the left; the order of the rates is that of the names."""
    base = differential()
    assert base.names == ("left", "right")
    assert base.forward(base.rates(right=2.0, left=1.0)).omega > 0.0
    assert base.rates(right=2.0, left=1.0).tolist() == [1.0, 2.0]
    assert base.by_name(base.inverse(Twist(0.0, 0.0, 1.0))) == {"left": -2.5, "right": 2.5}


def test_forward_means_wheels_to_body():
    base = differential()
    assert isinstance(base.forward([1.0, 1.0]), Twist)
    assert isinstance(base.inverse(Twist(1.0, 0.0, 0.0)), np.ndarray)
    assert isinstance(base.displacement([1.0, 1.0]), Displacement)


def test_unequal_radii():
    """A wheel 1 % larger bends the straight line by a hundredth of v over the track."""
    base = WheeledBase.differential(track=0.5, left_radius=0.1, right_radius=0.101)
    twist = base.forward([10.0, 10.0])
    assert twist.omega == pytest.approx(0.02)
    assert twist.vx == pytest.approx(1.005)
    for radii in (
        {}, {"left_radius": 0.1}, {"right_radius": 0.1}, {"radius": 0.1, "left_radius": 0.1},
        {"radius": 0.1, "left_radius": 0.1, "right_radius": 0.1},
    ):  # fmt: skip
        with pytest.raises(InvalidValue, match="left_radius and right_radius"):
            WheeledBase.differential(track=0.5, **radii)


@pytest.mark.parametrize("bad", [0.0, -0.1, np.nan, np.inf])
def test_lengths_must_be_positive(bad):
    for call in (
        lambda: differential(radius=bad),
        lambda: differential(half_track=bad),
        lambda: WheeledBase.differential(track=bad, radius=0.1),
        lambda: WheeledBase.differential(track=0.5, left_radius=0.1, right_radius=bad),
        lambda: mecanum(radius=bad),
        lambda: mecanum(half_length=bad),
        lambda: mecanum(half_width=bad),
        lambda: WheeledBase.omni(3, wheel_distance=bad, radius=0.1),
        lambda: WheeledBase.omni(3, wheel_distance=0.1, radius=bad),
        lambda: Wheel(0.0, 0.0, 0.0, bad),
    ):
        with pytest.raises(InvalidValue):
            call()


@pytest.mark.parametrize("gamma", [pi / 2, -pi / 2, 2.0, -3.0, np.nan, np.inf])
def test_roller_angles_that_drive_nothing(gamma):
    with pytest.raises(InvalidValue, match="roller_angle"):
        Wheel(0.0, 0.0, 0.0, 0.1, gamma)


def test_wheels_are_single_numbers():
    for call in (
        lambda: Wheel([0.0, 1.0], 0.0, 0.0, 0.1),
        lambda: Wheel(0.0, 0.0, [0.0], 0.1),
        lambda: Wheel(0.0, 0.0, 0.0, [0.1]),
    ):
        with pytest.raises(InvalidShape, match="one number"):
            call()
    for bad in (np.nan, np.inf, "left"):
        with pytest.raises(InvalidValue):
            Wheel(bad, 0.0, 0.0, 0.1)
    for count in (0, -1, 2.5):
        with pytest.raises(InvalidValue, match="count"):
            WheeledBase.omni(count, wheel_distance=0.2, radius=0.1)


def test_names():
    base = WheeledBase([Wheel(0.0, 0.1, 0.0, 0.1), Wheel(0.0, -0.1, 0.0, 0.1, name="right")])
    assert base.names == ("wheel_1", "right")
    assert base.row_names == ("wheel_1 rolling", "right rolling", "wheel_1 lateral", "right lateral")
    with pytest.raises(InvalidValue, match="name of its own"):
        WheeledBase([Wheel(0.0, 0.1, 0.0, 0.1, name="a"), Wheel(0.0, -0.1, 0.0, 0.1, name="a")])
    with pytest.raises(InvalidValue, match="at least one wheel"):
        WheeledBase([])
    with pytest.raises(UnknownName, match="did you mean 'left'"):
        differential().rates(lef=1.0, right=2.0)
    with pytest.raises(InvalidValue, match="missing: right"):
        differential().rates(left=1.0)
    with pytest.raises(InvalidShape, match="left, right"):
        differential().rates(left=np.zeros(2), right=np.zeros(3))
    assert mecanum().names == ("front_left", "front_right", "rear_left", "rear_right")


def test_rates_of_the_wrong_shape_or_value():
    base = mecanum()
    for call in (base.forward, base.residual, base.displacement, base.twist_rates, base.by_name, base.icr):
        with pytest.raises(InvalidShape, match="in the order front_left"):
            call([1.0, 2.0])
        with pytest.raises(InvalidValue):
            call([1.0, 2.0, np.nan, 4.0])
    with pytest.raises(InvalidShape):
        base.wheel_accelerations([1.0, 2.0])
    with pytest.raises(InvalidValue):
        base.constraints(np.inf)


def test_batches_and_floats():
    base = mecanum()
    batch = base.forward(np.ones((3, 1, 2, 4)))
    assert batch.shape == (3, 1, 2)
    assert base.inverse(batch).shape == (3, 1, 2, 4)
    assert base.wheel_velocities(batch).shape == (3, 1, 2, 4, 2)
    assert base.constraints(np.zeros((3, 2))).shape == (3, 2, 0, 3)
    assert differential().constraints(np.zeros((3, 2))).shape == (3, 2, 1, 3)
    assert base.inverse(Twist(np.zeros(5), 0.0, 1.0)).shape == (5, 4)
    assert type(base.forward([1, 2, 3, 4]).vx) is float
    assert base.forward(np.zeros((0, 4))).shape == (0,)


def test_what_is_kept_cannot_be_changed():
    base = mecanum()
    for array in (base.rolling, base.lateral, base.radii, base.singular_values, base.mobility.inverse):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        base.wheels = ()
    assert base == mecanum()
    assert hash(base) == hash(mecanum())
    assert base != mecanum(radius=0.2)
    copy = pickle.loads(pickle.dumps(base))
    assert copy == base
    assert copy.forward([1.0, 2.0, 3.0, 4.0]) == base.forward([1.0, 2.0, 3.0, 4.0])


def test_three_wheels_at_120_degrees():
    """J of three omni wheels: rows (-sin a, cos a, d) at a, a + 120 deg, a + 240 deg, and it is invertible."""
    d, r, first = 0.2, 0.05, 0.3
    base = WheeledBase.omni(3, wheel_distance=d, radius=r, first_angle=first)
    J = [(-sin(a), cos(a), d) for a in (first, first + 2 * pi / 3, first + 4 * pi / 3)]
    np.testing.assert_allclose(base.rolling, J, rtol=0, atol=1e-15)
    assert base.is_holonomic
    rates = np.array([3.0, -1.0, 2.0])
    np.testing.assert_allclose(base.forward(rates).as_array(), np.linalg.solve(J, r * rates), rtol=0, atol=1e-15)


def test_roller_sign():
    """Gamma is the direction of the axle of the roller on the ground: the wheel pushes along it."""
    wheel = Wheel(0.0, 0.0, 0.0, 0.1, pi / 4)
    base = WheeledBase([wheel])
    assert base.inverse(Twist(1.0, -1.0, 0.0)) == pytest.approx(0.0, abs=1e-14)  # across the axle it rolls freely
    assert base.inverse(Twist(0.0, 1.0, 0.0)) == pytest.approx(10.0)
    assert base.forward([1.0]).vx == pytest.approx(base.forward([1.0]).vy)  # it drives along the axle
    front_left = mecanum().wheels[0]
    assert (front_left.x > 0, front_left.y > 0, front_left.roller_angle) == (True, True, -pi / 4)


def test_mecanum_moves_as_everybody_knows():
    base = mecanum()
    speeds = {
        name: np.sign(np.round(base.inverse(twist), 12)).tolist()
        for name, twist in (("forward", Twist(1, 0, 0)), ("left", Twist(0, 1, 0)), ("turn", Twist(0, 0, 1)))
    }
    assert speeds == {"forward": [1, 1, 1, 1], "left": [-1, 1, 1, -1], "turn": [-1, 1, -1, 1]}
    with pytest.raises(UnknownName, match="rollers"):
        mecanum(rollers="H")


@pytest.mark.parametrize(
    "base", [differential(), differential(half_track=0.3137), mecanum(), mecanum(half_width=0.171)]
)
@pytest.mark.parametrize("rate", [0.1, 7.3, 1e5 / 3])
def test_equal_rates_drive_exactly_straight(base, rate):
    """What cancels by symmetry leaves no rounding: no turning radius of 10^16 m."""
    twist = base.forward(np.full(len(base.wheels), rate))
    assert (twist.vy, twist.omega) == (0.0, 0.0)
    assert twist.vx == pytest.approx(0.1 * rate, rel=1e-15)
    assert base.feasible(Twist(rate, 0.0, 0.0)).twist.as_array().tolist() == pytest.approx([rate, 0.0, 0.0], rel=1e-15)


def test_another_array_library():
    jax = pytest.importorskip("jax")
    base = mecanum()
    with jax.enable_x64(True):
        rates = jax.numpy.asarray([[1.0, 2.0, 3.0, 5.0]])
        np.testing.assert_allclose(base.forward(rates).vy, base.forward(np.asarray(rates)).vy, rtol=1e-14)
        slope = jax.grad(lambda r: base.forward(r).omega)(rates[0])
        np.testing.assert_allclose(slope, np.array([-1, 1, -1, 1]) * 0.1 / (4 * 0.5), rtol=1e-14)
        assert base.saturate(rates, 2.0, policy="keep_omega").rates.shape == (1, 4)
