"""Where a curve enters, leaves and touches the ring that two links reach."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from coplanar.arms import Arm
from coplanar.arms.geometry import ring, tool_lever
from coplanar.curves import Curve
from coplanar.engine import evaluator
from coplanar.laws import tracing as laws
from coplanar.solving import bracketed_root
from coplanar.tracing.result import Failure, Reason

_radius = evaluator(laws.radius)
_radial_rate = evaluator(laws.radial_rate)


@dataclass(frozen=True, slots=True)
class Path:
    """A curve seen from the base of an arm.

    Between neighbouring knots the distance from the base only grows or only falls.

    Attributes:
        arm: The arm.
        curve: The curve.
        knots: The parameters asked for, some between them, and all where the distance is extreme.
        radius: Distance from the base at the knots [m].
        inner: Of the ring [m].
        outer: Of the ring [m].
        extreme: Which knots are extreme.
        tolerance: How far off the ring's edge still counts as on it [m].
    """

    arm: Arm
    curve: Curve
    knots: np.ndarray
    radius: np.ndarray
    inner: float
    outer: float
    extreme: np.ndarray
    tolerance: float

    @classmethod
    def of(cls, arm: Arm, curve: Curve, parameters: np.ndarray, between: int, tolerance: float) -> Path:
        """With ``between`` pieces from each parameter to the next, in which an extreme is looked for."""
        base = (arm.base.x, arm.base.y)

        def radius(phi: np.ndarray) -> np.ndarray:
            points = curve.position(phi)
            return np.asarray(_radius(points[..., 0], points[..., 1], *base))

        def slope(phi: np.ndarray) -> np.ndarray:
            points, tangents = curve.position(phi), curve.derivative(phi)
            return np.asarray(_radial_rate(points[..., 0], points[..., 1], tangents[..., 0], tangents[..., 1], *base))

        fine = refined(parameters, between)
        signs = np.sign(slope(fine))
        turns = np.flatnonzero(signs[1:] * signs[:-1] < 0.0)
        roots = _roots(slope, fine, turns)
        knots, places = np.unique(np.concatenate([fine, roots]), return_inverse=True)
        extreme = np.zeros(len(knots), dtype=bool)
        extreme[places[len(fine) :]] = True
        extreme[places[: len(fine)][signs == 0.0]] = True
        if parameters[0] > parameters[-1]:
            knots, extreme = knots[::-1], extreme[::-1]
        inner, outer = ring((arm.links[0], tool_lever(arm)[0]))
        return cls(arm, curve, knots, radius(knots), inner, outer, extreme, tolerance)

    def index(self, parameter: np.ndarray) -> np.ndarray:
        """Places of parameters that are knots."""
        sign = 1.0 if self.knots[-1] > self.knots[0] else -1.0
        return np.asarray(np.searchsorted(sign * self.knots, sign * parameter))

    def touches(self) -> np.ndarray:
        """Places of the inner knots at which the curve touches an edge of the ring, or the base, from within."""
        inside = ~(self._beyond() | self._within())
        edge = np.minimum(np.abs(self.radius - self.outer), np.abs(self.radius - self.inner)) <= self.tolerance
        found = self.extreme & (edge | (self.radius <= self.tolerance)) & inside
        found[[0, -1]] = False
        found[1:-1] &= inside[:-2] & inside[2:]
        return np.flatnonzero(found)

    def failures(self) -> list[Failure]:
        """The intervals out of reach, their ends refined on the curve."""
        gone = []
        for out, reason, edge in (
            (self._beyond(), Reason.TOO_FAR, self.outer),
            (self._within(), Reason.TOO_CLOSE, self.inner),
        ):
            gap = np.abs(self.radius - edge)
            gone += failures_of(self.knots, out, gap, reason, self._edge(edge))
        return gone

    def _beyond(self) -> np.ndarray:
        return np.asarray(self.radius - self.outer > self.tolerance)

    def _within(self) -> np.ndarray:
        return np.asarray(self.inner - self.radius > self.tolerance)

    def _edge(self, edge: float) -> Callable[[np.ndarray], np.ndarray]:
        base = (self.arm.base.x, self.arm.base.y)

        def excess(phi: np.ndarray) -> np.ndarray:
            points = self.curve.position(phi)
            return np.asarray(_radius(points[..., 0], points[..., 1], *base)) - edge

        return excess


def failures_of(
    knots: np.ndarray, out: np.ndarray, amount: np.ndarray, reason: Reason,
    excess: Callable[[np.ndarray], np.ndarray], joint: int | None = None,
) -> list[Failure]:  # fmt: skip
    """Runs of knots that are out, as intervals whose inner ends are roots of ``excess``.

    Where the excess does not change its sign between the last knot inside and the first outside (the one inside is
    on the edge, within the tolerance), the one inside is the end.
    """
    changes = np.flatnonzero(out[1:] != out[:-1])
    ends = dict(zip(changes.tolist(), _crossings(excess, knots, out, changes).tolist(), strict=True))
    starts = np.flatnonzero(out & ~np.concatenate([[False], out[:-1]]))
    stops = np.flatnonzero(out & ~np.concatenate([out[1:], [False]]))
    return [
        Failure(
            first=ends.get(a - 1, float(knots[a])), last=ends.get(b, float(knots[b])), reason=reason,
            amount=float(amount[a : b + 1].max()), joint=joint,
        )
        for a, b in zip(starts.tolist(), stops.tolist(), strict=True)
    ]  # fmt: skip


def refined(parameters: np.ndarray, pieces: int) -> np.ndarray:
    """The parameters with ``pieces`` equal pieces between neighbours; those given stay exactly as they are."""
    parts = np.arange(pieces) / pieces
    body = parameters[:-1, None] + parts * np.diff(parameters)[:, None]
    return np.concatenate([body.ravel(), parameters[-1:]])


def _roots(function: Callable[[np.ndarray], np.ndarray], knots: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Roots between the knots at ``places`` and those after them."""
    if not places.size:
        return np.empty(0)
    return np.asarray(bracketed_root(function, knots[places], knots[places + 1], tolerance=0.0).x)


def _crossings(
    function: Callable[[np.ndarray], np.ndarray], knots: np.ndarray, out: np.ndarray, places: np.ndarray
) -> np.ndarray:
    if not places.size:
        return np.empty(0)
    answer = bracketed_root(function, knots[places], knots[places + 1], tolerance=0.0)
    inside = np.where(out[places], knots[places + 1], knots[places])
    return np.asarray(np.where(answer.converged, answer.x, inside))
