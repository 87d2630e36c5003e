"""Flight: a shot under heavy drag, and two ways to aim."""

from __future__ import annotations

from math import degrees, pi, tan
from typing import Any

import numpy as np

from coplanar.engine import evaluator
from coplanar.flight import Aim, Projectile, Shot
from coplanar.integrators import integrate_ode
from coplanar.laws import flight as laws
from coplanar.tour.demo import Demo
from coplanar.viz.axes import plane, plot_series
from coplanar.viz.flight import plot_envelope, plot_shot
from coplanar.viz.scene import Scene

_drag_rates = evaluator(laws.drag_rates)


def shot() -> Demo:
    """A fast launch under heavy drag, by the hodograph."""
    launch = Projectile(mass=1.0, drag=0.5).launch(velocity=(100.0, 100.0 * tan(pi / 3.0)))
    way = launch.sample(5.0, count=501)
    error = _against_ode(launch, way.time, way.position)
    apex = launch.apex()

    def figure(canvas: Any) -> None:
        left, right = canvas.subplots(1, 2, width_ratios=(1, 1.2))
        plane(left, "path").plot(way.x, way.y, color="C1")
        left.plot(apex.x, apex.y, "o", color="C3")
        left.annotate("apex", (apex.x, apex.y), textcoords="offset points", xytext=(6, 6))
        plot_series(way.time, {"vx": way.vx, "vy": way.vy}, right, unit="velocity [m/s]")

    position = way.position
    return Demo(
        name="shot",
        title="Projectile with quadratic drag",
        headline=f"200 m/s at 60 deg, yet the apex is {apex.y:.3f} m high, after {apex.time:.3f} s",
        check=f"DOP853 at 1e-12 on the equations of motion: {error:.0e} m",
        passed=bool(error < 1e-9),
        story="With C = 0.5 kg/m and 1 kg, drag takes nearly all of the speed within a tenth of a second; what is left "
        "falls at the terminal speed. The path comes from the hodograph: one quadrature, no differential equation.",
        tables={
            "run.csv": {"t": way.time, "x": position[:, 0], "y": position[:, 1], "vx": way.vx, "vy": way.vy}
        },
        figure=figure,
        scene=Scene(way.time[::4]).trail(position[::4]).moving_point(position[::4]),
    )  # fmt: skip


def aim_time() -> Demo:
    """Target and flight time given: the launch velocity."""
    aim = Projectile(mass=2.0, drag=0.05).aim((5.0, 10.0), time=2.0)
    vx, vy = aim.low.velocity
    time = np.linspace(0.0, 2.0, 201)
    error = float(np.hypot(*(_flown(aim.low.shot, time)[-1] - (5.0, 10.0))))

    def figure(canvas: Any) -> None:
        ax = plot_shot(aim.low.shot, 2.0, canvas.subplots(), color="C1")
        ax.plot(5.0, 10.0, "x", color="C3", markersize=9, markeredgewidth=2)
        ax.set_title("at the target after 2 s")

    return Demo(
        name="aim-time",
        title="Aiming: flight time given",
        headline=f"launch at ({vx:.6f}, {vy:.6f}) m/s",
        check=f"flown by DOP853 at 1e-12, it misses by {error:.0e} m",
        passed=bool(aim.hit and error < 1e-9),
        story="A target and a flight time fix the launch velocity, and only one will do. C = 0.05 kg/m, 2 kg, target "
        "(5, 10) m, 2 s.",
        tables={"run.csv": {"vx0": [vx], "vy0": [vy]}},
        figure=figure,
        scene=_flights(aim),
    )


def aim_speed() -> Demo:
    """Target and speed given: the low and the high arc."""
    ball, speed, target = Projectile(mass=1.0, drag=0.02), 30.0, (30.0, 2.0)
    aim = ball.aim(target, speed=speed)
    arcs = (aim.low, aim.high)
    ranges = [arc.shot.impact(level=target[1]).state.x for arc in arcs]
    ends = [_flown(arc.shot, np.linspace(0.0, arc.time, 201))[-1] for arc in arcs]
    error = float(max(np.hypot(*(end - target)) for end in ends))

    def figure(canvas: Any) -> None:
        ax = plot_envelope(ball, speed, canvas.subplots())
        for arc, name in zip(arcs, ("low", "high"), strict=True):
            plot_shot(arc.shot, arc.time, ax, label=f"{name} arc, {degrees(arc.angle):.1f} deg")
        ax.plot(*target, "x", color="C3", markersize=9, markeredgewidth=2)
        ax.set_ylim(bottom=-2.0)
        ax.legend()

    return Demo(
        name="aim-speed",
        title="Aiming: speed given",
        headline=f"{degrees(aim.low.angle):.3f} deg or {degrees(aim.high.angle):.3f} deg at {speed:.0f} m/s hit "
        f"({target[0]:.0f}, {target[1]:.0f}) m",
        check=f"both flown by DOP853 at 1e-12, the worse misses by {error:.0e} m",
        passed=bool(aim.hit and error < 1e-9 and aim.low.angle < aim.high.angle),
        story="At 30 m/s with k = 0.02 1/m, two launches pass through the target. Beyond the envelope none does, and "
        "the answer is the shortfall and the least speed that would do.",
        tables={"run.csv": {"angle": [arc.angle for arc in arcs], "range": ranges}},
        figure=figure,
        scene=_flights(aim),
    )


def _flown(launch: Shot, time: np.ndarray) -> np.ndarray:
    """Positions at times by an adaptive integration of the equations of motion, shape (n, 2) [m]."""
    ball = launch.projectile

    def rates(_: float, state: np.ndarray) -> np.ndarray:
        ax, ay = _drag_rates(state[2], state[3], ball.drag_per_mass, ball.gravity)
        return np.array([state[2], state[3], ax, ay])

    first = (*launch.start, *launch.velocity)
    tight = {"relative_tolerance": 1e-12, "absolute_tolerance": 1e-13}
    states = integrate_ode(rates, time, first, method="DOP853", **tight)
    return states[:, :2]


def _against_ode(launch: Shot, time: np.ndarray, position: np.ndarray) -> float:
    return float(np.hypot(*(_flown(launch, time) - position).T).max())


def _flights(aim: Aim) -> Scene:
    """Both arcs, each at its own pace; what has arrived waits at the target."""
    arcs = (aim.low,) if aim.low.angle == aim.high.angle else (aim.low, aim.high)
    scene = Scene(np.linspace(0.0, max(arc.time for arc in arcs), 121))
    for arc, role in zip(arcs, ("first", "second"), strict=False):
        way = arc.shot.at(np.minimum(scene.times, arc.time)).position
        scene = scene.trail(way, role=role).moving_point(way, role=role)
    return scene.curve(np.array([aim.target, aim.target]), role="target").moving_point([aim.target] * 121)
