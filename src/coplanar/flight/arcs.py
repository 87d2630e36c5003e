"""The low and the lofted arc to the end of a line of sight, for one or for rows of them.

A rough idea of how far the speed goes is enough to find the arcs to targets that are clearly nearer. For the others the
limit is found first. What the searches on angle and parameter leave, the nested ones of ``Sight`` find.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from coplanar.flight.path import crossing
from coplanar.flight.sight import Sight
from coplanar.laws.aiming import ASTRAY, arc, farthest

Row = Any

ABOUT = 2  # rounds that tell the limit to about a thousandth
CLEAR = 0.95  # of the rough limit: what is nearer is surely within the true one


class Arcs(NamedTuple):
    """Angles of two launches from the zenith [rad] and their flight times [s].

    Attributes:
        low: Angle of the flatter launch; of the one that goes farthest where the target is out of reach.
        low_time: Its flight time.
        high: Angle of the lofted launch; the same one where the target is out of reach.
        high_time: Its flight time.
        most: How far the speed goes along the line [m]; infinite where that was not asked, the target being nearer.
        lost: Whether a launch is not one through the target, nor the farthest.
    """

    low: Row
    low_time: Row
    high: Row
    high_time: Row
    most: Row
    lost: Row


def arcs(sight: Sight, distance: Row, speed: Row) -> Arcs:
    """Both arcs to a distance along the line at a speed."""
    if type(distance) is float:
        return _one(sight, distance, speed)
    columns = np.broadcast_arrays(speed, *sight, distance)
    rows = np.array([np.ravel(column) for column in columns])
    answer = np.full((6, rows.shape[1]), np.inf)
    *limit, _, _ = farthest(*rows[:5], rounds=ABOUT)
    left = ~_placed(answer, rows, limit, rows[5] < CLEAR * limit[1])
    if left.any():
        _place_far(answer, rows, np.flatnonzero(left))
    low, low_time, high, high_time, most, lost = answer.reshape(6, *columns[0].shape)
    return Arcs(low, low_time, high, high_time, most, lost > 0.0)


def _one(sight: Sight, distance: float, speed: float) -> Arcs:
    """The same for floats."""
    for rounds in (ABOUT, None):
        best, most, theta, time, known = farthest(speed, *sight, rounds=rounds)
        exact = known > 0.0
        if exact and distance > most:
            return Arcs(best, time, best, time, most, False)
        if exact or distance < CLEAR * most:
            given = speed, *sight, distance, best, most, theta
            low, low_time, found = arc(*given, 1.0)
            high, high_time, found_too = arc(*given, -1.0)
            if found * found_too > 0.0:
                return Arcs(low, low_time, high, high_time, most if exact else np.inf, False)
    low, low_time, high, high_time, most, lost = _nested(np.array([[speed, *sight, distance]]).T)[:, 0].tolist()
    return Arcs(low, low_time, high, high_time, most, lost > 0.0)


def _placed(answer: np.ndarray, rows: np.ndarray, limit: Any, which: np.ndarray) -> np.ndarray:
    """Write the arcs of the rows that are True, and say which were found."""
    whole = bool(which.all())
    given = [*rows, *limit] if whole else [row[which] for row in (*rows, *limit)]
    low, low_time, found = arc(*given, 1.0)
    high, high_time, found_too = arc(*given, -1.0)
    good = found * found_too > 0.0
    there = which.copy()
    there[which] = good
    for column, part in zip(answer, (low, low_time, high, high_time), strict=False):
        column[there] = part[good]
    answer[5, there] = 0.0
    return there


def _place_far(answer: np.ndarray, rows: np.ndarray, left: np.ndarray) -> None:
    """The rows that are left, from their exact limits; where these are not found, by nested searches."""
    rows = rows[:, left]
    best, most, theta, time, known = farthest(*rows[:5])
    part = np.full((6, len(left)), np.inf)
    part[4] = most
    beyond = (known > 0.0) & (rows[5] > most)
    part[:4, beyond], part[5, beyond] = np.array([best, time, best, time])[:, beyond], 0.0
    lost = ~(beyond | _placed(part, rows, (best, most, theta), (known > 0.0) & ~beyond))
    if lost.any():
        part[:, lost] = _nested(rows[:, lost])
    answer[:, left] = part


def _nested(rows: np.ndarray) -> Any:
    """The arcs by a search for the best angle, two for the arcs, and in each of their steps one for the crossing."""
    speed, distance, sight = rows[0], rows[5], Sight(*rows[1:5])
    with np.errstate(all="ignore"):
        low, high, best, most = sight.both(distance, speed)
        far = distance > most
        angles = [np.where(far, best, angle) for angle in (low, high)]
        (low_time, lost), (high_time, lost_too) = (
            time_to(sight, np.minimum(distance, most), speed, angle) for angle in angles
        )
    return np.array([angles[0], low_time, angles[1], high_time, most, 1.0 * (lost | lost_too)])


def time_to(sight: Sight, distance: Row, speed: Row, zenith: Row) -> tuple[Row, Row]:
    """The time at which a path is nearest to the end of the line of sight, and whether it misses that.

    A path that is nearly parallel to the line crosses it at a place known less well than the path itself.
    """
    end, _ = crossing(sight.path(speed, zenith), sight.cosine, sight.sine)
    dx, dy = distance * sight.cosine - end.x, distance * sight.sine - end.y
    later = (dx * end.vx + dy * end.vy) / (end.vx * end.vx + end.vy * end.vy)
    return end.time + later, ~(np.hypot(dx - later * end.vx, dy - later * end.vy) <= ASTRAY * distance)
