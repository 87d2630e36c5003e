"""Where the links of an arm are, how they move, and the columns of its Jacobian: loops over links, batches in rows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from coplanar.checks import Real
from coplanar.engine import components, evaluator
from coplanar.engine.linkage import Linkage
from coplanar.laws import arms as laws
from coplanar.laws import se2, squares

if TYPE_CHECKING:
    from coplanar.arms.chain import Chain

Point = tuple[Real, Real]
Column = tuple[Real, Real, float]

_act = evaluator(se2.act)
_link = evaluator(laws.joint_link)
_link_velocity = evaluator(laws.link_velocity)
_prismatic_column = evaluator(laws.prismatic_column)
_prismatic_column_rate = evaluator(laws.prismatic_column_rate)
_revolute_column = evaluator(laws.revolute_column)
_rotate = evaluator(se2.rotate)

linkage = Linkage(
    link=laws.joint_link,
    act=se2.act,
    revolute=laws.revolute_column,
    prismatic=laws.prismatic_column,
    task_error=laws.task_error,
    damping=squares.damping,
    free=squares.free,
    solve_three=squares.solve_three,
    shortening=squares.shortening,
    gain=squares.gain,
    adapted=squares.adapted,
    still=squares.still,
)


@dataclass(frozen=True, slots=True, eq=False)
class Texts:
    """The laws of a posture in the form that serves its joints best."""

    link: Callable[..., Any]
    act: Callable[..., Any]
    revolute: Callable[..., Any]
    prismatic: Callable[..., Any]


_LAWS = (_link, _act, _revolute_column, _prismatic_column)
_ON_FLOATS = Texts(*(law.on_floats for law in _LAWS))
_ON_ROWS = Texts(*(law.law for law in _LAWS))
_ON_ALL = Texts(*_LAWS)


@dataclass(slots=True, eq=False)
class Posture:
    """The links of an arm in the world.

    Attributes:
        parts: Joints, one entry each.
        angles: Direction of every link [rad].
        points: The base, then the end of every link [m].
        tip: The tool's origin [m].
        texts: Which evaluated them.
    """

    parts: Any
    angles: list[Real]
    points: list[Point]
    tip: Point
    texts: Texts

    @classmethod
    def of(cls, chain: Chain, q: Any) -> Posture:
        """The posture at checked joints q, shape (..., n)."""
        parts = q if type(q) is list else components(q)
        if type(parts[0]) is float:
            try:
                return cls._through(chain, parts, _ON_FLOATS)
            except ValueError:  # a sum of joints is infinite, and has no sine
                return cls._through(chain, parts, _ON_ALL)
        return cls._through(chain, parts, _ON_ROWS if type(parts[0]) is np.ndarray else _ON_ALL)

    @classmethod
    def _through(cls, chain: Chain, parts: Any, texts: Texts) -> Posture:
        """From link to link."""
        link, plan = texts.link, chain.plan
        x, y, angle = chain.base.x, chain.base.y, chain.base.theta
        angles: list[Real] = []
        points: list[Point] = [(x, y)]
        for value, (carry, turns, bend, length, slides) in zip(parts, plan.joints, strict=True):
            x, y, angle = link(x, y, angle, value, carry, turns, bend, length, slides)
            angles.append(angle)
            points.append((x, y))
        tip = texts.act(x, y, angle, chain.tool.x, chain.tool.y) if plan.mounted else (x, y)
        return cls(parts, angles, points, tip, texts)


def columns(chain: Chain, posture: Posture) -> list[Column]:
    """(dx/dq_j, dy/dq_j, dtheta/dq_j) for every joint j."""
    texts, plan = posture.texts, chain.plan
    places = [*posture.points[:-1], posture.tip]
    table: list[Column] = []
    for i, (joint, end, turn) in enumerate(zip(plan.joints, plan.ends, plan.turns_tool, strict=True)):
        if joint[1]:
            table.append((*texts.revolute(*posture.points[i], *places[end]), turn))
        else:
            table.append((*texts.prismatic(posture.angles[i]), 0.0))
    return table


def column_rates(chain: Chain, posture: Posture, rates: Any) -> list[Column]:
    """Time derivatives of the columns at the joint rates."""
    omegas, velocities, tip = _motion(chain, posture, rates)
    places = [*velocities[:-1], tip]
    table: list[Column] = []
    for i, (joint, end) in enumerate(zip(chain.joints, chain.plan.ends, strict=True)):
        if joint == "R":
            table.append((*_revolute_column(*velocities[i], *places[end]), 0.0))
        else:
            table.append((*_prismatic_column_rate(posture.angles[i], omegas[i]), 0.0))
    return table


def _motion(chain: Chain, posture: Posture, rates: Any) -> tuple[list[Real], list[Point], Point]:
    """Turning rate of every link, velocity of every point and of the tip."""
    omegas: list[Real] = []
    velocities: list[Point] = [(0.0, 0.0)]
    omega: Real = 0.0
    rows = zip(chain.plan.joints, components(rates), posture.parts, posture.angles, strict=True)
    for (carry, turns, _, length, slides), rate, value, angle in rows:
        omega = carry * omega + turns * rate
        omegas.append(omega)
        velocities.append(_link_velocity(*velocities[-1], angle, omega, length + slides * value, slides * rate))
    lever = _rotate(posture.angles[-1], chain.tool.x, chain.tool.y)
    (vx, vy), (wx, wy) = velocities[-1], _revolute_column(0.0, 0.0, *lever)
    return omegas, velocities, (vx + omega * wx, vy + omega * wy)
