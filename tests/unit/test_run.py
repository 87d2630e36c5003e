"""Runs: columns, resampling, files, summaries, what they refuse."""

from __future__ import annotations

import math
import sys

import numpy as np
import pytest

from coplanar.errors import InvalidShape, InvalidValue, MissingExtra, UnknownName
from coplanar.run import Kind, Run, RunStatus

T = np.array([0.0, 1.0, 2.0, 4.0])


def small(**more):
    columns = {
        "t": T,
        "x": [0.0, 1.0, 1.0, 3.0],
        "y": [0.0, 0.0, 2.0, 2.0],
        "theta": [3.0, -3.0, -2.5, -2.0],
        "v": [0.0, 1.0, 2.0, 1.0],
        "omega": [0.0, 0.3, 0.5, 0.25],
        "ex": [0.0, 0.3, 0.0, 0.1],
        "ey": [0.0, 0.4, 0.0, 0.0],
    }
    return Run(columns | more, "unicycle")


def test_roles():
    run = small(extra=[1, 2, 3, 4])
    assert run.names.states == ("x", "y", "theta")
    assert run.states.shape == (4, 3)
    assert run.commands[1].tolist() == [1.0, 0.3]
    assert run.errors[1].tolist() == [0.3, 0.4]
    assert run.poses.x.tolist() == run["x"].tolist()
    assert run["extra"].tolist() == [1.0, 2.0, 3.0, 4.0]
    assert len(run) == 4
    assert run.shape == ()
    assert Run({"t": T}).states.shape == (4, 0)
    arm = Run({"t": T, "q1": T, "q2": T, "x": T}, "arm")
    assert arm.names.states == ("q1", "q2")
    own = Run({"s": T, "height": T}, Kind(states=("h*",)), index="s")
    assert own.states.shape == (4, 1)
    assert own.t is own["s"]


def test_resampling_by_time():
    run = small()
    for i, t in enumerate(T):
        for name in run.columns:
            expected = run[name][i] if name != "theta" else np.unwrap(run["theta"])[i]
            assert run.at(t)[name][0] == pytest.approx(expected, abs=1e-15)
    between = run.at([0.5, 3.0])
    assert between["x"].tolist() == [0.5, 2.0]
    assert between.kind == "unicycle"


def test_headings_are_unwrapped_across_pi():
    heading = small().at([0.25, 0.5, 0.75])["theta"]
    np.testing.assert_allclose(heading, 3.0 + np.array([0.25, 0.5, 0.75]) * (2.0 * math.pi - 6.0))


def test_headings_that_already_wind_are_left_alone():
    """A robot that turns by more than half a turn a row did so."""
    run = Run({"t": [0.0, 1.0, 2.0, 3.0], "theta": [0.0, 4.0, 8.0, 12.0]})
    assert run.at([0.5, 1.5])["theta"].tolist() == [2.0, 6.0]


def test_commands_hold_over_the_interval_that_ends_in_their_row():
    assert small().at([0.0, 0.5, 1.0, 1.5, 3.9])["v"].tolist() == [0.0, 1.0, 1.0, 2.0, 1.0]


def test_decreasing_index():
    run = Run({"t": T[::-1], "x": [4.0, 3.0, 2.0, 0.0]})
    assert run.at(3.0)["x"].tolist() == [3.5]
    assert run.at([3.0, 0.5])["x"].tolist() == [3.5, 1.0]


def test_outside_the_run():
    for t in (-0.1, 4.1, math.nan, [[0.0]]):
        with pytest.raises(InvalidValue):
            small().at(t)


def test_batches():
    run = Run({"t": [0.0, 1.0], "x": np.arange(12.0).reshape(2, 2, 3), "y": np.zeros((2, 3))}, "flight")
    assert run.shape == (2, 3)
    one = run.robot((1, 2))
    assert one["x"].tolist() == [5.0, 11.0]
    assert one["y"].tolist() == [0.0, 0.0]
    assert one.shape == ()
    assert run.robot(1).shape == (3,)
    assert run.at(0.5)["x"].shape == (1, 2, 3)
    with pytest.raises(InvalidShape, match=r"run\.robot"):
        run.to_csv("never.csv")
    assert run.summary()["distance"].shape == (2, 3)
    with pytest.raises(UnknownName):
        run["z"]


