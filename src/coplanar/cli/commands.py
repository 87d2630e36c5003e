"""The table of commands. A command is imported when it is asked for, so that help comes at once.

To add one: write a function in a module of its topic, with typer's annotations, and a line here. Keep the module's
imports to typer and ``coplanar.cli``; import what it works with inside the function. End with ``answers.give``; raise
``CoplanarError`` for what cannot be used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from coplanar.cli.arguments import ListsOfNumbers
from coplanar.cli.conduct import conducted
from coplanar.version import __version__

if TYPE_CHECKING:
    from collections.abc import Callable

COMMANDS = {
    "tour": "tour",
    "list": "scenarios",
    "new": "scenarios",
    "check": "scenarios",
    "run": "scenarios",
    "animate": "records",
    "export": "records",
    "sweep": "sweeps",
    "schema": "scenarios",
    "fk": "arms",
    "ik": "arms",
    "aim": "aim",
    "wheels": "wheels",
    "odometry": "odometry",
    "lab": "lab",
    "play": "play",
    "doctor": "doctor",
}  # name of the command and of its function, and the module in coplanar.cli that holds it


class Commands(TyperGroup):
    """The commands of the table, in its order."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.commands.update(dict.fromkeys(COMMANDS))  # type: ignore[arg-type]  # names to suggest

    def list_commands(self, ctx: Any) -> list[str]:  # noqa: ARG002
        """Their names."""
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:  # noqa: ARG002
        """One of them, or None."""
        if self.commands.get(cmd_name) is None and cmd_name in COMMANDS:
            self.commands[cmd_name] = _made(cmd_name)
        return self.commands.get(cmd_name)


def _made(name: str) -> Any:
    """The command behind a name."""
    module = importlib.import_module(f"coplanar.cli.{COMMANDS[name]}")
    function: Callable[..., None] = getattr(module, f"{name}_" if name == "list" else name)
    alone = typer.Typer(add_completion=False, rich_markup_mode=None)
    alone.command(name, cls=ListsOfNumbers)(conducted(function))
    return typer.main.get_command(alone)


app = typer.Typer(
    name="coplanar", cls=Commands, no_args_is_help=True, pretty_exceptions_enable=False, rich_markup_mode=None
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"coplanar {__version__}")
        raise typer.Exit


@app.callback()
def coplanar(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Say the version.")
    ] = False,
) -> None:
    """Robots that live in a plane: frames, arms, wheels, motion, projectiles.

    Exit codes: 0 done, 1 the honest no (out of reach, out of range), 2 what cannot be used. Angles are radians, lengths
    metres, times seconds; "30 deg", "12 in" and "pi/2" are understood as well.
    """
