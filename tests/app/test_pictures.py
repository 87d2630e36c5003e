"""Pictures: what is drawn is what the library computes; units, scales, words that keep out of each other's way."""

from __future__ import annotations

import functools
import itertools
import os
import subprocess
import sys
from math import pi

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure

from coplanar import (
    Arm,
    Astroid,
    Circle,
    FrameTree,
    HolonomicMotion,
    Lemniscate,
    PointTracker,
    PolarController,
    Pose,
    Program,
    Projectile,
    Ramp,
    RollingWheel,
    Run,
    Segment,
    Trapezoid,
    Twist,
    Unicycle,
    Wheel,
    WheeledBase,
    simulate,
    trace,
    viz,
)  # fmt: skip
from coplanar.errors import InvalidShape, InvalidValue, UnknownName
from coplanar.motion import Comparison
from coplanar.viz.style import DARK, LIGHT, THEMES

ARM, LIMITED = Arm((1.0, 0.7)), Arm((1.0, 0.7), limits=[(-0.5, 1.9), (0.2, 2.2)])
SLIDE = Arm((1.0, 0.3), joints="RP", limits=[(-1.0, 2.0), (0.0, 0.8)])
DIFFERENTIAL = WheeledBase.differential(track=0.5, radius=0.1)
MECANUM = WheeledBase.mecanum(radius=0.1, wheelbase=0.6, track=0.5)
BALL = Projectile(mass=1.0, drag=0.02)
TRACKER = PointTracker((0.05, 0.0), kp=100.0, kd=0.5, error_against="next")
PROGRAM = Program([Segment(v, w, duration=T) for v, w, T in ((1.0, 1.2, 1.5), (0.8, -1.6, 1.2), (0.0, pi / 2, 1.0))])
HOLONOMIC = HolonomicMotion.from_accelerations([1.0, 1.5], [(0.8, 0.0, 0.0), (0.0, 0.6, 0.2)])
RAMP = Ramp.independent((0.4, 0.2), (1.2, -0.6), (0.5, 0.25))
TREE = (
    FrameTree("world")
    .with_frame("robot", "world", Pose(2.0, 1.0, 0.5))
    .with_frame("camera", "robot", Pose(0.6, 0.2, -0.4))
    .with_frame("goal", "world", Pose(3.0, -0.5, 2.0))
)


@functools.cache
def tracked():
    reference = Astroid(1.0).over(2.0)
    return simulate(Unicycle(), TRACKER, reference, step=0.01, start=TRACKER.pose_for((1.0, 0.0), pi / 2))


def several(count=3):
    start = Pose(np.linspace(-2.0, -1.0, count), np.linspace(1.0, -1.0, count), np.zeros(count))
    return simulate(Unicycle(), PolarController(Pose()), duration=1.0, step=0.02, start=start)


def flown():
    way = BALL.launch(speed=30.0, angle=1.0).sample(4.0)
    return Run({"t": way.time, "x": way.x, "y": way.y, "vx": way.vx, "vy": way.vy}, "flight")


def traced(arm=ARM, curve=None, **options):
    return trace(arm, curve or Circle(0.3, center=(1.0, 0.5)), 51, **options)


@functools.cache
def compared():
    program = Program([Segment(1.0, -0.5, a=0.2, alpha=0.4, duration=6.0)])
    return Comparison(program, Pose(), steps=(0.6, 0.3, 0.15))


