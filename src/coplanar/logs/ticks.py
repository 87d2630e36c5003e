"""What the wheels of a robot measured, row by row, as odometry: counts, wheel rates, or velocities over time."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from math import tau
from typing import Any, ClassVar, NamedTuple

import numpy as np

from coplanar import checks
from coplanar.errors import InvalidValue
from coplanar.logs.columns import Rows
from coplanar.motion import Odometry, Reckoning
from coplanar.se2 import Displacement, Pose, Twist
from coplanar.wheels import WheeledBase

MOST_BITS = 53  # counts are exact in a float64 up to here
MOST_COUNT = 2.0**MOST_BITS


class Measured(ABC):
    """How rows become displacements.

    Attributes:
        names: The columns, the time first.
        timeless: Whether the time may be absent.
        between: Whether a displacement belongs to two rows, and not to one.
        allowed: What can have been measured, in words.
    """

    __slots__ = ()
    timeless: ClassVar[bool] = False
    between: bool = True
    allowed: str = "finite numbers"

    @property
    @abstractmethod
    def names(self) -> tuple[str, ...]:
        """The columns, the time first."""

    @abstractmethod
    def displacements(self, values: np.ndarray, dt: Any) -> Displacement:
        """What n + 1 rows, without their time, say about the n ticks of length dt [s] between them."""

    def wrong(self, values: np.ndarray) -> np.ndarray:
        """Which values cannot have been measured."""
        return np.zeros(values.shape, dtype=bool)


@dataclass(frozen=True, slots=True)
class Velocities(Measured):
    """Forward velocity v [m/s] and turn rate omega [rad/s], held until the next row.

    Example:
        >>> log = [Rows(np.array([[0.0, 1.0, 0.0], [2.0, 9.0, 9.0]]), np.array([1, 2]))]
        >>> next(reckon(log, Velocities())).poses.x.tolist()
        [0.0, 2.0]
    """

    @property
    def names(self) -> tuple[str, ...]:
        """Time, velocity, turn rate."""
        return ("t", "v", "omega")

    def displacements(self, values: np.ndarray, dt: Any) -> Displacement:
        """The velocities of each row but the last, for as long as they hold."""
        v, omega = values[:-1].T
        return Twist(v, 0.0, omega).during(dt)


@dataclass(frozen=True, slots=True)
class WheelRates(Measured):
    """Rates of the wheels of a base [rad/s], held until the next row.

    Attributes:
        base: Whose wheels they are; the columns have their names.

    Example:
        >>> rates = WheelRates(WheeledBase.differential(track=0.5, radius=0.1))
        >>> rates.names
        ('t', 'left', 'right')
    """

    base: WheeledBase

    @property
    def names(self) -> tuple[str, ...]:
        """The time, then the wheels."""
        return ("t", *self.base.names)

    def displacements(self, values: np.ndarray, dt: Any) -> Displacement:
        """The rates of each row but the last, for as long as they hold."""
        return self.base.forward(values[:-1]).during(dt)


@dataclass(frozen=True, slots=True)
class Encoders(Measured):
    """Whole counts of the encoders of a base's wheels, since some beginning or since the row before.

    Attributes:
        base: Whose wheels they are; the columns have their names.
        ticks_per_turn: Counts of one turn of a wheel; negative where they count backwards.
        bits: Of counters that wrap round, signed or not; None where they never do. Between two rows a wheel turns by
            less than half of their range.
        since_last: Whether a row counts since the one before.

    Raises:
        InvalidValue: If the ticks are 0 or not finite, or there are less than 2 or more than 53 bits.

    Example:
        >>> encoders = Encoders(WheeledBase.differential(track=0.5, radius=0.5), ticks_per_turn=100.0, bits=8)
        >>> log = [Rows(np.array([[250.0, 250.0], [4.0, 4.0]]), np.array([1, 2]))]
        >>> next(reckon(log, encoders)).poses.x.round(6).tolist()  # ten ticks of 0.0314 m
        [0.0, 0.314159]
    """

    base: WheeledBase
    ticks_per_turn: float = field(kw_only=True)
    bits: int | None = field(default=None, kw_only=True)
    since_last: bool = field(default=False, kw_only=True)
    timeless: ClassVar[bool] = True

    def __post_init__(self) -> None:
        if checks.real("ticks_per_turn", self.ticks_per_turn) == 0.0:
            raise InvalidValue("ticks_per_turn", self.ticks_per_turn, "a number that is not 0")
        if self.bits is not None and not 2 <= self.bits <= MOST_BITS:
            raise InvalidValue("bits", self.bits, f"2 to {MOST_BITS}")

    @property
    def names(self) -> tuple[str, ...]:
        """The time, then the wheels."""
        return ("t", *self.base.names)

    @property
    def between(self) -> bool:  # type: ignore[override]
        """Whether the counts are totals."""
        return not self.since_last

    @property
    def allowed(self) -> str:  # type: ignore[override]
        """Whole numbers within the counters."""
        return "a whole count of at most 2^53" if self.bits is None else f"a whole count of {self.bits} bits"

    def displacements(self, values: np.ndarray, dt: Any) -> Displacement:  # noqa: ARG002
        """The base's displacement by the counts, whenever they were made."""
        counts = values[1:] if self.since_last else np.diff(values, axis=0)
        if self.bits is not None:
            half = 2.0 ** (self.bits - 1)
            counts = (counts + half) % (2.0 * half) - half
        return self.base.displacement(counts * (tau / self.ticks_per_turn))

    def wrong(self, values: np.ndarray) -> np.ndarray:
        """Counts that are not whole, or beyond what counters of these bits hold."""
        low, high = (
            (-MOST_COUNT, MOST_COUNT) if self.bits is None else (-(2.0 ** (self.bits - 1)), 2.0**self.bits - 1.0)
        )
        wrong: np.ndarray = (values != np.rint(values)) | (values < low) | (values > high)
        return wrong


