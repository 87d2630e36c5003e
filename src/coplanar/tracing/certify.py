"""What a trace has shown: how near to singular, how large the steps, how near to the limits, how far off the curve."""

from __future__ import annotations

import numpy as np

from coplanar.arms import Arm
from coplanar.arms.geometry import tool_lever
from coplanar.curves import Curve
from coplanar.engine import evaluator
from coplanar.laws import arms as laws
from coplanar.tracing.branch import Branch
from coplanar.tracing.result import Certificate, Failure, Reason
from coplanar.tracing.ring import Path

_elbow_sine = evaluator(laws.elbow_sine)
Rows = tuple[np.ndarray, np.ndarray, np.ndarray]


def certify(
    arm: Arm, curve: Curve, rows: Rows, failures: list[Failure], inside: tuple[Path, Branch, np.ndarray] | None = None
) -> Certificate:
    """The certificate of what was followed.

    Args:
        arm: The arm.
        curve: The curve.
        rows: Parameters, joints, and which of them follow.
        failures: Where they do not.
        inside: For two revolute joints the path and its branch at all knots, and which of these follow.
    """
    phi, q, followed = rows
    postures = q[followed] if inside is None else inside[1].q[inside[2]]
    sine, sine_at = (None, None) if inside is None else _smallest_sine(inside[0], inside[2])
    step, step_at = _largest_step(phi, q, followed)
    off = arm.forward(q[followed]).position - curve.position(phi[followed])
    margins = np.minimum(postures - arm.lower, arm.upper - postures)
    return Certificate(
        smallest_sine=sine,
        smallest_sine_at=sine_at,
        smallest_conditioning=_smallest_conditioning(arm, postures),
        largest_step=step,
        largest_step_at=step_at,
        limits_kept=all(failure.reason is not Reason.JOINT_LIMIT for failure in failures),
        limit_margin=float(margins.min(initial=np.inf)),
        elbows=() if inside is None else _elbows(inside[1]),
        position_error=float(np.hypot(off[:, 0], off[:, 1]).max(initial=0.0)),
    )


def _smallest_sine(path: Path, on_curve: np.ndarray) -> tuple[float | None, float | None]:
    """Smallest |sin| at the elbow and its parameter: between the knots it is nowhere smaller than at both."""
    if not on_curve.any():
        return None, None
    radius = np.clip(path.radius, path.inner, path.outer)
    sines = np.asarray(_elbow_sine(radius, 0.0, path.arm.links[0], tool_lever(path.arm)[0]))
    least = int(np.where(on_curve, sines, np.inf).argmin())
    return float(sines[least]), float(path.knots[least])


def _smallest_conditioning(arm: Arm, postures: np.ndarray) -> float:
    """Smallest over largest singular value of the position Jacobian; 0 where there are no postures."""
    if not len(postures):
        return 0.0
    values = np.linalg.svd(arm.jacobian(postures, task="position"), compute_uv=False)
    return float((values[:, -1] / np.maximum(values[:, 0], np.finfo(np.float64).tiny)).min())


def _largest_step(phi: np.ndarray, q: np.ndarray, followed: np.ndarray) -> tuple[float, float]:
    """Largest change of a joint between neighbouring rows that follow, and the parameter before it."""
    steps = np.where(followed[1:] & followed[:-1], np.abs(np.diff(q, axis=0)).max(axis=1), 0.0)
    largest = int(steps.argmax())
    return float(steps[largest]), float(phi[largest])


def _elbows(branch: Branch) -> tuple[int, ...]:
    """The signs one after the other, up to where the arm stopped."""
    signs = branch.elbow[: branch.stop + 1]
    changes = np.concatenate([[True], signs[1:] != signs[:-1]])
    return tuple(signs[changes].tolist())