def test_csv_round_trip_is_exact(tmp_path):
    rng = np.random.default_rng(0)
    run = Run({"t": np.cumsum(rng.random(50)), "x": rng.normal(size=50) * 10.0 ** rng.integers(-300, 300, 50)})
    path = run.to_csv(tmp_path / "run.csv")
    back = Run.from_csv(path)
    for name in run.columns:
        np.testing.assert_array_equal(back[name], run[name])
    assert path.read_text(encoding="utf-8").startswith("t,x\n")
    assert [p.name for p in tmp_path.iterdir()] == ["run.csv"]
    assert Run.from_csv(path, "flight").kind == "flight"


def test_a_file_appears_whole_or_not_at_all(tmp_path, monkeypatch):
    path = small().to_csv(tmp_path / "run.csv")
    before = path.read_bytes()

    def broken(*_):
        raise OSError("disk full")

    monkeypatch.setattr("coplanar.run.files.os.replace", broken)
    with pytest.raises(OSError, match="disk full"):
        small(x=[9.0, 9.0, 9.0, 9.0]).to_csv(path)
    assert path.read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == ["run.csv"]


def test_a_diverged_run_survives_its_file(tmp_path):
    run = Run({"t": [0.0, 1.0], "x": [0.0, math.nan]}, status=RunStatus.DIVERGED)
    back = Run.from_csv(run.to_csv(tmp_path / "run.csv"))
    assert back.status is RunStatus.DIVERGED
    assert math.isnan(back["x"][1])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "a header"),
        ("t,x\n", "at least one row"),
        ("t,t\n1,2\n", "different names"),
        ("t,x\n0,1\n1,two\n", "line 3.*two"),
        ("t,x\n0,1\n1\n", "line 3.*2 cells"),
        ("s,x\n0,1\n1,2\n", "a column 't'"),
        ("t,x\n1,1\n0,1\n1,1\n", "monotone"),
    ],
)
def test_bad_files(tmp_path, text, words):
    path = tmp_path / "bad.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InvalidValue, match=words):
        Run.from_csv(path)


def test_bad_columns():
    with pytest.raises(InvalidShape, match="x: "):
        Run({"t": T, "x": [1.0, 2.0]})
    with pytest.raises(InvalidShape):
        Run({"t": [[0.0, 1.0]]})
    with pytest.raises(InvalidValue, match="monotone"):
        Run({"t": [0.0, 0.0]})
    with pytest.raises(InvalidValue, match="x = "):
        Run({"t": T, "x": [0.0, 1.0, math.nan, 2.0]})
    with pytest.raises(InvalidValue, match="without commas"):
        Run({"t": T, "a,b": T})
    with pytest.raises(UnknownName, match="did you mean 'unicycle'"):
        Run({"t": T}, "unicycles")


def test_nothing_can_be_changed():
    mine = T.copy()
    run = Run({"t": mine})
    mine[0] = -5.0
    assert run.t[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        run.t[0] = 1.0
    with pytest.raises(TypeError):
        run.columns["x"] = T
    with pytest.raises(TypeError):
        run.info["x"] = 1


def test_summary():
    facts = small().summary()
    assert facts["rows"] == 4
    assert facts["duration"] == 4.0
    assert facts["distance"] == 5.0
    assert facts["final_x"] == 3.0
    assert facts["largest_v"] == 2.0
    assert facts["largest_error"] == pytest.approx(0.5)
    assert facts["rms_error"] == pytest.approx(math.sqrt((0.25 + 0.01) / 4.0))
    assert facts["status"] == "ran to its end"


def test_one_row_is_a_run():
    one = Run({"t": [1.0], "x": [2.0]})
    assert one.at(1.0)["x"].tolist() == [2.0]


def test_dataframe_needs_pandas(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(MissingExtra, match="pip install pandas"):
        small().to_dataframe()


def test_dataframe(monkeypatch):
    class Frames:
        DataFrame = staticmethod(lambda columns: {name: list(values) for name, values in columns.items()})

    monkeypatch.setitem(sys.modules, "pandas", Frames)
    assert small().to_dataframe()["x"] == [0.0, 1.0, 1.0, 3.0]


def test_warnings_may_be_worked_out_when_they_are_asked_for():
    asked = []

    def sentences():
        asked.append(1)
        return ["mind the step"]

    run = Run._of({"t": np.zeros(1)}, "table", status=RunStatus.COMPLETE, warnings=sentences, info={})
    assert not asked
    assert run.warnings == ("mind the step",)
    assert run.warnings == run.at(0.0).warnings == ("mind the step",)
    assert len(asked) == 1
    assert Run({"t": [0.0]}, warnings=["a"]).warnings == ("a",)
