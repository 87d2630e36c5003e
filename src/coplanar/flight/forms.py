"""The four forms of aiming, row by row in the launch's own frame: the target at (x, y), x >= 0.

Each answers with the velocities of a low and a high arc (the same where there is one), the flight times and a code.
Velocities are NaN where there is no launch. All rows are arrays of one shape.
"""

from __future__ import annotations

from enum import Enum
from math import exp, hypot
from typing import Any, NamedTuple

import numpy as np

from coplanar.engine import evaluator
from coplanar.flight.arcs import arcs, time_to
from coplanar.flight.path import Path, at_time, by_launch, crossing
from coplanar.flight.sight import LOG_FASTEST, Sight
from coplanar.laws import flight as laws
from coplanar.solving import code_of

Row = Any

_climb_height = evaluator(laws.climb_height)
_climb_speed = evaluator(laws.climb_speed)
_climb_time = evaluator(laws.climb_time)
_first_climb = evaluator(laws.first_climb)
_launch_speed_of_mean = evaluator(laws.launch_speed_of_mean)
_speed_at_height = evaluator(laws.speed_at_height)
_straight_time = evaluator(laws.straight_time)

UPRIGHT = 1e-9  # cosine of a line of sight that counts as vertical: the shot is a straight one, leaning by first order
ALONG = 1e-12  # [rad] between a launch and the line of sight that counts as along it, where only along it will do
ROUNDS = 60  # of Newton for the flight time; it takes about six
MOST_HOLD = 115.0  # k times mean speed times time: beyond, the speed of launch is about 1e50 times the mean speed


class AimStatus(Enum):
    """What an aim found."""

    HIT = "the launch sends the projectile through the target"
    OUT_OF_REACH = "out of reach at this speed: the launch goes as far as it can towards the target"
    OFF_THE_LINE = "no speed reaches the target at this angle: it is not below the line of the launch"
    TOO_FAST = "the target takes a speed of more than about 1e50 m/s"
    ANY_SPEED = "every speed reaches the target: there is no single or least one"
    NOT_FOUND = "the search stopped before it came to the target"


HIT, OUT_OF_REACH, OFF_THE_LINE, TOO_FAST, ANY_SPEED, NOT_FOUND = map(code_of, AimStatus)


class Way(NamedTuple):
    """A target ahead [m], drag per mass k [1/m], gravity g [m/s^2]: arrays of one shape."""

    x: np.ndarray
    y: np.ndarray
    drag_per_mass: np.ndarray
    gravity: np.ndarray

    @property
    def distance(self) -> np.ndarray:
        """Straight distance to the target [m]."""
        return np.asarray(np.hypot(self.x, self.y))

    @property
    def upright(self) -> np.ndarray:
        """Where the target is straight above or below."""
        return np.asarray(self.x <= UPRIGHT * self.distance)

    @property
    def weightless(self) -> np.ndarray:
        """Where there is no gravity."""
        return np.asarray(self.gravity <= 0.0)

    def ordinary(self) -> tuple[Sight, np.ndarray]:
        """The line of sight and its length, with a harmless one where it is upright or there is no gravity."""
        special = self.upright | self.weightless
        x, y = np.where(special, 1.0, self.x), np.where(special, 0.0, self.y)
        k, g = np.where(special, 0.0, self.drag_per_mass), np.where(special, 1.0, self.gravity)
        length = np.hypot(x, y)
        return Sight(x / length, y / length, k, g), length


class Answer(NamedTuple):
    """Velocities and flight times of the low and the high arc, the code, and how far the launch can go [m]."""

    low: tuple[Row, Row, Row]
    high: tuple[Row, Row, Row]
    code: np.ndarray
    furthest: Row


