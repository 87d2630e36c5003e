"""Names of a package that are imported when they are first asked for, so that nobody waits for what is not used."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Mapping
from typing import Any


def names_of(package: str, homes: Mapping[str, str]) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """The ``__getattr__`` and ``__dir__`` of a package whose modules hold these names.

    Args:
        package: Its ``__name__``.
        homes: Module of the package to the names that it offers, with blanks between them.

    Example:
        >>> find, _ = names_of("coplanar.se2", {"pose": "Pose"})
        >>> find("Pose")(1.0, 2.0, 0.5)
        Pose(x=1.0, y=2.0, theta=0.5)
    """
    home = {name: module for module, names in homes.items() for name in names.split()}

    def find(name: str) -> Any:
        if name not in home:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(importlib.import_module(f"{package}.{home[name]}"), name)
        setattr(sys.modules[package], name, value)
        return value

    def offered() -> list[str]:
        return sorted({*vars(sys.modules[package]), *home})

    return find, offered
