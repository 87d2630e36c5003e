"""An arm follows a curve, on one branch and with a certificate."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.arms import Arm
from coplanar.curves import Curve
from coplanar.scenarios import truths
from coplanar.scenarios.outcome import Finding, Outcome
from coplanar.scenarios.parts.arms import ArmPart, Posture
from coplanar.scenarios.parts.common import vector
from coplanar.scenarios.parts.curves import AnyCurve
from coplanar.scenarios.quantities import Duration
from coplanar.scenarios.scenario import Progress, Scenario
from coplanar.tracing import Trace, trace

ON_THE_CURVE = 1e-12  # [m] that the tool may be off a curve that it follows, for an arm in closed form
SEARCHED = 1e-8  # [m] the same for an arm whose inverse is searched


class Traced(NamedTuple):
    """What the library makes of it, before it follows."""

    arm: Arm
    curve: Curve


class ArmTrace(Scenario):
    """An arm and a curve."""

    example: ClassVar[dict[str, Any]] = {
        "arm": {"links": [1.0, 1.0]}, "curve": {"type": "circle", "radius": 0.5, "center": [1.0, 0.5]}, "points": 51,
    }  # fmt: skip

    type: Literal["arm-trace"] = Field(default="arm-trace", description="An arm follows a curve")
    arm: ArmPart = Field(description="The arm")
    curve: AnyCurve = Field(description="What its tool follows")
    points: Annotated[int, Field(strict=True, ge=2, le=20_000)] = Field(
        default=101, description="Points of the curve, evenly in its parameter"
    )
    near: Posture | None = Field(default=None, description="Joints that the start comes nearest to")
    elbow: Literal[-1, 1] | None = Field(default=None, description="Sign of the sine at the elbow at the start")
    at_singular: Literal["stop", "through", "bounce"] = Field(
        default="stop", description="What to do where the two branches meet"
    )
    duration: Duration = Field(default=10.0, description="Time for the whole curve")

    def build(self) -> Traced:
        """The arm and the curve."""
        arm = self.arm.build()
        if self.near is not None:
            arm.checked_joints("near", vector(self.near))
        return Traced(arm, self.curve.build())

    def _followed(self, built: Traced) -> Trace:
        near = None if self.near is None else vector(self.near)
        return trace(
            built.arm, built.curve, self.points, elbow=self.elbow, near=near, at_singular=self.at_singular
        )  # fmt: skip

    def _numbers(self, things: Any) -> dict[str, Any]:
        return _numbers_of(self._followed(things))

    def _findings(self, things: Traced) -> list[Finding]:
        followed = self._followed(things)
        failures = [Finding(str(failure), "no") for failure in followed.failures]
        passed = [Finding(f"passes a singular point ({p.kind}) at {p.parameter:.6g}", "warn")
                  for p in followed.singular_points]  # fmt: skip
        return failures or [Finding(followed.status.value, "good"), *passed]

    def _outcome(self, progress: Progress, /) -> Outcome:
        built = self.build()
        followed = self._followed(built)
        progress(0.6)
        q, phi, on = followed.q, followed.parameters, followed.followed
        tool = followed.arm.forward(q).position
        off = np.abs(truths.tool_of(built.arm, q) - truths.points_of(built.curve.position(phi)))
        error = float(off[on].max(initial=0.0))
        joints = {f"q{i}": q[:, i - 1] for i in range(1, built.arm.n + 1)}
        closed = followed.certificate.smallest_sine is not None or not on.any()
        return self._told(
            built,
            _numbers_of(followed),
            {"trace": followed},
            run=followed.as_run(self.duration),
            ok=not followed.failures,
            status=str(followed),
            headline=_certified(followed),
            check=f"sums of complex exponentials in every row against the curve: {error:.0e} m",
            passed=bool(error < (ON_THE_CURVE if closed else SEARCHED)),
            tables={"run.csv": {"phi": phi, **joints, "x": tool[:, 0], "y": tool[:, 1]}},
            warnings=tuple(map(str, followed.failures)),
        )


def _numbers_of(followed: Trace) -> dict[str, Any]:
    proof = followed.certificate
    return {
        "followed": not followed.failures, "failures": len(followed.failures),
        "singular_points": len(followed.singular_points),
        "smallest_sine": np.nan if proof.smallest_sine is None else proof.smallest_sine,
        "smallest_conditioning": proof.smallest_conditioning, "largest_step": proof.largest_step,
        "limit_margin": proof.limit_margin, "position_error": proof.position_error,
    }  # fmt: skip


def _certified(followed: Trace) -> str:
    if followed.failures:
        return f"follows {np.mean(followed.followed):.0%} of the curve: {followed.failures[0]}"
    proof, places = followed.certificate, len(followed.singular_points)
    through = f"passes {places} singular points; " if places else ""
    least = "" if proof.smallest_sine is None else f"smallest |sin q2| {proof.smallest_sine:.3f}, "
    return f"{through}{least}largest joint step {np.degrees(proof.largest_step):.1f} deg"
