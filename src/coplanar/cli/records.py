"""What runs leave behind: films of them, and files for other programs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from coplanar.cli.answers import Answer, Fact, give
from coplanar.cli.arguments import Json
from coplanar.cli.progress import progress
from coplanar.errors import InvalidValue

if TYPE_CHECKING:
    from coplanar.run import Run

Which = Annotated[
    str, typer.Argument(metavar="RUN", help="The folder of a run, a log, a scenario's file, or a name from the list.")
]


def animate(
    run: Which,
    output: Annotated[str, typer.Option("--output", "-o", metavar="FILE", help="Ends in .gif, .mp4 or .html.")],
    fps: Annotated[float, typer.Option(help="Frames a second.")] = 25.0,
    size: Annotated[str, typer.Option(metavar="WxH", help="In pixels.")] = "640x480",
    speed: Annotated[float, typer.Option(help="Times as fast as it happened.")] = 1.0,
    theme: Annotated[str | None, typer.Option(help="light or dark.")] = None,
    as_json: Json = False,
) -> None:
    """Make a film of a run.

    A GIF, an MP4 (extra "video"), or one HTML file with a player, by the suffix.
    """
    from coplanar.viz import animate as film

    width, _, height = size.partition("x")
    if not (width.isascii() and width.isdigit() and height.isascii() and height.isdigit()):
        raise InvalidValue("--size", size, "WxH in pixels", "as in  --size 640x480")
    shown, title = _moving(run)
    with progress("frames") as step:
        path = film(
            shown, output, fps=fps, size=(int(width), int(height)), theme=theme, speed=speed, title=title,
            progress=lambda done, total: step(Path(output).name, done, total),
        )  # fmt: skip
    give(Answer(f"{path} is written", (Fact("file", str(path)), Fact("bytes", path.stat().st_size))), as_json)


def export(
    run: Which,
    to: Annotated[
        str | None, typer.Option("--to", metavar="FORMAT", help="csv, json, wpilog, mcap or parquet.")
    ] = None,
    output: Annotated[
        str | None, typer.Option("--output", "-o", metavar="FILE", help="Beside the run, named after it, unless given.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Write a run for other programs.

    As CSV, JSON, WPILOG, MCAP or Parquet (extra "logs").
    """
    from coplanar.logs import write_log

    if to is None and output is None:
        raise InvalidValue("--to", None, "csv, json, wpilog, mcap or parquet", "or a file by -o")
    table, beside = _table(run)
    target = Path(output) if output is not None else beside.with_suffix(f".{to}")
    path = write_log(table, target, to)
    facts = (Fact("file", str(path)), Fact("rows", len(table)), Fact("columns", list(table.columns)))
    give(Answer(f"{path} is written", facts), as_json)


def _moving(given: str) -> tuple[Any, str]:
    """The scene or run behind a name, and what to call it."""
    from coplanar.scenarios import load
    from coplanar.store import read_record
    from coplanar.viz.outcomes import scene_of

    path = Path(given)
    if _is_log(path):
        return _log(path), path.stem
    scenario = read_record(path).scenario if path.is_dir() else load(given)
    outcome = scenario.run()
    scene = scene_of(outcome)
    if scene is None:
        raise InvalidValue("RUN", given, "something that moves in time", f"{scenario.name}: {outcome.status}")
    return scene, scenario.title or scenario.name


def _table(given: str) -> tuple[Run, Path]:
    """The run behind a name, and where a file about it belongs, without a suffix."""
    from coplanar.scenarios import load
    from coplanar.store import read_record

    path = Path(given)
    if _is_log(path):
        return _log(path), path
    if path.is_dir():
        record = read_record(path)
        run, name, beside = record.run, record.scenario.name, path / record.scenario.name
    else:
        outcome = load(given).run()
        run, name, beside = outcome.run, outcome.name, Path(outcome.name)
    if run is None:
        raise InvalidValue("RUN", given, "something that moves in time", f"{name} has tables, but no run over time")
    return run, beside.with_name(f"{beside.name}.run")


def _is_log(path: Path) -> bool:
    """Whether it is a file that ``read_log`` takes; .json is a log unless it says that it is a scenario."""
    from coplanar.logs import FORMATS

    if not path.is_file() or path.suffix.lstrip(".").lower() not in FORMATS:
        return False
    return path.suffix.lower() != ".json" or b'"columns"' in path.read_bytes()[:4096]


def _log(path: Path) -> Run:
    from coplanar.logs import read_log

    return read_log(path)
