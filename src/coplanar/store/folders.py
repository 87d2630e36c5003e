"""Folders that appear whole or not at all."""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from coplanar.errors import InvalidValue


@contextmanager
def whole_folder(folder: Path, replaceable: Callable[[Path], bool]) -> Iterator[Path]:
    """A folder beside ``folder`` to write into; at the end it takes its place, so that nobody ever sees half of it.

    What was there before stays if anything fails on the way.

    Args:
        folder: Where it will be.
        replaceable: Whether what is there already may go; an empty folder may.

    Raises:
        InvalidValue: If something else is there.
        OSError: If it cannot be written.
    """
    if folder.exists() and not (folder.is_dir() and (not any(folder.iterdir()) or replaceable(folder))):
        raise InvalidValue("output", str(folder), "a new folder, or one that a run was written to", "choose another")
    folder.parent.mkdir(parents=True, exist_ok=True)
    mark = secrets.token_hex(4)
    part, old = folder.with_name(f".{folder.name}.{mark}.part"), folder.with_name(f".{folder.name}.{mark}.old")
    part.mkdir()
    try:
        yield part
        _swap(part, folder, old)
    finally:
        shutil.rmtree(part, ignore_errors=True)
        shutil.rmtree(old, ignore_errors=True)


def _swap(part: Path, folder: Path, old: Path) -> None:
    """Put the new folder in the place of the old one; the old one comes back if that fails."""
    if not folder.exists():
        os.replace(part, folder)
        return
    os.replace(folder, old)
    try:
        os.replace(part, folder)
    except OSError:
        os.replace(old, folder)
        raise
