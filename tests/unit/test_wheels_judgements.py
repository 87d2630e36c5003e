"""What a base can do and cannot do; slip, saturation, centres of rotation, wiring: statuses and sentences."""

from __future__ import annotations

from math import cos, inf, pi, sin

import numpy as np
import pytest

from coplanar import Pose, Twist
from coplanar.errors import InvalidShape, InvalidValue, NoSolution, UnknownName
from coplanar.wheels import (
    FindingKind,
    Icr,
    IcrStatus,
    SlipStatus,
    TwistStatus,
    Wheel,
    WheeledBase,
    WiringStatus,
    identify_wiring,
    turning_radius,
)

DIFFERENTIAL = WheeledBase.differential(half_track=0.25, radius=0.1)
MECANUM = WheeledBase.mecanum(radius=0.1, half_length=0.3, half_width=0.2)
OMNI = WheeledBase.omni(3, wheel_distance=0.2, radius=0.05)


def omni_at(*wheels):
    return WheeledBase([Wheel(x, y, beta, 0.05, 0.0) for x, y, beta in wheels])


def kinds(base, **kwargs):
    return [finding.kind for finding in base.diagnose(**kwargs)]


def faults(base):
    return [str(finding) for finding in base.diagnose() if finding.is_fault]


def test_control_against_configuration():
    """Two controls reach three coordinates: the differential drive is not holonomic, an omni base is."""
    assert (DIFFERENTIAL.degrees_of_control, DIFFERENTIAL.degrees_of_configuration) == (2, 3)
    assert DIFFERENTIAL.mobility.degrees_of_mobility == 2
    assert not DIFFERENTIAL.is_holonomic
    for base in (OMNI, MECANUM):
        assert (base.degrees_of_control, base.degrees_of_configuration, base.is_holonomic) == (3, 3, True)


def test_the_constraint_of_the_differential_drive():
    """xdot sin theta - ydot cos theta = 0, once for both wheels; an axle ahead of the origin adds its lever."""
    theta = 0.7
    np.testing.assert_allclose(DIFFERENTIAL.constraints(theta), [[-sin(theta), cos(theta), 0.0]], rtol=0, atol=1e-15)
    ahead = WheeledBase([Wheel(0.3, 0.2, 0.0, 0.1), Wheel(0.3, -0.2, 0.0, 0.1)])
    np.testing.assert_allclose(ahead.constraints(theta), [[-sin(theta), cos(theta), 0.3]], rtol=0, atol=1e-15)
    assert ahead.cannot == ("cannot move its point (0.3, 0) m sideways: wheel_1 and wheel_2 would slide",)


def test_skid_steering_only_goes_straight_without_sliding():
    """Four ordinary wheels: one degree of mobility; least squares still tells the turning, with a residual."""
    base = WheeledBase([Wheel(x, y, 0.0, 0.1) for x in (0.3, -0.3) for y in (0.2, -0.2)])
    assert (base.rank, base.degrees_of_control, base.degrees_of_configuration) == (3, 1, 1)
    assert base.cannot[0].startswith("cannot do anything but move forward")
    rates = np.array([-10.0, 10.0, -10.0, 10.0])
    # 4 b^2 omega + 4 a^2 omega = 4 b r w, by the normal equation.
    assert base.forward(rates).omega == pytest.approx(0.2 * 0.1 * 10 / (0.2**2 + 0.3**2))
    assert np.abs(base.residual(rates)).max() > 0.1
    assert base.slip(rates, 0.1).is_slipping


def test_wheels_that_lock_each_other():
    base = WheeledBase([Wheel(0.0, 0.1, 0.0, 0.1), Wheel(0.1, -0.1, 0.4, 0.1), Wheel(0.3, 0.0, 0.7, 0.1)])
    assert (base.degrees_of_control, base.degrees_of_configuration) == (0, 0)
    assert "cannot move at all" in base.cannot[0]
    assert base.feasible(Twist(1.0, 0.0, 0.0)).twist.as_array() == pytest.approx(0.0, abs=1e-15)
    tricycle = WheeledBase([Wheel(0.0, 0.1, 0.0, 0.1), Wheel(0.0, -0.1, 0.0, 0.1), Wheel(0.3, 0.0, pi / 4, 0.1)])
    assert tricycle.degrees_of_control == 1
    assert tricycle.cannot[0].startswith("cannot do anything but turn about (0, 0.3) m")


