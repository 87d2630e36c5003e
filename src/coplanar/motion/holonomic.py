"""Holonomic motion: vx, vy and the turn rate are independent, and given in the world."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import evaluator, running_sum
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.laws import ramps as laws
from coplanar.motion.program import held_samples
from coplanar.motion.sequence import along, pick, piece_at
from coplanar.se2 import Displacement, Pose, Twist

_clamp = evaluator(laws.clamp)
_rate = evaluator(laws.rate)
_uniform = evaluator(laws.uniform)


@dataclass(frozen=True, slots=True)
class HolonomicMotion:
    """Pieces of constant acceleration in the world: x = x0 + int vx dt, y = y0 + int vy dt, theta likewise.

    Before 0 and after the end the body stands still. A velocity may jump between pieces.

    Attributes:
        velocities: (vx, vy, omega) at the beginning of each piece, shape (..., n, 3) [m/s, m/s, rad/s].
        accelerations: Constant within each piece, shape (..., n, 3) [m/s^2, m/s^2, rad/s^2].
        durations: Of the pieces, shape (n,) [s].
        knots: When each piece begins, and when the last one ends [s], shape (n + 1,).
        ways: Displacement in the world until each of the knots, shape (..., 3, n + 1).

    Raises:
        InvalidShape: If the pieces do not match.
        InvalidValue: If a duration is negative.

    Example:
        >>> sideways = HolonomicMotion([[0.0, 2.0, 0.5]], [[0.0, 0.0, 0.0]], [3.0])
        >>> sideways.end(Pose())
        Pose(x=0.0, y=6.0, theta=1.5)
    """

    velocities: np.ndarray
    accelerations: np.ndarray
    durations: np.ndarray
    knots: Any = field(init=False, repr=False, compare=False)
    ways: Any = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        durations = checks.not_negative("durations", checks.vector("durations", self.durations))
        if durations.ndim != 1:
            raise InvalidShape("durations", f"shape {durations.shape}", "shape (n,)")
        rates = {name: checks.vector(name, getattr(self, name), 3) for name in ("velocities", "accelerations")}
        shape = checks.broadcast(**rates, durations=durations[:, None])
        if shape[-2] != durations.size:
            raise InvalidShape("velocities", f"shape {shape}", f"shape (..., {durations.size}, 3)")
        rates = {name: np.broadcast_to(rate, shape) for name, rate in rates.items()}
        v, a = (rate.swapaxes(-1, -2) for rate in rates.values())
        rates |= {"knots": running_sum(durations), "ways": running_sum(_uniform(0.0, v, a, durations)[0])}
        for name, value in {**rates, "durations": durations}.items():
            object.__setattr__(self, name, checks.frozen(value))

    @classmethod
    def from_samples(
        cls, t: ArrayLike, vx: ArrayLike, vy: ArrayLike, omega: ArrayLike = 0.0, *, between: str = "linear"
    ) -> HolonomicMotion:
        """The motion through sampled velocities.

        Args:
            t: Strictly increasing times [s], shape (n,). The motion begins at its own 0.
            vx: Velocity along the world's x axis [m/s], a number or shape (..., n).
            vy: Along its y axis [m/s].
            omega: Turn rate [rad/s].
            between: "linear" joins the samples by constant accelerations, "hold" keeps each until the next time.

        Raises:
            InvalidValue: If the times do not increase.
            InvalidShape: If the counts differ.
            UnknownName: If ``between`` is neither.

        Example:
            >>> HolonomicMotion.from_samples([0.0, 2.0], [0.0, 1.0], 0.0).end(Pose()).x
            1.0
            >>> HolonomicMotion.from_samples([0.0, 2.0], [3.0, 1.0], 0.0, between="hold").end(Pose()).x
            6.0
        """
        checks.choice("between", between, ("linear", "hold"))
        times = checks.monotone("t", t)
        if times[1] < times[0]:
            raise InvalidValue("t", t, "increasing times", "reverse the samples")
        named = {"vx": checks.real("vx", vx), "vy": checks.real("vy", vy), "omega": checks.real("omega", omega)}
        durations = np.diff(times)
        if between == "hold":
            held = [along(held_samples(name, value, times.size), times.size - 1) for name, value in named.items()]
            velocities = np.stack(np.broadcast_arrays(*held), -1)
            return cls(velocities, np.zeros(3), durations)
        checks.broadcast(**named, t=times)
        samples = np.stack(np.broadcast_arrays(*(along(value, times.size) for value in named.values())), -1)
        slopes = _rate(samples[..., :-1, :], samples[..., 1:, :], durations[:, None])
        return cls(samples[..., :-1, :], slopes, durations)

    @classmethod
    def from_accelerations(
        cls, durations: ArrayLike, accelerations: ArrayLike, *, velocity: ArrayLike = (0.0, 0.0, 0.0)
    ) -> HolonomicMotion:
        """Accelerations one after another from an initial velocity, which goes on without a jump.

        Args:
            durations: Of the pieces [s], shape (n,).
            accelerations: (ax, ay, alpha) of each, shape (..., n, 3).
            velocity: (vx, vy, omega) at the beginning, shape (..., 3).

        Example:
            >>> there_and_stop = HolonomicMotion.from_accelerations([1.0, 1.0], [[1.0, 0, 0], [-1.0, 0, 0]])
            >>> there_and_stop.end(Pose()).x
            1.0
        """
        dt = checks.not_negative("durations", checks.vector("durations", durations))
        gains = checks.vector("accelerations", accelerations, 3) * dt[..., :, None]
        sums = running_sum(gains.swapaxes(-1, -2)).swapaxes(-1, -2)
        return cls(checks.vector("velocity", velocity, 3)[..., None, :] + sums[..., :-1, :], accelerations, dt)

    @property
    def duration(self) -> float:
        """When the last piece ends [s]."""
        return float(self.knots[-1])

    def pose(self, start: Pose, t: ArrayLike) -> Pose:
        """The pose at time t: x0 + int vx dt, y0 + int vy dt, theta0 + int omega dt.

        Args:
            start: Pose at time 0; broadcasts with the leading shape.
            t: [s], broadcasts with the leading shape.

        Example:
            >>> HolonomicMotion([[1.0, 0.0, 0.0]], [[2.0, 0.0, 0.0]], [3.0]).pose(Pose(), [0.0, 1.0]).x.tolist()
            [0.0, 2.0]
        """
        way, _ = self._state(checks.real("t", t))
        return Pose._of(*(checks.real("pose", p + w) for p, w in zip(start.parts, way, strict=True)))

    def velocity(self, t: ArrayLike) -> np.ndarray:
        """World velocities (vx, vy, omega) at time t, shape (..., 3); at a knot those of the piece that begins there.

        Example:
            >>> HolonomicMotion([[1.0, 0.0, 0.0]], [[2.0, 0.0, 0.0]], [3.0]).velocity(1.0).tolist()
            [3.0, 0.0, 0.0]
        """
        time = np.asarray(checks.real("t", t))
        inside = (time >= 0.0) & (time <= self.duration)
        rates: np.ndarray = np.stack(np.broadcast_arrays(*self._state(time)[1]), -1) * inside[..., None]
        return rates

    def speed(self, t: ArrayLike) -> Real:
        """sqrt(vx^2 + vy^2) at time t [m/s].

        Example:
            >>> HolonomicMotion([[3.0, 4.0, 0.0]], [[0.0, 0.0, 0.0]], [1.0]).speed(0.5)
            5.0
        """
        rates = self.velocity(t)
        return checks.real("speed", np.hypot(rates[..., 0], rates[..., 1]))

    def end(self, start: Pose) -> Pose:
        """The pose when the motion is over."""
        return self.pose(start, self.duration)

    def _state(self, t: Real) -> tuple[list[Any], list[Any]]:
        index = piece_at(self.knots, t)
        since = _clamp(t - self.knots[index], 0.0, self.durations[index])
        states = [
            _uniform(*(pick(table, index) for table in (self.ways[..., k, :], v, a)), since)
            for k, (v, a) in enumerate(
                zip(np.moveaxis(self.velocities, -1, 0), np.moveaxis(self.accelerations, -1, 0), strict=True)
            )
        ]
        return [way for way, _ in states], [velocity for _, velocity in states]


def discretize(twist: Twist, dt: ArrayLike) -> Twist:
    """The constant body twist whose arc ends where moving straight by (vx, vy) dt while turning by omega dt ends.

    A constant body twist held for a while is an arc, not a line; this one leaves no skew after dt.

    Args:
        twist: Wanted velocities, their direction that of the body at the beginning of the step.
        dt: How long the result is held [s].

    Returns:
        The twist to command, seen from the body.

    Raises:
        InvalidValue: If dt is not positive, or the step turns by more than half a turn.

    Example:
        >>> wanted = Twist(1.0, 0.0, 2.0)
        >>> Pose().step(discretize(wanted, 0.5).during(0.5)).as_array().round(12).tolist()
        [0.5, 0.0, 1.0]
    """
    step = checks.positive("dt", dt)
    vx, vy, omega = twist.parts
    if np.any(np.abs(omega * step) > np.pi):
        raise InvalidValue("omega dt", omega * step, "at most pi in size", "take a shorter dt")
    return twist_between(Pose(), Pose._of(vx * step, vy * step, omega * step), step)


def twist_between(start: Pose, end: Pose, duration: ArrayLike) -> Twist:
    """The constant body twist that leads from one pose to another: log(start^-1 end)/duration.

    Args:
        start: Where it begins.
        end: Where it leads, turning by at most half a turn.
        duration: [s].

    Raises:
        InvalidValue: If the duration is not positive.

    Example:
        >>> twist_between(Pose(1.0, 0.0, 0.0), Pose(3.0, 0.0, 0.0), 4.0)
        Twist(vx=0.5, vy=0.0, omega=0.0)
    """
    way: Displacement = start.between(end).log()
    return way.over(duration)
