"""The boundary of what a two-link arm with joint limits reaches, as circular arcs.

The tip is on the boundary only where a joint is at a limit or the links are in line: each of these is an arc. All
arcs are cut where they cross, and a piece counts if the region lies on one side of it alone.
"""

from __future__ import annotations

import cmath
import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from coplanar.arms import geometry
from coplanar.arms.chain import Chain
from coplanar.engine import evaluator
from coplanar.laws import arms as laws
from coplanar.laws import se2

SIDE = 1e-6  # of the reach: how far beside an arc its two sides are looked at
MERGE = 1e-7  # [rad] cuts nearer than this are one: where circles touch, rounding parts them by 1e-8

_link = evaluator(laws.link)
_two_link_inverse = evaluator(laws.two_link_inverse)
_wrap = evaluator(se2.wrap)


@dataclass(frozen=True, slots=True)
class Arc:
    """A circular arc in the world.

    Attributes:
        centre: [m].
        radius: [m].
        start: Angle of its first point, from the x axis [rad].
        sweep: Angle to its last point, counterclockwise, at most 2 pi [rad].
    """

    centre: tuple[float, float]
    radius: float
    start: float
    sweep: float

    def points(self, count: int = 65) -> np.ndarray:
        """Points along the arc, both ends among them, shape (count, 2) [m].

        Example:
            >>> Arc((0.0, 0.0), 2.0, 0.0, 1.0).points(2)[0].tolist()
            [2.0, 0.0]
        """
        return self.at(self.start + np.linspace(0.0, self.sweep, count))

    def at(self, angle: np.ndarray, *, outwards: float = 0.0) -> np.ndarray:
        """The point of the circle in a direction, or a little outwards of it, shape (..., 2)."""
        return np.stack(_link(*self.centre, np.asarray(angle), self.radius + outwards), axis=-1)

    def farthest(self, point: tuple[float, float]) -> float:
        """Largest distance from a point to the arc [m]."""
        dx, dy = self.centre[0] - point[0], self.centre[1] - point[1]
        away = (math.atan2(dy, dx) - self.start) % math.tau
        if away <= self.sweep:
            return math.hypot(dx, dy) + self.radius
        ends = self.points(2)
        return float(np.hypot(ends[:, 0] - point[0], ends[:, 1] - point[1]).max())

    def cut(self, others: list[Arc]) -> list[Arc]:
        """The pieces between the places where it meets the circles of the others."""
        angles = sorted((a - self.start) % math.tau for other in others for a in self._meets(other))
        stops = [0.0]
        for angle in angles:
            if angle - stops[-1] > MERGE and angle < self.sweep - MERGE:
                stops.append(angle)
        pieces = itertools.pairwise([*stops, self.sweep])
        return [Arc(self.centre, self.radius, self.start + a, b - a) for a, b in pieces if b > a]

    def _meets(self, other: Arc) -> list[float]:
        """Directions on this circle where the other circle crosses it: a triangle of two links."""
        dx, dy = other.centre[0] - self.centre[0], other.centre[1] - self.centre[1]
        inner, outer = geometry.ring((self.radius, other.radius))
        if not inner < math.hypot(dx, dy) < outer or math.hypot(dx, dy) == 0.0:
            return []
        return [_two_link_inverse(dx, dy, self.radius, other.radius, elbow)[0] for elbow in (1.0, -1.0)]


def boundary_arcs(chain: Chain, gap: Callable[[np.ndarray], np.ndarray]) -> list[Arc]:
    """The arcs that bound the region of a two-link arm with limits, in the world.

    Args:
        chain: Joints "RR", with limits.
        gap: Distance of points, shape (k, 2), from the region.
    """
    edges = [arc for arc in (*_first_at_limit(chain), *_second_at_limit(chain), *_in_line(chain)) if arc.radius > 0.0]
    pieces = [piece for i, arc in enumerate(edges) for piece in arc.cut(edges[:i] + edges[i + 1 :])]
    reach = sum(geometry.levers(chain))
    middles = [(p, p.start + 0.5 * p.sweep) for p in pieces]
    sides = np.array([[p.at(np.array(m), outwards=s * SIDE * reach) for p, m in middles] for s in (1.0, -1.0)])
    inside = gap(sides.reshape(-1, 2)).reshape(2, -1) <= 1e-3 * SIDE * reach
    kept = [piece for piece, (out, inn) in zip(pieces, inside.T, strict=True) if not (out and inn)]
    return _distinct(kept)


