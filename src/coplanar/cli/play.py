"""The playground in the browser."""

from __future__ import annotations

from typing import Annotated

import typer


def play(
    scenario: Annotated[
        str | None,
        typer.Argument(metavar="SCENARIO", help="A scenario file, or a name of the catalog, to begin with."),
    ] = None,
    port: Annotated[int, typer.Option(min=0, max=65535, metavar="N", help="Port; 0 takes any free one.")] = 0,
    host: Annotated[
        str, typer.Option(metavar="H", help="Address to listen at; others than this machine's own let others in.")
    ] = "127.0.0.1",
    no_browser: Annotated[bool, typer.Option("--no-browser", help="Print the address only.")] = False,
) -> None:
    """Open the playground in the browser.

    Six tabs, every system under the hand. It serves this machine only, prints its address, and ends with Ctrl-C.

    Example: coplanar play track-astroid
    """
    from coplanar.play import play as serve

    serve(scenario, host=host, port=port, browser=not no_browser, say=typer.echo)
