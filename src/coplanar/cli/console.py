"""Where text goes: coloured and fitted to a terminal (NO_COLOR holds), plain and unbroken in a pipe."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    from rich.console import Console

WIDE = 10_000  # [characters] of a line in a pipe: nothing is broken


def visible(text: str) -> str:
    r"""The text without anything that a terminal would obey: what comes from files and arguments is shown, not done.

    Example:
        >>> visible("a\x1b[31mb")
        'a\\x1b[31mb'
    """
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() or c == "\n" else c.encode("unicode_escape").decode() for c in text)


def console(*, stderr: bool = False) -> Console:
    """A console of rich on stdout or stderr."""
    from rich.console import Console

    class Plain(Console):
        """A console that leaves a closed pipe to whoever runs the command."""

        def on_broken_pipe(self) -> NoReturn:
            raise BrokenPipeError

    settings: dict[str, Any] = {"stderr": stderr, "markup": False, "highlight": False, "emoji": False}
    terminal = Plain(**settings, soft_wrap=True)
    return terminal if terminal.is_terminal else Plain(**settings, width=WIDE)
