"""The playground without its page: a message in, a message out."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from typing import Any

from coplanar import checks
from coplanar.errors import CoplanarError, InvalidInput, InvalidShape, InvalidValue, UnknownName
from coplanar.play import protocol, scenarios
from coplanar.play.controls import State, checked_state, point_of
from coplanar.play.tab import Tab
from coplanar.play.tabs import TABS

REACH = 1000.0  # [m] nothing is dragged further
WARMING = [[0.5, 0.5], [0.6, 0.7], [0.8, 0.7], [0.9, 0.5]]  # a stroke
PRESSES = 100  # of an arrow key in one request
KEYS = ("id", "do", "tab", "state", "live", "changed", "drag", "nudge", "as")

_log = logging.getLogger(__name__)


class Session:
    """Answers messages of ``coplanar.play.protocol``; it holds no state, so that one serves everybody.

    Example:
        >>> answer = Session().handle('{"id": 1, "do": "show", "tab": "arm"}')
        >>> answer["ok"], answer["tab"], sorted(answer["pictures"])
        (True, 'arm', ['main'])
        >>> Session().handle({"id": 2, "do": "sing"})["error"]["sentence"]
        "do = 'sing': needed one of copy, describe, show"
    """

    def handle(self, message: str | bytes | Mapping[str, Any]) -> dict[str, Any]:
        """The answer to a message: a mapping that strict JSON can hold. Never an exception.

        Args:
            message: Text, or what a JSON reader makes of it.
        """
        identity = None
        try:
            request = protocol.read(message)
            identity = protocol.identity_of(request)
            return {"id": identity, "ok": True, **_answered(request)}
        except CoplanarError as error:
            return protocol.refusal(identity, error)
        except Exception:  # what nobody thought of must not end the connection
            _log.exception("the playground could not answer")
            return protocol.refusal(identity, CoplanarError("a fault of the playground itself; it is in its log"))

    def answer(self, message: str | bytes | Mapping[str, Any]) -> str:
        """The answer as strict JSON."""
        return protocol.written(self.handle(message))

    def warm(self) -> None:
        """Import what the tabs need late, and answer each once, so that the first user does not wait."""
        for name in TABS:
            for state in ({}, {"curve": "stroke", "stroke": WARMING}):
                for live in (False, True):
                    self.handle({"id": 0, "do": "show", "tab": name, "state": state, "live": live})


def _answered(request: dict[str, Any]) -> dict[str, Any]:
    for key in request:
        if key not in KEYS:
            raise UnknownName("key", key, KEYS)
    verbs = {"describe": _describe, "show": _show, "copy": _copy}
    do = request.get("do")
    if not isinstance(do, str) or do not in verbs:
        raise UnknownName("do", do, verbs)
    return verbs[do](request)


def _describe(_request: dict[str, Any]) -> dict[str, Any]:
    tabs = [
        {
            "name": tab.name, "title": tab.title, "about": tab.about,
            "controls": [control.as_mapping() for control in tab.controls],
        }
        for tab in TABS.values()
    ]  # fmt: skip
    return {"tabs": tabs}


def _show(request: dict[str, Any]) -> dict[str, Any]:
    tab, state = _tab_and_state(request)
    live = request.get("live", False)
    if not isinstance(live, bool):
        raise InvalidValue("live", live, "true or false")
    live = live or "drag" in request or "nudge" in request
    changed = _changed(tab, request)
    state = _moved(tab, state, request) if "drag" in request or "nudge" in request else tab.settled(state, changed)
    answer = tab.show(state, live=live)
    return {"tab": tab.name, "state": state, **answer.as_mapping()}


def _copy(request: dict[str, Any]) -> dict[str, Any]:
    tab, state = _tab_and_state(request)
    form = request.get("as")
    if not isinstance(form, str) or form not in ("python", "yaml"):
        raise UnknownName("as", form, ("python", "yaml"))
    state = tab.settled(state, "")
    return {"text": tab.python(state) if form == "python" else scenarios.text_of(tab, state)}


def _tab_and_state(request: dict[str, Any]) -> tuple[Tab, State]:
    name = request.get("tab")
    if not isinstance(name, str) or name not in TABS:
        raise UnknownName("tab", name, TABS)
    tab = TABS[name]
    return tab, checked_state(tab.controls, request.get("state", {}))


def _changed(tab: Tab, request: dict[str, Any]) -> str:
    key = request.get("changed", "")
    if not isinstance(key, str) or (key and key not in {control.key for control in tab.controls}):
        raise UnknownName("changed", key, [control.key for control in tab.controls])
    return key


def _moved(tab: Tab, state: State, request: dict[str, Any]) -> State:
    """The state after the drag or the nudge."""
    if "drag" in request:
        handle, to = _pair(request["drag"], "drag", "to")
        return tab.moved(state, handle, point_of("drag.to", to, REACH))
    name, by = _pair(request["nudge"], "nudge", "by")
    right, up = _presses(by)
    state = tab.settled(state, "")
    handles = {handle.name: handle for handle in tab.show(state, live=True).handles}
    return tab.moved(state, name, handles[checks.choice("handle", name, handles)].nudged(right, up))


def _pair(value: Any, key: str, second: str) -> tuple[str, Any]:
    if not isinstance(value, Mapping) or set(value) != {"handle", second} or not isinstance(value["handle"], str):
        raise InvalidInput(key, value, f'{{"handle": name, "{second}": [x, y]}}')
    return value["handle"], value[second]


def _presses(by: Any) -> tuple[int, int]:
    if not isinstance(by, list | tuple) or len(by) != 2:
        raise InvalidShape("nudge.by", f"a {type(by).__name__}", "two whole numbers [right, up]")
    for count in by:
        if isinstance(count, bool) or not isinstance(count, int) or abs(count) > PRESSES:
            raise InvalidValue("nudge.by", count, f"whole numbers from {-PRESSES} to {PRESSES}")
    return by[0], by[1]
