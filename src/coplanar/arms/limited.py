"""The nearest point of a two-link arm whose joint limits keep it away, exactly.

Inside its limits the tool's distance to a target out of their reach is least where a joint is at a limit: there the
tool moves on a circle, and the nearest angle of an arc is the target's own, or an end. So four edges are compared.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from coplanar.arms.chain import Chain
from coplanar.arms.closed import Triangle
from coplanar.engine import evaluator
from coplanar.laws import arms as laws

_link = evaluator(laws.link)
_turn_onto = evaluator(laws.turn_onto)


def nearest_on_edges(chain: Chain, triangle: Triangle, near: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Joints within the limits whose tool is nearest to the target, shape (k, 2), and the distance, shape (k,)."""
    edges = [(i, limit) for i in (0, 1) for limit in (chain.lower[i], chain.upper[i]) if np.isfinite(limit)]
    candidates = np.stack([_on_edge(chain, triangle, near, i, limit) for i, limit in edges], axis=1)
    x, y = _tip(chain, triangle, candidates)
    distance = np.hypot(x - triangle.x[:, None], y - triangle.y[:, None])
    best = distance.argmin(axis=1)
    rows = np.arange(len(best))
    return candidates[rows, best], distance[rows, best]


def _on_edge(chain: Chain, triangle: Triangle, near: np.ndarray, fixed: int, limit: float) -> np.ndarray:
    """Joints with one at its limit and the other as near to the target as its own limits allow, shape (k, 2)."""
    moving = 1 - fixed
    joints = np.zeros((len(triangle.x), 2))
    joints[:, fixed] = limit
    (cx, cy), (sx, sy) = _circle(chain, triangle, joints, fixed)
    wanted = np.arctan2(triangle.y - cy, triangle.x - cx) - np.arctan2(sy - cy, sx - cx)
    joints[:, moving] = _turn_onto(wanted, near[:, moving], chain.lower[moving], chain.upper[moving])
    return joints


def _circle(chain: Chain, triangle: Triangle, joints: np.ndarray, fixed: int) -> tuple[Any, Any]:
    """Centre of the circle on which the tip moves with one joint fixed, and the tip where the other joint is 0."""
    start = _tip(chain, triangle, joints)
    if fixed == 0:
        return _link(0.0, 0.0, joints[:, 0] + chain.bends[0], triangle.l1), start
    if chain.angles == "relative":
        return (0.0, 0.0), start
    return _link(0.0, 0.0, joints[:, 1] + chain.bends[1] + triangle.lean, triangle.l2), start


def _tip(chain: Chain, triangle: Triangle, joints: np.ndarray) -> tuple[Any, Any]:
    """Tip in the base frame."""
    first = joints[..., 0] + chain.bends[0]
    second = joints[..., 1] + chain.bends[1] + triangle.lean
    second = second + first if chain.angles == "relative" else second
    x, y = _link(*_link(0.0, 0.0, first, triangle.l1), second, triangle.l2)
    return x, y
