"""Scenarios: what there is, a new one, whether one is right, run it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from coplanar.cli.answers import Answer, Fact, give
from coplanar.cli.arguments import Json
from coplanar.cli.conduct import NO
from coplanar.cli.console import console
from coplanar.cli.progress import progress
from coplanar.errors import InvalidValue

if TYPE_CHECKING:
    from coplanar.scenarios import Outcome, Scenario

Which = Annotated[str, typer.Argument(metavar="SCENARIO", help="A file, or a name that  coplanar list  shows.")]
Several = Annotated[list[str], typer.Argument(metavar="SCENARIO", help="Files, or names from  coplanar list.")]
Set = Annotated[list[str] | None, typer.Option("--set", metavar="KEY=VALUE", help="Another value: controller.kp=20.")]
Output = Annotated[str | None, typer.Option("--output", "-o", metavar="FILE", help="Write there; stdout unless given.")]


def loaded(name: str, changes: list[str] | None) -> Scenario:
    """A scenario with other values under some keys."""
    from coplanar.scenarios import load, read_value

    pairs = [change.partition("=") for change in changes or ()]
    for key, sign, value in pairs:
        if not (key and sign):
            raise InvalidValue("--set", f"{key}{sign}{value}", "KEY=VALUE", "as in  --set controller.kp=20")
    found = load(name)
    return found.replaced({key.strip(): read_value(value) for key, _, value in pairs}) if pairs else found


def list_(as_json: Json = False) -> None:
    """List the scenarios that come with the library.

    And the kinds of which  coplanar new  writes one.
    """
    from coplanar.scenarios import KINDS, load, names

    scenarios = [load(name) for name in names()]
    rows = [{"name": s.name, "type": s.type, "title": s.title} for s in scenarios]
    give(Answer(f"{len(rows)} scenarios", (Fact("scenarios", rows), Fact("kinds", list(KINDS)))), as_json)


def new(
    kind: Annotated[str, typer.Argument(metavar="KIND", help="One of the kinds that  coplanar list  shows.")],
    output: Output = None,
) -> None:
    """Write a commented scenario that runs as it is.

    Example: coplanar new track > mine.yaml
    """
    from coplanar.scenarios import template

    _write(template(kind), output)


def schema(output: Output = None) -> None:
    """Write the JSON Schema of scenario files.

    Editors that know it complete and check what is typed.
    """
    import json

    from coplanar import scenarios

    _write(json.dumps(scenarios.schema(), indent=2, ensure_ascii=False) + "\n", output)


def check(scenario: Which, changes: Set = None, as_json: Json = False) -> None:
    """Check a scenario before anything runs.

    The file, the wheels, the gains, the reach; the exit code is 1 if it would not do.
    """
    found = loaded(scenario, changes)
    findings = found.preflight()
    no = [f.sentence for f in findings if f.tone == "no"]
    status = no[0] if no else f"{found.name} can run"
    rows = [{"tone": f.tone, "finding": f.sentence} for f in findings]
    give(Answer(status, (Fact("type", found.type), *([Fact("findings", rows)] if rows else [])), ok=not no), as_json)


def run(
    scenario: Several,
    changes: Set = None,
    output: Annotated[
        str | None, typer.Option("--output", "-o", metavar="DIR", help="Folder of the run; runs/NAME unless given.")
    ] = None,
    figures: Annotated[bool, typer.Option("--figures/--no-figures", help="Draw the figures.")] = True,
    resume: Annotated[bool, typer.Option("--resume", help="Leave out what has been run already.")] = False,
    as_json: Json = False,
) -> None:
    """Run scenarios, each into a folder of its own.

    It holds the scenario as it was run, tables, figures and a summary, and appears whole or not at all.
    """
    found = [loaded(name, changes) for name in scenario]
    folders = _folders(found, output)
    with progress() as step:
        answers = [
            _run(one, folder, figures, resume, lambda part, name=one.name: step(name, part, 1.0))
            for one, folder in zip(found, folders, strict=True)
        ]
    if as_json:
        _give_all(answers)
    for answer in () if as_json else answers:
        give(answer, False, exits=False)
    if not all(answer.ok for answer in answers):
        raise typer.Exit(NO)


def _folders(found: list[Scenario], output: str | None) -> list[Path]:
    if len({s.name for s in found}) < len(found):
        raise InvalidValue("SCENARIO", [s.name for s in found], "scenarios of different names")
    if output is None:
        return [Path("runs") / one.name for one in found]
    return [Path(output)] if len(found) == 1 else [Path(output) / one.name for one in found]


def _run(one: Scenario, folder: Path, figures: bool, resume: bool, told: Any) -> Answer:
    from coplanar.store import is_record, read_record, write_record

    if resume and is_record(folder):
        record = read_record(folder)
        if record.scenario.data(defaults=True) == one.data(defaults=True):
            return _answer(record.summary, folder)
    outcome: Outcome = one.run(told)
    write_record(outcome, folder, themes=("light", "dark") if figures else ())
    return _answer(read_record(folder).summary, folder)


def _answer(summary: Any, folder: Path) -> Answer:
    """What a summary says, and where it is."""
    facts = [Fact(name.replace("_", " "), value) for name, value in summary["summary"].items()]
    said = (Fact("name", summary["name"]), Fact("headline", summary["headline"]), Fact("check", summary["check"]))
    ok = summary["ok"] and summary["passed"]
    return Answer(summary["status"], (*said, *facts, Fact("folder", str(folder))), ok=ok, warnings=summary["warnings"])


def _give_all(answers: list[Answer]) -> None:
    import json

    documents = [answer.document() for answer in answers]
    whole: Any = documents[0] if len(documents) == 1 else documents
    typer.echo(json.dumps(whole, allow_nan=False, ensure_ascii=False, indent=2))


def _write(text: str, output: str | None) -> None:
    """To a file, whole or not at all, or to stdout."""
    if output is None:
        typer.echo(text, nl=False)
        return
    from coplanar.run.files import written_whole

    with written_whole(Path(output)) as part:
        part.write_text(text, encoding="utf-8")
    console(stderr=True).print(output)
