"""What can go wrong, as one family.

A legitimate "no" (out of reach, out of range, budget spent) is a result, not an exception.
Only misuse raises, and every message says what was given, what was needed, what to do.

    CoplanarError
    ├── InvalidInput (also a ValueError)
    │   ├── InvalidShape       wrong number of axes, wrong length, shapes that do not broadcast
    │   ├── InvalidValue       not finite, not positive, not monotone, out of its interval
    │   └── UnknownName        a name that is not in the list
    ├── NoSolution             raised by ``.or_raise()`` of a result that says no; keeps the result
    └── MissingExtra (also an ImportError)   an optional dependency is not installed
"""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable
from typing import Any


class CoplanarError(Exception):
    """Root of every error that Coplanar raises on purpose; it travels between processes with all it holds."""

    def __reduce__(self) -> tuple[Callable[..., CoplanarError], tuple[Any, ...]]:
        return _restored, (type(self), self.args, self.__dict__)


class InvalidInput(CoplanarError, ValueError):
    """An argument that cannot be used: what was given, what was needed, what to do.

    Attributes:
        name: The argument.
        given: What was passed.
        needed: What would have been accepted.
    """

    def __init__(self, name: str, given: object, needed: str, remedy: str = "") -> None:
        self.name, self.given, self.needed, self.remedy = name, given, needed, remedy
        text = f"{self._what_was_given()}: needed {needed}"
        super().__init__(f"{text}; {remedy}" if remedy else text)

    def _what_was_given(self) -> str:
        return f"{self.name} = {_short(self.given)}"


class InvalidShape(InvalidInput):
    """An array of the wrong shape; ``given`` is the shape in words."""

    def _what_was_given(self) -> str:
        return f"{self.name} with {self.given}"


class InvalidValue(InvalidInput):
    """A number outside what the law allows."""


class UnknownName(InvalidInput):
    """A name that is not one of those known, with the nearest one suggested."""

    def __init__(self, name: str, given: object, known: Iterable[str]) -> None:
        known = sorted(known)
        near = difflib.get_close_matches(str(given), known, n=1)
        super().__init__(name, given, "one of " + ", ".join(known), f"did you mean {near[0]!r}?" if near else "")


class NoSolution(CoplanarError):
    """A result that says no, raised because the caller asked for it by ``.or_raise()``.

    Attributes:
        result: The result with its status, nearest answer and residuals.
    """

    def __init__(self, message: str, result: object) -> None:
        self.result = result
        super().__init__(message)


class MissingExtra(CoplanarError, ImportError):
    """An optional dependency is absent; the message holds the command that installs it.

    Attributes:
        package: What is missing.
        extra: The extra that brings it; empty where none does.
    """

    def __init__(self, package: str, extra: str = "") -> None:
        self.package, self.extra = package, extra
        wanted = f"'coplanar[{extra}]'" if extra else package
        super().__init__(f"{package} is not installed: run  pip install {wanted}")


def _short(value: object) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= 80 else text[:77] + "..."


def _restored(kind: type[CoplanarError], args: tuple[Any, ...], state: dict[str, Any]) -> CoplanarError:
    error = kind.__new__(kind, *args)
    error.__dict__.update(state)
    return error
