"""Bases on wheels: what a table of wheels can do, cannot do, and what its rates say."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike
from coplanar.engine import evaluator, stack
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.laws import wheels as laws
from coplanar.se2 import Twist
from coplanar.wheels import doctor, layouts
from coplanar.wheels.feasible import FeasibleTwist
from coplanar.wheels.icr import Icr
from coplanar.wheels.rows import WheelRows
from coplanar.wheels.saturation import POLICIES, Saturation, limited
from coplanar.wheels.slip import Slip, slip_of

_row_speed = evaluator(laws.row_speed)


@dataclass(frozen=True, slots=True)
class WheeledBase(WheelRows):
    """A body on wheels, r phidot = J xi: ordinary, omni and mecanum wheels are rows of one table.

    Twists are seen from the body: vx forward, vy to the left, omega counterclockwise. Rates are (..., N) in the order
    of the wheels; ``rates`` and ``by_name`` take and give them by name. From wheels to body is "forward".

    Attributes:
        wheels: One or more; those without a name are called wheel_1, wheel_2 and so on.
        rank_tolerance: Singular values below this share of the largest, or of 1, count as zero [-].
        rolling: J, one row for each wheel, (N, 3) [1, 1, m].
        lateral: One row "no sideways velocity" for each ordinary wheel, (L, 3) [1, 1, m].
        radii: (N,) [m].
        mobility: Ranks and directions that follow from the rows.

    Raises:
        InvalidValue: If there is no wheel, or two have the same name.

    Example:
        >>> base = WheeledBase.differential(track=0.5, radius=0.1)
        >>> base.forward(base.rates(left=5.0, right=10.0)).as_array().round(12).tolist()
        [0.75, 0.0, 1.0]
        >>> base.cannot
        ('cannot move sideways: left and right would slide',)
    """

    @classmethod
    def differential(
        cls, *, half_track: float | None = None, track: float | None = None, radius: float | None = None,
        left_radius: float | None = None, right_radius: float | None = None,
    ) -> WheeledBase:  # fmt: skip
        """Two ordinary wheels, left and right of the body origin: v = r (wr + wl)/2, omega = r (wr - wl)/(2b).

        Args:
            half_track: b, from the origin to either wheel [m]; this or ``track``.
            track: 2b, between the wheels [m].
            radius: Of both wheels [m]; this, or ``left_radius`` and ``right_radius``.
            left_radius: [m].
            right_radius: [m].

        Raises:
            InvalidValue: If a length is missing, given twice, or not positive.
        """
        pair = (left_radius, right_radius)
        if (radius is None) == (pair == (None, None)) or (radius is None and None in pair):
            raise InvalidValue(
                "radius, left_radius, right_radius", (radius, *pair), "radius, or left_radius and right_radius"
            )
        left, right = (radius if r is None else r for r in pair)
        half = layouts.half_length("half_track", half_track, "track", track)
        return cls(layouts.differential(half, left, right))  # type: ignore[arg-type]

    @classmethod
    def omni(cls, count: int, *, wheel_distance: float, radius: float, first_angle: float = 0.0) -> WheeledBase:
        """Omni wheels on a circle at equal angles: r phidot = -sin(a) vx + cos(a) vy + d omega.

        Args:
            count: How many; three drive every direction.
            wheel_distance: d, from the body origin to each wheel [m].
            radius: [m].
            first_angle: a of the first wheel, counterclockwise from the x axis [rad].

        Example:
            >>> WheeledBase.omni(3, wheel_distance=0.2, radius=0.05).inverse(Twist(0.0, 0.0, 1.0)).round(12).tolist()
            [4.0, 4.0, 4.0]
        """
        return cls(layouts.omni(count, wheel_distance, radius, first_angle))

    @classmethod
    def mecanum(
        cls, *, radius: float, half_length: float | None = None, wheelbase: float | None = None,
        half_width: float | None = None, track: float | None = None, rollers: str = "X",
    ) -> WheeledBase:  # fmt: skip
        """Four mecanum wheels: r phidot = vx -+ vy -+ (lx + ly) omega.

        Args:
            radius: [m].
            half_length: lx, from the origin forward to the front wheels [m]; this or ``wheelbase``.
            wheelbase: 2 lx [m].
            half_width: ly, from the origin to the left wheels [m]; this or ``track``.
            track: 2 ly [m].
            rollers: "X", what the rollers look like seen from above when they are mounted right, or "O".

        Raises:
            InvalidValue: If a length is missing, given twice, or not positive.
            UnknownName: If the rollers are neither.

        Example:
            >>> base = WheeledBase.mecanum(radius=0.1, wheelbase=0.6, track=0.4)
            >>> base.by_name(base.inverse(Twist(0.0, 1.0, 0.0)).round(9))["front_left"]
            -10.0
        """
        angle = layouts.ROLLERS[checks.choice("rollers", rollers, layouts.ROLLERS)]
        lx = layouts.half_length("half_length", half_length, "wheelbase", wheelbase)
        ly = layouts.half_length("half_width", half_width, "track", track)
        return cls(layouts.mecanum(lx, ly, radius, angle))

    @property
    def rank(self) -> int:
        """Of all rows: 3 when the rates determine the twist."""
        return self.mobility.rank

    @property
    def singular_values(self) -> np.ndarray:
        """Of all rows, with the omega column divided by ``mobility.length``; three, largest first [-]."""
        return self.mobility.singular_values

    @property
    def condition(self) -> float:
        """Largest over smallest singular value [-]: 1 is isotropic, infinite when the rank is below 3."""
        return self.mobility.condition

    @property
    def degrees_of_control(self) -> int:
        """How many independent twists the wheels drive without sliding: 2 for a differential drive."""
        return self.mobility.degrees_of_control

    @property
    def degrees_of_configuration(self) -> int:
        """How many of (x, y, theta) those twists reach together: 3 for a differential drive."""
        return self.mobility.degrees_of_configuration(self.rank_tolerance)

    @property
    def is_holonomic(self) -> bool:
        """Whether vx, vy and omega can be driven independently: three degrees of control."""
        return self.degrees_of_control == 3

    @property
    def cannot(self) -> tuple[str, ...]:
        """What the base cannot do, in words; empty if it drives every motion."""
        forbidden = doctor.forbidden(self.wheels, self.lateral, self.mobility)
        return tuple(f.sentence for f in (*forbidden, *doctor.undriven(self.wheels, self.mobility)))

    def diagnose(self, *, worst_condition: float = 10.0, same_place: float = 1e-6) -> tuple[doctor.Finding, ...]:
        """What is wrong with the table of wheels, or worth knowing, in sentences.

        Args:
            worst_condition: Largest condition number that is not called weak [-].
            same_place: Wheels nearer than this stand on one point [m].

        Example:
            >>> base = WheeledBase.mecanum(radius=0.1, half_length=0.3, half_width=0.3, rollers="O")
            >>> print(base.diagnose()[0])
            nothing drives or holds it to turn on the spot: all lines of traction pass through (0, 0) m (rank 2 of 3)
        """
        found = doctor.findings(
            self.wheels, self.lateral, self.mobility, worst_condition=worst_condition, same_place=same_place
        )
        return tuple(found)

    def icr(self, rates: ArrayLike) -> Icr:
        """The instantaneous centre of rotation of wheel rates (..., N) [rad/s].

        Example:
            >>> base = WheeledBase.differential(half_track=0.25, radius=0.1)
            >>> round(base.icr(base.rates(left=5.0, right=15.0)).radius, 12)
            0.5
        """
        return Icr(self.forward(rates))

    def feasible(self, twist: Twist, *, tolerance: float = 1e-9) -> FeasibleTwist:
        """The nearest twist that the base can be driven along without sliding, and what is missing.

        Args:
            twist: Wanted, seen from the body.
            tolerance: How large the missing part may be [m/s].

        Example:
            >>> base = WheeledBase.differential(half_track=0.25, radius=0.1)
            >>> base.feasible(Twist(1.0, 0.5, 0.0)).infeasible.as_array().round(12).tolist()
            [0.0, 0.5, 0.0]
        """
        matrix = self.mobility.projection.tolist()
        nearest = Twist._of(*(_row_speed(*row, *twist.parts) for row in matrix))
        allowed = checks.not_negative("tolerance", tolerance)
        return FeasibleTwist(twist, nearest, "; ".join(self.cannot), self.mobility.length, allowed)

    def slip(self, rates: ArrayLike, rate_std: ArrayLike, *, false_alarm: float = 0.01) -> Slip:
        """Whether redundant wheels disagree by more than their noise: chi-square with N - 3 degrees of freedom.

        Ordinary wheels count as rows that hold exactly, and leave N less the degrees of control.

        Args:
            rates: Shape (..., N) [rad/s].
            rate_std: Standard deviation of the measured rates, one for all or (N,) [rad/s].
            false_alarm: The share of rolling samples that are called slipping, between 0 and 1 [-].

        Example:
            >>> base = WheeledBase.mecanum(radius=0.1, half_length=0.3, half_width=0.2)
            >>> base.slip([10.0, 10.0, 10.0, 12.0], 0.1).status.value
            'the rates disagree by more than the noise explains: at least one wheel slips'
        """
        if not 0.0 < checks.real("false_alarm", false_alarm) < 1.0:
            raise InvalidValue("false_alarm", false_alarm, "between 0 and 1")
        measured = stack(self._per_wheel("rates", rates))
        return slip_of(
            measured, self._for_each_wheel("rate_std", rate_std), radii=self.radii, rows=self.rolling,
            free=self.mobility.free, degrees=len(self.wheels) - self.degrees_of_control,
            false_alarm=false_alarm, tolerance=self.rank_tolerance,
        )  # fmt: skip

    def saturate(self, rates: ArrayLike, max_rate: ArrayLike, *, policy: str = "scale") -> Saturation:
        """Wheel rates brought inside their limits.

        Args:
            rates: Shape (..., N) [rad/s].
            max_rate: The largest rate of either sign, one for all wheels or (N,) [rad/s].
            policy: "scale" keeps the path and drives it more slowly; "clip" cuts each rate by itself and changes the
                path; "keep_omega" keeps the turning as far as it fits by itself and leaves the rest to the translation.

        Raises:
            UnknownName: If the policy is none of these.

        Example:
            >>> base = WheeledBase.differential(half_track=0.25, radius=0.1)
            >>> base.saturate(base.rates(left=10.0, right=20.0), 10.0).rates.tolist()
            [5.0, 10.0]
        """
        checks.choice("policy", policy, POLICIES)
        limits = self._for_each_wheel("max_rate", max_rate).tolist()
        wanted = stack(self._per_wheel("rates", rates))
        before = self.forward(wanted)
        turning = self.inverse(Twist._of(0.0, 0.0, before.omega))
        inside, share, turn_share = limited(policy, wanted, turning, tuple(limits))
        return Saturation(policy, inside, wanted, self.forward(inside), before, share, turn_share)

    def _for_each_wheel(self, name: str, value: ArrayLike) -> np.ndarray:
        checked = np.asarray(checks.positive(name, value))
        if checked.shape not in ((), (len(self.wheels),)):
            raise InvalidShape(name, f"shape {checked.shape}", f"one number, or shape ({len(self.wheels)},)")
        return np.broadcast_to(checked, (len(self.wheels),))
