"""Driving histories: sampled commands (v, omega), and the path they make by any integrator."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import Real
from coplanar.engine import components, evaluator, stack
from coplanar.errors import InvalidValue
from coplanar.integrators import METHODS, SCIPY_METHODS, integrate_ode
from coplanar.laws import motion as laws
from coplanar.motion.odometry import Odometry
from coplanar.motion.program import Program, held_samples
from coplanar.se2 import Pose

_unicycle_rates = evaluator(laws.unicycle_rates)


@dataclass(frozen=True, slots=True)
class DrivingHistory:
    """Commands (v, omega) at given times, each held until the next time.

    Attributes:
        t: Strictly monotone times [s], shape (n,).
        v: Forward velocity [m/s], a number, or shape (..., n) or (..., n - 1); of n samples the last one is not driven.
        omega: Turn rate [rad/s], likewise.

    Raises:
        InvalidValue: If the times are not strictly monotone.
        InvalidShape: If the counts differ.

    Example:
        >>> DrivingHistory([0.0, 1.0, 2.0], [1.0, 2.0, 0.0], 0.0).path(Pose()).x.tolist()
        [0.0, 1.0, 3.0]
    """

    t: np.ndarray
    v: Real
    omega: Real

    def __post_init__(self) -> None:
        times = checks.monotone("t", self.t)
        held = {name: held_samples(name, getattr(self, name), times.size) for name in ("v", "omega")}
        checks.broadcast(**held)
        for name, value in {"t": times, **held}.items():
            object.__setattr__(self, name, checks.frozen(value))

    @classmethod
    def square(cls, step: float = 0.1) -> DrivingHistory:
        """Seven one-second pieces, alternately v = 1 and omega = pi/2: the square of the course that does not close.

        The time 0 belongs to the first side and the last sample is never driven, so the first side is one step longer
        than the others and the last one a step shorter.

        Args:
            step: Time between samples [s]; a whole number of them make one second.

        Raises:
            InvalidValue: If one second is no whole number of steps (to 1e-9).

        Example:
            >>> square = DrivingHistory.square()
            >>> end = square.path(Pose(0.0, 0.0, -np.pi / 2)).as_array()[-1]
            >>> square.t.size, end.round(12).tolist()
            (71, [0.1, -0.1, 3.14159265359])
        """
        per_piece = round(1.0 / checks.positive("step", step))
        if abs(per_piece * step - 1.0) > 1e-9:
            raise InvalidValue("step", step, "a whole fraction of 1 s")
        samples = np.arange(7 * per_piece + 1)
        turning = np.maximum(samples - 1, 0) // per_piece % 2 == 1
        return cls(samples / per_piece, np.where(turning, 0.0, 1.0), np.where(turning, np.pi / 2, 0.0))

    def path(self, start: Pose, method: str = "exact") -> Pose:
        """The pose at every time.

        Args:
            start: Pose at the first time; of the leading shape.
            method: "exact" for arcs, which hold for any step; or a method of ``integrate_ode``: "euler", "rk4" ...

        Returns:
            Shape (..., n).

        Raises:
            UnknownName: If there is no such method.
        """
        checks.choice("method", method, ("exact", *METHODS, *SCIPY_METHODS))
        if method == "exact":
            return self.as_odometry().path(start)
        command = stack((self.v, self.omega))
        command = np.broadcast_to(command, (*np.broadcast_shapes(command.shape[:-1], (self.t.size - 1,)), 2))
        held = np.moveaxis(command, -2, 0)
        first = np.broadcast_to(start.as_array(), (*np.broadcast_shapes(start.shape, held.shape[1:-1]), 3))
        states = integrate_ode(_pose_rates, self.t, first, method=method, held=held)
        return Pose._of(*components(np.moveaxis(states, 0, -2)))

    def as_odometry(self) -> Odometry:
        """The arcs between the times, as odometry."""
        return Odometry.from_velocities(self.v, self.omega, self.t)

    def as_program(self) -> Program:
        """The arcs between the times, as a program.

        Raises:
            InvalidValue: If the times decrease.
        """
        return Program.from_samples(self.v, self.omega, self.t)


def _pose_rates(_t: float, pose: np.ndarray, command: np.ndarray) -> Any:
    """Rates of (x, y, theta), shape (..., 3), under the command (v, omega), shape (..., 2)."""
    return stack(_unicycle_rates(pose[..., 2], command[..., 0], command[..., 1]))
