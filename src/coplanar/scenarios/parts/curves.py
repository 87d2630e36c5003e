"""Curves, and curves in time, as a file describes them."""

from __future__ import annotations

from math import tau
from typing import Annotated, Any, Literal

from pydantic import Field

from coplanar.curves import Astroid, Circle, Curve, Ellipse, HeldPoint, Lemniscate, Line, Polyline, Spline
from coplanar.scenarios.part import Part
from coplanar.scenarios.parts.common import vector
from coplanar.scenarios.quantities import Angle, Duration, Number, Point, Positive, PositiveLength, Time

Interval = tuple[Number, Number]
Points = Annotated[tuple[Point, ...], Field(min_length=2, max_length=10_000)]


class Placed(Part):
    """A curve with a formula about its own centre."""

    center: Point = Field(default=(0.0, 0.0), description="Where its middle stands")
    tilt: Angle = Field(default=0.0, description="How far it is turned counterclockwise")
    interval: Interval = Field(default=(0.0, tau), description="First and last parameter")

    def placed(self) -> dict[str, Any]:
        """What every such curve takes."""
        return {"center": vector(self.center), "tilt": self.tilt, "interval": self.interval}


class CirclePart(Placed):
    """(r cos phi, r sin phi)."""

    type: Literal["circle"] = Field(default="circle", description="A circle")
    radius: PositiveLength = Field(description="Radius")

    def build(self) -> Curve:
        """The curve."""
        return Circle(self.radius, **self.placed())


class EllipsePart(Placed):
    """(a cos phi, b sin phi)."""

    type: Literal["ellipse"] = Field(default="ellipse", description="An ellipse")
    a: PositiveLength = Field(description="Half its length")
    b: PositiveLength = Field(description="Half its width")

    def build(self) -> Curve:
        """The curve."""
        return Ellipse(self.a, self.b, **self.placed())


class LemniscatePart(Placed):
    """(a cos phi, b cos phi sin phi), a figure of eight."""

    type: Literal["lemniscate"] = Field(default="lemniscate", description="A figure of eight")
    a: PositiveLength = Field(default=1.0, description="Half its length")
    b: PositiveLength | None = Field(default=None, description="Its height; as a unless given")

    def build(self) -> Curve:
        """The curve."""
        return Lemniscate(self.a, self.a if self.b is None else self.b, **self.placed())


class AstroidPart(Placed):
    """(a cos^3 phi, a sin^3 phi), with four cusps."""

    type: Literal["astroid"] = Field(default="astroid", description="A star with four cusps")
    a: PositiveLength = Field(default=1.0, description="Distance of the cusps from the centre")

    def build(self) -> Curve:
        """The curve."""
        return Astroid(self.a, **self.placed())


class LinePart(Part):
    """A straight line."""

    type: Literal["line"] = Field(default="line", description="A straight line")
    start: Point = Field(description="Where it begins")
    end: Point = Field(description="Where it ends")

    def build(self) -> Curve:
        """The curve."""
        return Line(self.start, self.end)


class PolylinePart(Part):
    """Straight pieces from point to point."""

    type: Literal["polyline"] = Field(default="polyline", description="Straight pieces from point to point")
    points: Points = Field(description="The points, neighbours apart")
    closed: bool = Field(default=False, description="Whether a last piece leads back to the first point")

    def build(self) -> Curve:
        """The curve."""
        return Polyline(self.points, closed=self.closed)


class SplinePart(Part):
    """The cubic spline through points."""

    type: Literal["spline"] = Field(default="spline", description="A smooth curve through points")
    points: Points = Field(description="The points, neighbours apart")
    closed: bool = Field(default=False, description="Whether it comes back to the first point as smoothly as elsewhere")
    ends: Literal["natural", "not-a-knot", "clamped"] = Field(default="natural", description="How an open one ends")

    def build(self) -> Curve:
        """The curve."""
        return Spline(self.points, closed=self.closed, ends=self.ends)


class PointPart(Part):
    """A reference that rests."""

    type: Literal["point"] = Field(default="point", description="A reference that rests at one point")
    point: Point = Field(description="Where it rests")

    def build(self) -> HeldPoint:
        """The resting reference."""
        return HeldPoint(vector(self.point))


_CURVES = CirclePart | EllipsePart | LemniscatePart | AstroidPart | LinePart | PolylinePart | SplinePart
AnyCurve = Annotated[_CURVES, Field(discriminator="type")]
CurveOrPoint = Annotated[_CURVES | PointPart, Field(discriminator="type")]


class ReferencePart(Part):
    """A curve run through in time."""

    curve: CurveOrPoint = Field(description="What is followed")
    duration: Duration | None = Field(
        default=None, description="Time for the curve; that of the whole run unless given"
    )
    start_time: Time = Field(default=0.0, description="When it sets off")
    laps: Positive = Field(default=1.0, description="How many times around")
    profile: Literal["uniform", "minimum_jerk"] = Field(
        default="uniform", description="The parameter's pace: constant, or from rest to rest"
    )

    def build(self) -> Any:
        """The reference, for a run of its own duration (of 1 s without one)."""
        return self.over(1.0)

    def over(self, duration: float) -> Any:
        """The reference for a run of a duration [s]."""
        curve = self.curve.build()
        if isinstance(curve, HeldPoint):
            return curve
        time = duration if self.duration is None else self.duration
        return curve.over(time, start_time=self.start_time, laps=self.laps, profile=self.profile)
