"""Answers that take longer than a frame, kept for the next time the same is asked."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

Value = TypeVar("Value")


class Kept(Generic[Value]):
    """A function of hashable arguments whose newest answers are kept.

    What is kept is the function's own answer, so that answers do not depend on who asked before.

    Example:
        >>> squares = Kept(lambda x: x * x, most=2)
        >>> squares.known(3), squares(3), squares.known(3)
        (None, 9, 9)
    """

    def __init__(self, function: Callable[..., Value], *, most: int) -> None:
        self._function, self._most = function, most
        self._answers: OrderedDict[tuple[Hashable, ...], Value] = OrderedDict()
        self._lock = threading.Lock()

    def known(self, *key: Hashable) -> Value | None:
        """The answer if it is there already."""
        with self._lock:
            return self._answers.get(key)

    def __call__(self, *key: Hashable) -> Value:
        """The answer, worked out where it is not there yet."""
        found = self.known(*key)
        if found is None:
            found = self._function(*key)
        with self._lock:
            self._answers[key] = found
            self._answers.move_to_end(key)
            while len(self._answers) > self._most:
                self._answers.popitem(last=False)
        return found

    def within(self, live: bool, *key: Hashable) -> Value | None:
        """The answer; while something is dragged only if it is there already."""
        return self.known(*key) if live else self(*key)
