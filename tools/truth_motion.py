"""Write the golden files of motion: tests/truth/motion_*.json.  Run from the root: python tools/truth_motion.py."""

from __future__ import annotations

import importlib.metadata
import itertools
import json
from pathlib import Path

import mpmath as mp
import numpy as np
from scipy.integrate import solve_ivp

FOLDER = Path(__file__).parents[1] / "tests" / "truth"
TINY_TO_LARGE = (0.0, 1e-12, 1e-8, 1e-4, 1e-2, 0.3, 1.0, 3.0, 10.0)
SIGNED = (*TINY_TO_LARGE, *(-value for value in TINY_TO_LARGE[1:]))
DURATION = 1.25


def panels(omega, alpha, duration):
    fastest = max(abs(omega), abs(omega + alpha * duration))
    count = int(fastest * duration / 4.0) + 1
    return [mp.mpf(duration) * k / count for k in range(count + 1)]


def integral(v, omega, a, alpha, duration, factor):
    """The integral int factor(s, v + a s) e^(i (omega s + alpha s^2/2)) ds to 50 digits."""
    v, omega, a, alpha = map(mp.mpf, (v, omega, a, alpha))
    knots = panels(omega, alpha, duration)
    return mp.quad(lambda s: factor(s, v + a * s) * mp.expj(omega * s + alpha * s * s / 2), knots)


def pair(number):
    return [float(number.real), float(number.imag)]


def segments():
    for omega, alpha, a in itertools.product(SIGNED, SIGNED, (0.0, -1.5)):
        end = integral(1.0, omega, a, alpha, DURATION, lambda _, speed: speed)
        yield {"command": [1.0, omega, a, alpha, DURATION], "end": pair(end)}


def jacobians():
    for omega, alpha, a in itertools.product((0.0, 1e-9, -0.3, 4.0), (0.0, -1e-9, 0.5, -6.0), (0.0, -1.5)):
        parts = (1.0, omega, a, alpha, DURATION)
        yield {
            "command": list(parts),
            "by_v": pair(integral(*parts, lambda *_: mp.mpf(1))),
            "by_omega": pair(integral(*parts, lambda s, speed: mp.mpc(0, 1) * s * speed)),
            "by_a": pair(integral(*parts, lambda s, _: s)),
            "by_alpha": pair(integral(*parts, lambda s, speed: mp.mpc(0, 1) * s * s * speed / 2)),
        }


def clothoids():
    from pyclothoids import Clothoid

    for curvature, rate in itertools.product((-2.0, -0.1, 0.0, 0.7, 3.0), (-2.5, -1e-3, 0.0, 0.4, 2.0)):
        curve = Clothoid.StandardParams(0.5, -0.25, 0.75, curvature, rate, 2.0)
        points = [[curve.X(s), curve.Y(s), curve.Theta(s)] for s in (0.5, 1.0, 2.0)]
        yield {
            "start": [0.5, -0.25, 0.75],
            "curvature": curvature,
            "rate": rate,
            "at": [0.5, 1.0, 2.0],
            "poses": points,
        }


def rates(t, pose, v, omega, a, alpha):
    return [(v + a * t) * np.cos(pose[2]), (v + a * t) * np.sin(pose[2]), omega + alpha * t]


def odes():
    rng = np.random.default_rng(20)
    for _ in range(60):
        start, command = rng.uniform(-2.0, 2.0, 3), rng.uniform(-2.0, 2.0, 4)
        times = np.array([0.5, 1.0, 2.0])
        answer = solve_ivp(rates, (0.0, 2.0), start, "DOP853", times, args=tuple(command), rtol=1e-13, atol=1e-14)
        yield {"start": start.tolist(), "command": command.tolist(), "at": times.tolist(), "poses": answer.y.T.tolist()}


def wheels():
    from wpimath.geometry import Pose2d, Rotation2d
    from wpimath.kinematics import DifferentialDriveKinematics

    rng = np.random.default_rng(21)
    for track in (0.2, 0.55, 1.5):
        kinematics, pose, poses = DifferentialDriveKinematics(track), Pose2d(1.0, 2.0, Rotation2d(0.5)), []
        ways = rng.uniform(-0.2, 0.3, (40, 2))
        for left, right in ways:
            twist = kinematics.toTwist2d(left, right)
            step = twist.exp() if hasattr(twist, "exp") else None
            pose = pose.transformBy(step) if step is not None else pose.exp(twist)
            poses.append([pose.X(), pose.Y(), pose.rotation().radians()])
        yield {"track": track, "start": [1.0, 2.0, 0.5], "ways": ways.tolist(), "poses": poses}


def write(name, oracle, tolerance, cases):
    package = {"mpmath": "mpmath", "scipy DOP853": "scipy", "pyclothoids": "pyclothoids", "WPILib": "robotpy-wpimath"}[
        oracle
    ]
    document = {
        "generator": "tools/truth_motion.py",
        "oracle": oracle,
        "version": importlib.metadata.version(package),
        "tolerance": tolerance,
        "cases": list(cases),
    }
    text = json.dumps(document, separators=(",", ":")).replace('{"', '\n{"')
    (FOLDER / f"motion_{name}.json").write_text(text.lstrip() + "\n")
    print(name, len(document["cases"]), "cases,", len(text), "bytes")


def main():
    mp.mp.dps = 50
    write("segments", "mpmath", 1e-14, segments())
    write("jacobians", "mpmath", 1e-14, jacobians())
    write("clothoids", "pyclothoids", 1e-13, clothoids())
    write("odes", "scipy DOP853", 1e-11, odes())
    write("wheels", "WPILib", 1e-9, wheels())


if __name__ == "__main__":
    main()
