"""What commands take: numbers with units, lists of them, vectors; read only when a command runs."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperCommand

from coplanar.errors import InvalidValue

if TYPE_CHECKING:
    from coplanar.scenarios.quantities import Dimension

NUMBER_LIKE = re.compile(r"[-+(]*(\d|\.\d|pi\b|π|free\b)")

Json = Annotated[bool, typer.Option("--json", help="Write one JSON document.")]


class ListsOfNumbers(TyperCommand):
    """A command whose lists may follow their option: ``--links 1 0.5`` for ``--links 1 --links 0.5``."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Repeat the option for every number that follows it."""
        lists = {name for p in self.params if getattr(p, "multiple", False) for name in p.opts}
        rest: list[str] = super().parse_args(ctx, repeated(args, lists))
        return rest


def repeated(args: Sequence[str], lists: Iterable[str]) -> list[str]:
    """The arguments, with the option of a list before each of its numbers.

    Example:
        >>> repeated(["--q", "1", "-0.5", "--json"], ["--q"])
        ['--q', '1', '--q', '-0.5', '--json']
    """
    known, out = set(lists), list[str]()
    current, begun = "", False
    for i, arg in enumerate(args):
        if begun:  # the first number, whatever it looks like
            begun = False
        elif arg == "--":
            return [*out, *args[i:]]
        elif arg.partition("=")[0] in known:
            current, _, value = arg.partition("=")
            begun = not value
        elif current and _is_number_like(arg):
            out.append(current)
        else:
            current = ""
        out.append(arg)
    return out


def _is_number_like(arg: str) -> bool:
    return NUMBER_LIKE.match(arg) is not None and re.search(r"\.[A-Za-z]", arg) is None  # 2024.csv is a file


def quantity(name: str, text: str, dimension: Dimension) -> float:
    """A number of one dimension in SI units: "30 deg", "12 in", "pi/2", or plain.

    Raises:
        InvalidValue: With what was needed.
    """
    from pydantic_core import PydanticCustomError

    from coplanar.scenarios.quantities import Quantity

    try:
        return Quantity(dimension).read(text)
    except PydanticCustomError as error:
        context: dict[str, Any] = dict(error.context or {})
        raise InvalidValue(name, text, str(context.get("needed")), str(context.get("remedy", ""))) from None


def quantities(name: str, texts: Iterable[str], *dimensions: Dimension) -> tuple[float, ...]:
    """Numbers of one dimension, or of one each; commas may stand between them.

    Raises:
        InvalidValue: Naming the one that cannot be used, or if there are not as many as dimensions.
    """
    parts = [part.strip() for text in texts for part in text.split(",")]
    if len(dimensions) > 1 and len(parts) != len(dimensions):
        raise InvalidValue(name, " ".join(parts), f"{len(dimensions)} numbers")
    kinds = dimensions if len(dimensions) > 1 else dimensions * len(parts)
    return tuple(quantity(name, part, kind) for part, kind in zip(parts, kinds, strict=True))


def maybe(name: str, text: str | None, dimension: Dimension) -> float | None:
    """The number, where there is one."""
    return None if text is None else quantity(name, text, dimension)
