"""A driving history: sampled commands, and the path they make by any integrator."""

from __future__ import annotations

from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.motion import DrivingHistory
from coplanar.run import Run
from coplanar.scenarios import truths
from coplanar.scenarios.outcome import Outcome
from coplanar.scenarios.parts.common import PosePart
from coplanar.scenarios.parts.motion import AnyHistory
from coplanar.scenarios.scenario import Progress, Scenario
from coplanar.se2 import Pose

ONE_STEP = 1e-12  # [m, rad] that a step taken anew may be apart, of a path of a metre


class Driven(NamedTuple):
    """What the library makes of it."""

    history: DrivingHistory
    start: Pose


class Drive(Scenario):
    """Commands over time, and where they lead."""

    vectorised_keys: ClassVar[tuple[str, ...]] = (
        "start.*", "history.pieces.*.v", "history.pieces.*.omega", "history.pieces.*.left", "history.pieces.*.right",
    )  # fmt: skip
    example: ClassVar[dict[str, Any]] = {
        "history": {
            "type": "wheel-rates", "base": {"track": 0.5, "radius": 0.1},
            "pieces": [{"left": 5.0, "right": 5.0, "duration": 2.0}, {"left": 3.0, "right": 6.0, "duration": 3.0}],
        },
    }  # fmt: skip

    type: Literal["drive"] = Field(default="drive", description="A robot drives sampled commands")
    history: AnyHistory = Field(description="The commands")
    start: PosePart = Field(default=PosePart(), description="Where it sets off")
    method: Literal["euler", "midpoint", "heun", "rk4", "exact"] = Field(
        default="exact", description="How each step is integrated; exact is the arc itself"
    )

    def build(self) -> Driven:
        """The history and the first pose."""
        return Driven(self.history.build(), self.start.build())

    def _numbers(self, things: Any) -> dict[str, Any]:
        path = things.history.path(things.start, self.method)
        return _numbers_of(path)

    def _outcome(self, progress: Progress, /) -> Outcome:
        built = self.build()
        history, t = built.history, built.history.t
        poses = history.path(built.start, self.method)
        progress(0.6)
        path = poses.as_array()
        held = [np.broadcast_to(command, (len(t) - 1,)) for command in (history.v, history.omega)]
        v, omega = held
        error = truths.step_error(path, np.stack(held, -1), np.diff(t), self.method)
        numbers = _numbers_of(poses)
        pose = {"x": path[:, 0], "y": path[:, 1], "theta": path[:, 2]}
        led = {"v": np.concatenate([[0.0], v]), "omega": np.concatenate([[0.0], omega])}
        return self._told(
            built,
            numbers,
            {"path": poses},
            run=Run({"t": t, **pose, **led}, "unicycle", info={"method": self.method}),
            ok=True,
            status="drove every command",
            headline=f"ends {numbers['gap']:.3f} m from where it starts, after {numbers['distance']:.3f} m",
            check=f"every step taken anew in complex numbers: {error:.0e}",
            passed=bool(error < ONE_STEP * max(1.0, float(np.abs(path).max()))),
            tables={"run.csv": {"t": t, **pose, "v": np.append(v, v[-1]), "omega": np.append(omega, omega[-1])}},
        )


def _numbers_of(path: Pose) -> dict[str, Any]:
    """Where a path (..., n) ends, how long it is, and how far its end is from its beginning."""
    sides = np.hypot(np.diff(path.x), np.diff(path.y)).sum(-1)
    gap = np.hypot(path.x[..., -1] - path.x[..., 0], path.y[..., -1] - path.y[..., 0])
    ends = {"final_x": path.x[..., -1], "final_y": path.y[..., -1], "final_theta": path.theta[..., -1]}
    return {**ends, "distance": sides, "gap": gap}
