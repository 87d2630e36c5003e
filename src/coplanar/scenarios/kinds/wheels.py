"""A base on wheels and a motion that is asked of it: wheel rates, what it cannot do, where it turns."""

from __future__ import annotations

from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.run import Run
from coplanar.scenarios import truths
from coplanar.scenarios.outcome import Finding, Outcome
from coplanar.scenarios.parts.bases import AnyBase, TwistPart
from coplanar.scenarios.parts.common import Rows
from coplanar.scenarios.quantities import Duration
from coplanar.scenarios.scenario import Progress, Scenario
from coplanar.se2 import Pose, Twist
from coplanar.wheels import FeasibleTwist, Icr, WheeledBase


class Carried(NamedTuple):
    """What the library makes of it."""

    base: WheeledBase
    feasible: FeasibleTwist
    twist: Twist
    rates: np.ndarray


class Wheels(Scenario):
    """A table of wheels and a twist."""

    vectorised_keys: ClassVar[tuple[str, ...]] = ("twist.*",)
    example: ClassVar[dict[str, Any]] = {
        "base": {"type": "omni", "count": 3, "wheel_distance": 0.2, "radius": 0.05},
        "twist": {"vx": 0.5, "vy": 0.2, "omega": 1.0},
    }  # fmt: skip

    type: Literal["wheels"] = Field(default="wheels", description="A base on wheels and a motion asked of it")
    base: AnyBase = Field(description="The wheels")
    twist: TwistPart = Field(description="The motion that is wanted, seen from the body")
    duration: Duration = Field(default=6.0, description="How long it is driven")
    points: Rows = Field(default=121, description="Rows of the path")

    def build(self) -> Carried:
        """The base, the feasible part of the twist, and its wheel rates."""
        base, wanted = self.base.build(), self.twist.build()
        feasible = base.feasible(wanted)
        twist = wanted if np.all(feasible.is_feasible) else feasible.twist
        return Carried(base, feasible, twist, base.inverse(twist))

    def _numbers(self, things: Any) -> dict[str, Any]:
        base, feasible, twist, rates = things
        named = {f"rate_{name}": rates[..., i] for i, name in enumerate(base.names)}
        centre = Icr(twist).body
        facts = {"rank": base.rank, "condition": base.condition, "degrees_of_control": base.degrees_of_control}
        where = {"icr_x": centre[..., 0], "icr_y": centre[..., 1]}
        return {**named, "feasible": feasible.is_feasible, "gap": feasible.gap, **facts, **where}

    def _findings(self, things: Carried) -> list[Finding]:
        found = [Finding(f.sentence, "warn" if f.is_fault else "note") for f in things.base.diagnose()]
        if not things.feasible.is_feasible:
            sentence = (
                f"{things.feasible.status.value}: {things.feasible.reason}; short by {things.feasible.gap:.3g} m/s"
            )
            return [Finding(sentence, "no"), *found]
        return [Finding(things.feasible.status.value, "good"), *found]

    def _outcome(self, _: Progress, /) -> Outcome:
        built = self.build()
        base, rates = built.base, built.rates
        error = truths.wheel_error(base, built.twist, rates)
        back = float(np.abs(base.forward(rates).as_array() - built.twist.as_array()).max())
        t = np.linspace(0.0, self.duration, self.points)
        path = Pose.exp(built.twist.during(t))
        columns = {"t": t, "x": path.x, "y": path.y, "theta": path.theta}
        commands = {
            name: np.full(len(t), part) for name, part in zip(("vx", "vy", "omega"), built.twist.parts, strict=True)
        }
        size = max(1.0, float(np.abs(rates).max()))
        twist = built.twist
        possible = bool(built.feasible.is_feasible)
        sentences = tuple(finding.sentence for finding in self._findings(built))
        wanted = f"({twist.vx:g}, {twist.vy:g}) m/s and {twist.omega:g} rad/s"
        told = f"{', '.join(f'{r:+.2f}' for r in rates)} rad/s for {wanted}"
        full = base.rank == 3  # otherwise the rates do not determine the twist, and the way back is another one
        return self._told(
            built,
            self._numbers(built),
            {"path": path},
            run=Run(columns | commands, "body"),
            ok=possible,
            status=built.feasible.status.value if possible else sentences[0],
            headline=told if possible else f"{sentences[0]}; without it {told}",
            check=f"velocities of the contacts in complex numbers: {error:.0e} rad/s; forward of inverse: {back:.0e}",
            passed=bool(error < 1e-12 * size and (back < 1e-12 * size or not full)),
            tables={"run.csv": {"wheel": base.names, "rate": rates}, "path.csv": columns},
            warnings=tuple(f.sentence for f in self._findings(built) if f.tone in ("warn", "no")),
        )