def by_time(way: Way, time: np.ndarray) -> Answer:
    """The velocity that is at the target after a time: Newton in the mean velocity w, v0 = w (exp(k w T) - 1)/(k w T).

    In w the answer is exact without gravity and without drag, so that the exponential growth of the speed with k d is
    taken out and the drag-free answer, with the fall that drag allows, is near enough for every k.
    """
    x, y, k, g = way
    wx, wy = _first_climb(x, y, time, k, g)
    scale = g * time + way.distance / time
    floor = 1e-15 * scale  # let go: the slowest launch that still has a direction, and that is down
    settled, lost = np.zeros(x.shape, bool), np.zeros(x.shape, bool)
    for _ in range(ROUNDS):
        path, grown, mean, lost = _of_mean(wx, wy, time, floor, way)
        state = at_time(path, time)
        x_v, y_v, x_psi, y_psi = by_launch(path, state)
        along, across = _solve(x_v * grown, x_psi / mean, y_v * grown, y_psi / mean, x - state.x, y - state.y)
        size = np.hypot(along, across)
        with np.errstate(all="ignore"):
            part = np.minimum(1.0, (mean + scale) / size)
        moves = ~(settled | lost)
        wx = np.where(moves, wx + part * (along * path.cosine - across * path.sine), wx)
        wy = np.where(moves, wy + part * (along * path.sine + across * path.cosine), wy)
        settled = settled | (size <= 1e-9 * mean + 1e-14 * scale)
        if (settled | lost).all():
            break
    path, _, _, lost = _of_mean(wx, wy, time, floor, way)
    code = np.where(lost, TOO_FAST, np.where(settled, HIT, NOT_FOUND))
    shot = _kept(code <= HIT, path.speed * path.cosine, path.speed * path.sine, time)
    return Answer(shot, shot, code, np.inf)


def by_speed(way: Way, speed: np.ndarray) -> Answer:
    """The low and the high launch at a speed; the one that goes farthest, twice, where the target is out of reach."""
    sight, length = way.ordinary()
    found = arcs(sight, length, speed)
    low, high = ((speed * np.sin(z), speed * np.cos(z), t) for z, t in (found[:2], found[2:4]))
    far = length > found.most
    code = np.where(found.lost, NOT_FOUND, np.where(far, OUT_OF_REACH, HIT))
    both, furthest = [low, high], found.most
    for special, instead in ((way.upright, _upright_by_speed), (way.weightless, _straight_by_speed)):
        if special.any():
            other = instead(way, speed)
            both = [_merged(special, one, arc) for one, arc in zip(other[:2], both, strict=True)]
            code, furthest = np.where(special, other.code, code), np.where(special, other.furthest, furthest)
    return Answer(both[0], both[1], code, furthest)


def one_by_speed(x: float, y: float, k: float, g: float, speed: float) -> tuple[Any, Any, int, float] | None:
    """Angle and time of both arcs, the code and the limit for one row of floats; None where the shot is straight."""
    length = hypot(x, y)
    if not (g > 0.0 and x > UPRIGHT * length):
        return None
    found = arcs(Sight(x / length, y / length, k, g), length, speed)
    code = NOT_FOUND if found.lost else OUT_OF_REACH if length > found.most else HIT
    return found[:2], found[2:4], code, found.most


def by_angle(way: Way, cosine: np.ndarray, sine: np.ndarray) -> Answer:
    """The speed at an angle (cosine, sine): there is one if the target is below the line of the launch."""
    sight, length = way.ordinary()
    zenith = np.arctan2(cosine, sine)
    below = (zenith > ALONG) & (zenith < sight.zenith)
    speed = sight.speed_for(length, np.where(below, zenith, 0.5 * sight.zenith))
    arc, lost = _launched(sight, length, speed, np.where(below, zenith, 0.5 * sight.zenith))
    code = np.where(below, _found(speed, lost), OFF_THE_LINE)
    along = (np.abs(way.x * sine - way.y * cosine) <= ALONG * way.distance) & (way.x * cosine + way.y * sine > 0.0)
    drops = way.upright & (np.abs(cosine) <= ALONG) & (way.y < 0.0) & ~way.weightless
    code = np.where(way.upright | way.weightless, OFF_THE_LINE, code)
    code = np.where((along & way.weightless) | drops, ANY_SPEED, code)
    climbs = along & way.upright & ~way.weightless & (way.y > 0.0)
    return _climbing(way, climbs, arc, code)


def by_least(way: Way) -> Answer:
    """The least speed of all and its angle; there is none where the target is straight below, or without gravity."""
    sight, length = way.ordinary()
    speed, zenith = sight.least(length)
    arc, lost = _launched(sight, length, speed, zenith)
    code = _found(speed, lost)
    code = np.where(way.weightless | (way.upright & (way.y <= 0.0)), ANY_SPEED, code)
    return _climbing(way, way.upright & (way.y > 0.0) & ~way.weightless, arc, code)


def _climbing(way: Way, climbs: np.ndarray, arc: tuple[Row, Row, Row], code: Row) -> Answer:
    """The answer with the least launch straight up in the rows that climb."""
    if climbs.any():
        climb = _climb(way)
        arc, code = _merged(climbs, climb, arc), np.where(climbs, _found(climb[1], False), code)
    arc = _kept(code == HIT, *arc)
    return Answer(arc, arc, code, np.inf)


