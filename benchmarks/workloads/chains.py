"""Six links: where the tool is with the Jacobian, and the joints for a pose by damped least squares."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from benchmarks import truth
from benchmarks.limits import Limits
from benchmarks.measure import Contender, Workload
from benchmarks.peers import jax64, load
from benchmarks.workloads.inverse import pinocchio_model
from coplanar import Arm, Pose

LINKS = (1.0, 0.8, 0.7, 0.5, 0.4, 0.3)  # [m]
SOLVED = 1e-8  # [m, rad] every solver has to come this near
N = len(LINKS)


class Postures(NamedTuple):
    """Joints, the starts of the searches and the poses of the tool that they look for, one row each."""

    q: np.ndarray
    start: np.ndarray
    target: np.ndarray


def postures(rows: int) -> Postures:
    """Joints of a bent arm, searched for from up to 0.3 rad aside."""
    rng = np.random.default_rng(4)
    q = rng.uniform(-1.5, 1.5, (rows, N))
    return Postures(q, q + rng.uniform(-0.3, 0.3, (rows, N)), tool(q))


def tool(q: np.ndarray) -> np.ndarray:
    """Pose of the tool, columns x, y, theta."""
    angles = np.cumsum(q, axis=-1)
    return np.column_stack((np.cos(angles) @ LINKS, np.sin(angles) @ LINKS, angles[:, -1]))


def kinematics(data: Postures, count: int) -> np.ndarray:
    """Truth: pose and the nine rows of the Jacobian."""
    table = truth.rows(lambda *q: truth.chain(LINKS, *q), list(data.q.T), count)
    return planar(table[:, :3], table[:, 3:])


def planar(pose: Any, J: Any) -> np.ndarray:
    """x, y, the sine of the heading (the others do not count turns) and the Jacobian's entries."""
    pose = np.asarray(pose)
    return np.column_stack((pose[:, :2], np.sin(pose[:, 2]), np.reshape(J, (-1, 3 * N))))


def objects(data: Postures) -> Contender:
    """``forward`` and ``jacobian``."""
    arm = Arm(LINKS)
    read = lambda answer: planar(answer[0].as_array(), answer[1])  # noqa: E731
    return Contender("coplanar: arm.forward(q), arm.jacobian(q)", lambda: (arm.forward(data.q), arm.jacobian(data.q)),
                     len(data.q), read)  # fmt: skip


def at_once(data: Postures) -> Contender:
    """``kinematics``: both in one call."""
    arm = Arm(LINKS)
    read = lambda answer: planar(answer[0].as_array(), answer[1])  # noqa: E731
    return Contender("coplanar: arm.kinematics(q)", lambda: arm.kinematics(data.q), len(data.q), read)


def numpy_batch(data: Postures) -> Contender:
    """As an expert writes it: running sums from the tip inwards."""
    links = np.array(LINKS)

    def call() -> tuple[np.ndarray, np.ndarray]:
        angles = np.cumsum(data.q, axis=-1)
        ahead = np.cumsum((links * np.cos(angles))[:, ::-1], axis=-1)[:, ::-1]
        across = np.cumsum((links * np.sin(angles))[:, ::-1], axis=-1)[:, ::-1]
        J = np.empty((len(angles), 3, N))
        np.negative(across, out=J[:, 0])
        J[:, 1], J[:, 2] = ahead, 1.0
        return np.column_stack((ahead[:, 0], across[:, 0], angles[:, -1])), J

    read = lambda answer: planar(*answer)  # noqa: E731
    return Contender("NumPy", call, len(data.q), read)


def jax_batch(data: Postures) -> Contender:
    """The same, compiled by JAX."""
    jax, jnp = jax64()
    links = jnp.array(LINKS)

    def both(q: Any) -> tuple[Any, Any]:
        angles = jnp.cumsum(q)
        ahead = jnp.cumsum((links * jnp.cos(angles))[::-1])[::-1]
        across = jnp.cumsum((links * jnp.sin(angles))[::-1])[::-1]
        return jnp.stack((ahead[0], across[0], angles[-1])), jnp.stack((-across, ahead, jnp.ones(N)))

    run, q = jax.jit(jax.vmap(both)), jnp.asarray(data.q)
    read = lambda answer: planar(*answer)  # noqa: E731
    return Contender("JAX jit(vmap)", lambda: jax.block_until_ready(run(q)), len(data.q), read)


def pinocchio_loop(data: Postures) -> Contender:
    """C++, a loop over postures."""
    pin, count = load("pinocchio"), 500
    model, frame = pinocchio_model(LINKS)
    state, rows = model.createData(), [np.ascontiguousarray(q) for q in data.q[:count]]

    def call() -> list[Any]:
        answer = []
        for q in rows:
            J = pin.computeFrameJacobian(model, state, q, frame, pin.LOCAL_WORLD_ALIGNED)
            answer.append((pin.updateFramePlacement(model, state, frame), J))
        return answer

    return Contender(
        "pinocchio (C++), loop", call, count, lambda a: np.array([spatial(T.homogeneous, J) for T, J in a])
    )


def rtb_loop(data: Postures) -> Contender:
    """C++, a loop over postures."""
    arm, count = rtb_chain(), 100
    rows = [np.ascontiguousarray(q) for q in data.q[:count]]
    call = lambda: [(arm.eval(q), arm.jacob0(q)) for q in rows]  # noqa: E731
    return Contender("Robotics Toolbox (C++), loop", call, count, lambda a: np.array([spatial(T, J) for T, J in a]))


def spatial(T: np.ndarray, J: np.ndarray) -> np.ndarray:
    """The planar part of a spatial pose and Jacobian; of the heading its sine."""
    return np.concatenate((T[:2, 3], [T[1, 0]], J[0], J[1], J[5]))


