"""Edges of aiming: what is refused, the numbers of an honest no, special targets, limits, tolerance, root finders."""

from __future__ import annotations

import numpy as np
import pytest

from coplanar import errors
from coplanar.flight import AimStatus, Projectile, forms, reach, roots
from coplanar.flight.roots import falling_root, rising_root
from coplanar.laws.aiming import arc, farthest

BALL = Projectile(mass=1.0, drag=0.02)
FREE = Projectile(mass=1.0, drag=0.0, gravity=10.0)
STRAIGHT = Projectile(mass=1.0, drag=0.1, gravity=0.0)


class TestAim:
    def test_takes_one_or_none(self):
        with pytest.raises(errors.InvalidInput, match="speed and angle"):
            BALL.aim((5.0, 5.0), speed=3.0, angle=0.1)

    @pytest.mark.parametrize(
        "words", [{"speed": 0.0}, {"speed": -1.0}, {"time": 0.0}, {"time": np.nan}, {"angle": np.inf}]
    )
    def test_refuses_numbers(self, words):
        with pytest.raises(errors.InvalidValue):
            BALL.aim((5.0, 5.0), **words)

    @pytest.mark.parametrize("target", [(30.0, 1e12), (0.0, 1e12), (30.0, 1e6)])
    def test_a_target_as_high_as_no_speed_climbs(self, target):
        least, best = BALL.aim(target), BALL.aim(target, speed=30.0)
        assert least.status is AimStatus.TOO_FAST
        assert np.isnan(least.low.speed)
        assert best.status is AimStatus.OUT_OF_REACH
        assert np.allclose([best.low.speed, best.high.speed], 30.0, rtol=1e-12)
        assert np.isclose(best.miss(), best.shortfall, rtol=1e-6)

    @pytest.mark.parametrize("words", [{"speed": 3.0}, {"angle": 1.0}, {}])
    def test_the_launch_point_is_no_target(self, words):
        with pytest.raises(errors.InvalidValue, match="away from the launch point"):
            BALL.aim((1.0, 2.0), start=(1.0, 2.0), **words)

    def test_but_a_flight_time_leads_back_to_it(self):
        aim = FREE.aim((1.0, 2.0), start=(1.0, 2.0), time=2.0)
        assert np.allclose(aim.low.velocity, (0.0, 10.0), atol=1e-12)
        with pytest.raises(errors.InvalidValue):
            STRAIGHT.aim((1.0, 2.0), start=(1.0, 2.0), time=2.0)

    def test_refuses_other_shapes(self):
        with pytest.raises(errors.InvalidShape):
            BALL.aim((1.0, 2.0, 3.0), speed=3.0)
        with pytest.raises(errors.InvalidShape):
            BALL.aim([(1.0, 2.0), (3.0, 4.0)], speed=[1.0, 2.0, 3.0])

    def test_out_of_reach_tells_the_numbers(self):
        aim = BALL.aim((60.0, 0.0), speed=30.0)
        assert aim.status is AimStatus.OUT_OF_REACH
        assert not aim.hit
        assert np.isclose(aim.furthest, BALL.furthest(30.0).distance)
        assert np.isclose(aim.low.angle, BALL.furthest(30.0).angle)
        assert np.isclose(BALL.aim((60.0, 0.0), speed=aim.least_speed * (1 + 1e-9)).miss(), 0.0, atol=1e-9)
        with pytest.raises(errors.NoSolution, match=r"short by 17\.79") as caught:
            aim.or_raise()
        assert caught.value.result is aim

    def test_above_the_line_of_sight_no_speed_helps(self):
        aim = BALL.aim((10.0, 10.0), angle=np.radians(30.0))
        assert aim.status is AimStatus.OFF_THE_LINE
        assert np.isclose(aim.shortfall, np.hypot(10.0, 10.0) * np.sin(np.radians(15.0)))
        assert aim.miss() == np.inf
        assert np.isnan(aim.low.speed)
        assert np.isclose(BALL.aim((10.0, 0.0), angle=2.0).shortfall, 10.0)  # the other way

    def test_beyond_the_asymptote_of_a_slow_shot_a_faster_one_reaches(self):
        """With drag a path at a speed has a vertical asymptote; the speed that is found moves it beyond the target."""
        slow = BALL.launch(speed=30.0, angle=1.0).at(1e3).x
        aim = BALL.aim((2.0 * slow, -50.0), angle=1.0)
        assert aim.hit
        assert aim.low.speed > 30.0

    def test_unthinkable_speeds_are_said_to_be(self):
        heavy = Projectile(mass=1.0, drag=1.0)
        for words in ({"time": 1.0}, {"angle": 0.7}, {}):
            aim = heavy.aim((1e4, 0.0), **words)
            assert aim.status is AimStatus.TOO_FAST
            assert aim.miss() == np.inf

    @pytest.mark.parametrize("words", [{"speed": 30.0}, {"angle": 1.0}, {"time": 2.0}, {}])
    def test_a_search_that_stops_early_says_so(self, words, monkeypatch):
        monkeypatch.setattr(roots, "ROUNDS", 1)
        monkeypatch.setattr(forms, "ROUNDS", 1)
        for search in (arc, farthest):
            monkeypatch.setattr(search, "rounds", 1)
            monkeypatch.setattr(search, "_loops", None)
        aim = BALL.aim((20.0, 5.0), **words)
        assert aim.status is AimStatus.NOT_FOUND
        with pytest.raises(errors.NoSolution, match="stopped before"):
            aim.or_raise()

    def test_near_and_far_targets_in_one_batch(self):
        aim = BALL.aim([(10.0, 0.0), (60.0, 0.0)], speed=30.0)
        assert [s.name for s in aim.status] == ["HIT", "OUT_OF_REACH"]
        assert aim.sentence().startswith("1 HIT, 1 OUT_OF_REACH; short by 17.79")
        assert aim.miss()[0] < 1e-12

    def test_straight_up_is_passed_twice_and_straight_down_by_both_ways(self):
        up = BALL.aim((0.0, 10.0), speed=30.0)
        assert np.allclose(up.angles, np.pi / 2)
        assert up.low.arrival().vy > 0.0 > up.high.arrival().vy
        assert up.miss() < 1e-13
        down = BALL.aim((0.0, -10.0), speed=30.0)
        assert np.allclose(down.angles, (-np.pi / 2, np.pi / 2))
        assert down.miss() < 1e-13
        high = BALL.aim((0.0, 100.0), speed=30.0)
        assert np.isclose(high.furthest, np.log1p(0.02 * 900.0 / 9.81) / 0.04)
        assert np.isclose(high.miss(), high.shortfall)

    @pytest.mark.parametrize("aside", [1e-3, -1e-6, 1e-8, -3e-9, 1e-10, 1e-13, 0.0])
    @pytest.mark.parametrize("height", [10.0, -10.0])
    def test_nearly_straight_targets_are_hit_too(self, aside, height):
        for words in ({"speed": 30.0}, {"time": 1.5}):
            assert BALL.aim((aside, height), **words).miss() < 1e-12, words
        if height > 0.0:
            least = BALL.aim((aside, height))
            assert np.isclose(least.low.speed, np.sqrt(9.81 * np.expm1(0.4) / 0.02), rtol=1e-3)
            assert least.miss() < 1e-12

    @pytest.mark.parametrize("k", [0.0, 7e-5, 0.02, 1.0])
    @pytest.mark.parametrize("speed", [0.1, 1.0, 100.0])
    def test_up_and_back_to_a_level_below(self, k, speed):
        aim = Projectile(mass=1.0, drag=k).aim((0.0, -1.0), speed=speed)
        assert aim.miss() < 1e-12 * (1.0 + speed * speed)

    def test_straight_down_every_speed_will_do(self):
        aim = BALL.aim((0.0, -10.0))
        assert aim.status is AimStatus.ANY_SPEED
        assert aim.least_speed == 0.0
        assert BALL.aim((0.0, -10.0), angle=np.pi / 2).status is AimStatus.ANY_SPEED
        assert BALL.aim((0.0, -10.0), angle=-np.pi / 2).status is AimStatus.ANY_SPEED

    def test_straight_up_at_an_angle(self):
        assert np.isclose(BALL.aim((0.0, 10.0), angle=np.pi / 2).low.arrival().vy, 0.0, atol=1e-6)
        assert BALL.aim((0.0, 10.0), angle=1.0).status is AimStatus.OFF_THE_LINE
        assert BALL.aim((5.0, 10.0), angle=np.pi / 2).status is AimStatus.OFF_THE_LINE

    def test_without_gravity_only_the_line_of_sight_will_do(self):
        aim = STRAIGHT.aim((3.0, 4.0), speed=10.0)
        assert np.allclose(aim.angles, np.arctan2(4.0, 3.0))
        assert np.isclose(aim.low.time, np.expm1(0.5) / 1.0)
        assert aim.miss() < 1e-14
        assert aim.furthest == np.inf
        assert STRAIGHT.aim((3.0, 4.0)).status is AimStatus.ANY_SPEED
        assert STRAIGHT.aim((3.0, 4.0), angle=np.arctan2(4.0, 3.0)).status is AimStatus.ANY_SPEED
        assert STRAIGHT.aim((3.0, 4.0), angle=1.0).status is AimStatus.OFF_THE_LINE

    def test_needed_speed_grows_exponentially_with_the_distance(self):
        distances = np.array([50.0, 100.0, 150.0, 200.0])
        aim = Projectile(mass=1.0, drag=0.1).aim(np.stack([distances, 0 * distances], -1), time=1.0)
        assert np.all(aim.miss() < 1e-11)
        assert np.allclose(np.diff(np.log(aim.low.speed)), 5.0, rtol=0.02)

    def test_the_starting_point_moves_everything(self):
        one = BALL.aim((15.0, 2.0), speed=30.0)
        two = BALL.aim((16.0, 5.0), speed=30.0, start=(1.0, 3.0))
        assert np.allclose(one.angles, two.angles, rtol=1e-12)
        assert two.miss() < 1e-12