PLANE = {
    "arm": lambda ax: viz.plot_arm(Arm((0.5, 0.3)), (0.3, 0.4), ax),
    "arm with its ellipse": lambda ax: viz.plot_arm(ARM, (0.6, 0.9), ax, ellipse="velocity", workspace=True),
    "arm that is singular": lambda ax: viz.plot_arm(ARM, (0.6, 0.0), ax, ellipse="force"),
    "arm that slides": lambda ax: viz.plot_arm(SLIDE, (0.7, 0.4), ax, workspace=True),
    "base": lambda ax: viz.plot_base(DIFFERENTIAL, ax),
    "base of mecanum wheels": lambda ax: viz.plot_base(MECANUM, ax),
    "base that cannot move": lambda ax: viz.plot_base(
        WheeledBase([Wheel(0.3, 0.2, 0.4, 0.06), Wheel(-0.3, 0.2, -0.4, 0.06), Wheel(-0.3, -0.2, -0.6, 0.06)]), ax
    ),
    "envelope": lambda ax: viz.plot_envelope(BALL, 30.0, ax),
    "frames": lambda ax: viz.plot_frames(TREE, ax),
    "headings": lambda ax: viz.plot_headings(tracked(), ax),
    "holonomic": lambda ax: viz.plot_holonomic(HOLONOMIC, ax),
    "icr": lambda ax: viz.plot_icr(DIFFERENTIAL, Twist(0.6, 0.0, 1.0), ax),
    "icr that is not": lambda ax: viz.plot_icr(DIFFERENTIAL, Twist(0.6, 0.0, 0.0), ax),
    "integrators": lambda ax: viz.plot_integrators(compared(), ax),
    "path": lambda ax: viz.plot_path(Lemniscate(1.0), ax),
    "program": lambda ax: viz.plot_program(PROGRAM, ax),
    "reach": lambda ax: viz.plot_reach(ARM.inverse((1.0, 0.6)), ax),
    "reach, limited": lambda ax: viz.plot_reach(LIMITED.inverse((0.2, -0.9)), ax),
    "reach, too close": lambda ax: viz.plot_reach(ARM.inverse((0.1, 0.1)), ax),
    "reach, too far": lambda ax: viz.plot_reach(ARM.inverse((1.9, 0.9)), ax),
    "rolling": lambda ax: viz.plot_rolling(RollingWheel(0.3), 2.0, ax),
    "rolling with slip": lambda ax: viz.plot_rolling(RollingWheel(0.3), 2.0, ax, slip=-0.3),
    "segment": lambda ax: viz.plot_segment(Segment(1.0, 0.6, a=-0.8, duration=2.5), ax),
    "shots": lambda ax: viz.plot_shots(BALL.aim((30.0, 2.0), speed=30.0), ax),
    "shots that land": lambda ax: viz.plot_shots(BALL.launch(speed=30.0, angle=0.9), ax),
    "shots, short": lambda ax: viz.plot_shots(BALL.aim((60.0, 0.0), speed=20.0), ax),
    "trace": lambda ax: viz.plot_trace(traced(), ax),
    "trace that fails": lambda ax: viz.plot_trace(traced(Arm((1.0, 0.6)), Circle(0.7, center=(1.1, 0.3))), ax),
    "track": lambda ax: viz.plot_track(tracked(), ax, reference=Astroid(1.0), point=(0.05, 0.0)),
    "workspace": lambda ax: viz.plot_workspace(LIMITED, ax),
}
OTHERS = {
    "commands": (lambda ax: viz.plot_commands(tracked(), ax), "time [s]", "v [m/s], omega [rad/s]"),
    "convergence": (lambda ax: viz.plot_convergence(compared(), ax, tolerance=1e-1), "step [s]", "largest error [m]"),
    "errors": (lambda ax: viz.plot_errors(tracked(), ax), "time [s]", "error [mm]"),
    "flight": (lambda ax: viz.plot_flight(BALL.launch(speed=9.0, angle=1.0), 1.0, ax), "time [s]", "velocity [m/s]"),
    "joints": (lambda ax: viz.plot_joints(traced(), ax), "curve parameter", "joint [rad]"),
    "poles": (lambda ax: viz.plot_poles(TRACKER.stability(0.01, speed=1.0), ax), "Re z", "Im z"),
    "ramp": (lambda ax: viz.plot_ramp(RAMP, ax), "time [s]", "velocity [m/s]"),
    "velocities": (lambda ax: viz.plot_velocities(PROGRAM, ax), "time [s]", "v [m/s], omega [rad/s]"),
}
EVERY = PLANE | {name: draw for name, (draw, _, _) in OTHERS.items()}


def lines(ax, label=None):
    return [line.get_xydata() for line in ax.lines if label is None or line.get_label() == label]


def holds(ax, points):
    """Whether some line or mark is drawn through exactly these points."""
    wanted = np.atleast_2d(points)
    return any(xy.shape == wanted.shape and np.allclose(xy, wanted, rtol=0, atol=1e-12) for xy in lines(ax))


def words(ax):
    return [text.get_text() for text in ax.texts]


