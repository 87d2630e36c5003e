"""Forward kinematics: where an arm's joints put its tool."""

from __future__ import annotations

from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.arms import Arm
from coplanar.scenarios import truths
from coplanar.scenarios.outcome import Finding, Outcome
from coplanar.scenarios.parts.arms import ArmPart, Posture
from coplanar.scenarios.parts.common import vector
from coplanar.scenarios.scenario import Progress, Scenario

NEARLY_SINGULAR = 1e-6  # smallest over largest singular value below which a posture is called singular [1]


class Posed(NamedTuple):
    """What the library makes of it."""

    arm: Arm
    q: Any
    points: np.ndarray


class ArmPose(Scenario):
    """An arm and its joints."""

    vectorised_keys: ClassVar[tuple[str, ...]] = ("q.*",)
    example: ClassVar[dict[str, Any]] = {"arm": {"links": [0.5, 0.3]}, "q": [0.3, 0.4]}

    type: Literal["arm-pose"] = Field(default="arm-pose", description="Forward kinematics of an arm")
    arm: ArmPart = Field(description="The arm")
    q: Posture = Field(description="The joints, base first")

    def build(self) -> Posed:
        """The arm and its points."""
        arm, q = self.arm.build(), vector(self.q)
        return Posed(arm, q, arm.points(q))

    def _numbers(self, things: Any) -> dict[str, Any]:
        tool = things.arm.forward(things.q)
        values = np.linalg.svd(things.arm.jacobian(things.q, task="position"), compute_uv=False)
        share = values[..., -1] / np.where(values[..., 0] > 0.0, values[..., 0], 1.0)
        return {
            "x": tool.x, "y": tool.y, "theta": tool.theta,
            "manipulability": things.arm.manipulability(things.q), "conditioning": share,
        }  # fmt: skip

    def _findings(self, things: Posed) -> list[Finding]:
        outside = (things.q < things.arm.lower) | (things.q > things.arm.upper)
        found = [Finding(f"joint {i + 1} is beyond its limit", "warn") for i in np.flatnonzero(outside)]
        share = float(self._numbers(things)["conditioning"])
        if share < NEARLY_SINGULAR:
            found.append(Finding("the posture is singular: the tool cannot move in every direction", "warn"))
        return found or [Finding(f"the posture is regular: smallest over largest singular value {share:.3g}", "good")]

    def _outcome(self, _: Progress, /) -> Outcome:
        built = self.build()
        points = built.points
        error = float(abs(truths.tool_of(built.arm, built.q) - complex(*points[-1])))
        numbers = self._numbers(built)
        return self._told(
            built,
            numbers,
            {},
            ok=True,
            status="the joints put the tool in one place",
            headline=f"tool at ({points[-1, 0]:.4f}, {points[-1, 1]:.4f}) m",
            check=f"sums of complex exponentials: {error:.0e} m",
            passed=bool(error <= 1e-15 * max(1.0, float(np.sum(np.abs(built.arm.links))))),
            tables={"run.csv": {"point": names_of(len(points), built.arm.n), "x": points[:, 0], "y": points[:, 1]}},
        )


def names_of(count: int, joints: int) -> tuple[str, ...]:
    """What the points of an arm are called: base, elbow or joints, tool.

    Example:
        >>> names_of(3, 2), names_of(5, 3)
        (('base', 'elbow', 'tool'), ('base', 'joint_2', 'joint_3', 'flange', 'tool'))
    """
    inner = ("elbow",) if joints == 2 else tuple(f"joint_{i}" for i in range(2, joints + 1))
    return ("base", *inner, *(("flange",) if count == joints + 2 else ()), "tool")