class TestReach:
    def test_straight_up_it_is_the_height_of_the_climb(self):
        reach = BALL.furthest(30.0, slope=np.pi / 2)
        assert np.isclose(reach.distance, BALL.launch(velocity=(0.0, 30.0)).apex().y, rtol=1e-13)
        assert np.isclose(BALL.furthest(30.0, slope=np.pi / 2 - 1e-6).distance, reach.distance, rtol=1e-5)

    def test_without_gravity_there_is_no_limit(self):
        reach = STRAIGHT.furthest(30.0, slope=0.3)
        assert (reach.angle, reach.distance) == (0.3, np.inf)

    @pytest.mark.parametrize("slope", [-np.pi / 2, 2.0, np.nan])
    def test_refuses_slopes(self, slope):
        with pytest.raises(errors.InvalidValue):
            BALL.furthest(30.0, slope=slope)

    def test_what_the_search_leaves_open_is_found_all_the_same(self, monkeypatch):
        slopes = np.linspace(-0.5, 1.5, 5)
        usual = BALL.furthest(30.0, slope=slopes)

        def lost(*inputs):
            zenith, most, theta, time, known = farthest(*inputs)
            return zenith * 0.0, most * 0.0, theta, time, known * 0.0

        monkeypatch.setattr(reach, "farthest", lost)
        nested = BALL.furthest(30.0, slope=slopes)
        assert np.allclose(nested.distance, usual.distance, rtol=1e-12, atol=0.0)
        assert np.allclose(nested.angle, usual.angle, rtol=0.0, atol=1e-8)

    def test_no_shot_passes_the_envelope(self):
        points = BALL.envelope(30.0, np.linspace(-0.5, 1.5, 12))
        low, high = (BALL.aim(f * points, speed=30.0).hit for f in (1 - 1e-9, 1 + 1e-9))
        assert low.all()
        assert not high.any()


