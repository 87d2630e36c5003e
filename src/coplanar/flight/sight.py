"""How far a shot goes along a line of sight, and what reaches a given distance on it.

In the launch's own frame: the origin at the launch point, the target ahead (x > 0). A launch is a speed and its angle
from the zenith, so that the lofted arc of a near target keeps its digits; the line of sight has such an angle too. The
range along the line vanishes for a launch straight up and for one along the line, and has one maximum between them.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from coplanar.engine import evaluator
from coplanar.flight.path import Path, State, by_launch, crossing
from coplanar.flight.roots import falling_root, rising_root
from coplanar.laws import flight as laws

Row = Any

_free_speed = evaluator(laws.free_speed)
_hold_off = evaluator(laws.hold_off)

LOG_FASTEST = 115.0  # of the greatest speed that is searched, about 1e50 m/s
FINE = 1e-9  # last secant step to the best angle, over the sector between the zenith and the line


class Range(NamedTuple):
    """Range along the line [m], its derivatives by speed [s] and angle [m/rad], and the state at its end."""

    distance: Row
    by_speed: Row
    by_angle: Row
    end: State


class Sight(NamedTuple):
    """A line of sight from the launch point: cosine >= 0 and sine of its angle, drag k [1/m] and gravity g [m/s^2]."""

    cosine: Row
    sine: Row
    drag_per_mass: Row
    gravity: Row

    @property
    def zenith(self) -> Row:
        """Angle of the line from the zenith [rad]."""
        return np.arctan2(self.cosine, self.sine)

    def path(self, speed: Row, zenith: Row) -> Path:
        """The launch at a speed and an angle from the zenith."""
        return Path(speed, np.sin(zenith), np.cos(zenith), self.drag_per_mass, self.gravity)

    def reach(self, speed: Row, zenith: Row) -> Range:
        """The range along the line: from the launch point to where the path comes back to the line."""
        path, c, s = self.path(speed, zenith), self.cosine, self.sine
        end, _ = crossing(path, c, s)
        x_v, y_v, x_psi, y_psi = by_launch(path, end)
        # A change of the launch moves the path; the end slides along the path until it is on the line again.
        with np.errstate(all="ignore"):
            slide = (c * end.vx + s * end.vy) / (c * end.vy - s * end.vx)
        return Range(
            c * end.x + s * end.y,
            c * x_v + s * y_v - slide * (c * y_v - s * x_v),
            c * x_psi + s * y_psi - slide * (c * y_psi - s * x_psi),
            end,
        )

    def farthest(self, speed: Row) -> tuple[np.ndarray, Range]:
        """The angle from the zenith that goes farthest at this speed, and its range."""

        def surplus(zenith: Row, speed: Row, *sight: Row) -> Row:
            return -Sight(*sight).reach(speed, zenith).by_angle

        best = falling_root(surplus, 0.5 * self.zenith, 0.0, self.zenith, speed, *self, fine=FINE)
        return best, self.reach(speed, best)

    def speed_for(self, distance: Row, zenith: Row, start: Row = None) -> np.ndarray:
        """The speed that reaches a distance at this angle; infinite where it is beyond exp(``LOG_FASTEST``) m/s.

        The range rises with the speed, like v^2 at first and like log v in the end: Newton in log v.

        Args:
            distance: Along the line [m].
            zenith: Angle of the launch from the zenith [rad].
            start: A guess of the speed [m/s].
        """
        free = np.log(_free_speed(distance, self.cosine, np.sin(zenith), np.sin(self.zenith - zenith), self.gravity))
        guess = free + _hold_off(self.drag_per_mass * distance) if start is None else np.log(start)

        def beyond(log_speed: Row, distance: Row, zenith: Row, *sight: Row) -> tuple[Row, Row]:
            speed = np.exp(log_speed)
            now = Sight(*sight).reach(speed, zenith)
            with np.errstate(all="ignore"):
                return np.log(now.distance / distance), speed * now.by_speed / now.distance

        start, end = np.clip(guess, free, LOG_FASTEST), np.minimum(free, LOG_FASTEST)
        found = rising_root(beyond, start, end, LOG_FASTEST, distance, zenith, *self, longest=20.0)
        return np.where(found < LOG_FASTEST, np.exp(found), np.inf)

    def least(self, distance: Row) -> tuple[np.ndarray, np.ndarray]:
        """The least speed that reaches a distance, and its angle from the zenith: where more angle brings no range.

        Near it the speed hardly changes with the angle, so that the speed at the first angle is a guess for all.
        """

        def surplus(zenith: Row, distance: Row, guess: Row, *sight: Row) -> Row:
            line = Sight(*sight)
            return -line.reach(line.speed_for(distance, zenith, guess), zenith).by_angle

        middle = 0.5 * self.zenith
        guess = self.speed_for(distance, middle)
        zenith = falling_root(surplus, middle, 0.0, self.zenith, distance, guess, *self, fine=FINE)
        return self.speed_for(distance, zenith, guess), zenith

    def both(self, distance: Row, speed: Row) -> tuple[np.ndarray, np.ndarray, np.ndarray, Row]:
        """Low arc, lofted arc and the best angle, all from the zenith, and the farthest range, for a speed.

        The two arcs are searched on either side of the best angle, where the range is monotone. Near the greatest range
        they merge like its square root: Newton runs on the root of what is missing to it. Beyond it, both are the best.
        """
        best, top = self.farthest(speed)
        most = top.distance

        def long(way: Row, side: Row, from_: Row, distance: Row, most: Row, speed: Row, *sight: Row) -> tuple[Row, Row]:
            now = Sight(*sight).reach(speed, from_ - side * way)
            gap, root = (np.sqrt(np.maximum(most - far, 0.0)) for far in (distance, now.distance))
            with np.errstate(all="ignore"):
                slope = side * now.by_angle * np.where(root > 0.0, 0.5 * (root + gap) / root, 1.0)
            return np.where(gap > 0.0, now.distance - distance, 0.0), slope

        part, above = 1.0 - np.sqrt(np.maximum(1.0 - distance / most, 0.0)), self.zenith - best
        given = distance, most, speed, *self
        low = rising_root(long, part * above, 0.0, above, 1.0, self.zenith, *given)
        high = rising_root(long, part * best, 0.0, best, -1.0, 0.0, *given)
        return self.zenith - low, high, best, most
