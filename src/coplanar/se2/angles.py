"""Angles: one turn, or all of them."""

from __future__ import annotations

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import evaluator
from coplanar.laws import se2 as laws

_wrap = evaluator(laws.wrap)


def wrap_angle(angle: ArrayLike) -> Real:
    """The same direction in (-pi, pi] [rad].

    Example:
        >>> from math import pi
        >>> wrap_angle(-pi) == pi, wrap_angle(0.5)
        (True, 0.5)
    """
    return _wrap(checks.real("angle", angle))


def unwrap_angles(angles: ArrayLike, *, axis: int = -1) -> np.ndarray:
    """The angles with whole turns added so that no neighbours differ by more than pi [rad].

    Args:
        angles: Shape (..., n) [rad].
        axis: Along which the angles follow one another.

    Example:
        >>> unwrap_angles([3.0, -3.0]).round(6).tolist()
        [3.0, 3.283185]
    """
    unwrapped: np.ndarray = np.unwrap(checks.vector("angles", angles), axis=axis)
    return unwrapped