def test_drive_directions_through_one_point():
    """Radial drive directions leave the turning undriven: rank 2, and the sentence names the point."""
    base = omni_at(*((cos(a) + 0.5, sin(a), a) for a in (0.0, 2.0, 4.0)))
    assert (base.rank, base.condition, base.is_holonomic) == (2, inf, False)
    assert "turn about (0.5, 0) m: all lines of traction pass through (0.5, 0) m (rank 2 of 3)" in base.cannot[0]
    centred = omni_at(*((cos(a), sin(a), a) for a in (0.0, 2 * pi / 3, 4 * pi / 3)))
    np.testing.assert_allclose(centred.singular_values, [np.sqrt(1.5), np.sqrt(1.5), 0.0], rtol=0, atol=1e-15)
    assert "turn on the spot" in centred.cannot[0]


def test_parallel_drive_directions():
    base = omni_at((0.3, 0.0, 0.3), (0.0, 0.4, 0.3), (-0.2, -0.1, 0.3 + pi))
    assert base.rank == 2
    assert "move along 107.189 deg: all lines of traction are parallel, along 17.189 deg" in base.cannot[0]


def test_two_omni_wheels_are_not_enough():
    for second in (0.3, 1.0, 2.0, pi):
        base = omni_at((0.2, 0.0, pi / 2), (0.2 * cos(second), 0.2 * sin(second), second + pi / 2))
        assert (base.rank, base.degrees_of_control, base.is_holonomic) == (2, 2, False)
        assert FindingKind.UNDRIVEN in kinds(base)
    assert "any point of the line of traction" in omni_at((0.2, 0.0, 0.0)).cannot[0]


def test_mecanum_rollers_mounted_the_wrong_way():
    wrong = WheeledBase.mecanum(radius=0.1, half_length=0.3, half_width=0.2, rollers="O")
    assert kinds(wrong)[0] is FindingKind.MIRRORED_ROLLERS
    assert "a lever of 0.1 m, mirrored ones by 0.5 m" in faults(wrong)[0]
    length = wrong.mobility.length
    np.testing.assert_allclose(wrong.singular_values * (1, 1, length), [2.0, 2.0, 0.2], rtol=0, atol=1e-15)
    square = WheeledBase.mecanum(radius=0.1, half_length=0.3, half_width=0.3, rollers="O")
    assert square.rank == 2
    assert [f.kind for f in square.diagnose() if f.is_fault] == [FindingKind.UNDRIVEN, FindingKind.MIRRORED_ROLLERS]
    assert faults(MECANUM) == faults(OMNI) == faults(DIFFERENTIAL) == []


def test_weak_and_coincident_and_redundant():
    weak = omni_at((1.0, 0.0, 0.01), (-1.0, 0.0, 0.0), (0.0, 1.0, pi))
    assert FindingKind.WEAK in kinds(weak)
    assert FindingKind.WEAK not in kinds(weak, worst_condition=1e3)
    twins = omni_at((0.0, 0.0, 0.0), (0.0, 0.0, pi / 2), (0.3, 0.0, pi / 2))
    assert "wheel_1 and wheel_2 stand on one point, (0, 0) m" in faults(twins)[0]
    assert kinds(omni_at((0.1, 0, 0), (0.1, 1e-3, 1), (0.3, 0, 2)), same_place=0.01)[-2] is FindingKind.COINCIDENT
    for base, words in (
        (OMNI, "no wheel is redundant"),
        (MECANUM, "one wheel is redundant"),
        (WheeledBase.omni(6, wheel_distance=0.2, radius=0.05), "3 wheels are redundant"),
    ):
        assert str(base.diagnose()[-1]).startswith(words)


