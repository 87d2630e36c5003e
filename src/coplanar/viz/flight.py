"""Shots: their paths, both arcs of an aim, the limit of what a speed reaches, how far a target is beyond it."""

from __future__ import annotations

import textwrap
from math import degrees, isfinite, pi
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import Real
from coplanar.errors import InvalidValue
from coplanar.flight import Aim, Arc, Projectile, Shot
from coplanar.viz.axes import plot_series
from coplanar.viz.paper import Axes, Paper

POINTS = 161  # of the line of a shot


def plot_shot(shot: Shot, duration: Real, ax: Axes | None = None, *, count: int = POINTS, **line: Any) -> Axes:
    """The path of a shot up to a time; of a batch every member.

    Args:
        shot: One shot or many.
        duration: [s].
        ax: Where to draw; a new figure if None.
        count: Points of the line.
        **line: Passed to Matplotlib's ``plot``.
    """
    paper = Paper.plane(ax)
    way = np.moveaxis(shot.sample(duration, count=count).position, 0, -2)
    paper.lines(way.reshape(-1, count, 2), **line)
    return paper.ax


def plot_shots(
    shots: Aim | Shot,
    ax: Axes | None = None,
    *,
    envelope: bool = True,
    duration: Real | None = None,
    level: float = 0.0,
) -> Axes:
    """Shots until they land; or an aim: every arc to its target, the envelope of its speed, what is short by how much.

    Out of reach, the shot that comes farthest is drawn, the gap to the target, and the launch of least speed that
    would do.

    Args:
        shots: The answer of ``Projectile.aim``, or shots; of a batch every member.
        ax: Where to draw; a new figure if None.
        envelope: Of an aim at a given speed: whether the limit of that speed is drawn.
        duration: Of shots: how long they fly [s]; until they come down through ``level`` if None.
        level: Height at which shots land [m].

    Raises:
        InvalidValue: If a shot never comes down to the level and no duration is given.

    Example:
        >>> ball = Projectile(mass=1.0, drag=0.02)
        >>> ax = plot_shots(ball.aim((30.0, 2.0), speed=30.0))
        >>> [line.get_label() for line in ax.lines][:2]
        ['low arc, 19.7 deg', 'high arc, 64.9 deg']
    """
    paper = Paper.plane(ax)
    if isinstance(shots, Shot):
        return _landed(paper, shots, duration, level)
    rows = _rows(shots)
    for row in rows:
        _aimed(paper, row, envelope=envelope, named=len(rows) == 1)
    paper.cross(shots.target, label="target")
    paper.dots(shots.start, "ink", size=4.5)
    if len(rows) == 1 and not shots.hit:
        paper.title(textwrap.fill(shots.status.value, 62))
    paper.legend()
    return paper.ax


def plot_envelope(
    projectile: Projectile, speed: float, ax: Axes | None = None, *, lowest: float = -0.6,
    start: tuple[float, float] = (0.0, 0.0), side: float = 1.0,
) -> Axes:  # fmt: skip
    """The limit of what a speed reaches; targets beyond it are out of reach.

    Args:
        projectile: What flies.
        speed: [m/s].
        ax: Where to draw; a new figure if None.
        lowest: Direction from which the limit is drawn, up to straight up [rad].
        start: Launch point [m].
        side: 1 draws it to the right, -1 to the left.
    """
    paper = Paper.plane(ax)
    points = projectile.envelope(speed, np.linspace(lowest, 0.5 * pi, 91))
    paper.line(points * (side, 1.0) + start, "reference", linestyle=(0, (5, 3)), linewidth=1.3, label="envelope")
    return paper.ax


def plot_flight(shot: Shot, duration: Real, ax: Axes | None = None, *, quantity: str = "velocity") -> Axes:
    """Both components of a shot's position or velocity against time.

    Args:
        shot: One shot or many.
        duration: [s].
        ax: Where to draw; a new figure if None.
        quantity: "position" or "velocity".
    """
    time = np.linspace(0.0, float(np.max(duration)), POINTS)
    states = shot.at(time.reshape(-1, *(1,) * np.ndim(shot.speed)))
    if checks.choice("quantity", quantity, ("position", "velocity")) == "position":
        return plot_series(time, {"x": states.x, "y": states.y}, ax, unit="position [m]")
    return plot_series(time, {"vx": states.vx, "vy": states.vy}, ax, unit="velocity [m/s]")


