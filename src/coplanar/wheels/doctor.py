"""The wheel-layout doctor: what is wrong with a table of wheels, or worth knowing, in sentences."""

from __future__ import annotations

import enum
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from math import hypot

import numpy as np

from coplanar.engine import evaluator
from coplanar.laws import wheels as laws
from coplanar.wheels import words
from coplanar.wheels.mobility import Mobility
from coplanar.wheels.wheel import Wheel

_rolling_row = evaluator(laws.rolling_row)


class FindingKind(enum.Enum):
    """What a finding is about."""

    FORBIDDEN = "ordinary wheels forbid a motion"
    UNDRIVEN = "no wheel drives or holds a motion"
    WEAK = "a motion is driven weakly"
    MIRRORED_ROLLERS = "the rollers look mirrored"
    COINCIDENT = "wheels stand on one point"
    REDUNDANCY = "how many wheels are redundant"


NOTES = frozenset((FindingKind.FORBIDDEN, FindingKind.REDUNDANCY))


@dataclass(frozen=True, slots=True)
class Finding:
    """One sentence about a base.

    Attributes:
        kind: What it is about.
        sentence: With the wheels and numbers it rests on.
    """

    kind: FindingKind
    sentence: str

    def __str__(self) -> str:
        return self.sentence

    @property
    def is_fault(self) -> bool:
        """Whether somebody should change the base; the others are worth knowing."""
        return self.kind not in NOTES


def findings(
    wheels: tuple[Wheel, ...], lateral: np.ndarray, mobility: Mobility, *, worst_condition: float, same_place: float
) -> Iterator[Finding]:
    """Everything the doctor has to say, faults and notes, in a fixed order."""
    yield from forbidden(wheels, lateral, mobility)
    yield from undriven(wheels, mobility)
    yield from _weak(mobility, worst_condition)
    yield from _mirrored(wheels)
    yield from _coincident(wheels, same_place)
    yield _redundancy(wheels, mobility)


def forbidden(wheels: tuple[Wheel, ...], lateral: np.ndarray, mobility: Mobility) -> Iterator[Finding]:
    """What the ordinary wheels forbid."""
    names = words.listed([wheel.name for wheel in wheels if wheel.is_ordinary])
    if mobility.constraint_rank == 1:
        yield Finding(FindingKind.FORBIDDEN, f"cannot {words.sliding(lateral[0])}: {names} would slide")
    elif mobility.constraint_rank == 2:
        only = words.motion(mobility.free[0], mobility.length)
        yield Finding(FindingKind.FORBIDDEN, f"cannot do anything but {only}: one of {names} would slide")
    elif mobility.constraint_rank == 3:
        yield Finding(FindingKind.FORBIDDEN, f"cannot move at all: the axles of {names} meet in no common point")


def undriven(wheels: tuple[Wheel, ...], mobility: Mobility) -> Iterator[Finding]:
    """What no wheel drives, and why."""
    if mobility.rank == 3:
        return
    if mobility.rank == 1:
        motion = f"turn about any point of the line of traction through {words.point(wheels[0].x, wheels[0].y)}"
        cause = "there is no other line of traction"
    else:
        motion = words.motion(mobility.undriven[0], mobility.length)
        cause = _cause(mobility.undriven[0], mobility.length)
    yield Finding(FindingKind.UNDRIVEN, f"nothing drives or holds it to {motion}: {cause} (rank {mobility.rank} of 3)")


def _cause(twist: np.ndarray, length: float, tolerance: float = 1e-6) -> str:
    """A twist that turns no wheel: every line of traction passes through its centre, or stands across its motion."""
    vx, vy, omega = twist.tolist()
    if abs(omega) * length <= tolerance:
        return f"all lines of traction are parallel, {words.direction(-vy, vx)}"
    return f"all lines of traction pass through {words.point(-vy / omega, vx / omega)}"


def _weak(mobility: Mobility, worst_condition: float) -> Iterator[Finding]:
    if mobility.rank == 3 and mobility.condition > worst_condition:
        weakest = words.motion(mobility.weakest, mobility.length)
        yield Finding(
            FindingKind.WEAK,
            f"to {weakest} is driven weakly: condition number {mobility.condition:.3g}, above {worst_condition:g}",
        )


def _mirrored(wheels: tuple[Wheel, ...]) -> Iterator[Finding]:
    rolled = [wheel for wheel in wheels if wheel.roller_angle]
    if not rolled:
        return
    lever, mirrored = _lever(rolled, 1.0), _lever(rolled, -1.0)
    if lever < mirrored * (1.0 - 1e-9):
        names = words.listed([wheel.name for wheel in rolled])
        yield Finding(
            FindingKind.MIRRORED_ROLLERS,
            f"the rollers of {names} turn the base by a lever of {round(lever, 9):.4g} m, "
            f"mirrored ones by {mirrored:.4g} m: mecanum wheels are mounted as X seen from above, these as O",
        )


def _lever(wheels: list[Wheel], sign: float) -> float:
    """Root mean square of the omega entries of the rolling rows [m]."""
    rows = [_rolling_row(w.x, w.y, w.drive_angle, sign * (w.roller_angle or 0.0)) for w in wheels]
    return float(np.sqrt(np.mean([row[2] ** 2 for row in rows])))


def _coincident(wheels: tuple[Wheel, ...], same_place: float) -> Iterator[Finding]:
    for one, other in combinations(wheels, 2):
        if hypot(one.x - other.x, one.y - other.y) <= same_place:
            yield Finding(
                FindingKind.COINCIDENT,
                f"{one.name} and {other.name} stand on one point, {words.point(one.x, one.y)}: check the table",
            )


def _redundancy(wheels: tuple[Wheel, ...], mobility: Mobility) -> Finding:
    spare = len(wheels) - mobility.degrees_of_control
    if spare == 0:
        return Finding(FindingKind.REDUNDANCY, "no wheel is redundant: slip cannot be seen from the rates")
    count = "one wheel is" if spare == 1 else f"{spare} wheels are"
    return Finding(FindingKind.REDUNDANCY, f"{count} redundant: slip shows as a residual of the rates")
