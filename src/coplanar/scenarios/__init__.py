"""Scenarios: what robots do, written down in files; every demonstration of the library is one.

``load("track-astroid").run()`` gives an ``Outcome``; ``load("my.yaml")`` tells everything that is wrong with a file at
once.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from coplanar.lazy import names_of

if TYPE_CHECKING:
    from coplanar.scenarios.batches import batched, measured, varied
    from coplanar.scenarios.catalog import names
    from coplanar.scenarios.changes import read_value
    from coplanar.scenarios.kinds import KINDS
    from coplanar.scenarios.outcome import Finding, Outcome
    from coplanar.scenarios.problems import InvalidScenario, Problem
    from coplanar.scenarios.reading import from_data, load, parse
    from coplanar.scenarios.scenario import Scenario
    from coplanar.scenarios.writing import schema, template

__all__ = [
    "KINDS",
    "Finding",
    "InvalidScenario",
    "Outcome",
    "Problem",
    "Scenario",
    "batched",
    "from_data",
    "load",
    "measured",
    "names",
    "parse",
    "read_value",
    "schema",
    "template",
    "varied",
]

__getattr__, __dir__ = names_of(
    __name__,
    {
        "batches": "batched measured varied",
        "catalog": "names",
        "changes": "read_value",
        "kinds": "KINDS",
        "outcome": "Finding Outcome",
        "problems": "InvalidScenario Problem",
        "reading": "from_data load parse",
        "scenario": "Scenario",
        "writing": "schema template",
    },
)
