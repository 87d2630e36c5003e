"""Golden values for wheeled bases: tests/truth/wheels_wpimath.json and tests/truth/wheels_mpmath.json.

Run as  python tools/truth_wheels.py  from the root of the project, with robotpy-wpimath and mpmath installed.
"""

from __future__ import annotations

import json
import random
from importlib.metadata import version
from pathlib import Path

import mpmath
from wpimath.geometry import Translation2d
from wpimath.kinematics import (
    ChassisSpeeds,
    DifferentialDriveKinematics,
    DifferentialDriveWheelSpeeds,
    MecanumDriveKinematics,
    MecanumDriveWheelSpeeds,
)

TRUTH = Path(__file__).parent.parent / "tests" / "truth"
GENERATOR = "tools/truth_wheels.py"


def twist_of(speeds):
    return [speeds.vx, speeds.vy, speeds.omega]


def differential_case(rng):
    track, radius, limit = rng.uniform(0.1, 1.5), rng.uniform(0.02, 0.3), rng.uniform(0.5, 2.0)
    kinematics = DifferentialDriveKinematics(track)
    left, right = rng.uniform(-3, 3), rng.uniform(-3, 3)
    wanted = [rng.uniform(-3, 3), 0.0, rng.uniform(-3, 3)]
    wheels = kinematics.toWheelSpeeds(ChassisSpeeds(*wanted))
    slower = kinematics.toWheelSpeeds(ChassisSpeeds(*wanted))
    slower.desaturate(limit)
    return {
        "track": track, "radius": radius, "limit": limit, "speeds": [left, right], "wanted": wanted,
        "twist": twist_of(kinematics.toChassisSpeeds(DifferentialDriveWheelSpeeds(left, right))),
        "wheels": [wheels.left, wheels.right], "desaturated": [slower.left, slower.right],
    }  # fmt: skip


def mecanum_row(speeds):
    return [speeds.frontLeft, speeds.frontRight, speeds.rearLeft, speeds.rearRight]


def mecanum_case(rng):
    half_length, half_width, limit = rng.uniform(0.1, 0.8), rng.uniform(0.1, 0.8), rng.uniform(0.5, 2.0)
    corners = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
    kinematics = MecanumDriveKinematics(*(Translation2d(a * half_length, b * half_width) for a, b in corners))
    speeds = [rng.uniform(-3, 3) for _ in range(4)]
    wanted = [rng.uniform(-3, 3) for _ in range(3)]
    slower = kinematics.toWheelSpeeds(ChassisSpeeds(*wanted))
    slower.desaturate(limit)
    return {
        "half_length": half_length, "half_width": half_width, "radius": rng.uniform(0.02, 0.3), "limit": limit,
        "speeds": speeds, "wanted": wanted,
        "twist": twist_of(kinematics.toChassisSpeeds(MecanumDriveWheelSpeeds(*speeds))),
        "wheels": mecanum_row(kinematics.toWheelSpeeds(ChassisSpeeds(*wanted))), "desaturated": mecanum_row(slower),
    }  # fmt: skip


def direction_rows(wheel):
    """The contact's velocity is (vx - omega y, vy + omega x); measured along the drive and the free directions."""
    x, y, beta, _, gamma = (mpmath.mpf(v) if v is not None else None for v in wheel)
    drive, side = (mpmath.cos(beta), mpmath.sin(beta)), (-mpmath.sin(beta), mpmath.cos(beta))
    velocity = [(1, 0), (0, 1), (-y, x)]  # of the contact, for unit vx, vy, omega
    along = [drive[0] * u + drive[1] * w for u, w in velocity]
    across = [side[0] * u + side[1] * w for u, w in velocity]
    if gamma is None:
        return [along, across]
    # velocity = drive speed along beta + slide along the free direction beta + gamma + 90 deg: solve for the first.
    slide = [a / mpmath.cos(gamma) for a in across]
    return [[a + s * mpmath.sin(gamma) for a, s in zip(along, slide, strict=True)]]


def layout_case(rng, count):
    wheels = []
    for _ in range(count):
        gamma = rng.choice([0.0, 0.0, rng.uniform(-1.0, 1.0)])
        wheels.append([rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-3, 3), rng.uniform(0.05, 0.2), gamma])
    if rng.random() < 0.3:
        wheels[0][4] = None
    rows = [direction_rows(wheel) for wheel in wheels]
    rolling, lateral = [r[0] for r in rows], [r[1] for r in rows if len(r) > 1]
    matrix = mpmath.matrix(rolling + lateral)
    rates, twist = [rng.uniform(-9, 9) for _ in wheels], [rng.uniform(-2, 2) for _ in range(3)]
    speeds = mpmath.matrix(
        [mpmath.mpf(w[3]) * rate for w, rate in zip(wheels, rates, strict=True)] + [0] * len(lateral)
    )
    best = mpmath.lu_solve(matrix.T * matrix, matrix.T * speeds)
    inverse = mpmath.matrix(rolling) * mpmath.matrix(twist)
    return {
        "wheels": wheels, "rates": rates, "forward": [float(v) for v in best],
        "residual": [float(v) for v in speeds - matrix * best], "twist": twist,
        "inverse": [float(v / mpmath.mpf(w[3])) for v, w in zip(inverse, wheels, strict=True)],
        "condition": float(mpmath.sqrt(mpmath.cond(matrix.T * matrix))),
    }  # fmt: skip


def chi_square_threshold(degrees, false_alarm):
    """The x with Q(degrees/2, x/2) = false_alarm."""
    excess = lambda x: mpmath.gammainc(mpmath.mpf(degrees) / 2, x / 2, regularized=True) - mpmath.mpf(false_alarm)  # noqa: E731
    return float(mpmath.findroot(excess, (0.1, 60.0), solver="bisect", tol=1e-40, maxsteps=200))


def write(name, versions, tolerance, cases):
    content = {"generator": GENERATOR, "versions": versions, "tolerance": tolerance, **cases}
    (TRUTH / name).write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def main():
    rng = random.Random(20)
    write(
        "wheels_wpimath.json", {"robotpy-wpimath": version("robotpy-wpimath")}, 1e-13,
        {
            "differential": [differential_case(rng) for _ in range(40)],
            "mecanum": [mecanum_case(rng) for _ in range(40)],
        },
    )  # fmt: skip
    mpmath.mp.dps = 50
    thresholds = [[d, p, chi_square_threshold(d, p)] for d in (1, 2, 3, 5) for p in (0.1, 0.01, 1e-4)]
    write(
        "wheels_mpmath.json", {"mpmath": version("mpmath")}, 1e-13,
        {"layouts": [layout_case(rng, n) for n in (3, 3, 4, 4, 5, 6) for _ in range(8)], "chi_square": thresholds},
    )  # fmt: skip


if __name__ == "__main__":
    main()
