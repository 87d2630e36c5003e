"""Bases on wheels as a file describes them."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from coplanar.scenarios.part import Part
from coplanar.scenarios.quantities import Angle, Length, PositiveLength, Speed, TurnRate
from coplanar.se2 import Twist
from coplanar.wheels import Wheel, WheeledBase


class DifferentialPart(Part):
    """Two ordinary wheels, left and right of the body's origin."""

    type: Literal["differential"] = Field(default="differential", description="Two ordinary wheels, left and right")
    half_track: PositiveLength | None = Field(default=None, description="From the origin to either wheel; or track")
    track: PositiveLength | None = Field(default=None, description="Between the wheels; or half_track")
    radius: PositiveLength | None = Field(default=None, description="Radius of both wheels")
    left_radius: PositiveLength | None = Field(default=None, description="Radius of the left wheel alone")
    right_radius: PositiveLength | None = Field(default=None, description="Radius of the right wheel alone")

    def build(self) -> WheeledBase:
        """The base."""
        return WheeledBase.differential(
            half_track=self.half_track, track=self.track, radius=self.radius, left_radius=self.left_radius,
            right_radius=self.right_radius,
        )  # fmt: skip


class OmniPart(Part):
    """Omni wheels on a circle at equal angles."""

    type: Literal["omni"] = Field(default="omni", description="Omni wheels on a circle, at equal angles")
    count: Annotated[int, Field(strict=True, ge=1, le=64)] = Field(default=3, description="How many wheels")
    wheel_distance: PositiveLength = Field(description="From the body's origin to each wheel")
    radius: PositiveLength = Field(description="Radius of the wheels")
    first_angle: Angle = Field(default=0.0, description="Where the first wheel stands, counterclockwise from forward")

    def build(self) -> WheeledBase:
        """The base."""
        place = {"wheel_distance": self.wheel_distance, "first_angle": self.first_angle}
        return WheeledBase.omni(self.count, radius=self.radius, **place)


class MecanumPart(Part):
    """Four mecanum wheels."""

    type: Literal["mecanum"] = Field(default="mecanum", description="Four mecanum wheels")
    radius: PositiveLength = Field(description="Radius of the wheels")
    half_length: PositiveLength | None = Field(default=None, description="Forward to the front wheels; or wheelbase")
    wheelbase: PositiveLength | None = Field(default=None, description="Between front and rear; or half_length")
    half_width: PositiveLength | None = Field(default=None, description="To the left wheels; or track")
    track: PositiveLength | None = Field(default=None, description="Between left and right; or half_width")
    rollers: Literal["X", "O"] = Field(default="X", description="What the rollers look like from above")

    def build(self) -> WheeledBase:
        """The base."""
        return WheeledBase.mecanum(
            radius=self.radius, half_length=self.half_length, wheelbase=self.wheelbase, half_width=self.half_width,
            track=self.track, rollers=self.rollers,
        )  # fmt: skip


class WheelPart(Part):
    """One wheel, seen from above."""

    x: Length = Field(description="Forward of the body's origin")
    y: Length = Field(description="To the left of the body's origin")
    drive_angle: Angle = Field(default=0.0, description="Where a positive rate drives the contact, from forward")
    radius: PositiveLength = Field(description="Radius")
    roller_angle: Angle | None = Field(
        default=None, description="Axle of the roller on the ground, from the drive angle; null for an ordinary wheel"
    )
    name: Annotated[str, Field(max_length=40)] = Field(default="", description="What to call it")

    def build(self) -> Wheel:
        """The wheel."""
        return Wheel(self.x, self.y, self.drive_angle, self.radius, self.roller_angle, name=self.name)


class WheelTablePart(Part):
    """Any wheels, one by one."""

    type: Literal["wheels"] = Field(default="wheels", description="Any wheels, one by one")
    wheels: Annotated[tuple[WheelPart, ...], Field(min_length=1, max_length=64)] = Field(description="The wheels")

    def build(self) -> WheeledBase:
        """The base."""
        return WheeledBase(tuple(wheel.build() for wheel in self.wheels))


AnyBase = Annotated[DifferentialPart | OmniPart | MecanumPart | WheelTablePart, Field(discriminator="type")]


class TwistPart(Part):
    """A motion seen from the body."""

    vx: Speed = Field(default=0.0, description="Forward")
    vy: Speed = Field(default=0.0, description="To the left")
    omega: TurnRate = Field(default=0.0, description="Counterclockwise")

    def build(self) -> Twist:
        """The twist."""
        return Twist(self.vx, self.vy, self.omega)
