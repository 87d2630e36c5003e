"""Frames and arms: where they are, how they get there, what they draw."""

from __future__ import annotations

from typing import Any

import numpy as np

from coplanar.scenarios import Outcome
from coplanar.scenarios.kinds.arm_pose import names_of
from coplanar.viz.axes import plane, plot_linkage, plot_path, plot_series
from coplanar.viz.scene import Scene

SMALLEST = 1e-17  # [m] a residual on a logarithmic axis


def draw_frames(outcome: Outcome, canvas: Any) -> None:
    """The axes of every frame in the world, and the points."""
    tree, points, ax = outcome.things["tree"], outcome.things["points"], plane(canvas.subplots(), "frames in the world")
    places = [tree.pose(name, tree.root) for name in tree.names]
    spots = tree.convert(points, from_=outcome.scenario.seen_in, to=tree.root)
    spread = np.ptp(np.vstack([*(place.position for place in places), spots]), axis=0).max()
    length = 0.18 * max(float(spread), 0.5)
    for name, place in zip(tree.names, places, strict=True):
        for tip, colour in (((length, 0.0), "C0"), ((0.0, length), "C1")):
            end = place @ tip
            ax.plot(*zip(place.position, end, strict=True), alpha=0.0)  # an arrow alone does not widen the axes
            ax.annotate("", end, place.position, arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.8})
        ax.annotate(name, place.position, textcoords="offset points", xytext=(5, -13))
    ax.plot(spots[:, 0], spots[:, 1], "o", color="C3")
    ax.margins(0.2)


def draw_pose(outcome: Outcome, canvas: Any) -> None:
    """The arm with its points named."""
    points = outcome.things["points"]
    ax = plot_linkage(points, canvas.subplots(), colours=("C0", "C2"))
    for name, (x, y) in zip(names_of(len(points), outcome.things["arm"].n), points, strict=True):
        ax.annotate(name, (x, y), textcoords="offset points", xytext=(8, -12))
    links = " and ".join(f"{length:g} m" for length in outcome.things["arm"].links)
    ax.set_title(f"links {links}, q = ({', '.join(f'{q:g}' for q in outcome.things['q'])})")


def draw_reach(outcome: Outcome, canvas: Any) -> None:
    """Every answer, and the search beside them where there is one."""
    arm, answer, search = (outcome.things[name] for name in ("arm", "solution", "search"))
    report = answer.report if search is None else search.report
    axes: Any = canvas.subplots(1, 2) if len(report) else (canvas.subplots(),)
    for place, q in enumerate(answer.branches):
        plot_linkage(arm.points(q), axes[0], colours=(f"C{place}",))
    axes[0].plot(*answer.target, "x", color="C3", markersize=9, markeredgewidth=2, zorder=5)
    axes[0].set_title("both elbows" if len(answer.branches) == 2 else "the nearest posture")
    if not answer.reached:
        axes[0].plot(*zip(answer.nearest, answer.target, strict=True), "--", color="C3", linewidth=1.2)
        axes[0].set_title(f"short by {answer.gap:.3g} m")
    if len(report):
        axes[1].semilogy(range(len(report)), np.maximum([line.residual for line in report], SMALLEST), "o-")
        start = ", ".join(f"{q:g}" for q in report[0].x)
        axes[1].set_title(f"search from ({start})")
        axes[1].set_xlabel("iteration")
        axes[1].set_ylabel("distance to the target [m]")


def reach_scene(outcome: Outcome) -> Scene | None:
    """The arm during the search; None where there was none."""
    arm, answer, search = (outcome.things[name] for name in ("arm", "solution", "search"))
    report = answer.report if search is None else search.report
    if len(report) < 2:
        return None
    joints = [arm.points(line.x) for line in report]
    scene = Scene(0.6 * np.arange(len(joints))).linkage(joints)
    return scene.moving_point([answer.target] * len(joints))


def draw_trace(outcome: Outcome, canvas: Any) -> None:
    """The curve, some postures, and the joints over the parameter."""
    followed = outcome.things["trace"]
    q, phi = followed.q, followed.parameters
    left, right = canvas.subplots(1, 2)
    plot_path(_wanted(outcome), left, linewidth=1.4)
    for i in np.linspace(0, len(q) - 1, 7).astype(int)[:-1]:
        plot_linkage(followed.arm.points(q[i]), left, colours=("C0", "C2"), alpha=0.35)
    plane(left, "postures")
    joints = {f"q{i + 1}": q[:, i] for i in range(q.shape[1])}
    plot_series(phi, joints, right, unit="joint [rad]", xlabel="curve parameter")
    for failure in followed.failures:
        right.axvspan(failure.first, failure.last, color="C3", alpha=0.15, linewidth=0)
    right.set_title("joints, unwrapped")


def trace_scene(outcome: Outcome) -> Scene:
    """The arm on its way along the curve."""
    followed, run = outcome.things["trace"], outcome.run
    times = followed.parameters if run is None else run.t
    tool = followed.arm.forward(followed.q).position
    scene = Scene(times).curve(_wanted(outcome), dashed=True)
    return scene.linkage(followed.arm.points(followed.q)).trail(tool)


def _wanted(outcome: Outcome) -> Any:
    curve = outcome.things["curve"]
    return curve.position(curve.parameters(400))
