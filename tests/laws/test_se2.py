"""SE(2) is a group, exp and log are what they are called, and their Jacobians are derivatives."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from coplanar import Displacement, Pose, Twist, wrap_angle
from coplanar.laws import se2
from tests.engines import BATCH_SHAPES, ENGINES, on_engine

EPS = np.finfo(float).eps
NEARLY_NOTHING = [0.0, *(s * 10.0**-k for k in range(1, 17) for s in (1.0, -1.0))]
HALF_TURNS = [math.pi, -math.pi, math.nextafter(math.pi, 0.0), math.pi / 2, -math.pi / 2]
# Numbers below 1e-307 are left out: JAX takes them for 0.
NUMBERS = st.one_of(st.floats(-3.0, 3.0, allow_subnormal=False), st.sampled_from(NEARLY_NOTHING))
ANGLES = st.one_of(st.floats(-10.0, 10.0, allow_subnormal=False), st.sampled_from(NEARLY_NOTHING + HALF_TURNS))
SHAPES = st.sampled_from(BATCH_SHAPES)
SPECIAL = sorted(
    {
        0.0,
        *(10.0**-k for k in range(17)),
        *(math.pi / 2 + e for e in (0.0, EPS, -EPS, 1e-8, -1e-8)),
        *(math.pi - 10.0**-k for k in range(17)),
        math.pi,
    }
)
INSIDE = [*SPECIAL, *(-a for a in SPECIAL if a != math.pi)]  # (-pi, pi]


def triples(shape, kind=ANGLES):
    """Three columns of one shape: two numbers and an angle."""
    column = npst.arrays(float, shape, elements=NUMBERS)
    return st.tuples(column, column, npst.arrays(float, shape, elements=kind))


def several(count, kind=ANGLES):
    """Triples that share one of the batch shapes."""
    return SHAPES.flatmap(lambda shape: st.tuples(*(triples(shape, kind) for _ in range(count))))


def apart(one, other):
    """Largest difference between two triples."""
    return max(float(np.max(np.abs(a - b))) for a, b in zip(one, other, strict=True))


def size(*groups):
    """Largest number among them, at least 1: what a rounding error is measured by."""
    return max(1.0, *(float(np.max(np.abs(a))) for group in groups for a in group))


on_every_engine = pytest.mark.parametrize("engine", ENGINES)
some = settings(deadline=None, max_examples=25, derandomize=True)


@on_every_engine
@some
@given(several(3))
def test_group_axioms(engine, poses):
    def law(name, *args):
        return on_engine(engine, getattr(se2, name), *args)

    a, b, c = poses
    room = 40 * EPS * size(a, b, c)
    zero = [np.zeros_like(part) for part in a]
    left = law("compose", *law("compose", *a, *b), *c)
    assert left[0].shape == a[0].shape
    assert apart(left, law("compose", *a, *law("compose", *b, *c))) <= room
    assert apart(law("compose", *a, *zero), a) == 0.0
    assert apart(law("compose", *zero, *a), a) == 0.0
    assert apart(law("compose", *a, *law("inverse", *a)), zero) <= room
    assert apart(law("compose", *law("inverse", *a), *a), zero) <= room
    assert apart(law("between", *a, *b), law("compose", *law("inverse", *a), *b)) <= room
    assert apart(law("compose", *a, *law("between", *a, *b)), b) <= room


@on_every_engine
@some
@given(several(3))
def test_the_group_acts_on_points(engine, triple):
    def law(name, *args):
        return on_engine(engine, getattr(se2, name), *args)

    a, b, (px, py, _) = triple
    room = 40 * EPS * size(a, b, (px, py))
    there = law("act", *a, *law("act", *b, px, py))
    assert apart(there, law("act", *law("compose", *a, *b), px, py)) <= room
    assert apart(law("act_inverse", *a, *law("act", *a, px, py)), (px, py)) <= room
    assert apart(law("act_inverse", *a, px, py), law("act", *law("inverse", *a), px, py)) <= room
    assert apart(law("act", *a, px, py), [o + r for o, r in zip(a, law("rotate", a[2], px, py), strict=False)]) <= room


@on_every_engine
@some
@given(several(2))
def test_step_is_compose_with_exp(engine, pair):
    def law(name, *args):
        return on_engine(engine, getattr(se2, name), *args)

    pose, xi = pair
    room = 40 * EPS * size(pose, xi)
    assert apart(law("step", *pose, *xi), law("compose", *pose, *law("exp", *xi))) <= room
    assert apart(law("screw", *pose, *xi, np.ones_like(xi[0])), law("step", *pose, *xi)) == 0.0
    back = law("step", *law("step", *pose, *xi), *(-part for part in xi))
    assert apart(back, pose) <= 2 * room


@on_every_engine
@some
@given(several(2))
def test_adjoint_moves_a_twist_through_a_pose(engine, pair):
    def law(name, *args):
        return on_engine(engine, getattr(se2, name), *args)

    pose, xi = pair
    room = 100 * EPS * size(pose, xi) ** 2
    left = law("compose", *pose, *law("exp", *xi))  # T exp(xi) = exp(Ad xi) T
    right = law("compose", *law("exp", *law("adjoint", *pose, *xi)), *pose)
    assert apart(left, right) <= room


@on_every_engine
@pytest.mark.parametrize("vector", [(1.0, 0.0), (0.0, 1.0), (0.3, -2.0)])
def test_log_undoes_exp_at_every_special_angle(engine, vector):
    angle = np.array(INSIDE)
    xi = (np.full_like(angle, vector[0]), np.full_like(angle, vector[1]), angle)
    back = on_engine(engine, se2.log, *on_engine(engine, se2.exp, *xi))
    assert np.array_equal(back[2], angle)
    assert apart(back, xi) <= 8 * EPS * size(xi)


@on_every_engine
@pytest.mark.parametrize("vector", [(1.0, 0.0), (0.0, 1.0), (0.3, -2.0)])
def test_exp_undoes_log_at_every_special_angle(engine, vector):
    angle = np.array([*INSIDE, -math.pi])
    pose = (np.full_like(angle, vector[0]), np.full_like(angle, vector[1]), angle)
    x, y, theta = on_engine(engine, se2.exp, *on_engine(engine, se2.log, *pose))
    assert apart((x, y), pose[:2]) <= 8 * EPS * size(pose)
    assert np.array_equal(theta[:-1], angle[:-1])
    assert theta[-1] == math.pi  # -pi is not in (-pi, pi]: the other way round, to the same place


@some
@given(several(1))
def test_log_keeps_its_interval_and_its_promise(single):
    pose = Pose(*single[0])
    way = pose.log()
    assert np.all(way.dtheta > -math.pi)
    assert np.all(way.dtheta <= math.pi)
    # Where the heading has full turns in it, cos and sin see the true 2 pi and wrap the float's: n * 2.4e-16 apart.
    assert np.all(Pose.exp(way).is_close(pose, distance=40 * EPS * size(single[0]), angle=4 * EPS))


@on_every_engine
def test_wrap_is_exact_and_never_leaves_the_interval(engine):
    rng = np.random.default_rng(5)
    turns = np.arange(-200, 201) * math.pi
    angle = np.concatenate(
        [
            INSIDE, turns, np.nextafter(turns, np.inf), np.nextafter(turns, -np.inf), rng.uniform(-1e6, 1e6, 500),
            rng.choice([-1.0, 1.0], 500) * 10.0 ** rng.uniform(-300, 300, 500),
        ]
    )  # fmt: skip
    (wrapped,) = on_engine(engine, se2.wrap, angle)
    assert np.all(wrapped > -math.pi)
    assert np.all(wrapped <= math.pi)
    expected = [math.remainder(a, math.tau) for a in angle]
    assert np.array_equal(wrapped, [math.pi if r == -math.pi else r for r in expected])
    inside = (angle > -math.pi) & (angle <= math.pi)
    assert np.array_equal(wrapped[inside], angle[inside])
    assert np.array_equal(on_engine(engine, se2.wrap, wrapped)[0], wrapped)


def test_wrap_of_whole_turns_is_zero():
    assert wrap_angle(math.tau) == 0.0
    assert wrap_angle(-2.0 * math.tau) == 0.0
    assert wrap_angle(-math.pi) == wrap_angle(math.pi) == math.pi


@on_every_engine
@some
@given(several(1))
def test_heading_is_the_angle_of_the_direction(engine, single):
    _, _, theta = single[0]
    s, c = np.sin(theta), np.cos(theta)
    (found,) = on_engine(engine, se2.heading, c, s)
    (turn,) = on_engine(engine, se2.wrap, theta)
    assert np.all((found > -math.pi) & (found <= math.pi))
    assert np.max(np.abs(np.sin(found - turn))) <= 8 * EPS


@some
@given(several(1))
def test_exp_jacobian_is_the_derivative_of_exp(single):
    xi = Displacement(*single[0])
    step = EPS ** (1 / 3)
    for k in range(3):
        nudge = np.zeros(3)
        nudge[k] = step
        ahead, behind = (Pose.exp(Displacement.from_array(xi.as_array() + s * nudge)).as_array() for s in (1, -1))
        numeric = (ahead - behind) / (2.0 * step)
        assert np.max(np.abs(xi.exp_jacobian()[..., k] - numeric)) <= 50.0 * step**2 * size(single[0])


@some
@given(several(1))
def test_right_jacobian_takes_a_change_of_the_coordinates_to_the_body(single):
    xi = Displacement(*single[0])
    step = EPS ** (1 / 3)
    for k in range(3):
        nudge = np.zeros(3)
        nudge[k] = step
        ahead, behind = (Pose.exp(Displacement.from_array(xi.as_array() + s * nudge)) for s in (1, -1))
        seen = behind.between(ahead).log().as_array() / (2.0 * step)  # exp(xi + d) = exp(xi) exp(J_r d)
        assert np.max(np.abs(xi.right_jacobian()[..., k] - seen)) <= 50.0 * step**2 * size(single[0])


@pytest.mark.parametrize("shape", BATCH_SHAPES)
@pytest.mark.parametrize("path", ["screw", "decoupled"])
def test_both_paths_lead_from_one_pose_to_the_other(shape, path):
    rng = np.random.default_rng(2)
    start, end = (Pose(*rng.uniform(-3.0, 3.0, (3, *shape))) for _ in range(2))
    room = {"distance": 20 * EPS, "angle": 20 * EPS}
    assert np.all(start.interpolate(end, 0.0, path=path).is_close(start, **room))
    assert np.all(start.interpolate(end, 1.0, path=path).is_close(end, **room))


def test_a_screw_bends_and_a_decoupled_path_does_not():
    start, end = Pose(0.0, 0.0, 0.0), Pose(1.0, 1.0, math.pi / 2)
    fraction = np.linspace(0.0, 1.0, 11)
    screw = start.interpolate(end, fraction)
    line = start.interpolate(end, fraction, path="decoupled")
    assert np.max(np.abs(np.hypot(screw.x, screw.y - 1.0) - 1.0)) <= 4 * EPS  # the quarter circle about (0, 1)
    assert np.max(np.abs(line.x - line.y)) <= 4 * EPS
    assert np.max(np.abs(screw.theta - line.theta)) <= 4 * EPS
    assert not np.any(screw[1:-1].is_close(line[1:-1], distance=0.1, angle=1.0))
    pieces = screw[:-1].between(screw[1:]).log().as_array()
    assert np.max(np.abs(pieces - pieces[0])) <= 20 * EPS  # one constant twist all the way


def test_the_shorter_turn_is_taken_across_pi():
    start, end = Pose(0.0, 0.0, 3.0), Pose(0.0, 0.0, -3.0)
    for path in ("screw", "decoupled"):
        assert abs(start.interpolate(end, 0.5, path=path).theta - math.pi) <= 4 * EPS


@pytest.mark.parametrize("shape", BATCH_SHAPES)
@pytest.mark.parametrize("omega", [0.0, 1e-12, 1e-5, 0.7, -6.3, 40.0])
def test_one_big_step_is_a_thousand_small_ones(shape, omega):
    rng = np.random.default_rng(3)
    start = Pose(*rng.uniform(-2.0, 2.0, (3, *shape)))
    twist, count = Twist(1.3, -0.4, omega), 1000
    big, walked = start.step(twist.during(1.0)), start
    for _ in range(count):
        walked = walked.step(twist.during(1.0 / count))
    room = count * EPS * max(1.0, abs(omega))
    assert np.all(big.is_close(walked, distance=room, angle=room))
    assert np.max(np.abs(big.theta - walked.theta)) <= room  # the turns are counted, too


@some
@given(several(1), ANGLES)
def test_world_rates_and_body_twist_are_inverse(single, heading):
    twist = Twist(*single[0])
    back = Twist.from_world(twist.in_world(heading), heading)
    assert apart(back.parts, twist.parts) <= 8 * EPS * size(single[0])
    rates = twist.in_world(heading)
    assert np.max(np.abs(Pose(0.0, 0.0, heading).act(twist.vx, twist.vy)[0] - rates[..., 0])) <= 8 * EPS * size(
        single[0]
    )


@some
@given(several(1), st.floats(1e-3, 1e3))
def test_rate_and_increment_are_inverse(single, duration):
    twist = Twist(*single[0])
    assert apart(twist.during(duration).over(duration).parts, twist.parts) <= 2 * EPS * size(single[0])


@on_every_engine
@some
@given(several(2))
def test_separation_is_a_distance(engine, pair):
    a, b = pair
    distance, angle = on_engine(engine, se2.separation, *a, *b)
    assert np.all((angle >= 0.0) & (angle <= math.pi))
    assert np.allclose(distance, np.hypot(b[0] - a[0], b[1] - a[1]), rtol=4 * EPS, atol=0.0)
    swapped = on_engine(engine, se2.separation, *b, *a)
    assert apart((distance, angle), swapped) == 0.0
    assert np.max(on_engine(engine, se2.separation, *a, *a)) == 0.0


@some
@given(several(2))
def test_matrices_multiply_as_poses_compose(pair):
    a, b = (Pose(*triple) for triple in pair)
    room = 40 * EPS * size(*pair)
    assert np.max(np.abs((a @ b).as_matrix() - a.as_matrix() @ b.as_matrix())) <= room
    assert np.all(Pose.from_matrix(a.as_matrix()).is_close(a, distance=0.0, angle=8 * EPS))
    twist = Twist(*pair[1])
    seen = (a.adjoint() @ twist.as_array()[..., None])[..., 0]
    assert np.max(np.abs(seen - a.transform(twist).as_array())) <= room


def test_a_coordinate_is_the_product_with_the_axis():
    theta, px, py = 0.7, 1.2, -0.5
    s, c = math.sin(theta), math.cos(theta)
    seen = Pose(0.0, 0.0, theta).act_inverse(px, py)
    assert abs(se2.coordinate(px, py, c, s) - seen[0]) <= EPS
    assert abs(se2.coordinate(px, py, -s, c) - seen[1]) <= EPS
