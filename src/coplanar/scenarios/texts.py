"""From a text in YAML, TOML or JSON to plain data, with the line of every key.

YAML is read as version 1.2 says: ``1e-3`` is a number, ``on`` and ``12:30`` are texts, and a key stands once.
"""

from __future__ import annotations

import json
import math
import re
import tomllib
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, NoReturn

import yaml

from coplanar.scenarios.problems import InvalidScenario, Problem, key_text, shown

LARGEST_TEXT = 256 * 1024  # characters of a scenario
DEEPEST = 24  # mappings and lists inside one another
MOST_VALUES = 40_000  # keys and values, each alias counted as often as it is used
_SIZE = f"at most {MOST_VALUES} values, in at most {DEEPEST} levels of mappings and lists"
_WHOLE = re.compile(r"[-+]?[0-9]+", re.ASCII)
_NUMBER = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?", re.ASCII)
_PART = r"(?:[\w-]++|\"[^\"\n]*+\"|'[^'\n]*+')"
_DOTTED = re.compile(rf"(?<![\w\"'-]){_PART}(?:[ \t]*+\.[ \t]*+{_PART}){{{DEEPEST},}}+")
_WORDS = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
    **dict.fromkeys((".inf", ".Inf", ".INF", "+.inf", "+.Inf", "+.INF"), math.inf),
    **dict.fromkeys(("-.inf", "-.Inf", "-.INF"), -math.inf),
    **dict.fromkeys((".nan", ".NaN", ".NAN"), math.nan),
}
_PLAIN_TAGS = frozenset(
    ("str", "int", "float", "bool", "null", "timestamp", "merge", "value")
)  # as PyYAML resolves them
Place = tuple[str | int, ...]


class Parsed(NamedTuple):
    """What a text says.

    Attributes:
        data: Mappings, lists, texts, numbers, true and false, None.
        lines: The line of each key and list entry, by its path; empty where lines are not known.
    """

    data: Any
    lines: Mapping[Place, int]


def parsed(text: str, form: str, source: str) -> Parsed:
    """The data of a text.

    Args:
        text: The whole text.
        form: A key of ``FORMS``.
        source: What to call it in errors.

    Raises:
        InvalidScenario: If it cannot be read.
    """
    if len(text) > LARGEST_TEXT:
        refuse(source, "", f"a text of {len(text)} characters", f"at most {LARGEST_TEXT}")
    try:
        data, lines = FORMS[form](text)
    except _Refused as error:
        raise InvalidScenario([error.problem], source) from None
    except RecursionError:
        refuse(source, "", "", _SIZE)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        refuse(source, "", _sentence(error), f"{form.upper()} that can be read", mark.line + 1 if mark else None)
    except (json.JSONDecodeError, tomllib.TOMLDecodeError) as error:
        refuse(source, "", _sentence(error), f"{form.upper()} that can be read", _line_of(error))
    except ValueError as error:  # whole numbers of thousands of digits
        refuse(source, "", _sentence(error), "numbers of a sane length")
    return Parsed(data, lines)


def refuse(source: str, key: str, given: str, needed: str, line: int | None = None) -> NoReturn:
    """Raise the error for a single problem."""
    raise InvalidScenario([Problem(key, given, needed, "", line)], source) from None


class _Refused(Exception):
    def __init__(self, key: Place, given: str, needed: str, line: int | None = None) -> None:
        self.problem = Problem(key_text(key), given, needed, "", line)


def _sentence(error: Exception) -> str:
    told = getattr(error, "problem", None) or getattr(error, "reason", None) or str(error)
    return key_text([str(told).partition(";")[0]])


def _line_of(error: Exception) -> int | None:
    line = getattr(error, "lineno", None)
    told = re.search(r"at line (\d+)", str(error))
    return line or (int(told[1]) if told else None)


class _Loader(yaml.SafeLoader):
    """PyYAML's composer with a bound on its nodes and their depth."""

    depth = count = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        self.depth, self.count = self.depth + 1, self.count + 1
        if self.depth > DEEPEST or self.count > MOST_VALUES:
            raise _Refused((), "", _SIZE, self.line + 1)
        node = super().compose_node(parent, index)
        self.depth -= 1
        return node


