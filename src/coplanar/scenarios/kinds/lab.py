"""The laboratory of integrators: how far each is from the exact path, of which order, and with what step it will do."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.integrators import METHODS
from coplanar.motion import Comparison, Program
from coplanar.scenarios import truths
from coplanar.scenarios.outcome import Outcome
from coplanar.scenarios.parts.common import PosePart
from coplanar.scenarios.parts.motion import Segments
from coplanar.scenarios.quantities import Duration, PositiveLength
from coplanar.scenarios.scenario import Progress, Scenario

INTEGRATED = 1e-9  # [m] that an adaptive integration at 1e-12 may be apart
OFF_ORDER = 0.3  # by which a measured order may be off
Method = Literal["euler", "midpoint", "heun", "rk4"]


class Compared(NamedTuple):
    """What the library makes of it."""

    comparison: Comparison


class Lab(Scenario):
    """A motion, methods and steps."""

    example: ClassVar[dict[str, Any]] = {
        "segments": [{"v": 1.0, "omega": -0.5, "a": 0.2, "alpha": 0.8, "duration": 3.0}],
    }  # fmt: skip

    type: Literal["lab"] = Field(default="lab", description="Integrators side by side")
    segments: Segments = Field(description="The motion that is integrated")
    start: PosePart = Field(default=PosePart(), description="Where it sets off")
    methods: Annotated[tuple[Method, ...], Field(min_length=1, max_length=8)] = Field(
        default=("euler", "midpoint", "heun", "rk4"), description="What is compared with the exact path"
    )
    steps: Annotated[tuple[Duration, ...], Field(min_length=1, max_length=24)] = Field(
        default=(0.5, 0.25, 0.125, 0.0625, 0.03125), description="Steps to compare"
    )
    tolerance: PositiveLength = Field(default=1e-3, description="Distance for which the largest step is looked for")

    def build(self) -> Compared:
        """The comparison, not yet made."""
        program = Program([segment.build() for segment in self.segments])
        return Compared(Comparison(program, self.start.build(), self.methods, self.steps))

    def _numbers(self, things: Any) -> dict[str, Any]:
        compared: Comparison = things.comparison
        return self._numbers_of(compared, compared.errors())

    def _numbers_of(self, compared: Comparison, errors: np.ndarray) -> dict[str, Any]:
        orders = compared.orders(errors)
        numbers: dict[str, Any] = {}
        for method, row, order in zip(self.methods, errors, orders, strict=True):
            numbers[f"{method}_error"] = float(row[int(np.argmax(self.steps))])
            numbers[f"{method}_order"] = float(order)
            numbers[f"{method}_largest_step"] = compared.largest_step(method, self.tolerance)
        return numbers

    def _outcome(self, progress: Progress, /) -> Outcome:
        built = self.build()
        compared = built.comparison
        errors = compared.errors()
        progress(0.4)
        numbers = self._numbers_of(compared, errors)
        exact = truths.program_error(compared.program)
        orders = {method: numbers[f"{method}_order"] for method in self.methods}
        off = max((abs(order - METHODS[m].order) for m, order in orders.items() if np.isfinite(order)), default=0.0)
        largest = ", ".join(f"{m} {_in_ms(numbers[f'{m}_largest_step'])}" for m in self.methods)
        rows = [
            (m, h, e) for m, row in zip(self.methods, errors, strict=True) for h, e in zip(self.steps, row, strict=True)
        ]
        return self._told(
            built,
            numbers,
            {"errors": errors},
            ok=True,
            status="every method was compared with the exact path",
            headline=f"largest step for {1000.0 * self.tolerance:g} mm: {largest}",
            check=f"exact path against DOP853 at 1e-12: {exact:.0e} m; orders within {off:.2f} of the tables'",
            passed=bool(exact < INTEGRATED and off < OFF_ORDER),
            tables={"run.csv": dict(zip(("method", "step", "error"), zip(*rows, strict=True), strict=True))},
        )


def _in_ms(step: float) -> str:
    return f"{1000.0 * step:.3g} ms" if step else "none that is practical"
