"""The tour, as a user runs it: its files, their columns, its page."""

from __future__ import annotations

import csv
import json
import re
from html.parser import HTMLParser
from math import pi

import numpy as np
import pytest
from typer.testing import CliRunner

from coplanar.cli import app
from coplanar.scenarios import load, names
from coplanar.tour import run_tour
from coplanar.viz.outcomes import scene_of

COLUMNS = {
    "arm-pose/run.csv": ("point,x,y", 3),
    "arm-reach/run.csv": ("elbow,q1,q2", 2),
    "arm-reach/iterations.csv": ("iteration,evaluations,residual,step,damping,taken,q1,q2", None),
    "trace-circle/run.csv": ("phi,q1,q2,x,y", 51),
    "trace-lemniscate/run.csv": ("phi,q1,q2,x,y", 201),
    "rolling-wheel/run.csv": ("beta,vx,vy", None),
    "drive-square/run.csv": ("t,x,y,theta,v,omega", 71),
    "arc-chain/run.csv": ("t,x,y,theta", None),
    "clothoid/run.csv": ("t,x,y,theta", 101),
    "holonomic/run.csv": ("t,x,y,vx,vy", None),
    "omni-three/run.csv": ("wheel,rate", 3),
    "ramp/run.csv": ("t,x,y,vx,vy", None),
    "track-astroid/run.csv": ("t,x,y,theta,v,omega,ex,ey", 1001),
    "track-astroid-p/run.csv": ("t,x,y,theta,v,omega,ex,ey", 1001),
    "shot/run.csv": ("t,x,y,vx,vy", 501),
    "aim-time/run.csv": ("vx0,vy0", 1),
    "aim-speed/run.csv": ("angle,range", 2),
}


pytestmark = pytest.mark.xdist_group("tour")  # one worker, so that the tour runs once


