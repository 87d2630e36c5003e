"""From a file, a name or a text to a scenario."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from coplanar.scenarios import catalog
from coplanar.scenarios.kinds import KINDS
from coplanar.scenarios.problems import InvalidScenario, Problem, did_you_mean, shown
from coplanar.scenarios.scenario import Scenario
from coplanar.scenarios.texts import LARGEST_TEXT, Place, parsed, refuse
from coplanar.scenarios.validation import line_of, validated

SUFFIXES = {".yaml": "yaml", ".yml": "yaml", ".toml": "toml", ".json": "json"}


def load(name_or_path: str | Path) -> Scenario:
    """A scenario from a file, or from the catalog by its name.

    Args:
        name_or_path: A path that ends in .yaml, .yml, .toml or .json; or a name, whose last part is enough where it
            is the only one ("lemniscate").

    Raises:
        InvalidScenario: With everything that is wrong, each with its line, key and what was needed.

    Example:
        >>> load("lemniscate").name
        'trace-lemniscate'
    """
    path = Path(name_or_path)
    if isinstance(name_or_path, str) and path.suffix.lower() not in SUFFIXES and len(path.parts) == 1:
        return parse(catalog.text(name_or_path), source=catalog.found(name_or_path), name=catalog.found(name_or_path))
    return parse(*_file(path), source=str(name_or_path), name=path.stem)


def parse(text: str, form: str = "yaml", *, source: str = "text", name: str = "") -> Scenario:
    """A scenario from a text.

    Args:
        text: The text.
        form: "yaml", "toml" or "json".
        source: What to call it in errors.
        name: The scenario's name where it gives none.

    Raises:
        InvalidScenario: With everything that is wrong.

    Example:
        >>> parse("{type: arm-reach, arm: {links: [1, 1]}, target: [1, 30 cm]}").target
        (1.0, 0.3)
    """
    data, lines = parsed(text, form, source)
    return from_data(data, lines=lines, source=source, name=name)


def from_data(
    data: Any, *, lines: Mapping[Place, int] | None = None, source: str = "scenario", name: str = ""
) -> Scenario:
    """A scenario from plain data: mappings, lists, texts, numbers.

    Args:
        data: As a file would hold it.
        lines: The line of each key by its path.
        source: What to call it in errors.
        name: The scenario's name where the data give none.

    Raises:
        InvalidScenario: With everything that is wrong.
    """
    lines = lines or {}
    if not isinstance(data, Mapping):
        refuse(source, "", shown(data), "a mapping of keys that begins with type")
    kind = data.get("type")
    if not isinstance(kind, str) or kind not in KINDS:
        given = shown(kind) if "type" in data else "nothing"
        problem = Problem(
            "type", given, f"one of {', '.join(KINDS)}", did_you_mean(kind, KINDS), line_of(("type",), lines)
        )
        raise InvalidScenario([problem], source)
    named = {"name": _name_from(name or kind), **data}
    scenario: Scenario = validated(KINDS[kind], named, lines, source)
    return scenario


def _name_from(text: str) -> str:
    """A scenario's name out of a file's."""
    return re.sub(r"[^a-z0-9._-]+", "-", text.lower()).strip("._-")[:64] or "scenario"


def _file(path: Path) -> tuple[str, str]:
    """The text of a file and its form."""
    form = SUFFIXES.get(path.suffix.lower())
    if form is None:
        refuse(str(path), "", path.suffix or "no suffix", f"a file that ends in {', '.join(SUFFIXES)}")
    try:
        if not path.is_file():
            refuse(str(path), "", "no file" if not path.exists() else "something that is no file", "a file")
        with path.open("rb") as file:
            content = file.read(4 * LARGEST_TEXT + 1)
        return content.decode("utf-8-sig"), form
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        refuse(str(path), "", f"byte 0x{content[error.start]:02x}", "text in UTF-8", line)
    except (OSError, ValueError) as error:
        refuse(str(path), "", getattr(error, "strerror", None) or str(error), "a file that can be read")
