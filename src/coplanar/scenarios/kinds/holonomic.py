"""Holonomic motion: vx, vy and the turn rate are commanded independently, in the world."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.errors import InvalidValue
from coplanar.motion import HolonomicMotion
from coplanar.run import Run
from coplanar.scenarios.outcome import Outcome
from coplanar.scenarios.part import Part
from coplanar.scenarios.parts.bases import TwistPart
from coplanar.scenarios.parts.common import MOST_STEPS, PosePart, vector
from coplanar.scenarios.quantities import Acceleration, Duration, TurnAcceleration
from coplanar.scenarios.scenario import Progress, Scenario
from coplanar.se2 import Pose


class PushPart(Part):
    """Accelerations in the world, held for a while."""

    ax: Acceleration = Field(default=0.0, description="Along the world's x axis")
    ay: Acceleration = Field(default=0.0, description="Along the world's y axis")
    alpha: TurnAcceleration = Field(default=0.0, description="Turn acceleration")
    duration: Duration = Field(description="How long it is held")


class Moved(NamedTuple):
    """What the library makes of it."""

    motion: HolonomicMotion
    start: Pose


class Holonomic(Scenario):
    """A body that moves in any direction while it turns."""

    vectorised_keys: ClassVar[tuple[str, ...]] = (
        "pieces.*.ax", "pieces.*.ay", "pieces.*.alpha", "velocity.*", "start.*",
    )  # fmt: skip
    example: ClassVar[dict[str, Any]] = {
        "pieces": [{"ax": 0.8, "duration": 1.0}, {"ay": 0.6, "duration": 1.5}, {"ax": -0.8, "duration": 1.0},
                   {"ay": -0.6, "duration": 1.5}],
    }  # fmt: skip

    type: Literal["holonomic"] = Field(default="holonomic", description="vx and vy are independent of the heading")
    pieces: Annotated[tuple[PushPart, ...], Field(min_length=1, max_length=1000)] = Field(
        description="Accelerations, one after another"
    )
    velocity: TwistPart = Field(default=TwistPart(), description="Velocity in the world at the beginning")
    start: PosePart = Field(default=PosePart(), description="Where it sets off")
    step: Duration = Field(default=0.05, description="Time between the rows of the table")

    def build(self) -> Moved:
        """The motion and the first pose."""
        if sum(piece.duration for piece in self.pieces) / self.step > MOST_STEPS:
            raise InvalidValue("step", self.step, f"at most {MOST_STEPS} rows")
        rows = [np.stack(np.broadcast_arrays(piece.ax, piece.ay, piece.alpha), -1) for piece in self.pieces]
        accelerations = np.stack(np.broadcast_arrays(*rows), -2)
        velocity = vector((self.velocity.vx, self.velocity.vy, self.velocity.omega))
        durations = [piece.duration for piece in self.pieces]
        motion = HolonomicMotion.from_accelerations(durations, accelerations, velocity=velocity)
        return Moved(motion, self.start.build())

    def _numbers(self, things: Any) -> dict[str, Any]:
        end = things.motion.end(things.start)
        return {
            "final_x": end.x, "final_y": end.y, "final_theta": end.theta, "duration": things.motion.duration,
            "largest_speed": _fastest(things.motion),
        }  # fmt: skip

    def _outcome(self, _: Progress, /) -> Outcome:
        built = self.build()
        motion = built.motion
        t = times(motion.duration, self.step)
        pose, velocity = motion.pose(built.start, t), motion.velocity(t)
        # The velocities are linear between the knots: the areas of trapezoids are exact.
        knots = np.concatenate([motion.velocities, _ends(motion)], axis=-1)
        areas = 0.5 * (knots[:, :3] + knots[:, 3:]) * motion.durations[:, None]
        error = float(np.abs(areas.sum(axis=0) - (pose.as_array()[-1] - built.start.as_array())).max())
        numbers = self._numbers(built)
        where = {"x": pose.x, "y": pose.y}
        rates = {"vx": velocity[:, 0], "vy": velocity[:, 1]}
        turned = np.degrees(numbers["final_theta"] - self.start.theta)
        told = "with its heading unchanged" if turned == 0.0 else f"turned by {turned:.1f} deg"
        return self._told(
            built,
            numbers,
            {"path": pose},
            run=Run({"t": t, **where, "theta": pose.theta, **rates, "omega": velocity[:, 2]}, "body"),
            ok=True,
            status="moved to the end of every piece",
            headline=f"ends at ({numbers['final_x']:.3f}, {numbers['final_y']:.3f}) m {told}",
            check=f"trapezoids under the velocities: {error:.0e} m",
            passed=bool(error < 1e-12 * max(1.0, float(np.abs(pose.as_array()).max()))),
            tables={"run.csv": {"t": t, **where, **rates}},
        )


def times(duration: float, step: float) -> np.ndarray:
    """Times a step apart from 0 to the duration, which is the last one [s].

    Example:
        >>> times(1.0, 0.4).tolist()
        [0.0, 0.4, 0.8, 1.0]
    """
    count = max(1, round(np.ceil(duration / step - 1e-9)))
    row: np.ndarray = np.minimum(step * np.arange(count + 1), duration)
    row[-1] = duration
    return row


def _ends(motion: HolonomicMotion) -> np.ndarray:
    """Velocities at the end of each piece."""
    return np.asarray(motion.velocities + motion.accelerations * motion.durations[:, None])


def _fastest(motion: HolonomicMotion) -> Any:
    """The speed is largest at an end of a piece."""
    corners = np.concatenate([motion.velocities, _ends(motion)], axis=-2)
    return np.hypot(corners[..., 0], corners[..., 1]).max(axis=-1)
