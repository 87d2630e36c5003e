"""Slip seen from redundant wheels, against a threshold that follows from the encoder noise."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from math import inf

import numpy as np

from coplanar.checks import Real
from coplanar.se2 import Twist


class SlipStatus(enum.Enum):
    """What the redundant wheels say."""

    ROLLING = "the rates agree with rolling, within the noise"
    SLIPPING = "the rates disagree by more than the noise explains: at least one wheel slips"
    BLIND = "no wheel is redundant: slip cannot be seen from the rates"


@dataclass(frozen=True, slots=True)
class Slip:
    """The part of the wheel rates that no motion of the base explains, measured in standard deviations.

    Under pure rolling with independent Gaussian rates the statistic is chi-square distributed with ``degrees``
    degrees of freedom, the number of redundant wheels: N - 3 for N omni or mecanum wheels.

    Attributes:
        statistic: Sum of the squared residuals in standard deviations, shape (...) [-].
        threshold: What the statistic stays below with probability 1 - false_alarm; infinite without redundancy [-].
        degrees: How many wheels are redundant.
        false_alarm: The share of rolling samples that are called slipping [-].
        residual: r phidot - J xi at the likeliest twist, shape (..., N) [m/s].
        scores: Each residual over its own standard deviation, shape (..., N) [-]. With two redundant wheels or more,
            the largest points at the wheel; with one, all of them are equal in size and none can be named.
        twist: The likeliest motion without sliding: least squares weighted by the noise.
    """

    statistic: Real
    threshold: float
    degrees: int
    false_alarm: float
    residual: np.ndarray
    scores: np.ndarray
    twist: Twist

    @property
    def is_slipping(self) -> bool | np.ndarray:
        """Whether the statistic exceeds the threshold: a bool, or an array of the leading shape."""
        over = np.greater(self.statistic, self.threshold)
        return over if over.ndim else bool(over)

    @property
    def status(self) -> SlipStatus:
        """One sentence; for a batch, ROLLING only if every entry rolls."""
        if self.degrees == 0:
            return SlipStatus.BLIND
        return SlipStatus.SLIPPING if np.any(self.is_slipping) else SlipStatus.ROLLING


def slip_of(
    rates: np.ndarray, stds: np.ndarray, *, radii: np.ndarray, rows: np.ndarray, free: np.ndarray,
    degrees: int, false_alarm: float, tolerance: float,
) -> Slip:  # fmt: skip
    """Project the whitened rates on what no twist explains.

    Args:
        rates: Shape (..., N) [rad/s].
        stds: Standard deviation of each rate, (N,) [rad/s].
        radii: (N,) [m].
        rows: Rolling rows, (N, 3).
        free: Twists that slide no ordinary wheel, (k, 3).
        degrees: How many wheels are redundant.
        false_alarm: Share of rolling samples that are called slipping [-].
        tolerance: Singular values below this share of the largest count as zero [-].
    """
    speed_stds = radii * stds
    explained = rows @ free.T / speed_stds[:, None]
    inverse = np.linalg.pinv(explained, rcond=tolerance)
    unexplained = np.eye(len(radii)) - explained @ inverse
    whitened = rates / stds
    parts = whitened @ unexplained.T
    spread = np.sqrt(np.maximum(np.diag(unexplained), 0.0))
    seen = spread > np.sqrt(tolerance)  # a wheel without a share in the redundancy shows no residual
    scores = np.where(seen, parts / np.where(seen, spread, 1.0), 0.0)
    statistic = np.sum(parts * parts, axis=-1)
    twist = Twist.from_array(whitened @ (free.T @ inverse).T)
    return Slip(
        statistic if statistic.ndim else float(statistic), _threshold(degrees, false_alarm), degrees, false_alarm,
        parts * speed_stds, scores, twist,
    )  # fmt: skip


def _threshold(degrees: int, false_alarm: float) -> float:
    from scipy.special import chdtri

    return float(chdtri(degrees, false_alarm)) if degrees else inf
