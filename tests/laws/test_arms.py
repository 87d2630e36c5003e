"""What holds for every arm: the inverse undoes forward, Jacobians are slopes, work is kept, branches stay apart."""

from __future__ import annotations

import importlib.util

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from coplanar import Pose
from coplanar.arms import Arm, Reach
from coplanar.engine import evaluator
from coplanar.laws import arms as laws

LEADS = [(), (1,), (3, 1, 2)]
STEP = 1e-6  # central differences: truncation 1e-12, rounding 1e-10
SLOPE = 1e-8
ROUNDING = 1e-13

lengths = st.floats(0.1, 3.0)
angle = st.floats(-3.1, 3.1)
seeds = st.integers(0, 2**32 - 1)
conventions = st.sampled_from(["relative", "absolute"])
poses = st.builds(Pose, st.floats(-2, 2), st.floats(-2, 2), angle)
gentle = settings(deadline=None, max_examples=40)


@st.composite
def arms(draw, least=1, most=5, letters="RP", free=False):
    n = draw(st.integers(least, most))
    joints = "".join(draw(st.sampled_from(letters)) for _ in range(n))
    bends = None if free else [draw(angle) for _ in range(n)]
    extras = {} if free else {"base": draw(poses), "tool": draw(poses), "bends": bends}
    return Arm([draw(lengths) for _ in range(n)], joints=joints, angles=draw(conventions), **extras)


def joints_for(arm, lead, seed, spread=3.0):
    return np.random.default_rng(seed).uniform(-spread, spread, (*lead, arm.n))


@pytest.mark.parametrize("lead", LEADS)
@gentle
@given(arm=arms(), seed=seeds)
def test_jacobian_is_the_slope_of_forward(lead, arm, seed):
    q = joints_for(arm, lead, seed)
    jacobian = arm.jacobian(q)
    assert jacobian.shape == (*lead, 3, arm.n)
    for i, unit in enumerate(np.eye(arm.n)):
        rise = arm.forward(q + STEP * unit).as_array() - arm.forward(q - STEP * unit).as_array()
        assert np.allclose(jacobian[..., i], rise / (2 * STEP), atol=10 * SLOPE)
    assert np.array_equal(arm.jacobian(q, task="position"), jacobian[..., :2, :])


@pytest.mark.parametrize("lead", LEADS)
@gentle
@given(arm=arms(), seed=seeds)
def test_jacobian_dot_is_the_slope_of_the_jacobian_along_the_motion(lead, arm, seed):
    q, rate = joints_for(arm, lead, seed), joints_for(arm, lead, seed + 1, 1.0)
    rise = arm.jacobian(q + STEP * rate) - arm.jacobian(q - STEP * rate)
    assert np.allclose(arm.jacobian_dot(q, rate), rise / (2 * STEP), atol=100 * SLOPE)


@gentle
@given(arm=arms(), seed=seeds)
def test_power_at_the_joints_is_power_at_the_tool(arm, seed):
    q, rate, wrench = joints_for(arm, (4,), seed), joints_for(arm, (4,), seed + 1), np.random.default_rng(seed)
    wrench = wrench.uniform(-1, 1, (4, 3))
    at_joints = (arm.torques(q, wrench) * rate).sum(axis=-1)
    at_tool = (wrench * np.einsum("kmn,kn->km", arm.jacobian(q), rate)).sum(axis=-1)
    assert np.allclose(at_joints, at_tool, atol=1e-11)
    force_only = np.concatenate((wrench[:, :2], np.zeros((4, 1))), axis=-1)
    assert np.allclose(arm.torques(q, wrench[:, :2]), arm.torques(q, force_only), atol=0.0)


