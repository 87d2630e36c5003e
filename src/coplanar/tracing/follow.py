"""An arm follows a curve, and says what it has shown."""

from __future__ import annotations

import math

import numpy as np

from coplanar import checks
from coplanar.arms import Arm
from coplanar.arms.closed import ELBOWS, has_closed_form
from coplanar.checks import ArrayLike
from coplanar.curves import Curve
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.tracing.branch import AT_SINGULAR, Branch, follow, limit_failures
from coplanar.tracing.certify import certify
from coplanar.tracing.result import Failure, Reason, Trace
from coplanar.tracing.ring import Path
from coplanar.tracing.search import Walker


def trace(
    arm: Arm, curve: Curve, parameters: ArrayLike, *, elbow: int | None = None, near: ArrayLike | None = None,
    at_singular: str = "stop", tolerance: float = 1e-9, between: int = 8, step_limit: float = 0.5 * math.pi,
) -> Trace:  # fmt: skip
    """Joints along a curve by continuity, with a certificate of the branch or the exact interval where it fails.

    With two revolute joints the branch is followed in closed form and in unwrapped joints, at the parameters, at
    ``between`` pieces of each interval between them, and wherever the distance from the base is extreme; the ends of
    failures are roots on the curve. A limit that is passed and kept again within one piece is not seen. Other arms
    walk by ``arm.inverse``, started from the joints before.

    Args:
        arm: The arm.
        curve: What its tool follows, in the world.
        parameters: Strictly monotone parameters of the curve, shape (rows,); or how many, evenly over its interval.
        elbow: Sign of the sine at the elbow at the start; that of the start nearest to ``near`` (then +1) when None.
        near: Joints that the start comes nearest to, shape (n,).
        at_singular: What to do where the two branches meet. "stop": stop there and say where. "through": go straight
            on, which changes the elbow. "bounce": keep the elbow.
        tolerance: How far off the ring's edge, or the curve, counts as on it [m].
        between: How many pieces of an interval between two parameters are looked at.
        step_limit: Of other arms: how far a joint may move from one parameter to the next [rad or m].

    Raises:
        InvalidShape: If the parameters are no vector or ``near`` has not one entry a joint.
        InvalidValue: If the parameters are not monotone or not on the curve, or the elbow is neither +1 nor -1.
        UnknownName: If ``at_singular`` is none of the three.

    Example:
        >>> from coplanar.curves import Lemniscate
        >>> arm, curve = Arm((1.0, 1.0)), Lemniscate(1.0)
        >>> str(trace(arm, curve, 201).failures[0])[:14]
        '1.57079632679 '
        >>> passed = trace(arm, curve, 201, at_singular="through")
        >>> passed.status.name, [point.kind for point in passed.singular_points], passed.certificate.elbows
        ('PASSED', ['base', 'base'], (1, -1, 1))
    """
    phi = curve.parameters(parameters) if isinstance(parameters, int) else checks.monotone("parameters", parameters)
    checks.choice("at_singular", at_singular, AT_SINGULAR)
    if curve.shape:
        raise InvalidShape("curve", f"shape {curve.shape}", "one curve", "trace them one by one")
    if between < 1:
        raise InvalidValue("between", between, "1 or more")
    start = None if near is None else _start(arm, near)
    checks.positive("tolerance", tolerance)
    if elbow is not None and elbow not in ELBOWS:
        raise InvalidValue("elbow", elbow, "+1 or -1, the sign of the sine at the elbow")
    if has_closed_form(arm, with_heading=False):
        path = Path.of(arm, curve, phi, between, tolerance)
        first = arm.inverse(curve.position(phi[0]), near=start, elbow=elbow)
        return _on_a_branch(path, phi, follow(path, elbow or int(first.elbow), start, at_singular))
    walker = Walker(arm, curve, tolerance, checks.positive("step_limit", step_limit))
    q, followed, failures = walker.walk(phi, start)
    shown = certify(arm, curve, (phi, q, followed), failures)
    return Trace(arm, curve, phi, q, followed, np.zeros(len(phi), dtype=int), tuple(failures), (), shown)


def _start(arm: Arm, near: ArrayLike) -> np.ndarray:
    q = np.asarray(arm.checked_joints("near", near))
    if q.ndim != 1:
        raise InvalidShape("near", f"shape {q.shape}", f"one posture, shape ({arm.n},)")
    return q


def _on_a_branch(path: Path, phi: np.ndarray, branch: Branch) -> Trace:
    """The rows asked for, out of the knots of the path."""
    knots, stop = path.knots, branch.stop
    sign = 1.0 if knots[-1] > knots[0] else -1.0
    failures = [f for f in path.failures() + limit_failures(path, branch) if sign * f.first <= sign * knots[stop]]
    if stop < len(knots) - 1:
        failures.append(Failure(float(knots[stop]), float(knots[-1]), Reason.SINGULAR))
    failures.sort(key=lambda failure: sign * failure.first)
    on_curve = np.ones(len(knots), dtype=bool)
    for failure in failures:
        inside = (sign * knots >= sign * failure.first) & (sign * knots <= sign * failure.last)
        on_curve &= ~inside | (knots == knots[stop]) & (failure.reason is Reason.SINGULAR)
    rows = path.index(phi)
    shown = certify(path.arm, path.curve, (phi, branch.q[rows], on_curve[rows]), failures, (path, branch, on_curve))
    table = branch.q[rows], on_curve[rows], branch.elbow[rows]
    return Trace(path.arm, path.curve, phi, *table, tuple(failures), branch.singular_points, shown)
