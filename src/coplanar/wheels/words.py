"""Directions of motion, in words."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, degrees, hypot

import numpy as np

_COMPASS = {0.0: "forward", 90.0: "sideways"}


def motion(twist: np.ndarray, length: float, *, tolerance: float = 1e-6) -> str:
    """A twist as a motion, up to its sign and size.

    Args:
        twist: (vx, vy, omega).
        length: What omega is multiplied by to compare it with a speed [m].
        tolerance: What counts as zero, as a share of the whole [-].

    Example:
        >>> motion(np.array([0.0, -1.0, 0.0]), 0.2)
        'move sideways'
        >>> motion(np.array([0.0, -0.5, 1.0]), 0.2)
        'turn about (0.5, 0) m'
    """
    vx, vy, omega = (float(part) for part in twist)
    speed, turning = hypot(vx, vy), abs(omega) * length
    if turning <= tolerance * speed:
        return f"move {direction(vx, vy)}"
    if speed <= tolerance * turning:
        return "turn on the spot"
    return f"turn about {point(-vy / omega, vx / omega)}"


def direction(x: float, y: float) -> str:
    """The direction of a line: forward, sideways or its angle from the x axis.

    Example:
        >>> direction(0.0, -2.0), direction(1.0, 1.0)
        ('sideways', 'along 45 deg')
    """
    angle = round(degrees(atan2(y, x)) % 180.0, 3) % 180.0
    return _COMPASS.get(angle, f"along {angle:g} deg")


def point(x: float, y: float) -> str:
    """A body point to four digits.

    Example:
        >>> point(0.5, -0.0)
        '(0.5, 0) m'
    """
    return f"({round(x, 9) + 0.0:.4g}, {round(y, 9) + 0.0:.4g}) m"


def listed(names: Sequence[str]) -> str:
    """Names in a row.

    Example:
        >>> listed(["left", "right", "rear"])
        'left, right and rear'
    """
    return " and ".join([", ".join(names[:-1]), names[-1]]) if len(names) > 1 else "".join(names)


def sliding(row: np.ndarray, *, tolerance: float = 1e-9) -> str:
    """A velocity that a lateral row forbids: of which point, along which direction.

    Args:
        row: (a, b, c) of a vx + b vy + c omega = 0 with a^2 + b^2 = 1.
        tolerance: Lever arms below this are zero [m].

    Example:
        >>> sliding(np.array([0.0, 1.0, 0.3]))
        'move its point (0.3, 0) m sideways'
        >>> sliding(np.array([0.0, 1.0, 0.0]))
        'move sideways'
    """
    a, b, c = (float(entry) for entry in row)
    if abs(c) <= tolerance:
        return f"move {direction(a, b)}"
    return f"move its point {point(c * b, -c * a)} {direction(a, b)}"
