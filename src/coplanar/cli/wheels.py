"""Bases on wheels: rates, twists, the doctor, the wiring."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Any

import typer

from coplanar.cli.answers import Answer, Fact, give
from coplanar.cli.arguments import Json, quantities
from coplanar.cli.bases import Layout, Sizes, base_of, listed, steered

if TYPE_CHECKING:
    from coplanar.se2 import Twist
    from coplanar.wheels import WheeledBase


class Rollers(StrEnum):
    """What mecanum rollers look like seen from above."""

    X = "X"
    O = "O"  # noqa: E741


Length = str | None
TWIST = "VX VY OMEGA"


def wheels(
    layout: Annotated[Layout, typer.Argument(help="Which wheels, and where.")],
    radius: Annotated[Length, typer.Option(metavar="R", help="Of the wheels [m].")] = None,
    track: Annotated[Length, typer.Option(metavar="W", help="From left to right wheels, the whole [m].")] = None,
    wheelbase: Annotated[Length, typer.Option(metavar="L", help="From rear to front wheels, the whole [m].")] = None,
    distance: Annotated[Length, typer.Option(metavar="D", help="Of omni wheels from the centre [m].")] = None,
    count: Annotated[int, typer.Option(help="Of omni wheels.", min=1, max=1000)] = 3,
    first: Annotated[str, typer.Option(metavar="ANGLE", help="Where the first omni wheel stands.")] = "0 rad",
    rollers: Annotated[Rollers, typer.Option(help="Mecanum rollers seen from above.")] = Rollers.X,
    wheel: Annotated[
        list[str] | None, typer.Option(metavar="X,Y,ANGLE,R[,ROLLER]", help="A wheel of a table; again for each.")
    ] = None,
    file: Annotated[str | None, typer.Option(metavar="FILE", help="A table: such a wheel in each line.")] = None,
    twist: Annotated[tuple[str, str, str] | None, typer.Option(metavar=TWIST, help="Wanted: what rates?")] = None,
    rates: Annotated[list[str] | None, typer.Option(metavar="W1 W2 ...", help="Measured: what twist?")] = None,
    jog: Annotated[
        list[str] | None, typer.Option(metavar="VX,VY,OMEGA", help="What each motor alone did, in order: the wiring.")
    ] = None,
    as_json: Json = False,
) -> None:
    """What a base on wheels does, and what it cannot do.

    Rates for a twist, the twist of rates, and which motor turns which wheel. For a twist that the base cannot make it
    says the nearest one, and the exit code is 1, as it is for motors that are wired wrongly.

    Example: coplanar wheels differential --track 0.5 --radius 0.1 --twist 0.5 0 "30 deg/s"
    """
    sizes = Sizes(radius, track, wheelbase, distance, count, first, rollers.value, wheel, file)
    wanted = _twist("twist", twist) if twist else None
    base = steered(sizes, wanted) if layout is Layout.SWERVE else base_of(layout, sizes)
    give(_answer(base, layout, wanted, rates, jog), as_json)


def _answer(
    base: WheeledBase, layout: Layout, wanted: Twist | None, rates: list[str] | None, jog: list[str] | None
) -> Answer:
    """Everything that was asked."""
    facts, ok = _layout(base), True
    status = base.cannot[0] if base.cannot else "the base drives every motion"
    if wanted is not None:
        feasible = base.feasible(wanted)
        ok, status = bool(feasible.is_feasible), feasible.status.value
        facts += _inverse(base, layout, feasible)
    if rates:
        facts += _forward(base, rates)
    if jog:
        wired, sentences, found = _wiring(base, jog)
        facts, ok = facts + found, ok and wired
        status = status if wanted is not None and wired else "; ".join(sentences)
    return Answer(status, facts, ok, tuple(f.sentence for f in base.diagnose() if f.is_fault))


def _layout(base: WheeledBase) -> list[Fact]:
    """What follows from the table alone."""
    return [
        Fact("wheels", listed(base), "m, rad"),
        Fact("rank", base.rank),
        Fact("condition", base.condition),
        Fact("degrees of control", base.degrees_of_control),
        Fact("degrees of configuration", base.degrees_of_configuration),
        Fact("holonomic", base.is_holonomic),
        Fact("worth knowing", [finding.sentence for finding in base.diagnose() if not finding.is_fault]),
    ]


def _inverse(base: WheeledBase, layout: Layout, feasible: Any) -> list[Fact]:
    """Rates for the nearest twist that the base can make."""
    import numpy as np

    facts = [Fact("wanted", feasible.wanted.as_array(), "m/s, m/s, rad/s")]
    if not feasible.is_feasible:
        facts.append(Fact("gap", feasible.gap, "m/s"))
        facts.append(Fact("nearest", np.round(feasible.twist.as_array(), 15) + 0.0, "m/s, m/s, rad/s"))
    turns = base.inverse(feasible.twist if not feasible.is_feasible else feasible.wanted).tolist()
    rows = [{"wheel": name, "rate": rate} for name, rate in zip(base.names, turns, strict=True)]
    if layout is Layout.SWERVE:
        rows = [row | {"steering": w.drive_angle} for row, w in zip(rows, base.wheels, strict=True)]
    return [*facts, Fact("rates", rows, "rad/s")]


def _forward(base: WheeledBase, rates: list[str]) -> list[Fact]:
    """The twist that explains the rates best, where it turns about, and what it leaves."""
    import numpy as np

    from coplanar.scenarios.quantities import TURN_RATE

    measured = np.array(quantities("rates", rates, TURN_RATE))
    twist = base.forward(measured)
    centre = base.icr(measured)
    return [
        Fact("twist", twist.as_array(), "m/s, m/s, rad/s"),
        Fact("centre of rotation", centre.body if centre.exists else None, "m" if centre.exists else ""),
        Fact("residual", base.residual(measured), "m/s"),
    ]


def _wiring(base: WheeledBase, jog: list[str]) -> tuple[bool, tuple[str, ...], list[Fact]]:
    """Which motor turns which wheel."""
    import numpy as np

    from coplanar.wheels import WiringStatus, identify_wiring

    observed = np.array([_twist("jog", text.split(",")).as_array() for text in jog])
    wiring = identify_wiring(base, observed)
    rows = [
        {"motor": motor, "turns": wheel, "inverted": inverted, "match": match}
        for motor, wheel, inverted, match in zip(
            wiring.motors, wiring.wheels, wiring.inverted, wiring.match, strict=True
        )
    ]
    right = wiring.status is WiringStatus.CORRECT
    return right, wiring.sentences, [Fact("wiring", rows)]


def _twist(name: str, parts: Any) -> Twist:
    from coplanar.scenarios.quantities import SPEED, TURN_RATE
    from coplanar.se2 import Twist

    return Twist(*quantities(name, parts, SPEED, SPEED, TURN_RATE))
