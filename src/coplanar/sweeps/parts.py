"""What is finished of a sweep, on disk beside its table, so that an interrupted one goes on."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from coplanar.errors import InvalidValue
from coplanar.run.files import written_whole
from coplanar.sweeps.plan import Plan
from coplanar.sweeps.task import Columns


class Parts:
    """The finished tasks of one plan, a file each, in a folder; kept in memory alone where there is no folder."""

    def __init__(self, plan: Plan, table: Path | None) -> None:
        """Open or make the folder ``<table>.parts``.

        Raises:
            InvalidValue: If it holds the parts of another plan.
            OSError: If it cannot be made.
        """
        self._folder = None if table is None else table.with_name(f"{table.name}.parts")
        self._done: dict[int, Columns] = {}
        if self._folder is not None:
            self._open(self._folder, plan)

    def _open(self, folder: Path, plan: Plan) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        label, digest = folder / "plan.json", plan.digest()
        if label.exists() and _read(label) != digest:
            remedy = f"remove {folder}, or write to another table"
            raise InvalidValue("parts", folder.name, "those of the same scenario, keys, values and seed", remedy)
        _write(label, digest)
        for path in folder.glob("[0-9]*.json"):
            columns = _read(path)
            if isinstance(columns, dict):
                self._done[int(path.stem)] = columns

    def __contains__(self, number: int) -> bool:
        return number in self._done

    def __len__(self) -> int:
        return len(self._done)

    def add(self, number: int, columns: Columns) -> None:
        """Keep what a task found."""
        if self._folder is not None:
            _write(self._folder / f"{number}.json", columns)
        self._done[number] = columns

    def __iter__(self) -> Iterator[Columns]:
        return (self._done[number] for number in sorted(self._done))

    def remove(self) -> None:
        """Away with the folder: its table is written."""
        if self._folder is not None:
            shutil.rmtree(self._folder)


def _write(path: Path, data: Any) -> None:
    with written_whole(path) as part:
        part.write_text(json.dumps(data), encoding="utf-8")


def _read(path: Path) -> Any:
    """What the file says; None where it cannot be read: that part is worked out again."""
    try:
        return json.loads(path.read_text("utf-8"))
    except (OSError, ValueError):
        return None
