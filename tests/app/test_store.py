"""Runs on disk: whole or not at all, and read back."""

from __future__ import annotations

import csv
import json

import numpy as np
import pytest

from coplanar.errors import InvalidInput, InvalidValue
from coplanar.scenarios import load, names
from coplanar.store import is_record, read_record, whole_folder, write_record


@pytest.fixture(scope="module")
def outcome():
    return load("track-astroid").replaced({"duration": 1}).run()


def test_a_record_holds_the_scenario_the_numbers_the_figures(outcome, tmp_path):
    folder = write_record(outcome, tmp_path / "a" / "run")
    assert sorted(p.name for p in folder.iterdir()) == [
        "figure-dark.svg", "figure-light.svg", "run.csv", "scenario.yaml", "summary.json"
    ]  # fmt: skip
    record = read_record(folder)
    assert record.scenario.data(defaults=True) == outcome.scenario.data(defaults=True)
    assert record.summary["summary"] == outcome.summary
    assert record.summary["headline"] == outcome.headline
    for name, values in outcome.run.columns.items():
        np.testing.assert_array_equal(record.run[name], values)
    assert (record.run.kind, record.run.status) == (outcome.run.kind, outcome.run.status)
    with (folder / "run.csv").open() as file:
        assert len(list(csv.reader(file))) == len(outcome.run) + 1
    assert "integrator" in (folder / "scenario.yaml").read_text()
    assert (folder / "figure-light.svg").read_text().startswith("<?xml")


@pytest.mark.parametrize("name", names())
def test_every_demonstration_is_written_and_read(name, tmp_path):
    outcome = load(name).run()
    record = read_record(write_record(outcome, tmp_path / name, themes=()))
    assert set(outcome.tables) <= {p.name for p in record.folder.iterdir()}
    assert (record.run is None) == (outcome.run is None)
    for column, values in {} if outcome.run is None else outcome.run.columns.items():
        np.testing.assert_array_equal(record.run[column], values)


def test_the_scenario_of_a_record_runs_to_the_same_numbers(outcome, tmp_path):
    folder = write_record(outcome, tmp_path / "run", themes=())
    assert load(folder / "scenario.yaml").run().summary == outcome.summary


def test_a_run_without_numbers_is_a_record_too(tmp_path):
    refused = load("track-astroid").replaced({"controller.kd": 0.9}).run()
    assert not refused.ok
    record = read_record(write_record(refused, tmp_path / "no"))
    assert record.run is None
    assert record.summary["ok"] is False


def test_a_new_run_replaces_an_old_one_and_nothing_else(outcome, tmp_path):
    folder = write_record(outcome, tmp_path / "run", themes=())
    (folder / "extra.txt").write_text("left from before")
    write_record(outcome, folder, themes=())
    assert not (folder / "extra.txt").exists()
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "thesis.tex").write_text("years of work")
    with pytest.raises(InvalidValue, match="choose another"):
        write_record(outcome, mine)
    assert (mine / "thesis.tex").read_text() == "years of work"
    a_file = tmp_path / "file"
    a_file.write_text("x")
    with pytest.raises(InvalidValue, match="choose another"):
        write_record(outcome, a_file)


def test_what_fails_on_the_way_leaves_what_was_there(outcome, tmp_path):
    folder = write_record(outcome, tmp_path / "run", themes=())
    before = (folder / "run.csv").read_bytes()

    def half():
        with whole_folder(folder, is_record) as part:
            (part / "run.csv").write_text("t,x\n0,")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        half()
    assert (folder / "run.csv").read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == ["run"]


@pytest.mark.parametrize(
    ("name", "content"),
    [("summary.json", "{"), ("summary.json", "[" * 100_000), ("summary.json", "3"), ("summary.json", '{"format": 9}'),
     ("summary.json", '{"format": 1, "run": {"kind": "unicycle"}}'), ("summary.json", '{"format": 1, "run": 7}'),
     ("summary.json", '{"format": 1, "run": {"kind": "bird", "index": "t", "status": "COMPLETE", "table": "run.csv"}}'),
     ("run.csv", "t,x\n0,zero\n"), ("run.csv", ""), ("scenario.yaml", "type: nothing"), ("scenario.yaml", "\0")],
)  # fmt: skip
def test_a_record_that_was_spoilt_is_refused(outcome, tmp_path, name, content):
    folder = write_record(outcome, tmp_path / "run", themes=())
    (folder / name).write_text(content)
    with pytest.raises(InvalidInput):
        read_record(folder)


def test_what_is_no_record_says_so(tmp_path):
    with pytest.raises(InvalidValue, match="coplanar run"):
        read_record(tmp_path)


def test_the_summary_is_strict_json(outcome, tmp_path):
    folder = write_record(outcome, tmp_path / "run", themes=())

    def refuse(name):
        raise AssertionError(name)

    json.loads((folder / "summary.json").read_text(), parse_constant=refuse)
