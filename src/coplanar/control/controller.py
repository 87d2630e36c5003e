"""What a closed loop asks of a controller."""

from __future__ import annotations

from typing import Any, ClassVar, Protocol

import numpy as np

from coplanar.checks import ArrayLike, Real
from coplanar.control.stability import StabilityReport
from coplanar.control.unicycle import Command, State
from coplanar.se2 import Pose


class Timed(Protocol):
    """A point that moves in time, such as ``coplanar.curves.Reference``."""

    def position(self, t: ArrayLike) -> np.ndarray:
        """[m], shape (..., 2)."""
        ...

    def velocity(self, t: ArrayLike) -> np.ndarray:
        """[m/s], shape (..., 2)."""
        ...

    def acceleration(self, t: ArrayLike) -> np.ndarray:
        """[m/s^2], shape (..., 2)."""
        ...


class Controller(Protocol):
    """(error, reference) -> command, as ``simulate`` calls it.

    What it remembers from step to step is handed back and forth, so that a controller is never changed by a run.
    """

    error_names: ClassVar[tuple[str, ...]]

    @property
    def shape(self) -> tuple[int, ...]:
        """Leading shape of its parameters."""
        ...

    def stability(self, step: ArrayLike, *, method: str = "euler", speed: ArrayLike = 0.0) -> StabilityReport:
        """What the loop will do."""
        ...

    def start(self, reference: Any, time: float) -> Pose:
        """Where a run begins unless told."""
        ...

    def targets(self, reference: Any, times: np.ndarray, dimensions: int) -> tuple[np.ndarray, ...]:
        """What each step aims at: arrays (steps, ...)."""
        ...

    def memory(self, state: State) -> tuple[Any, ...]:
        """What it remembers before the first step."""
        ...

    def respond(self, state: State, target: Any, memory: Any, step: Real) -> tuple[Command, tuple[Real, ...], Any]:
        """Command, errors (as ``error_names``) and the new memory."""
        ...


def as_column(times: np.ndarray, dimensions: int) -> np.ndarray:
    """Times (steps,) with as many axes of length 1 behind them as a batch of robots has."""
    return times.reshape(-1, *(1,) * dimensions)
