"""Logs that are read back: by us, and tables by json, csv, pandas and pyarrow."""

from __future__ import annotations

import csv
import json
import math
import sys

import numpy as np
import pytest

from coplanar.errors import InvalidShape, InvalidValue, MissingExtra, UnknownName
from coplanar.logs import FORMATS, read_log, write_log
from coplanar.run import Kind, Run, RunStatus
from tests.app.logs import BATCH, RUNS, T, same, same_numbers, unicycle

NEEDS = {"mcap": "mcap_ros2", "parquet": "pyarrow"}
WHOLE = [name for name in FORMATS if name != "csv"]


def need(format):
    if format in NEEDS:
        pytest.importorskip(NEEDS[format])


@pytest.mark.parametrize("name", RUNS)
@pytest.mark.parametrize("format", WHOLE)
def test_a_run_comes_back_as_it_was(tmp_path, format, name):
    need(format)
    path = write_log(RUNS[name], tmp_path / f"run.{format}")
    same(RUNS[name], read_log(path))
    assert [p.name for p in tmp_path.iterdir()] == [f"run.{format}"]


@pytest.mark.parametrize("name", RUNS)
def test_csv_keeps_the_numbers(tmp_path, name):
    run = RUNS[name]
    back = read_log(write_log(run, tmp_path / "run.csv"), kind=run.kind, index=run.index)
    same_numbers(run, back)
    assert (back.kind, back.status) == (run.kind, run.status)


@pytest.mark.parametrize("format", ["json", "parquet", "wpilog"])
def test_batches_come_back_in_their_shape(tmp_path, format):
    need(format)
    same(BATCH, read_log(write_log(BATCH, tmp_path / f"run.{format}")))


@pytest.mark.parametrize("format", ["csv", "mcap"])
def test_formats_of_one_robot_say_so(tmp_path, format):
    need(format)
    with pytest.raises(InvalidShape, match=r"run\.robot"):
        write_log(BATCH, tmp_path / f"run.{format}")
    assert list(tmp_path.iterdir()) == []


def test_the_suffix_or_the_word_says_the_format(tmp_path):
    same(unicycle(), read_log(write_log(unicycle(), tmp_path / "RUN.JSON")))
    path = write_log(unicycle(), tmp_path / "log", "wpilog")
    assert path.read_bytes()[:6] == b"WPILOG"
    same(unicycle(), read_log(path, "wpilog"))
    with pytest.raises(UnknownName, match=r"suffix.*did you mean 'wpilog'"):
        write_log(unicycle(), tmp_path / "run.wpilg")
    with pytest.raises(UnknownName, match="format = 'xml'"):
        read_log(path, "xml")