class _Tree:
    """Nodes of YAML as data, and the lines of what they hold."""

    def __init__(self) -> None:
        self.lines: dict[Place, int] = {}
        self.count = 0

    def data(self, node: yaml.Node, place: Place) -> Any:
        self.count += 1
        if self.count > MOST_VALUES or len(place) > DEEPEST:
            raise _Refused((), "", _SIZE, node.start_mark.line + 1)
        self.lines.setdefault(place, node.start_mark.line + 1)
        if isinstance(node, yaml.MappingNode):
            return self._mapping(node, place)
        if isinstance(node, yaml.SequenceNode):
            return [self.data(item, (*place, i)) for i, item in enumerate(node.value)]
        return _scalar(node, place)

    def _mapping(self, node: yaml.MappingNode, place: Place) -> dict[str, Any]:
        held: dict[str, Any] = {}
        for key_node, value in node.value:
            line = key_node.start_mark.line + 1
            if not isinstance(key_node, yaml.ScalarNode):
                raise _Refused(place, "a list or mapping as a key", "keys that are words", line)
            key = str(key_node.value)
            if key in held:
                raise _Refused((*place, key), "", "each key once; it stands here a second time", line)
            self.lines[(*place, key)] = line
            held[key] = self.data(value, (*place, key))
        return held


def _scalar(node: yaml.Node, place: Place) -> Any:
    text, tag = str(node.value), str(node.tag)
    if tag.removeprefix("tag:yaml.org,2002:") not in _PLAIN_TAGS:
        raise _Refused(place, shown(tag), "values without tags of their own", node.start_mark.line + 1)
    if getattr(node, "style", None) in ("'", '"', "|", ">") or (
        tag.endswith(":str") and text not in _WORDS and not _NUMBER.fullmatch(text)
    ):
        return text
    if text in _WORDS:
        return _WORDS[text]
    if _WHOLE.fullmatch(text):
        return int(text)
    return float(text) if _NUMBER.fullmatch(text) else text


def _from_yaml(text: str) -> tuple[Any, dict[Place, int]]:
    loader = _Loader(text)
    try:
        node = loader.get_single_node()
        tree = _Tree()
        return (None if node is None else tree.data(node, ())), tree.lines
    finally:
        loader.dispose()


def _from_json(text: str) -> tuple[Any, dict[Place, int]]:
    data = json.loads(text, object_pairs_hook=_once)
    try:  # nearly every JSON text is YAML as well, which knows its lines
        lines = _from_yaml(text)[1]
    except (yaml.YAMLError, _Refused):
        lines = {}
    return data, lines


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    held = dict(pairs)
    if len(held) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise _Refused((twice,), "", "each key once; it stands twice in one mapping")
    return held


def _from_toml(text: str) -> tuple[Any, dict[Place, int]]:
    deep = _DOTTED.search(text)
    if deep:  # tomllib takes time as the square of such a key's length
        line = text.count("\n", 0, deep.start()) + 1
        raise _Refused((), "a dotted key", _SIZE, line)
    data = tomllib.loads(text)
    return data, _lines_of_toml(text, data)


def _lines_of_toml(text: str, data: Any) -> dict[Place, int]:
    """Lines of the keys that stand at the beginning of one; tables of arrays are counted."""
    lines: dict[Place, int] = {}
    table: Place = ()
    seen: dict[Place, int] = {}
    for number, line in enumerate(text.splitlines(), 1):
        header = re.match(r"\s*(\[\[?)([\w.\- ]+)\]", line)
        key = re.match(r"\s*([\w.\-]+)\s*=", line)
        if header:
            table = tuple(part.strip() for part in header[2].split("."))
            if header[1] == "[[":
                seen[table] = seen.get(table, -1) + 1
                table = (*table, seen[table])
            lines.setdefault(table, number)
        elif key:
            lines.setdefault((*table, *key[1].split(".")), number)
    return {place: line for place, line in lines.items() if data}


FORMS: Mapping[str, Callable[[str], tuple[Any, dict[Place, int]]]] = {
    "yaml": _from_yaml,
    "toml": _from_toml,
    "json": _from_json,
}
