"""When a law is compiled: for batches that are worth the wait, for what is compiled already, and where it is asked for.

Evaluators differ in the last digit, so the block ``reproducible`` makes the choice hang on the number of rows alone.
"""

from __future__ import annotations

import functools
import importlib
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

FIRST_COMPILED_ROWS = 20_000  # below this a batch never waits for the compiler
COMPILED_ROWS = 100  # from here the compiled loop wins, once it is there,
LONG = 10  # and from one row for a law of as many operations

BY_ROWS_ALONE, AT_ONCE = "by rows alone", "at once"
mode: ContextVar[str] = ContextVar("mode", default="")  # of this block of code: one of these, or ""


@contextmanager
def reproducible() -> Iterator[None]:
    """In this block the number of rows alone decides who evaluates, not what was compiled before.

    Evaluators differ in the last digit; here the same call gives the same digits, whatever ran before it.
    """
    with _in_mode(BY_ROWS_ALONE):
        yield


@contextmanager
def warm_up() -> Iterator[None]:
    """In this block every call waits for the compiler, so that the same calls are fast from then on.

    Without it only large batches are compiled, and single calls go by Python's ``math``. A control loop, a game or a
    simulator makes each of its calls once within the block before it starts. The first time on a machine a call
    may take some seconds, later a fraction of one: compiled code is kept on the disk. Where Numba does not run the
    block changes nothing. Compiled and other answers may differ in the last digit.

    Example:
        >>> from coplanar import Pose, Segment, warm_up
        >>> segment = Segment(1.0, 0.0, duration=2.0)
        >>> with warm_up():
        ...     end = segment.end(Pose())
        >>> segment.end(Pose()) == end
        True
    """
    with _in_mode(AT_ONCE):
        yield


@contextmanager
def _in_mode(name: str) -> Iterator[None]:
    token = mode.set(name)
    try:
        yield
    finally:
        mode.reset(token)


def warm(ready: bool) -> bool:
    """Whether a compiled loop, ready or not, may serve batches that would not be worth its compilation."""
    now = mode.get()
    return now == AT_ONCE or (ready and now != BY_ROWS_ALONE)


def pays(rows: int, ready: bool, *, least: int = 1, first: int = FIRST_COMPILED_ROWS) -> bool:
    """Whether so many rows go by a compiled loop.

    Args:
        rows: How many.
        ready: Whether the loop is compiled already.
        least: From how many rows a loop that is compiled wins.
        first: From how many rows compiling it is worth the wait.
    """
    return rows >= (least if warm(ready) else first) and can_compile()


@functools.cache
def can_compile() -> bool:
    """Whether Numba is installed here and imports; without it the NumPy text answers every batch."""
    try:
        importlib.import_module("numba")
    except ImportError:  # absent, or not made for the NumPy that is here
        return False
    return True
