"""Wheel rates brought inside their limits, and what that does to the motion."""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from typing import Any

import numpy as np

from coplanar.checks import Real
from coplanar.engine import components, evaluator, stack
from coplanar.laws import wheels as laws
from coplanar.se2 import Twist

_clipped = evaluator(laws.clipped)
_limited_share = evaluator(laws.limited_share)
_moving_share = evaluator(laws.moving_share)
_turning_share = evaluator(laws.turning_share)

POLICIES = {
    "scale": "all rates times one share: the same path, driven more slowly",
    "clip": "each rate clipped by itself: the path changes",
    "keep_omega": "the turning kept as far as it fits by itself, the translation cut to the rest: the path changes",
}


@dataclass(frozen=True, slots=True)
class Saturation:
    """Limited wheel rates, and the motion before and after.

    Attributes:
        policy: "scale", "clip" or "keep_omega".
        rates: Inside the limits, shape (..., N) [rad/s].
        wanted_rates: As they were asked for, shape (..., N) [rad/s].
        twist: The motion of ``rates``.
        wanted: The motion of ``wanted_rates``.
        share: What the translation was multiplied by; for "clip", the rate that was cut most; 1 if unlimited [-].
        turn_share: What the turning was multiplied by; the same as ``share`` except for "keep_omega" [-].
    """

    policy: str
    rates: np.ndarray
    wanted_rates: np.ndarray
    twist: Twist
    wanted: Twist
    share: Real
    turn_share: Real

    @property
    def is_limited(self) -> bool | np.ndarray:
        """Whether a rate was changed: a bool, or an array of the leading shape."""
        less = np.less(np.minimum(self.share, self.turn_share), 1.0)
        return less if less.ndim else bool(less)

    @property
    def sentence(self) -> str:
        """What was changed, in words."""
        if not np.any(self.is_limited):
            return "every rate is inside its limit: nothing changed"
        return f"{POLICIES[self.policy]}; share {np.min(self.share):.3g}"


def limited(policy: str, rates: Any, turning_rates: Any, limits: tuple[float, ...]) -> tuple[Any, Any, Any]:
    """The rates inside their limits, the share of the translation and the share of the turning.

    Args:
        policy: One of ``POLICIES``.
        rates: Shape (..., N) [rad/s].
        turning_rates: The part of the rates that turns the base, shape (..., N) [rad/s].
        limits: One for each wheel [rad/s].
    """
    wanted, turning = components(rates), components(turning_rates)
    turn_share = share = _share(wanted, limits)
    kept = wanted
    if policy == "scale":
        kept = tuple(share * rate for rate in wanted)
    elif policy == "keep_omega":
        turn_share = _turning_share(_share(turning, limits), share)
        moving = [rate - turn for rate, turn in zip(wanted, turning, strict=True)]
        wheels = zip([turn_share * turn for turn in turning], moving, limits, strict=True)
        share = reduce(lambda least, wheel: _moving_share(least, *wheel), wheels, 1.0)
        # The wanted rate less what was given up: exactly the wanted one where nothing is.
        kept = tuple(
            rate - (1.0 - turn_share) * turn - (1.0 - share) * move
            for rate, turn, move in zip(wanted, turning, moving, strict=True)
        )
    # A rounding above the limit is cut off too.
    return stack([_clipped(rate, limit) for rate, limit in zip(kept, limits, strict=True)]), share, turn_share


def _share(rates: Any, limits: tuple[float, ...]) -> Any:
    return reduce(lambda least, wheel: _limited_share(least, *wheel), zip(rates, limits, strict=True), 1.0)