@pytest.mark.parametrize("lead", LEADS)
@gentle
@given(arm=arms(2, 2, "R"), seed=seeds)
def test_both_branches_of_two_links_reach_what_forward_reaches(lead, arm, seed):
    assume(np.hypot(arm.links[1] + arm.tool.x, arm.tool.y) > 0.05)
    q = joints_for(arm, lead, seed)
    answer = arm.inverse(arm.forward(q).position, near=q)
    assert answer.branches.shape == (*lead, 2, 2)
    assert np.all(answer.reached)
    for k, sign in enumerate((1, -1)):
        tool = arm.forward(answer.branches[..., k, :]).position
        assert np.allclose(tool, answer.target, atol=ROUNDING)
        forced = arm.inverse(answer.target, near=q, elbow=sign)
        assert np.all(np.asarray(forced.elbow) == sign)
    # Near where the branches meet eps in the target is sqrt(eps) in the joints.
    assert np.allclose(answer.q, q, atol=1e-6)


@pytest.mark.parametrize("lead", LEADS)
@gentle
@given(arm=arms(3, 3, "R"), seed=seeds)
def test_three_links_reach_the_pose_by_both_branches(lead, arm, seed):
    q = joints_for(arm, lead, seed)
    answer = arm.inverse(arm.forward(q), near=q)
    assert np.all(answer.reached)
    assert np.max(answer.position_error()) < ROUNDING
    assert np.max(np.abs(answer.heading_error())) < ROUNDING
    for k in range(2):
        again = arm.forward(answer.branches[..., k, :])
        assert np.allclose(again.position, answer.target, atol=ROUNDING)
    assert np.allclose(answer.q, q, atol=1e-5)


@gentle
@given(
    l1=lengths, l2=lengths, turn=angle, exponent=st.floats(-15, -1), fold=st.booleans(), elbow=st.sampled_from([1, -1])
)
def test_elbow_is_the_sign_of_the_sine_even_next_to_where_the_branches_meet(l1, l2, turn, exponent, fold, elbow):
    near = 10.0**exponent
    step = near * min(l1, l2)
    r = abs(l1 - l2) + step if fold else l1 + l2 - step
    x, y = r * np.cos(turn), r * np.sin(turn)
    q1, q2 = evaluator(laws.two_link_inverse)(x, y, l1, l2, float(elbow))
    assert elbow * q2 >= 0.0
    tip = evaluator(laws.two_link)(q1, q2, l1, l2)
    assert np.hypot(tip[0] - x, tip[1] - y) < 1e-15 * 20 * (l1 + l2)
    sine = evaluator(laws.elbow_sine)(x, y, l1, l2)
    assert abs(abs(np.sin(q2)) - sine) < 1e-15 * 20 / max(min(l1, l2), 0.1)


@gentle
@given(x=st.floats(-4, 4), y=st.floats(-4, 4), l1=lengths, l2=lengths)
def test_an_unreachable_target_gets_the_nearest_point_of_the_ring(x, y, l1, l2):
    arm = Arm((l1, l2))
    answer = arm.inverse((x, y))
    r, ring = np.hypot(x, y), (abs(l1 - l2), l1 + l2)
    expected = max(r - ring[1], ring[0] - r, 0.0)
    assert answer.gap == pytest.approx(expected, abs=ROUNDING)
    assert answer.position_error() == pytest.approx(expected, abs=ROUNDING)
    assert answer.reached == (expected <= 1e-9)
    if not answer.reached:
        assert answer.status is (Reach.TOO_FAR if r > ring[1] else Reach.TOO_CLOSE)
        assert answer.conditioning() < 1e-7
    nearest = evaluator(laws.ring_nearest)(x, y, *ring)
    assert np.hypot(nearest[0] - x, nearest[1] - y) == pytest.approx(expected, abs=ROUNDING)
    assert evaluator(laws.ring_gap)(*nearest, *ring) < ROUNDING


