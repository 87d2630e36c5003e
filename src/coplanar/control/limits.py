"""What the motors allow."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from coplanar import checks
from coplanar.checks import Real
from coplanar.control.unicycle import Command
from coplanar.engine import evaluator
from coplanar.errors import InvalidValue
from coplanar.laws import control as laws
from coplanar.laws import wheels

_clipped = evaluator(wheels.clipped)
_rims = {
    "scale": evaluator(laws.rims_scaled),
    "clip": evaluator(laws.rims_clipped),
    "keep_omega": evaluator(laws.rims_keeping_omega),
}
_scaled = evaluator(laws.scaled)
_slewed = evaluator(laws.slewed)


@dataclass(frozen=True, slots=True, eq=False)
class Limits:
    """Limits on (v, omega), on the rims of two wheels, and on how fast the command changes.

    Attributes:
        v: Largest |v| [m/s].
        omega: Largest |omega| [rad/s].
        rim: Largest rim speed of either wheel, |v -+ b omega| [m/s]; needs ``half_track``.
        half_track: b, half the distance between the wheels [m].
        mode: "scale" shrinks v and omega alike and keeps the curvature; "clip" clips each by itself and changes the
            path; "keep_omega" clips omega to its own limit and gives v what the rims have left.
        acceleration: Largest |dv/dt| [m/s^2].
        turn_acceleration: Largest |domega/dt| [rad/s^2].

    Example:
        >>> Limits(v=1.0, omega=2.0).apply((2.0, 1.0)), Limits(v=1.0, mode="clip").apply((2.0, 1.0))
        ((1.0, 0.5), (1.0, 1.0))
    """

    v: Real = math.inf
    omega: Real = math.inf
    rim: Real = math.inf
    half_track: Real | None = None
    mode: str = "scale"
    acceleration: Real = math.inf
    turn_acceleration: Real = math.inf

    def __post_init__(self) -> None:
        checks.choice("mode", self.mode, _rims)
        for name in ("v", "omega", "rim", "half_track", "acceleration", "turn_acceleration"):
            value = getattr(self, name)
            if value is not None and value is not math.inf:
                object.__setattr__(self, name, checks.frozen(checks.positive(name, value)))
        if self.rim is not math.inf and self.half_track is None:
            raise InvalidValue("half_track", None, "half the distance between the wheels when rim is limited")

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading shape of the limits, () for numbers."""
        return np.broadcast_shapes(
            *(np.shape(v) for v in (self.v, self.omega, self.rim, self.acceleration, self.turn_acceleration))
        )

    def apply(self, command: Command, last: Command = (0.0, 0.0), step: Real = math.inf) -> Command:
        """The command within the limits.

        Args:
            command: (v, omega) wanted [m/s, rad/s].
            last: The command before, which limits on acceleration start from.
            step: Time since then [s]; infinite lets every change pass.
        """
        v, omega = command
        if self.rim is not math.inf:
            v, omega = _rims[self.mode](v, omega, self.half_track, self.rim)
        if self.mode == "scale":
            v, omega = _scaled(v, omega, self.v, self.omega)
        else:
            v, omega = _clipped(v, self.v), _clipped(omega, self.omega)
        return _slewed(v, last[0], self.acceleration, step), _slewed(omega, last[1], self.turn_acceleration, step)
