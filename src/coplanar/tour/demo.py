"""What a demonstration is: numbers, a check on them, a picture, a moving picture."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from coplanar.viz.scene import Scene

Table = Mapping[str, Sequence[Any] | Any]  # column name to values: numbers, or words


@dataclass(frozen=True, slots=True, kw_only=True)
class Demo:
    """The result of one system on its demonstration.

    Attributes:
        name: The folder that holds its files.
        title: Which system of planar robotics it shows.
        headline: The number one remembers, with its unit.
        check: What was compared with what, and how closely they agree.
        passed: Whether the check held.
        story: Two or three sentences for the page.
        tables: File name to table; ``run.csv`` is the first.
        figure: Draws on the given Matplotlib figure.
        scene: The animation, where there is something that moves.
    """

    name: str
    title: str
    headline: str
    check: str
    passed: bool
    story: str
    tables: Mapping[str, Table]
    figure: Callable[[Any], None]
    scene: Scene | None = None
