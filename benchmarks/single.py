"""Single calls: after a warm-up, and as they come."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from benchmarks.measure import Contender
from coplanar import warm_up
from coplanar.engine import reproducible

CALLS = 100  # within one block without compiled calls, so that the block does not count


def warmed(builder: Callable[[Any], Contender]) -> Callable[[Any], Contender]:
    """The contender after its call was made once in a warm-up."""

    def build(data: Any) -> Contender:
        contender = builder(data)
        with warm_up():
            contender.call()
        return replace(contender, name=f"{contender.name}, warmed up")

    return build


def as_they_come(builder: Callable[[Any], Contender]) -> Callable[[Any], Contender]:
    """The contender by Python's ``math``, as where nothing was warmed up."""

    def build(data: Any) -> Contender:
        contender = builder(data)

        def calls() -> Any:
            with reproducible():
                for _ in range(CALLS - 1):
                    contender.call()
                return contender.call()

        return replace(contender, name=f"{contender.name}, not warmed up", call=calls, rows=CALLS)

    return build