def test_all_wheels_on_the_origin():
    base = omni_at((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 2.0))
    assert base.rank == 2
    assert np.isfinite(base.forward([1.0, 2.0, 3.0]).as_array()).all()
    assert base.forward([1.0, 2.0, 3.0]).omega == 0.0
    assert len([k for k in kinds(base) if k is FindingKind.COINCIDENT]) == 3


def test_infeasible_part():
    answer = DIFFERENTIAL.feasible(Twist([1.0, 1.0], [0.5, 0.0], 2.0))
    np.testing.assert_allclose(answer.infeasible.as_array(), [[0.0, 0.5, 0.0], [0.0, 0.0, 0.0]], rtol=0, atol=1e-15)
    assert answer.is_feasible.tolist() == [False, True]
    np.testing.assert_allclose(answer.gap, [0.5, 0.0], rtol=0, atol=1e-15)
    assert answer.status is TwistStatus.PARTLY_FEASIBLE
    with pytest.raises(NoSolution, match=r"cannot move sideways.*short by 0\.5 m/s") as caught:
        answer.or_raise()
    assert caught.value.result is answer
    fine = MECANUM.feasible(Twist(1.0, 0.5, 2.0))
    assert fine.or_raise() is fine
    assert (fine.status, fine.reason, fine.is_feasible) == (TwistStatus.FEASIBLE, "", True)


def test_centre_of_rotation_may_not_exist():
    straight = DIFFERENTIAL.icr([[10.0, 10.0], [5.0, 10.0]])
    assert straight.exists.tolist() == [False, True]
    assert straight.body[0].tolist() == [inf, inf]
    assert straight.in_world(Pose(1.0, 2.0, 0.3))[0].tolist() == [inf, inf]
    assert straight.status is IcrStatus.TRANSLATES
    with pytest.raises(NoSolution, match="omega = 0"):
        straight.or_raise()
    spin = Icr(Twist(0.0, 0.0, 2.0))
    assert (spin.exists, spin.radius, spin.or_raise()) == (True, 0.0, spin)
    assert turning_radius(1.0, 1.0, half_track=0.2) == inf
    assert turning_radius(-1.0, 1.0, half_track=0.2) == 0.0
    assert turning_radius([0.0, 1.0], [1.0, 0.0], half_track=0.2).tolist() == [0.2, -0.2]


def test_scaling_keeps_the_curvature_and_clipping_does_not():
    wanted = DIFFERENTIAL.rates(left=10.0, right=30.0)
    radius = DIFFERENTIAL.icr(wanted).radius
    scaled, clipped, turning = (
        DIFFERENTIAL.saturate(wanted, 15.0, policy=policy) for policy in ("scale", "clip", "keep_omega")
    )
    assert DIFFERENTIAL.saturate(wanted, 15.0).rates.tolist() == scaled.rates.tolist() == [5.0, 15.0]
    assert Icr(scaled.twist).radius == pytest.approx(radius)
    assert clipped.rates.tolist() == [10.0, 15.0]
    assert Icr(clipped.twist).radius == pytest.approx(2.5 * radius)
    assert turning.rates.tolist() == pytest.approx([-5.0, 15.0])
    assert turning.twist.omega == pytest.approx(turning.wanted.omega)
    for done, share in ((scaled, 0.5), (clipped, 0.5), (turning, 0.25)):
        assert done.share == pytest.approx(share)
        assert done.is_limited
        assert f"share {share:.3g}" in done.sentence
    assert "same path" in scaled.sentence
    assert "path changes" in clipped.sentence
    inside = DIFFERENTIAL.saturate(wanted, 30.0)
    assert not inside.is_limited
    assert "nothing changed" in inside.sentence


def test_turning_faster_than_the_limit():
    done = DIFFERENTIAL.saturate(DIFFERENTIAL.inverse(Twist(1.0, 0.0, 8.0)), 10.0, policy="keep_omega")
    assert done.turn_share == pytest.approx(0.5)
    assert done.twist.as_array() == pytest.approx([0.0, 0.0, 4.0], abs=1e-14)
    standing = DIFFERENTIAL.saturate([0.0, 0.0], 10.0, policy="keep_omega")
    assert standing.rates.tolist() == [0.0, 0.0]
    assert (standing.share, standing.turn_share) == (1.0, 1.0)


