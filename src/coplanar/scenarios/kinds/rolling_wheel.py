"""A wheel that rolls along a road, and how its rim moves."""

from __future__ import annotations

from math import pi, tau
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.scenarios.outcome import Finding, Outcome
from coplanar.scenarios.parts.common import Rows
from coplanar.scenarios.quantities import Positive, PositiveLength, Speed, TurnRate
from coplanar.scenarios.scenario import Progress, Scenario
from coplanar.wheels import RollingWheel


class Rolling(NamedTuple):
    """What the library makes of it."""

    wheel: RollingWheel
    rate: Any
    slip: Any


class RollingScenario(Scenario):
    """A wheel, its rate, and its slip."""

    vectorised_keys: ClassVar[tuple[str, ...]] = ("radius", "rate", "slip")
    example: ClassVar[dict[str, Any]] = {"radius": 0.3, "rate": 2.0}

    type: Literal["rolling-wheel"] = Field(default="rolling-wheel", description="A wheel rolls along a road")
    radius: PositiveLength = Field(description="Radius")
    rate: TurnRate = Field(description="Rate of the wheel; positive drives it towards +x")
    slip: Speed = Field(default=0.0, description="Velocity of the contact along the road; negative when it spins")
    points: Rows = Field(default=73, description="Points of the rim")
    turns: Positive = Field(default=2.0, description="How many turns it is watched")

    def build(self) -> Rolling:
        """The wheel."""
        return Rolling(RollingWheel(self.radius), self.rate, self.slip)

    def _numbers(self, things: Any) -> dict[str, Any]:
        wheel, rate, slip = things
        return {
            "centre_speed": wheel.centre_speed(rate, slip=slip),
            "top_speed": _size(wheel.top_velocity(rate, slip=slip)),
            "contact_speed": _size(wheel.contact_velocity(rate, slip=slip)),
        }

    def _findings(self, things: Rolling) -> list[Finding]:
        if things.slip == 0.0:
            return [Finding("it rolls without slipping: the contact point stands still", "good")]
        return [Finding(f"the contact point slides over the road at {abs(things.slip):g} m/s", "warn")]

    def _outcome(self, _: Progress, /) -> Outcome:
        built = self.build()
        wheel, rate, slip = built
        beta = np.linspace(0.0, tau, self.points)
        velocity = wheel.rim_velocity(rate, beta, slip=slip)
        truth = slip + self.radius * rate * (1.0 - np.exp(-1j * beta))
        error = float(np.abs(velocity[:, 0] + 1j * velocity[:, 1] - truth).max())
        numbers = self._numbers(built)
        contact, centre, top = (numbers[f"{name}_speed"] for name in ("contact", "centre", "top"))
        return self._told(
            built,
            numbers,
            {"beta": beta, "velocity": velocity, "turned": np.linspace(0.0, self.turns * tau, 241)},
            ok=True,
            status="rolls without slipping" if slip == 0.0 else "rolls and slips",
            headline=f"contact {contact:.3g} m/s, centre {centre:.3g} m/s, top {top:.3g} m/s",
            check=f"the slip and a turning complex number: {error:.0e} m/s",
            passed=bool(error <= 1e-15 * max(1.0, abs(top)) * pi),
            tables={"run.csv": {"beta": beta, "vx": velocity[:, 0], "vy": velocity[:, 1]}},
        )


def _size(velocity: Any) -> Any:
    return np.hypot(velocity[..., 0], velocity[..., 1])
