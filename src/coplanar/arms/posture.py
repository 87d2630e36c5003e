"""Where the links of an arm are, how they move, and the columns of its Jacobian: loops over links, batches in rows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from coplanar.checks import Real
from coplanar.engine import components, evaluator
from coplanar.laws import arms as laws
from coplanar.laws import se2

if TYPE_CHECKING:
    from coplanar.arms.chain import Chain

Point = tuple[Real, Real]

_act = evaluator(se2.act)
_link = evaluator(laws.link)
_link_velocity = evaluator(laws.link_velocity)
_prismatic_column = evaluator(laws.prismatic_column)
_prismatic_column_rate = evaluator(laws.prismatic_column_rate)
_revolute_column = evaluator(laws.revolute_column)
_rotate = evaluator(se2.rotate)


@dataclass(frozen=True, slots=True)
class Posture:
    """The links of an arm in the world.

    Attributes:
        angles: Direction of every link [rad].
        lengths: Length of every link, extensions included [m].
        points: The base, then the end of every link [m].
        tip: The tool's origin [m].
    """

    angles: list[Real]
    lengths: list[Real]
    points: list[Point]
    tip: Point

    @classmethod
    def of(cls, chain: Chain, q: Any) -> Posture:
        """The posture at checked joints q, shape (..., n)."""
        parts = components(q)
        angles = directions(chain, parts)
        lengths = [
            length + v if j == "P" else length for j, v, length in zip(chain.joints, parts, chain.links, strict=True)
        ]
        points: list[Point] = [(chain.base.x, chain.base.y)]
        for angle, length in zip(angles, lengths, strict=True):
            points.append(_link(*points[-1], angle, length))
        return cls(angles, lengths, points, _act(*points[-1], angles[-1], chain.tool.x, chain.tool.y))

    def ends(self, chain: Chain) -> list[Point]:
        """For every joint the last point that turns with it as one rigid body: the tool, or the next absolute joint."""
        places = [*self.points[:-1], self.tip]
        return [places[i] for i in _last_turned(chain)]


def directions(chain: Chain, parts: Any) -> list[Real]:
    """Direction of every link in the world: phi_i = phi_(i-1) + q_i + bend_i, or base + q_i + bend_i if absolute."""
    angles: list[Real] = []
    angle = chain.base.theta + 0.0 * parts[0]  # slides alone turn nothing, and still have the shape of the batch
    for joint, value, bend in zip(chain.joints, parts, chain.bends, strict=True):
        if joint == "R":
            angle = (chain.base.theta if chain.angles == "absolute" else angle) + value
        angle = angle + bend
        angles.append(angle)
    return angles


def columns(chain: Chain, posture: Posture) -> list[tuple[Real, Real, float]]:
    """(dx/dq_j, dy/dq_j, dtheta/dq_j) for every joint j."""
    table: list[tuple[Real, Real, float]] = []
    for i, (joint, end) in enumerate(zip(chain.joints, posture.ends(chain), strict=True)):
        if joint == "R":
            table.append((*_revolute_column(*posture.points[i], *end), turns_tool(chain, i)))
        else:
            table.append((*_prismatic_column(posture.angles[i]), 0.0))
    return table


def column_rates(chain: Chain, posture: Posture, rates: Any) -> list[tuple[Real, Real, float]]:
    """Time derivatives of the columns at the joint rates."""
    omegas, velocities, tip = _motion(chain, posture, rates)
    places = [*velocities[:-1], tip]
    table: list[tuple[Real, Real, float]] = []
    for i, (joint, last) in enumerate(zip(chain.joints, _last_turned(chain), strict=True)):
        if joint == "R":
            table.append((*_revolute_column(*velocities[i], *places[last]), 0.0))
        else:
            table.append((*_prismatic_column_rate(posture.angles[i], omegas[i]), 0.0))
    return table


def _motion(chain: Chain, posture: Posture, rates: Any) -> tuple[list[Real], list[Point], Point]:
    """Turning rate of every link, velocity of every point and of the tip."""
    omegas: list[Real] = []
    velocities: list[Point] = [(0.0, 0.0)]
    omega: Real = 0.0
    rows = zip(chain.joints, components(rates), posture.angles, posture.lengths, strict=True)
    for joint, rate, angle, length in rows:
        if joint == "R":
            omega = rate if chain.angles == "absolute" else omega + rate
        omegas.append(omega)
        velocities.append(_link_velocity(*velocities[-1], angle, omega, length, rate if joint == "P" else 0.0))
    lever = _rotate(posture.angles[-1], chain.tool.x, chain.tool.y)
    (vx, vy), (wx, wy) = velocities[-1], _revolute_column(0.0, 0.0, *lever)
    return omegas, velocities, (vx + omega * wx, vy + omega * wy)


def _last_turned(chain: Chain) -> list[int]:
    """For every joint the index of the last point that it turns; n stands for the tool."""
    n = len(chain.joints)
    if chain.angles == "relative":
        return [n] * n
    return [next((k for k in range(i + 1, n) if chain.joints[k] == "R"), n) for i in range(n)]


def turns_tool(chain: Chain, i: int) -> float:
    """1 if joint i turns the tool, else 0: dtheta/dq_i."""
    return 1.0 if chain.joints[i] == "R" and _last_turned(chain)[i] == len(chain.joints) else 0.0
