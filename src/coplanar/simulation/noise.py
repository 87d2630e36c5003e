"""What sensors and motors add, from a seed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import Real


@dataclass(frozen=True, slots=True, eq=False)
class Noise:
    """Independent normal noise at every step; the same seed gives the same run.

    Attributes:
        position: Of the measured x and of y, standard deviation [m].
        heading: Of the measured theta [rad].
        v: Of the driven v [m/s].
        omega: Of the driven omega [rad/s].
        seed: Of NumPy's default generator.

    Example:
        >>> Noise(position=0.01, seed=1).draw(3, ()).shape
        (3, 5)
    """

    position: Real = 0.0
    heading: Real = 0.0
    v: Real = 0.0
    omega: Real = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        for name in ("position", "heading", "v", "omega"):
            object.__setattr__(self, name, checks.frozen(checks.not_negative(name, getattr(self, name))))

    @property
    def shape(self) -> tuple[int, ...]:
        """The leading shape of its standard deviations."""
        return checks.broadcast(position=self.position, heading=self.heading, v=self.v, omega=self.omega)

    def draw(self, steps: int, shape: tuple[int, ...]) -> np.ndarray:
        """What is added to x, y, theta (measured), v, omega (driven), shape (steps, 5, ...)."""
        unit = np.random.default_rng(self.seed).standard_normal((steps, 5, *shape))
        sizes: tuple[Any, ...] = (self.position, self.position, self.heading, self.v, self.omega)
        drawn: np.ndarray = unit * np.stack([np.broadcast_to(size, shape) for size in sizes])
        return drawn