@pytest.fixture(scope="module")
def toured(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tour")
    return folder, run_tour(folder)


@pytest.fixture
def read(toured):
    folder, _ = toured

    def table(name):
        with (folder / name).open(newline="") as file:
            rows = list(csv.reader(file))
        return dict(zip(rows[0], (np.array(column) for column in zip(*rows[1:], strict=True)), strict=True))

    return table


def numbers(table):
    return {name: column.astype(float) for name, column in table.items()}


@pytest.mark.parametrize("name", COLUMNS)
def test_tables_have_their_columns_and_rows(toured, name):
    header, rows = COLUMNS[name]
    lines = (toured[0] / name).read_text().splitlines()
    assert lines[0] == header
    assert rows is None or len(lines) == rows + 1


def test_every_check_of_the_tour_holds(toured):
    assert {demo.name: demo.passed for demo in toured[1]} == dict.fromkeys((d.name for d in toured[1]), True)
    assert [demo.name for demo in toured[1]] == list(names())
    assert all(demo.ok for demo in toured[1])


def test_numbers_survive_the_file(toured, read):
    for demo in toured[1]:
        for file, table in demo.tables.items():
            back = read(f"{demo.name}/{file}")
            for name, column in table.items():
                if np.asarray(column).dtype.kind == "f":
                    assert np.array_equal(back[name].astype(float), column)


def test_the_arm_pose_is_where_trigonometry_puts_it(read):
    table = read("arm-pose/run.csv")
    assert table["point"].tolist() == ["base", "elbow", "tool"]
    elbow = 0.5 * np.exp(0.3j)
    points = table["x"].astype(float) + 1j * table["y"].astype(float)
    assert np.allclose(points, [0.0, elbow, elbow + 0.3 * np.exp(0.7j)], rtol=0, atol=1e-15)


def test_both_elbows_reach(read):
    table = numbers(read("arm-reach/run.csv"))
    tool = 0.5 * np.exp(1j * table["q1"]) + 0.5 * np.exp(1j * (table["q1"] + table["q2"]))
    assert np.allclose(tool, 0.5, rtol=0, atol=1e-15)
    assert np.array_equal(np.sign(np.sin(table["q2"])), table["elbow"])


@pytest.mark.parametrize(
    ("name", "curve"),
    [
        ("trace-circle", lambda phi: 1 + 0.5j + 0.5 * np.exp(1j * phi)),
        ("trace-lemniscate", lambda phi: np.cos(phi) * (1 + 1j * np.sin(phi))),
    ],
)
def test_traces_are_on_their_curves_without_jumps(read, name, curve):
    table = numbers(read(f"{name}/run.csv"))
    tool = np.exp(1j * table["q1"]) + np.exp(1j * (table["q1"] + table["q2"]))
    assert np.allclose(tool, curve(table["phi"]), rtol=0, atol=1e-14)
    assert np.allclose(tool, table["x"] + 1j * table["y"], rtol=0, atol=1e-15)
    assert table["phi"][[0, -1]].tolist() == [0.0, 2.0 * pi]
    for joint in ("q1", "q2"):
        assert np.abs(np.diff(table[joint])).max() < 0.2


def test_the_square_is_the_sum_of_its_steps(read):
    table = numbers(read("drive-square/run.csv"))
    heading = -pi / 2 + np.concatenate([[0.0], np.cumsum(0.1 * table["omega"][:-1])])
    assert np.allclose(table["theta"], heading, rtol=0, atol=1e-12)
    steps = 0.1 * table["v"][:-1] * np.exp(1j * heading[:-1])
    path = np.concatenate([[0.0], np.cumsum(steps)])
    assert np.allclose(table["x"] + 1j * table["y"], path, rtol=0, atol=1e-12)
    assert np.allclose(np.diff(table["t"]), 0.1)
    assert (table["v"] == 1.0)[:11].all()
    assert not (table["v"] == 1.0)[11]


def test_the_clothoid_is_the_integral(read):
    from scipy.integrate import quad

    table = numbers(read("clothoid/run.csv"))
    i = 63
    heading = lambda s: -0.5 * s + 0.2 * s * s  # noqa: E731 - an integrand
    for name, wave in (("x", np.cos), ("y", np.sin)):
        truth, _ = quad(lambda s, w=wave: (1 + 0.2 * s) * w(heading(s)), 0.0, table["t"][i], epsabs=1e-13)
        assert table[name][i] == pytest.approx(truth, abs=1e-12)


def test_the_tracking_demo_follows_its_recurrence(read):
    """The loop written out again: error against the next reference, PD with a backward difference, Euler."""
    table = numbers(read("track-astroid/run.csv"))
    t = table["t"]
    reference = np.cos(2 * pi * t / 10) ** 3 + 1j * np.sin(2 * pi * t / 10) ** 3
    centre, theta, last = reference[0] - 0.05j, pi / 2, 0.0
    for i in range(1000):
        error = reference[i + 1] - (centre + 0.05 * np.exp(1j * theta))
        body = (100.0 * error + 0.5 * (error - last) / 0.01) * np.exp(-1j * theta)
        v, omega, last = body.real, body.imag / 0.05, error
        assert table["v"][i + 1] == pytest.approx(v, abs=1e-8)
        assert table["omega"][i + 1] == pytest.approx(omega, abs=1e-7)
        assert table["ex"][i + 1] + 1j * table["ey"][i + 1] == pytest.approx(error, abs=1e-10)
        centre, theta = centre + 0.01 * v * np.exp(1j * theta), theta + 0.01 * omega
        assert table["x"][i + 1] + 1j * table["y"][i + 1] == pytest.approx(centre, abs=1e-10)
    assert table["theta"][-1] == pytest.approx(theta, abs=1e-8)


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.links, self.open = [], []

    def handle_starttag(self, tag, attributes):
        if tag not in ("meta", "img", "input", "source", "link", "br"):
            self.open.append(tag)
        self.links += [value for name, value in attributes if name in ("href", "src", "srcset")]

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def test_the_page_is_whole_and_needs_nothing_from_elsewhere(toured):
    folder, demos = toured
    text = (folder / "index.html").read_text("utf-8")
    page = Page()
    page.feed(text)
    assert page.open == []
    assert not any("//" in link for link in page.links)
    for link in page.links:
        if link.startswith("#"):
            assert f'id="{link[1:]}"' in text
        else:
            assert (folder / link).is_file(), link
    scenes = re.findall(r'<script type="application/json">(.*?)</script>', text, re.DOTALL)
    assert len(scenes) == sum(scene_of(demo) is not None for demo in demos) > 10
    for scene in map(json.loads, scenes):
        assert all(len(layer.get(key, scene["times"])) == len(scene["times"])
                   for layer in scene["layers"] if layer["kind"] != "curve"
                   for key in ("points", "joints", "poses"))  # fmt: skip


def test_the_command_prints_the_table_and_where_the_page_is(tmp_path, monkeypatch, toured):
    monkeypatch.setattr("coplanar.tour.run_tour", lambda *_, **__: toured[1])
    result = CliRunner().invoke(app, ["tour", "-o", str(tmp_path)], env={"COLUMNS": "200"})
    assert result.exit_code == 0
    assert all(demo.name in result.stdout for demo in toured[1])
    assert result.stdout.rstrip().endswith("index.html")


def test_the_command_answers_programs(tmp_path, monkeypatch, toured):
    monkeypatch.setattr("coplanar.tour.run_tour", lambda *_, **__: toured[1])
    result = CliRunner().invoke(app, ["tour", "-o", str(tmp_path), "--json"])
    document = json.loads(result.stdout)
    assert (result.exit_code, document["ok"]) == (0, True)
    assert [row["name"] for row in document["demonstrations"]] == [demo.name for demo in toured[1]]
    assert all(row["passed"] for row in document["demonstrations"])


def test_a_folder_that_is_a_file_is_refused(tmp_path):
    (tmp_path / "file").write_text("")
    result = CliRunner().invoke(app, ["tour", "-o", str(tmp_path / "file")])
    assert result.exit_code == 2
    assert "needed a folder" in " ".join(result.stderr.split())


def test_a_failing_demo_leaves_the_folder_as_it_was(tmp_path, monkeypatch):
    def broken(self, progress=None):
        raise RuntimeError("no")

    first, second = load("arm-pose"), load("shot")
    monkeypatch.setattr(type(second), "run", broken)
    (tmp_path / "mine.txt").write_text("kept")
    with pytest.raises(RuntimeError):
        run_tour(tmp_path, scenarios=(first, second))
    assert [p.name for p in tmp_path.iterdir()] == ["mine.txt"]


def test_version():
    assert CliRunner().invoke(app, ["--version"]).stdout.startswith("coplanar ")
