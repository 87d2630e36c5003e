"""A shot: a projectile under quadratic drag, from its launch to where it comes down."""

from __future__ import annotations

from math import degrees
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.flight import Impact, Shot
from coplanar.run import Run
from coplanar.scenarios import truths
from coplanar.scenarios.outcome import Finding, Outcome
from coplanar.scenarios.parts.common import Rows
from coplanar.scenarios.parts.flight import LaunchPart, ProjectilePart
from coplanar.scenarios.quantities import Duration, Length
from coplanar.scenarios.scenario import Progress, Scenario

INTEGRATED = 1e-9  # [m] that an adaptive integration at 1e-12 may be apart


class Fired(NamedTuple):
    """What the library makes of it."""

    shot: Shot
    impact: Impact


class ShotScenario(Scenario):
    """A projectile and its launch."""

    vectorised_keys: ClassVar[tuple[str, ...]] = ("projectile.*", "launch.*", "level")
    example: ClassVar[dict[str, Any]] = {
        "projectile": {"mass": 1.0, "drag": 0.02}, "launch": {"speed": 30.0, "angle": "40 deg"},
    }  # fmt: skip

    type: Literal["shot"] = Field(default="shot", description="A projectile under quadratic drag")
    projectile: ProjectilePart = Field(description="What flies")
    launch: LaunchPart = Field(description="How it is launched")
    level: Length = Field(default=0.0, description="Height at which it comes down")
    duration: Duration | None = Field(default=None, description="How long it is followed; until it comes down if null")
    points: Rows = Field(default=101, description="Rows of the table")

    def build(self) -> Fired:
        """The shot and where it comes down."""
        shot = self.launch.of(self.projectile.build())
        return Fired(shot, shot.impact(self.level))

    def _numbers(self, things: Any) -> dict[str, Any]:
        shot, impact = things
        apex, end = shot.apex(), impact.state
        return {
            "apex_time": apex.time, "apex_x": apex.x, "apex_y": apex.y, "lands": impact.reached,
            "impact_time": end.time, "impact_x": end.x, "impact_speed": end.speed, "impact_angle": end.angle,
        }  # fmt: skip

    def _findings(self, things: Fired) -> list[Finding]:
        return [Finding(things.impact.status.value, "good" if things.impact.reached else "note")]

    def _outcome(self, progress: Progress, /) -> Outcome:
        built = self.build()
        shot, impact = built
        until = self.duration or (
            impact.time if impact.reached and impact.time > 0.0 else 2.0 * shot.apex().time or 1.0
        )
        way = shot.sample(until, count=self.points)
        progress(0.4)
        position, numbers = way.position, self._numbers(built)
        error = truths.flight_error(shot, way.time)
        columns = {"t": way.time, "x": position[:, 0], "y": position[:, 1], "vx": way.vx, "vy": way.vy}
        lands = f"; lands at {numbers['impact_x']:.3f} m" if impact.reached and self.duration is None else ""
        return self._told(
            built,
            numbers,
            {"way": way},
            run=Run(columns, "flight"),
            ok=True,
            status=impact.status.value,
            headline=f"{shot.speed:.3g} m/s at {degrees(shot.angle):.3g} deg: "
            f"the apex is {numbers['apex_y']:.3f} m high, after {numbers['apex_time']:.3f} s{lands}",
            check=f"DOP853 at 1e-12 on the equations of motion: {error:.0e} m",
            passed=bool(error < INTEGRATED * max(1.0, float(np.abs(position).max()))),
            tables={"run.csv": columns},
        )