def _distinct(arcs: list[Arc]) -> list[Arc]:
    """Every piece once: two edges may share an arc."""
    seen: dict[tuple[float, ...], Arc] = {}
    for arc in arcs:
        middle = arc.at(np.array(arc.start + 0.5 * arc.sweep))
        seen.setdefault(tuple(np.round([*middle, arc.radius, arc.sweep], 9).tolist()), arc)
    return list(seen.values())


def _first_at_limit(chain: Chain) -> list[Arc]:
    """Link 1 at a limit: the tip turns about the elbow."""
    arcs = []
    l1, (l2, lean) = chain.links[0], geometry.tool_lever(chain)
    for limit in _pair(chain, 0):
        if math.isfinite(limit):
            first = chain.base.theta + limit + chain.bends[0]
            elbow = _link(chain.base.x, chain.base.y, first, l1)
            zero = lean + chain.bends[1] + (first if chain.angles == "relative" else chain.base.theta)
            arcs.append(Arc(elbow, l2, *_span(zero, *_pair(chain, 1))))
    return arcs


def _second_at_limit(chain: Chain) -> list[Arc]:
    """Link 2 at a limit: the tip turns about the base, or, at an absolute angle, about the base shifted by link 2."""
    arcs = []
    l1, (l2, lean) = chain.links[0], geometry.tool_lever(chain)
    zero = chain.base.theta + chain.bends[0]
    for limit in _pair(chain, 1):
        if math.isfinite(limit):
            second = limit + chain.bends[1] + lean
            if chain.angles == "relative":
                line = l1 + cmath.rect(l2, second)
                span = _span(zero + cmath.phase(line), *_pair(chain, 0))
                arcs.append(Arc((chain.base.x, chain.base.y), abs(line), *span))
            else:
                centre = _link(chain.base.x, chain.base.y, chain.base.theta + second, l2)
                arcs.append(Arc(centre, l1, *_span(zero, *_pair(chain, 0))))
    return arcs


def _in_line(chain: Chain) -> list[Arc]:
    """The elbow straight or folded, for every number of half turns that the limits allow."""
    l1, (l2, lean) = chain.links[0], geometry.tool_lever(chain)
    arcs = []
    for half_turns in (0, 1):
        reach = l1 - l2 if half_turns else l1 + l2
        flip = math.pi if reach < 0.0 else 0.0
        for low, high in _first_joint_in_line(chain, half_turns * math.pi - chain.bends[1] - lean):
            zero = chain.base.theta + chain.bends[0] + flip
            arcs.append(Arc((chain.base.x, chain.base.y), abs(reach), *_span(zero, low, high)))
    return arcs


def _first_joint_in_line(chain: Chain, turn: float) -> list[tuple[float, float]]:
    """Intervals of the first joint for which the second may stand ``turn`` (and whole turns) from link 1."""
    (low, high), (least, most) = _pair(chain, 0), _pair(chain, 1)
    if chain.angles == "relative":
        fits = math.floor((most - turn) / math.tau) >= math.ceil((least - turn) / math.tau) if math.isfinite(
            most - least
        ) else True  # fmt: skip
        return [(low, high)] if fits else []
    if not (math.isfinite(high - low) and math.isfinite(most - least)):
        return [(low, high)]
    shift = turn + chain.bends[0]
    first, last = math.ceil((least - high - shift) / math.tau), math.floor((most - low - shift) / math.tau)
    spans = [(least - shift - math.tau * k, most - shift - math.tau * k) for k in range(first, last + 1)]
    return [(max(low, a), min(high, b)) for a, b in spans if max(low, a) < min(high, b)]


def _span(zero: float, low: float, high: float) -> tuple[float, float]:
    """Start and sweep of the angles zero + [low, high], at most one turn."""
    if not math.isfinite(high - low) or high - low >= math.tau:
        return (zero + (low if math.isfinite(low) else 0.0), math.tau)
    return zero + low, high - low


def _pair(chain: Chain, joint: int) -> tuple[float, float]:
    return float(chain.lower[joint]), float(chain.upper[joint])
