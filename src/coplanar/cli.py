"""The command line."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from coplanar import __version__
from coplanar.errors import CoplanarError

app = typer.Typer(add_completion=True, no_args_is_help=True, help="Robots that live in a plane.")


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"coplanar {__version__}")
        raise typer.Exit


@app.callback()
def main(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Say the version.")
    ] = False,
) -> None:
    """Robots that live in a plane: frames, arms, wheels, motion, projectiles."""


@app.command()
def tour(
    output: Annotated[Path, typer.Option("--output", "-o", metavar="DIR", help="Folder to write.")] = Path("tour"),
) -> None:
    """Run every system on its demonstration; write tables, figures and DIR/index.html."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
    from rich.table import Table

    from coplanar.tour import run_tour

    console, errors = Console(), Console(stderr=True)
    columns = (TextColumn("{task.description:18}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    try:
        with Progress(*columns, console=errors, disable=not errors.is_terminal) as bar:
            task = bar.add_task("")
            demos = run_tour(
                output,
                progress=lambda name, done, total: bar.update(task, description=name, completed=done, total=total),
            )
    except CoplanarError as error:
        errors.print(f"error: {error}", style="red", markup=False, highlight=False)
        raise typer.Exit(2) from None
    table = Table("demonstration", "system", "headline", "checked against", "")
    for demo in demos:
        mark = "[green]holds[/]" if demo.passed else "[red]fails[/]"
        table.add_row(demo.name, demo.title, demo.headline, demo.check, mark)
    console.print(table)
    console.print(f"{output / 'index.html'}", highlight=False)
    if not all(demo.passed for demo in demos):
        raise typer.Exit(1)
