"""Many scenarios at once: keys that hold arrays, measured by the library's own broadcasting.

``varied`` puts arrays under keys; ``batched`` stacks scenarios of one structure; ``measured`` takes any keys: those
that hold arrays together, the others one after another.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from coplanar.errors import InvalidInput, InvalidShape, InvalidValue
from coplanar.scenarios.part import Part
from coplanar.scenarios.problems import InvalidScenario, Problem
from coplanar.scenarios.scenario import Scenario

Kind = TypeVar("Kind", bound=Scenario)
Columns = Mapping[str, Sequence[Any] | np.ndarray]


def varied(scenario: Kind, columns: Columns) -> Kind:
    """The scenario with arrays under some keys; ``measure`` then gives arrays.

    Args:
        scenario: Where everything else comes from.
        columns: Key to values, all of one length; every key one that the kind ``takes_arrays``.

    Raises:
        InvalidScenario: If a key takes no arrays, or a row is no valid scenario.
        InvalidShape: If the lengths differ.

    Example:
        >>> from coplanar.scenarios import load
        >>> many = varied(load("arm-reach"), {"target.0": [0.5, 0.8, 1.2]})
        >>> many.measure()["gap"].round(12).tolist()
        [0.0, 0.0, 0.2]
    """
    _length(columns)
    refused = [key for key in columns if not scenario.takes_arrays(key)]
    if refused:
        needed = f"a key that takes arrays: {', '.join(scenario.vectorised_keys) or 'none of this kind'}"
        raise InvalidScenario([Problem(key, "an array", needed) for key in refused], scenario.name)
    first = scenario.replaced({key: _entry(values, 0) for key, values in columns.items()})
    for row in sorted({row for values in columns.values() for row in _extremes(values)}):
        scenario.replaced({key: _entry(values, row) for key, values in columns.items()})
    for key, values in columns.items():
        first = _placed(first, key.split("."), _frozen(values))
    try:
        with np.errstate(all="ignore"):
            first.build()
    except InvalidInput as error:
        raise InvalidScenario([Problem(error.name, "an array", error.needed, error.remedy)], scenario.name) from None
    return first


def batched(scenarios: Sequence[Kind]) -> Kind:
    """Scenarios of one structure as one, with arrays where their numbers differ.

    Raises:
        InvalidShape: If there is none, or they are of different kinds or structures.
        InvalidScenario: If they differ in a key that takes no arrays.

    Example:
        >>> from coplanar.scenarios import load
        >>> shot = load("aim-speed")
        >>> batched([shot, shot.replaced({"target.0": 25.0})]).measure()["hit"].tolist()
        [True, True]
    """
    leaves = [dict(_leaves(scenario, ())) for scenario in scenarios]
    shapes = {(type(scenario), tuple((place, value is None) for place, value in own.items()))
              for scenario, own in zip(scenarios, leaves, strict=True)}  # fmt: skip
    if len(shapes) != 1:
        raise InvalidShape("scenarios", "none, or different structures", "one or more with the same keys")
    named = {place: [own[place] for own in leaves] for place in leaves[0] if place not in NAMES}
    columns = {".".join(place): values for place, values in named.items() if any(v != values[0] for v in values)}
    return varied(scenarios[0], columns) if columns else scenarios[0]


NAMES = (("name",), ("title",), ("description",))


def measured(scenario: Scenario, columns: Columns) -> dict[str, np.ndarray]:
    """The headline numbers of every row of a table of keys, shape (rows, ...).

    Rows that differ only in keys that take arrays are measured together, in pieces of bounded memory; a number that
    some rows do not have is NaN there.

    Args:
        scenario: Where everything else comes from.
        columns: Key to values, all of one length.

    Raises:
        InvalidScenario: If a row is no valid scenario; its problems say which key.
        InvalidShape: If the lengths differ.

    Example:
        >>> from coplanar.scenarios import load
        >>> table = measured(load("track-astroid-p"), {"controller.kp": [50.0, 50.0], "integrator.step": [0.01, 0.02]})
        >>> table["stable"].tolist(), table["largest_error"].round(4).tolist()
        ([True, True], [0.0188, 0.0188])
    """
    rows = _length(columns)
    arrays = {key: np.asarray(values) for key, values in columns.items() if scenario.takes_arrays(key)}
    others = {key: values for key, values in columns.items() if key not in arrays}
    groups: dict[tuple[Any, ...], list[int]] = {}
    for row in range(rows):
        groups.setdefault(tuple(repr(_entry(values, row)) for values in others.values()), []).append(row)
    parts = []
    for group in groups.values():
        one = (
            scenario.replaced({key: _entry(values, group[0]) for key, values in others.items()}) if others else scenario
        )
        parts += [(piece, _measured(one, arrays, piece)) for piece in _pieces(group, one.rows_at_once)]
    return _joined(parts, rows)


def _measured(scenario: Scenario, arrays: Mapping[str, np.ndarray], rows: list[int]) -> dict[str, np.ndarray]:
    if not arrays:
        return {name: np.broadcast_to(value, (len(rows), *np.shape(value)))
                for name, value in scenario.measure().items()}  # fmt: skip
    batch = varied(scenario, {key: values[rows] for key, values in arrays.items()})
    return {name: np.broadcast_to(value, (len(rows), *np.shape(value)[1:])) for name, value in batch.measure().items()}


def _joined(parts: list[tuple[list[int], dict[str, np.ndarray]]], rows: int) -> dict[str, np.ndarray]:
    """One table out of pieces of its rows."""
    names = list(dict.fromkeys(name for _, piece in parts for name in piece))
    table = {}
    for name in names:
        pieces = [(where, piece[name]) for where, piece in parts if name in piece]
        whole = sum(len(where) for where, _ in pieces) == rows
        kind = np.result_type(*(piece for _, piece in pieces))
        column = np.full((rows, *pieces[0][1].shape[1:]), 0 if whole else np.nan, kind if whole else np.float64)
        for where, piece in pieces:
            column[where] = piece
        table[name] = column
    return table


def _pieces(rows: list[int], most: int) -> Iterator[list[int]]:
    return (rows[first : first + most] for first in range(0, len(rows), most))


def _length(columns: Columns) -> int:
    lengths = {key: len(values) for key, values in columns.items()}
    if len(set(lengths.values())) != 1 or 0 in lengths.values():
        raise InvalidShape(
            "columns", ", ".join(f"{k}: {n}" for k, n in lengths.items()) or "none", "one length above 0"
        )
    return next(iter(lengths.values()))


def _entry(values: Sequence[Any] | np.ndarray, row: int) -> Any:
    value = values[row]
    return value.item() if isinstance(value, np.generic) else value


def _extremes(values: Sequence[Any] | np.ndarray) -> tuple[int, int]:
    """Rows of the smallest and the largest value, which are validated; the library checks the others."""
    column = np.asarray(values)
    if column.dtype.kind not in "iuf" or column.ndim != 1 or not np.isfinite(column).all():
        raise InvalidValue("columns", values, "finite numbers under keys that take arrays")
    return int(column.argmin()), int(column.argmax())


def _frozen(values: Sequence[Any] | np.ndarray) -> np.ndarray:
    column = np.array(values)
    column = column if column.dtype.kind in "iu" else column.astype(np.float64)
    column.flags.writeable = False
    return column


def _placed(holder: Any, way: list[str], values: np.ndarray) -> Any:
    """A part or a tuple with the values in place of what is at the end of the way."""
    step, rest = way[0], way[1:]
    if isinstance(holder, tuple):
        row = int(step)
        inner = _placed(holder[row], rest, values) if rest else values
        return (*holder[:row], inner, *holder[row + 1 :])
    return holder.model_copy(update={step: _placed(getattr(holder, step), rest, values) if rest else values})


def _leaves(value: Any, place: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Any]]:
    """Everything that is neither part nor tuple, with its keys."""
    if isinstance(value, Part):
        for name in type(value).model_fields:
            yield from _leaves(getattr(value, name), (*place, name))
    elif isinstance(value, tuple):
        for i, entry in enumerate(value):
            yield from _leaves(entry, (*place, str(i)))
    else:
        yield place, value
