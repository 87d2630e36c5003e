"""What a command says: facts by name, as one JSON document for programs or as lines for people."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import typer

from coplanar.cli.conduct import NO, until_closed
from coplanar.cli.console import console, visible

if TYPE_CHECKING:
    from rich.console import Console, RenderableType


@dataclass(frozen=True, slots=True)
class Fact:
    """One thing that is so.

    Attributes:
        name: In words; in JSON with underscores.
        value: A number, text, truth value, array, or rows: a list of mappings.
        unit: Of its numbers.
    """

    name: str
    value: Any
    unit: str = ""


@dataclass(frozen=True, slots=True)
class Answer:
    """What a command found.

    Attributes:
        status: In a sentence.
        facts: In the order in which they are said.
        ok: Whether it is a yes; the exit code is 1 for a no.
        warnings: Sentences worth knowing.
    """

    status: str
    facts: Sequence[Fact] = ()
    ok: bool = True
    warnings: Sequence[str] = ()

    def document(self) -> dict[str, Any]:
        """Everything as plain JSON: arrays as lists, what is not finite as null."""
        facts = {fact.name.replace(" ", "_"): plain(fact.value) for fact in self.facts}
        return {"ok": self.ok, "status": self.status, **facts, "warnings": list(self.warnings)}


def give(answer: Answer, as_json: bool, *, exits: bool = True) -> None:
    """Write the answer to stdout, and exit with 1 if it is a no, unless there is more to say."""
    with until_closed():
        if as_json:
            typer.echo(json.dumps(answer.document(), allow_nan=False))
        else:
            _print(answer, console())
    if exits and not answer.ok:
        raise typer.Exit(NO)


def plain(value: Any) -> Any:
    """The value as JSON knows it.

    Example:
        >>> import numpy as np
        >>> plain({"a": np.array([1.0, np.inf]), "b": (True, None)})
        {'a': [1.0, None], 'b': [True, None]}
    """
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, Mapping):
        return {str(key).replace(" ", "_"): plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _print(answer: Answer, out: Console) -> None:
    out.print(visible(answer.status), style="bold green" if answer.ok else "bold yellow")
    width = max((len(fact.name) for fact in answer.facts), default=0)
    for fact in answer.facts:
        if _is_table(fact.value):
            out.print(_table(fact))
            continue
        for i, line in enumerate(_lines(fact)):
            out.print(f"  {fact.name if i == 0 else '':{width}}  {line}")
    for warning in answer.warnings:
        out.print(f"  note: {visible(warning)}", style="yellow")


def _is_table(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(row, Mapping) for row in value)


def _table(fact: Fact) -> RenderableType:
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    title = f"{fact.name} [{fact.unit}]" if fact.unit else fact.name
    table = Table(*fact.value[0], box=SIMPLE_HEAD, title=f"  {title}", title_justify="left", title_style="")
    for row in fact.value:
        table.add_row(*(_text(cell) for cell in row.values()))
    return table


def _lines(fact: Fact) -> Iterable[str]:
    """A line for each row of the value."""
    value = fact.value.tolist() if hasattr(fact.value, "tolist") else fact.value
    stacked = isinstance(value, list | tuple) and any(isinstance(v, list | tuple | str) for v in value)
    rows = value if stacked else [value]
    for row in rows:
        text = _text(row)
        angle = f"  ({_text(_degrees(row))} deg)" if fact.unit == "rad" and row is not None else ""
        yield f"{text} {fact.unit}{angle}".rstrip()


def _degrees(value: Any) -> Any:
    return [_degrees(v) for v in value] if isinstance(value, list | tuple) else math.degrees(value)


def _text(value: Any) -> str:
    """A value as people read it: six digits."""
    if isinstance(value, bool) or value is None:
        return {True: "yes", False: "no", None: "-"}[value]
    if isinstance(value, list | tuple):
        return "  ".join(_text(entry) for entry in value)
    if isinstance(value, float):
        return "-" if math.isnan(value) else f"{value + 0.0:.6g}"
    return visible(str(value))
