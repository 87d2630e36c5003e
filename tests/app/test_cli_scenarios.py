"""The commands about scenarios and runs, as a shell calls them."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image
from typer.testing import CliRunner

from coplanar.cli import app
from coplanar.logs import read_log
from coplanar.run import Run
from coplanar.scenarios import KINDS, load, names


@pytest.fixture
def call(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def called(*arguments):
        answer = CliRunner().invoke(app, [str(a) for a in arguments])
        assert answer.exception is None or isinstance(answer.exception, SystemExit), answer.exception
        return answer

    return called


def told(answer):
    return json.loads(answer.stdout, parse_constant=lambda name: pytest.fail(name))


def test_list_names_every_scenario(call):
    rows = told(call("list", "--json"))["scenarios"]
    assert [row["name"] for row in rows] == list(names())
    assert all(row["title"] for row in rows)


@pytest.mark.parametrize("kind", KINDS)
def test_a_new_scenario_checks_as_it_is(call, tmp_path, kind):
    text = call("new", kind).stdout
    (tmp_path / "s.yaml").write_text(text)
    assert "#" in text
    assert call("check", "s.yaml").exit_code == 0
    assert call("new", kind, "-o", "t.yaml").exit_code == 0
    assert (tmp_path / "t.yaml").read_text() == text


def test_run_writes_a_folder_and_says_what_came_out(call, tmp_path):
    answer = call(
        "run", "track-astroid", "--set", "duration=1 s", "--set", "controller.kp=50", "--json", "--no-figures"
    )
    document = told(answer)
    assert answer.exit_code == 0
    assert document["folder"] == "runs/track-astroid"
    run = Run.from_csv(tmp_path / document["folder"] / "run.csv", "unicycle")
    assert document["distance"] == pytest.approx(run.summary()["distance"])
    assert load(tmp_path / "runs/track-astroid/scenario.yaml").controller.kp == 50


def test_several_runs_go_side_by_side_and_resume(call, tmp_path):
    both = call("run", "arm-reach", "arm-pose", "-o", "out", "--no-figures", "--json")
    assert [d["folder"] for d in told(both)] == ["out/arm-reach", "out/arm-pose"]
    stamp = (tmp_path / "out/arm-reach/summary.json").stat().st_mtime_ns
    (tmp_path / "out/arm-pose/summary.json").unlink()
    (tmp_path / "out/arm-pose/scenario.yaml").unlink()
    for left in (tmp_path / "out/arm-pose").iterdir():
        left.unlink()
    again = call("run", "arm-reach", "arm-pose", "-o", "out", "--no-figures", "--json", "--resume")
    assert told(again) == told(both)
    assert (tmp_path / "out/arm-reach/summary.json").stat().st_mtime_ns == stamp


def test_the_honest_no_is_exit_code_one(call):
    unstable = call("run", "track-astroid", "--set", "integrator.method=rk4", "--json", "--no-figures")
    assert (unstable.exit_code, told(unstable)["ok"]) == (1, False)
    checked = call("check", "track-astroid", "--set", "integrator.method=rk4")
    assert checked.exit_code == 1
    far = call("run", "arm-reach", "--set", "target=[5, 0]", "--json", "--no-figures")
    assert (far.exit_code, told(far)["ok"]) == (1, False)


def test_everything_wrong_with_a_file_is_said_at_once(call, tmp_path):
    (tmp_path / "bad.yaml").write_text("type: arm-reach\narm: {links: [1, -1]}\ntarget: [1, two]\ncolour: red\n")
    answer = call("run", "bad.yaml")
    assert answer.exit_code == 2
    for word in ("line 2", "arm.links.1", "line 3", "target.1", "line 4", "colour"):
        assert word in answer.stderr
    assert "Traceback" not in answer.stderr
    assert not (tmp_path / "runs").exists()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [(("run", "track-astroit"), "track-astroid"), (("run", "arm-reach", "--set", "target"), "KEY=VALUE"),
     (("run", "arm-reach", "--set", "tarket=1"), "target"), (("new", "arm-reech"), "arm-reach"),
     (("export", "arm-reach"), "--to"), (("export", "track-astroid", "--to", "xlsx"), "csv"),
     (("animate", "track-astroid", "-o", "x.avi"), "gif"), (("animate", "nowhere", "-o", "x.gif"), "nowhere"),
     (("animate", "track-astroid", "-o", "x.gif", "--size", "big"), "WxH"), (("run", "no.yaml"), "no.yaml"),
     (("export", "arm-pose", "--to", "csv"), "moves in time"), (("sweep", "arm-reach"), "vary"),
     (("sweep", "arm-reach", "--vary", "target.0"), "KEY=VALUES"), (("check", "."), "file"),
     (("sweep", "arm-reach", "--vary", "target.0=0:1:3", "-o", "t.txt"), ".csv")],
)  # fmt: skip
def test_what_cannot_be_used_is_exit_code_two_and_leaves_nothing(call, tmp_path, arguments, says):
    answer = call(*arguments)
    assert answer.exit_code == 2
    assert says in answer.stderr
    assert "Traceback" not in answer.output
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("form", ["csv", "json", "wpilog", "mcap", "parquet"])
def test_a_run_is_exported_to_every_format(call, tmp_path, form):
    if form in ("mcap", "parquet"):
        pytest.importorskip("mcap_ros2" if form == "mcap" else "pyarrow", reason="needs the extra logs")
    assert call("run", "track-astroid", "--set", "duration=1", "--no-figures").exit_code == 0
    answer = told(call("export", "runs/track-astroid", "--to", form, "--json"))
    run = Run.from_csv(tmp_path / "runs/track-astroid/run.csv", "unicycle")
    back = read_log(tmp_path / answer["file"])
    for name in run.columns:
        np.testing.assert_array_equal(back[name], run[name])


def test_a_run_becomes_a_film(call, tmp_path):
    assert call("run", "track-astroid", "--set", "duration=1", "--no-figures").exit_code == 0
    answer = call("animate", "runs/track-astroid", "-o", "a.gif", "--size", "200x160", "--fps", "10")
    assert answer.exit_code == 0, answer.stderr
    with Image.open(tmp_path / "a.gif") as film:
        assert film.size == (200, 160)
        assert film.n_frames >= 10
    assert call("animate", "trace-circle", "-o", "b.html").exit_code == 0
    assert "<canvas" in (tmp_path / "b.html").read_text()


def test_a_sweep_from_the_shell(call, tmp_path):
    grid = call("sweep", "arm-reach", "--vary", "target.0=10 cm:140 cm:5", "-j", 1, "--plot", "gap", "--json")
    document = told(grid)
    assert (document["rows"], document["problems"]) == (5, 0)
    assert document["files"] == ["arm-reach-sweep.csv", "arm-reach-sweep-gap-light.svg", "arm-reach-sweep-gap-dark.svg"]
    draws = ("sweep", "arm-reach", "--vary", "target.0=0.1:1.4", "--samples", 7, "--seed", 3, "-j", 1, "-o")
    assert call(*draws, "a.csv").exit_code == call(*draws, "b.csv").exit_code == 0
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()


def test_the_schema_is_json_schema(call):
    jsonschema = pytest.importorskip("jsonschema", reason="checks schemas")
    jsonschema.Draft202012Validator.check_schema(told(call("schema")))


WORDS = ["--set", "--json", "-o", "x", "arm-reach", "target=1", "--to", "=", "--vary", "a=1:2:3", "--help"]
WORDS += ["target.0=0:1:2", "-j", "1", "--samples", "2"]


@settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.sampled_from(["list", "new", "check", "export", "animate", "schema", "sweep"]),
    st.lists(st.one_of(st.sampled_from(WORDS), st.text(max_size=8)), max_size=4),
)
def test_no_arguments_end_in_a_traceback(call, command, arguments):
    assert call(command, *arguments).exit_code in (0, 1, 2)