@gentle
@given(target=angle, near=st.floats(-30, 30), lower=st.floats(-9, 9), width=st.floats(0, 12))
def test_whole_turns_come_nearest_inside_the_limits(target, near, lower, width):
    upper = lower + width
    all_turns = target + 2 * np.pi * np.arange(-12, 13)
    inside = all_turns[(all_turns >= lower) & (all_turns <= upper)]
    found = evaluator(laws.turn_within)(target, near, lower, upper)
    if inside.size and min(inside - lower) > ROUNDING and min(upper - inside) > ROUNDING:
        assert abs(found - near) == pytest.approx(np.abs(inside - near).min(), abs=1e-12)
    onto = evaluator(laws.turn_onto)(target, near, lower, upper)
    assert lower <= onto <= upper
    distance = np.abs(np.angle(np.exp(1j * (np.linspace(lower, upper, 400) - target)))).min()
    assert abs(np.angle(np.exp(1j * (onto - target)))) <= distance + ROUNDING
    assert abs(evaluator(laws.turn_near)(target, near) - near) <= np.pi + ROUNDING


@gentle
@given(arm=arms(1, 4), seed=seeds, task=st.sampled_from(["position", "pose"]))
def test_exact_rates_are_of_minimum_norm_and_leave_the_least_error(arm, seed, task):
    q = joints_for(arm, (3,), seed)
    velocity = np.random.default_rng(seed).uniform(-1, 1, (3, 2 if task == "position" else 3))
    rates = arm.rates(q, velocity, task=task)
    jacobian = arm.jacobian(q, task=task)
    well = rates.singular_values[:, -1] > 1e-3
    for k in np.flatnonzero(well):
        expected = np.linalg.lstsq(jacobian[k], velocity[k], rcond=None)[0]
        assert np.allclose(rates.exact[k], expected, atol=1e-9)
    if arm.n >= velocity.shape[-1]:
        assert np.abs(rates.exact_error()[well]).max(initial=0.0) < 1e-10
    normal = np.einsum("kmi,kmj->kij", jacobian, jacobian) + rates.damping**2 * np.eye(arm.n)
    expected = np.linalg.solve(normal, np.einsum("kmn,km->kn", jacobian, velocity)[..., None])[..., 0]
    assert np.allclose(rates.damped, expected, atol=1e-9)
    assert np.all(
        np.linalg.norm(rates.damped, axis=-1) <= np.linalg.norm(velocity, axis=-1) / (2 * rates.damping) + 1e-9
    )


@gentle
@given(arm=arms(3, 5, "R"), seed=seeds)
def test_null_motion_leaves_the_tool_alone(arm, seed):
    q, wish = joints_for(arm, (), seed), joints_for(arm, (), seed + 1)
    still = arm.rates(q, [0.0, 0.0], null_rate=wish)
    assert np.abs(arm.jacobian(q, task="position") @ still.exact).max() < 1e-11
    # The projection is the nearest such motion: what is left of the wish stands across it.
    assert abs(still.exact @ (wish - still.exact)) < 1e-10


@gentle
@given(q1=angle, q2=angle, l1=lengths, l2=lengths, seed=seeds)
def test_two_link_rates_are_the_inverse_of_the_jacobian(q1, q2, l1, l2, seed):
    assume(abs(np.sin(q2)) > 1e-3)
    velocity = np.random.default_rng(seed).uniform(-1, 1, 2)
    rates = evaluator(laws.two_link_rates)(q1, q2, l1, l2, *velocity.tolist())
    exact = Arm((l1, l2)).rates([q1, q2], velocity).exact
    assert np.allclose(rates, exact, rtol=1e-9, atol=1e-9)


@gentle
@given(arm=arms(2, 4, "R"), seed=seeds)
def test_ellipses_of_velocity_and_force_are_reciprocal(arm, seed):
    q = joints_for(arm, (2,), seed)
    velocity, force = arm.ellipse(q), arm.ellipse(q, kind="force")
    assume(velocity.radii.min() > 1e-3)
    assert np.allclose(velocity.radii * force.radii[..., ::-1], 1.0)
    across = np.einsum("kij,kij->kj", velocity.axes, force.axes[..., ::-1])
    assert np.allclose(np.abs(across), 1.0)
    assert np.allclose(arm.manipulability(q), velocity.radii.prod(axis=-1))
    outline = np.linalg.solve(arm.jacobian(q, task="position")[:, :, :2], velocity.outline().swapaxes(-1, -2))
    if arm.n == 2:
        assert np.allclose((outline**2).sum(axis=-2), 1.0, atol=1e-6)


