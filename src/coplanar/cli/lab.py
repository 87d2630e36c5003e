"""Integrators side by side on a motion whose exact end is known."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from coplanar.cli.answers import Answer, Fact, give
from coplanar.cli.arguments import Json, quantity
from coplanar.errors import InvalidValue

if TYPE_CHECKING:
    from coplanar.motion import Comparison, Segment

SHOWN = {"euler": "Euler", "midpoint": "RK2 (midpoint)", "heun": "RK2 (Heun)", "rk4": "RK4"}


def lab(
    v: Annotated[str, typer.Option("--v", metavar="V", help="Forward velocity.")] = "1 m/s",
    omega: Annotated[str, typer.Option("--omega", metavar="W", help="Turn rate.")] = "1 rad/s",
    a: Annotated[str, typer.Option("--a", metavar="A", help="Forward acceleration.")] = "0 m/s^2",
    alpha: Annotated[str, typer.Option("--alpha", metavar="A", help="Turn acceleration.")] = "0 rad/s^2",
    duration: Annotated[str, typer.Option(metavar="T", help="How long.")] = "10 s",
    step: Annotated[str, typer.Option(metavar="H", help="Step of the integrators.")] = "0.1 s",
    within: Annotated[str, typer.Option(metavar="E", help="Error that the largest step may make.")] = "1 mm",
    as_json: Json = False,
) -> None:
    """Integrators side by side: error, order, largest step.

    Euler, two RK2 and RK4 with one step, and with half of it, along a motion of constant accelerations.

    Example: coplanar lab --v 1 --omega "90 deg/s" --step "50 ms"
    """
    from coplanar.motion import Comparison, Program, Segment
    from coplanar.scenarios import quantities as dimensions
    from coplanar.se2 import Pose

    time, size = (quantity(n, text, dimensions.TIME) for n, text in (("duration", duration), ("step", step)))
    if not 0.0 < size <= time:
        raise InvalidValue("step", size, f"a time of more than 0, and at most the duration {time:g} s")
    motion = Segment(
        quantity("v", v, dimensions.SPEED), quantity("omega", omega, dimensions.TURN_RATE),
        a=quantity("a", a, dimensions.ACCELERATION), alpha=quantity("alpha", alpha, dimensions.TURN_ACCELERATION),
        duration=time,
    )  # fmt: skip
    allowed = quantity("within", within, dimensions.LENGTH)
    compared = Comparison(Program([motion]), Pose(), tuple(SHOWN), (size, 0.5 * size))
    give(_answer(compared, motion, allowed), as_json)


def _answer(compared: Comparison, motion: Segment, allowed: float) -> Answer:
    """One row for each method, and the exact end."""
    size, end = float(compared.steps[0]), motion.end(compared.start)
    facts = (
        Fact("step", size, "s"),
        Fact("exact end", [end.x, end.y], "m"),
        Fact("exact heading", end.theta, "rad"),
        Fact("error allowed", allowed, "m"),
        Fact("methods", _rows(compared, allowed), "m, s"),
    )
    return Answer(f"{motion.duration:g} s in steps of {size:g} s, against the exact motion", facts)


def _rows(compared: Comparison, allowed: float) -> list[dict[str, Any]]:
    from coplanar.cli.progress import progress

    errors, rows = compared.errors(), []
    orders = compared.orders(errors)
    with progress() as step:
        for i, method in enumerate(compared.methods):
            step(SHOWN[method], i, len(SHOWN))
            largest = compared.largest_step(method, allowed)
            rows.append(
                {
                    "method": SHOWN[method],
                    "largest error": float(errors[i, 0]),
                    "with half the step": float(errors[i, 1]),
                    "order": float(orders[i]),
                    "largest step": largest or None,
                }
            )
    exact = {"method": "exact", "largest error": 0.0, "with half the step": 0.0, "order": None}
    return [*rows, exact | {"largest step": compared.program.duration}]
