"""Inverse kinematics: joints that bring an arm's tool to a target, or as near as it gets."""

from __future__ import annotations

from math import degrees
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.arms import Arm, Solution
from coplanar.scenarios import truths
from coplanar.scenarios.outcome import Finding, Outcome
from coplanar.scenarios.part import Part
from coplanar.scenarios.parts.arms import ArmPart, Posture
from coplanar.scenarios.parts.common import vector
from coplanar.scenarios.quantities import Angle, Point, PositiveLength
from coplanar.scenarios.scenario import Progress, Scenario
from coplanar.se2 import Pose
from coplanar.solving import Report

Budget = Annotated[int, Field(strict=True, ge=1, le=1000)]
HOW_NEAR = 1e-9  # [m] that two answers of one inverse may be apart
COLUMNS = ("iteration", "evaluations", "residual", "step", "damping", "taken")


class SearchPart(Part):
    """A numerical search, told iteration by iteration."""

    near: Posture | None = Field(default=None, description="Joints to start from")
    iterations: Budget = Field(default=100, description="Most iterations")


class Reached(NamedTuple):
    """What the library makes of it."""

    arm: Arm
    target: Any
    solution: Solution


class ArmReach(Scenario):
    """An arm and a target."""

    vectorised_keys: ClassVar[tuple[str, ...]] = ("target.*", "heading", "near.*")
    example: ClassVar[dict[str, Any]] = {
        "arm": {"links": [0.5, 0.5]}, "target": [0.5, 0.0], "search": {"near": [0.1, 0.1]},
    }  # fmt: skip

    type: Literal["arm-reach"] = Field(default="arm-reach", description="Inverse kinematics of an arm")
    arm: ArmPart = Field(description="The arm")
    target: Point = Field(description="Where the tool should be")
    heading: Angle | None = Field(default=None, description="Heading that the tool should have; any unless given")
    near: Posture | None = Field(default=None, description="Joints that the answer comes nearest to")
    elbow: Literal[-1, 1] | None = Field(
        default=None, description="Sign of the sine at the elbow; the nearest unless given"
    )
    method: Literal["auto", "closed", "numerical"] = Field(default="auto", description="How it is solved")
    tolerance: PositiveLength = Field(default=1e-9, description="How far from the target counts as reached")
    iterations: Budget = Field(default=100, description="Most iterations of a numerical answer")
    search: SearchPart | None = Field(default=None, description="A numerical search beside the answer, to watch")

    def build(self) -> Reached:
        """The arm and its answer."""
        arm, target = self.arm.build(), vector(self.target)
        return Reached(arm, target, self._inverse(arm, target, self.near, self.method, self.iterations))

    def _inverse(self, arm: Arm, target: Any, near: Any, method: str, iterations: int) -> Solution:
        aim = target if self.heading is None else Pose(target[..., 0], target[..., 1], self.heading)
        start = None if near is None else vector(near)
        return arm.inverse(
            aim, near=start, elbow=self.elbow, method=method, tolerance=self.tolerance, iterations=iterations
        )

    def _numbers(self, things: Any) -> dict[str, Any]:
        answer: Solution = things.solution
        joints = {f"q{i}": answer.q[..., i - 1] for i in range(1, things.arm.n + 1)}
        place = {"x": answer.nearest[..., 0], "y": answer.nearest[..., 1]}
        return {
            "reached": answer.reached, "gap": answer.gap, **joints, **place, "conditioning": answer.conditioning(),
        }  # fmt: skip

    def _findings(self, things: Reached) -> list[Finding]:
        return [Finding(things.solution.sentence(), "good" if things.solution.reached else "no")]

    def _outcome(self, progress: Progress, /) -> Outcome:
        built = self.build()
        search = self._searched(built)
        progress(0.5)
        answer = built.solution
        tool = truths.tool_of(built.arm, answer.branches)
        off = np.abs(tool - complex(*self.target))
        error = float(np.abs(off - answer.gap).max() if not answer.reached else off.max())
        check, apart = f"sums of complex exponentials: {error:.0e} m", 0.0
        if search is not None and search.reached and answer.reached:
            apart = float(np.abs(answer.branches - search.q).max(axis=-1).min())
            check = f"search against the answer: {apart:.0e} rad; {check}"
        return self._told(
            built,
            self._numbers(built),
            {"search": search},
            ok=bool(answer.reached),
            status=answer.status.value,
            headline=self._headline(answer, search),
            check=check,
            passed=bool(error < HOW_NEAR and apart < HOW_NEAR),
            tables=_tables(answer, search),
            warnings=() if answer.reached else (answer.sentence(),),
        )

    def _searched(self, built: Reached) -> Solution | None:
        if self.search is None:
            return None
        return self._inverse(built.arm, built.target, self.search.near, "numerical", self.search.iterations)

    def _headline(self, answer: Solution, search: Solution | None) -> str:
        if not answer.reached:
            x, y = answer.nearest
            return f"short by {answer.gap:.4g} m: the nearest point is ({x:.4f}, {y:.4f}) m"
        last = " and ".join(f"{degrees(q):+.4g} deg" for q in answer.branches[:, -1])
        told = f"q{answer.q.size} = {last}"
        return told if search is None else f"{told}; the search takes {search.iterations} iterations"


def _tables(answer: Solution, search: Solution | None) -> dict[str, Any]:
    rows = answer.branches
    elbows = (1, -1) if len(rows) == 2 else (answer.elbow,)
    joints = {f"q{i}": rows[:, i - 1] for i in range(1, rows.shape[1] + 1)}
    report = search.report if search is not None else answer.report
    tables: dict[str, Any] = {"run.csv": {"elbow": elbows, **joints}}
    return tables | ({"iterations.csv": _iterations(report)} if len(report.rows) else {})


def _iterations(report: Report) -> dict[str, Any]:
    rows = [(n, e, residual, step, lam, int(taken), *x) for n, e, residual, step, lam, taken, x in report.rows]
    names = (*COLUMNS, *(f"q{i}" for i in range(1, len(rows[0]) - len(COLUMNS) + 1)))
    return dict(zip(names, zip(*rows, strict=True), strict=True))
