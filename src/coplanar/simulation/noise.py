"""What sensors and motors add, from a seed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import Real
from coplanar.errors import InvalidValue


@dataclass(frozen=True, slots=True, eq=False)
class Noise:
    """Independent normal noise at every step; the same seed gives the same run.

    Of many seeds each robot draws from its own, as it would alone.

    Attributes:
        position: Of the measured x and of y, standard deviation [m].
        heading: Of the measured theta [rad].
        v: Of the driven v [m/s].
        omega: Of the driven omega [rad/s].
        seed: Of NumPy's default generator; a whole number, or an array of them, one a robot.

    Example:
        >>> Noise(position=0.01, seed=1).draw(3, ()).shape
        (3, 5)
    """

    position: Real = 0.0
    heading: Real = 0.0
    v: Real = 0.0
    omega: Real = 0.0
    seed: Any = 0

    def __post_init__(self) -> None:
        for name in ("position", "heading", "v", "omega"):
            object.__setattr__(self, name, checks.frozen(checks.not_negative(name, getattr(self, name))))
        seeds = np.asarray(self.seed)
        if seeds.dtype.kind not in "iu" or np.any(seeds < 0):
            raise InvalidValue("seed", self.seed, "whole numbers of at least 0")
        object.__setattr__(self, "seed", checks.frozen(seeds) if seeds.ndim else int(seeds))

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading shape of its standard deviations and seeds."""
        sizes = {"position": self.position, "heading": self.heading, "v": self.v, "omega": self.omega}
        return checks.broadcast(**sizes, seed=self.seed)

    def draw(self, steps: int, shape: tuple[int, ...]) -> np.ndarray:
        """What is added to x, y, theta (measured), v, omega (driven), shape (steps, 5, ...)."""
        if np.ndim(self.seed):
            seeds = np.broadcast_to(self.seed, shape).ravel()
            rows = [np.random.default_rng(seed).standard_normal((steps, 5)) for seed in seeds.tolist()]
            unit = np.stack(rows, axis=-1).reshape(steps, 5, *shape)
        else:
            unit = np.random.default_rng(self.seed).standard_normal((steps, 5, *shape))
        sizes: tuple[Any, ...] = (self.position, self.position, self.heading, self.v, self.omega)
        drawn: np.ndarray = unit * np.stack([np.broadcast_to(size, shape) for size in sizes])
        return drawn
