"""Pieces that several kinds of scenario share."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field

from coplanar.engine import stack
from coplanar.scenarios.part import Part
from coplanar.scenarios.quantities import Angle, Length
from coplanar.se2 import Pose

Rows = Annotated[int, Field(strict=True, ge=2, le=100_000)]
MOST_STEPS = 1_000_000  # of a run: more is refused before anything is allocated


class PosePart(Part):
    """Where a frame stands."""

    x: Length = Field(default=0.0, description="Forward of the world's origin, along its x axis")
    y: Length = Field(default=0.0, description="Along the world's y axis")
    theta: Angle = Field(default=0.0, description="Heading, counterclockwise from the x axis")

    def build(self) -> Pose:
        """The pose."""
        return Pose(self.x, self.y, self.theta)


def vector(parts: tuple[Any, ...]) -> Any:
    """Numbers, or arrays of them, side by side on a last axis."""
    return stack(parts)
