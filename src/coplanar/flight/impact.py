"""Where a shot comes down: on a level, on a slope, at a wall."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coplanar.engine import stack
from coplanar.errors import NoSolution
from coplanar.flight.path import State, by_launch
from coplanar.flight.state import FlightState, Sensitivity
from coplanar.laws.landing import landing
from coplanar.solving import code_of, count_by_status, status_of

if TYPE_CHECKING:
    from coplanar.checks import Real
    from coplanar.flight.shot import Shot


class ImpactStatus(Enum):
    """How a path stands to a line."""

    REACHED = "the path crosses the line from above to below"
    NEVER = "the path never comes down through the line: this is its nearest point"


class Line(NamedTuple):
    """A straight line through (x, y) [m] along (cosine, sine), cosine >= 0; a wall where it is 0."""

    x: Real
    y: Real
    cosine: Real
    sine: Real


@dataclass(frozen=True, slots=True)
class Impact:
    """The answer of ``Shot.impact`` and its kin.

    Attributes:
        shot: The shot.
        line: What it comes down on.
        code: Place of the status in ``ImpactStatus``, an int or an array of them.
        state: Time, position and velocity there; where the line is never crossed, at the nearest point of the path.
        theta: The parameter of the hodograph there.
    """

    shot: Shot
    line: Line
    code: Any
    state: FlightState
    theta: Real

    @classmethod
    def of(cls, shot: Shot, line: Line) -> Impact:
        """The crossing of a shot and a line."""
        k, g = shot.projectile.drag_per_mass, shot.projectile.gravity
        theta, *state, code = landing(shot.x, shot.y, shot.vx, shot.vy, k, g, *line)
        return cls(shot, line, code.astype(np.int8) if np.ndim(code) else int(code), FlightState(*state), theta)

    @property
    def status(self) -> Any:
        """An ``ImpactStatus``, or an object array of them for a batch."""
        return status_of(ImpactStatus, self.code)

    @property
    def reached(self) -> Any:
        """Whether the line is crossed; an array of bool for a batch."""
        return self.code == code_of(ImpactStatus.REACHED)

    @property
    def time(self) -> Real:
        """Since the launch [s]."""
        return self.state.time

    @property
    def position(self) -> np.ndarray:
        """Where, shape (..., 2) [m]."""
        return self.state.position

    @property
    def velocity(self) -> np.ndarray:
        """How fast, shape (..., 2) [m/s]."""
        return self.state.velocity

    def height(self) -> Real:
        """How far the point stands above the line, along its normal, computed anew; 0 where it is reached [m].

        A negative height is by how much the path stays below a line that it never crosses.
        """
        now, (px, py, c, s) = self.state, self.line
        return c * (now.y - py) - s * (now.x - px)

    def sensitivity(self) -> Sensitivity:
        """How the point of impact moves along the line with the speed and the angle of the launch."""
        side, now, c = self.shot.side, self.state, np.asarray(self.line.cosine)
        s, vx, vy = side * np.asarray(self.line.sine), side * now.vx, now.vy
        end = State(self.theta, now.time, side * (now.x - self.shot.x), now.y - self.shot.y, vx, vy)
        x_v, y_v, x_psi, y_psi = by_launch(self.shot.path(), end)
        along = []
        for dx, dy in ((x_v, y_v), (x_psi, y_psi)):
            delay = -(c * dy - s * dx) / (c * vy - s * vx)
            along.append((dx + delay * vx, dy + delay * vy))
        (ax, ay), (bx, by) = along
        return Sensitivity(stack((side * ax, ay)), stack((bx, side * by)))

    def or_raise(self) -> Impact:
        """This answer if every path crosses its line.

        Raises:
            NoSolution: With the sentence and this answer, if one does not.
        """
        if not np.all(self.reached):
            raise NoSolution(count_by_status(ImpactStatus, self.code), self)
        return self
