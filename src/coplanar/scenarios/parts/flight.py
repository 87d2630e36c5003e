"""Projectiles and launches as a file describes them."""

from __future__ import annotations

from pydantic import Field

from coplanar.errors import InvalidValue
from coplanar.flight import Projectile, Shot
from coplanar.scenarios.part import Part
from coplanar.scenarios.parts.common import vector
from coplanar.scenarios.quantities import (
    Angle,
    Area,
    Density,
    Drag,
    DragPerMass,
    Gravity,
    Mass,
    NotNegative,
    Point,
    PositiveSpeed,
    Velocity,
)


class ProjectilePart(Part):
    """A point mass under gravity and quadratic drag; the drag in one of three forms, none of them for a parabola."""

    mass: Mass = Field(default=1.0, description="Mass")
    drag: Drag | None = Field(default=None, description="C, the drag force over the square of the speed")
    drag_per_mass: DragPerMass | None = Field(default=None, description="k = C/m, in place of drag")
    drag_coefficient: NotNegative | None = Field(
        default=None, description="c_d, about 0.47 for a sphere; with area, in place of drag"
    )
    area: Area | None = Field(default=None, description="Cross section across the flow, with drag_coefficient")
    air_density: Density = Field(default=1.225, description="Of the air, with drag_coefficient")
    gravity: Gravity = Field(default=9.81, description="Gravity, downwards")

    def build(self) -> Projectile:
        """The projectile."""
        if (self.drag_coefficient is None) != (self.area is None):
            raise InvalidValue("area", self.area, "drag_coefficient and area together")
        ways = {"drag": self.drag, "drag_per_mass": self.drag_per_mass, "drag_coefficient": self.drag_coefficient}
        given = [name for name, value in ways.items() if value is not None]
        if len(given) > 1:
            raise InvalidValue(given[1], ways[given[1]], f"one form of drag; {given[0]} is given already")
        if self.drag_per_mass is not None:
            return Projectile.from_drag_per_mass(self.drag_per_mass, mass=self.mass, gravity=self.gravity)
        if self.drag_coefficient is not None:
            return Projectile.from_area(
                self.mass, drag_coefficient=self.drag_coefficient, area=self.area, air_density=self.air_density,
                gravity=self.gravity,
            )  # fmt: skip
        return Projectile(self.mass, 0.0 if self.drag is None else self.drag, self.gravity)


class LaunchPart(Part):
    """How it is launched: speed and angle, or a velocity."""

    speed: PositiveSpeed | None = Field(default=None, description="Speed, with angle")
    angle: Angle | None = Field(default=None, description="From the x axis, counterclockwise")
    velocity: Velocity | None = Field(default=None, description="(vx, vy), in place of speed and angle")
    start: Point = Field(default=(0.0, 0.0), description="Where it is launched")

    def build(self) -> Shot:
        """A shot of a projectile of 1 kg without drag: what can be said of a launch alone."""
        return self.of(Projectile(1.0, 0.0))

    def of(self, projectile: Projectile) -> Shot:
        """The shot of a projectile."""
        velocity = None if self.velocity is None else vector(self.velocity)
        return projectile.launch(speed=self.speed, angle=self.angle, velocity=velocity, start=vector(self.start))
