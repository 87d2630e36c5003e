"""What outcomes are checked against: the same things worked out in another way, that shares no code with the library.

Points of the plane are complex numbers here, poses are multiplied as exponentials, equations of motion are integrated.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from coplanar.arms import Arm
from coplanar.control import PointTracker
from coplanar.flight import Shot
from coplanar.integrators import METHODS, integrate_ode
from coplanar.motion import Program, Segment
from coplanar.run import Run, RunStatus
from coplanar.se2 import Pose, Twist
from coplanar.wheels import WheeledBase

SETTLED = 1000.0  # of the times that a fall takes to settle, 1/sqrt(k g), that are integrated
LONGEST_TURN = 100.0  # [rad] of a piece that is integrated: what follows is more of the same, and takes long


def tool_of(arm: Arm, q: Any) -> np.ndarray:
    """Where the tool is, as sums of complex exponentials; joints (..., n) give complex numbers (...)."""
    joints = np.asarray(q, dtype=np.float64)
    place = np.full(joints.shape[:-1], complex(arm.base.x, arm.base.y))
    turned = np.full(joints.shape[:-1], float(arm.base.theta))
    for i, (length, letter, bend) in enumerate(zip(arm.links, arm.joints, arm.bends, strict=True)):
        value = joints[..., i]
        before = arm.base.theta if arm.angles == "absolute" and letter == "R" else turned
        turned = before + bend + (value if letter == "R" else 0.0)
        place = place + (length + (value if letter == "P" else 0.0)) * np.exp(1j * turned)
    ahead: np.ndarray = place + complex(arm.tool.x, arm.tool.y) * np.exp(1j * turned)
    return ahead


def points_of(pairs: Any) -> np.ndarray:
    """Points (..., 2) as complex numbers (...)."""
    table = np.asarray(pairs)
    return np.asarray(table[..., 0] + 1j * table[..., 1])


def loop_error(
    run: Run, controller: Any, reference: Any, method: str, *, limits: Any = None, noise: Any = None
) -> float:
    """How far each row of a closed loop is from the step that leads to it, taken anew [m, rad, m/s, rad/s].

    The plant by its Butcher table (or an arc's chord), the command of a tracked point from its error in complex
    numbers where neither noise nor limits stand in between.
    """
    if len(run) < 2 or run.status is not RunStatus.COMPLETE:
        return 0.0
    steps = np.diff(run.t)
    shaken = noise.draw(len(steps), ()) if noise else np.zeros((len(steps), 5))
    driven = np.stack([run["v"][1:] + shaken[:, 3], run["omega"][1:] + shaken[:, 4]], -1)
    poses = run.poses.as_array()
    error = step_error(poses, driven, steps, method)
    if limits is None and noise is None and isinstance(controller, PointTracker):
        error = max(error, _command_error(run, controller, reference))
    return error


def step_error(poses: np.ndarray, driven: np.ndarray, steps: np.ndarray, method: str) -> float:
    """How far each pose (rows, 3) is from a step of the one before under the command that was driven [m, rad]."""
    return float(np.abs(_stepped(poses[:-1], driven, steps, method) - poses[1:]).max())


def program_error(program: Program) -> float:
    """The largest distance of a program from an adaptive integration of its pieces at 1e-12, seen from its start [m].

    Only the first ``LONGEST_TURN`` [rad] of a piece are integrated; after one that turns more, what follows goes on
    from where the program has come.
    """
    state, error = np.zeros(3), 0.0
    tight: dict[str, Any] = {"relative_tolerance": 1e-12, "absolute_tolerance": 1e-13}
    knots = program.poses(Pose()).as_array()
    for begin, after, piece in zip(program.knots, knots[1:], program, strict=False):
        fastest = max(abs(piece.omega), abs(piece.omega + piece.alpha * piece.duration))
        until = min(piece.duration, LONGEST_TURN / max(fastest, 1e-9))
        if until > 0.0:
            state = integrate_ode(_held_rates(piece), [0.0, until], state, method="DOP853", **tight)[-1]
        there = program.pose(Pose(), begin + until).as_array() if until < piece.duration else after
        error = max(error, float(np.hypot(*(state - there)[:2])))
        state = state if until == piece.duration else after
    return error


def _held_rates(piece: Segment) -> Any:
    def rates(t: float, pose: np.ndarray) -> np.ndarray:
        moved = (piece.v + piece.a * t) * np.exp(1j * pose[2])
        return np.array([moved.real, moved.imag, piece.omega + piece.alpha * t])

    return rates


def wheel_error(base: WheeledBase, twist: Twist, rates: np.ndarray) -> float:
    """How far wheel rates are from the velocities of their contacts, as complex numbers [rad/s]."""
    apart = []
    for wheel, rate in zip(base.wheels, rates, strict=True):
        contact = complex(twist.vx, twist.vy) + 1j * twist.omega * complex(wheel.x, wheel.y)
        seen = contact * np.exp(-1j * wheel.drive_angle)
        slope = np.tan(wheel.roller_angle) if wheel.roller_angle else 0.0
        apart.append(abs(seen.real + slope * seen.imag - wheel.radius * rate) / wheel.radius)
    return float(max(apart))


def flight_error(shot: Shot, time: np.ndarray) -> float:
    """The largest distance of a shot from an adaptive integration of m a = -m g - C |v| v at 1e-12 [m].

    Times beyond ``SETTLED`` are left out: the projectile falls at its terminal speed there, step after step after step.
    """
    k, g = shot.projectile.drag_per_mass, shot.projectile.gravity
    early = time[time <= SETTLED / np.sqrt(k * g)] if k * g > 0.0 else time
    early = early if early.size > 1 else time[:1] + np.array([0.0, 1.0]) * SETTLED / np.sqrt(k * g)

    def rates(_: float, state: np.ndarray) -> np.ndarray:
        speed = abs(complex(state[2], state[3]))
        return np.array([state[2], state[3], -k * speed * state[2], -g - k * speed * state[3]])

    first = (*shot.start, *shot.velocity)
    states = integrate_ode(rates, early, first, method="DOP853", relative_tolerance=1e-12, absolute_tolerance=1e-13)
    return float(np.hypot(*(shot.at(early).position - states[:, :2]).T).max())


def _stepped(poses: np.ndarray, driven: np.ndarray, steps: np.ndarray, method: str) -> np.ndarray:
    """One step of every row."""
    v, omega = driven.T
    if method == "exact":
        turn = omega * steps
        safe = np.where(np.abs(turn) < 1e-6, 1.0, turn)
        chord = np.where(np.abs(turn) < 1e-6, 1.0 + 0.5j * turn, (np.exp(1j * turn) - 1.0) / (1j * safe))
        way = v * steps * chord * np.exp(1j * poses[:, 2])
        return np.asarray(poses + np.stack([way.real, way.imag, turn], -1))

    def rates(_: float, pose: np.ndarray) -> np.ndarray:
        moved = v * np.exp(1j * pose[:, 2])
        return np.stack([moved.real, moved.imag, omega], -1)

    each: Any = steps[:, None]
    return np.asarray(METHODS[method].step(rates, 0.0, poses, each))


def _command_error(run: Run, controller: PointTracker, reference: Any) -> float:
    """The largest difference between the commands of a run and those of its errors, relative to the largest."""
    steps, place = np.diff(run.t), points_of(reference.position(run.t))
    heading = np.exp(1j * run["theta"][:-1])
    centre = run["x"][:-1] + 1j * run["y"][:-1]
    aim = place[1:] if controller.error_against == "next" else place[:-1]
    error = aim - centre - heading * complex(controller.px, controller.py)
    before = np.concatenate([[0.0], error[:-1]])
    pull = controller.kp * error + controller.kd * (error - before) / steps
    pull = pull + controller.ki * np.cumsum(steps * error)
    if controller.feedforward:
        pull = pull + points_of(reference.velocity(run.t[:-1]))
    seen = pull / heading
    omega = seen.imag / controller.px
    v = seen.real + controller.py * omega
    apart = np.abs(np.stack([v - run["v"][1:], controller.px * (omega - run["omega"][1:])]))
    return float(apart.max() / max(1.0, np.abs(pull).max()))