def rtb_chain() -> Any:
    """The arm as an elementary transform sequence."""
    ET = load("roboticstoolbox").ET
    arm = ET.Rz() * ET.tx(LINKS[0])
    for link in LINKS[1:]:
        arm = arm * ET.Rz() * ET.tx(link)
    return arm


def solved(q: Any) -> np.ndarray:
    """What the joints reach."""
    reached = tool(np.asarray(q, float).reshape(-1, N))
    reached[:, 2] = wrap(reached[:, 2])
    return reached


def wrap(angle: np.ndarray) -> np.ndarray:
    """Into (-pi, pi], but the same on both sides of the cut for this comparison."""
    return np.cos(angle) + 2.0 * np.sin(angle)


def wanted(data: Postures, count: int) -> np.ndarray:
    """Truth of a search: the targets themselves."""
    target = data.target[:count].copy()
    target[:, 2] = wrap(target[:, 2])
    return target


def search(data: Postures) -> Contender:
    """Poses from their starts, with status and gap."""
    arm, target = Arm(LINKS), Pose(*data.target.T)
    call = lambda: arm.inverse(target, near=data.start, tolerance=SOLVED)  # noqa: E731
    return Contender("coplanar: arm.inverse(poses, near=starts)", call, len(data.q), lambda answer: solved(answer.q))


def rtb_search(data: Postures) -> Contender:
    """C++ Levenberg-Marquardt, a loop over targets."""
    arm, SE3, count = rtb_chain(), load("spatialmath").SE3, 100
    mask = np.array([1.0, 1.0, 0, 0, 0, 1.0])
    places = [(SE3(x, y, 0.0) * SE3.Rz(theta)).A for x, y, theta in data.target[:count]]
    jobs = list(zip(places, data.start[:count], strict=True))

    def call() -> list[Any]:
        return [arm.ik_LM(T, q0=q, mask=mask, tol=0.5 * SOLVED**2, joint_limits=False)[0] for T, q in jobs]

    return Contender("Robotics Toolbox ik_LM (C++), loop", call, count, solved)


def pinocchio_search(data: Postures) -> Contender:
    """Damped least squares over pinocchio's kinematics, as its examples have it."""
    pin, count = load("pinocchio"), 50
    model, frame = pinocchio_model(LINKS)
    state, jobs = model.createData(), list(zip(data.target[:count], data.start[:count], strict=True))

    def one(target: np.ndarray, q: np.ndarray) -> np.ndarray:
        for _ in range(100):
            J = pin.computeFrameJacobian(model, state, q, frame, pin.LOCAL_WORLD_ALIGNED)[[0, 1, 5]]
            pin.updateFramePlacement(model, state, frame)
            T = state.oMf[frame]
            turn = target[2] - np.arctan2(T.rotation[1, 0], T.rotation[0, 0])
            miss = np.array([*(target[:2] - T.translation[:2]), (turn + np.pi) % (2.0 * np.pi) - np.pi])
            if np.abs(miss).max() < SOLVED:
                break
            q = q + J.T @ np.linalg.solve(J @ J.T + 1e-9 * np.eye(3), miss)
        return q

    return Contender("pinocchio (C++), damped loop", lambda: [one(*job) for job in jobs], count, solved)


def scipy_search(data: Postures) -> Contender:
    """``least_squares`` with the exact Jacobian, a loop over targets."""
    least_squares, count = load("scipy.optimize").least_squares, 10
    jobs, links = list(zip(data.target[:count], data.start[:count], strict=True)), np.array(LINKS)

    def miss(q: np.ndarray, target: np.ndarray) -> np.ndarray:
        angles = np.cumsum(q)
        turn = (angles[-1] - target[2] + np.pi) % (2.0 * np.pi) - np.pi
        return np.array([links @ np.cos(angles) - target[0], links @ np.sin(angles) - target[1], turn])

    def slope(q: np.ndarray, _: np.ndarray) -> np.ndarray:
        angles = np.cumsum(q)
        ahead = np.cumsum((links * np.cos(angles))[::-1])[::-1]
        return np.array([-np.cumsum((links * np.sin(angles))[::-1])[::-1], ahead, np.ones(N)])

    call = lambda: [least_squares(miss, q, slope, args=(target,), ftol=None, gtol=SOLVED).x for target, q in jobs]  # noqa: E731
    return Contender("SciPy least_squares, loop", call, count, solved)


def kinematics_floor(limits: Limits, threads: int, data: Any) -> float:
    """Six numbers in, twenty-one out; six sincos."""
    del data
    return limits.floor(threads, read=N, written=3 + 3 * N, sincos=N)


def search_floor(limits: Limits, threads: int, data: Postures) -> float:
    """Three evaluations and two damped steps: what most of these starts need at the least."""
    del data
    return limits.floor(threads, read=3 + N, written=N, sincos=3 * N, sqrt=2 * 3)


FORWARD = Workload(
    "kinematics", "10^5 6R forward and Jacobian", "row", postures, (100_000, 20_000), (at_once, objects),
    {"NumPy": numpy_batch, "JAX": jax_batch, "pinocchio": pinocchio_loop, "roboticstoolbox-python": rtb_loop},
    kinematics_floor, {1: 50.0, 2: 26.0}, 1e-11, kinematics, (300, 50),
)  # fmt: skip

SEARCH = Workload(
    "search", "10^4 6R damped least squares", "target", postures, (10_000, 1000), (search,),
    {"roboticstoolbox-python": rtb_search, "pinocchio": pinocchio_search, "SciPy least_squares": scipy_search},
    search_floor, {1: 500.0, 2: 270.0}, 10 * SOLVED, wanted, (10_000, 1000),
)  # fmt: skip