def _of_mean(wx: Row, wy: Row, time: Row, floor: Row, way: Way) -> tuple[Path, Row, Row, np.ndarray]:
    """The launch whose mean velocity against drag alone is w; where it is too fast to be a number, a slower one."""
    length = np.hypot(wx, wy)
    mean, still = np.maximum(length, floor), length < floor
    cosine, sine = np.where(still, 0.0, wx / mean), np.where(still, -1.0, wy / mean)
    hold = way.drag_per_mass * mean * time
    lost = ~(hold <= MOST_HOLD)
    v, grown = _launch_speed_of_mean(np.where(lost, mean * MOST_HOLD / np.where(lost, hold, 1.0), mean), time, way[2])
    return Path(v, cosine, sine, way.drag_per_mass, way.gravity), grown, mean, lost


def _solve(a: Row, b: Row, c: Row, d: Row, e: Row, f: Row) -> tuple[Row, Row]:
    """The solution of a p + b q = e, c p + d q = f."""
    with np.errstate(all="ignore"):
        det = a * d - b * c
        return (d * e - b * f) / det, (a * f - c * e) / det


def _found(speed: Row, lost: Row) -> Row:
    return np.where(speed < exp(LOG_FASTEST), np.where(lost, NOT_FOUND, HIT), TOO_FAST)


def _launched(sight: Sight, length: Row, speed: Row, zenith: Row) -> tuple[tuple[Row, Row, Row], Row]:
    """The velocity and flight time of a launch to the end of the line of sight, and whether it misses that."""
    time, lost = time_to(sight, length, np.where(np.isfinite(speed), speed, 1.0), zenith)
    return (speed * np.sin(zenith), speed * np.cos(zenith), time), lost


def _straight_by_speed(way: Way, speed: Row) -> Answer:
    time = _straight_time(way.distance, speed, way.drag_per_mass)
    shot = (speed * way.x / way.distance, speed * way.y / way.distance, time)
    code = np.where(np.isfinite(time), HIT, OUT_OF_REACH)
    return Answer(shot, shot, code, np.where(np.isfinite(time), np.inf, 0.0))


def _upright_by_speed(way: Way, speed: Row) -> Answer:
    """Straight up: the target is passed on the way up, and again on the way down. Straight down: by both ways."""
    k, g = way.drag_per_mass, np.where(way.weightless, 1.0, way.gravity)
    up = way.y > 0.0
    most = np.where(up, _climb_height(speed, k, g), np.inf)
    far = way.y > most
    height = np.minimum(np.where(up, way.y, 1.0), np.where(up, most, 1.0))
    rise = _climb_time(speed, _speed_at_height(speed, height, k, g), k, g)
    down, _ = crossing(Path(speed, 0.0, -1.0, k, g), 1.0, 0.0, np.where(up, 1.0, -way.y))
    back, _ = crossing(Path(speed, 0.0, 1.0, k, g), 1.0, 0.0, -np.minimum(way.y, most))
    nearer = way._replace(x=np.where(far, way.x * (most / np.where(far, way.y, 1.0)), way.x))
    low = _leaning(nearer, np.where(up, speed, -speed), np.where(up, rise, down.time))
    high = _leaning(nearer, speed + 0.0 * way.y, np.where(far, rise, back.time))
    return Answer(low, high, np.where(far, OUT_OF_REACH, HIT), most)


def _climb(way: Way) -> tuple[Row, Row, Row]:
    """The least launch straight up to the target: it arrives at rest."""
    g = np.where(way.weightless, 1.0, way.gravity)
    speed = _climb_speed(np.maximum(way.y, 0.0), way.drag_per_mass, g)
    return _leaning(way, speed, _climb_time(speed, 0.0 * speed, way.drag_per_mass, g))


def _leaning(way: Way, upwards: Row, time: Row) -> tuple[Row, Row, Row]:
    """A straight shot made to lean so that it is at the target's x in time: there x is linear in the lean."""
    path = Path(np.abs(upwards), UPRIGHT, np.sign(upwards), way.drag_per_mass, way.gravity)
    across = at_time(path, time).x
    return path.speed * UPRIGHT * way.x / np.where(across > 0.0, across, 1.0), upwards, time


def _merged(rows: np.ndarray, yes: tuple[Row, Row, Row], no: tuple[Row, Row, Row]) -> tuple[Row, Row, Row]:
    vx, vy, time = (np.where(rows, a, b) for a, b in zip(yes, no, strict=True))
    return vx, vy, time


def _kept(rows: np.ndarray, vx: Row, vy: Row, time: Row) -> tuple[Row, Row, Row]:
    return np.where(rows, vx, np.nan), np.where(rows, vy, np.nan), np.where(rows, time, np.nan)
