"""Aiming: what launch sends a projectile through a target, and what is in the way where none does."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, sin
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import components, stack
from coplanar.errors import InvalidInput, InvalidValue, NoSolution
from coplanar.flight import forms, reach
from coplanar.flight.answers import answers
from coplanar.flight.forms import AimStatus
from coplanar.flight.shot import Shot
from coplanar.flight.state import FlightState, plain
from coplanar.solving import count_by_status, status_of

if TYPE_CHECKING:
    from coplanar.flight.projectile import Projectile


class Arc(NamedTuple):
    """One launch and how long it flies.

    Attributes:
        shot: The launch; NaN in the rows where there is none.
        time: Flight time to the target, or to where the flight comes nearest in the sense of the status [s].
    """

    shot: Shot
    time: Real

    @property
    def angle(self) -> Real:
        """Angle of launch from the x axis [rad]."""
        return self.shot.angle

    @property
    def speed(self) -> Real:
        """Speed of launch [m/s]."""
        return self.shot.speed

    @property
    def velocity(self) -> np.ndarray:
        """Velocity of launch, shape (..., 2) [m/s]."""
        return self.shot.velocity

    def arrival(self) -> FlightState:
        """The state at the end, flown anew; NaN in the rows where there is no launch."""
        there = np.isfinite(np.asarray(self.time))
        vx, vy = np.where(there, self.shot.vx, 1.0), np.where(there, self.shot.vy, 0.0)
        flown = Shot._of(self.shot.projectile, self.shot.x, self.shot.y, vx, vy).at(np.where(there, self.time, 0.0))
        return FlightState(*(plain(np.where(there, part, np.nan)) for part in flown))


@dataclass(frozen=True, slots=True)
class Aim:
    """The answer of ``Projectile.aim``; the leading axes are those of the targets.

    Attributes:
        projectile: What flies.
        start: Launch point, shape (..., 2) [m].
        target: Shape (..., 2) [m].
        code: Place of the status in ``AimStatus``, an int or an array of them.
        low: The low arc: the flatter launch, the shorter flight.
        high: The lofted arc; the low one again where only one launch exists.
        top_speed: The speed that was given; infinite where none was [m/s].
        shortfall: How far the target is beyond ``furthest`` at the given speed, or aside of the line of the launch at
            the given angle; 0 where it is hit [m].
    """

    projectile: Projectile
    start: np.ndarray
    target: np.ndarray
    code: Any
    low: Arc
    high: Arc
    top_speed: Real
    shortfall: Real

    @property
    def status(self) -> Any:
        """An ``AimStatus``, or an object array of them for a batch."""
        return status_of(AimStatus, self.code)

    @property
    def hit(self) -> Any:
        """Whether there is a launch through the target; an array of bool for a batch."""
        return self.code == forms.HIT

    @property
    def angles(self) -> np.ndarray:
        """Angles of launch, low and high, shape (..., 2) [rad]."""
        angles: np.ndarray = stack((self.low.angle, self.high.angle))
        return angles

    def miss(self) -> Real:
        """Distance from the target at the end of the flight, flown anew: the worse arc; infinite without launch [m]."""
        ends = [arc.arrival().position for arc in (self.low, self.high)]
        worst = np.maximum(*(np.hypot(*np.moveaxis(end - self.target, -1, 0)) for end in ends))
        return plain(np.where(np.isnan(worst), np.inf, worst))

    @property
    def furthest(self) -> Real:
        """How far the given speed goes in the direction of the target; infinite where that is not limited [m].

        Worked out when asked.
        """
        (tx, ty), (sx, sy) = components(self.target), components(self.start)
        slope = np.arctan2(ty - sy, np.abs(tx - sx))
        limited = np.isfinite(self.top_speed) & (slope > -0.5 * np.pi)
        if not limited.any():
            return plain(np.full(limited.shape, np.inf))
        speed, slope = np.where(limited, self.top_speed, 1.0), np.where(limited, slope, 0.0)
        return plain(np.where(limited, reach.furthest(self.projectile, speed, slope).distance, np.inf))

    def least(self) -> Aim:
        """The launch of least speed through the same target: what a target that is out of reach needs."""
        return self.projectile.aim(self.target, start=self.start)

    @property
    def least_speed(self) -> Real:
        """The least speed that reaches the target; 0 where every speed does [m/s]."""
        least = self.least()
        return plain(np.where(least.code == forms.ANY_SPEED, 0.0, least.low.speed))

    def where(self, rows: Any, other: Aim) -> Aim:
        """This answer in the rows that are True, the other one elsewhere; both are for the same targets."""
        arcs = [
            _arc(self.projectile, tuple(components(self.start)), _chosen(rows, one, two))
            for one, two in ((self.low, other.low), (self.high, other.high))
        ]
        code = np.where(rows, self.code, other.code)
        numbers = [
            plain(np.where(rows, one, two))
            for one, two in ((self.top_speed, other.top_speed), (self.shortfall, other.shortfall))
        ]
        return Aim(self.projectile, self.start, self.target, int(code) if code.ndim == 0 else code, *arcs, *numbers)

    def sentence(self) -> str:
        """The status in a sentence with its numbers; the counts of each status for a batch."""
        text = count_by_status(AimStatus, self.code)
        short = float(np.max(self.shortfall, initial=0.0))
        return f"{text}; short by {short:.6g} m" if short else text

    def or_raise(self) -> Aim:
        """This answer if every target is hit.

        Raises:
            NoSolution: With the sentence and this answer, if one is not.
        """
        if not np.all(self.hit):
            raise NoSolution(self.sentence(), self)
        return self


def aim(
    projectile: Projectile, target: ArrayLike, start: ArrayLike, time: Any = None, speed: Any = None, angle: Any = None
) -> Aim:
    """The launch through a target for one of flight time, speed, angle; of least speed for none of them."""
    given = {name: value for name, value in (("time", time), ("speed", speed), ("angle", angle)) if value is not None}
    if len(given) > 1:
        raise InvalidInput(" and ".join(given), tuple(given.values()), "one of time, speed, angle, or none of them")
    tx, ty = components(checks.vector("target", target, 2))
    sx, sy = map(checks.frozen, components(checks.vector("start", start, 2)))
    name, value = next(iter(given.items()), ("nothing", 1.0))
    check = checks.real if name == "angle" else checks.positive
    number = check(name, value)
    k, g = projectile.drag_per_mass, projectile.gravity
    shape = checks.broadcast(target=tx, start=sx, k=k, **{name: number})
    if name == "speed" and (alone := _one(projectile, (sx, sy), (tx, ty), number)):
        return alone
    found = answers(name, [tx, ty, sx, sy, k, g, number], shape)
    if found.lost_point:
        raise InvalidValue(
            "target", target, "a point away from the launch point", "only a flight time leads back to it"
        )
    low, high = (_arc(projectile, (sx, sy), arc) for arc in (found.low, found.high))
    begin, end = (_spread(stack(point), (*shape, 2)) for point in ((sx, sy), (tx, ty)))
    top = _spread(number if name == "speed" else np.inf, shape)
    code = found.code if shape else int(found.code)
    return Aim(projectile, begin, end, code, low, high, plain(top), plain(found.shortfall))


def _one(projectile: Projectile, start: tuple[Real, ...], target: tuple[Real, ...], speed: Real) -> Aim | None:
    """The answer to one ordinary target, without arrays; None where it is not that."""
    numbers = (*start, *target, projectile.drag_per_mass, projectile.gravity, speed)
    if not all(type(number) is float for number in numbers):
        return None
    sx, sy, tx, ty, k, g, _ = numbers
    side = -1.0 if tx < sx else 1.0
    found = forms.one_by_speed(side * (tx - sx), ty - sy, k, g, speed)
    if found is None:
        return None
    low, high, code, most = found
    one, two = (
        Arc(Shot._of(projectile, sx, sy, side * speed * sin(z), speed * cos(z)), time) for z, time in (low, high)
    )
    short = hypot(tx - sx, ty - sy) - most if code == forms.OUT_OF_REACH else 0.0
    begin, end = (checks.frozen(np.array(point)) for point in (start, target))
    return Aim(projectile, begin, end, code, one, two, speed, short)


def _arc(projectile: Projectile, start: tuple[Real, ...], arc: Any) -> Arc:
    vx, vy, time = map(plain, arc)
    return Arc(Shot._of(projectile, *start, vx, vy), time)


def _spread(value: Any, shape: tuple[int, ...]) -> np.ndarray:
    """A copy of the value, seen in a shape."""
    return np.broadcast_to(checks.frozen(np.asarray(value)), shape)


def _chosen(rows: Any, yes: Arc, no: Arc) -> list[Any]:
    pairs = ((yes.shot.vx, no.shot.vx), (yes.shot.vy, no.shot.vy), (yes.time, no.time))
    return [np.where(rows, a, b) for a, b in pairs]
