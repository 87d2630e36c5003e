"""A point P fixed on a unicycle follows a reference by P, PD or PI control and feed-forward."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.control.advice import tracker_warnings
from coplanar.control.controller import Timed, as_column
from coplanar.control.stability import StabilityReport, judge, loop_poles, margin_of, moving_poles, stable_below
from coplanar.control.unicycle import ROWS, Command, State, lead_of
from coplanar.engine import Scan, components, evaluator, stack
from coplanar.errors import InvalidValue
from coplanar.laws import control as laws
from coplanar.se2 import Pose

_center_under = evaluator(laws.center_under)
_gain_sum = evaluator(laws.gain_sum)
_point_velocity = evaluator(laws.point_velocity)
_point_command = evaluator(laws.point_command)
_track_point = evaluator(laws.track_point)
_tracking_step = Scan(laws.tracking_step)
_turn_per_step = evaluator(laws.turn_per_step)
_turn_rate = evaluator(laws.turn_rate)

_TRACKING: dict[str, tuple[Scan, tuple[float, ...]]] = {
    "euler": (Scan(laws.tracking_euler), ()),
    "exact": (Scan(laws.tracking_arc), ()),
    **{method: (_tracking_step, ROWS[method]) for method in ("midpoint", "heun", "rk4")},
}
AGAINST = ("current", "next")
NO_SIDEWAYS = (
    "with P on the axle no command moves it sideways (det A = px = 0): put P ahead of the axle, "
    "or drive the robot's centre to poses with PolarController"
)


@dataclass(frozen=True, slots=True, eq=False)
class PointTracker:
    """[v, omega] = A^-1 (kp e + kd edot + ki int e + refdot), P = C + R(theta) p, det A = px.

    ``edot`` is the backward difference over a step (e before the first is 0), the integral the sum of h e. With
    px < 0 P still tracks, but the robot turns round and drives in reverse: P always ends up leading.

    Attributes:
        point: P on the robot, (px, py) ahead of and to the left of its centre [m], shape (..., 2); px is not 0.
        kp: [1/s].
        kd: [1].
        ki: [1/s^2].
        feedforward: Whether the reference's velocity is added; without it P lags by |refdot|/kp.
        error_against: "current": e = ref(t_i) - P(t_i); "next": e = ref(t_i+1) - P(t_i).

    Raises:
        InvalidValue: If px = 0, kp is not positive or ki is negative.

    Example:
        >>> tracker = PointTracker(point=(0.05, 0.0), kp=100.0, kd=0.5)
        >>> report = tracker.stability(0.01)
        >>> report.status.name, report.poles.real.tolist(), report.largest_step
        ('BOUNDARY', [0.5, -1.0], 0.01)
    """

    point: ArrayLike
    kp: Real
    kd: Real = 0.0
    ki: Real = 0.0
    feedforward: bool = False
    error_against: str = "current"
    px: Real = field(init=False, repr=False)
    py: Real = field(init=False, repr=False)
    error_names: ClassVar[tuple[str, ...]] = ("ex", "ey")

    def __post_init__(self) -> None:
        point = checks.vector("point", self.point, 2)
        px, py = components(point)
        if not np.all(np.not_equal(px, 0.0)):
            raise InvalidValue("point", self.point, "px other than 0", NO_SIDEWAYS)
        gains = (("kp", checks.positive), ("kd", checks.real), ("ki", checks.not_negative))
        kp, kd, ki = (check(name, getattr(self, name)) for name, check in gains)
        checks.broadcast(point=px, kp=kp, kd=kd, ki=ki)
        checks.choice("error_against", self.error_against, AGAINST)
        values = {"point": point, "kp": kp, "kd": kd, "ki": ki, "px": px, "py": py}
        for name, value in values.items():
            object.__setattr__(self, name, checks.frozen(value))

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading shape of point and gains, () for one robot."""
        return checks.broadcast(px=self.px, kp=self.kp, kd=self.kd, ki=self.ki)

    def command(self, heading: ArrayLike, velocity: ArrayLike) -> np.ndarray:
        """[v, omega] = A^-1 w: what gives P the velocity w, shape (..., 2).

        Args:
            heading: [rad], shape (...).
            velocity: w, in the world [m/s], shape (..., 2).

        Example:
            >>> PointTracker((0.1, 0.0), kp=1.0).command(0.0, (1.0, 0.5)).tolist()
            [1.0, 5.0]
        """
        w = components(checks.vector("velocity", velocity, 2))
        answer: np.ndarray = stack(_point_command(checks.real("heading", heading), self.px, self.py, *w))
        return answer

    def velocity(self, heading: ArrayLike, command: ArrayLike) -> np.ndarray:
        """Pdot = A [v, omega], the velocity of P in the world [m/s], shape (..., 2).

        Example:
            >>> PointTracker((0.1, 0.0), kp=1.0).velocity(0.0, (1.0, 5.0)).tolist()
            [1.0, 0.5]
        """
        u = components(checks.vector("command", command, 2))
        answer: np.ndarray = stack(_point_velocity(checks.real("heading", heading), self.px, self.py, *u))
        return answer

    def pose_for(self, point: ArrayLike, heading: ArrayLike) -> Pose:
        """The pose with this heading [rad] that puts P on a point (..., 2) of the world: C = P - R p.

        Example:
            >>> PointTracker((0.1, 0.0), kp=1.0).pose_for((1.0, 0.0), heading=0.0)
            Pose(x=0.9, y=0.0, theta=0.0)
        """
        theta = checks.real("heading", heading)
        x, y = _center_under(*components(checks.vector("point", point, 2)), theta, self.px, self.py)
        return Pose(x, y, theta)

    def omega_for(self, error: ArrayLike) -> Real:
        """|omega| = kp |e|/|px|: the turn rate that an error e [m] across the robot asks for [rad/s].

        Example:
            >>> PointTracker((0.001, 0.0), kp=100.0).omega_for(0.05)
            5000.0
        """
        return _turn_rate(checks.real("error", error), self.kp, self.px)

    def stability(
        self, step: ArrayLike, *, method: str = "euler", speed: ArrayLike = 0.0, error: ArrayLike | None = None,
        tolerance: float = 1e-9,
    ) -> StabilityReport:  # fmt: skip
        """What the sampled loop will do.

        Along the reference, and everywhere at rest, the error obeys z^2 = (1 - h kp - kd) z + kd (a cubic with ki).
        Across a reference that moves at speed V the heading takes part, turning by g = h V/|px| a step per radian
        of misalignment; a plant of order 2 or more moves sideways while it turns and needs h kp + 2 kd + g < 2.

        Args:
            step: h [s].
            method: How the plant is stepped.
            speed: V [m/s].
            error: The largest error expected [m], for the turn rate it asks for; the lag V/kp unless given.
            tolerance: How near 1 the largest pole counts as on the boundary [1].

        Raises:
            UnknownName: If the method is not known.
            InvalidValue: If the step is not positive or the speed negative.
        """
        lead = lead_of(method)
        h, fast = checks.positive("step", step), checks.not_negative("speed", speed)
        lag = fast / self.kp if error is None else np.abs(checks.real("error", error))
        gains = (self.kp, self.kd, self.ki)
        total, turn = _gain_sum(h, *gains), _turn_per_step(h, fast, self.px)
        poles = loop_poles(h, *gains)
        across = moving_poles(h, gains, turn, lead) if np.any(fast) else None
        margin = margin_of(poles, across, turn)
        status = judge(margin, tolerance)
        numbers = {"gain_sum": total, "turn_per_step": turn, "omega_per_error": self.omega_for(1.0)}
        conditions = {"h kp + 2 kd + h^2 ki/2 < 2": np.less(total, 2.0), "|kd| < 1": np.less(np.abs(self.kd), 1.0)}
        return StabilityReport(
            step=h, method=method, poles=poles, lateral_poles=across, speed=fast, margin=margin,
            largest_step=stable_below(gains, self.px, fast, lead), status=status, conditions=conditions,
            numbers=numbers, warnings=tracker_warnings(self, status, numbers, (h, lag), lead),
        )  # fmt: skip

    def start(self, reference: Timed, time: float) -> Pose:
        """P on the reference, heading the way it moves (at rest: the way it is about to, or 0)."""
        (dx, dy), (ax, ay) = components(reference.velocity(time)), components(reference.acceleration(time))
        rest = np.hypot(dx, dy) <= 1e-12 * np.hypot(ax, ay)  # [s] of acceleration: slower than this is at rest
        heading = np.arctan2(np.where(rest, ay, dy), np.where(rest, ax, dx))
        return self.pose_for(reference.position(time), heading)

    def targets(self, reference: Timed | None, times: np.ndarray, dimensions: int) -> tuple[np.ndarray, ...]:
        """Reference point and feed-forward velocity for every step: four arrays (steps, ...).

        Raises:
            InvalidValue: If there is no reference.
        """
        if reference is None:
            raise InvalidValue("reference", None, "a reference in time", "use curve.over(duration) or HeldPoint")
        t = as_column(times, dimensions)
        points = reference.position(t)
        aim = points[1:] if self.error_against == "next" else points[:-1]
        ahead = reference.velocity(t[:-1]) if self.feedforward else np.zeros(aim.shape)
        return (*components(aim), *components(ahead))

    def memory(self, state: State) -> tuple[Any, ...]:
        """Before the first step: the last error and the integral, all 0."""
        nothing = 0.0 * state[0]
        return nothing, nothing, nothing, nothing

    def respond(self, state: State, target: Any, memory: Any, step: Real) -> tuple[Command, tuple[Real, ...], Any]:
        """The command for a measured state: (v, omega), the error (ex, ey), what to remember."""
        v, omega, ex, ey, total_x, total_y = _track_point(
            *state, *target, *memory, self.px, self.py, self.kp, self.kd, self.ki, step
        )
        return (v, omega), (ex, ey), (ex, ey, total_x, total_y)

    def roll(
        self, state: State, targets: Any, steps: np.ndarray, method: str, kept: Collection[int]
    ) -> tuple[np.ndarray, ...]:
        """The whole closed loop of a unicycle in one go: x, y, theta, v, omega, ex, ey.

        Each has shape (steps + 1, ...) where its place is among those kept, else that of the last row.
        """
        scan, row = _TRACKING[method]
        memory = (0.0,) * 6
        parameters = (self.px, self.py, self.kp, self.kd, self.ki, *row)
        columns: tuple[np.ndarray, ...] = scan((*state, *memory), (*targets, steps), parameters, keep=kept)[:7]
        return columns
