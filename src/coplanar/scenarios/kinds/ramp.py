"""Velocity ramps: from one velocity to another, each component on its own or both together."""

from __future__ import annotations

from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.errors import InvalidValue
from coplanar.motion import Ramp
from coplanar.run import Run
from coplanar.scenarios.kinds.holonomic import times
from coplanar.scenarios.outcome import Outcome
from coplanar.scenarios.parts.common import MOST_STEPS, vector
from coplanar.scenarios.quantities import Duration, PositiveAcceleration, Velocity
from coplanar.scenarios.scenario import Progress, Scenario


class Ramped(NamedTuple):
    """What the library makes of it."""

    ramp: Ramp
    other: Ramp


class RampScenario(Scenario):
    """Two velocity components and what they ramp to."""

    vectorised_keys: ClassVar[tuple[str, ...]] = ("start.*", "target.*", "acceleration.*")
    example: ClassVar[dict[str, Any]] = {"start": [0.4, 0.2], "target": [1.2, -0.6], "acceleration": [0.5, 0.25]}

    type: Literal["ramp"] = Field(default="ramp", description="From one velocity to another")
    start: Velocity = Field(description="(vx, vy) at time 0")
    target: Velocity = Field(description="(vx, vy) to reach, and then to hold")
    acceleration: tuple[PositiveAcceleration, PositiveAcceleration] = Field(description="Magnitude for each component")
    together: bool = Field(default=False, description="Whether both arrive at the same time")
    duration: Duration = Field(default=4.0, description="How long it is watched")
    step: Duration = Field(default=0.025, description="Time between the rows of the table")

    def build(self) -> Ramped:
        """The ramp, and the one of the other sort."""
        if self.duration / self.step > MOST_STEPS:
            raise InvalidValue("step", self.step, f"at most {MOST_STEPS} rows")
        given = vector(self.start), vector(self.target), vector(self.acceleration)
        alone, both = Ramp.independent(*given), Ramp.synchronised(*given)
        return Ramped(both, alone) if self.together else Ramped(alone, both)

    def _numbers(self, things: Any) -> dict[str, Any]:
        ramp = things.ramp
        end = ramp.position((0.0, 0.0), self.duration)
        needed = {"time_x": ramp.durations[..., 0], "time_y": ramp.durations[..., 1]}
        return {**needed, "final_x": end[..., 0], "final_y": end[..., 1]}

    def _outcome(self, _: Progress, /) -> Outcome:
        built = self.build()
        ramp, t = built.ramp, times(self.duration, self.step)
        position, velocity = ramp.position((0.0, 0.0), t), ramp.velocity(t)
        # The velocities are linear between their corners: with those among the times, trapezoids are exact.
        fine = np.unique(np.concatenate([t, np.minimum(ramp.durations, self.duration)]))
        rates = ramp.velocity(fine)
        areas = np.concatenate(
            [[(0.0, 0.0)], np.cumsum(0.5 * np.diff(fine)[:, None] * (rates[:-1] + rates[1:]), axis=0)]
        )
        error = float(np.abs(areas[np.searchsorted(fine, t)] - position).max())
        numbers = self._numbers(built)
        columns = {"t": t, "x": position[:, 0], "y": position[:, 1], "vx": velocity[:, 0], "vy": velocity[:, 1]}
        arrived = bool(np.all(ramp.durations <= self.duration))
        return self._told(
            built,
            numbers,
            {"position": position, "velocity": velocity},
            run=Run(columns),
            ok=True,
            status="both components hold their targets"
            if arrived
            else "the targets are not reached within the duration",
            headline=f"vx arrives after {numbers['time_x']:.2f} s, vy after {numbers['time_y']:.2f} s",
            check=f"areas under the velocities: {error:.0e} m",
            passed=bool(error < 1e-12 * max(1.0, float(np.abs(position).max()))),
            tables={"run.csv": columns},
            warnings=() if arrived else ("the targets are not reached within the duration",),
        )
