"""Dead reckoning that goes on: odometry of any length, piece by piece, in the memory of one piece."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.motion.covariance import OdometryNoise, about, carried, checked_covariance, summed_about
from coplanar.motion.odometry import EXACT, PATH_METHODS, Odometry, walked
from coplanar.se2 import Pose


class Stretch(NamedTuple):
    """A piece of a path.

    Attributes:
        poses: Before each tick of the piece and after its last one, shape (..., n + 1).
        covariances: Of (x, y, theta) at these poses, shape (..., n + 1, 3, 3); None without noise.
        onward: The reckoning that the next piece is given to.
    """

    poses: Pose
    covariances: np.ndarray | None
    onward: Reckoning


@dataclass(frozen=True, slots=True)
class Reckoning:
    """Odometry up to now: pieces of it, each given to what the one before left, are one path, to the last bit.

    The sums are carried, not the pose: what a long sum rounds does not hang on where it was cut.

    Attributes:
        start: Where it began.
        method: "exact" for arcs, or a Runge-Kutta method; see ``Odometry.path``.
        noise: Of the increments; without it no covariance is computed.
        initial: Covariance at the start, shape (..., 3, 3); certain where None.
        sums: Chords and turns summed since the start [m, m, rad]; None before the first piece.
        spread: The covariance so far, as if each tick had swung the path about the start; None likewise.

    Raises:
        UnknownName: If there is no such method.
        InvalidShape: If the initial covariance is not 3 by 3.
        InvalidValue: If it is not symmetric.

    Example:
        >>> from coplanar.se2 import Displacement
        >>> first = Reckoning(Pose()).follow(Odometry(Displacement([1.0, 1.0], 0.0, 0.0)))
        >>> first.onward.follow(Odometry(Displacement([3.0], 0.0, 0.0))).poses.x.tolist()
        [2.0, 5.0]
    """

    start: Pose = field(default_factory=Pose)
    method: str = field(default=EXACT, kw_only=True)
    noise: OdometryNoise | None = field(default=None, kw_only=True)
    initial: ArrayLike | None = field(default=None, kw_only=True)
    sums: tuple[Real | None, Real | None, Real | None] = field(default=(None, None, None), kw_only=True)
    spread: np.ndarray | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        checks.instance("start", self.start, Pose)
        checks.choice("method", self.method, PATH_METHODS)
        if self.initial is not None:
            object.__setattr__(self, "initial", checks.frozen(checked_covariance("initial", self.initial)))

    @property
    def pose(self) -> Pose:
        """Where the body is now."""
        return Pose._of(*(p if s is None else p + s for p, s in zip(self.start.parts, self.sums, strict=True)))

    def follow(self, odometry: Odometry) -> Stretch:
        """Go on by the next ticks.

        Args:
            odometry: What they measured; none of them is an empty piece.
        """
        increments = odometry.increments
        poses, sums = walked(increments, self.start, self.method, self.sums)
        if self.noise is None:
            return Stretch(poses, None, replace(self, sums=sums))
        first = self.spread if self.spread is not None else np.zeros((3, 3)) if self.initial is None else self.initial
        summed = summed_about(poses, self.start, increments, self.noise.covariances(increments), first)
        covariances = carried(about(poses, self.start), summed)
        return Stretch(poses, covariances, replace(self, sums=sums, spread=summed[..., -1, :, :]))
