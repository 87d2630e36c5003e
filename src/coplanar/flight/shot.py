"""A shot: a projectile on its way, from its launch on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import components, evaluator, stack
from coplanar.errors import InvalidValue
from coplanar.flight import path as hodograph
from coplanar.flight.impact import Impact, Line
from coplanar.flight.ode import flown
from coplanar.flight.state import Energy, FlightState, Sensitivity, plain
from coplanar.laws import flight as laws

if TYPE_CHECKING:
    from coplanar.flight.projectile import Projectile

_energy = evaluator(laws.energy)

TOO_FAST = 1e150  # [m/s] the square of a speed has to be a number
METHODS = ("hodograph", "ode")


@dataclass(frozen=True, slots=True)
class Shot:
    """A launch of a projectile; or launches of any leading shape. Made by ``Projectile.launch``.

    Near the vertical the derivatives by the angle lose digits, as the rounding over the cosine of the launch angle.

    Attributes:
        projectile: What flies.
        x: Where it starts [m].
        y: [m].
        vx: How it is launched [m/s].
        vy: [m/s].

    Example:
        >>> from coplanar.flight import Projectile
        >>> shot = Projectile(mass=1.0, drag=0.0, gravity=10.0).launch(velocity=(3.0, 20.0))
        >>> shot.at(1.0).position.round(9).tolist()
        [3.0, 15.0]
        >>> round(shot.apex().time, 9), round(shot.impact().time, 9)
        (2.0, 4.0)
    """

    projectile: Projectile
    x: Real
    y: Real
    vx: Real
    vy: Real

    def __post_init__(self) -> None:
        for name in ("x", "y", "vx", "vy"):
            object.__setattr__(self, name, checks.frozen(checks.real(name, getattr(self, name))))
        speed = np.hypot(self.vx, self.vy)
        if not np.all((speed > 0.0) & (speed < TOO_FAST)):
            raise InvalidValue("velocity", (self.vx, self.vy), "a speed greater than 0 and below 1e150 m/s")
        checks.broadcast(x=self.x, y=self.y, vx=self.vx, vy=self.vy, k=self.projectile.drag_per_mass)

    @classmethod
    def _of(cls, projectile: Projectile, *parts: Real) -> Shot:
        """The shot without the checks, of arrays that are nobody else's; NaN where there is no launch."""
        new = object.__new__(cls)
        for name, value in zip(("projectile", "x", "y", "vx", "vy"), (projectile, *parts), strict=True):
            if isinstance(value, np.ndarray):
                value.flags.writeable = False
            object.__setattr__(new, name, value)
        return new

    @property
    def speed(self) -> Real:
        """Speed of launch [m/s]."""
        return plain(np.hypot(self.vx, self.vy))

    @property
    def angle(self) -> Real:
        """Angle of launch from the x axis, counterclockwise [rad]."""
        return plain(np.arctan2(self.vy, self.vx))

    @property
    def velocity(self) -> np.ndarray:
        """Velocity of launch, shape (..., 2) [m/s]."""
        vectors: np.ndarray = stack((self.vx, self.vy))
        return vectors

    @property
    def start(self) -> np.ndarray:
        """Launch point, shape (..., 2) [m]."""
        points: np.ndarray = stack((self.x, self.y))
        return points

    def at(self, time: ArrayLike, *, method: str = "hodograph") -> FlightState:
        """The state at a time since the launch, t(theta) = time solved for the hodograph's parameter.

        Args:
            time: 0 or more [s]; broadcasts with the shots, so many times of N shots have shape (T, 1).
            method: "hodograph", or "ode" for a numerical integration (DOP853 to 1e-13), which shares nothing with it.

        Raises:
            InvalidValue: If a time is negative.
            UnknownName: If the method is neither.

        Example:
            >>> from coplanar.flight import Projectile
            >>> shot = Projectile(mass=1.0, drag=0.1).launch(speed=30.0, angle=0.7)
            >>> abs(shot.at(2.0).x - shot.at(2.0, method="ode").x) < 1e-11
            True
        """
        t = checks.not_negative("time", time, remedy="a shot has no state before its launch")
        checks.broadcast(time=t, velocity=np.hypot(self.vx, self.vy) + np.asarray(self.x) + self.y)
        if checks.choice("method", method, METHODS) == "ode":
            x, y, vx, vy = flown(self.vx, self.vy, self.projectile.drag_per_mass, self.projectile.gravity, t)
            return FlightState(*map(plain, np.broadcast_arrays(t, self.x + x, self.y + y, vx, vy)))
        return self._world(hodograph.at_time(self.path(), t), t)

    def sample(self, duration: ArrayLike, *, count: int = 101) -> FlightState:
        """States at ``count`` equal steps of time from the launch to ``duration`` [s], on a new leading axis.

        Example:
            >>> from coplanar.flight import Projectile
            >>> Projectile(mass=1.0, drag=0.1).launch(speed=[20.0, 30.0], angle=0.7).sample(2.0, count=5).x.shape
            (5, 2)
        """
        end = checks.not_negative("duration", duration)
        if count < 2:
            raise InvalidValue("count", count, "2 or more")
        shape = np.broadcast_shapes(np.shape(end), np.shape(self.speed), np.shape(self.x))
        return self.at(np.linspace(0.0, 1.0, count).reshape(count, *(1,) * len(shape)) * end)

    def apex(self) -> FlightState:
        """The highest point: where the path is level, or the start if the launch goes down.

        Without gravity a path never bends, and the start is returned as well.
        """
        state = hodograph.parallel(self.path(), 1.0, 0.0)
        return self._world(state, state.time)

    def impact(self, level: ArrayLike = 0.0) -> Impact:
        """Where the path comes down through a level, y = level: a root on the descending branch, not a sample.

        Args:
            level: [m].

        Example:
            >>> from coplanar.flight import Projectile
            >>> shot = Projectile(mass=1.0, drag=0.0, gravity=10.0).launch(velocity=(3.0, 20.0), start=(0.0, 1.0))
            >>> round(shot.impact(level=16.0).time, 9), shot.impact(level=22.0).status.name
            (3.0, 'NEVER')
        """
        return Impact.of(self, Line(0.0, checks.real("level", level), 1.0, 0.0))

    def impact_on(self, point: ArrayLike, *, slope: ArrayLike) -> Impact:
        """Where the path crosses a straight slope from above to below.

        Args:
            point: A point of the slope, shape (..., 2) [m].
            slope: Its angle from the x axis, between -pi/2 and pi/2 [rad].

        Raises:
            InvalidValue: If the slope is vertical or overhangs.
        """
        px, py = components(checks.vector("point", point, 2))
        alpha = checks.real("slope", slope)
        if not np.all(np.cos(alpha) > 1e-9):
            raise InvalidValue("slope", slope, "between -pi/2 and pi/2 [rad]", "a vertical wall is impact_at_wall")
        return Impact.of(self, Line(px, py, plain(np.cos(alpha)), plain(np.sin(alpha))))

    def impact_at_wall(self, x: ArrayLike) -> Impact:
        """Where the path comes to the vertical line x, in [m]; with drag no path passes its vertical asymptote."""
        wall = checks.real("x", x)
        return Impact.of(self, Line(wall, 0.0, 0.0, self.side))

    def energy(self, time: ArrayLike) -> Energy:
        """Kinetic and potential energy at a time, and what drag has taken since the launch [J]."""
        g, m, now = self.projectile.gravity, self.projectile.mass, self.at(time)
        kinetic, potential = _energy(m, now.y, now.vx, now.vy, g)
        at_launch = sum(_energy(m, self.y, self.vx, self.vy, g))
        return Energy(kinetic, potential, at_launch - kinetic - potential)

    def sensitivity(self, time: ArrayLike) -> Sensitivity:
        """How the position at a time moves with the speed and the angle of the launch: the hodograph differentiated."""
        state = hodograph.at_time(self.path(), checks.not_negative("time", time))
        x_v, y_v, x_psi, y_psi = hodograph.by_launch(self.path(), state)
        side = self.side
        # Towards negative x the angle from the x axis is pi - psi.
        return Sensitivity(stack((side * x_v, y_v)), stack((x_psi, side * y_psi)))

    @property
    def side(self) -> Real:
        """1 where the launch goes to greater x or straight up, -1 where it goes to smaller x."""
        return plain(np.where(np.asarray(self.vx) < 0.0, -1.0, 1.0))

    def path(self) -> hodograph.Path:
        """The launch in its own frame, for ``coplanar.flight.path``."""
        speed = np.hypot(self.vx, self.vy)
        k, g = self.projectile.drag_per_mass, self.projectile.gravity
        return hodograph.Path(plain(speed), plain(np.abs(self.vx) / speed), plain(self.vy / speed), k, g)

    def _world(self, state: hodograph.State, time: Any) -> FlightState:
        side = self.side
        parts = (time, self.x + side * state.x, self.y + state.y, side * state.vx, state.vy)
        return FlightState(*map(plain, np.broadcast_arrays(*parts)))
