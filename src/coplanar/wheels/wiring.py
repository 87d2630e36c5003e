"""Which motor turns which wheel, and which way: from jogging one motor at a time."""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike
from coplanar.errors import InvalidShape, InvalidValue, NoSolution
from coplanar.se2 import Twist
from coplanar.wheels.rows import WheelRows
from coplanar.wheels.words import listed


class WiringStatus(enum.Enum):
    """What the jogs say."""

    CORRECT = "every motor turns its own wheel, the right way round"
    MISWIRED = "motors are swapped or inverted"
    UNCLEAR = "the jogs do not tell the wheels apart"


@dataclass(frozen=True, slots=True)
class Wiring:
    """Which wheel each motor turns.

    Attributes:
        motors: The motors, called after the wheel that each should turn.
        wheels: The wheel that each motor turns.
        inverted: Whether it turns it the wrong way round.
        match: How well the observed motion fits, 1 is exactly [-].
        unclear: The motors whose motion fits no wheel, or more than one.
    """

    motors: tuple[str, ...]
    wheels: tuple[str, ...]
    inverted: tuple[bool, ...]
    match: tuple[float, ...]
    unclear: tuple[str, ...]

    @property
    def status(self) -> WiringStatus:
        """One sentence about all motors."""
        if self.unclear:
            return WiringStatus.UNCLEAR
        right = self.wheels == self.motors and not any(self.inverted)
        return WiringStatus.CORRECT if right else WiringStatus.MISWIRED

    @property
    def sentences(self) -> tuple[str, ...]:
        """One for each motor that is not right, and one for all that are not clear."""
        told = [
            self._sentence(motor, wheel, inverted)
            for motor, wheel, inverted in zip(self.motors, self.wheels, self.inverted, strict=True)
            if motor not in self.unclear and (wheel != motor or inverted)
        ]
        if self.unclear:
            told.append(f"what {listed(self.unclear)} did fits no wheel, or more than one: jog again, on the ground")
        return tuple(told) or (self.status.value,)

    def commands(self, rates: ArrayLike) -> np.ndarray:
        """What to send to the motors, in their order, so that the wheels turn at these rates, shape (..., N) [rad/s].

        Args:
            rates: Wanted, in the order of the wheels of the base, shape (..., N) [rad/s].

        Raises:
            NoSolution: If the wiring is not clear.
        """
        self.or_raise()
        wanted = checks.vector("rates", rates, len(self.motors))
        sources = [self.motors.index(wheel) for wheel in self.wheels]
        signed: np.ndarray = wanted[..., sources] * np.where(self.inverted, -1.0, 1.0)
        return signed

    def or_raise(self) -> Wiring:
        """This result, if it is clear.

        Raises:
            NoSolution: If a motor's motion fits no wheel, or more than one.
        """
        if self.unclear:
            raise NoSolution(f"{self.status.value}: {self.sentences[-1]}", self)
        return self

    @staticmethod
    def _sentence(motor: str, wheel: str, inverted: bool) -> str:
        if wheel == motor:
            return f"motor {motor} is inverted"
        return f"motor {motor} turns the wheel {wheel}" + (", inverted" if inverted else "")


def identify_wiring(
    base: WheelRows, jogs: Twist | ArrayLike, *, jog_rates: ArrayLike = 1.0, least_match: float = 0.8,
    least_margin: float = 0.1,
) -> Wiring:  # fmt: skip
    """Which motor turns which wheel: each motor was jogged alone, the others held, and the motion observed.

    The direction of each observed motion is compared with the one that each wheel would cause; its size is not used.

    Args:
        base: The table of wheels as it should be.
        jogs: The observed motion of each jog, in the order of the wheels: a Twist of shape (N,), or (N, 3).
        jog_rates: The commanded rate of each jog; only its sign counts [rad/s].
        least_match: Cosine between observed and expected direction below which a motion fits no wheel [-].
        least_margin: Lead of the best fit over the next below which it is not clear [-].

    Returns:
        The assignment of motors to wheels that fits best altogether.

    Raises:
        InvalidShape: If there is not one jog for each wheel.
        InvalidValue: If a commanded rate is 0.

    Example:
        >>> from coplanar.wheels import WheeledBase
        >>> base = WheeledBase.differential(half_track=0.25, radius=0.1)
        >>> identify_wiring(base, [(-0.05, 0.0, 0.2), (0.05, 0.0, 0.2)]).sentences
        ('motor left is inverted',)
    """
    from scipy.optimize import linear_sum_assignment

    fit = _cosines(base, jogs, jog_rates)
    strength = np.abs(fit)
    wheels = linear_sum_assignment(-strength)[1]
    motors = np.arange(len(wheels))
    match = strength[motors, wheels]
    others = strength.copy()
    others[motors, wheels] = 0.0
    poor = (match < least_match) | (match - others.max(axis=1) < least_margin)
    names = base.names
    return Wiring(
        names, tuple(names[j] for j in wheels), tuple((fit[motors, wheels] < 0.0).tolist()), tuple(match.tolist()),
        tuple(name for name, bad in zip(names, poor, strict=True) if bad),
    )  # fmt: skip


def _cosines(base: WheelRows, jogs: Twist | ArrayLike, jog_rates: ArrayLike) -> np.ndarray:
    """Cosine between each observed motion and the one that each wheel causes, (motors, wheels)."""
    count = len(base.wheels)
    observed = jogs.as_array() if isinstance(jogs, Twist) else checks.vector("jogs", jogs, 3)
    if observed.shape != (count, 3):
        raise InvalidShape("jogs", f"shape {observed.shape}", f"shape ({count}, 3)", "jog every motor once")
    signs = np.sign(np.broadcast_to(checks.real("jog_rates", jog_rates), (count,)))
    if not signs.all():
        raise InvalidValue("jog_rates", jog_rates, "rates that are not 0")
    expected = base.forward(np.eye(count)).as_array()
    cosines: np.ndarray = (_directions(observed, base) * signs[:, None]) @ _directions(expected, base).T
    return cosines


def _directions(twists: np.ndarray, base: WheelRows) -> np.ndarray:
    """The twists with omega counted as a speed, each divided by its length; zero stays zero."""
    speeds = twists * np.array([1.0, 1.0, base.mobility.length])
    lengths = np.linalg.norm(speeds, axis=-1, keepdims=True)
    units: np.ndarray = np.divide(speeds, lengths, out=np.zeros_like(speeds), where=lengths > 0.0)
    return units