def _landed(paper: Paper, shots: Shot, duration: Real | None, level: float) -> Axes:
    if duration is None:
        impact = shots.impact(level=level)
        if not np.all(impact.reached):
            raise InvalidValue("duration", None, "a duration, as not every shot lands", "give one, or another level")
        duration = impact.time
    one = np.ndim(shots.speed) == 0
    plot_shot(shots, duration, paper.ax, color="trail" if one else None)
    ends = shots.at(duration)
    paper.dots(ends.position, "target", size=5)
    if one:
        apex = shots.apex()
        paper.dots(apex.position, "third", size=5)
        paper.text(f"apex {apex.y:.4g} m, {apex.time:.3g} s", apex.position, "third", offset=(0.0, 11.0))
    return paper.ax


def _rows(aim: Aim) -> list[Aim]:
    """The answers of a batch, one by one."""
    if np.ndim(aim.code) == 0:
        return [aim]
    shape = np.shape(aim.code)
    parts = (aim.projectile.mass, aim.projectile.drag, aim.projectile.gravity)
    projectiles = [np.broadcast_to(part, shape).ravel() for part in parts]
    tables = [np.ravel(aim.code), aim.start.reshape(-1, 2), aim.target.reshape(-1, 2)]
    ends = [np.ravel(aim.furthest), np.ravel(aim.shortfall)]
    arcs = [_arcs(arc, shape) for arc in (aim.low, aim.high)]
    return [
        Aim(Projectile(*map(float, body)), start, target, int(code), low, high, float(far), float(short))
        for body, code, start, target, far, short, low, high in zip(
            zip(*projectiles, strict=True), *tables, *ends, *arcs, strict=True
        )
    ]


def _arcs(arc: Arc, shape: tuple[int, ...]) -> list[Arc]:
    shot = arc.shot
    columns = [np.broadcast_to(part, shape).ravel().tolist() for part in (shot.x, shot.y, shot.vx, shot.vy, arc.time)]
    return [Arc(Shot._of(shot.projectile, *map(float, row[:4])), float(row[4])) for row in zip(*columns, strict=True)]


def _aimed(paper: Paper, aim: Aim, *, envelope: bool, named: bool) -> None:
    arcs = _named_arcs(aim)
    for (name, arc), colour in zip(arcs, ("first", "second"), strict=False):
        label = f"{name}, {degrees(arc.angle):.1f} deg" if named else "_"
        shot = aim.projectile.launch(velocity=arc.velocity, start=aim.start)
        plot_shot(shot, arc.time, paper.ax, color=colour, label=label)
    if named and envelope:
        _limit(paper, aim, len(arcs))
    if aim.shortfall > 0.0 and arcs:
        _short(paper, aim, named=named)


def _named_arcs(aim: Aim) -> list[tuple[str, Arc]]:
    """The launches that there are, with what they are called."""
    if aim.shortfall > 0.0:
        arcs = [("farthest shot", aim.low)]
    elif np.array_equal(aim.low.velocity, aim.high.velocity):
        arcs = [("launch", aim.low)]
    else:
        arcs = [("low arc", aim.low), ("high arc", aim.high)]
    return [(name, arc) for name, arc in arcs if isfinite(arc.time)]


def _limit(paper: Paper, aim: Aim, arcs: int) -> None:
    """The envelope of the speed that was given, if one was: there are two arcs, or the target is beyond it."""
    limited = arcs == 2 or (arcs == 1 and aim.shortfall > 0.0 and isfinite(aim.furthest))
    if not limited or float(aim.projectile.gravity) == 0.0:
        return
    across, rise = (aim.target - aim.start).tolist()
    lowest = min(-0.1, float(np.arctan2(rise, abs(across))) - 0.1)
    start, side = (float(aim.start[0]), float(aim.start[1])), -1.0 if across < 0.0 else 1.0
    plot_envelope(aim.projectile, aim.low.speed, paper.ax, lowest=max(lowest, -1.5), start=start, side=side)


def _short(paper: Paper, aim: Aim, *, named: bool) -> None:
    """The gap to a target out of reach, and the least speed that would do."""
    way = aim.target - aim.start
    end = aim.start + way * (aim.furthest / float(np.hypot(*way)))
    paper.line(np.array([end, aim.target]), "target", linestyle=(0, (4, 3)), linewidth=1.5)
    paper.dots(end, "target", size=5)
    if not named:
        return
    paper.text(f"short by {aim.shortfall:.4g} m", 0.5 * (end + aim.target), "target", offset=(0.0, 11.0))
    least = aim.least()
    if least.hit:
        launch = aim.projectile.launch(velocity=least.low.velocity, start=aim.start)
        words = f"least speed, {least.low.speed:.4g} m/s"
        plot_shot(launch, least.low.time, paper.ax, color="third", linestyle=":", label=words)