def test_unequal_limits_do_not_cut_what_fits():
    """The turning alone would break a limit that it keeps together with the translation."""
    base = WheeledBase.omni(3, wheel_distance=0.2, radius=0.05)
    rates = base.inverse(Twist(0.3, 0.0, 2.0))
    done = base.saturate(rates, np.abs(rates) + 0.01, policy="keep_omega")
    assert np.any(np.abs(base.inverse(Twist(0.0, 0.0, 2.0))) > np.abs(rates) + 0.01)
    assert not done.is_limited
    assert done.rates.tolist() == rates.tolist()


def test_limits_and_policies_are_checked():
    for limit in (0.0, -1.0, np.nan, [1.0, 0.0]):
        with pytest.raises(InvalidValue, match="max_rate"):
            DIFFERENTIAL.saturate([1.0, 2.0], limit)
    with pytest.raises(InvalidShape, match="max_rate"):
        DIFFERENTIAL.saturate([1.0, 2.0], [1.0, 2.0, 3.0])
    with pytest.raises(UnknownName, match="did you mean 'scale'"):
        DIFFERENTIAL.saturate([1.0, 2.0], 1.0, policy="scaled")


@pytest.mark.parametrize("count", [4, 5, 6])
def test_slip_threshold_follows_from_the_noise(count):
    """Rolling wheels raise a false alarm as often as was asked for, and the statistic has mean N - 3."""
    rng = np.random.default_rng(1)
    wheels = [Wheel(cos(a), sin(a), a + 2, 0.05 + 0.01 * i, 0.0) for i, a in enumerate(np.arange(count) * 1.3)]
    base = WheeledBase(wheels)
    stds, samples = np.linspace(0.1, 0.4, count), 20_000
    rates = base.inverse(Twist(*rng.normal(size=(3, samples)))) + rng.normal(size=(samples, count)) * stds
    slip = base.slip(rates, stds, false_alarm=0.05)
    assert slip.degrees == count - 3
    # Five standard deviations of a share, and of a mean of chi-square values.
    assert np.mean(slip.is_slipping) == pytest.approx(0.05, abs=5 * np.sqrt(0.05 * 0.95 / samples))
    assert np.mean(slip.statistic) == pytest.approx(count - 3, abs=5 * np.sqrt(2 * (count - 3) / samples))
    np.testing.assert_allclose(np.std(slip.scores, axis=0), 1.0, rtol=0, atol=5 / np.sqrt(samples))
    np.testing.assert_allclose(base.residual(rates, slip.twist)[:, :count], slip.residual, rtol=0, atol=1e-12)


def test_slip_of_one_wheel_shows_and_is_named_by_two_redundant_ones():
    base = WheeledBase.omni(5, wheel_distance=0.2, radius=0.05)
    rates = base.inverse(Twist(1.0, 0.5, 0.2))
    assert base.slip(rates, 0.1).status is SlipStatus.ROLLING
    rates[3] += 2.0
    slip = base.slip(rates, 0.1)
    assert slip.status is SlipStatus.SLIPPING
    assert np.argmax(np.abs(slip.scores)) == 3
    assert slip.statistic == pytest.approx(np.sum((slip.residual / (0.05 * 0.1)) ** 2))


def test_slip_needs_redundancy():
    for base in (OMNI, DIFFERENTIAL):
        slip = base.slip(np.arange(len(base.wheels)) + 1.0, 0.1)
        assert (slip.status, slip.degrees, slip.threshold, slip.is_slipping) == (SlipStatus.BLIND, 0, inf, False)
        np.testing.assert_allclose(slip.residual, 0.0, rtol=0, atol=1e-15)
    for kwargs in ({"false_alarm": 0.0}, {"false_alarm": 1.0}, {"false_alarm": np.nan}):
        with pytest.raises(InvalidValue, match="false_alarm"):
            MECANUM.slip(np.zeros(4), 0.1, **kwargs)
    with pytest.raises(InvalidValue, match="rate_std"):
        MECANUM.slip(np.zeros(4), 0.0)


