"""Gauss-Legendre nodes and the number of panels; the rule that every evaluator's ``integrate`` shares."""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np


@functools.cache
def rule(points: int) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Nodes in (-1, 1) and weights of the Gauss-Legendre rule.

    Example:
        >>> nodes, weights = rule(2)
        >>> round(nodes[1] ** 2 * 3, 12), sum(weights)
        (1.0, 2.0)
    """
    nodes, weights = np.polynomial.legendre.leggauss(points)
    return tuple(nodes.tolist()), tuple(weights.tolist())


UNKNOWN = 16  # panels where the count is not known yet: an array that is being traced has no values


def panel_count(panels: Any) -> int:
    """How many panels serve every entry: the largest, rounded up, at least 1.

    Under tracing (``jax.jit``) the entries have no values, and ``UNKNOWN`` panels are taken.

    Example:
        >>> panel_count(0.2), panel_count(np.array([0.5, 2.5]))
        (1, 3)
    """
    if isinstance(panels, float | int):
        return max(1, math.ceil(panels)) if math.isfinite(panels) else 1
    if getattr(panels, "size", 1) == 0:
        return 1
    try:
        largest = float(panels.max())
    except TypeError:
        return UNKNOWN
    return max(1, math.ceil(largest)) if math.isfinite(largest) else 1
