"""What is wrong with a scenario: everything at once, each with its key, what was given and what was needed."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from coplanar.errors import InvalidInput

MOST_TOLD = 25  # problems that the text of the error lists; all of them are in ``problems``
SHORT = 60  # characters of what was given


@dataclass(frozen=True, slots=True)
class Problem:
    """One thing that is wrong.

    Attributes:
        key: Where: "controller.kp", "segments.2.v"; empty for the whole.
        given: What stands there, in words.
        needed: What would have been accepted.
        remedy: What to do; empty where nothing more can be said.
        line: Of the file, counted from 1; None where that is not known.

    Example:
        >>> print(Problem("controller.kp", "-3", "a gain [1/s] above 0", line=7))
        line 7: controller.kp = -3: needed a gain [1/s] above 0
    """

    key: str
    given: str
    needed: str
    remedy: str = ""
    line: int | None = None

    def __post_init__(self) -> None:
        for name in ("key", "given", "needed", "remedy"):
            object.__setattr__(self, name, printable(getattr(self, name)))

    def __str__(self) -> str:
        """The problem in one line."""
        what = f"{self.key} = {self.given}" if self.key and self.given else self.key or self.given
        told = ": ".join(part for part in (what, f"needed {self.needed}") if part)
        where = f"line {self.line}: " if self.line else ""
        return where + (f"{told}; {self.remedy}" if self.remedy else told)


class InvalidScenario(InvalidInput):
    """A scenario that cannot be used; its text holds one line a problem.

    Attributes:
        problems: All of them.
        source: The file, or what the scenario came from.
    """

    def __init__(self, problems: Sequence[Problem], source: str = "") -> None:
        self.problems, self.source = tuple(problems), source
        first = self.problems[0]
        super().__init__(first.key or source or "scenario", first.given, first.needed, first.remedy)
        place = f"{printable(source)}: " if source else ""
        told = [f"{place}{problem}" for problem in self.problems[:MOST_TOLD]]
        more = len(self.problems) - MOST_TOLD
        self.args = ("\n".join([*told, f"and {more} problems more"] if more > 0 else told),)


def did_you_mean(given: object, known: Iterable[str]) -> str:
    """The nearest known name as a question; empty where none is near.

    Example:
        >>> did_you_mean("leminscate", ["circle", "lemniscate"])
        "did you mean 'lemniscate'?"
    """
    near = difflib.get_close_matches(given[:SHORT], list(known), n=1) if isinstance(given, str) else []
    return f"did you mean {near[0]!r}?" if near else ""


def shown(value: object) -> str:
    """A value in a few printable characters."""
    if isinstance(value, int) and value.bit_length() > 4 * SHORT:
        return "a whole number of hundreds of digits"
    text = repr(value) if not isinstance(value, dict | list | tuple) else _outline(value)
    return printable(text) if len(text) <= SHORT else printable(text[: SHORT - 3]) + "..."


def printable(text: str) -> str:
    r"""A text without what a terminal would take for a command; half characters cannot even be written.

    Example:
        >>> printable("a\x1b[31mb")
        'a?[31mb'
    """
    return text if text.isprintable() else "".join(c if c.isprintable() else "?" for c in text)


def key_text(parts: Iterable[object]) -> str:
    """A path of keys and places as one printable text."""
    return ".".join(printable(str(part)[: 2 * SHORT]) for part in parts)


def _outline(value: dict[object, object] | list[object] | tuple[object, ...]) -> str:
    """A container without what is deep inside it."""
    if isinstance(value, dict):
        return "keys " + ", ".join(key_text([key]) for key in list(value)[:6]) if value else "an empty mapping"
    simple = len(value) <= 8 and all(isinstance(item, int | float | str) for item in value)
    return f"[{', '.join(map(shown, value))}]" if simple else f"a list of {len(value)}"
