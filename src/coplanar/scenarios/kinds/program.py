"""Segments of constant accelerations, driven one after another: lines, arcs, clothoids and all in between."""

from __future__ import annotations

from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.errors import InvalidValue
from coplanar.motion import Program
from coplanar.run import Run
from coplanar.scenarios import truths
from coplanar.scenarios.outcome import Finding, Outcome
from coplanar.scenarios.parts.common import MOST_STEPS, PosePart
from coplanar.scenarios.parts.motion import Segments
from coplanar.scenarios.quantities import Duration
from coplanar.scenarios.scenario import Progress, Scenario
from coplanar.se2 import Pose

INTEGRATED = 1e-9  # [m] that an adaptive integration at 1e-12 may be apart
CURVES = {
    "rest": "stands still", "line": "a line", "spin": "a turn on the spot", "arc": "an arc", "circle": "an arc",
    "clothoid": "a clothoid", "general": "no clothoid, because a is not 0",
}  # fmt: skip


class Chain(NamedTuple):
    """What the library makes of it."""

    program: Program
    start: Pose


class ProgramScenario(Scenario):
    """Segments, joined end to end."""

    vectorised_keys: ClassVar[tuple[str, ...]] = ("segments.*", "start.*")
    example: ClassVar[dict[str, Any]] = {
        "segments": [
            {"v": 1.0, "omega": 1.2, "duration": 1.5},
            {"v": 1.0, "omega": 0.0, "alpha": 0.8, "duration": 3.0},
            {"v": 1.0, "omega": 2.4, "a": -0.5, "duration": 2.0},
        ],
    }  # fmt: skip

    type: Literal["program"] = Field(default="program", description="Segments of constant accelerations")
    segments: Segments = Field(description="One after another")
    start: PosePart = Field(default=PosePart(), description="Where it sets off")
    step: Duration = Field(default=0.05, description="Time between the rows of the table")

    def build(self) -> Chain:
        """The program and the first pose."""
        if sum(np.max(segment.duration) for segment in self.segments) / self.step > MOST_STEPS:
            raise InvalidValue("step", self.step, f"at most {MOST_STEPS} rows")
        return Chain(Program([segment.build() for segment in self.segments]), self.start.build())

    def _numbers(self, things: Any) -> dict[str, Any]:
        end = things.program.end(things.start)
        ends = {"final_x": end.x, "final_y": end.y, "final_theta": end.theta}
        return {**ends, "duration": things.program.duration}

    def _findings(self, things: Chain) -> list[Finding]:
        found = []
        for place, segment in enumerate(things.program):
            found.append(Finding(f"segment {place}: {segment.kind}", "note"))
            if np.isfinite(segment.cusp_time) and segment.cusp_time > 0.0:
                found.append(Finding(f"segment {place} reverses after {segment.cusp_time:.4g} s: a cusp", "warn"))
        return found

    def _outcome(self, progress: Progress, /) -> Outcome:
        built = self.build()
        t, poses = built.program.sample(built.start, self.step)
        progress(0.4)
        error = truths.program_error(built.program)
        path, twist, numbers = poses.as_array(), built.program.twist(t), self._numbers(built)
        pose = {"x": path[:, 0], "y": path[:, 1], "theta": path[:, 2]}
        kinds = [segment.kind for segment in built.program]
        told = f"{CURVES[kinds[0]]}" if len(kinds) == 1 else f"{len(kinds)} segments"
        return self._told(
            built,
            numbers,
            {"path": poses},
            run=Run({"t": t, **pose, "v": twist.vx, "omega": twist.omega}, "unicycle"),
            ok=True,
            status="drove every segment",
            headline=f"{told}: ends at ({numbers['final_x']:.6f}, {numbers['final_y']:.6f}) m, "
            f"{np.degrees(numbers['final_theta']):.1f} deg",
            check=f"DOP853 at 1e-12 over all pieces: {error:.0e} m",
            passed=bool(error < INTEGRATED * max(1.0, float(np.abs(path[:, :2]).max()))),
            tables={"run.csv": {"t": t, **pose}},
        )
