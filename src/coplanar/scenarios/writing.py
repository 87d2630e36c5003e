"""From a scenario to YAML, with what each key is in a comment; and the JSON Schema that editors complete from."""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Iterator
from typing import Any, get_args

import yaml
from pydantic import BaseModel, TypeAdapter

from coplanar.scenarios.kinds import KINDS
from coplanar.scenarios.quantities import Quantity
from coplanar.scenarios.validation import keys_of

SCHEMA_FILE = "schema.json"
WIDTH = 108  # characters of a line before a long text is folded
_FOLDS = re.compile(r"[!-~]+( [!-~]+)*")  # words of ASCII with one space between them: folding loses nothing
_FOLD = textwrap.TextWrapper(WIDTH, break_long_words=False, break_on_hyphens=False)
_PLAIN = re.compile(r"[A-Za-z][A-Za-z0-9_/-]*( [A-Za-z0-9_/-]+)*")
_WORDS = frozenset(["true", "false", "null", "yes", "no", "on", "off", "y", "n", "inf", "nan"])


def yaml_of(data: dict[str, Any], model: Any, *, comments: bool) -> str:
    """Plain data of a model as YAML.

    Args:
        data: What the scenario gives by ``data``.
        model: Its class.
        comments: Whether each key is followed by what it is and its unit.
    """
    return "".join(f"{line}\n" for line in _mapping(data, model, 0, comments))


def _mapping(data: dict[str, Any], model: Any, depth: int, comments: bool) -> Iterator[str]:
    for key, value in sorted(data.items(), key=lambda item: item[0] not in ("schema", "type")):
        annotation, words = _field(model, key)
        comment = f"  # {words}" if comments and words else ""
        head = f"{' ' * depth}{_text(key)}:"
        if isinstance(value, str) and len(value) > WIDTH and _FOLDS.fullmatch(value):
            yield f"{head} >-{comment}"
            yield from (f"{' ' * (depth + 2)}{line}" for line in _FOLD.wrap(value))
        elif isinstance(value, dict) and value:
            yield head + comment
            yield from _mapping(value, _model_for(annotation, value), depth + 2, comments)
        elif isinstance(value, list) and any(isinstance(entry, dict) for entry in value):
            yield head + comment
            yield from _list(value, annotation, depth + 2, comments)
        else:
            yield f"{head} {_flow(value)}{comment}"


def _list(values: list[Any], annotation: Any, depth: int, comments: bool) -> Iterator[str]:
    """Mappings under one another, each with its first key beside the dash; comments at the first alone."""
    for place, entry in enumerate(values):
        lines = list(_mapping(entry, _model_for(annotation, entry), depth + 2, comments and place == 0))
        yield f"{' ' * depth}- {lines[0].lstrip()}"
        yield from lines[1:]


def _flow(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_flow, value))}]"
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, float):
        number = repr(value)
        return number if "." in number or "e" not in number else number.replace("e", ".0e")
    return json.dumps(value)


def _text(value: str) -> str:
    """A text that every reader of YAML takes for a text."""
    if _PLAIN.fullmatch(value) and value.lower() not in _WORDS:
        return value
    return yaml.safe_dump(value, default_style='"', width=10**9).rstrip("\n")


def _field(model: Any, key: str) -> tuple[Any, str]:
    """The annotation of a key, and what it is with its unit."""
    if model is None or key not in keys_of(model):
        return None, ""
    field = next(f for name, f in model.model_fields.items() if (f.alias or name) == key)
    unit = next(iter(_units(field.annotation, field.metadata)), "")
    choices = [str(choice) for choice in _choices(field.annotation)]
    told = f"{field.description or ''}{f' [{unit}]' if unit else ''}"
    if type(None) in get_args(field.annotation) and field.default is None and len(_parts(field.annotation)) == 1:
        choices = keys_of(_parts(field.annotation)[0])
    return field.annotation, f"{told}: {', '.join(choices)}" if len(choices) > 1 else told


def _units(annotation: Any, metadata: Any = ()) -> Iterator[str]:
    """The SI units of the quantities in an annotation."""
    for entry in (*metadata, *getattr(annotation, "__metadata__", ())):
        if isinstance(entry, Quantity):
            yield entry.dimension.unit
    for argument in get_args(annotation):
        yield from () if _is_part(argument) else _units(argument)


def _choices(annotation: Any) -> list[Any]:
    arguments = get_args(annotation)
    if arguments and all(isinstance(a, str | int) for a in arguments):
        return list(arguments)
    return [choice for a in arguments if not _is_part(a) for choice in _choices(a)]


def _is_part(annotation: Any) -> bool:
    return isinstance(annotation, type) and issubclass(annotation, BaseModel)


def _parts(annotation: Any) -> list[Any]:
    if _is_part(annotation):
        return [annotation]
    return [part for argument in get_args(annotation) for part in _parts(argument)]


def _model_for(annotation: Any, value: dict[str, Any]) -> Any:
    """Which of the models of an annotation a mapping is."""
    parts = _parts(annotation)
    if len(parts) < 2:
        return parts[0] if parts else None
    return next((part for part in parts if part.model_fields["type"].default == value.get("type")), None)


def template(kind: str) -> str:
    """A commented scenario of a kind, as YAML that runs as it is.

    Args:
        kind: A type of scenario.

    Raises:
        InvalidScenario: If there is no such kind.

    Example:
        >>> print(template("arm-pose")[:17])
        # Forward kinemat
    """
    from coplanar.scenarios.reading import from_data

    given = {"schema": 1, "type": kind, "name": f"my-{kind}", "title": "My scenario"}
    model = type(from_data({"type": kind, **getattr(KINDS.get(kind), "example", {})}, source="kind"))
    scenario = from_data({**given, **model.example}, source="kind")
    head = f"# {model.model_fields['type'].description}.\n# Every key is shown; those with null may be left out.\n"
    return head + yaml_of(scenario.data(defaults=True), model, comments=True)


def schema() -> dict[str, Any]:
    """The JSON Schema of scenario files, for editors and other programs.

    Example:
        >>> schema()["title"], len(schema()["oneOf"]) == len(KINDS)
        ('Coplanar scenario', True)
    """
    inner = TypeAdapter(tuple[tuple(KINDS.values())]).json_schema(by_alias=True, ref_template="#/$defs/{model}")  # type: ignore[misc,arg-type]
    definitions: dict[str, Any] = inner["$defs"]
    for part in definitions.values():
        _finish(part)
    for model in KINDS.values():
        part = definitions[model.__name__]
        part["required"] = ["type", *(key for key in part.get("required", []) if key != "type")]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Coplanar scenario",
        "description": "A robot of the plane and what it does; plain numbers are SI units and radians",
        "type": "object",
        "oneOf": [{"$ref": f"#/$defs/{model.__name__}"} for model in KINDS.values()],
        "discriminator": {"propertyName": "type"},
        "$defs": dict(sorted(definitions.items())),
    }


def _finish(part: dict[str, Any]) -> None:
    """Units into the descriptions; no titles that only repeat the keys."""
    part.pop("title", None)
    for field in part.get("properties", {}).values():
        field.pop("title", None)
        unit = next(iter(_found(field, "x-unit")), "")
        if unit:
            field["description"] = f"{field.get('description', '')} [{unit}]"


def _found(node: Any, key: str) -> Iterator[str]:
    """Every value under a key, at any depth."""
    if isinstance(node, dict):
        if node.get(key):
            yield node[key]
        for inner in node.values():
            yield from _found(inner, key)
    elif isinstance(node, list):
        for inner in node:
            yield from _found(inner, key)
