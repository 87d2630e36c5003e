"""Wheels: what a base looks like from above, what it cannot do, what it turns about; a wheel that rolls."""

from __future__ import annotations

import textwrap

import numpy as np

from coplanar.se2 import Pose, Twist
from coplanar.viz.axes import disc
from coplanar.viz.paper import Axes, Paper
from coplanar.wheels import Icr, RollingWheel, Wheel, WheeledBase

BREADTH = 0.42  # width of a drawn wheel over its diameter
TURNS = 1e-6  # of the speed: a slower turn is drawn as a translation


def plot_base(base: WheeledBase, ax: Axes | None = None, *, cannot: bool = True, drives: bool = True) -> Axes:
    """A base from above in its own frame: wheels, rollers, drive directions; what it cannot do is crossed.

    The lines across a wheel are the axles of the rollers that touch the ground.

    Args:
        base: Any layout.
        ax: Where to draw; a new figure if None.
        cannot: Whether the motions that it cannot be driven along are drawn, crossed, with the sentences as title.
        drives: Whether an arrow shows where each wheel drives at a positive rate.

    Example:
        >>> ax = plot_base(WheeledBase.differential(track=0.5, radius=0.1))
        >>> ax.get_title(loc="left")
        'cannot move sideways: left and right would slide'
    """
    paper = Paper.plane(ax)
    reach = _reach(base)
    places = np.array([(w.x, w.y) for w in base.wheels])
    around = places[np.argsort(np.arctan2(*(places - places.mean(axis=0)).T[::-1]))]
    if len(places) > 2:
        paper.region(around, colour="body", alpha=0.08)
    elif len(places) == 2:
        paper.line(places, "muted", linewidth=3.0, zorder=0.9)
    paper.arrow((0.0, 0.0), (0.62 * reach, 0.0), "ink", width=1.4)
    paper.dots((0.0, 0.0), "ink", size=4)
    for number, wheel in enumerate(base.wheels, 1):
        _wheel(paper, wheel, str(number))
        if drives:
            _drive(paper, wheel)
    if cannot and base.cannot:
        paper.title(textwrap.fill("; ".join(base.cannot), 64))
        for twist in _missing(base):
            _crossed(paper, twist, reach)
    paper.ax.margins(0.25)
    return paper.ax


def plot_icr(base: WheeledBase, twist: Twist, ax: Axes | None = None) -> Axes:
    """What a base turns about: the instantaneous centre, a line to it from every wheel, and the wheels' velocities.

    Without sliding the axle of every ordinary wheel lies on its line.

    Args:
        base: Any layout.
        twist: One motion, seen from the body.
        ax: Where to draw; a new figure if None.
    """
    paper = Paper.plane(ax)
    plot_base(base, paper.ax, cannot=False, drives=False)
    centre = Icr(twist)
    speeds = {w.name: Pose(w.x, w.y, 0.0).inverse().transform(twist) for w in base.wheels}
    fastest = max(float(np.hypot(v.vx, v.vy)) for v in speeds.values())
    scale = 0.6 * _reach(base) / fastest if fastest > 0.0 else 0.0
    for wheel in base.wheels:
        here, v = np.array([wheel.x, wheel.y]), speeds[wheel.name]
        if centre.exists:
            paper.line(np.array([here, centre.body]), "muted", linewidth=1.0, linestyle=(0, (4, 3)))
        paper.arrow(here, here + scale * np.array([v.vx, v.vy]), "trail")
    if centre.exists:
        paper.dots(centre.body, "target", size=8, hollow=True)
        outwards = centre.body / max(float(np.hypot(*centre.body)), 1e-12)
        paper.text(
            f"ICR, R = {centre.radius:.3g} m", centre.body, "target", offset=(14.0 * outwards[0], 14.0 * outwards[1])
        )
    else:
        paper.title(textwrap.fill(centre.status.value, 64))
    paper.ax.margins(0.12)
    return paper.ax


