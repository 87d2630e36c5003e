"""Progress on a terminal, silence in a pipe."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from coplanar.cli.console import console

Step = Callable[[str, float, float | None], None]


@contextmanager
def progress(unit: str = "") -> Iterator[Step]:
    """A bar on stderr for as long as the block runs; the step is told (what, done, of how much, or None).

    Args:
        unit: Of what is counted; empty for steps.
    """
    errors = console(stderr=True)
    if not errors.is_terminal:
        yield lambda _what, _done, _total: None
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (
        TextColumn("{task.description:18}"), BarColumn(), TextColumn("{task.completed:,.0f} " + unit),
        TimeElapsedColumn(),
    )  # fmt: skip
    with Progress(*columns, console=errors, transient=True) as bar:
        task = bar.add_task("", total=None)
        yield lambda what, done, total: bar.update(task, description=what, completed=done, total=total)
