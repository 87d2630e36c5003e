"""From plain data to a model, or to every problem at once."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any, get_args

from pydantic import BaseModel, ValidationError

from coplanar.scenarios.problems import InvalidScenario, Problem, did_you_mean, key_text, shown
from coplanar.scenarios.texts import Place

_NEEDED = {
    "model_type": "a mapping of keys", "model_attributes_type": "a mapping of keys", "dict_type": "a mapping of keys",
    "tuple_type": "a list", "list_type": "a list", "string_type": "a text", "bool_type": "true or false",
    "bool_parsing": "true or false", "int_type": "a whole number", "int_parsing": "a whole number",
    "int_from_float": "a whole number", "int_parsing_size": "a whole number of a sane size",
    "string_unicode": "a text without half characters",
}  # fmt: skip
_BOUNDS = {
    "greater_than": ("gt", "above {}"), "greater_than_equal": ("ge", "{} or more"), "less_than": ("lt", "below {}"),
    "less_than_equal": ("le", "{} or less"), "too_short": ("min_length", "{} entries or more"),
    "too_long": ("max_length", "{} entries at most"), "string_too_long": ("max_length", "{} characters at most"),
    "string_pattern_mismatch": ("pattern", "a text of the form {}"),
}  # fmt: skip


def validated(model: type[BaseModel], data: Any, lines: Mapping[Place, int], source: str) -> Any:
    """The model of the data.

    Raises:
        InvalidScenario: With all problems, in the order of their lines.
    """
    try:
        return model.model_validate(data)
    except ValidationError as error:
        found = [_problem(model, entry, lines) for entry in error.errors(include_url=False)]
    raise InvalidScenario(sorted(found, key=lambda problem: problem.line or 0), source) from None


def line_of(place: Sequence[str | int], lines: Mapping[Place, int]) -> int | None:
    """The line of the innermost key on the way to a place whose line is known."""
    path = tuple(place)
    while path:
        if path in lines:
            return lines[path]
        path = path[:-1]
    return lines.get(())


def _problem(model: type[BaseModel], entry: Any, lines: Mapping[Place, int]) -> Problem:
    place, holder = _place(model, entry["loc"])
    said, kind = entry.get("ctx") or {}, str(entry["type"])
    given = said.get("given") if kind == "refused" else shown(entry["input"])
    needed, remedy = _NEEDED.get(kind, ""), str(said.get("remedy", ""))
    if kind == "extra_forbidden":
        known = keys_of(holder)
        needed, remedy = f"a key that is known here: {', '.join(known)}", did_you_mean(place[-1], known)
        return Problem(key_text(place), "", needed, remedy, line_of(place, lines))
    if kind == "missing":
        given, needed = "nothing", _description(holder, place[-1])
    elif kind in ("union_tag_invalid", "union_tag_not_found"):
        place, names = (*place, "type"), _names(said.get("expected_tags", "") or _tags(holder))
        given = shown(said.get("tag")) if "tag" in said else "nothing"
        needed, remedy = f"one of {', '.join(names)}", did_you_mean(said.get("tag", ""), names)
    elif kind == "literal_error":
        names = _names(said["expected"])
        needed, remedy = f"one of {', '.join(names)}", did_you_mean(entry["input"], names)
    elif kind in ("refused", "quantity"):
        needed, name = str(said["needed"]), str(said.get("name", "")).split(".")
        inner = tuple(int(part) if part.isdigit() else part for part in name)
        place = (*place, *inner) if name[0].split(",")[0] in keys_of(holder) else place
    elif kind in _BOUNDS:
        bound, form = _BOUNDS[kind]
        needed = form.format(said.get(bound))
    return Problem(key_text(place), str(given), needed or str(entry["msg"]), remedy, line_of(place, lines))


def _place(model: Any, loc: Sequence[str | int]) -> tuple[Place, Any]:
    """The keys of an error's location without the tags of unions, and the model or annotation that is there."""
    here: Any = model
    place: list[str | int] = []
    for step in loc:
        tagged = next((m for m in _models(here) if _tag(m) == step), None) if not _is_model(here) else None
        if tagged is not None:
            here = tagged
            continue
        place.append(step)
        field = (
            next((f for n, f in here.model_fields.items() if (f.alias or n) == step), None) if _is_model(here) else None
        )
        if field is not None:
            here = field.annotation
            models = _models(here)
            here = models[0] if len(models) == 1 and not _is_list(here) else here
        elif not _is_model(here):
            models = _models(here)
            here = models[0] if len(models) == 1 else here
    return tuple(place), here


def _is_model(annotation: Any) -> bool:
    return isinstance(annotation, type) and issubclass(annotation, BaseModel)


def _is_list(annotation: Any) -> bool:
    return getattr(annotation, "__origin__", None) in (tuple, list) or any(map(_is_list, get_args(annotation)))


def _models(annotation: Any) -> list[type[BaseModel]]:
    """Every model that an annotation names, at any depth of its arguments."""
    if _is_model(annotation):
        return [annotation]
    return [model for argument in get_args(annotation) for model in _models(argument)]


def _tag(model: type[BaseModel]) -> Any:
    field = model.model_fields.get("type")
    return get_args(field.annotation)[0] if field else None


def _tags(annotation: Any) -> str:
    return ", ".join(f"'{_tag(model)}'" for model in _models(annotation))


def keys_of(model: Any) -> list[str]:
    """The keys of a model as files write them."""
    return [field.alias or name for name, field in model.model_fields.items()] if _is_model(model) else []


def _description(holder: Any, key: Any) -> str:
    """What a key is, for one that is missing."""
    if not _is_model(holder):
        return "one more number" if isinstance(key, int) else "a value"
    field = next((f for n, f in holder.model_fields.items() if (f.alias or n) == key), None)
    return (field.description if field else "") or "a value"


def _names(expected: Any) -> list[str]:
    return re.findall(r"'([^']*)'", str(expected))