class TestTolerant:
    def test_no_other_launch_through_the_target_misses_less(self):
        best = BALL.most_tolerant((15.0, 2.0), sigma_angle=0.02, sigma_speed=0.2)
        assert best.aim.hit
        assert not best.at_limit
        for lift in (-0.05, -3e-3, 3e-3, 0.05):
            assert best.miss < self.spread((15.0, 2.0), best.aim.low.angle + lift) * (1 + 1e-9)
        assert np.isclose(best.miss, self.spread((15.0, 2.0), best.aim.low.angle), rtol=1e-9)

    @staticmethod
    def spread(target, angle):
        """The standard deviation of the miss by differences of shots."""
        arc, h = BALL.aim(target, angle=angle).low, 1e-4
        end = arc.arrival()
        across = np.array([-end.vy, end.vx]) / end.speed

        def passed(a, b):
            return BALL.launch(speed=arc.speed + a, angle=arc.angle + b).at(arc.time).position @ across

        ways = [(passed(a, b) - passed(-a, -b)) / (2 * h) for a, b in ((h, 0.0), (0.0, h))]
        return np.hypot(0.2 * ways[0], 0.02 * ways[1])

    def test_the_spread_is_that_of_many_shots(self):
        rng, target = np.random.default_rng(0), np.array([15.0, 2.0])
        best = BALL.most_tolerant(target, sigma_angle=0.002, sigma_speed=0.02)
        arc = best.aim.low
        shots = BALL.launch(speed=rng.normal(arc.speed, 0.02, 4000), angle=rng.normal(arc.angle, 0.002, 4000))
        end = arc.arrival()
        passed = (shots.at(arc.time).position - target) @ np.array([-end.vy, end.vx]) / end.speed
        assert np.isclose(passed.std(), best.miss, rtol=0.1)

    def test_with_perfect_speed_it_is_the_least_speed(self):
        best = BALL.most_tolerant((15.0, 2.0), sigma_angle=0.02, sigma_speed=0.0)
        assert np.isclose(best.aim.low.angle, BALL.aim((15.0, 2.0)).low.angle, atol=1e-5)

    def test_with_a_perfect_angle_faster_is_better_up_to_the_limit(self):
        best = BALL.most_tolerant((15.0, 2.0), sigma_angle=0.0, sigma_speed=0.2, max_speed=40.0)
        assert best.at_limit
        assert np.isclose(best.aim.low.speed, 40.0, rtol=1e-6)

    def test_a_target_that_the_limit_does_not_reach_is_a_no(self):
        best = BALL.most_tolerant([(15.0, 2.0), (50.0, 0.0)], sigma_angle=0.02, sigma_speed=0.2, max_speed=20.0)
        assert [s.name for s in best.aim.status] == ["HIT", "OUT_OF_REACH"]
        assert best.miss[1] == np.inf
        assert np.isclose(best.aim.low.speed[1], 20.0)

    def test_the_mirror_image(self):
        right, left = (BALL.most_tolerant((x, 2.0), sigma_angle=0.02, sigma_speed=0.2) for x in (15.0, -15.0))
        assert np.isclose(right.aim.low.angle, np.pi - left.aim.low.angle, rtol=1e-6)

    def test_refuses(self):
        for words in ({"sigma_angle": 0.0, "sigma_speed": 0.0}, {"sigma_angle": -0.1, "sigma_speed": 0.0},
                      {"sigma_angle": 0.1, "sigma_speed": 0.1, "max_speed": 0.0}):  # fmt: skip
            with pytest.raises(errors.InvalidValue):
                BALL.most_tolerant((15.0, 2.0), **words)
        with pytest.raises(errors.InvalidValue, match="aside"):
            BALL.most_tolerant((0.0, 2.0), sigma_angle=0.1, sigma_speed=0.1)


class TestRoots:
    def test_a_root_beyond_the_end_is_the_end(self):
        assert rising_root(lambda x: (x - 5.0, np.ones_like(x)), 0.0, 0.0, 2.0) == 2.0

    def test_without_an_end_the_bracket_grows(self):
        assert np.isclose(rising_root(lambda x: (x**3 - 1e6, 3 * x**2), 1.0, 0.0, np.inf, longest=3.0), 100.0)

    def test_a_row_that_is_not_a_number_does_not_hold_up_the_others(self):
        roots = rising_root(lambda x, a: (x - a, np.ones_like(x)), 0.0, -9.0, 9.0, np.array([np.nan, 1.0]))
        assert np.isnan(roots[0])
        assert roots[1] == 1.0

    def test_a_falling_function(self):
        cosines = np.array([0.0, 0.5, 0.999])
        root = falling_root(lambda x, c: np.cos(x) - c, 1.0, 0.0, np.pi, cosines, fine=1e-12)
        assert np.allclose(np.cos(root), cosines, atol=1e-11)
