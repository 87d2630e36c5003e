"""Where a robot has been, from what its wheels measured: a log of any length, in the memory of some thousand rows."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from coplanar.cli.answers import Answer, Fact, give
from coplanar.cli.arguments import Json, maybe, quantities
from coplanar.errors import InvalidValue

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coplanar.cli.streams import Tally
    from coplanar.logs.ticks import Measured, Piece
    from coplanar.motion import OdometryNoise, Reckoning
    from coplanar.wheels import WheeledBase


class Kind(StrEnum):
    """What the rows hold."""

    VELOCITIES = "velocities"
    RATES = "rates"
    TICKS = "ticks"


class Method(StrEnum):
    """How the path is summed."""

    EXACT = "exact"
    EULER = "euler"
    MIDPOINT = "midpoint"
    HEUN = "heun"
    RK4 = "rk4"


def odometry(
    log: Annotated[str, typer.Argument(metavar="LOG", help="A file, or - for what comes through a pipe.")],
    kind: Annotated[Kind, typer.Option("--from", help="(t, v, omega), (t, left, right) rates, or counts.")],
    track: Annotated[str | None, typer.Option(metavar="W", help="Between the wheels, the whole [m].")] = None,
    radius: Annotated[
        list[str] | None, typer.Option(metavar="R [R]", help="Of the wheels; or left, right [m].")
    ] = None,
    ticks: Annotated[float | None, typer.Option(metavar="N", help="Counts of one turn of a wheel.")] = None,
    bits: Annotated[int | None, typer.Option(metavar="B", help="Of counters that wrap round.")] = None,
    since_last: Annotated[bool, typer.Option("--since-last", help="Rows count since the row before.")] = False,
    columns: Annotated[str | None, typer.Option(metavar="A,B,C", help="Names in the header, or 1,2,3.")] = None,
    start: Annotated[tuple[str, str, str], typer.Option(metavar="X Y THETA", help="Where it begins.")] = (
        "0",
        "0",
        "0",
    ),
    method: Annotated[Method, typer.Option(help="Exact arcs, or an integrator.")] = Method.EXACT,
    covariance: Annotated[
        list[str] | None,
        typer.Option(
            metavar="F S M R", help="Add it, from the deviations forward, sideways, of the heading per m, rad."
        ),
    ] = None,
    equal_times: Annotated[bool, typer.Option("--equal-times", help="A time may be that of the row before.")] = False,
    every: Annotated[int, typer.Option(metavar="N", help="Write each Nth pose, and the last one.", min=1)] = 1,
    decimals: Annotated[
        int | None, typer.Option(help="Digits after the point.  [all there are]", min=0, max=17)
    ] = None,
    output: Annotated[str | None, typer.Option("--output", "-o", metavar="FILE", help="Write poses here.")] = None,
    as_json: Json = False,
) -> None:
    """Poses from wheel counts, wheel rates or velocities.

    They go to stdout as CSV, one for each row as it comes, or to FILE, whole or not at all.

    Rows are comma, semicolon, space or tab separated, with # comments, with or without a header, gzipped or not.
    With -o or --json a summary is said. A bad value is an error that names its line; what a pipe has got it keeps.

    Example: zcat drive.log.gz | coplanar odometry - --from ticks --ticks 4096 --radius "3 in" --track "40 cm"
    """
    from coplanar.cli.streams import poses_to, source

    measured = _measured(kind, track, radius, ticks, bits, since_last)
    reckoning = _reckoning(start, method, covariance)
    target = None if output == "-" else output
    with source(log) as (read, name):
        pieces = _pieces(read, name, measured, reckoning, columns, equal_times)
        tally = poses_to(target if as_json or target else "-", pieces, every, decimals)
    if target or as_json:
        give(_summary(tally), as_json)


def _pieces(read, name, measured, reckoning, columns, equal_times) -> Iterator[Piece]:  # type: ignore[no-untyped-def]
    from coplanar.logs.columns import Wanted, read_columns
    from coplanar.logs.ticks import reckon

    chosen = None if columns is None else tuple(part.strip() for part in columns.split(","))
    rows = read_columns(read, Wanted(measured.names, chosen, measured.timeless), name)
    return reckon(rows, measured, reckoning, name=name, equal_times=equal_times)


def _measured(
    kind: Kind, track: str | None, radius: list[str] | None, ticks: float | None, bits: int | None, since_last: bool
) -> Measured:
    """What the options say about the rows."""
    from coplanar.logs.ticks import Encoders, Velocities, WheelRates

    if kind is not Kind.TICKS and (ticks is not None or bits is not None or since_last):
        raise InvalidValue("--ticks, --bits, --since-last", f"--from {kind.value}", "--from ticks")
    if kind is Kind.VELOCITIES:
        if track is not None or radius:
            raise InvalidValue("--track, --radius", "--from velocities", "--from rates or ticks")
        return Velocities()
    base = _base(track, radius)
    if kind is Kind.RATES:
        return WheelRates(base)
    if ticks is None:
        raise InvalidValue("--ticks", "nothing", "counts of one turn of a wheel")
    return Encoders(base, ticks_per_turn=ticks, bits=bits, since_last=since_last)


def _base(track: str | None, radius: list[str] | None) -> WheeledBase:
    from coplanar.scenarios.quantities import LENGTH
    from coplanar.wheels import WheeledBase

    if track is None or not radius:
        raise InvalidValue("--track, --radius", "nothing", "both: the distance of the wheels, and their radius [m]")
    sizes = quantities("radius", radius, LENGTH)
    if len(sizes) > 2:
        raise InvalidValue("radius", sizes, "one radius, or those of the left and the right wheel")
    return WheeledBase.differential(track=maybe("track", track, LENGTH), left_radius=sizes[0], right_radius=sizes[-1])


def _reckoning(start: tuple[str, str, str], method: Method, covariance: list[str] | None) -> Reckoning:
    from coplanar.motion import Reckoning
    from coplanar.scenarios.quantities import ANGLE, LENGTH
    from coplanar.se2 import Pose

    noise = _noise(covariance) if covariance else None
    return Reckoning(Pose(*quantities("start", start, LENGTH, LENGTH, ANGLE)), method=method.value, noise=noise)


def _noise(deviations: list[str]) -> OdometryNoise:
    from coplanar.motion import OdometryNoise
    from coplanar.scenarios.quantities import ANGLE, LENGTH

    return OdometryNoise(*quantities("covariance", deviations, LENGTH, LENGTH, ANGLE, ANGLE))


def _summary(tally: Tally) -> Answer:
    """The end of the path, and how far it was."""
    x, y, theta = tally.pose.parts
    facts = [
        Fact("rows", tally.rows),
        Fact("duration", tally.duration, "s" if tally.duration is not None else ""),
        Fact("end", [x, y], "m"),
        Fact("heading", theta, "rad"),
        Fact("distance", tally.distance, "m"),
        Fact("turn", tally.turn, "rad"),
    ]
    if tally.covariance is not None:
        facts.append(Fact("covariance", tally.covariance, "m^2, m rad, rad^2"))
    if tally.file is not None:
        facts.append(Fact("file", tally.file))
    return Answer(f"{tally.rows} poses", facts)
