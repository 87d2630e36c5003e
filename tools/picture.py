"""Draws ``docs/coplanar.svg``, the picture of the README: an arm, a robot and two shots."""

from __future__ import annotations

from pathlib import Path

from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from coplanar import Arm, Astroid, Lemniscate, PointTracker, Projectile, Unicycle, simulate, trace
from coplanar.viz.axes import plane, plot_headings, plot_linkage
from coplanar.viz.flight import plot_envelope, plot_shot
from coplanar.viz.style import drawn_in


def arm(ax):
    followed = trace(Arm((1.0, 1.0)), Lemniscate(1.0), 201, at_singular="through")
    tool = followed.arm.forward(followed.q).position
    ax.plot(*tool.T, color="C1")
    for i in (15, 35, 60, 140, 165, 185):
        plot_linkage(followed.arm.points(followed.q[i]), ax, colours=("C0", "C2"), alpha=0.45)
    ax.set_title("an arm, through its own base")


def robot(ax):
    tracker = PointTracker((0.05, 0.0), kp=40.0, feedforward=True)
    run = simulate(Unicycle(), tracker, Astroid(1.0).over(10.0), step=0.01, method="exact")
    point = run.poses @ (0.05, 0.0)
    plane(ax).plot(*point.T, color="C1")
    plot_headings(run.poses.as_array(), ax, count=24, length=0.07, colour="C0")
    ax.set_title("a point of a robot, on an astroid")


def shots(ax):
    ball = Projectile(mass=1.0, drag=0.02)
    plot_envelope(ball, 30.0, ax, lowest=-0.05)
    for x, y in ((30.0, 2.0), (22.0, 9.0), (12.0, 14.0)):
        aim = ball.aim((x, y), speed=30.0)
        for arc, colour in ((aim.low, "C0"), (aim.high, "C1")):
            plot_shot(arc.shot, arc.time, ax, color=colour)
        ax.plot(x, y, "x", color="C3", markersize=8, markeredgewidth=2)
    ax.set_title("low and high arcs under drag")


def main():
    with drawn_in("light"):
        figure = Figure(figsize=(12.0, 4.0))
        FigureCanvasSVG(figure)
        for ax, draw in zip(figure.subplots(1, 3), (arm, robot, shots), strict=True):
            draw(ax)
        figure.savefig(Path(__file__).parents[1] / "docs" / "coplanar.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
