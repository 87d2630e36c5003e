"""A value deep inside a scenario, by its key: "controller.kp", "arm.links.0"."""

from __future__ import annotations

from typing import Any


def at(part: Any, key: str) -> Any:
    """What stands under a key that exists.

    Example:
        >>> at({"links": (1.0, 0.5)}, "links.1")
        0.5
    """
    for step in key.split("."):
        part = _under(part, step)
    return part


def _under(part: Any, step: str) -> Any:
    if isinstance(part, tuple | list):
        return part[int(step)]
    return part[step] if isinstance(part, dict) else getattr(part, _name(part, step))


def _name(part: Any, step: str) -> str:
    """The field whose name in files is this."""
    for name, field in type(part).model_fields.items():
        if step in (field.alias, name):
            return str(name)
    return step
