"""The command line. ``commands`` lists what there is; every command is a function in a module of its topic."""

from __future__ import annotations

import _thread
import signal
import sys
import threading
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from coplanar.cli.commands import app

__all__ = ["app", "main"]


def main() -> None:
    """Run ``coplanar`` as the shell does; asked to end, it puts away what is half done."""
    sys.unraisablehook = _unraised
    try:
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
        from coplanar.cli.commands import app

        app()
    except KeyboardInterrupt:  # before a command has begun
        sys.exit(130)


def _unraised(what: Any) -> None:
    """An interruption that Python met where it cannot raise it, as in a collector's call-back: it comes again soon."""
    if what.exc_type is KeyboardInterrupt:
        threading.Timer(0.01, _thread.interrupt_main).start()
    else:
        sys.__unraisablehook__(what)


def __getattr__(name: str) -> Any:
    if name != "app":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from coplanar.cli.commands import app

    return app
