"""Edges of projectiles, shots and impacts: what is refused, what is an honest no, what special cases answer."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar import errors
from coplanar.flight import ImpactStatus, Projectile

BALL = Projectile(mass=1.0, drag=0.02)
FREE = Projectile(mass=1.0, drag=0.0, gravity=10.0)
STRAIGHT = Projectile(mass=1.0, drag=0.1, gravity=0.0)


class TestProjectile:
    @pytest.mark.parametrize(
        ("values", "words"),
        [
            ({"mass": 0.0, "drag": 0.1}, "mass.*greater than 0"),
            ({"mass": -1.0, "drag": 0.1}, "mass.*greater than 0"),
            ({"mass": 1.0, "drag": -0.1}, "drag.*0 or more.*kg/m"),
            ({"mass": 1.0, "drag": 0.1, "gravity": -9.81}, "gravity.*0 or more.*points down"),
            ({"mass": np.nan, "drag": 0.1}, "mass.*finite"),
            ({"mass": 1.0, "drag": np.inf}, "drag.*finite"),
            ({"mass": 1.0, "drag": 0.1, "gravity": [9.81, np.nan]}, "gravity.*finite"),
        ],
    )
    def test_refuses(self, values, words):
        with pytest.raises(errors.InvalidValue, match=words):
            Projectile(**values)

    def test_refuses_shapes_that_do_not_broadcast(self):
        with pytest.raises(errors.InvalidShape, match=r"mass, drag.* \(2,\), \(3,\)"):
            Projectile(mass=[1.0, 2.0], drag=[0.1, 0.2, 0.3])

    def test_keeps_read_only_arrays(self):
        masses = np.array([1.0, 2.0])
        projectile = Projectile(mass=masses, drag=0.1)
        masses[0] = 9.0
        assert projectile.mass.tolist() == [1.0, 2.0]
        assert not projectile.mass.flags.writeable

    def test_drag_and_drag_per_mass_are_told_apart_by_name(self):
        assert Projectile(mass=2.0, drag=0.05).drag_per_mass == 0.025
        assert Projectile.from_drag_per_mass(0.025, mass=2.0).drag == 0.05
        area = Projectile.from_area(2.0, drag_coefficient=0.5, area=0.2, air_density=1.0)
        assert area.drag == 0.05

    def test_terminal_speed_is_where_drag_holds_the_weight(self):
        ball = Projectile(mass=2.0, drag=[0.0, 0.5])
        assert ball.terminal_speed[0] == np.inf
        assert np.isclose(0.5 * ball.terminal_speed[1] ** 2, 2.0 * 9.81)
        falling = Projectile(mass=2.0, drag=0.5).launch(speed=50.0, angle=0.5).at(60.0)
        assert np.isclose(falling.speed, ball.terminal_speed[1], rtol=1e-12)


class TestLaunch:
    @pytest.mark.parametrize(
        "words", [{"speed": 1.0}, {"angle": 1.0}, {}, {"speed": 1.0, "angle": 1.0, "velocity": (1.0, 1.0)},
                  {"speed": 1.0, "velocity": (1.0, 1.0)}],
    )  # fmt: skip
    def test_takes_speed_and_angle_or_velocity(self, words):
        with pytest.raises(errors.InvalidInput, match="speed and angle, or velocity alone"):
            BALL.launch(**words)

    @pytest.mark.parametrize("speed", [0.0, -3.0, np.nan, np.inf, 1e200])
    def test_refuses_speeds(self, speed):
        with pytest.raises(errors.InvalidValue):
            BALL.launch(speed=speed, angle=0.5)

    def test_refuses_rest(self):
        with pytest.raises(errors.InvalidValue, match="speed greater than 0"):
            BALL.launch(velocity=(0.0, 0.0))

    def test_refuses_other_shapes(self):
        with pytest.raises(errors.InvalidShape):
            BALL.launch(velocity=(1.0, 2.0, 3.0))
        with pytest.raises(errors.InvalidShape):
            BALL.launch(speed=[1.0, 2.0], angle=[0.1, 0.2, 0.3])

    def test_floats_in_floats_out(self):
        shot = BALL.launch(speed=30, angle=0.7)
        values = (*shot.at(2), *shot.apex(), *shot.impact().state, *shot.energy(1.0), shot.speed, shot.angle)
        assert {type(v) for v in values} == {float}

    def test_speed_and_angle_are_those_given(self):
        shot = BALL.launch(speed=[10.0, 20.0], angle=[0.5, 2.5])
        assert np.allclose(shot.speed, [10.0, 20.0])
        assert np.allclose(shot.angle, [0.5, 2.5])
        assert not shot.vx.flags.writeable


class TestState:
    def test_at_launch_it_is_the_launch(self):
        shot = BALL.launch(velocity=(3.0, 4.0), start=(1.0, 2.0))
        assert np.allclose(shot.at(0.0), (0.0, 1.0, 2.0, 3.0, 4.0), rtol=1e-15)

    def test_refuses_times_before_the_launch(self):
        with pytest.raises(errors.InvalidValue, match="before its launch"):
            BALL.launch(speed=30.0, angle=0.7).at([0.0, -1.0])

    def test_refuses_unknown_methods(self):
        with pytest.raises(errors.UnknownName, match="did you mean 'hodograph'"):
            BALL.launch(speed=30.0, angle=0.7).at(1.0, method="hodogaph")

    def test_many_times_of_many_shots(self):
        shots = BALL.launch(speed=[10.0, 20.0, 30.0], angle=0.7)
        assert shots.at(np.linspace(0.0, 2.0, 5)[:, None]).position.shape == (5, 3, 2)
        with pytest.raises(errors.InvalidShape):
            shots.at([0.0, 1.0])

    def test_a_very_long_fall_goes_on_at_terminal_speed(self):
        shot = BALL.launch(speed=30.0, angle=0.7)
        minute, hour = shot.at(60.0), shot.at(3600.0)
        assert np.isclose(hour.y - minute.y, -3540.0 * BALL.terminal_speed, rtol=1e-9)
        assert np.isclose(hour.x, shot.at(1e5).x, rtol=1e-14)

    def test_a_very_slow_launch_is_a_fall_from_rest(self):
        state = BALL.launch(velocity=(1e-12, 0.0)).at(1.0)
        assert np.isclose(state.y, -np.log(np.cosh(np.sqrt(0.02 * 9.81))) / 0.02, rtol=1e-13)

    def test_apex_is_level_and_highest(self):
        shot = BALL.launch(speed=30.0, angle=[0.7, 2.0, -0.3], start=(1.0, 5.0))
        apex = shot.apex()
        assert np.allclose(apex.vy[:2], 0.0, atol=1e-13)
        assert apex.y[2] == 5.0
        assert np.all(apex.y[:2] >= shot.at(apex.time + np.array([[-0.1, -0.1, 0.0], [0.1] * 3])).y[:, :2])

    def test_the_path_of_a_launch_straight_up_is_straight(self):
        shot = BALL.launch(velocity=(0.0, 30.0))
        assert np.all(shot.sample(6.0).x == 0.0)
        assert np.isclose(shot.apex().y, np.log1p(0.02 * 900.0 / 9.81) / 0.04, rtol=1e-14)

    def test_sample_refuses_a_single_step(self):
        with pytest.raises(errors.InvalidValue, match="2 or more"):
            BALL.launch(speed=30.0, angle=0.7).sample(1.0, count=1)

    def test_energy_is_kept_without_drag(self):
        shot = Projectile(mass=2.0, drag=0.0).launch(speed=30.0, angle=0.7, start=(0.0, 3.0))
        energy = shot.energy(np.linspace(0.0, 4.0, 9))
        assert np.allclose(energy.total, 900.0 + 2.0 * 9.81 * 3.0, rtol=1e-13)
        assert np.allclose(energy.lost, 0.0, atol=1e-10)


class TestImpact:
    def test_the_level_of_the_launch_is_reached_on_the_way_down(self):
        impact = FREE.launch(velocity=(3.0, 20.0)).impact()
        assert np.isclose(impact.time, 4.0)
        assert impact.velocity[1] < 0.0

    def test_a_level_above_the_launch_is_reached_from_above(self):
        assert np.isclose(FREE.launch(velocity=(3.0, 20.0)).impact(level=15.0).time, 3.0)

    def test_the_apex_itself_is_reached(self):
        shot = FREE.launch(velocity=(3.0, 20.0))
        assert np.isclose(shot.impact(level=20.0 - 1e-12).time, 2.0, atol=1e-5)

    def test_a_level_above_the_apex_is_not_reached_and_the_gap_is_told(self):
        impact = BALL.launch(speed=[30.0, 30.0], angle=[0.7, -0.7]).impact(level=50.0)
        assert all(s is ImpactStatus.NEVER for s in impact.status)
        assert np.allclose(impact.height(), [BALL.launch(speed=30.0, angle=0.7).apex().y - 50.0, -50.0])
        with pytest.raises(errors.NoSolution, match="2 NEVER") as caught:
            impact.or_raise()
        assert caught.value.result is impact

    def test_a_launch_downwards_from_the_level_is_there_at_once(self):
        impact = BALL.launch(speed=30.0, angle=-0.7).impact()
        assert impact.reached
        assert impact.time == 0.0

    def test_a_slope_is_reached_where_the_path_is_on_it(self):
        for side in (1.0, -1.0):
            shot = BALL.launch(velocity=(side * 15.0, 20.0), start=(1.0, 2.0))
            impact = shot.impact_on((side * 20.0 + 1.0, 0.0), slope=side * 0.3)
            assert impact.reached
            assert abs(impact.height()) < 1e-12
            assert np.isclose(shot.at(impact.time).x, impact.position[0], rtol=1e-13)

    def test_a_wall_beyond_the_asymptote_is_never_reached(self):
        shot = Projectile(mass=1.0, drag=0.1).launch(speed=30.0, angle=1.0)
        far = shot.at(1e3).x
        assert shot.impact_at_wall(0.99 * far).reached
        assert not shot.impact_at_wall(1.01 * far).reached
        assert np.isclose(shot.impact_at_wall(1.01 * far).height(), 0.01 * far)
        assert not shot.impact_at_wall(-1.0).reached

    def test_walls_on_both_sides(self):
        for side in (1.0, -1.0):
            impact = BALL.launch(velocity=(side * 15.0, 20.0)).impact_at_wall(side * 10.0)
            assert np.isclose(impact.position[0], side * 10.0, rtol=1e-13)

    def test_straight_flights_reach_what_lies_ahead(self):
        down, up = (STRAIGHT.launch(velocity=(3.0, side * 4.0), start=(0.0, 8.0)).impact() for side in (-1.0, 1.0))
        assert np.allclose(down.position, (6.0, 0.0), atol=1e-12)
        assert np.isclose(down.time, np.expm1(0.1 * 10.0) / (0.1 * 5.0))
        assert not up.reached

    def test_from_a_great_height(self):
        impact = BALL.launch(speed=30.0, angle=0.7, start=(0.0, 1e6)).impact()
        assert np.isclose(impact.position[1], 0.0, atol=1e-8)
        assert np.isclose(impact.time, 1e6 / BALL.terminal_speed, rtol=1e-3)

    def test_steep_slopes_are_walls(self):
        with pytest.raises(errors.InvalidValue, match="impact_at_wall"):
            BALL.launch(speed=30.0, angle=0.7).impact_on((1.0, 1.0), slope=np.pi / 2)

    @pytest.mark.parametrize("side", [1.0, -1.0])
    @pytest.mark.parametrize("slope", [0.0, 0.4])
    def test_sensitivity_is_the_difference_of_exact_impacts(self, side, slope):
        def at(speed, lift):
            angle = np.pi / 2 - side * (np.pi / 2 - 0.6) + lift
            return BALL.launch(speed=speed, angle=angle).impact_on((side * 9.0, 1.0), slope=side * slope)

        h, exact = 1e-5, at(30.0, 0.0).sensitivity()
        assert np.allclose(exact.by_speed, (at(30 + h, 0).position - at(30 - h, 0).position) / (2 * h), atol=1e-7)
        assert np.allclose(exact.by_angle, (at(30.0, h).position - at(30.0, -h).position) / (2 * h), atol=1e-6)

    def test_the_range_does_not_depend_on_the_angle_at_the_best_one(self):
        shot = BALL.launch(speed=30.0, angle=BALL.furthest(30.0).angle)
        assert np.allclose(shot.impact().sensitivity().by_angle, 0.0, atol=1e-8)