def legend(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


@pytest.mark.parametrize("name", PLANE)
def test_the_plane_has_one_scale_and_its_unit(name):
    ax = PLANE[name](None)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x [m]", "y [m]")
    assert ax.get_aspect() == 1.0


@pytest.mark.parametrize("name", OTHERS)
def test_other_axes_have_their_units(name):
    draw, xlabel, ylabel = OTHERS[name]
    ax = draw(None)
    assert (ax.get_xlabel(), ax.get_ylabel()) == (xlabel, ylabel)


@pytest.mark.parametrize("name", EVERY)
def test_words_are_inside_the_figure_and_apart(name):
    figure = EVERY[name](None).figure
    figure.draw_without_rendering()
    ax = figure.axes[0]
    shown = [text for text in (*ax.texts, ax.title, ax._left_title, ax.xaxis.label, ax.yaxis.label) if text.get_text()]
    boxes = [text.get_window_extent() for text in shown]
    boxes += [ax.get_legend().get_window_extent()] if ax.get_legend() else []
    for box in boxes:
        assert box.x0 >= -1 and box.y0 >= -1 and box.x1 <= figure.bbox.x1 + 1 and box.y1 <= figure.bbox.y1 + 1  # noqa: PT018
    for one, other in itertools.combinations(boxes, 2):
        assert not (one.overlaps(other)), (one, other)


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("name", EVERY)
def test_every_colour_is_the_themes(name, theme):
    with viz.drawn_in(theme):
        ax = EVERY[name](None)
    known = {*THEMES[theme].series, THEMES[theme].ink, THEMES[theme].muted, THEMES[theme].surface, THEMES[theme].grid}
    drawn = {mpl.colors.to_hex(line.get_color()) for line in ax.lines}
    drawn |= {mpl.colors.to_hex(text.get_color()) for text in ax.texts}
    drawn |= {mpl.colors.to_hex(patch.get_edgecolor()) for patch in ax.patches if patch.get_edgecolor()[3] > 0.0}
    assert drawn <= known


@pytest.mark.parametrize("name", EVERY)
def test_axes_that_are_given_are_the_only_thing_that_changes(name):
    figure = Figure()
    mine, other = figure.subplots(1, 2)
    before = dict(mpl.rcParams)
    assert EVERY[name](mine) is mine
    assert dict(mpl.rcParams) == before
    assert not other.has_data()
    assert figure.axes == [mine, other]
    assert mine.get_facecolor() == other.get_facecolor()
    assert mine.has_data()


def test_dark_axes_get_light_colours():
    for background, theme in (("black", DARK), ("white", LIGHT)):
        ax = Figure().subplots()
        ax.set_facecolor(background)
        viz.plot_path([(0, 0), (1, 1)], ax)
        assert ax.lines[0].get_color() == theme.series[0]


def test_an_arm_is_drawn_where_it_is():
    q = (0.3, 0.4)
    ax = viz.plot_arm(ARM, q)
    points = ARM.points(q)
    assert holds(ax, points)
    assert holds(ax, points[:2])
    assert holds(ax, points[1:])
    assert np.allclose(points[-1], ARM.forward(q).position)
    arcs = [xy for xy in lines(ax) if len(xy) == 41]
    assert len(arcs) == 2
    turned = [np.unwrap(np.arctan2(*(xy - centre).T[::-1])) for xy, centre in zip(arcs, points, strict=False)]
    assert [float(t[-1] - t[0]) for t in turned] == pytest.approx(q)
    assert turned[0][0] == pytest.approx(0.0, abs=1e-12)


def test_every_posture_of_a_batch_is_drawn():
    q = np.random.default_rng(0).uniform(-2, 2, (2, 3, 2))
    ax = viz.plot_arm(ARM, q)
    assert all(holds(ax, ARM.points(posture)) for posture in q.reshape(-1, 2))


def test_the_ellipse_is_the_arms():
    q = (0.6, 0.9)
    ax = viz.plot_ellipse(ARM, q, scale=0.1)
    assert holds(ax, ARM.ellipse(q).outline(ARM.forward(q).position, scale=0.1))


def test_an_unbounded_ellipse_is_a_line_across_the_arm():
    ax = viz.plot_ellipse(ARM, (0.6, 0.0), kind="force")
    (line,) = lines(ax)
    way, tool = np.diff(line, axis=0)[0], ARM.forward((0.6, 0.0)).position
    assert np.allclose(line.mean(axis=0), tool)
    assert abs(way @ (np.cos(0.6), np.sin(0.6))) == pytest.approx(np.hypot(*way))  # along the stretched arm


def test_the_workspace_is_the_arms():
    ring = viz.plot_workspace(ARM)
    radii = sorted({round(float(r), 12) for xy in lines(ring) for r in np.hypot(*xy.T)})
    assert radii == [0.3, 1.7]
    limited, space = viz.plot_workspace(LIMITED), LIMITED.workspace()
    for xy in lines(limited):
        assert np.all(space.gap(xy) < 1e-9)
    region = limited.patches[0].get_path()
    inside = np.random.default_rng(1).uniform(-1.8, 1.8, (400, 2))
    assert np.array_equal(region.contains_points(inside), space.contains(inside))
    hollow = ring.patches[0].get_path().to_polygons()
    areas = [0.5 * float(np.sum(p[:-1, 0] * p[1:, 1] - p[1:, 0] * p[:-1, 1])) for p in hollow]
    assert sum(areas) == pytest.approx(pi * (1.7**2 - 0.3**2), rel=1e-3)
    assert {line.get_linestyle() for line in viz.plot_workspace(SLIDE).lines} == {"--"}


def test_both_elbows_the_target_and_the_gap():
    answer = ARM.inverse((1.0, 0.6))
    ax = viz.plot_reach(answer)
    assert all(holds(ax, ARM.points(q)) for q in answer.branches)
    assert holds(ax, [(1.0, 0.6)])
    far = ARM.inverse((1.9, 0.9))
    ax = viz.plot_reach(far)
    assert holds(ax, [far.nearest, (1.9, 0.9)])
    assert words(ax) == [f"gap {far.gap:.3g} m"]
    assert ax.get_title(loc="left").replace("\n", " ") == far.status.value


def test_a_forbidden_branch_is_dotted():
    answer = LIMITED.inverse((0.6, 1.3))
    forbidden = answer.branches[~answer.allowed][0]
    ax = viz.plot_reach(answer)
    dotted = [line.get_xydata() for line in ax.lines if line.get_linestyle() == ":"]
    assert len(dotted) == 1
    assert np.allclose(dotted[0], LIMITED.points(forbidden))


def test_many_targets_are_all_drawn():
    targets = np.array([(1.0, 0.5), (0.0, 2.5), (-1.0, 0.2)])
    ax = viz.plot_reach(ARM.inverse(targets))
    assert holds(ax, targets)
    assert len(words(ax)) == 1


def test_an_arm_without_a_bound_has_no_workspace_behind_it():
    answer = Arm((1.0, 0.3), joints="RP").inverse((3.0, 1.0))
    ax = viz.plot_reach(answer)
    assert legend(ax) == ["target"]
    assert holds(ax, answer.chain.points(answer.q))


def test_wheels_stand_where_the_table_says():
    ax = viz.plot_base(MECANUM)
    tyres = [p.get_path().vertices for p in ax.patches if len(p.get_path().vertices) == 5][1::2]
    centres = [v[:4].mean(axis=0) for v in tyres]
    assert np.allclose(centres, [(w.x, w.y) for w in MECANUM.wheels])
    assert words(ax) == ["1", "2", "3", "4"]
    axles = [np.diff(xy, axis=0)[0] for xy in lines(ax) if len(xy) == 2]
    assert len(axles) == 16
    for wheel, axle in zip(np.repeat(MECANUM.wheels, 4), axles, strict=True):
        angle = wheel.drive_angle + wheel.roller_angle
        assert abs(axle[0] * np.sin(angle) - axle[1] * np.cos(angle)) < 1e-12


def test_what_a_base_cannot_do_is_crossed():
    ax = viz.plot_base(DIFFERENTIAL)
    crosses = [line for line in ax.lines if line.get_marker() == "x"]
    assert len(crosses) == 1
    assert ax.get_title(loc="left") == DIFFERENTIAL.cannot[0]
    arrow = next(p for p in ax.patches if mpl.colors.to_hex(p.get_edgecolor()) == LIGHT.series[3])
    start, end = arrow._posA_posB
    assert start[0] == end[0]
    assert end[1] > start[1]
    assert not [line for line in viz.plot_base(MECANUM).lines if line.get_marker() == "x"]


def test_the_icr_is_on_every_axle():
    twist = Twist(0.6, 0.0, 1.5)
    ax = viz.plot_icr(DIFFERENTIAL, twist)
    assert holds(ax, [(0.0, 0.4)])
    for wheel in DIFFERENTIAL.wheels:
        assert holds(ax, [(wheel.x, wheel.y), (0.0, 0.4)])
    assert "ICR, R = 0.4 m" in words(ax)
    arrows = [p._posA_posB for p in ax.patches if hasattr(p, "_posA_posB")][1:]
    ways = [np.subtract(end, start) for start, end in arrows]
    assert ways[0][0] / ways[1][0] == pytest.approx((0.4 - 0.25) / (0.4 + 0.25))  # speeds grow with the distance
    assert [start for start, _ in arrows] == [(w.x, w.y) for w in DIFFERENTIAL.wheels]


def test_rolling_says_what_the_wheel_says():
    wheel = RollingWheel(0.3)
    ax = viz.plot_rolling(wheel, 2.0)
    assert words(ax) == ["centre 0.6 m/s", "contact 0 m/s", "top 1.2 m/s"]
    assert len([p for p in ax.patches if hasattr(p, "_posA_posB")]) == 11 + 1  # the contact stands still


def test_frames_stand_where_the_tree_says():
    for seen_from in ("world", "camera"):
        ax = viz.plot_frames(TREE, seen_from=seen_from)
        assert sorted(words(ax)) == sorted(TREE.names)
        for name in TREE.names:
            assert holds(ax, TREE.pose(name, seen_from).position)
    with pytest.raises(InvalidShape, match="names"):
        viz.plot_frames(Pose([0.0, 1.0], 0.0, 0.0), names=("A",))


def test_paths_of_every_member():
    few = Segment(1.0, np.linspace(-1.0, 1.0, 3), duration=2.0)
    assert len(viz.plot_segment(few).lines) == 3
    many = viz.plot_segment(Segment(1.0, np.linspace(-1.0, 1.0, 40), duration=2.0))
    (bundle,) = many.collections
    assert len(bundle.get_segments()) == 40
    assert np.allclose(bundle.get_segments()[-1][-1], Segment(1.0, 1.0, duration=2.0).end(Pose()).position)
    with pytest.raises(InvalidShape, match="path"):
        viz.plot_path([1.0, 2.0])
    with pytest.raises(InvalidShape, match="poses"):
        viz.plot_headings([(1.0, 2.0)])


def test_a_segment_with_its_cusp():
    segment = Segment(1.0, 0.6, a=-0.8, duration=2.5)
    ax = viz.plot_segment(segment)
    assert holds(ax, segment.pose(Pose(), segment.cusp_time).position)
    assert legend(ax) == ["cusp"]
    assert lines(ax)[0][-1] == pytest.approx(segment.end(Pose()).position)


def test_a_program_with_its_joints():
    start = Pose(1.0, 2.0, 0.5)
    ax = viz.plot_program(PROGRAM, start=start)
    assert holds(ax, PROGRAM.poses(start).position)


def test_velocities_are_the_motions():
    t = np.linspace(0.0, PROGRAM.duration, 401)
    v, omega = lines(viz.plot_velocities(PROGRAM))
    assert np.array_equal(v, np.column_stack([t, PROGRAM.twist(t).vx]))
    assert np.array_equal(omega[:, 1], PROGRAM.twist(t).omega)
    robots = Program(Segment([[1.0, 1.0], [1.0, 2.0]], [[0.0, 1.0], [0.5, -1.0]], duration=1.0))
    assert lines(viz.plot_velocities(robots))[1][-1, 1] == 2.0
    assert len(viz.plot_velocities(Segment([1.0, 2.0], 0.0, duration=[1.0, 2.0])).lines) == 4
    assert viz.plot_velocities(HOLONOMIC).get_ylabel() == "vx, vy [m/s], omega [rad/s]"
    move = Trapezoid(3.0, 1.0, 1.0)
    assert lines(viz.plot_velocities(move))[0][:, 1].max() == pytest.approx(move.peak)
    assert holds(viz.plot_velocities(RAMP), [(RAMP.durations[1], RAMP.target[1])])
    with pytest.raises(InvalidShape, match="names"):
        viz.plot_ramp(RAMP, names=("v",))


def test_both_arcs_end_at_the_target():
    aim = BALL.aim((30.0, 2.0), speed=30.0)
    ax = viz.plot_shots(aim)
    low, high = lines(ax)[:2]
    for arc in (low, high):
        assert arc[-1] == pytest.approx((30.0, 2.0), abs=1e-9)
    limit = lines(ax, "envelope")[0]
    assert np.allclose(limit, BALL.envelope(30.0, np.arctan2(limit[:, 1], limit[:, 0])), atol=1e-9)


def test_a_target_out_of_reach_to_the_left():
    aim = BALL.aim((-60.0, 1.0), speed=20.0, start=(0.0, 1.0))
    ax = viz.plot_shots(aim)
    assert words(ax) == [f"short by {aim.shortfall:.4g} m"]
    assert holds(ax, [(-aim.furthest, 1.0), (-60.0, 1.0)])
    assert any(label.startswith("least speed") for label in legend(ax))
    assert lines(ax, "envelope")[0][0, 0] < -10.0


def test_many_aims_and_many_shots():
    aim = BALL.aim([(30.0, 2.0), (20.0, 5.0), (60.0, 0.0)], speed=30.0)
    ax = viz.plot_shots(aim)
    ends = [tuple(xy[-1].round(6)) for xy in lines(ax) if len(xy) == 161]
    assert len(ends) == 5
    assert ends.count((30.0, 2.0)) == ends.count((20.0, 5.0)) == 2
    shots = BALL.launch(speed=30.0, angle=np.linspace(0.2, 1.3, 12))
    ax = viz.plot_shots(shots)
    assert len(ax.collections[0].get_segments()) == 12
    assert holds(ax, shots.impact().position)
    with pytest.raises(InvalidValue, match="duration"):
        viz.plot_shots(BALL.launch(speed=3.0, angle=1.0), level=10.0)
    with pytest.raises(UnknownName, match="quantity"):
        viz.plot_flight(BALL.launch(speed=3.0, angle=1.0), 1.0, quantity="jerk")


def test_a_trace_with_what_it_cannot_follow():
    answer = traced(Arm((1.0, 0.6)), Circle(0.7, center=(1.1, 0.3)))
    ax = viz.plot_trace(answer)
    tool = lines(ax, "tool")[0]
    assert np.array_equal(np.isfinite(tool[:, 0]), answer.followed)
    for failure in answer.failures:
        ends = answer.curve.position([failure.first, failure.last])
        assert any(np.allclose(xy[[0, -1]], ends) for xy in lines(ax, failure.reason.value))
    assert legend(ax).count(answer.failures[0].reason.value) == 1
    joints = viz.plot_joints(answer)
    assert np.array_equal(lines(joints)[1][:, 1], answer.q[:, 1])
    assert len(joints.patches) == len(answer.failures)


def test_singular_points_are_marked():
    answer = traced(Arm((1.0, 1.0)), Lemniscate(1.0), at_singular="through")
    places = answer.curve.position(np.array([p.parameter for p in answer.singular_points]))
    assert holds(viz.plot_trace(answer), places)


def test_poles_are_the_reports():
    report = TRACKER.stability(0.009, method="rk4", speed=1.0)
    ax = viz.plot_poles(report)
    assert holds(ax, np.column_stack([report.poles.real, report.poles.imag]))
    assert holds(ax, np.column_stack([report.lateral_poles.real, report.lateral_poles.imag]))
    (circle,) = lines(ax, "stability boundary")
    assert np.allclose(np.hypot(*circle.T), 1.0)
    batch = PointTracker((0.05, 0.0), kp=[50.0, 250.0]).stability(0.01)
    ax = viz.plot_poles(batch)
    assert holds(ax, np.column_stack([batch.poles.ravel().real, batch.poles.ravel().imag]))
    assert ax.get_xlim()[1] > 1.5
    assert ax.get_title(loc="left") == ""


def test_commands_hold_and_errors_come_in_millimetres():
    run = tracked()
    ax = viz.plot_commands(run)
    assert [line.get_drawstyle() for line in ax.lines] == ["steps-pre"] * 2
    assert np.array_equal(lines(ax)[1][:, 1], run["omega"])
    errors = viz.plot_errors(run)
    assert np.array_equal(lines(errors)[0][:, 1], 1000.0 * run["ex"])
    assert viz.plot_errors(several()).get_ylabel() == "error rho [m]"
    assert viz.plot_commands(run, names=("omega",)).get_ylabel() == "omega [rad/s]"
    with pytest.raises(UnknownName, match="omega"):
        viz.plot_commands(run, names=("omeg",))
    with pytest.raises(InvalidValue, match="no commands"):
        viz.plot_commands(flown())
    with pytest.raises(InvalidValue, match="no errors"):
        viz.plot_errors(flown())


def test_the_track_of_a_point_and_its_robots():
    run = tracked()
    ax = viz.plot_track(run, reference=Astroid(1.0), point=(0.05, 0.0), length=0.06, count=4)
    assert np.allclose(lines(ax, "path")[0], run.poses @ np.array([0.05, 0.0]))
    noses = [xy for xy in lines(ax) if xy.shape == (2, 2)]
    assert len(noses) == 4
    last = run.poses.as_array()[-1]
    assert np.allclose(noses[-1], [last[:2], last[:2] + 0.06 * np.array([np.cos(last[2]), np.sin(last[2])])])


@pytest.mark.parametrize(
    ("run", "labels"),
    [
        (tracked, ["y [m]", "v [m/s]", "omega [rad/s]", "error [mm]"]),
        (several, ["y [m]", "v [m/s]", "omega [rad/s]", "error rho [m]"]),
        (flown, ["y [m]", "position [m]", "velocity [m/s]"]),
        (lambda: traced().as_run(5.0), ["y [m]", "joint [rad]", "error [mm]"]),
        (lambda: Run({"t": [0.0, 1.0], "pressure": [1.0, 2.0]}), ["pressure"]),
        (lambda: Run({"t": [0.0, 1.0], "x": [1.0, 2.0], "y": [0.0, 1.0]}), ["y [m]"]),
    ],
)
def test_the_overview_has_a_picture_for_everything(run, labels):
    figure = run().plot()
    assert [ax.get_ylabel() for ax in figure.axes] == labels
    figure.draw_without_rendering()


def test_a_diverged_run_is_drawn_as_far_as_it_goes():
    tracker = PointTracker((0.05, 0.0), kp=100.0, kd=0.5, error_against="next")
    with np.errstate(all="ignore"):
        run = simulate(Unicycle(), tracker, Astroid(1.0).over(60.0), step=0.05, method="rk4")
    assert not np.isfinite(run["x"]).all()
    figure = run.plot()
    figure.draw_without_rendering()
    assert len(viz.scene_of_run(run).times) < len(run)


def test_integrators_lie_over_the_exact_path():
    answer = compared()
    ax = viz.plot_integrators(answer, step=0.3)
    for line, method in zip(ax.lines[1:], answer.methods, strict=True):
        assert np.array_equal(line.get_xydata(), answer.path(method, 0.3)[1].position)
        assert line.get_label() == f"{method}, {answer.error(method, 0.3):.2g} m off"


def test_convergence_shows_the_errors_and_the_largest_step():
    answer = compared()
    ax = viz.plot_convergence(answer, tolerance=1e-1)
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")
    for method, errors, order in zip(answer.methods, answer.errors(), answer.orders(), strict=True):
        assert holds(ax, np.column_stack([answer.steps, errors]))
        step = answer.largest_step(method, 1e-1)
        assert f"{method}, order {order:.1f}; 0.1 m: {step:.3g} s" in legend(ax)


HEADLESS = """
import sys
import coplanar.viz
assert "matplotlib" not in sys.modules
import coplanar as c
from coplanar import viz
run = c.simulate(c.Unicycle(), c.PolarController(c.Pose()), duration=1.0, step=0.1, start=c.Pose(1.0, 1.0, 0.0))
run.plot().savefig(sys.argv[1] + "/run.png")
run.animate(sys.argv[1] + "/run.gif", size=(160, 120))
viz.plot_arm(c.Arm((1.0, 1.0)), (0.1, 0.2)).figure.savefig(sys.argv[1] + "/arm.svg")
assert "<iframe" in run._repr_html_()
assert "matplotlib.pyplot" not in sys.modules, "pyplot"
import matplotlib
assert not any("tk" in name.lower() or "qt" in name.lower() for name in sys.modules if "backend" in name)
"""


def test_no_screen_no_backend_no_pyplot(tmp_path):
    clean = {k: v for k, v in os.environ.items() if k not in ("MPLBACKEND", "DISPLAY", "WAYLAND_DISPLAY")}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", HEADLESS, str(tmp_path)], env=clean, capture_output=True, text=True,
        timeout=120, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert sorted(p.name for p in tmp_path.iterdir()) == ["arm.svg", "run.gif", "run.png"]
