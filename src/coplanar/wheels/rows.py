"""The rows of a table of wheels: between the twist of the body and the rates of the wheels."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import reduce
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, frozen
from coplanar.engine import components, evaluator, stack
from coplanar.errors import InvalidValue
from coplanar.laws import rolling as rolling_laws
from coplanar.laws import wheels as laws
from coplanar.se2 import Displacement, Twist
from coplanar.wheels.mobility import Mobility
from coplanar.wheels.wheel import Wheel, positive_number

_add_share = evaluator(laws.add_share)
_lateral_row = evaluator(laws.lateral_row)
_pfaffian_row = evaluator(laws.pfaffian_row)
_point_velocity = evaluator(rolling_laws.point_velocity)
_rolling_row = evaluator(laws.rolling_row)
_row_residual = evaluator(laws.row_residual)
_wheel_rate = evaluator(laws.wheel_rate)


@dataclass(frozen=True, slots=True)
class WheelRows:
    """A table of wheels as rows: r phidot = J xi for every wheel, and 0 = lateral xi for every ordinary one.

    Attributes:
        wheels: One or more; those without a name are called wheel_1, wheel_2 and so on.
        rank_tolerance: Singular values below this share of the largest, or of 1, count as zero [-].
        rolling: J, one row for each wheel, (N, 3) [1, 1, m].
        lateral: One row for each ordinary wheel, (L, 3) [1, 1, m].
        radii: (N,) [m].
        mobility: Ranks and directions that follow from the rows.
    """

    wheels: tuple[Wheel, ...]
    rank_tolerance: float = field(default=1e-9, kw_only=True)
    rolling: np.ndarray = field(init=False, repr=False, compare=False)
    lateral: np.ndarray = field(init=False, repr=False, compare=False)
    radii: np.ndarray = field(init=False, repr=False, compare=False)
    mobility: Mobility = field(init=False, repr=False, compare=False)
    _columns: tuple[tuple[float, ...], ...] = field(init=False, repr=False, compare=False)
    _rows: tuple[tuple[float, ...], ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        wheels = _named(tuple(self.wheels))
        radii = np.array([w.radius for w in wheels])
        rolling = np.array([_rolling_row(w.x, w.y, w.drive_angle, w.roller_angle or 0.0) for w in wheels])
        lateral = np.array([_lateral_row(w.x, w.y, w.drive_angle) for w in wheels if w.is_ordinary]).reshape(-1, 3)
        length = float(np.sqrt(np.mean([w.x * w.x + w.y * w.y for w in wheels]))) or 1.0
        tolerance = positive_number("rank_tolerance", self.rank_tolerance)
        mobility = Mobility.of_rows(rolling, lateral, length=length, tolerance=tolerance)
        columns = (mobility.inverse[:, : len(wheels)] * radii).T
        values = {
            "wheels": wheels, "rolling": frozen(rolling), "lateral": frozen(lateral), "radii": frozen(radii),
            "mobility": mobility, "_columns": tuple(map(tuple, columns.tolist())),
            "_rows": tuple(map(tuple, np.column_stack([rolling, radii]).tolist())),
        }  # fmt: skip
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the wheels, in the order of the rates."""
        return tuple(wheel.name for wheel in self.wheels)

    @property
    def row_names(self) -> tuple[str, ...]:
        """The names of the entries of ``residual``."""
        sideways = (f"{wheel.name} lateral" for wheel in self.wheels if wheel.is_ordinary)
        return (*(f"{name} rolling" for name in self.names), *sideways)

    def rates(self, **rates: ArrayLike) -> np.ndarray:
        """Wheel rates by name, side by side in the order of the wheels, shape (..., N) [rad/s].

        Args:
            **rates: One for each wheel; they broadcast.

        Raises:
            UnknownName: If a name is not that of a wheel.
            InvalidValue: If a wheel is missing.
        """
        for name in rates:
            checks.choice("wheel", name, self.names)
        missing = [name for name in self.names if name not in rates]
        if missing:
            raise InvalidValue("rates", list(rates), "one rate for each wheel", "missing: " + ", ".join(missing))
        values = {name: checks.real(name, rates[name]) for name in self.names}
        checks.broadcast(**values)
        side_by_side: np.ndarray = stack(list(values.values()))
        return side_by_side

    def by_name(self, rates: ArrayLike) -> dict[str, Any]:
        """Wheel rates (..., N) as a dictionary from names to floats or arrays."""
        return dict(zip(self.names, self._per_wheel("rates", rates), strict=True))

    def inverse(self, twist: Twist) -> np.ndarray:
        """Rates phidot = J xi / r of a twist, shape (..., N) [rad/s].

        What ordinary wheels forbid is left out: ``feasible`` says what that is.

        Args:
            twist: Seen from the body.
        """
        rates: np.ndarray = stack([_wheel_rate(*row, *twist.parts) for row in self._rows])
        return rates

    def forward(self, rates: ArrayLike) -> Twist:
        """Twist xi = J+ r phidot of wheel rates, by least squares over the rolling and the lateral rows.

        All rows weigh the same; ``slip`` weighs by the noise and takes the lateral rows as exact. Motions that no
        wheel drives (rank below 3) are taken as zero.

        Args:
            rates: Shape (..., N), in the order of ``names`` [rad/s].

        Returns:
            Seen from the body, of shape (...).
        """
        return Twist._of(*self._sum("rates", rates))

    def displacement(self, rotations: ArrayLike) -> Displacement:
        """Displacement J+ r phi of wheel rotations made together at constant rates.

        Args:
            rotations: Shape (..., N) [rad].
        """
        return Displacement._of(*self._sum("rotations", rotations))

    def rotations(self, displacement: Displacement) -> np.ndarray:
        """Rotations phi = J d / r of a displacement at a constant twist, shape (..., N) [rad]."""
        phi: np.ndarray = stack([_wheel_rate(*row, *displacement.parts) for row in self._rows])
        return phi

    def wheel_accelerations(self, twist_rates: ArrayLike) -> np.ndarray:
        """Accelerations J xidot / r of the wheels, shape (..., N) [rad/s^2].

        Args:
            twist_rates: Rates of change of (vx, vy, omega) seen from the body, shape (..., 3) [m/s^2, m/s^2, rad/s^2].
        """
        parts = components(checks.vector("twist_rates", twist_rates, 3))
        accelerations: np.ndarray = stack([_wheel_rate(*row, *parts) for row in self._rows])
        return accelerations

    def twist_rates(self, wheel_accelerations: ArrayLike) -> np.ndarray:
        """Twist rates J+ r phidotdot: rates of change of (vx, vy, omega) seen from the body, shape (..., 3).

        Args:
            wheel_accelerations: Shape (..., N) [rad/s^2].
        """
        rates: np.ndarray = stack(self._sum("wheel_accelerations", wheel_accelerations))
        return rates

    def residual(self, rates: ArrayLike, twist: Twist | None = None) -> np.ndarray:
        """Residual r phidot - J xi of every wheel, then 0 - lateral xi of every ordinary one, shape (..., N + L) [m/s].

        Args:
            rates: Shape (..., N) [rad/s].
            twist: Any twist; that of ``forward`` when None.
        """
        parts = (self.forward(rates) if twist is None else twist).parts
        speeds = [r * rate for r, rate in zip(self.radii.tolist(), self._per_wheel("rates", rates), strict=True)]
        rolling = [_row_residual(speed, *row[:3], *parts) for speed, row in zip(speeds, self._rows, strict=True)]
        gaps: np.ndarray = stack(rolling + [_row_residual(0.0, *row, *parts) for row in self.lateral.tolist()])
        return gaps

    def wheel_velocities(self, twist: Twist) -> np.ndarray:
        """Velocity [vx, vy] + omega [-y, x] of every wheel's centre, seen from the body, shape (..., N, 2) [m/s]."""
        velocities = [stack(_point_velocity(*twist.parts, w.x, w.y)) for w in self.wheels]
        side_by_side: np.ndarray = stack(velocities, axis=-2)
        return side_by_side

    def constraints(self, heading: ArrayLike) -> np.ndarray:
        """A(q) with A(q) qdot = 0: the independent lateral rows in the world, shape (..., k, 3).

        For the differential drive this is -xdot sin theta + ydot cos theta = 0. A base without ordinary wheels
        has none: k = 0.

        Args:
            heading: theta of the body in the world [rad].
        """
        theta = checks.real("heading", heading)
        independent = self._independent_lateral()
        if not independent:
            return np.zeros((*np.shape(theta), 0, 3))
        rows: np.ndarray = stack([stack(_pfaffian_row(*row, theta)) for row in independent], axis=-2)
        return rows

    def _independent_lateral(self) -> list[list[float]]:
        """The lateral rows, without those that follow from the ones before."""
        kept: list[list[float]] = []
        scale = [1.0, 1.0, self.mobility.length]
        for row in self.lateral.tolist():
            rank = np.linalg.matrix_rank(np.array([*kept, row]) / scale, rtol=self.rank_tolerance)
            kept += [row] * (int(rank) - len(kept))
        return kept

    def _sum(self, name: str, rates: ArrayLike) -> tuple[Any, Any, Any]:
        shares = zip(self._columns, self._per_wheel(name, rates), strict=True)
        return reduce(lambda total, share: _add_share(*total, *share[0], share[1]), shares, (0.0, 0.0, 0.0))

    def _per_wheel(self, name: str, rates: ArrayLike) -> tuple[Any, ...]:
        order = "in the order " + ", ".join(self.names)
        return components(checks.vector(name, rates, len(self.wheels), remedy=order))


def _named(wheels: tuple[Wheel, ...]) -> tuple[Wheel, ...]:
    """The wheels, each with a name of its own."""
    if not wheels:
        raise InvalidValue("wheels", wheels, "at least one wheel")
    named = tuple(w if w.name else replace(w, name=f"wheel_{i}") for i, w in enumerate(wheels, start=1))
    names = [w.name for w in named]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise InvalidValue("wheels", twice, "a name of its own for every wheel")
    return named
