"""What one worker does: measure some rows, in batches where the scenario's kind takes arrays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from coplanar.engine import reproducible
from coplanar.errors import InvalidInput
from coplanar.scenarios import Scenario, from_data, measured
from coplanar.sweeps.keys import at

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
    if getattr(scenario, "noise", None) is not None:  # a seed for each, so that each draws what it would draw alone
        columns = {SEED: [at(scenario, SEED)] * rows, **columns}
    with reproducible():
        try:
            return {name: values.tolist() for name, values in measured(scenario, columns).items()}
        except InvalidInput:  # at least one of them cannot run: each by itself, to say which
            found = [_one(scenario, {key: values[row] for key, values in columns.items()}) for row in range(rows)]
    names = dict.fromkeys(name for measures in found for name in measures)
    return {name: [measures.get(name, _missing(name)) for measures in found] for name in names}


def _one(scenario: Scenario, changes: Mapping[str, Any]) -> dict[str, Any]:
    try:
        measures = scenario.replaced(changes).measure()
    except InvalidInput as error:
        return {PROBLEM: str(error)}
    return {name: value.item() if isinstance(value, np.generic) else value for name, value in measures.items()}


def _missing(name: str) -> Any:
    return "" if name == PROBLEM else float("nan")
