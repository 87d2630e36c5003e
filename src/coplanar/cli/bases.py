"""The base on wheels that options describe."""

from __future__ import annotations

from collections.abc import Iterator
from enum import StrEnum
from itertools import islice
from typing import TYPE_CHECKING, Any, NamedTuple

from coplanar.cli.arguments import quantities, quantity
from coplanar.errors import InvalidValue

if TYPE_CHECKING:
    from coplanar.se2 import Twist
    from coplanar.wheels import Wheel, WheeledBase

MOST_WHEELS = 1000


class Layout(StrEnum):
    """Which wheels a base has."""

    DIFFERENTIAL = "differential"
    OMNI = "omni"
    MECANUM = "mecanum"
    SWERVE = "swerve"
    TABLE = "table"


class Sizes(NamedTuple):
    """The options that describe a base, as texts."""

    radius: str | None
    track: str | None
    wheelbase: str | None
    distance: str | None
    omni_count: int
    first: str
    rollers: str
    wheel: list[str] | None
    file: str | None

    def length(self, name: str) -> float:
        """One of the lengths.

        Raises:
            InvalidValue: If it is not given.
        """
        from coplanar.scenarios.quantities import LENGTH

        text = getattr(self, name)
        if text is None:
            raise InvalidValue(f"--{name}", "nothing", "a length [m]", f"give --{name}")
        return quantity(name, text, LENGTH)


def base_of(layout: Layout, sizes: Sizes) -> WheeledBase:
    """The base of a layout.

    Raises:
        InvalidValue: If a size is missing.
    """
    from coplanar.scenarios.quantities import ANGLE
    from coplanar.wheels import WheeledBase

    if layout is Layout.DIFFERENTIAL:
        return WheeledBase.differential(track=sizes.length("track"), radius=sizes.length("radius"))
    if layout is Layout.OMNI:
        first = quantity("first", sizes.first, ANGLE)
        return WheeledBase.omni(
            sizes.omni_count, wheel_distance=sizes.length("distance"), radius=sizes.length("radius"), first_angle=first
        )
    if layout is Layout.MECANUM:
        return WheeledBase.mecanum(
            radius=sizes.length("radius"), wheelbase=sizes.length("wheelbase"), track=sizes.length("track"),
            rollers=sizes.rollers,
        )  # fmt: skip
    return WheeledBase(tuple(_table(sizes)))


def steered(sizes: Sizes, wanted: Twist | None) -> WheeledBase:
    """Four wheels at the corners, each turned to where the twist takes it; forward where it does not move."""
    from dataclasses import replace
    from math import atan2

    from coplanar.wheels import Wheel, WheeledBase

    x, y, radius = 0.5 * sizes.length("wheelbase"), 0.5 * sizes.length("track"), sizes.length("radius")
    corners = {"front_left": (x, y), "front_right": (x, -y), "rear_left": (-x, y), "rear_right": (-x, -y)}
    straight = WheeledBase(tuple(Wheel(*place, 0.0, radius, name=name) for name, place in corners.items()))
    if wanted is None:
        return straight
    moving = straight.wheel_velocities(wanted).tolist()
    pairs = zip(straight.wheels, moving, strict=True)
    return WheeledBase(tuple(replace(w, drive_angle=atan2(vy, vx)) for w, (vx, vy) in pairs))


def listed(base: WheeledBase) -> list[dict[str, Any]]:
    """The wheels of a base as rows."""
    return [
        {
            "wheel": w.name,
            "x": w.x,
            "y": w.y,
            "drive angle": w.drive_angle,
            "radius": w.radius,
            "roller": w.roller_angle,
        }
        for w in base.wheels
    ]


def _table(sizes: Sizes) -> list[Wheel]:
    rows = [("--wheel", text) for text in sizes.wheel or ()]
    if sizes.file is not None:
        rows += islice(_lines_of(sizes.file), MOST_WHEELS + 1)
    if not rows or len(rows) > MOST_WHEELS:
        raise InvalidValue("wheels", f"{len(rows)}", f"1 to {MOST_WHEELS} of them", "give --wheel or --file")
    return [_wheel(*row) for row in rows]


def _lines_of(file: str) -> Iterator[tuple[str, str]]:
    """Where each wheel of a file stands, and its text."""
    from coplanar.cli.streams import source
    from coplanar.logs.lines import whole_lines

    with source(file) as (read, name):
        for block in whole_lines(read, name):
            for line, text in enumerate(block.text.decode("utf-8", "backslashreplace").split("\n"), block.first):
                row = text.partition("#")[0].strip()
                if row:
                    yield f"line {line} of {name}", row


def _wheel(name: str, text: str) -> Wheel:
    from coplanar.scenarios.quantities import ANGLE, LENGTH
    from coplanar.wheels import Wheel

    cells = [cell.strip() for cell in text.split(",")]
    called = cells.pop() if len(cells) > 4 and cells[-1][:1].isalpha() and cells[-1] != "pi" else ""
    if len(cells) not in (4, 5):
        raise InvalidValue(name, text, "X,Y,ANGLE,RADIUS and for rollers their ANGLE, at last a name if it has one")
    kinds = (LENGTH, LENGTH, ANGLE, LENGTH, ANGLE)[: len(cells)]
    return Wheel(*quantities(name, cells, *kinds), name=called)