class Piece(NamedTuple):
    """Some rows of a log as a path.

    Attributes:
        times: Of the rows [s]; None where the log has none.
        poses: At the rows.
        covariances: At the rows, (n, 3, 3); None without noise.
        ticks: The displacements that lead to them.
        onward: The reckoning after them.
    """

    times: np.ndarray | None
    poses: Pose
    covariances: np.ndarray | None
    ticks: Displacement
    onward: Reckoning

    def first(self, count: int) -> Piece:
        """The poses of the first rows."""
        times = None if self.times is None else self.times[:count]
        covariances = None if self.covariances is None else self.covariances[:count]
        return self._replace(times=times, poses=self.poses[:count], covariances=covariances)


def reckon(
    rows: Iterable[Rows], measured: Measured, reckoning: Reckoning | None = None, *, name: str = "log",
    equal_times: bool = False,
) -> Iterator[Piece]:  # fmt: skip
    """The path along the rows of a log, one pose for each row: the start for the first one, unless it counts by itself.

    Args:
        rows: In the columns of ``measured``, some at a time; of any number in all.
        measured: What they are.
        reckoning: Where it begins, how, and how sure it is.
        name: What an error calls the log.
        equal_times: Whether a time may be that of the row before.

    Raises:
        InvalidValue: Naming the line at which time does not go on, or that holds what cannot have been measured.
    """
    onward, before = reckoning or Reckoning(), None
    for piece in rows:
        timed = piece.values.shape[1] == len(measured.names)
        good, fault = _measurable(before, piece, measured, timed, equal_times, name)
        if len(good.lines):
            path = _along(before, good, measured, timed, onward)
            count, lost = _on_the_plane(path, good, name)
            if count:
                yield path if lost is None else path.first(count)
            onward, before, fault = path.onward, good.values[-1:], lost or fault
        if fault is not None:
            raise fault


def _along(before: np.ndarray | None, piece: Rows, measured: Measured, timed: bool, reckoning: Reckoning) -> Piece:
    """The path along some rows, after the last one of the piece before."""
    if before is not None:
        values = np.concatenate((before, piece.values))
    elif measured.between:
        values = piece.values
    else:  # what counts by itself has some row before the first too
        values = np.concatenate((piece.values[:1], piece.values))
    times, new = values[:, 0] if timed else None, len(values) - len(piece.values)
    with np.errstate(over="ignore", invalid="ignore"):
        ticks = measured.displacements(values[:, int(timed) :], None if times is None else np.diff(times))
        stretch = reckoning.follow(Odometry(ticks))
    covariances = None if stretch.covariances is None else stretch.covariances[new:]
    return Piece(None if times is None else times[new:], stretch.poses[new:], covariances, ticks, stretch.onward)


def _measurable(
    before: np.ndarray | None, piece: Rows, measured: Measured, timed: bool, equal: bool, name: str
) -> tuple[Rows, InvalidValue | None]:
    """The rows up to the first whose time does not go on or that cannot have been measured, and what is wrong."""
    wrong = measured.wrong(piece.values[:, int(timed) :])
    late = np.zeros(len(piece.lines), dtype=bool)
    if timed:
        times = piece.values[:, 0] if before is None else np.concatenate((before[:, 0], piece.values[:, 0]))
        steps = np.diff(times)
        late[len(late) - len(steps) :] = steps < 0.0 if equal else steps <= 0.0
    bad = late | wrong.any(axis=1)
    if not bad.any():
        return piece, None
    i = int(np.argmax(bad))
    line = f"line {piece.lines[i]} of {name}"
    if late[i]:
        now, last = piece.values[i, 0], times[i + len(times) - len(late) - 1]
        needed = f"a time {'of at least' if equal else 'after'} {last:.17g}, that of the row before"
        remedy = "rows of equal times can be accepted" if now == last else ""
        fault = InvalidValue(f"t in {line}", float(now), needed, remedy)
    else:
        j = int(np.argmax(wrong[i]))
        column = measured.names[j + 1]
        fault = InvalidValue(f"{column} in {line}", float(piece.values[i, j + int(timed)]), measured.allowed)
    return Rows(piece.values[:i], piece.lines[:i]), fault


def _on_the_plane(path: Piece, piece: Rows, name: str) -> tuple[int, InvalidValue | None]:
    """How many of the poses are finite, and where the first is that is not."""
    finite = np.isfinite(path.poses.as_array()).all(axis=1)
    if finite.all():
        return len(finite), None
    i = int(np.argmin(finite))
    pose = tuple(path.poses[i].as_array().tolist())
    return i, InvalidValue(f"path at line {piece.lines[i]} of {name}", pose, "finite numbers: no robot is that fast")
