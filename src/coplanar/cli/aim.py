"""Aiming a projectile."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from coplanar.cli.answers import Answer, Fact, give
from coplanar.cli.arguments import Json, maybe, quantities, quantity

if TYPE_CHECKING:
    from coplanar.flight import Aim, Arc


def aim(
    target: Annotated[tuple[str, str], typer.Option(metavar="X Y", help="What should be hit [m].")],
    speed: Annotated[str | None, typer.Option(metavar="V", help="Of the launch: both arcs [m/s].")] = None,
    angle: Annotated[str | None, typer.Option(metavar="ANGLE", help="Of the launch: the speed [rad].")] = None,
    time: Annotated[str | None, typer.Option(metavar="T", help="Of the flight: the velocity [s].")] = None,
    mass: Annotated[str, typer.Option(metavar="M", help="Of the projectile.")] = "1 kg",
    drag: Annotated[str, typer.Option(metavar="C", help="Force over the square of the speed.")] = "0 kg/m",
    gravity: Annotated[str, typer.Option(metavar="G", help="Downwards.")] = "9.81 m/s^2",
    start: Annotated[tuple[str, str], typer.Option(metavar="X Y", help="Where it is launched.")] = ("0", "0"),
    as_json: Json = False,
) -> None:
    """The launch that sends a projectile through a target.

    For a speed both arcs, for an angle the speed, for a time the velocity; for none of them the least speed. Out of
    range, it says how far short and what speed would do, and the exit code is 1.

    Example: coplanar aim --target 30 2 --speed "30 m/s" --drag 0.02
    """
    from coplanar.flight import Projectile
    from coplanar.scenarios import quantities as dimensions

    ball = Projectile(
        quantity("mass", mass, dimensions.MASS), quantity("drag", drag, dimensions.DRAG),
        quantity("gravity", gravity, dimensions.ACCELERATION),
    )  # fmt: skip
    plane = (dimensions.LENGTH, dimensions.LENGTH)
    found = ball.aim(
        quantities("target", target, *plane),
        start=quantities("start", start, *plane),
        speed=maybe("speed", speed, dimensions.SPEED),
        angle=maybe("angle", angle, dimensions.ANGLE),
        time=maybe("time", time, dimensions.TIME),
    )
    hit = bool(found.hit)
    facts = _hit(found) if hit else _missed(found)
    give(Answer(found.sentence(), (Fact("code", found.status.name), *facts), ok=hit), as_json)


def _hit(found: Aim) -> tuple[Fact, ...]:
    arcs = [_row("low", found.low)]
    if found.high.time != found.low.time:
        arcs.append(_row("high", found.high))
    return Fact("arcs", arcs), Fact("miss", found.miss(), "m")


def _missed(found: Aim) -> tuple[Fact, ...]:
    """How far it goes, and the launch that would do."""
    least = found.least()
    launch = [_row("least speed", least.low)] if least.hit else []
    return (
        Fact("shortfall", found.shortfall, "m"),
        Fact("furthest", found.furthest, "m"),
        Fact("least speed", found.least_speed, "m/s"),
        Fact("arcs", launch),
    )


def _row(name: str, arc: Arc) -> dict[str, Any]:
    from math import degrees

    return {
        "arc": name, "angle": arc.angle, "degrees": degrees(arc.angle), "speed": arc.speed, "time": arc.time,
        "velocity": arc.velocity.tolist(),
    }  # fmt: skip
