"""How far a speed reaches, and which launch through a target forgives its errors best."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import components, evaluator, stack
from coplanar.errors import InvalidValue
from coplanar.flight.forms import UPRIGHT, Way
from coplanar.flight.path import by_launch
from coplanar.flight.sight import Sight
from coplanar.flight.state import plain
from coplanar.laws import flight as laws
from coplanar.laws.aiming import farthest

if TYPE_CHECKING:
    from coplanar.flight.aiming import Aim
    from coplanar.flight.projectile import Projectile

Row = Any

_climb_height = evaluator(laws.climb_height)
_miss_across = evaluator(laws.miss_across)

FIRST_GRID = 33  # launches compared at first, between the lofted and the flat one at the greatest speed
NEXT_GRID = 9  # and between the neighbours of the best so far
ZOOMS = 8  # each narrows the neighbours four times
FASTER = 20.0  # times the least speed: the fastest launch that is compared where no greatest speed is given


class Reach(NamedTuple):
    """The launch that goes farthest along a slope.

    Attributes:
        angle: Of the launch, from the x axis [rad].
        distance: Along the slope; infinite without gravity [m].
        slope: Its angle from the x axis [rad].
    """

    angle: Real
    distance: Real
    slope: Real

    @property
    def point(self) -> np.ndarray:
        """The end, from the launch point, shape (..., 2) [m]."""
        end: np.ndarray = stack((self.distance * np.cos(self.slope), self.distance * np.sin(self.slope)))
        return end


@dataclass(frozen=True, slots=True)
class Tolerant:
    """The launch through a target that forgives errors of speed and angle best.

    Attributes:
        aim: The launch; its status says no where even the greatest speed does not reach the target.
        miss: Standard deviation of the distance by which the path passes the target, to first order [m].
        at_limit: Whether it is one of the fastest launches compared: a faster one would do still better.
    """

    aim: Aim
    miss: Real
    at_limit: Any


def furthest(projectile: Projectile, speed: ArrayLike, slope: ArrayLike) -> Reach:
    """The best angle and the range along a slope; straight up it is the height of the climb."""
    v, alpha = checks.positive("speed", speed), checks.real("slope", slope)
    k, g = projectile.drag_per_mass, projectile.gravity
    checks.broadcast(speed=v, slope=alpha, k=k)
    if not (np.all(np.greater(alpha, -0.5 * np.pi)) and np.all(np.less_equal(alpha, 0.5 * np.pi))):
        raise InvalidValue("slope", slope, "in (-pi/2, pi/2] [rad]", "straight down everything is reached")
    v, alpha, k, g = np.broadcast_arrays(v, alpha, k, g)
    upright, weightless = np.cos(alpha) <= UPRIGHT, g <= 0.0
    special = upright | weightless
    level = np.where(special, 0.0, alpha)
    sight = Sight(np.cos(level), np.sin(level), np.where(special, 0.0, k), np.where(special, 1.0, g))
    zenith, most = _farthest(v, sight)
    height = _climb_height(v, np.where(weightless, 0.0, k), np.where(weightless, 1.0, g))
    distance = np.where(weightless, np.inf, np.where(upright, height, most))
    return Reach(plain(np.where(special, alpha, 0.5 * np.pi - zenith)), plain(distance), plain(alpha))


def _farthest(speed: Row, sight: Sight) -> tuple[Row, Row]:
    """The best angle from the zenith and its range; what the search does not settle, the nested one finds."""
    zenith, most, _, _, known = farthest(speed, *sight)
    lost = np.asarray(known) <= 0.0
    if not lost.any():
        return zenith, most
    best, range_ = sight.farthest(speed)
    return np.where(lost, best, zenith), np.where(lost, range_.distance, most)


def most_tolerant(
    projectile: Projectile,
    target: ArrayLike,
    start: ArrayLike,
    sigma_angle: float,
    sigma_speed: float,
    max_speed: float,
) -> Tolerant:
    """The least standard deviation of the miss among the launches from the flat to the lofted one at the top speed."""
    spread = checks.not_negative("sigma_speed", sigma_speed), checks.not_negative("sigma_angle", sigma_angle)
    if not any(spread):
        raise InvalidValue(
            "sigma_speed and sigma_angle", spread, "one greater than 0", "without errors every hit is one"
        )
    if not max_speed > 0.0:
        raise InvalidValue("max_speed", max_speed, "greater than 0")
    (tx, ty), (sx, sy) = (components(checks.vector(n, p, 2)) for n, p in (("target", target), ("start", start)))
    x, y, k, g = (
        np.asarray(a) for a in np.broadcast_arrays(tx - sx, ty - sy, projectile.drag_per_mass, projectile.gravity)
    )
    way = Way(np.abs(x), y, k, g)
    if np.any(way.upright | way.weightless):
        raise InvalidValue(
            "target", target, "aside of the launch point, under gravity", "straight shots leave no choice"
        )
    least = np.asarray(projectile.aim(target, start=start).low.speed)
    top = np.minimum(max_speed, FASTER * least)
    within = top >= least
    with np.errstate(all="ignore"):
        zenith, miss, edge = _search(way, np.maximum(top, least), spread)
    angle = np.where(x < 0.0, 0.5 * np.pi + zenith, 0.5 * np.pi - zenith)
    aim = projectile.aim(target, angle=plain(angle), start=start)
    if not within.all():
        aim = aim.where(within, projectile.aim(target, speed=plain(top), start=start))
    return Tolerant(aim, plain(np.where(within, miss, np.inf)), _flag(edge & within))


def _search(way: Way, top: Any, spread: tuple[Real, Real]) -> tuple[Any, Any, Any]:
    """The zenith angle of the least miss: the best of a grid, then of finer ones between its neighbours."""
    sight, length = way.ordinary()
    low, high, _, _ = sight.both(length, top)
    wide = Sight(*(np.asarray(a)[..., None] for a in sight))
    left, right, count = high, low, FIRST_GRID
    for _ in range(ZOOMS + 1):
        zenith = left[..., None] + (right - left)[..., None] * np.linspace(0.0, 1.0, count)
        speed = wide.speed_for(length[..., None], zenith)
        end = wide.reach(speed, zenith).end
        spreads = _miss_across(*by_launch(wide.path(speed, zenith), end), end.vx, end.vy, *spread)
        best = np.argmin(spreads, axis=-1)[..., None]
        left = np.take_along_axis(zenith, np.maximum(best - 1, 0), -1)[..., 0]
        right = np.take_along_axis(zenith, np.minimum(best + 1, count - 1), -1)[..., 0]
        count = NEXT_GRID
    found, miss = (np.take_along_axis(a, best, -1)[..., 0] for a in (zenith, spreads))
    edge = (np.abs(found - high) <= 1e-3 * (low - high)) | (np.abs(found - low) <= 1e-3 * (low - high))
    return found, miss, edge


def _flag(rows: Any) -> Any:
    return bool(rows) if np.ndim(rows) == 0 else rows