@pytest.mark.parametrize("format", FORMATS)
def test_a_file_appears_whole_or_not_at_all(tmp_path, format, monkeypatch):
    need(format)
    path = write_log(unicycle(), tmp_path / f"run.{format}")
    before = path.read_bytes()

    def broken(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("coplanar.run.files.os.replace", broken)
    with pytest.raises(InvalidValue, match="No space left"):
        write_log(unicycle(x=T), path)
    assert path.read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("format", FORMATS)
def test_a_place_that_is_none(tmp_path, format):
    need(format)
    for place in (tmp_path / "no" / f"run.{format}", tmp_path / f"run\0.{format}"):
        with pytest.raises(InvalidValue, match="path = "):
            write_log(unicycle(), place)
        with pytest.raises(InvalidValue, match="path = "):
            read_log(place)
    with pytest.raises(InvalidValue, match="a file that can be read"):
        read_log(tmp_path, format)


@pytest.mark.parametrize("format", FORMATS)
def test_a_file_that_is_too_long_is_refused(tmp_path, format):
    need(format)
    path = write_log(unicycle(), tmp_path / f"run.{format}")
    with pytest.raises(InvalidValue, match="largest="):
        read_log(path, largest=100)


@pytest.mark.parametrize(("format", "module"), [("mcap", "mcap_ros2.writer"), ("parquet", "pyarrow")])
def test_a_missing_extra_says_how_to_get_it(tmp_path, format, module, monkeypatch):
    need(format)
    path = write_log(unicycle(), tmp_path / f"run.{format}")
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(MissingExtra, match=r"pip install 'coplanar\[logs\]'"):
        write_log(unicycle(), tmp_path / f"new.{format}")
    monkeypatch.setitem(sys.modules, "mcap.stream_reader", None)
    with pytest.raises(MissingExtra, match=r"coplanar\[logs\]"):
        read_log(path)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


def test_what_no_log_holds(tmp_path):
    for nothing in (Run({"t": []}), Run({"t": [0.0], "x": np.empty((1, 0))})):
        with pytest.raises(InvalidShape, match="at least one row and one robot"):
            write_log(nothing, tmp_path / "run.json")
    with pytest.raises(InvalidValue, match="UTF-8"):
        write_log(Run({"t": [0.0], "\ud800": [0.0]}), tmp_path / "run.json")
    with pytest.raises(InvalidValue, match="largest"):
        read_log(tmp_path / "run.json", largest=0)


@pytest.mark.parametrize("format", ["wpilog", "mcap"])
def test_times_beyond_the_stamps(tmp_path, format):
    need(format)
    with pytest.raises(InvalidValue, match="have no stamps"):
        write_log(Run({"t": [0.0, 1e13]}), tmp_path / f"run.{format}")
    assert list(tmp_path.iterdir()) == []


def test_info_that_json_has_no_form_for(tmp_path):
    info = {
        "array": np.arange(3),
        "tuple": (1, np.float64(2.0)),
        "inf": math.inf,
        3: RunStatus.COMPLETE,
        "nan": math.nan,
    }
    back = read_log(write_log(Run({"t": T}, info=info), tmp_path / "run.json"))
    assert dict(back.info) == {
        "array": [0, 1, 2], "tuple": [1, 2.0], "inf": "inf", "3": "RunStatus.COMPLETE", "nan": "nan"
    }  # fmt: skip


def test_json_is_strict_and_any_reader_sees_the_columns(tmp_path):
    def never(word):
        raise AssertionError(word)

    text = write_log(unicycle(), tmp_path / "run.json").read_text(encoding="utf-8")
    table = json.loads(text, parse_constant=never)
    assert table["columns"]["x"] == unicycle()["x"].tolist()
    assert table["status"] == "COMPLETE"
    text = write_log(RUNS["diverged"], tmp_path / "run.json").read_text(encoding="utf-8")
    table = json.loads(text, parse_constant=never)
    assert table["columns"]["x"] == [0.0, math.inf, None]
    assert table["status"] == "DIVERGED"


def test_csv_by_the_standard_library(tmp_path):
    with write_log(unicycle(), tmp_path / "run.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["ey"]) for row in rows] == unicycle()["ey"].tolist()


def test_tables_by_pandas(tmp_path):
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("pyarrow")
    run = unicycle()
    by_csv = pandas.read_csv(write_log(run, tmp_path / "run.csv"), converters=dict.fromkeys(run.columns, float))
    by_parquet = pandas.read_parquet(write_log(run, tmp_path / "run.parquet"))
    for frame in (by_csv, by_parquet):
        assert list(frame.columns) == list(run.columns)
        for name in run.columns:
            np.testing.assert_array_equal(frame[name].to_numpy(), run[name])


def test_parquet_by_pyarrow(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    table = parquet.read_table(write_log(BATCH, tmp_path / "run.parquet"))
    assert table.column("x")[3].as_py() == BATCH["x"][3].ravel().tolist()
    assert str(table.schema.field("t").type) == "double"
    assert json.loads(table.schema.metadata[b"coplanar"])["shapes"] == {"x": [3, 2], "y": [2]}


def test_a_table_by_others_is_read_as_csv_is(tmp_path):
    pyarrow = pytest.importorskip("pyarrow")
    parquet = pytest.importorskip("pyarrow.parquet")
    path = tmp_path / "theirs.parquet"
    columns = {"s": [0, 1, 2], "name": ["a", "b", "c"], "x": [0.5, None, 1.5]}
    parquet.write_table(pyarrow.table(columns), path)
    run = read_log(path, index="s", kind=Kind(states=("x",)))
    assert list(run.columns) == ["s", "x"]
    assert run.status is RunStatus.DIVERGED
    assert math.isnan(run["x"][1])
    assert run.names.states == ("x",)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "line 1 of .*bad.json"),
        ("{\n\n oops}", "line 3 of .*bad.json.*'{.n.n oops}'.*JSON"),
        ("[1]", "with columns"),
        ('{"columns": {"t": [0, NaN]}}', "NaN is no number"),
        ('{"columns": {"t": 3}}', "column 't'.*a list of numbers"),
        ('{"columns": {"t": [0, "1"]}}', "column 't'.*str among its entries"),
        ('{"columns": {"t": [0, true]}}', "bool among"),
        ('{"columns": {"t": [[0], [1, 2]]}}', "column 't'"),
        ('{"columns": {"t": [1' + "0" * 400 + "]}}", "column 't'.*a double holds"),
        ('{"columns": {"t": [1' + "0" * 5000 + "]}}", "bad.json"),
        ('{"columns": {}}', "coplanar: 1"),
        ('{"columns": {"t": [0]}, "coplanar": 1}', "index of the description"),
        ("[" * 100_000, "sensible depth"),
        (b"\xff\xfe{}", "byte 0 of .*UTF-8"),
    ],
)
def test_json_that_is_no_run(tmp_path, text, words):
    path = tmp_path / "bad.json"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(InvalidValue, match=words):
        read_log(path)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"kind": "unicycles"}, "did you mean 'unicycle'"),
        ({"kind": 3}, "kind of .*run.json"),
        ({"kind": {"states": ["x"]}}, "kind of .*commands"),
        ({"kind": {role: [1] for role in Kind._fields}}, "kind of"),
        ({"index": "s"}, "columns of .*a column 's'"),
        ({"status": "FINE"}, "status of .*COMPLETE, DIVERGED"),
        ({"warnings": [1]}, "warnings of .*sentences"),
        ({"info": []}, "info of the description"),
        ({"coplanar": 2}, "coplanar: 1"),
        ({"columns": {"t": [0.0, 0.0]}}, "t of .*monotone"),
        ({"columns": {"t": [0.0, None]}}, "t of .*finite"),
        ({"columns": {"t": [0.0], "x": [1.0, 2.0]}}, "columns of .*one length"),
        ({"columns": {"t": [0.0], "a,b": [1.0]}}, "columns of .*without commas"),
    ],
)
def test_a_description_that_cannot_be(tmp_path, change, words):
    path = write_log(unicycle(), tmp_path / "run.json")
    path.write_text(json.dumps(json.loads(path.read_text(encoding="utf-8")) | change), encoding="utf-8")
    with pytest.raises(InvalidValue, match=words):
        read_log(path)


def test_csv_that_is_no_table(tmp_path):
    path = tmp_path / "bad.csv"
    for content, words in (
        (b"t,x\n0,1\n1,\xff\n", "byte 10 of"),
        (b't,x\n0,"' + b"9" * 200_000, "line 2 of"),
        (b"t,x\n0,1_0\n", "line 2 of.*1_0"),
        (b"t,\n0,1\n", "columns of"),
        (b"s,x\n0,1\n", "columns of .*bad.csv.*a column 't'"),
    ):
        path.write_bytes(content)
        with pytest.raises(InvalidValue, match=words):
            read_log(path)
    path.write_bytes(b"\xef\xbb\xbft,x\r\n0,1\r\n\r\n1,2\r\n")
    assert read_log(path)["x"].tolist() == [1.0, 2.0]
