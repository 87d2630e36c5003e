"""Views that hold a path."""

from __future__ import annotations

import math

import numpy as np


def half_width(points: np.ndarray, least: float = 1.0) -> float:
    """A power of two that holds the points (n, 2): a view that jumps seldom.

    Example:
        >>> half_width(np.array([[0.0, 0.0], [2.5, 1.0]]))
        4.0
    """
    reach = max(1.15 * float(np.abs(points).max(initial=0.0)), least)
    return float(2.0 ** math.ceil(math.log2(reach)))
