"""Controllers, limits, noise and integrators as a file describes them."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

from pydantic import Field

from coplanar.control import Limits, PointTracker, PolarController
from coplanar.scenarios.part import Part
from coplanar.scenarios.parts.common import PosePart, vector
from coplanar.scenarios.quantities import (
    Angle,
    AngleSpread,
    Distance,
    Duration,
    Gain,
    GainPerTime,
    Length,
    Number,
    Point,
    PositiveAcceleration,
    PositiveGain,
    PositiveLength,
    PositiveSpeed,
    PositiveTurnAcceleration,
    PositiveTurnRate,
    SpeedSpread,
    TurnRateSpread,
)
from coplanar.se2 import Pose
from coplanar.simulation import Noise


class PointTrackerPart(Part):
    """A point fixed on the robot follows the reference: kp e + kd edot + ki int e, and feed-forward."""

    type: Literal["point-tracker"] = Field(
        default="point-tracker", description="A point of the robot follows the reference"
    )
    point: Point = Field(description="The point, ahead of and to the left of the robot's centre; not on its axle")
    kp: PositiveGain = Field(description="Velocity per error: how hard the point is pulled to the reference")
    kd: Number = Field(default=0.0, description="Damping: share of the error's rate of change")
    ki: GainPerTime = Field(default=0.0, description="Pull by the sum of past errors")
    feedforward: bool = Field(default=False, description="Whether the reference's own velocity is added")
    error_against: Literal["current", "next"] = Field(
        default="current", description="Which sample of the reference the error is taken to"
    )

    def build(self) -> PointTracker:
        """The controller."""
        return PointTracker(vector(self.point), self.kp, self.kd, self.ki, self.feedforward, self.error_against)


class PolarPart(Part):
    """Drive to a pose by distance, bearing and heading of the goal."""

    type: Literal["polar"] = Field(default="polar", description="Drives to a pose")
    goal: PosePart = Field(description="The pose to reach")
    k_rho: Gain | None = Field(default=None, description="Speed per distance; 3 unless given")
    k_alpha: Gain | None = Field(
        default=None, description="Turn rate per bearing of the goal; the form's own unless given"
    )
    k_beta: Number | None = Field(default=None, description="Pull to the goal's heading; the form's own unless given")
    form: Literal["linear", "smooth"] = Field(
        default="linear", description="Linear near the goal, or smooth from everywhere"
    )
    direction: Literal["forward", "backward", "nearest"] = Field(default="forward", description="Which end goes ahead")
    arrive_within: PositiveLength = Field(
        default=1e-6, description="Distance at which only the heading is left to turn"
    )

    def build(self) -> PolarController:
        """The controller."""
        gains = (self.k_rho, self.k_alpha, self.k_beta)
        return PolarController(self.goal.build(), *gains, self.form, self.direction, self.arrive_within)


AnyController = Annotated[PointTrackerPart | PolarPart, Field(discriminator="type")]


class LimitsPart(Part):
    """What the motors allow."""

    v: PositiveSpeed | None = Field(default=None, description="Largest forward speed of either sign")
    omega: PositiveTurnRate | None = Field(default=None, description="Largest turn rate of either sign")
    rim: PositiveSpeed | None = Field(default=None, description="Largest rim speed of either wheel; needs half_track")
    half_track: PositiveLength | None = Field(default=None, description="Half the distance between the wheels")
    mode: Literal["scale", "clip", "keep_omega"] = Field(
        default="scale", description="Keep the curvature, cut each by itself, or keep the turn rate"
    )
    acceleration: PositiveAcceleration | None = Field(default=None, description="Largest change of the forward speed")
    turn_acceleration: PositiveTurnAcceleration | None = Field(
        default=None, description="Largest change of the turn rate"
    )

    def build(self) -> Limits:
        """The limits."""
        given = {name: getattr(self, name) for name in type(self).model_fields if name not in ("mode", "half_track")}
        free = {name: math.inf if value is None else value for name, value in given.items()}
        return Limits(**free, half_track=self.half_track, mode=self.mode)


class NoisePart(Part):
    """What sensors and motors add, normally distributed."""

    position: Distance = Field(default=0.0, description="Standard deviation of the measured x and y")
    heading: AngleSpread = Field(default=0.0, description="Standard deviation of the measured heading")
    v: SpeedSpread = Field(default=0.0, description="Standard deviation of the driven forward speed")
    omega: TurnRateSpread = Field(default=0.0, description="Standard deviation of the driven turn rate")
    seed: Annotated[int, Field(strict=True, ge=0, le=2**32 - 1)] = Field(
        default=0, description="Of the random numbers: same seed, same run"
    )

    def build(self) -> Noise:
        """The noise."""
        return Noise(self.position, self.heading, self.v, self.omega, self.seed)


class IntegratorPart(Part):
    """How time is stepped."""

    method: Literal["euler", "midpoint", "heun", "rk4", "exact"] = Field(
        default="exact", description="How the robot moves in a step; exact is the arc itself"
    )
    step: Duration = Field(default=0.01, description="Time from one command to the next")


class StartPart(Part):
    """Where a robot sets off: a pose, or its tracked point on the reference."""

    x: Length | None = Field(
        default=None, description="Along the world's x axis; with y, or neither: then on the reference"
    )
    y: Length | None = Field(default=None, description="Along the world's y axis")
    theta: Angle | None = Field(default=None, description="Heading; that of the reference unless given, 0 with x and y")

    def pose(self, controller: Any, reference: Any) -> Pose | None:
        """The pose; None where the controller's own is meant."""
        if self.x is not None and self.y is not None:
            return Pose(self.x, self.y, 0.0 if self.theta is None else self.theta)
        if self.theta is None or reference is None or not isinstance(controller, PointTracker):
            return None
        return controller.pose_for(reference.position(getattr(reference, "start_time", 0.0)), self.theta)


class RobotPart(Part):
    """What is driven."""

    type: Literal["unicycle"] = Field(default="unicycle", description="Two controls: forward speed and turn rate")
    start: StartPart = Field(default=StartPart(), description="Where it sets off")
