"""The two-link inverse: one target with status and both branches, a million of them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from benchmarks import truth
from benchmarks.limits import Limits
from benchmarks.measure import Contender, Workload
from benchmarks.peers import jax64, load
from benchmarks.single import as_they_come, warmed
from coplanar import Arm
from coplanar.engine import evaluator
from coplanar.laws import arms

L1, L2 = 1.0, 0.7  # [m]
START = (0.5, 0.9)  # [rad] where the searches begin: towards the elbow's + branch


class Targets(NamedTuple):
    """Points of the ring, shape (rows,)."""

    x: np.ndarray
    y: np.ndarray


def targets(rows: int) -> Targets:
    """Points with the elbow between 0.05 and 3.05 rad, all round; the first one is a common case."""
    rng = np.random.default_rng(2)
    q1, q2 = rng.uniform(-np.pi, np.pi, rows), rng.uniform(0.05, 3.05, rows)
    q1[0], q2[0] = 0.4, 1.1
    return Targets(L1 * np.cos(q1) + L2 * np.cos(q1 + q2), L1 * np.sin(q1) + L2 * np.sin(q1 + q2))


def both(data: Targets, count: int) -> np.ndarray:
    """Truth: q1, q2 of the elbow +, then of the elbow -."""
    table = truth.rows(lambda x, y: truth.two_link(x, y, truth.mpf(L1), truth.mpf(L2)), data, count)
    return wrapped(table)


def same_row(data: Targets, count: int) -> np.ndarray:
    """Truth of the first row."""
    del count
    return both(data, 1)


def wrapped(table: np.ndarray) -> np.ndarray:
    """Angles brought into (-pi, pi]."""
    return table - 2.0 * np.pi * np.round(table / (2.0 * np.pi))


def columns(answer: Any) -> np.ndarray:
    """Angles of a tuple of columns."""
    return wrapped(np.column_stack([np.atleast_1d(np.asarray(c, float)) for c in answer]))


def solution(answer: Any) -> np.ndarray:
    """Angles of both branches of a ``Solution``."""
    return wrapped(np.asarray(answer.branches).reshape(-1, 4))


def objects(data: Targets) -> Contender:
    """The answer, and its status and both branches read."""
    arm, target = Arm((L1, L2)), (float(data.x[0]), float(data.y[0]))

    def call() -> tuple[Any, Any]:
        answer = arm.inverse(target)
        return answer.status, answer.branches

    read = lambda answer: wrapped(answer[1].reshape(-1, 4))  # noqa: E731
    return Contender("coplanar: arm.inverse(target), its status and branches", call, 1, read)


def bare_law(data: Targets) -> Contender:
    """One branch by the law on floats, without the object."""
    law, x, y = evaluator(arms.two_link_inverse), float(data.x[0]), float(data.y[0])
    return Contender("coplanar: the law on floats, one branch", lambda: law(x, y, L1, L2, 1.0), 1, columns)


def rtb_arm() -> Any:
    """The arm as an elementary transform sequence."""
    load("roboticstoolbox")
    ET = load("roboticstoolbox").ET
    return ET.Rz() * ET.tx(L1) * ET.Rz() * ET.tx(L2)


def rtb_once(data: Targets) -> Contender:
    """C++ Levenberg-Marquardt, position in the plane only."""
    arm, SE3 = rtb_arm(), load("spatialmath").SE3
    T, mask, start = SE3(data.x[0], data.y[0], 0.0).A, np.array([1.0, 1.0, 0, 0, 0, 0]), np.array(START)
    call = lambda: arm.ik_LM(T, q0=start, mask=mask, tol=1e-12, joint_limits=False)  # noqa: E731
    return Contender("Robotics Toolbox ik_LM (C++)", call, 1, lambda a: columns(a[0]), slack=1e-5)


def fsolve_once(data: Targets) -> Contender:
    """MINPACK with the exact Jacobian."""
    optimize, (x, y) = load("scipy.optimize"), (float(data.x[0]), float(data.y[0]))
    cos, sin = load("math").cos, load("math").sin

    def miss(q: np.ndarray) -> tuple[float, float]:
        a, b = q[0], q[0] + q[1]
        return L1 * cos(a) + L2 * cos(b) - x, L1 * sin(a) + L2 * sin(b) - y

    return Contender("SciPy fsolve", lambda: optimize.fsolve(miss, START, xtol=1e-12), 1, columns, slack=1e-8)


def pinocchio_once(data: Targets) -> Contender:
    """Newton's loop over pinocchio's kinematics, as its examples have it."""
    pin = load("pinocchio")
    model, frame = pinocchio_model((L1, L2))
    state, target, start = model.createData(), np.array([data.x[0], data.y[0]]), np.array(START)

    def call() -> np.ndarray:
        q = start.copy()
        for _ in range(50):
            J = pin.computeFrameJacobian(model, state, q, frame, pin.LOCAL_WORLD_ALIGNED)[:2]
            pin.updateFramePlacement(model, state, frame)
            miss = target - state.oMf[frame].translation[:2]
            if miss @ miss < 1e-24:
                break
            q = q + np.linalg.solve(J, miss)
        return q

    return Contender("pinocchio (C++), Newton loop", call, 1, columns, slack=1e-8)


def pinocchio_model(links: tuple[float, ...]) -> tuple[Any, int]:
    """A serial arm of revolute joints about z, and its tool frame."""
    pin = load("pinocchio")
    model, parent, length = pin.Model(), 0, 0.0
    for i, link in enumerate(links):
        place = pin.SE3(np.eye(3), np.array([length, 0.0, 0.0]))
        parent, length = model.addJoint(parent, pin.JointModelRZ(), place, f"j{i}"), link
    tool = pin.Frame("tool", parent, pin.SE3(np.eye(3), np.array([length, 0.0, 0.0])), pin.FrameType.OP_FRAME)
    return model, model.addFrame(tool)


def ikpy_once(data: Targets) -> Contender:
    """Its usual optimiser."""
    chain, link = load("ikpy.chain"), load("ikpy.link")
    turn = {"rotation": [0, 0, 1], "origin_orientation": [0, 0, 0]}
    places = ([0.0, 0.0, 0.0], [L1, 0.0, 0.0])
    parts = [link.URDFLink(f"q{i}", origin_translation=p, **turn) for i, p in enumerate(places)]
    tip = link.URDFLink("tip", origin_translation=[L2, 0.0, 0.0], origin_orientation=[0, 0, 0], joint_type="fixed")
    arm = chain.Chain([link.OriginLink(), *parts, tip], active_links_mask=[False, True, True, False])
    target, start = [data.x[0], data.y[0], 0.0], [0.0, *START, 0.0]
    call = lambda: arm.inverse_kinematics(target, initial_position=start)  # noqa: E731
    return Contender("ikpy", call, 1, lambda q: columns(q[1:3]), slack=1e-3, note="to its own tolerance")


def batch(data: Targets) -> Contender:
    """Status, gap and both branches of every target."""
    arm, points = Arm((L1, L2)), np.column_stack(data)
    return Contender("coplanar: arm.inverse(targets)", lambda: arm.inverse(points), len(points), solution)


def batch_law(data: Targets) -> Contender:
    """One branch by the compiled law, into arrays that are there."""
    law, out = evaluator(arms.two_link_inverse), tuple(np.empty(len(data.x)) for _ in range(2))
    call = lambda: law.on_compiled(*data, L1, L2, 1.0, out=out)  # noqa: E731
    return Contender("coplanar: the law, out=, one branch", call, len(data.x), columns)


def single_law(data: Targets) -> Contender:
    """The same in single precision."""
    law, given = evaluator(arms.two_link_inverse), [np.float32(column) for column in data]
    out = tuple(np.empty(len(data.x), np.float32) for _ in range(2))
    call = lambda: law.on_compiled(*given, L1, L2, 1.0, out=out)  # noqa: E731
    return Contender("coplanar: the law, out=, float32", call, len(data.x), columns, slack=1e-4)


def numpy_batch(data: Targets) -> Contender:
    """As an expert writes it, one branch, by the cosine clipped to its range."""

    def call() -> tuple[np.ndarray, ...]:
        c2 = (data.x * data.x + data.y * data.y - (L1 * L1 + L2 * L2)) / (2.0 * L1 * L2)
        np.clip(c2, -1.0, 1.0, out=c2)
        s2 = np.sqrt(1.0 - c2 * c2)
        q1 = np.arctan2(data.y, data.x) - np.arctan2(L2 * s2, L1 + L2 * c2)
        return q1, np.arctan2(s2, c2)

    return Contender("NumPy, one branch", call, len(data.x), columns)


def jax_batch(data: Targets) -> Contender:
    """The same formula, compiled by JAX."""
    jax, jnp = jax64()

    def inverse(x: Any, y: Any) -> tuple[Any, Any]:
        c2 = jnp.clip((x * x + y * y - (L1 * L1 + L2 * L2)) / (2.0 * L1 * L2), -1.0, 1.0)
        s2 = jnp.sqrt(1.0 - c2 * c2)
        return jnp.arctan2(y, x) - jnp.arctan2(L2 * s2, L1 + L2 * c2), jnp.arctan2(s2, c2)

    run, x, y = jax.jit(inverse), jnp.asarray(data.x), jnp.asarray(data.y)
    return Contender("JAX jit, one branch", lambda: jax.block_until_ready(run(x, y)), len(data.x), columns)


def rtb_loop(data: Targets) -> Contender:
    """A loop over targets, from the same start."""
    arm, count, SE3 = rtb_arm(), 200, load("spatialmath").SE3
    mask, start = np.array([1.0, 1.0, 0, 0, 0, 0]), np.array([0.0, 1.5])
    places = [SE3(x, y, 0.0).A for x, y in zip(data.x[:count], data.y[:count], strict=True)]

    def call() -> list[Any]:
        return [arm.ik_LM(T, q0=start, mask=mask, tol=1e-12, joint_limits=False)[0] for T in places]

    def read(answer: list[Any]) -> np.ndarray:
        """Its branch may be either: brought to the elbow +."""
        q = np.array(answer)
        tip = np.column_stack(
            (L1 * np.cos(q[:, 0]) + L2 * np.cos(q.sum(1)), L1 * np.sin(q[:, 0]) + L2 * np.sin(q.sum(1)))
        )
        law = evaluator(arms.two_link_inverse)
        return columns(law(tip[:, 0].copy(), tip[:, 1].copy(), L1, L2, 1.0))

    return Contender("Robotics Toolbox ik_LM (C++), loop", call, count, read, slack=1e-4)


def once_floor(limits: Limits, threads: int, data: Any) -> float:
    """One call of a C function."""
    del threads, data
    return limits.call


def batch_floor(limits: Limits, threads: int, data: Any) -> float:
    """Two numbers in, two out; two atan2, one of them after three roots."""
    del data
    return limits.floor(threads, read=2, written=2, atan2=2, sqrt=1.5)


ONCE = Workload(
    "inverse", "one 2R inverse", "call", targets, (10, 10),
    (warmed(objects), as_they_come(objects), bare_law),
    {"roboticstoolbox-python": rtb_once, "SciPy fsolve": fsolve_once, "pinocchio": pinocchio_once, "ikpy": ikpy_once},
    once_floor, {1: 3000.0}, 1e-12, same_row, (1, 1), (None,),
)  # fmt: skip

BATCH = Workload(
    "inverses", "10^6 2R inverses", "row", targets, (1_000_000, 100_000), (batch, batch_law, single_law),
    {"NumPy": numpy_batch, "JAX": jax_batch, "roboticstoolbox-python": rtb_loop},
    batch_floor, {1: 5.0, 2: 2.7}, 1e-10, both, (1000, 200),
)  # fmt: skip
