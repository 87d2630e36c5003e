"""Driving: histories, arcs, clothoids, holonomic motion, ramps."""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np

from coplanar.integrators import integrate_ode
from coplanar.motion import DrivingHistory, HolonomicMotion, Program, Ramp, Segment
from coplanar.se2 import Pose
from coplanar.tour.demo import Demo
from coplanar.viz.axes import plot_headings, plot_path, plot_series
from coplanar.viz.scene import Scene

_ROBOT = np.array([(0.1 * np.cos(a), 0.1 * np.sin(a)) for a in np.linspace(0.0, 2.0 * pi, 37)])


def drive_square() -> Demo:
    """A differential drive on alternating commands: a square that does not close."""
    history = DrivingHistory.square()
    path = history.path(Pose(0.0, 0.0, -0.5 * pi), method="euler").as_array()
    v, omega = (np.append(held, held[-1]) for held in (history.v, history.omega))
    sides = np.hypot(*np.diff(path[:, :2], axis=0).T)
    gap = float(np.hypot(*(path[-1, :2] - path[0, :2])))
    error = float(np.abs(path[-1] - (0.1, -0.1, pi)).max())

    def figure(canvas: Any) -> None:
        left, right = canvas.subplots(1, 2, width_ratios=(1.2, 1))
        plot_headings(path, plot_path(path, left, color="C1"), colour="C0", length=0.08)
        left.set_title("Euler, 0.1 s")
        right.step(history.t, v, where="post", label="v [m/s]")
        right.step(history.t, omega, where="post", label="omega [rad/s]")
        right.set_xlabel("time [s]")
        right.legend()

    return Demo(
        name="drive-square",
        title="Differential drive from a driving history",
        headline=f"ends {gap:.3f} m from where it starts: the square does not close",
        check=f"eleven, ten, ten and nine steps of 0.1 m counted by hand: {error:.0e}",
        passed=bool(error < 1e-12 and round(float(sides.sum()), 9) == 4.0),
        story="One-second pieces, alternately 1 m/s and a quarter turn per second. The time vector gives the first "
        "side eleven samples and never drives the last one, so the path misses its start by a step in x and in y.",
        tables={"run.csv": _table(history.t, path) | {"v": v, "omega": omega}},
        figure=figure,
        scene=Scene(history.t).trail(path[:, :2]).body(path, _ROBOT),
    )


def arc_chain() -> Demo:
    """Arcs of constant (v, omega), joined by coordinate transforms."""
    commands = ((1.0, 1.2, 1.5), (0.8, -1.6, 1.2), (1.2, 0.0, 0.8), (0.0, pi / 2, 1.0), (0.9, 0.9, 2.0))
    program = Program([Segment(v, omega, duration=T) for v, omega, T in commands])
    t, path, error = _driven(program, 0.05)

    def figure(canvas: Any) -> None:
        ax = plot_headings(path, plot_path(path, canvas.subplots(), color="C1"), colour="C0", count=16)
        knots = program.poses(Pose())
        ax.plot(knots.x, knots.y, "s", color="C3", markersize=5)
        ax.set_title("five segments; squares mark the joints")

    return Demo(
        name="arc-chain",
        title="Exact arcs joined end to end",
        headline=f"ends at ({path[-1, 0]:.4f}, {path[-1, 1]:.4f}) m, {np.degrees(path[-1, 2]):.1f} deg",
        check=f"DOP853 at 1e-12 over all pieces: {error:.0e} m",
        passed=bool(error < 1e-9),
        story="Constant v and omega drive a circular arc, exactly, for any step; a line and a turn on the spot are "
        "arcs too. Each piece starts where the one before ends, so that their transforms multiply.",
        tables={"run.csv": _table(t, path)},
        figure=figure,
        scene=Scene(t).trail(path[:, :2]).body(path, _ROBOT),
    )


def clothoid() -> Demo:
    """Constant accelerations: a path whose turning changes sign."""
    segment = Segment(1.0, -0.5, a=0.2, alpha=0.4, duration=10.0)
    t, path, error = _driven(Program([segment]), 0.1)

    def figure(canvas: Any) -> None:
        left, right = canvas.subplots(1, 2, width_ratios=(1.3, 1))
        plot_headings(path, plot_path(path, left, color="C1"), colour="C0", length=0.12)
        twist = segment.twist(t)
        plot_series(t, {"v [m/s]": twist.vx, "omega [rad/s]": twist.omega}, right, unit="velocity")

    return Demo(
        name="clothoid",
        title="Constant accelerations: generalised Fresnel integrals",
        headline=f"ends at ({path[-1, 0]:.6f}, {path[-1, 1]:.6f}) m; it is a {_kind(segment)} curve, no clothoid",
        check=f"DOP853 at 1e-12: {error:.0e} m",
        passed=bool(error < 1e-9),
        story="With v and omega both growing, the pose is an integral without a closed form. Gauss panels of bounded "
        "phase give it to the last digits for every omega and alpha, 0 included. Only a = 0 makes it a clothoid.",
        tables={"run.csv": _table(t, path)},
        figure=figure,
        scene=Scene(t).trail(path[:, :2]).body(path, _ROBOT),
    )


