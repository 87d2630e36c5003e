"""Two revolute joints along a curve: one branch, continued through the points where the branches meet."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from coplanar.arms import Arm
from coplanar.arms.closed import joints_of_turns, triangle_of, wind
from coplanar.arms.geometry import tool_lever
from coplanar.engine import evaluator
from coplanar.laws import arms, se2
from coplanar.tracing.result import Failure, Reason, SingularPoint
from coplanar.tracing.ring import Path, failures_of

_two_link_inverse = evaluator(arms.two_link_inverse)
_turn_near = evaluator(arms.turn_near)
_wrap = evaluator(se2.wrap)
AT_SINGULAR = ("stop", "through", "bounce")
NEARBY = 1e-3  # of the way to the next knot: from how far a direction is taken where the tangent vanishes


@dataclass(frozen=True, slots=True)
class Branch:
    """The branch at the knots of a path.

    Attributes:
        q: Unwrapped joints, shape (knots, n).
        elbow: Sign of the sine at the elbow, shape (knots,).
        singular_points: Those passed, and the one stopped at.
        stop: Place of the knot at which it stopped; the last one if it did not.
    """

    q: np.ndarray
    elbow: np.ndarray
    singular_points: tuple[SingularPoint, ...]
    stop: int


def follow(path: Path, elbow: int, near: np.ndarray | None, at_singular: str) -> Branch:
    """The branch that begins with ``elbow``, in unwrapped joints."""
    touches = path.touches()
    stop = int(touches[0]) if at_singular == "stop" and touches.size else len(path.knots) - 1
    elbows = np.full(len(path.knots), elbow)
    passed = []
    for place in touches[touches <= stop]:
        point, after = _passage(path, int(place), int(elbows[place]), at_singular)
        passed.append(point)
        elbows[place + 1 :] = after
    turns = _turns(path, elbows, touches)
    q = joints_of_turns(path.arm, [turns[:, 0], turns[:, 1] - tool_lever(path.arm)[1]])
    q = q + _whole_turns(path.arm, q, near)
    q[stop + 1 :] = q[stop]
    return Branch(q, elbows, tuple(passed), stop)


def limit_failures(path: Path, branch: Branch) -> list[Failure]:
    """The intervals in which a joint is beyond a limit, their ends refined on the curve."""
    failures = []
    knots, q = path.knots[: branch.stop + 1], branch.q[: branch.stop + 1]
    for joint in range(path.arm.n):
        for bound, sign in ((path.arm.lower[joint], -1.0), (path.arm.upper[joint], 1.0)):
            beyond = sign * (q[:, joint] - bound)
            out = beyond > 0.0
            if out.any() and len(knots) > 1:
                excess = _Excess(path, branch, joint, float(bound))
                failures += failures_of(knots, out, beyond, Reason.JOINT_LIMIT, excess, joint)
    return failures


@dataclass(frozen=True, slots=True)
class _Excess:
    """A joint of the branch less a bound, anywhere between the knots."""

    path: Path
    branch: Branch
    joint: int
    bound: float

    def __call__(self, phi: np.ndarray) -> np.ndarray:
        path, knots = self.path, self.path.knots
        after = np.clip(path.index(phi), 1, len(knots) - 1)
        part = (phi - knots[after - 1]) / (knots[after] - knots[after - 1])
        between = (1.0 - part) * self.branch.q[after - 1, self.joint] + part * self.branch.q[after, self.joint]
        turns = _angles(path, path.curve.position(phi), self.branch.elbow[after])
        q = joints_of_turns(path.arm, [turns[:, 0], turns[:, 1] - tool_lever(path.arm)[1]])[:, self.joint]
        at_knot = (part <= 0.0) | (part >= 1.0)
        return np.where(at_knot, between, np.asarray(_turn_near(q, between))) - self.bound


def _turns(path: Path, elbows: np.ndarray, touches: np.ndarray) -> np.ndarray:
    """Unwrapped angles (first link, second link against the first) at the knots, shape (knots, 2)."""
    turns = _angles(path, path.curve.position(path.knots), elbows)
    on_base = path.radius <= path.tolerance
    last = len(path.knots) - 1
    rows = [turns[:1] if not on_base[0] else _on_base(path, 0, int(elbows[0]), leaving=True)[None]]
    for place in range(1, last + 1):
        if not on_base[place]:
            rows.append(turns[place : place + 1])
            continue
        rows.append(_on_base(path, place, int(elbows[place]), leaving=False)[None])
        if place in touches and place < last:
            rows.append(_on_base(path, place, int(elbows[place + 1]), leaving=True)[None])
    doubled = [p for p in touches.tolist() if on_base[p]]
    whole = np.unwrap(np.concatenate(rows), axis=0)
    keep = np.ones(len(whole), dtype=bool)
    keep[[p + 1 + i for i, p in enumerate(doubled)]] = False
    return np.asarray(whole[keep])


def _angles(path: Path, points: np.ndarray, elbows: np.ndarray) -> np.ndarray:
    triangle = triangle_of(path.arm, points, None)
    first, second = _two_link_inverse(triangle.x, triangle.y, triangle.l1, triangle.l2, elbows.astype(np.float64))
    return np.stack([first, second], axis=-1)


def _passage(path: Path, place: int, elbow: int, at_singular: str) -> tuple[SingularPoint, int]:
    """The singular point at a knot, and the elbow after it."""
    parameter = float(path.knots[place])
    if path.radius[place] > path.tolerance:
        stretched = abs(path.radius[place] - path.outer) <= path.tolerance
        after = -elbow if at_singular == "through" else elbow
        return SingularPoint(parameter, "stretched" if stretched else "folded"), after
    before = _on_base(path, place, elbow, leaving=False)
    turn = {e: float(_wrap(_on_base(path, place, e, leaving=True)[0] - before[0])) for e in (elbow, -elbow)}
    after = min(turn, key=lambda e: abs(turn[e])) if at_singular == "through" else elbow
    return SingularPoint(parameter, "base", turn[after]), after


def _on_base(path: Path, place: int, elbow: int, *, leaving: bool) -> np.ndarray:
    """Angles of the folded arm on its base as the limit along the curve.

    On a straight line through the base the angles before and after differ from those on it by the same amount with
    opposite signs, if the elbow changes: their mean, at any distance, is the limit.
    """
    dx, dy = _direction(path, place, leaving=leaving)
    arm = path.arm
    reach = 0.5 * min(arm.links[0], tool_lever(arm)[0])
    side = np.array([1.0, -1.0]) * (reach if leaving else -reach)
    points = np.stack([arm.base.x + side * dx, arm.base.y + side * dy], axis=-1)
    return np.asarray(np.unwrap(_angles(path, points, np.array([elbow, -elbow])), axis=0).mean(axis=0))


def _direction(path: Path, place: int, *, leaving: bool) -> tuple[float, float]:
    """Unit vector along which the curve leaves the knot, or arrives there."""
    knots, curve = path.knots, path.curve
    other = place + 1 if leaving else place - 1
    beside = knots[place] + NEARBY * (knots[other] - knots[place])
    way = curve.position(beside) - curve.position(knots[place])
    chord = way if leaving else -way
    tangent = curve.derivative(knots[place]) * math.copysign(1.0, knots[-1] - knots[0])
    along = float(chord @ tangent)
    straight = along > (1.0 - NEARBY) * float(np.hypot(*chord) * np.hypot(*tangent))
    dx, dy = tangent if straight else chord
    length = math.hypot(dx, dy)
    return float(dx) / length, float(dy) / length


def _whole_turns(arm: Arm, q: np.ndarray, near: np.ndarray | None) -> np.ndarray:
    """Whole turns of every joint [rad]: the start nearest to ``near``; without it, the trace within its limits.

    Where no turn keeps the whole trace within the limits, the start is.
    """
    start = np.asarray(wind(arm, q[:1], q[:1] if near is None else near[None])[0] - q[0])
    if near is not None:
        return start
    least = np.ceil((arm.lower - q.min(axis=0)) / math.tau)
    most = np.floor((arm.upper - q.max(axis=0)) / math.tau)
    return np.where(least <= most, math.tau * np.minimum(np.maximum(0.0, least), most), start)
