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


WHOLE = 16  # points of a panel whose parts can do with fewer: there the nearest singularity is further away
PARTS = ((7, 0.0125), (8, 0.05), (9, 0.1), (10, 0.2), (11, 0.3), (12, 0.5), (16, 1.0))  # nodes, and the part of a panel


def nodes_for(part: float) -> int:
    """How many nodes serve a part of a panel as well as ``WHOLE`` serve the whole: each leaves out less than 1e-16.

    Example:
        >>> nodes_for(0.25), nodes_for(1.0)
        (11, 16)
    """
    return next((nodes for nodes, most in PARTS if part <= most), WHOLE)


UNKNOWN = 16  # panels where the count is not known yet: an array that is being traced has no values
MOST_PANELS = 1_000_000  # beyond, the answer is NaN: a phase of millions of radians is a mistake, not a motion


def panel_count(panels: Any) -> int:
    """How many panels serve every entry: the largest that is no more than ``MOST_PANELS``, rounded up, at least 1.

    Under tracing (``jax.jit``) the entries have no values, and ``UNKNOWN`` panels are taken. An entry that asks for
    more panels than there are, or for NaN, has no integral: ``integrate`` answers NaN for it.

    Example:
        >>> panel_count(0.2), panel_count(np.array([0.5, 2.5, np.nan]))
        (1, 3)
    """
    if isinstance(panels, float | int):
        return math.ceil(panels) if 1.0 < panels <= MOST_PANELS else 1
    try:
        entries = np.asarray(panels)
    except (TypeError, RuntimeError):  # JAX says TypeError of a traced array, PyTorch RuntimeError of one with gradient
        return UNKNOWN
    return math.ceil(float(np.max(entries, where=entries <= MOST_PANELS, initial=1.0)))
