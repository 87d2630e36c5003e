"""The tour."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from coplanar.cli.answers import Answer, Fact, give
from coplanar.cli.arguments import Json
from coplanar.cli.conduct import NO
from coplanar.cli.console import console
from coplanar.cli.progress import progress


def tour(
    output: Annotated[str, typer.Option("--output", "-o", metavar="DIR", help="Folder to write.")] = "tour",
    as_json: Json = False,
) -> None:
    """Run every system on its demonstration, with figures.

    Writes tables, figures, animations and DIR/index.html, which opens from disk.
    """
    from rich.table import Table
    from rich.text import Text

    from coplanar.tour import run_tour

    with progress() as step:
        demos = run_tour(output, progress=step)
    if as_json:
        give(_answer(demos, output), True)
        return
    table = Table("demonstration", "system", "headline", "checked against", "")
    for demo in demos:
        mark = Text("holds", "green") if demo.passed else Text("fails", "red")
        table.add_row(demo.name, demo.title, demo.headline, demo.check, mark)
    out = console()
    out.print(table)
    out.print(str(Path(output) / "index.html"))
    if not all(demo.passed for demo in demos):
        raise typer.Exit(NO)


def _answer(demos: Any, output: str) -> Answer:
    """What the table shows, for programs."""
    failed = [demo.name for demo in demos if not demo.passed]
    keys = ("name", "title", "headline", "check", "passed")
    rows = [{key: getattr(demo, key) for key in keys} for demo in demos]
    status = f"these do not hold: {', '.join(failed)}" if failed else f"all {len(demos)} demonstrations hold"
    return Answer(status, (Fact("demonstrations", rows), Fact("page", str(Path(output) / "index.html"))), ok=not failed)
