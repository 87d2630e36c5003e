"""Aiming: the launch through a target, from the flight time, the speed, the angle, or of least speed."""

from __future__ import annotations

from math import degrees
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.errors import InvalidValue
from coplanar.flight import Aim, Arc, Projectile
from coplanar.run import Run
from coplanar.scenarios import truths
from coplanar.scenarios.outcome import Finding, Outcome
from coplanar.scenarios.parts.common import Rows, vector
from coplanar.scenarios.parts.flight import ProjectilePart
from coplanar.scenarios.quantities import Angle, Duration, Point, PositiveSpeed
from coplanar.scenarios.scenario import Progress, Scenario

HITS = 1e-9  # [m] by which an adaptive integration at 1e-12 may miss, of a flight of a metre
BEYOND = "the launch that it takes is beyond every number"


class Aimed(NamedTuple):
    """What the library makes of it."""

    projectile: Projectile
    target: Any
    aim: Aim


class AimScenario(Scenario):
    """A projectile and a target."""

    vectorised_keys: ClassVar[tuple[str, ...]] = ("projectile.*", "target.*", "start.*", "time", "speed", "angle")
    example: ClassVar[dict[str, Any]] = {
        "projectile": {"mass": 1.0, "drag": 0.02}, "target": [30.0, 2.0], "speed": 30.0,
    }  # fmt: skip

    type: Literal["aim"] = Field(default="aim", description="The launch through a target")
    projectile: ProjectilePart = Field(description="What flies")
    target: Point = Field(description="What is to be hit")
    start: Point = Field(default=(0.0, 0.0), description="Where it is launched")
    time: Duration | None = Field(default=None, description="Flight time; then the velocity is wanted")
    speed: PositiveSpeed | None = Field(
        default=None, description="Launch speed; then the low and high angle are wanted"
    )
    angle: Angle | None = Field(default=None, description="Launch angle; then the speed is wanted")
    points: Rows = Field(default=121, description="Rows of the flight")

    @property
    def form(self) -> str:
        """Which one is given: "time", "speed", "angle", or "least" for none."""
        given = [name for name in ("time", "speed", "angle") if getattr(self, name) is not None]
        if len(given) > 1:
            raise InvalidValue(
                given[1], getattr(self, given[1]), f"one of time, speed, angle; {given[0]} is given already"
            )
        return given[0] if given else "least"

    def build(self) -> Aimed:
        """The answer."""
        projectile, target = self.projectile.build(), vector(self.target)
        given = {} if self.form == "least" else {self.form: getattr(self, self.form)}
        return Aimed(projectile, target, projectile.aim(target, start=vector(self.start), **given))

    def _numbers(self, things: Any) -> dict[str, Any]:
        aim: Aim = things.aim
        numbers: dict[str, Any] = {"hit": aim.hit}
        for name, arc in (("low", aim.low), ("high", aim.high)):
            numbers |= {f"{name}_angle": arc.angle, f"{name}_speed": arc.speed, f"{name}_time": arc.time}
        numbers |= {"shortfall": aim.shortfall}
        if self.form == "speed":
            numbers |= {"furthest": aim.furthest, "least_speed": aim.least_speed}
        return numbers

    def _findings(self, things: Aimed) -> list[Finding]:
        return [Finding(self._sentence(things.aim), "good" if things.aim.hit and arcs_of(things.aim) else "no")]

    def _sentence(self, aim: Aim) -> str:
        if aim.hit or self.form != "speed":
            return aim.sentence() if not aim.hit or arcs_of(aim) else BEYOND
        return f"{aim.sentence()}; {aim.least_speed:.6g} m/s would do"

    def _outcome(self, progress: Progress, /) -> Outcome:
        built = self.build()
        aim, arcs = built.aim, arcs_of(built.aim)
        progress(0.4)
        hit, shown = bool(aim.hit) and bool(arcs), bool(arcs)
        error = max((self._miss(arc) for arc in arcs if hit), default=0.0)
        scale = max(1.0, float(np.hypot(*built.target)))
        way = arcs[0].shot.sample(arcs[0].time, count=self.points) if shown else None
        run = (
            None if way is None else Run({"t": way.time, "x": way.x, "y": way.y, "vx": way.vx, "vy": way.vy}, "flight")
        )
        return self._told(
            built,
            self._numbers(built),
            {"arcs": arcs},
            run=run,
            ok=hit,
            status=aim.sentence() if hit == aim.hit else BEYOND,
            headline=self._headline(aim) if hit else self._sentence(aim),
            check=f"flown by DOP853 at 1e-12, {'the worse' if len(arcs) > 1 else 'it'} misses by {error:.0e} m"
            if hit else "nothing hits",
            passed=bool(error < HITS * scale),
            tables={"run.csv": self._table(arcs)},
            warnings=() if hit else (self._sentence(aim),),
        )  # fmt: skip

    def _miss(self, arc: Arc) -> float:
        off = np.hypot(*(arc.arrival().position - np.array(self.target)))
        return float(off) + truths.flight_error(arc.shot, np.array([0.0, arc.time]))

    def _table(self, arcs: tuple[Arc, ...]) -> dict[str, Any]:
        if self.form == "time":
            return {"vx0": [arc.velocity[0] for arc in arcs], "vy0": [arc.velocity[1] for arc in arcs]}
        angles = {"angle": [arc.angle for arc in arcs]}
        if self.form == "speed":
            return angles | {"range": [arc.shot.impact(level=self.target[1]).state.x for arc in arcs]}
        return angles | {"speed": [arc.speed for arc in arcs], "time": [arc.time for arc in arcs]}

    def _headline(self, aim: Aim) -> str:
        place = f"({self.target[0]:g}, {self.target[1]:g}) m"
        low, high = (f"{degrees(arc.angle):.3f} deg" for arc in (aim.low, aim.high))
        if self.form == "time":
            return f"launch at ({aim.low.velocity[0]:.6f}, {aim.low.velocity[1]:.6f}) m/s"
        if self.form == "speed":
            return f"{low} or {high} at {self.speed:g} m/s hit {place}"
        return f"{aim.low.speed:.4f} m/s at {low} {'hits' if self.form == 'angle' else 'just reaches'} {place}"


def arcs_of(aim: Aim) -> tuple[Arc, ...]:
    """The launches of a single aim: two, one where they are the same, none where there is no launch."""
    if not np.isfinite(aim.low.time):
        return ()
    return (aim.low,) if aim.low.angle == aim.high.angle else (aim.low, aim.high)