def holonomic() -> Demo:
    """A body whose vx and vy are commanded independently."""
    accelerations = [(0.8, 0.0, 0.0), (0.0, 0.6, 0.0), (-0.8, 0.0, 0.0), (0.0, -0.6, 0.0)]
    motion = HolonomicMotion.from_accelerations([1.0, 1.5, 1.0, 1.5], accelerations)
    t = np.linspace(0.0, 5.0, 101)
    pose, velocity = motion.pose(Pose(), t), motion.velocity(t)
    # The velocities are linear between their corners, all of which are sampled: trapezoids are exact.
    steps = velocity[:-1] + velocity[1:]
    error = float(np.abs(0.5 * 0.05 * steps.sum(axis=0)[:2] - pose.position[-1]).max())

    def figure(canvas: Any) -> None:
        left, right = canvas.subplots(1, 2, width_ratios=(1.3, 1))
        plot_path(pose.position, left, color="C1")
        series = {"vx": velocity[:, 0], "vy": velocity[:, 1], "speed": motion.speed(t)}
        plot_series(t, series, right, unit="velocity [m/s]")

    return Demo(
        name="holonomic",
        title="Holonomic motion",
        headline=f"ends at ({pose.x[-1]:.3f}, {pose.y[-1]:.3f}) m with its heading unchanged",
        check=f"trapezoids under the velocities: {error:.0e} m",
        passed=bool(error < 1e-12),
        story="Here vx and vy do not depend on the heading, so that each coordinate is the integral of its own "
        "velocity. Three controls drive three coordinates; a differential drive has two.",
        tables={"run.csv": _planar(t, pose.position, velocity)},
        figure=figure,
        scene=Scene(t).trail(pose.position).body(pose.as_array(), 0.7 * _square()),
    )


def ramp() -> Demo:
    """From one velocity to another, independently or together."""
    start, target, acceleration = (0.4, 0.2), (1.2, -0.6), (0.5, 0.25)
    alone = Ramp.independent(start, target, acceleration)
    together = Ramp.synchronised(start, target, acceleration)
    t = np.linspace(0.0, 4.0, 161)
    position, velocity = alone.position((0.0, 0.0), t), alone.velocity(t)
    areas = np.cumsum(0.5 * 0.025 * (velocity[:-1] + velocity[1:]), axis=0)
    error = float(np.abs(areas - position[1:]).max())

    def figure(canvas: Any) -> None:
        left, right = canvas.subplots(1, 2, width_ratios=(1.2, 1))
        plot_path(position, left, label="independent")
        plot_path(together.position((0.0, 0.0), t), left, label="synchronised")
        left.legend()
        plot_series(t, {"vx": velocity[:, 0], "vy": velocity[:, 1]}, right, unit="velocity [m/s]")

    return Demo(
        name="ramp",
        title="Velocity ramps",
        headline=f"vx arrives after {alone.durations[0]:.2f} s, vy after {alone.durations[1]:.2f} s",
        check=f"areas under the velocities: {error:.0e} m",
        passed=bool(error < 1e-12 and np.array_equal(velocity[-1], target)),
        story="Each component moves at its own constant acceleration until it reaches its target, then holds. Reached "
        "at different times, the targets bend the path in velocity space; synchronised ramps keep it straight.",
        tables={"run.csv": _planar(t, position, velocity)},
        figure=figure,
        scene=Scene(t).trail(position).moving_point(position),
    )


def _driven(program: Program, step: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Times, poses and the largest distance to an adaptive integration of every piece at 1e-12 [m]."""
    t, poses = program.sample(Pose(), step)
    state, error = np.zeros(3), 0.0
    for piece, end in zip(program, program.poses(Pose()).as_array()[1:], strict=True):
        times = [0.0, float(piece.duration)]
        tight = {"relative_tolerance": 1e-12, "absolute_tolerance": 1e-13}
        state = integrate_ode(_rates(piece), times, state, method="DOP853", **tight)[-1]
        error = max(error, float(np.hypot(*(state - end)[:2])))
    return t, poses.as_array(), error


def _rates(piece: Segment) -> Any:
    def rates(t: float, pose: np.ndarray) -> np.ndarray:
        v = piece.v + piece.a * t
        return np.array([v * np.cos(pose[2]), v * np.sin(pose[2]), piece.omega + piece.alpha * t])

    return rates


def _kind(segment: Segment) -> str:
    return str(getattr(segment.kind, "value", segment.kind))


def _square() -> np.ndarray:
    return 0.15 * np.array([(1, 1), (-1, 1), (-1, -1), (1, -1), (1, 1)])


def _table(t: np.ndarray, path: np.ndarray) -> dict[str, Any]:
    return {"t": t, "x": path[:, 0], "y": path[:, 1], "theta": path[:, 2]}


def _planar(t: np.ndarray, position: np.ndarray, velocity: np.ndarray) -> dict[str, Any]:
    return {"t": t, "x": position[:, 0], "y": position[:, 1], "vx": velocity[:, 0], "vy": velocity[:, 1]}
