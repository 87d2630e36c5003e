"""The command line. ``commands`` lists what there is; every command is a function in a module of its topic."""

from __future__ import annotations

import signal
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from coplanar.cli.commands import app

__all__ = ["app", "main"]


def main() -> None:
    """Run ``coplanar`` as the shell does; asked to end, it puts away what is half done."""
    try:
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
        from coplanar.cli.commands import app

        app()
    except KeyboardInterrupt:  # before a command has begun
        sys.exit(130)


def __getattr__(name: str) -> Any:
    if name != "app":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from coplanar.cli.commands import app

    return app
