"""Motions and driving histories as a file describes them."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from coplanar.errors import InvalidValue
from coplanar.motion import DrivingHistory, Segment
from coplanar.scenarios.part import Part
from coplanar.scenarios.parts.bases import DifferentialPart
from coplanar.scenarios.parts.common import MOST_STEPS
from coplanar.scenarios.quantities import (
    TIME,
    Acceleration,
    Duration,
    Quantity,
    Speed,
    Time,
    TurnAcceleration,
    TurnRate,
)

ShortStep = Annotated[float, Quantity(TIME, least=1e-5, most=1.0)]
WHOLE = 1e-9  # of a step: a count this near a whole number is that number


class SegmentPart(Part):
    """A motion of constant accelerations."""

    v: Speed = Field(default=0.0, description="Forward velocity at its start")
    omega: TurnRate = Field(default=0.0, description="Turn rate at its start")
    a: Acceleration = Field(default=0.0, description="Forward acceleration")
    alpha: TurnAcceleration = Field(default=0.0, description="Turn acceleration")
    duration: Time = Field(description="How long it lasts")

    def build(self) -> Segment:
        """The segment."""
        return Segment(self.v, self.omega, self.a, self.alpha, duration=self.duration)


Segments = Annotated[tuple[SegmentPart, ...], Field(min_length=1, max_length=1000)]


class CommandPart(Part):
    """A command that is held for a while."""

    v: Speed = Field(default=0.0, description="Forward velocity")
    omega: TurnRate = Field(default=0.0, description="Turn rate")
    duration: Duration = Field(description="How long it is held")


class WheelCommandPart(Part):
    """Wheel rates that are held for a while."""

    left: TurnRate = Field(default=0.0, description="Rate of the left wheel")
    right: TurnRate = Field(default=0.0, description="Rate of the right wheel")
    duration: Duration = Field(description="How long they are held")


class SquarePart(Part):
    """Seven one-second pieces, alternately v = 1 and omega = pi/2: a square that does not close."""

    type: Literal["square"] = Field(default="square", description="Seven pieces of 1 s, forward and turning in turn")
    step: ShortStep = Field(default=0.1, description="Time between samples")

    def build(self) -> DrivingHistory:
        """The history."""
        return DrivingHistory.square(self.step)


class CommandsPart(Part):
    """Commands one after another."""

    type: Literal["commands"] = Field(default="commands", description="Commands (v, omega) one after another")
    pieces: Annotated[tuple[CommandPart, ...], Field(min_length=1, max_length=1000)] = Field(description="The commands")
    step: Duration = Field(default=0.05, description="Time between samples; each piece is a whole number of them")

    def build(self) -> DrivingHistory:
        """The history."""
        columns = [(piece.v, piece.omega) for piece in self.pieces]
        return held(self.pieces, columns, self.step)


class WheelRatesPart(Part):
    """Wheel rates of a differential drive, one after another."""

    type: Literal["wheel-rates"] = Field(default="wheel-rates", description="Rates of the left and right wheel")
    base: DifferentialPart = Field(description="The wheels")
    pieces: Annotated[tuple[WheelCommandPart, ...], Field(min_length=1, max_length=1000)] = Field(
        description="The wheel rates"
    )
    step: Duration = Field(default=0.05, description="Time between samples; each piece is a whole number of them")

    def build(self) -> DrivingHistory:
        """The history: v = r (wr + wl)/2, omega = r (wr - wl)/(2 b), by the base."""
        base = self.base.build()
        twists = [base.forward(base.rates(left=piece.left, right=piece.right)) for piece in self.pieces]
        return held(self.pieces, [(twist.vx, twist.omega) for twist in twists], self.step)


class SamplesPart(Part):
    """Sampled commands, each held until the next time."""

    type: Literal["samples"] = Field(default="samples", description="Commands at given times")
    t: Annotated[tuple[Time, ...], Field(min_length=2, max_length=10_000)] = Field(description="Increasing times")
    v: Annotated[tuple[Speed, ...], Field(max_length=10_000)] = Field(description="Forward velocity at each time")
    omega: Annotated[tuple[TurnRate, ...], Field(max_length=10_000)] = Field(description="Turn rate at each time")

    def build(self) -> DrivingHistory:
        """The history."""
        return DrivingHistory(np.array(self.t), np.array(self.v), np.array(self.omega))


AnyHistory = Annotated[SquarePart | CommandsPart | WheelRatesPart | SamplesPart, Field(discriminator="type")]


def held(pieces: tuple[Any, ...], commands: list[tuple[Any, Any]], step: float) -> DrivingHistory:
    """The history that holds each command for a whole number of steps.

    Raises:
        InvalidValue: If a duration is no whole number of steps, or there are too many.
    """
    counts = []
    for place, piece in enumerate(pieces):
        count = round(min(piece.duration / step, 2.0 * MOST_STEPS))
        if abs(count * step - piece.duration) > WHOLE * step or count < 1:
            raise InvalidValue(f"pieces.{place}.duration", piece.duration, f"a whole number of steps of {step:g} s")
        counts.append(count)
    if sum(counts) > MOST_STEPS:
        raise InvalidValue("step", step, f"at most {MOST_STEPS} steps in all")
    shape = np.broadcast_shapes(*(np.shape(value) for command in commands for value in command))
    columns = [np.stack([np.broadcast_to(command[k], shape) for command in commands], axis=-1) for k in (0, 1)]
    v, omega = (np.repeat(column, counts, axis=-1) for column in columns)
    return DrivingHistory(step * np.arange(sum(counts) + 1), v, omega)
