"""Run the demonstrations and write their folder: whole, or not at all."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from coplanar.errors import InvalidValue
from coplanar.run.files import write_table
from coplanar.scenarios import Outcome, Scenario, load, names
from coplanar.tour.page import page
from coplanar.viz.outcomes import figure_of
from coplanar.viz.style import THEMES, drawn_in


def run_tour(
    folder: str | Path,
    *,
    scenarios: Sequence[Scenario] | None = None,
    progress: Callable[[str, int, int], None] | None = None,
) -> list[Outcome]:
    """Run every demonstration of the catalog and write tables, figures and ``index.html``.

    Args:
        folder: Where to write; made if absent. Files of an earlier tour are replaced once all is done.
        scenarios: What to run; the catalog unless given.
        progress: Called with the name of what comes next, how many are done and how many there are.

    Returns:
        The outcomes, in order.

    Raises:
        InvalidValue: If the folder cannot be made or is a file.
    """
    wanted = [load(name) for name in names()] if scenarios is None else list(scenarios)
    target = Path(folder)
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InvalidValue("folder", str(folder), f"a folder that can be written ({error.strerror})") from None
    with tempfile.TemporaryDirectory(dir=target, prefix=".tour-") as scratch:
        demos = []
        for done, scenario in enumerate(wanted):
            if progress:
                progress(scenario.name, done, len(wanted))
            demo = scenario.run()
            _write(demo, Path(scratch) / demo.name)
            demos.append(demo)
        (Path(scratch) / "index.html").write_text(page(demos), "utf-8")
        if progress:
            progress("", len(wanted), len(wanted))
        for item in Path(scratch).iterdir():
            _replace(item, target / item.name)
    return demos


def _write(demo: Outcome, folder: Path) -> None:
    folder.mkdir()
    for name, table in demo.tables.items():
        write_table(folder / name, table)
    for theme in THEMES:
        _draw(demo, theme, folder / f"figure-{theme}.svg")


def _draw(demo: Outcome, theme: str, path: Path) -> None:
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure

    with drawn_in(theme):
        figure = Figure(figsize=(7.2, 4.6))
        FigureCanvasSVG(figure)
        figure_of(demo, figure)
        figure.savefig(path, metadata={"Date": None})


def _replace(source: Path, target: Path) -> None:
    if target.is_dir():
        shutil.rmtree(target)
    source.replace(target)
