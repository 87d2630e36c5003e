"""What running a scenario gives."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from coplanar.run import Run

Table = Mapping[str, Sequence[Any] | Any]  # column name to values: numbers, or words


class Finding(NamedTuple):
    """One sentence about a scenario, known before it runs.

    Attributes:
        sentence: What is to be known.
        tone: "good", "note", "warn", or "no" where running it would end in an honest no.
    """

    sentence: str
    tone: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Outcome:
    """A scenario, run.

    Attributes:
        scenario: As it was run.
        ok: False where the honest answer is no: out of reach, out of range, unstable gains refused.
        status: How it ended, in a sentence.
        headline: The number one remembers, with its unit.
        check: What was compared with what, and how closely they agree.
        passed: Whether the check held.
        tables: File name to table; ``run.csv`` is the first.
        run: The run, where something moves in time.
        things: What was built and found, by name, for pictures.
        summary: The headline numbers, as JSON takes them: None where there is no finite number.
        warnings: Sentences to know.
    """

    scenario: Any  # a Scenario, whose kind says which keys it has
    ok: bool
    status: str
    headline: str
    check: str
    passed: bool
    tables: Mapping[str, Table]
    run: Run | None = None
    things: Mapping[str, Any] = field(default_factory=dict)
    summary: Mapping[str, Any] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The scenario's name, fit for a folder."""
        return str(self.scenario.name)

    @property
    def title(self) -> str:
        """What the scenario shows, in a line."""
        return str(self.scenario.title)

    @property
    def story(self) -> str:
        """What the scenario says about itself."""
        return str(self.scenario.description)


def plain(numbers: Mapping[str, Any]) -> dict[str, Any]:
    """Numbers as JSON takes them; None for what is not finite.

    Example:
        >>> plain({"gap": np.float64(0.5), "reached": np.True_, "q": np.array([1.0, np.inf])})
        {'gap': 0.5, 'reached': True, 'q': [1.0, None]}
    """
    return {name: _plain(value) for name, value in numbers.items()}


def _plain(value: Any) -> Any:
    if isinstance(value, str) or value is None:
        return value
    if np.ndim(value):
        return [_plain(entry) for entry in np.asarray(value).tolist()]
    number = np.asarray(value).item()
    return number if isinstance(number, bool | int) or np.isfinite(number) else None
