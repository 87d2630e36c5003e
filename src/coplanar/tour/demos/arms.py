"""Arms: where they are, how they get there, what they draw."""

from __future__ import annotations

import cmath
from typing import Any

import numpy as np

from coplanar.arms import Arm
from coplanar.curves import Circle, Curve, Lemniscate
from coplanar.solving import Report
from coplanar.tour.demo import Demo
from coplanar.tracing import Trace, trace
from coplanar.viz.axes import plane, plot_linkage, plot_path, plot_series
from coplanar.viz.scene import Scene


def arm_pose() -> Demo:
    """A two-link arm and where its joints are."""
    arm, q = Arm((0.5, 0.3)), (0.3, 0.4)
    points = arm.points(q)
    elbow = cmath.rect(0.5, 0.3)
    tool = elbow + cmath.rect(0.3, 0.7)
    error = max(abs(complex(*p) - z) for p, z in zip(points, (0.0, elbow, tool), strict=True))

    def figure(canvas: Any) -> None:
        ax = plot_linkage(points, canvas.subplots(), colours=("C0", "C2"))
        for name, (x, y) in zip(("base", "elbow", "tool"), points, strict=True):
            ax.annotate(name, (x, y), textcoords="offset points", xytext=(8, -12))
        ax.set_title("links 0.5 m and 0.3 m, q = (0.3, 0.4) rad")

    return Demo(
        name="arm-pose",
        title="Two-link arm, forward kinematics",
        headline=f"tool at ({points[2, 0]:.4f}, {points[2, 1]:.4f}) m",
        check=f"sums of complex exponentials: {error:.0e} m",
        passed=bool(error < 1e-15),
        story="Each link adds its length along its own direction; relative joint angles add up along the arm.",
        tables={"run.csv": {"point": ("base", "elbow", "tool"), "x": points[:, 0], "y": points[:, 1]}},
        figure=figure,
    )


def arm_reach() -> Demo:
    """Both elbows that reach a target, and a numerical search that finds one of them."""
    arm, target = Arm((0.5, 0.5)), (0.5, 0.0)
    both = arm.inverse(target)
    search = arm.inverse(target, near=(0.1, 0.1), method="numerical")
    error = float(np.abs(both.branches - search.q).max(axis=-1).min())

    def figure(canvas: Any) -> None:
        left, right = canvas.subplots(1, 2)
        for q, colour in zip(both.branches, ("C0", "C1"), strict=True):
            plot_linkage(arm.points(q), left, colours=(colour,))
        left.plot(*target, "x", color="C3", markersize=9, markeredgewidth=2, zorder=5)
        left.set_title("both elbows")
        residuals = [line.residual for line in search.report]
        right.semilogy(range(len(residuals)), np.maximum(residuals, 1e-17), "o-")
        right.set_title("search from (0.1, 0.1)")
        right.set_xlabel("iteration")
        right.set_ylabel("distance to the target [m]")

    return Demo(
        name="arm-reach",
        title="Inverse kinematics of the two-link arm",
        headline=f"q2 = +120 deg and -120 deg; the search takes {search.iterations} iterations",
        check=f"search against closed form: {error:.0e} rad; {search.status.value}",
        passed=bool(error < 1e-9 and search.position_error() < 1e-9),
        story="A reachable target has two answers, one for each sign of the elbow. The numerical solver reports every "
        "iteration, a status sentence and the residual, and lands on the branch nearest to where it starts.",
        tables={
            "run.csv": {"elbow": (1, -1), "q1": both.branches[:, 0], "q2": both.branches[:, 1]},
            "iterations.csv": _iterations(search.report),
        },
        figure=figure,
        scene=_search_scene(arm, search.report, target),
    )


def trace_circle() -> Demo:
    """An arm draws a circle."""
    followed = trace(Arm((1.0, 1.0)), _circle(), 51, near=(0.5, 0.5))
    return _traced(
        "trace-circle",
        "Arm traces a circle",
        _circle(),
        followed,
        "The joints follow one branch by continuity. The certificate says how far the arm stays from being straight or "
        "folded, where branches meet, and how large the largest joint step is.",
    )


def trace_lemniscate() -> Demo:
    """An arm draws a figure of eight through its own base."""
    curve = Lemniscate(1.0)
    followed = trace(Arm((1.0, 1.0)), curve, 201, at_singular="through")
    return _traced(
        "trace-lemniscate",
        "Arm traces a lemniscate through its base",
        curve,
        followed,
        "The curve runs through the base, where an arm of equal links is folded and the first joint is free. Passing "
        "through has to be asked for; the joints stay continuous, and the certificate names the places.",
    )


def _circle() -> Curve:
    return Circle(0.5, center=(1.0, 0.5))


def _iterations(report: Report) -> dict[str, Any]:
    names = ("iteration", "evaluations", "residual", "step", "damping", "taken", "q1", "q2")
    rows = [(n, e, residual, step, lam, int(taken), *x) for n, e, residual, step, lam, taken, x in report.rows]
    return dict(zip(names, zip(*rows, strict=True), strict=True))


def _search_scene(arm: Arm, report: Report, target: tuple[float, float]) -> Scene:
    joints = [arm.points(line.x) for line in report]
    scene = Scene(0.6 * np.arange(len(joints))).linkage(joints)
    return scene.moving_point([target] * len(joints))


def _certified(followed: Trace) -> str:
    proof, places = followed.certificate, len(followed.singular_points)
    through = f"passes {places} singular points; " if places else ""
    step = np.degrees(proof.largest_step)
    return f"{through}smallest |sin q2| {proof.smallest_sine or 0.0:.3f}, largest joint step {step:.1f} deg"


def _traced(name: str, title: str, curve: Curve, followed: Trace, story: str) -> Demo:
    q, phi = followed.q, followed.parameters
    tool = followed.arm.forward(q).position
    error = float(np.hypot(*(tool - curve.position(phi)).T).max())
    wanted = curve.position(np.linspace(*curve.interval, 400))

    def figure(canvas: Any) -> None:
        left, right = canvas.subplots(1, 2)
        plot_path(wanted, left, linewidth=1.4)
        for i in np.linspace(0, len(q) - 1, 7).astype(int)[:-1]:
            plot_linkage(followed.arm.points(q[i]), left, colours=("C0", "C2"), alpha=0.35)
        plane(left, "postures")
        plot_series(phi, {"q1": q[:, 0], "q2": q[:, 1]}, right, unit="joint [rad]", xlabel="curve parameter [rad]")
        right.set_title("joints, unwrapped")

    scene = Scene(phi).curve(wanted, dashed=True).linkage(followed.arm.points(q)).trail(tool)
    return Demo(
        name=name,
        title=title,
        headline=_certified(followed),
        check=f"forward kinematics of every row against the curve: {error:.0e} m",
        passed=bool(error < 1e-12 and not followed.failures),
        story=story,
        tables={"run.csv": {"phi": phi, "q1": q[:, 0], "q2": q[:, 1], "x": tool[:, 0], "y": tool[:, 1]}},
        figure=figure,
        scene=scene,
    )
