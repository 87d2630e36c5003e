"""What one worker does: measure some rows, in batches where the scenario's kind takes arrays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from coplanar.engine import reproducible
from coplanar.errors import InvalidInput
from coplanar.scenarios import Scenario, from_data
from coplanar.sweeps.keys import at, put

Columns = dict[str, list[Any]]
SEED = "noise.seed"
PROBLEM = "problem"  # the column that says why a row has no numbers


def measure_rows(data: Mapping[str, Any], columns: Mapping[str, list[Any]]) -> Columns:
    """The measures of every row, a list each; a row that cannot run says why in the column "problem".

    Args:
        data: The scenario.
        columns: The varied keys and their values.
    """
    scenario = from_data(data)
    rows = len(next(iter(columns.values())))
    found: list[dict[str, Any]] = [{}] * rows
    with reproducible():
        for places in _alike(scenario, columns, rows):
            for place, measures in zip(places, _measured(scenario, columns, places), strict=True):
                found[place] = measures
    names = dict.fromkeys(name for measures in found for name in measures)
    return {name: [measures.get(name, _missing(name)) for measures in found] for name in names}


def _alike(scenario: Scenario, columns: Mapping[str, list[Any]], rows: int) -> list[list[int]]:
    """Rows that differ only in keys that are taken as arrays."""
    single = [key for key in columns if not scenario.takes_arrays(key)]
    groups: dict[Any, list[int]] = {}
    for place in range(rows):
        groups.setdefault(tuple(repr(columns[key][place]) for key in single), []).append(place)
    return list(groups.values())


def _measured(scenario: Scenario, columns: Mapping[str, list[Any]], places: list[int]) -> list[dict[str, Any]]:
    if len(places) == 1:
        return [_one(scenario, {key: values[places[0]] for key, values in columns.items()})]
    try:
        return _together(scenario, columns, places)
    except InvalidInput:  # at least one of them cannot run: each by itself, to say which
        return [_one(scenario, {key: values[place] for key, values in columns.items()}) for place in places]


def _together(scenario: Scenario, columns: Mapping[str, list[Any]], places: list[int]) -> list[dict[str, Any]]:
    """All rows in one call.

    What a range holds at its ends it holds inside, so the ends are checked; the library checks the rest as it builds.
    """
    arrays = {key: np.array([columns[key][p] for p in places]) for key in columns if scenario.takes_arrays(key)}
    batch = scenario.replaced({key: columns[key][places[0]] for key in columns})
    if getattr(batch, "noise", None) is not None:  # each draws what it would draw alone
        arrays.setdefault(SEED, np.full(len(places), at(batch, SEED)))
    for key, values in arrays.items():
        batch.replaced({key: values.min().item()})
        batch.replaced({key: values.max().item()})
    for key, values in arrays.items():
        batch = put(batch, key, values)
    spread = {
        name: np.broadcast_to(values, (len(places),)).tolist() if np.ndim(values) < 2 else list(values)
        for name, values in batch.measure().items()
    }
    return [{name: values[k] for name, values in spread.items()} for k in range(len(places))]


def _one(scenario: Scenario, changes: Mapping[str, Any]) -> dict[str, Any]:
    try:
        measures = scenario.replaced(changes).measure()
    except InvalidInput as error:
        return {PROBLEM: str(error)}
    return {name: value.item() if isinstance(value, np.generic) else value for name, value in measures.items()}


def _missing(name: str) -> Any:
    return "" if name == PROBLEM else float("nan")