def plot_rolling(
    wheel: RollingWheel, rate: float, ax: Axes | None = None, *, slip: float = 0.0, count: int = 12
) -> Axes:
    """A wheel on the road from the side: velocities of its rim, its centre and its contact; the path of a rim point.

    Args:
        wheel: One wheel.
        rate: Of turning, clockwise [rad/s].
        ax: Where to draw; a new figure if None.
        slip: Velocity of the contact along the road [m/s].
        count: How many rim points have an arrow.
    """
    paper = Paper.plane(ax)
    r = float(wheel.radius)
    beta = 2.0 * np.pi * np.arange(count) / count
    points, velocities = wheel.rim_position(beta), wheel.rim_velocity(rate, beta, slip=slip)
    top, middle = wheel.top_velocity(rate, slip=slip), wheel.centre_speed(rate, slip=slip)
    fastest = float(np.hypot(*np.vstack([velocities, top]).T).max())
    scale = 1.4 * r / fastest if fastest > 0.0 else 0.0
    path = wheel.rim_path(np.linspace(-0.55 * np.pi, 1.2 * np.pi, 121))
    paper.line(path, "trail", linewidth=1.1, linestyle="--", label="path of a rim point")
    paper.line([(-2.2 * r, 0.0), (4.4 * r, 0.0)], "muted", linewidth=1.2)
    paper.region(disc(r, 73) + np.array([0.0, r]), colour="body", alpha=0.1, edge=1.8)
    for point, velocity in zip(points, velocities, strict=True):
        if float(np.hypot(*velocity)) * scale > 0.02 * r:
            paper.arrow(point, point + scale * velocity, "first", width=1.3, head=9.0)
    paper.arrow((0.0, r), (scale * middle, r), "third")
    paper.dots([(0.0, r)], "third", size=4)
    paper.dots([(0.0, 0.0)], "target", size=6)
    spare = float(np.hypot(*wheel.contact_velocity(rate, slip=slip)))
    paper.text(f"centre {middle:.3g} m/s", (0.0, r), "third", offset=(0.0, -11.0))
    paper.text(f"contact {spare:.3g} m/s", (0.0, 0.0), "target", offset=(0.0, -24.0))
    paper.text(f"top {np.hypot(*top):.3g} m/s", (scale * top[0], 2.0 * r), "first", offset=(6.0, 6.0), align="left")
    paper.legend(loc="upper right")
    return paper.ax


def _reach(base: WheeledBase) -> float:
    return max(max(float(np.hypot(w.x, w.y)) for w in base.wheels), 2.0 * float(base.radii.max()))


def _drive(paper: Paper, wheel: Wheel) -> None:
    rim = Pose(wheel.x, wheel.y, wheel.drive_angle) @ np.array([(wheel.radius, 0.0), (1.75 * wheel.radius, 0.0)])
    paper.arrow(rim[0], rim[1], "first", width=1.4, head=9.0)


def _wheel(paper: Paper, wheel: Wheel, name: str) -> None:
    r, width = wheel.radius, BREADTH * wheel.radius
    stands = Pose(wheel.x, wheel.y, wheel.drive_angle)
    corners = stands @ np.array([(r, width), (-r, width), (-r, -width), (r, -width)])
    paper.region(corners, colour="first", alpha=0.85 if wheel.is_ordinary else 0.3, edge=1.4)
    if wheel.roller_angle is not None:
        axle = 0.9 * width * np.array([np.cos(wheel.roller_angle), np.sin(wheel.roller_angle)])
        for along in (-0.6, -0.2, 0.2, 0.6):
            line = stands @ (np.array([along * r, 0.0]) + np.array([-axle, axle]))
            paper.line(line, "second", linewidth=1.6, zorder=3)
    paper.text(name, stands @ np.array([-1.35 * r, 0.0]), size=9)


def _missing(base: WheeledBase) -> list[Twist]:
    """The motions across all that the base can be driven along, with omega counted as the speed L omega."""
    length = base.mobility.length
    units = [Twist(1.0, 0.0, 0.0), Twist(0.0, 1.0, 0.0), Twist(0.0, 0.0, 1.0 / length if length else 1.0)]
    rows = np.array([base.feasible(unit).infeasible.as_array() for unit in units]) * (1.0, 1.0, length)
    _, sizes, across = np.linalg.svd(rows)
    kept = across[sizes > 0.5] / (1.0, 1.0, length if length else 1.0)
    return [Twist(*row) for row in kept]


def _crossed(paper: Paper, twist: Twist, reach: float) -> None:
    """A motion that is not possible: the way of the body's origin, or about the centre, with a cross on it."""
    speed = float(np.hypot(twist.vx, twist.vy))
    if abs(twist.omega) * reach <= TURNS * speed:
        way = 1.15 * reach * np.array([twist.vx, twist.vy]) / speed
        aside = 0.25 * np.array([abs(way[1]), abs(way[0]) if way[0] else 0.0])
        paper.arrow(aside - 0.35 * way, aside + 0.65 * way, "target", width=2.2)
        paper.cross(aside + 0.1 * way, "target", size=12)
        return
    centre = Icr(twist).body
    size = max(float(np.hypot(*centre)), 0.45 * reach)
    toward = np.arctan2(-centre[1], -centre[0]) if np.hypot(*centre) > TURNS * reach else 0.5 * np.pi
    turn = toward + np.sign(twist.omega) * np.linspace(-0.6, 0.6, 41)
    arc = centre + size * np.column_stack([np.cos(turn), np.sin(turn)])
    paper.line(arc[:-3], "target", linewidth=2.2)
    paper.arrow(arc[-4], arc[-1], "target", width=2.2)
    paper.cross(arc[20], "target", size=12)
