"""Integrators side by side on an arc, whose exact end is known."""

from __future__ import annotations

from math import ceil, log2
from typing import TYPE_CHECKING, Annotated, Any

import typer

from coplanar.cli.answers import Answer, Fact, give
from coplanar.cli.arguments import Json, quantity

if TYPE_CHECKING:
    import numpy as np

SHOWN = {"euler": "Euler", "midpoint": "RK2 (midpoint)", "heun": "RK2 (Heun)", "rk4": "RK4", "exact": "exact arcs"}
MOST_STEPS = 1_000_000


def lab(
    v: Annotated[str, typer.Option("--v", metavar="V", help="Forward velocity.")] = "1 m/s",
    omega: Annotated[str, typer.Option("--omega", metavar="W", help="Turn rate.")] = "1 rad/s",
    duration: Annotated[str, typer.Option(metavar="T", help="How long.")] = "10 s",
    step: Annotated[str, typer.Option(metavar="H", help="Step of the integrators.")] = "0.1 s",
    within: Annotated[str, typer.Option(metavar="E", help="Error that the largest step may make.")] = "1 mm",
    as_json: Json = False,
) -> None:
    """Euler, RK2, RK4 and exact arcs side by side: error, order, and the largest step for a millimetre.

    Example: coplanar lab --v 1 --omega "90 deg/s" --step "50 ms"
    """
    from coplanar.checks import positive
    from coplanar.errors import InvalidValue
    from coplanar.scenarios import quantities as dimensions

    speed, rate = quantity("v", v, dimensions.SPEED), quantity("omega", omega, dimensions.TURN_RATE)
    time = positive("duration", quantity("duration", duration, dimensions.TIME))
    size = positive("step", quantity("step", step, dimensions.TIME))
    allowed = positive("within", quantity("within", within, dimensions.LENGTH))
    if time / size > MOST_STEPS:
        raise InvalidValue("step", size, f"at least {time / MOST_STEPS:g} s: {MOST_STEPS:,} steps are the most")
    course = speed * time, rate * time
    count = max(1, round(time / size))
    rows = [_row(method, course, count, allowed, time) for method in SHOWN]
    facts = (
        Fact("steps", count),
        Fact("step", time / count, "s"),
        Fact("distance", course[0], "m"),
        Fact("turn", course[1], "rad"),
        Fact("largest error allowed", allowed, "m"),
        Fact("methods", rows),
    )
    give(Answer(f"{count} steps along an arc of {course[0]:.6g} m that turns by {course[1]:.6g} rad", facts), as_json)


def _row(method: str, course: tuple[float, float], count: int, allowed: float, time: float) -> dict[str, Any]:
    """What one method makes of the arc."""
    errors = _errors(method, course, count)
    sizes = float(errors.max()), float(_errors(method, course, 2 * count).max())
    rounding = 1e-13 * (1.0 + abs(course[0]))  # [m] below this there is no order to see
    steps = _fewest(method, course, allowed)
    return {
        "method": SHOWN[method],
        "error at end": float(errors[-1]),
        "largest error": sizes[0],
        "order": log2(sizes[0] / sizes[1]) if min(sizes) > rounding else None,
        "largest step": time / steps if steps else None,
        "steps needed": steps,
    }


def _errors(method: str, course: tuple[float, float], count: int) -> np.ndarray:
    """How far each pose of a path of so many steps is from the arc [m]."""
    import numpy as np

    from coplanar.motion import Odometry
    from coplanar.se2 import Displacement, Pose

    distance, turn = course
    ticks = Odometry(Displacement(np.full(count, distance / count), 0.0, np.full(count, turn / count)))
    done = np.arange(count + 1) / count
    arc = Pose.exp(Displacement(distance * done, 0.0, turn * done))
    gap = ticks.path(Pose(), method=method).position - arc.position
    apart: np.ndarray = np.hypot(gap[:, 0], gap[:, 1])
    return apart


def _fewest(method: str, course: tuple[float, float], allowed: float) -> int | None:
    """The fewest steps whose largest error is allowed; None where not even the most are enough."""

    def fits(count: int) -> bool:
        return float(_errors(method, course, count).max()) <= allowed

    enough = max(1, ceil(abs(course[1])))  # a step that turns by more may be right by chance
    while not fits(enough):
        enough *= 2
        if enough > MOST_STEPS:
            return None
    short = enough // 2 if enough > abs(course[1]) + 1.0 else 0
    while enough - short > 1:
        middle = (enough + short) // 2
        short, enough = (short, middle) if fits(middle) else (middle, enough)
    return enough
