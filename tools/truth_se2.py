"""Golden cases of SE(2) by mpmath: exp, log, their Jacobians and the wrapped angle; WPILib stands beside them.

The matrices are built from their definitions, exp by V = [[sin t/t, -(1 - cos t)/t], [(1 - cos t)/t, sin t/t]] and log
by the inverse of V, with digits enough that nothing cancels; Jacobians by differences with a step of 1e-50.
"""

from __future__ import annotations

import itertools
import math

import mpmath as mp
from wpimath.geometry import Pose2d, Rotation2d, Twist2d

from golden import write

mp.mp.dps = 50

TINY = [10.0**-k for k in range(17)]
ANGLES = sorted(
    {
        0.0, *TINY, 3.0, 6.0, 20.0, 1234.5, 99999.0,
        math.pi / 2, *(math.pi / 2 + e for e in (1e-15, -1e-15, 1e-8, -1e-8)),
        math.pi, *(math.pi - e for e in TINY),
    }
)  # fmt: skip
SIGNED = sorted({*ANGLES, *(-a for a in ANGLES)})
VECTORS = [(1.0, 0.0), (0.0, 1.0), (0.3, -2.0)]


def v_matrix(t):
    """V with exp(dx, dy, t) = V (dx, dy)."""
    if t == 0:
        return mp.eye(2)
    with mp.extradps(60):
        a, b = mp.sin(t) / t, (1 - mp.cos(t)) / t
        return mp.matrix([[a, -b], [b, a]])


def exp(dx, dy, t):
    x, y = v_matrix(t) * mp.matrix([dx, dy])
    return [x, y, t]


def log(x, y, t):
    with mp.extradps(60):
        dx, dy = mp.lu_solve(v_matrix(t), mp.matrix([x, y]))
    return [dx, dy, t]


def jacobian(function, at):
    with mp.workdps(150):
        columns = []
        for k in range(3):
            step = mp.mpf(10) ** -50
            ahead, behind = list(at), list(at)
            ahead[k], behind[k] = at[k] + step, at[k] - step
            columns.append([(a - b) / (2 * step) for a, b in zip(function(*ahead), function(*behind), strict=True)])
        return [[columns[k][row] for k in range(3)] for row in range(3)]


def exact(*numbers):
    return [mp.mpf(n) for n in numbers]


def floats(row):
    return [floats(r) if isinstance(r, list) else float(r) for r in row]


def right(dx, dy, t):
    """J_r = R(-t) dexp, from the definition exp(xi + d) = exp(xi) exp(J_r d)."""
    s, c = mp.sin(t), mp.cos(t)
    turned = mp.matrix([[c, s, 0], [-s, c, 0], [0, 0, 1]]) * mp.matrix(jacobian(exp, exact(dx, dy, t)))
    return [[turned[i, j] for j in range(3)] for i in range(3)]


def wrapped(angle):
    """The angle less whole turns of the float 2 pi, in (-pi, pi] of the float pi: exact arithmetic."""
    turn, half = mp.mpf(math.tau), mp.mpf(math.pi)
    with mp.workdps(400):
        return mp.mpf(angle) - turn * mp.ceil((mp.mpf(angle) - half) / turn)


def wpilib_exp(dx, dy, t):
    pose = Pose2d(0.0, 0.0, Rotation2d(0.0)).exp(Twist2d(dx, dy, t))
    return [pose.x, pose.y]


def wpilib_log(x, y, t):
    twist = Pose2d(0.0, 0.0, Rotation2d(0.0)).log(Pose2d(x, y, Rotation2d(t)))
    return [twist.dx, twist.dy, twist.dtheta]


def apart(row, truth):
    """Largest relative error of the first two entries: how exact the other library is here."""
    return max(float(abs(a - b) / abs(b)) if b else float(abs(a)) for a, b in zip(row[:2], truth[:2], strict=True))


def cases():
    for (a, b), t in itertools.product(VECTORS, SIGNED):
        truth, other = exp(*exact(a, b, t)), wpilib_exp(a, b, t)
        yield {"kind": "exp", "given": [a, b, t], "result": floats(truth), "wpilib": other, "off": apart(other, truth)}
    for (a, b), t in itertools.product(VECTORS, SIGNED):
        if -math.pi < t <= math.pi:
            truth, other = log(*exact(a, b, t)), wpilib_log(a, b, t)
            yield {
                "kind": "log",
                "given": [a, b, t],
                "result": floats(truth),
                "wpilib": other,
                "off": apart(other, truth),
            }
    for (a, b), t in itertools.product(VECTORS[::2], SIGNED[::3]):
        given = exact(a, b, t)
        yield {
            "kind": "jacobian",
            "given": [a, b, t],
            "exp": floats(jacobian(exp, given)),
            "right": floats(right(a, b, t)),
        }
    for angle in [*SIGNED, *(s * k * math.pi for k in range(1, 12) for s in (1, -1)), 1e5, 1e8, -1e12, 1e16, 1e300]:
        yield {"kind": "wrap", "given": angle, "result": float(wrapped(angle))}


if __name__ == "__main__":
    write(
        __file__,
        cases(),
        packages=["mpmath", "robotpy-wpimath"],
        tolerance={"exp": 8e-16, "log": 8e-16, "jacobian": 1e-15, "wrap": 0.0, "wpilib": 1e-12},
        unit="m, rad; exp and log relative, entry by entry (of the vector's length where both entries of it are given)",
    )
