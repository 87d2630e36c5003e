"""Many runs of a scenario."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from coplanar.cli.answers import Answer, Fact, give
from coplanar.cli.arguments import Json
from coplanar.cli.progress import progress
from coplanar.cli.scenarios import Set, Which, loaded
from coplanar.errors import InvalidValue


def sweep(
    scenario: Which,
    vary: Annotated[
        list[str] | None,
        typer.Option("--vary", metavar="KEY=VALUES", help="lo:hi:n, lo:hi:n:log or a,b,c; draws: lo:hi or mean+-sd."),
    ] = None,
    samples: Annotated[int | None, typer.Option(help="Draws for each combination of listed values.")] = None,
    seed: Annotated[int, typer.Option(help="Of the draws: the same seed gives the same table.")] = 0,
    jobs: Annotated[int | None, typer.Option("-j", "--jobs", help="Processes; as many as processors.")] = None,
    dask: Annotated[str | None, typer.Option(metavar="ADDRESS", help="A Dask scheduler: tcp://host:8786.")] = None,
    changes: Set = None,
    output: Annotated[
        str | None,
        typer.Option("--output", "-o", metavar="FILE", help=".csv or .parquet; NAME-sweep.csv unless given."),
    ] = None,
    plot: Annotated[str | None, typer.Option(metavar="MEASURE", help="Draw it beside the table.")] = None,
    as_json: Json = False,
) -> None:
    """Measure a scenario over a grid, or random draws.

    Of any of its keys, as many at once as there are processors, with the same table for the same seed.

    Any of its keys may vary. Interrupted, it keeps what is finished: the same command goes on from there.

    Example: coplanar sweep aim-speed --vary speed=20:60:30
    """
    from coplanar.sweeps import sweep as run_sweep

    found = loaded(scenario, changes)
    path = Path(output or f"{found.name}-sweep.csv")
    if jobs is not None and dask is not None:
        raise InvalidValue("--dask", dask, "either --dask or -j")
    with progress("tasks") as step:
        table = run_sweep(
            found, dict(map(_pair, vary or ())), samples=samples, seed=seed, executor=dask, jobs=jobs, path=path,
            progress=lambda done, total: step(found.name, done, total),
        )  # fmt: skip
    drawn = [] if plot is None else _draw(table, plot, path)
    statistics = [{"measure": name, **numbers} for name, numbers in table.statistics().items()]
    facts = [Fact("rows", len(table)), Fact("problems", table.problems), Fact("varied", list(table.varied))]
    facts += [Fact("statistics", statistics)] if statistics else []
    files = [str(path), *map(str, drawn)]
    give(Answer(f"{len(table)} runs of {found.name}", (*facts, Fact("files", files))), as_json)


def _pair(text: str) -> tuple[str, str]:
    key, sign, values = text.partition("=")
    if not (key.strip() and sign and values.strip()):
        raise InvalidValue("--vary", text, "KEY=VALUES", "as in  --vary controller.kp=10:100:10")
    return key.strip(), values.strip()


def _draw(table: Any, measure: str, path: Path) -> list[Path]:
    from matplotlib.figure import Figure

    from coplanar.run.files import written_whole
    from coplanar.viz import drawn_in

    drawn = []
    for theme in ("light", "dark"):
        with drawn_in(theme):
            canvas = Figure(figsize=(6.4, 4.4))
            table.plot(measure, canvas.subplots())
            target = path.with_name(f"{path.stem}-{measure}-{theme}.svg")
            with written_whole(target) as part:
                canvas.savefig(part, format="svg", metadata={"Date": None})
        drawn.append(target)
    return drawn
