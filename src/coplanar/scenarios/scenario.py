"""What every scenario has: a type, a name, a story; it runs, is measured, is looked at before it runs, is written."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fnmatch import fnmatchcase
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from pydantic import Field

from coplanar.errors import InvalidInput
from coplanar.scenarios.changes import changed
from coplanar.scenarios.outcome import Finding, Outcome, plain
from coplanar.scenarios.part import Part
from coplanar.scenarios.problems import InvalidScenario, Problem, shown
from coplanar.scenarios.validation import validated

Progress = Callable[[float], None]
Name = Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9._-]*$", max_length=64)]
Text = Annotated[str, Field(max_length=4000)]


class Scenario(Part):
    """A robot and what it does, as one record; each kind is a subclass.

    ``load`` makes one from a file or by its name in the catalog.
    """

    vectorised_keys: ClassVar[tuple[str, ...]] = ()  # patterns of the keys that ``measure`` takes as arrays
    example: ClassVar[dict[str, Any]] = {}  # the keys that a template shows, beside the common ones

    version: Literal[1] = Field(default=1, alias="schema", description="Version of this format")
    type: str = Field(description="Which kind of scenario this is")
    name: Name = Field(default="scenario", description="A short name, fit for a folder")
    title: Text = Field(default="", description="What it shows, in a line")
    description: Text = Field(default="", description="Two or three sentences about it")

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run it.

        Args:
            progress: Called with the part that is done, from 0 to 1.

        Raises:
            InvalidScenario: If the library finds something wrong that shows only on the way.
        """
        told = progress or (lambda _: None)
        told(0.0)
        try:
            with np.errstate(all="ignore"):
                outcome = self._outcome(told)
        except InvalidInput as error:
            problem = Problem(error.name, shown(error.given), error.needed, error.remedy)
            raise InvalidScenario([problem], self.name) from None
        told(1.0)
        return outcome

    def measure(self) -> dict[str, Any]:
        """The headline numbers: floats, or arrays where ``batched`` has put arrays into the fields."""
        with np.errstate(all="ignore"):
            return self._numbers(self.build())

    def preflight(self) -> list[Finding]:
        """What can be said before anything runs."""
        with np.errstate(all="ignore"):
            return list(self._findings(self.build()))

    def replaced(self, changes: Mapping[str, Any]) -> Self:
        """The scenario with other values: ``{"controller.kp": 20, "arm.links.0": "50 cm"}``.

        Raises:
            InvalidScenario: With all problems, unknown keys among them.
        """
        scenario: Self = validated(type(self), changed(self, changes), {}, self.name)
        return scenario

    def data(self, *, defaults: bool = False) -> dict[str, Any]:
        """Plain data that make the same scenario again.

        Args:
            defaults: Whether to fill in what was not given.
        """
        kept = self.model_dump(mode="json", by_alias=True, exclude_unset=not defaults)
        return {"schema": self.version, "type": self.type, **kept}

    def to_yaml(self, *, defaults: bool = False, comments: bool = False) -> str:
        """The scenario as YAML, which makes the same scenario again.

        Args:
            defaults: Whether to fill in what was not given.
            comments: Whether each key is followed by what it is and its unit.
        """
        from coplanar.scenarios.writing import yaml_of

        return yaml_of(self.data(defaults=defaults), type(self), comments=comments)

    def takes_arrays(self, key: str) -> bool:
        """Whether ``measure`` takes an array under a key, as ``controller.kp``."""
        return any(fnmatchcase(key, pattern) for pattern in self.vectorised_keys)

    @property
    def rows_at_once(self) -> int:
        """How many rows ``measured`` takes together, for the sake of memory."""
        return 20_000

    def _outcome(self, progress: Progress, /) -> Outcome:
        raise NotImplementedError

    def _numbers(self, things: Any) -> dict[str, Any]:
        raise NotImplementedError

    def _findings(self, things: Any) -> list[Finding]:  # noqa: ARG002
        return []

    def _told(self, built: Any, numbers: Mapping[str, Any], also: Mapping[str, Any], **words: Any) -> Outcome:
        """The outcome of what was built, its numbers, and what was found on the way."""
        return Outcome(scenario=self, things={**built._asdict(), **also}, summary=plain(numbers), **words)
