"""A projectile: mass, drag, gravity; what it can be asked."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import components, evaluator
from coplanar.errors import InvalidInput, InvalidValue
from coplanar.flight import aiming, reach
from coplanar.flight.aiming import Aim
from coplanar.flight.reach import Reach, Tolerant
from coplanar.flight.shot import TOO_FAST, Shot
from coplanar.flight.state import plain
from coplanar.laws import landing as laws

_launch_velocity = evaluator(laws.launch_velocity)

HERE = (0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Projectile:
    """A point mass under gravity and quadratic drag, m a = -m g y - C |v| v.

    C [kg/m] is not k = C/m [1/m], nor the drag coefficient: ``from_drag_per_mass`` and ``from_area`` take those. Only k
    and g matter to the path, the mass to the energies. Arrays are many projectiles.

    Attributes:
        mass: m [kg].
        drag: C, the drag force over the square of the speed [kg/m]; 0 flies a parabola.
        gravity: g, downwards [m/s^2]; 0 flies straight.

    Example:
        >>> ball = Projectile(mass=1.0, drag=0.02)
        >>> shot = ball.launch(speed=30.0, angle=0.7)
        >>> round(shot.impact().state.x, 6)
        42.181898
        >>> round(ball.aim((30.0, 2.0), speed=30.0).low.angle, 6)
        0.343748
    """

    mass: Real
    drag: Real
    gravity: Real = 9.81

    def __post_init__(self) -> None:
        values = {
            "mass": checks.positive("mass", self.mass),
            "drag": checks.not_negative("drag", self.drag, remedy="drag is C in the force -C |v| v [kg/m]"),
            "gravity": checks.not_negative("gravity", self.gravity, remedy="gravity points down; give its size"),
        }
        checks.broadcast(**values)
        for name, value in values.items():
            object.__setattr__(self, name, checks.frozen(value))

    @classmethod
    def from_drag_per_mass(
        cls, drag_per_mass: ArrayLike, *, mass: ArrayLike = 1.0, gravity: ArrayLike = 9.81
    ) -> Projectile:
        """From k = C/m [1/m].

        Example:
            >>> Projectile.from_drag_per_mass(0.02, mass=0.5).drag
            0.01
        """
        k = checks.not_negative("drag_per_mass", drag_per_mass, remedy="drag_per_mass is k = C/m [1/m]")
        m = checks.positive("mass", mass)
        checks.broadcast(drag_per_mass=k, mass=m)
        return cls(m, k * m, gravity)

    @classmethod
    def from_area(
        cls,
        mass: ArrayLike,
        *,
        drag_coefficient: ArrayLike,
        area: ArrayLike,
        air_density: ArrayLike = 1.225,
        gravity: ArrayLike = 9.81,
    ) -> Projectile:
        """From C = c_d rho A/2.

        Args:
            mass: [kg].
            drag_coefficient: c_d, about 0.47 for a sphere [1].
            area: Cross section across the flow [m^2].
            air_density: rho, by default of air at sea level and 15 degrees Celsius [kg/m^3].
            gravity: [m/s^2].

        Example:
            >>> round(Projectile.from_area(0.0027, drag_coefficient=0.47, area=0.001257).drag, 9)  # table tennis
            0.000361859
        """
        c_d = checks.not_negative("drag_coefficient", drag_coefficient)
        surface, rho = checks.not_negative("area", area), checks.not_negative("air_density", air_density)
        checks.broadcast(drag_coefficient=c_d, area=surface, air_density=rho)
        return cls(mass, 0.5 * rho * c_d * surface, gravity)

    @property
    def drag_per_mass(self) -> Real:
        """Drag over mass, k = C/m [1/m]."""
        return self.drag / self.mass

    @property
    def terminal_speed(self) -> Real:
        """Speed at which drag holds the weight, sqrt(g/k); infinite without drag [m/s].

        Example:
            >>> Projectile(mass=2.0, drag=0.5, gravity=9.0).terminal_speed
            6.0
        """
        k = np.asarray(self.drag_per_mass)
        still = k <= 0.0
        return plain(np.where(still, inf, np.sqrt(np.divide(self.gravity, np.where(still, 1.0, k)))))

    def launch(
        self,
        *,
        speed: ArrayLike | None = None,
        angle: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
        start: ArrayLike = HERE,
    ) -> Shot:
        """A shot, by speed and angle or by velocity.

        Args:
            speed: [m/s], with ``angle``.
            angle: From the x axis, counterclockwise [rad].
            velocity: Shape (..., 2) [m/s], in place of both.
            start: Launch point, shape (..., 2) [m].

        Raises:
            InvalidInput: If it is neither speed and angle nor velocity alone.
            InvalidValue: If a number is not finite, or the speed not greater than 0.
        """
        polar = speed is not None and angle is not None
        if polar == (velocity is not None) or (speed is None) != (angle is None):
            given = {"speed": speed, "angle": angle, "velocity": velocity}
            raise InvalidInput("launch", given, "speed and angle, or velocity alone")
        x, y = HERE if start is HERE else map(checks.frozen, components(checks.vector("start", start, 2)))
        if velocity is not None:
            return Shot(self, x, y, *components(checks.vector("velocity", velocity, 2)))
        v, psi = checks.positive("speed", speed), checks.real("angle", angle)
        checks.broadcast(speed=v, angle=psi, start=x, k=self.drag)
        if not np.all(np.less(v, TOO_FAST)):
            raise InvalidValue("speed", speed, "a speed below 1e150 m/s")
        return Shot._of(self, x, y, *_launch_velocity(v, psi))

    def aim(
        self,
        target: ArrayLike,
        *,
        time: ArrayLike | None = None,
        speed: ArrayLike | None = None,
        angle: ArrayLike | None = None,
        start: ArrayLike = HERE,
    ) -> Aim:
        """The launch through a target.

        Args:
            target: Shape (..., 2) [m].
            time: Flight time [s]: the velocity that is there then; it is unique.
            speed: [m/s]: the low and the high arc, or how far short the speed falls.
            angle: From the x axis [rad]: the speed.
            start: Launch point, shape (..., 2) [m].

        Give one of the three, or none for the launch of least speed.

        Returns:
            Status, low and high arc, and the numbers of a no.

        Raises:
            InvalidInput: If more than one of time, speed and angle is given.
            InvalidValue: If one is not finite, time or speed not positive, or the target is the launch point.

        Example:
            >>> ball = Projectile(mass=2.0, drag=0.05)
            >>> aim = ball.aim((5.0, 10.0), time=2.0)
            >>> aim.low.velocity.round(6).tolist(), aim.miss() < 1e-12
            ([3.153594, 17.49289], True)
            >>> aim = ball.aim((60.0, 0.0), speed=20.0)
            >>> aim.status.name, round(aim.shortfall, 3), round(aim.least_speed, 3)
            ('OUT_OF_REACH', 35.966, 52.422)
        """
        return aiming.aim(self, target, start, time, speed, angle)

    def furthest(self, speed: ArrayLike, *, slope: ArrayLike = 0.0) -> Reach:
        """The launch that goes farthest along a slope at a speed, and how far.

        Args:
            speed: [m/s].
            slope: Angle of the slope from the x axis, in (-pi/2, pi/2] [rad]; 0 is level ground.

        Example:
            >>> from math import degrees
            >>> round(degrees(Projectile(mass=1.0, drag=0.02).furthest(30.0).angle), 1)
            39.1
        """
        return reach.furthest(self, speed, slope)

    def envelope(self, speed: ArrayLike, slope: ArrayLike) -> np.ndarray:
        """Points (..., 2) of the limit of what a speed reaches, one a direction; without drag the parabola of safety.

        Args:
            speed: [m/s].
            slope: Directions from the launch point, in (-pi/2, pi/2] [rad]; the limit is the same to the other side.

        Example:
            >>> Projectile(mass=1.0, drag=0.0, gravity=10.0).envelope(20.0, [0.0, 1.5707963267948966]).round(6).tolist()
            [[40.0, 0.0], [0.0, 20.0]]
        """
        return reach.furthest(self, speed, slope).point

    def most_tolerant(
        self,
        target: ArrayLike,
        *,
        sigma_angle: float,
        sigma_speed: float,
        max_speed: float = inf,
        start: ArrayLike = HERE,
    ) -> Tolerant:
        """Of all launches through a target, the one that misses least for given errors of the launch.

        Args:
            target: Shape (..., 2) [m].
            sigma_angle: Standard deviation of the angle [rad].
            sigma_speed: Standard deviation of the speed [m/s].
            max_speed: The fastest launch allowed [m/s]; without one, 20 times the least speed.
            start: Launch point, shape (..., 2) [m].

        Raises:
            InvalidValue: If a standard deviation is negative or both are 0.

        Example:
            >>> ball = Projectile(mass=1.0, drag=0.02)
            >>> best = ball.most_tolerant((15.0, 2.0), sigma_angle=0.02, sigma_speed=0.2, max_speed=25.0)
            >>> best.aim.hit, best.miss < 0.3
            (True, True)
        """
        return reach.most_tolerant(self, target, start, sigma_angle, sigma_speed, max_speed)