@gentle
@given(links=st.lists(lengths, min_size=2, max_size=5), seed=seeds)
def test_the_ring_holds_every_tool_and_touches_both_circles(links, seed):
    arm = Arm(links)
    ring = arm.workspace()
    q = joints_for(arm, (200,), seed)
    assert np.all(ring.contains(arm.forward(q).position))
    assert arm.inverse((ring.outer + 1.0, 0.0)).gap == pytest.approx(1.0)
    stretched = np.zeros(arm.n)
    assert np.hypot(*arm.forward(stretched).position) == pytest.approx(ring.outer)


@settings(deadline=None, max_examples=15)
@given(arm=arms(3, 5, "R", free=True), seed=seeds)
def test_the_numerical_inverse_reaches_what_forward_reaches(arm, seed):
    q = joints_for(arm, (8,), seed)
    answer = arm.inverse(arm.forward(q).position)
    ring = arm.workspace()
    inside = (answer.target**2).sum(axis=-1) > (1.01 * ring.inner) ** 2
    assert np.all(answer.reached | ~inside)
    assert np.all(answer.position_error()[inside] <= 1e-9)


@settings(deadline=None, max_examples=15)
@given(seed=seeds, angles=conventions)
def test_the_region_of_limited_joints_is_where_the_inverse_reaches(seed, angles):
    rng = np.random.default_rng(seed)
    limits = np.sort(rng.uniform(-3, 3, (2, 2)), axis=-1) + np.array([-0.1, 0.1])
    arm = Arm(rng.uniform(0.3, 1.0, 2), angles=angles, limits=limits)
    q = rng.uniform(*limits.T, (50, 2))
    answer = arm.inverse(arm.forward(q).position)
    assert np.all(answer.reached)
    assert np.all(arm.is_within_limits(answer.q))
    region = arm.workspace()
    away = np.hypot(*arm.forward(q).position.T)
    assert region.exact
    assert away.max() <= region.outer + ROUNDING
    assert away.min() >= region.inner - ROUNDING
    corners = np.concatenate(region.boundary(9))
    assert np.max(region.gap(corners)) < 1e-9


@pytest.mark.skipif(importlib.util.find_spec("jax") is None, reason="needs JAX")
@pytest.mark.parametrize("target", [(2.0, 0.0), (0.0, 0.0), (1.2, 0.5), (3.0, 0.1), (0.0, -2.0)])
def test_gradients_through_the_closed_form_are_finite_even_where_the_branches_meet(target):
    import jax

    with jax.enable_x64(True):
        law = evaluator(laws.two_link_inverse)
        slope = jax.jacfwd(lambda p: jax.numpy.stack(law(p[0], p[1], 1.0, 1.0, 1.0)))(jax.numpy.asarray(target))
        assert bool(jax.numpy.isfinite(slope).all())
        if target == (1.2, 0.5):
            q = law(*(jax.numpy.asarray(v) for v in target), 1.0, 1.0, 1.0)
            jacobian = Arm((1.0, 1.0)).jacobian(np.array(q), task="position")
            assert np.allclose(np.array(slope) @ jacobian, np.eye(2), atol=1e-12)


@pytest.mark.skipif(importlib.util.find_spec("jax") is None, reason="needs JAX")
def test_forward_is_differentiable_and_its_gradient_is_the_jacobian():
    import jax

    arm = Arm((1.0, 0.5, 0.3), joints="RPR", tool=Pose(0.1, 0.2, 0.3))
    q = np.array([0.3, 0.1, -0.8])
    with jax.enable_x64(True):
        slope = jax.jacfwd(lambda v: jax.numpy.stack(arm.forward(v).parts))(jax.numpy.asarray(q))
        assert np.allclose(np.array(slope), arm.jacobian(q), atol=1e-14)
