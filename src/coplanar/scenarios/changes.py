"""Other values for keys of a scenario, by their path."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from coplanar.scenarios.problems import InvalidScenario, Problem, did_you_mean, key_text, shown
from coplanar.scenarios.texts import parsed


def changed(scenario: Any, changes: Mapping[str, Any]) -> dict[str, Any]:
    """The plain data of a scenario with other values under some keys.

    Raises:
        InvalidScenario: If a key leads nowhere.
    """
    data: dict[str, Any] = scenario.data()
    whole = scenario.data(defaults=True)
    problems = [problem for key, value in changes.items() if (problem := _set(data, whole, key, value))]
    if problems:
        raise InvalidScenario(problems, scenario.name)
    return data


def read_value(text: str) -> Any:
    """What the right side of ``key=value`` says: as in a YAML file.

    Raises:
        InvalidScenario: If it cannot be read.

    Example:
        >>> read_value("[1, 0.8]"), read_value("1e-3"), read_value("30 deg"), read_value("null")
        ([1, 0.8], 0.001, '30 deg', None)
    """
    return parsed(text, "yaml", shown(text)).data


def _set(data: Any, whole: Any, key: str, value: Any) -> Problem | None:
    """Put a value under a path, with the defaults of what stands on the way; what is wrong if it leads nowhere."""
    *way, last = key.split(".")
    for place, step in enumerate(way):
        inner = _filled(data, whole, step)
        if inner is None:
            return _nowhere(data, whole, key_text(way[: place + 1]), step)
        data, whole = inner, _get(whole, step)
    if isinstance(data, list) and _get(data, last) is _NOTHING:
        return _nowhere(data, whole, key, last)
    data[int(last) if isinstance(data, list) else last] = value
    return None


_NOTHING = object()


def _get(data: Any, step: str) -> Any:
    """What is under a step; a marker where nothing is."""
    if isinstance(data, list):
        place = int(step) if re.fullmatch(r"[0-9]{1,6}", step) else len(data)
        return data[place] if place < len(data) else _NOTHING
    return data.get(step, _NOTHING) if isinstance(data, dict) else _NOTHING


def _filled(data: Any, whole: Any, step: str) -> Any:
    """The mapping or list under a step, taken from the defaults where it was not given; None where there is none."""
    inner, usual = _get(data, step), _get(whole, step)
    if inner is _NOTHING and usual is _NOTHING:
        return None
    if inner is _NOTHING or inner is None:
        inner = {} if usual is None or usual is _NOTHING or isinstance(usual, dict) else usual
        data[int(step) if isinstance(data, list) else step] = inner
    return inner if isinstance(inner, dict | list) else None


def _nowhere(data: Any, whole: Any, key: str, step: str) -> Problem:
    if isinstance(data, list) and _get(data, step) is _NOTHING:
        return Problem(key, "", f"a place from 0 to {len(data) - 1}")
    held = _get(data, step) if _get(data, step) is not _NOTHING else _get(whole, step)
    if held is not _NOTHING:
        return Problem(key, shown(held), "no keys behind it: it holds one value")
    known = list({**(whole if isinstance(whole, dict) else {}), **data})
    return Problem(key, "", f"a key that is known here: {', '.join(known)}", did_you_mean(step, known))
