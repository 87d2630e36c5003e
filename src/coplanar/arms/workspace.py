"""Which points a tool can reach.

Freely turning revolute links reach a ring, exactly. Two revolute joints with limits reach a region whose boundary is
made of circular arcs, exactly: one joint at a limit, or the elbow straight or folded. Any other arm with limits is
sampled, and the answer says so.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.arms import geometry
from coplanar.arms.arcs import Arc, boundary_arcs
from coplanar.arms.chain import Chain
from coplanar.arms.inverse import inverse
from coplanar.checks import ArrayLike
from coplanar.engine import evaluator
from coplanar.errors import InvalidValue
from coplanar.laws import arms as laws

DIRECTIONS = 180  # sectors around the base in which a sampled envelope is measured
SAMPLES = 2**14  # postures of a sampled envelope

_ring_gap = evaluator(laws.ring_gap)


@dataclass(frozen=True, slots=True)
class Workspace:
    """The region that the tool's origin can reach.

    Attributes:
        chain: The arm.
        centre: The base [m].
        inner: Radius of the largest disc about the base that cannot be reached; at most this where sampled [m].
        outer: Radius of the smallest disc about the base that holds it all; at least this where sampled [m].
        arcs: The boundary as arcs; empty where it is sampled.
        exact: Whether inner, outer and arcs are exact. Otherwise they are measured on sampled postures, so that the
            true region is larger.
    """

    chain: Chain
    centre: tuple[float, float]
    inner: float
    outer: float
    arcs: tuple[Arc, ...]
    exact: bool

    def boundary(self, count: int = 65) -> list[np.ndarray]:
        """The boundary as polylines in the world, each of shape (count, 2) [m].

        A sampled boundary is the farthest, and then the nearest, sampled point in each of ``DIRECTIONS`` sectors about
        the base, shape (sectors that were met, 2).

        Example:
            >>> [len(line) for line in workspace_of(Chain((1.0, 0.5))).boundary(9)]
            [9, 9]
        """
        if self.exact:
            return [arc.points(count) for arc in self.arcs]
        return _envelope(self.chain, sample(self.chain))

    def gap(self, points: ArrayLike) -> Any:
        """Distance from points to the region, 0 inside; as ``Arm.inverse`` reports it, shape (...) [m]."""
        targets = checks.vector("points", points, 2)
        if geometry.turns_freely(self.chain):
            return _ring_gap(targets[..., 0] - self.centre[0], targets[..., 1] - self.centre[1], self.inner, self.outer)
        return inverse(self.chain, targets).gap

    def contains(self, points: ArrayLike, *, tolerance: float = 1e-9) -> Any:
        """Whether the tool comes within ``tolerance`` [m] of points, shape (...)."""
        return self.gap(points) <= checks.not_negative("tolerance", tolerance)


def workspace_of(chain: Chain) -> Workspace:
    """The workspace of an arm; see ``Workspace``.

    Raises:
        InvalidValue: If a prismatic joint has no finite limits, so that the region has no bound.
    """
    centre = (chain.base.x, chain.base.y)
    if geometry.turns_freely(chain):
        inner, outer = geometry.ring(geometry.levers(chain))
        arcs = tuple(Arc(centre, radius, 0.0, math.tau) for radius in (outer, inner) if radius > 0.0)
        return Workspace(chain, centre, inner, outer, arcs, exact=True)
    if chain.joints == "RR":
        return _of_two_links(chain, centre)
    slides = np.array(list(chain.joints)) == "P"
    if not np.isfinite([chain.lower[slides], chain.upper[slides]]).all():
        raise InvalidValue("limits", chain.limits, "finite limits at every prismatic joint", "its reach has no bound")
    radii = np.hypot(*(sample(chain) - centre).T)
    return Workspace(chain, centre, float(radii.min()), float(radii.max()), (), exact=False)


def _of_two_links(chain: Chain, centre: tuple[float, float]) -> Workspace:
    def gap(points: np.ndarray) -> np.ndarray:
        return np.asarray(inverse(chain, points, tolerance=0.0).gap)

    arcs = boundary_arcs(chain, gap)
    outer = max(arc.farthest(centre) for arc in arcs)
    base = np.array([centre])
    return Workspace(chain, centre, float(gap(base)[0]), outer, tuple(arcs), exact=True)


def sample(chain: Chain, count: int = SAMPLES) -> np.ndarray:
    """Tool positions at postures spread over the limits, many of them with joints at a limit, shape (count, 2).

    The boundary of the region belongs to postures with joints at their limits or links in line, so each joint is at
    its lower or upper limit, or straight, for a good part of the samples. The same points on every call.
    """
    from scipy.stats import qmc

    lower = np.where(np.isfinite(chain.lower), chain.lower, -np.pi)
    upper = np.where(np.isfinite(chain.upper), chain.upper, np.pi)
    draws = qmc.Sobol(2 * chain.n, scramble=False).random(count)
    spread, kind = draws[:, : chain.n], draws[:, chain.n :]
    q = lower + spread * (upper - lower)
    q = np.where(kind < 0.2, lower, np.where(kind < 0.4, upper, q))
    q = np.where((kind > 0.8) & (lower <= 0.0) & (upper >= 0.0), 0.0, q)
    return chain.forward(q).position


def _envelope(chain: Chain, points: np.ndarray) -> list[np.ndarray]:
    """The farthest and the nearest point of every sector about the base."""
    x, y = points[:, 0] - chain.base.x, points[:, 1] - chain.base.y
    sector = np.floor((np.arctan2(y, x) + np.pi) / math.tau * DIRECTIONS).astype(int)
    order = np.lexsort((np.hypot(x, y), sector))
    first = np.flatnonzero(np.diff(sector[order], prepend=-1))
    last = np.append(first[1:], len(order)) - 1
    return [points[order[last]], points[order[first]]]
