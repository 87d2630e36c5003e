"""The rows of a sweep: which value each key has in each run, settled before anything runs."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar.errors import InvalidValue
from coplanar.scenarios import InvalidScenario, Problem, Scenario, read_value
from coplanar.sweeps.keys import at
from coplanar.sweeps.task import SEED
from coplanar.sweeps.vary import Normal, Span, Uniform, Values, as_vary
from coplanar.version import __version__

MOST_ROWS = 100_000_000


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """What a sweep runs; the same plan gives the same table, whoever works on it.

    Attributes:
        scenario: What is varied.
        columns: The varied keys and their values, shape (rows,); numbers in SI units.
        seed: Of the draws.
        task_rows: How many rows go to a worker at once.
    """

    scenario: Scenario
    columns: Mapping[str, np.ndarray]
    seed: int
    task_rows: int

    @property
    def rows(self) -> int:
        """How many runs."""
        return len(next(iter(self.columns.values())))

    def tasks(self) -> Iterator[dict[str, list[Any]]]:
        """The columns, ``task_rows`` at a time."""
        for start in range(0, self.rows, self.task_rows):
            yield {key: values[start : start + self.task_rows].tolist() for key, values in self.columns.items()}

    @property
    def count(self) -> int:
        """How many tasks."""
        return math.ceil(self.rows / self.task_rows)

    def digest(self) -> str:
        """The same for the same plan of the same version only."""
        told = hashlib.sha256(json.dumps([__version__, self.scenario.data(), self.seed, self.task_rows]).encode())
        for key, values in self.columns.items():
            told.update(key.encode())
            told.update(values.tobytes() if values.dtype != object else repr(values.tolist()).encode())
        return told.hexdigest()


def planned(
    scenario: Scenario, vary: Mapping[str, Any], *, samples: int | None = None, seed: int = 0, task_rows: int = 250
) -> Plan:
    """Every combination of the listed values, each with ``samples`` draws of what is random.

    Args:
        scenario: What is varied.
        vary: Key to what ``read_vary`` reads, a list, ``Uniform`` or ``Normal``.
        samples: Draws for each combination.
        seed: Of the draws: the same seed, the same rows. Where the scenario has noise, each row gets a seed for it.
        task_rows: How many rows go to a worker at once.

    Raises:
        InvalidValue: If nothing is varied, draws are wanted of nothing, or there are too many rows.
        InvalidScenario: If a key or a value does not fit the scenario.
    """
    _check("seed", seed, 0, 2**63)
    _check("task_rows", task_rows, 1, 1_000_000)
    kinds = {key: _settled(scenario, key, as_vary(given)) for key, given in vary.items()}
    lists = {key: kind for key, kind in kinds.items() if isinstance(kind, Values)}
    drawn = {key: kind for key, kind in kinds.items() if not isinstance(kind, Values)}
    if drawn and samples is None:
        raise InvalidValue("samples", None, f"a number of draws of {', '.join(drawn)}", "or lo:hi:n for a grid")
    if samples is not None:
        _check("samples", samples, 1, MOST_ROWS)
    rows = math.prod(len(kind.values) for kind in lists.values()) * (samples or 1)
    if not vary and samples is None:
        raise InvalidValue("vary", {}, "keys to vary, or a number of samples")
    if rows > MOST_ROWS:
        raise InvalidValue("rows", rows, f"at most {MOST_ROWS}", "take fewer values")
    columns = _grid(lists, samples or 1) | {
        key: _draws(kind, rows, np.random.default_rng((seed, place))) for place, (key, kind) in enumerate(drawn.items())
    }
    if samples is not None and SEED not in columns and getattr(scenario, "noise", None) is not None:
        columns[SEED] = np.random.default_rng((seed, len(drawn), 1)).integers(0, 2**32, rows)
    if not columns:
        raise InvalidValue("samples", samples, "something to draw", "vary a key, or give the scenario noise")
    ordered = {key: columns[key] for key in (*vary, SEED) if key in columns}
    return Plan(scenario, ordered, seed, task_rows)


def _check(name: str, value: Any, low: int, high: int) -> None:
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or not low <= value <= high:
        raise InvalidValue(name, value, f"a whole number from {low} to {high}")


def _settled(scenario: Scenario, key: str, kind: Any) -> Values | Uniform | Normal:
    """The same in SI units; every listed value and every bound has been tried on the scenario."""
    if isinstance(kind, Values):
        return Values(tuple(_value(scenario, key, value) for value in kind.values))
    if isinstance(kind, Normal):
        return Normal(_number(scenario, key, kind.mean), kind.deviation)
    low, high = _number(scenario, key, kind.low), _number(scenario, key, kind.high)
    return kind.between(low, high) if isinstance(kind, Span) else Uniform(low, high)


def _value(scenario: Scenario, key: str, given: Any) -> Any:
    value = read_value(given) if isinstance(given, str) else given
    return at(scenario.replaced({key: value}), key)


def _number(scenario: Scenario, key: str, given: Any) -> float:
    value = _value(scenario, key, given)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InvalidScenario([Problem(key, str(given), "a number to span a range")], scenario.name)
    return float(value)


def _grid(lists: Mapping[str, Values], repeats: int) -> dict[str, np.ndarray]:
    """Every combination, the last key changing fastest, each ``repeats`` times."""
    sizes = [len(kind.values) for kind in lists.values()]
    places = np.indices([*sizes, repeats]).reshape(len(sizes) + 1, -1)
    return {key: _array(kind.values)[place] for (key, kind), place in zip(lists.items(), places, strict=False)}


def _array(values: tuple[Any, ...]) -> np.ndarray:
    if all(type(value) in (int, float) for value in values) and not all(type(value) is int for value in values):
        return np.array(values, dtype=np.float64)
    array = np.empty(len(values), dtype=np.int64 if all(type(value) is int for value in values) else object)
    array[:] = values
    return array


def _draws(kind: Uniform | Normal, rows: int, random: np.random.Generator) -> np.ndarray:
    if isinstance(kind, Uniform):
        return random.uniform(min(kind.low, kind.high), max(kind.low, kind.high), rows)
    return random.normal(kind.mean, kind.deviation, rows)
