"""What a tab is: controls, what they show, what a drag does to them, and how to do it again elsewhere."""

from __future__ import annotations

from typing import Any, ClassVar, Protocol

from coplanar.play.answer import Answer
from coplanar.play.controls import AnyControl, State


class Tab(Protocol):
    """One tab; it keeps nothing from request to request."""

    name: ClassVar[str]
    title: ClassVar[str]
    about: ClassVar[str]
    controls: ClassVar[tuple[AnyControl, ...]]

    def settled(self, state: State, changed: str) -> State:
        """The state after what follows from the key that was changed by hand (empty: none of them)."""
        ...

    def moved(self, state: State, handle: str, to: list[float]) -> State:
        """The state after a handle was dragged to a point."""
        ...

    def show(self, state: State, *, live: bool) -> Answer:
        """What the state looks like; ``live`` bounds the time."""
        ...

    def python(self, state: State) -> str:
        """A program that prints the same numbers."""
        ...

    def scenario(self, state: State) -> dict[str, Any]:
        """The same as a scenario file holds it."""
        ...
