"""What a run leaves behind, written and read back."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from coplanar.errors import InvalidValue
from coplanar.run import Run, RunStatus
from coplanar.run.files import read_table, write_table
from coplanar.scenarios import Outcome, Scenario, load
from coplanar.store.folders import whole_folder
from coplanar.version import __version__
from coplanar.viz import drawn_in
from coplanar.viz.outcomes import figure_of

SCENARIO, SUMMARY = "scenario.yaml", "summary.json"
TABLE, MOTION = "run.csv", "motion.csv"
FORMAT = 1
LARGEST_SUMMARY = 2**24  # bytes


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """A run as it was read from its folder.

    Attributes:
        folder: Where it is.
        scenario: As it was run.
        summary: What ``summary.json`` says.
        run: The table over time, where something moves in time.
    """

    folder: Path
    scenario: Scenario
    summary: Mapping[str, Any]
    run: Run | None


def write_record(outcome: Outcome, folder: Path, *, themes: tuple[str, ...] = ("light", "dark")) -> Path:
    """Write an outcome as a folder; one that holds an earlier run is replaced.

    Args:
        outcome: What a scenario gave.
        folder: Where to.
        themes: Of the figures; none for no figures.

    Returns:
        The folder.

    Raises:
        InvalidValue: If something else is there.
        OSError: If it cannot be written.
    """
    with whole_folder(folder, is_record) as part:
        (part / SCENARIO).write_text(outcome.scenario.to_yaml(defaults=True), encoding="utf-8")
        for name, table in _tables(outcome).items():
            write_table(part / name, table)
        for theme in themes if outcome.tables else ():
            _draw(outcome, part / f"figure-{theme}.svg", theme)
        text = json.dumps(_summary(outcome), indent=2, allow_nan=False, ensure_ascii=False)
        (part / SUMMARY).write_text(text + "\n", encoding="utf-8")
    return folder


def is_record(folder: Path) -> bool:
    """Whether a run was written to this folder."""
    return (folder / SCENARIO).is_file() and (folder / SUMMARY).is_file()


def read_record(folder: Path) -> Record:
    """Read a folder that ``write_record`` wrote.

    Raises:
        InvalidValue: If it is no such folder, or a file of it cannot be used.
        InvalidScenario: If the scenario in it cannot be used.
    """
    if not is_record(folder):
        raise InvalidValue("run", str(folder), f"a folder with {SCENARIO} and {SUMMARY}", "make one by  coplanar run")
    summary = _told(folder / SUMMARY)
    return Record(folder, load(folder / SCENARIO), summary, _run(folder, summary))


def _summary(outcome: Outcome) -> dict[str, Any]:
    run = outcome.run
    facts = {} if run is None else {"kind": _kind(run), "index": run.index, "status": run.status.name}
    moving = {} if run is None else {"run": {"table": _table_of(outcome), **facts}}
    return {
        "format": FORMAT, "coplanar": __version__, "name": outcome.name, "title": outcome.title, "ok": outcome.ok,
        "status": outcome.status, "headline": outcome.headline, "check": outcome.check, "passed": outcome.passed,
        "summary": dict(outcome.summary), "warnings": list(outcome.warnings), **moving,
    }  # fmt: skip


def _tables(outcome: Outcome) -> dict[str, Any]:
    """The tables of an outcome, the run over time among them."""
    moving = {} if outcome.run is None else {_table_of(outcome): outcome.run.columns}
    return {**moving, **outcome.tables}


def _table_of(outcome: Outcome) -> str:
    """Which table holds the run: the first one, unless that says something else, or over something else than time."""
    columns = {} if outcome.run is None else outcome.run.columns
    first = outcome.tables.get(TABLE, columns)
    same = (name in first and np.array_equal(values, first[name], equal_nan=True) for name, values in columns.items())
    return TABLE if all(same) else MOTION


def _kind(run: Run) -> str:
    return run.kind if isinstance(run.kind, str) else "table"


def _draw(outcome: Outcome, path: Path, theme: str) -> None:
    from matplotlib.figure import Figure

    with drawn_in(theme):
        canvas = Figure(figsize=(9.0, 4.2))
        figure_of(outcome, canvas)
        canvas.savefig(path, metadata={"Date": None})


def _told(path: Path) -> dict[str, Any]:
    try:
        with path.open("rb") as file:
            data = json.loads(file.read(LARGEST_SUMMARY))
    except (ValueError, RecursionError) as error:
        raise InvalidValue(SUMMARY, str(path.parent), f"JSON ({error})", "run the scenario again") from None
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        raise InvalidValue(SUMMARY, str(path.parent), f'"format": {FORMAT}', "run the scenario again")
    return data


def _run(folder: Path, summary: Mapping[str, Any]) -> Run | None:
    facts = summary.get("run")
    if facts is None:
        return None
    try:
        kind, index, status = facts["kind"], facts["index"], RunStatus[facts["status"]]
        table = read_table(folder / {TABLE: TABLE, MOTION: MOTION}[facts["table"]])
    except (KeyError, TypeError):
        raise InvalidValue(
            SUMMARY, str(folder), "the table, kind, index and status of the run", "run it again"
        ) from None
    return Run(table, kind, index=index, status=status, warnings=tuple(map(str, summary.get("warnings", ()))))
