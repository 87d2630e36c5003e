"""How a command ends: 0 done, 1 the honest no, 2 what cannot be used, 130 interrupted; never with a traceback."""

from __future__ import annotations

import functools
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import typer

from coplanar.cli.console import console, visible
from coplanar.errors import CoplanarError, NoSolution

NO, UNUSABLE, INTERRUPTED = 1, 2, 130


def conducted(command: Callable[..., None]) -> Callable[..., None]:
    """The command, with every end that is no bug turned into an exit code and a sentence."""

    @functools.wraps(command)
    def run(*args: Any, **kwargs: Any) -> None:
        if hasattr(sys.stdout, "reconfigure"):
            sys.stdout.reconfigure(errors="backslashreplace")  # what the terminal has no letters for
        try:
            with until_closed():
                command(*args, **kwargs)
        except NoSolution as error:
            raise _exit(NO, error) from None
        except CoplanarError as error:
            raise _exit(UNUSABLE, error) from None
        except OSError as error:
            where = f"{error.filename}: " if error.filename else ""
            raise _exit(UNUSABLE, f"{where}{error.strerror or error}") from None
        except MemoryError:
            raise _exit(UNUSABLE, "this takes more memory than there is") from None
        except KeyboardInterrupt:
            raise typer.Exit(INTERRUPTED) from None

    return run


@contextmanager
def until_closed() -> Iterator[None]:
    """Write until the block ends or the reader of a pipe has what it wanted, as in ``| head``; nothing is left over."""
    try:
        yield
        sys.stdout.flush()
    except BrokenPipeError:
        _abandon_output()


def _exit(code: int, error: object) -> typer.Exit:
    console(stderr=True).print(visible(f"error: {error}"), style="red")
    return typer.Exit(code)


def _abandon_output() -> None:
    """Let nothing be written to the closed pipe when Python ends."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (OSError, ValueError):  # not a file of the system's
        return
