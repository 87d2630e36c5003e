"""Between the states of the playground and scenario files."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from coplanar.errors import InvalidInput, InvalidValue
from coplanar.play.controls import State, checked_state
from coplanar.play.openings import OPENINGS
from coplanar.play.tab import Tab
from coplanar.play.tabs import TABS

if TYPE_CHECKING:
    from coplanar.scenarios import Scenario

HEAD = "# Made in the playground. Run it by  coplanar run FILE\n"
ALIKE = 1e-9  # relative, and absolute below 1: numbers of a scenario that the playground shows as they are
SLOW = ("lab",)  # whose numbers take too long to be compared; their openings are checked field by field


def text_of(tab: Tab, state: State) -> str:
    """The state as a scenario file in YAML.

    Raises:
        InvalidInput: If the library cannot take the state.
    """
    import yaml

    return HEAD + yaml.safe_dump(_data(tab, state), sort_keys=False, default_flow_style=None, width=100)


def opened(scenario: Scenario) -> tuple[str, State]:
    """The tab that shows a scenario, and its state there.

    Args:
        scenario: From ``coplanar.scenarios.load``.

    Raises:
        InvalidInput: If the playground has no tab for its kind, or cannot show all of it.

    Example:
        >>> from coplanar.scenarios import load
        >>> tab, state = opened(load("track-astroid"))
        >>> tab, state["kp"], state["curve"]
        ('drive', 100.0, 'astroid')
    """
    if scenario.type not in OPENINGS:
        raise InvalidValue("type", scenario.type, "one that the playground can show: " + ", ".join(OPENINGS))
    name, opening = OPENINGS[scenario.type]
    tab = TABS[name]
    state = tab.settled(checked_state(tab.controls, opening(scenario)), "")
    if scenario.type not in SLOW:
        _check_alike(scenario, _scenario(tab, state))
    return name, state


def _data(tab: Tab, state: State) -> dict[str, Any]:
    data = {"schema": 1, **tab.scenario(state)}
    _scenario(tab, state)
    return data


def _scenario(tab: Tab, state: State) -> Scenario:
    from coplanar.scenarios import from_data

    return from_data({"schema": 1, **tab.scenario(state)}, source=f"the {tab.title} tab")


def _check_alike(scenario: Scenario, shown: Scenario) -> None:
    """Refuse a scenario some of whose keys have no place in the playground: its numbers come out differently."""
    wanted, there = scenario.measure(), shown.measure()
    if scenario.type != shown.type or not all(_same(wanted[key], there.get(key, wanted[key])) for key in wanted):
        raise InvalidInput("scenario", scenario.name, "one whose keys all have a place in the playground")


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, Mapping) or isinstance(other, Mapping):
        return bool(one == other)
    a, b = float(one), float(other)
    return a == b or (math.isnan(a) and math.isnan(b)) or abs(a - b) <= ALIKE * max(1.0, abs(a))
