"""Edges of the things that move: shapes, error messages, read-only arrays, kinds."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from coplanar import Displacement, Pose, Twist
from coplanar.errors import InvalidShape, InvalidValue, UnknownName
from coplanar.motion import (
    DrivingHistory,
    HolonomicMotion,
    Odometry,
    OdometryNoise,
    Program,
    Ramp,
    Segment,
    Trapezoid,
    discretize,
)
from tests.engines import NEEDS_NUMBA

LINE = Segment(1.0, 0.0, duration=2.0)


@pytest.mark.parametrize(
    ("parts", "kind"),
    [
        ((0.0, 0.0, 0.0, 0.0), "rest"),
        ((1.0, 0.0, 0.0, 0.0), "line"),
        ((0.0, 0.0, -1.0, 0.0), "line"),
        ((0.0, 1.0, 0.0, 0.0), "spin"),
        ((0.0, 0.0, 0.0, 2.0), "spin"),
        ((1.0, 1.0, 0.0, 0.0), "arc"),
        ((1.0, 0.0, 0.0, 1.0), "clothoid"),
        ((-1.0, 3.0, 0.0, 1e-12), "clothoid"),
        ((0.3, 0.1, 0.6, 0.2), "circle"),
        ((0.0, 0.0, 0.6, 0.2), "circle"),
        ((1.0, 1.0, 1.0, 0.0), "general"),
        ((1.0, 0.0, 1.0, 1.0), "general"),
        ((0.0, 1.0, 1.0, 0.0), "general"),
    ],
)
def test_kinds(parts, kind):
    assert Segment(*parts, duration=1.0).kind == kind


def test_kinds_of_a_batch():
    segments = Segment([1.0, 1.0, 0.0], [0.0, 1.0, 1.0], duration=1.0)
    assert segments.kind.tolist() == ["line", "arc", "spin"]


@pytest.mark.parametrize(
    ("parts", "kappa"),
    [
        ((2.0, 1.0, 0.0, 0.0), 0.5),
        ((-2.0, 1.0, 0.0, 0.0), -0.5),
        ((0.0, 1.0, 0.0, 0.0), np.inf),
        ((0.0, -1.0, 5.0, 0.0), -np.inf),
        ((0.0, 0.0, 2.0, 1.0), 0.5),
        ((0.0, 0.0, 0.0, 1.0), np.inf),
        ((0.0, 0.0, 0.0, 0.0), 0.0),
    ],
)
def test_curvature_of_special_cases(parts, kappa):
    assert Segment(*parts, duration=1.0).curvature(0.0) == kappa


@pytest.mark.parametrize(
    ("v", "a", "time"),
    [(1.0, -2.0, 0.5), (1.0, -1.0, np.inf), (1.0, 1.0, np.inf), (0.0, 1.0, np.inf), (1.0, 0.0, np.inf)],
)
def test_cusps_lie_inside(v, a, time):
    assert Segment(v, 1.0, a, duration=1.0).cusp_time == time


def test_segment_arguments_are_checked():
    with pytest.raises(InvalidValue, match="duration = -1"):
        Segment(1.0, 0.0, duration=-1.0)
    with pytest.raises(InvalidValue, match="omega = nan"):
        Segment(1.0, np.nan, duration=1.0)
    with pytest.raises(InvalidShape, match="v, omega, a, alpha, duration"):
        Segment(np.zeros(2), np.zeros(3), duration=1.0)
    with pytest.raises(InvalidValue, match="at most 100000 rad; split the segment"):
        Segment(1.0, 1e6, duration=1.0)
    with pytest.raises(InvalidValue, match="t = inf"):
        LINE.pose(Pose(), np.inf)
    with pytest.raises(TypeError, match="duration"):
        Segment(1.0, 2.0)


def test_segments_keep_their_own_arrays():
    v = np.ones(2)
    segment = Segment(v, 0.0, duration=1.0)
    v[0] = 9.0
    assert segment.v.tolist() == [1.0, 1.0]
    assert not segment.v.flags.writeable
    with pytest.raises(AttributeError):
        segment.v = v


def test_floats_stay_floats():
    for thing in (LINE, Program([LINE])):
        assert {type(p) for p in thing.pose(Pose(), 1.0).parts} == {float}
        assert {type(p) for p in thing.end(Pose()).parts} == {float}
        assert {type(p) for p in thing.twist(1.0).parts} == {float}
    assert type(LINE.curvature(0.0)) is type(LINE.cusp_time) is type(Program([LINE]).duration) is float


def test_a_segment_of_no_duration_goes_nowhere():
    assert Segment(1.0, 2.0, 3.0, 4.0, duration=0.0).end(Pose(1.0, 2.0, 3.0)) == Pose(1.0, 2.0, 3.0)


def test_slices_of_segments():
    assert Segment([1.0, 2.0], 0.5, duration=1.0)[1] == Segment(2.0, 0.5, duration=1.0)


def test_programs_need_segments():
    with pytest.raises(InvalidShape, match="one segment or more"):
        Program([])
    with pytest.raises(InvalidShape, match="pass a list"):
        Program(LINE)
    with pytest.raises(InvalidShape, match="segment 0"):
        Program([Segment(np.zeros(2), 0.0, duration=1.0), Segment(np.zeros(3), 0.0, duration=1.0)])


def test_programs_are_sequences():
    turn = Segment(0.0, 1.0, duration=1.0)
    program = Program([LINE]).then(turn).then(Program([LINE, turn]))
    assert list(program) == [LINE, turn, LINE, turn]
    assert (len(program), program[-1]) == (4, turn)
    assert program.knots.tolist() == [0.0, 2.0, 3.0, 5.0, 6.0]
    with pytest.raises(IndexError):
        program[4]


def test_robots_join_a_program():
    two = Program([LINE]).then(Segment([1.0, 2.0], 0.0, duration=1.0))
    assert two.end(Pose()).x.tolist() == [3.0, 4.0]
    assert two.pose(Pose(), 2.5).x.tolist() == [2.5, 3.0]


def test_a_program_skips_segments_of_no_duration():
    program = Program([LINE, Segment(5.0, 5.0, duration=0.0), Segment(3.0, 0.0, duration=1.0)])
    assert program.twist([1.0, 2.0, 3.0]).vx.tolist() == [1.0, 3.0, 3.0]


def test_samples_end_at_the_end():
    t, poses = Program([LINE]).sample(Pose(), 0.1)
    assert (t.size, t[-1], poses.x[-1]) == (21, 2.0, 2.0)
    t, poses = Program([Segment([1.0, 2.0], 0.0, duration=1.0)] * 2).sample(Pose(np.ones(2), 0.0, 0.0), 0.3)
    assert t.tolist() == pytest.approx([0.0, 0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.0])
    assert poses.shape == (2, 8)
    assert poses.x[:, -1].tolist() == [3.0, 5.0]
    with pytest.raises(InvalidValue, match="step = 0"):
        Program([LINE]).sample(Pose(), 0.0)
    with pytest.raises(InvalidShape, match="one duration for all robots"):
        Program(Segment(1.0, 0.0, duration=np.ones((2, 1)))).sample(Pose(), 0.1)


def test_samples_of_commands_are_checked():
    with pytest.raises(InvalidValue, match="increasing"):
        Program.from_samples(1.0, 0.0, [1.0, 0.0])
    with pytest.raises(InvalidShape, match=r"v .*needed shape \(\.\.\., 3\) or \(\.\.\., 2\)"):
        Program.from_samples([1.0] * 4, 0.0, [0.0, 1.0, 2.0])
    one, other = (Program.from_samples([1.0, 2.0, 3.0][:n], 0.5, [0.0, 1.0, 3.0]).end(Pose()) for n in (2, 3))
    assert one == other


def test_odometry_arguments_are_checked():
    with pytest.raises(InvalidShape, match=r"pose\.step"):
        Odometry(Displacement(1.0, 0.0, 0.0))
    with pytest.raises(InvalidValue, match="track = 0"):
        Odometry.from_wheels([1.0], [1.0], track=0.0)
    with pytest.raises(InvalidShape, match="left, right, track"):
        Odometry.from_wheels([1.0, 2.0], [1.0, 2.0, 3.0], track=1.0)
    with pytest.raises(InvalidValue, match="forward = -1"):
        OdometryNoise(forward=-1.0)
    ticks = Odometry(Displacement(np.ones(3), 0.0, 0.0))
    with pytest.raises(InvalidShape, match="initial"):
        ticks.covariances(Pose(), OdometryNoise(), np.zeros(3))
    with pytest.raises(InvalidValue, match="symmetric"):
        ticks.covariances(Pose(), OdometryNoise(), np.triu(np.ones((3, 3))))
    assert ticks.covariances(Pose(), np.zeros((3, 3, 3))).shape == (4, 3, 3)


@pytest.mark.parametrize("ticks", [5, 30_000, 500_000])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_what_was_measured_is_finite_however_long_the_log(ticks, value):
    good, bad = np.ones(ticks), np.ones(ticks)
    bad[ticks // 2] = value
    times = np.arange(ticks + 1.0)
    for name, ask in {
        "left": lambda: Odometry.from_wheels(bad, good, track=1.0),
        "right": lambda: Odometry.from_wheels(good, bad, track=1.0),
        "v": lambda: Odometry.from_velocities(bad, 0.0, times),
        "omega": lambda: Odometry.from_velocities(good, bad, times),
    }.items():
        with pytest.raises(InvalidValue, match=rf"^{name} .*\(entry {ticks // 2} is"):
            ask()


def test_wheels_are_named_left_and_right():
    """More on the right turns to the left, by difference over the whole track."""
    path = Odometry.from_wheels(left=[0.0], right=[1.0], track=2.0).path(Pose())
    assert path.theta[-1] == 0.5
    assert path.y[-1] > 0.0


def test_headings_are_not_wrapped():
    spins = Odometry(Displacement(0.0, 0.0, np.full(10, np.pi)))
    np.testing.assert_allclose(spins.path(Pose()).theta[-1], 10 * np.pi)
    np.testing.assert_allclose(Program([Segment(0.0, 2 * np.pi, duration=3.0)]).end(Pose()).theta, 6 * np.pi)


def test_odometry_can_run_backwards():
    t, v, omega = np.array([0.0, 0.5, 2.0]), np.array([1.0, -0.5]), np.array([0.3, 2.0])
    there = Odometry.from_velocities(v, omega, t).path(Pose()).as_array()[-1]
    back = Odometry.from_velocities(v[::-1], omega[::-1], t[::-1]).path(Pose.from_array(there)).as_array()
    np.testing.assert_allclose(back[-1], 0.0, atol=1e-14)


def test_ramp_arguments_are_checked():
    with pytest.raises(InvalidValue, match="give the magnitude; the sign follows from target - start"):
        Ramp.independent([0.0, 0.0], [1.0, 1.0], -1.0)
    with pytest.raises(InvalidValue, match="acceleration = 0"):
        Ramp.synchronised([0.0, 0.0], [1.0, 1.0], 0.0)
    with pytest.raises(UnknownName, match="did you mean 'norm'"):
        Ramp.synchronised([0.0, 0.0], [1.0, 1.0], 1.0, limit="nrm")
    with pytest.raises(InvalidValue, match="where start and target differ"):
        Ramp([0.0, 0.0], [1.0, 0.0], [0.0, 0.0])
    with pytest.raises(InvalidShape, match="v and omega"):
        Ramp.independent(np.zeros(3), np.ones(3), 1.0).as_program()
    with pytest.raises(InvalidShape, match="acceleration"):
        Ramp.independent([0.0, 0.0], [1.0, 1.0], [1.0, 1.0, 1.0])


def test_a_ramp_of_length_zero():
    ramp = Ramp.synchronised([1.0, 2.0], [1.0, 2.0], 3.0)
    assert ramp.duration == 0.0
    assert ramp.velocity(0.0).tolist() == [1.0, 2.0]
    assert ramp.position([0.0, 0.0], 2.0).tolist() == [2.0, 4.0]
    assert ramp.accelerations.tolist() == [0.0, 0.0]


def test_ramps_of_many_robots_are_programs():
    ramp = Ramp.independent(np.zeros((3, 2)), np.arange(1.0, 7.0).reshape(3, 2), 1.0)
    program = ramp.as_program()
    assert program.knots.shape == (3, 3)
    assert program.twist(6.0).vx.tolist() == [0.0, 0.0, 5.0]


def test_ramp_arrays_are_read_only():
    ramp = Ramp.independent([0.0, 0.0], [1.0, 2.0], 1.0)
    assert not any(a.flags.writeable for a in (ramp.start, ramp.target, ramp.durations))


def test_moves_of_no_distance():
    rest = Trapezoid(0.0, 1.0, 1.0)
    assert (rest.duration, rest.peak, rest.position(0.0), rest.velocity(1.0)) == (0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("name", ["limit", "up", "down"])
def test_moves_are_checked(name):
    with pytest.raises(InvalidValue, match=f"{name} = -1.*give the magnitude"):
        Trapezoid(**{"distance": 1.0, "limit": 1.0, "up": 1.0, name: -1.0})


def test_holonomic_arguments_are_checked():
    with pytest.raises(UnknownName, match="hold, linear"):
        HolonomicMotion.from_samples([0.0, 1.0], 1.0, 0.0, between="cubic")
    with pytest.raises(InvalidValue, match="increasing"):
        HolonomicMotion.from_samples([1.0, 0.0], 1.0, 0.0)
    with pytest.raises(InvalidShape, match="vx, vy, omega, t"):
        HolonomicMotion.from_samples([0.0, 1.0], [1.0, 2.0, 3.0], 0.0)
    with pytest.raises(InvalidShape, match=r"\(n,\)"):
        HolonomicMotion([[1.0, 0.0, 0.0]], np.zeros(3), [[1.0]])
    with pytest.raises(InvalidShape, match=r"\(\.\.\., 1, 3\)"):
        HolonomicMotion(np.zeros((2, 3)), np.zeros(3), [1.0])
    motion = HolonomicMotion.from_samples([0.0, 1.0], 1.0, 0.0)
    assert not any(a.flags.writeable for a in (motion.velocities, motion.durations, motion.ways, motion.knots))


def test_holonomic_floats_stay_floats():
    motion = HolonomicMotion([[1.0, 0.0, 0.0]], np.zeros(3), [2.0])
    assert {type(p) for p in motion.pose(Pose(), 0.5).parts} == {float}
    assert motion.velocity([-1.0, 1.0, 3.0])[:, 0].tolist() == [0.0, 1.0, 0.0]


def test_discretised_steps_turn_by_half_a_turn_at_most():
    with pytest.raises(InvalidValue, match="take a shorter dt"):
        discretize(Twist(1.0, 0.0, 4.0), 1.0)
    with pytest.raises(InvalidValue, match="dt = 0"):
        discretize(Twist(1.0, 0.0, 4.0), 0.0)


def test_driving_histories_are_checked():
    with pytest.raises(UnknownName, match="did you mean 'exact'"):
        DrivingHistory.square().path(Pose(), "exakt")
    with pytest.raises(InvalidValue, match="whole fraction"):
        DrivingHistory.square(0.3)
    with pytest.raises(InvalidShape, match="omega"):
        DrivingHistory([0.0, 1.0], 1.0, [1.0, 2.0, 3.0])


def test_many_robots_drive_one_clock():
    t = np.linspace(0.0, 1.0, 6)
    v = np.array([[1.0], [2.0]]) * np.ones(6)
    history, start = DrivingHistory(t, v, 0.5), Pose(np.array([0.0, 1.0]), 0.0, 0.0)
    exact, rk4 = history.path(start), history.path(start, "rk4")
    assert exact.shape == rk4.shape == (2, 6)
    np.testing.assert_allclose(rk4.as_array(), exact.as_array(), atol=1e-7)
    np.testing.assert_allclose(history.as_program().poses(start).as_array(), exact.as_array(), atol=1e-12)


@NEEDS_NUMBA
def test_a_long_log_takes_the_memory_of_what_it_answers():
    odometry = Odometry.from_wheels(*np.full((2, 300_000), 0.01), track=0.4)
    column = 8 * 300_000
    for call, columns in ((odometry.path, 3), (odometry.end, 0)):
        call(Pose())
        tracemalloc.start()
        call(Pose())
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < (columns + 0.5) * column


def test_the_end_of_a_log_is_the_last_of_its_poses():
    rng = np.random.default_rng(3)
    for lead, ticks in (((), 5), ((), 30_000), ((4,), 7), ((300,), 90)):
        odometry = Odometry.from_wheels(*rng.uniform(-0.1, 0.2, (2, *lead, ticks)), track=0.4)
        start = Pose(*rng.uniform(-1.0, 1.0, (3, *lead)))
        assert odometry.end(start) == odometry.path(start)[..., -1]