def jog(base, wheels, signs):
    """What is seen when motor i turns wheel ``wheels[i]`` with ``signs[i]``, at some speed, with ten per cent noise."""
    rng = np.random.default_rng(3)
    clean = base.forward(np.eye(len(wheels))[wheels] * np.array(signs)[:, None]).as_array()
    return clean * rng.uniform(0.5, 2.0, size=(len(wheels), 1)) * (1 + 0.1 * rng.normal(size=clean.shape))


@pytest.mark.parametrize("base", [DIFFERENTIAL, OMNI, MECANUM, WheeledBase.omni(4, wheel_distance=0.2, radius=0.05)])
def test_wiring_is_identified(base):
    """Every permutation and inversion of the motors is found, and the commands undo it."""
    rng = np.random.default_rng(2)
    count = len(base.wheels)
    for _ in range(12):
        wheels, signs = rng.permutation(count), rng.choice([-1.0, 1.0], size=count)
        wiring = identify_wiring(base, jog(base, wheels, signs)).or_raise()
        assert wiring.wheels == tuple(base.names[j] for j in wheels)
        assert wiring.inverted == tuple((signs < 0).tolist())
        wanted = rng.normal(size=count)
        turned = np.zeros(count)
        turned[wheels] = signs * wiring.commands(wanted)
        np.testing.assert_array_equal(turned, wanted)


def test_wiring_sentences():
    right = identify_wiring(MECANUM, jog(MECANUM, [0, 1, 2, 3], [1, 1, 1, 1]))
    assert (right.status, right.sentences) == (WiringStatus.CORRECT, (WiringStatus.CORRECT.value,))
    backwards = Twist.from_array(-jog(MECANUM, [0, 1, 2, 3], [1, 1, 1, 1]))
    assert identify_wiring(MECANUM, backwards, jog_rates=-5.0).status is WiringStatus.CORRECT
    wrong = identify_wiring(MECANUM, jog(MECANUM, [1, 0, 2, 3], [1, 1, 1, -1]))
    assert wrong.status is WiringStatus.MISWIRED
    assert wrong.sentences == (
        "motor front_left turns the wheel front_right",
        "motor front_right turns the wheel front_left",
        "motor rear_right is inverted",
    )
    both = identify_wiring(DIFFERENTIAL, jog(DIFFERENTIAL, [1, 0], [-1, 1]))
    assert both.sentences[0] == "motor left turns the wheel right, inverted"


def test_wiring_may_be_unclear():
    """A motor that moves nothing, a motion that fits no wheel, and wheels that do the same are said to be unclear."""
    seen = jog(MECANUM, [0, 1, 2, 3], [1, 1, 1, 1])
    seen[2] = 0.0
    wiring = identify_wiring(MECANUM, seen)
    assert (wiring.status, wiring.unclear) == (WiringStatus.UNCLEAR, ("rear_left",))
    assert "rear_left" in wiring.sentences[-1]
    with pytest.raises(NoSolution, match="rear_left"):
        wiring.or_raise()
    with pytest.raises(NoSolution):
        wiring.commands(np.zeros(4))
    twins = omni_at((0.2, 0.0, pi / 2), (0.2, 0.0, pi / 2), (0.0, 0.2, 0.0), (-0.2, -0.2, 1.0))
    assert identify_wiring(twins, jog(twins, [0, 1, 2, 3], [1, 1, 1, 1])).unclear[:2] == ("wheel_1", "wheel_2")


def test_wiring_inputs_are_checked():
    with pytest.raises(InvalidShape, match="jog every motor once"):
        identify_wiring(DIFFERENTIAL, np.zeros((3, 3)))
    with pytest.raises(InvalidValue, match="not 0"):
        identify_wiring(DIFFERENTIAL, np.ones((2, 3)), jog_rates=[1.0, 0.0])
