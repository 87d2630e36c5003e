"""Whatever is typed or piped in: an answer, a no or an error; never a traceback, never a hang, never half a file."""

from __future__ import annotations

import gzip
import os

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from typer.main import get_command

from coplanar.cli import app
from coplanar.cli.commands import COMMANDS
from tests.app.commands import run

FILES = {"tour", "run", "animate", "export", "sweep"}  # written where they are run
SLOW = {"lab", "play"}  # minutes of work may be asked for; serves until it is stopped
PATIENT = settings(
    deadline=20_000, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
)
WORDS = [
    "free",
    "-90deg:90deg",
    "1:0",
    "R",
    "RP",
    "0,0,0,0.1",
    "1,2,3",
    "t,v,omega",
    "3,2,1",
    "",
    "-",
    "--",
    "nan",
    "inf",
]
units = st.sampled_from(
    ["", " m", "cm", " deg", "rad/s", " kg", " s", "m/s", "in", "/2", "*pi", " parsec", "°", "\x00", "\ud800"]
)
numbers = st.one_of(
    st.sampled_from(["0", "1", "-1", "0.5", "-0.3", "2", "pi", "1e-9", "1e12", "1e300", "1e-300", "((((", "1/0"]),
    st.floats(allow_nan=False, allow_infinity=False, width=16).map(repr),
)
quantities = st.tuples(numbers, units).map("".join)
tokens = st.one_of(quantities, st.sampled_from(WORDS), st.text(max_size=5))


def parameters(name):
    """The options of a command, and how many values each takes; None for what is no option."""
    command = get_command(app).get_command(None, name)
    for parameter in command.params:
        if parameter.param_type_name == "option":
            choices = getattr(parameter, "is_flag", False)
            yield parameter.opts[0], 0 if choices else parameter.nargs, parameter.multiple
        else:
            yield None, 1, False


def options(name):
    """One option with more or less the values that it takes."""

    def filled(parameter):
        option, count, many = parameter
        if option in ("--output", "--help", "--file"):
            return st.just([])
        values = st.lists(tokens, min_size=count, max_size=4 if many else count)
        return values.map(lambda v: ([] if option is None else [option]) + v)

    return st.sampled_from(list(parameters(name))).flatmap(filled)


STARTS = {
    "fk": ["--links", "1", "0.5", "--q", "0.1", "0.2"],
    "ik": ["--links", "1", "0.5", "--target", "0.3", "0.4"],
    "aim": ["--target", "30", "2"],
    "wheels": ["differential", "--track", "0.5", "--radius", "0.1"],
    "odometry": ["-", "--from", "velocities"],
    "doctor": [],
    "list": [],
    "new": ["track"],
    "check": ["track-astroid"],
    "schema": [],
}


def test_every_command_is_tried():
    assert set(STARTS) | FILES | SLOW == set(COMMANDS)


@pytest.mark.parametrize("name", STARTS)
def test_arguments(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    @PATIENT
    @given(st.booleans(), st.lists(options(name), max_size=4))
    def check(begun, parts):
        args = [*(STARTS[name] if begun else []), *(arg for part in parts for arg in part)]
        code, out, err = run(name, *args, data=b"0 1 0\n1 1 0.5\n2 0 0\n")
        assert code in (0, 1, 2), (args, code)
        assert "Traceback" not in out + err
        assert (code == 2) <= bool(err)
        assert os.listdir() == []

    check()


@pytest.mark.parametrize(("option", "unit"), [("--step", "s"), ("--within", "m"), ("--v", "m/s"), ("--omega", "rad/s")])
def test_arguments_of_the_lab(option, unit):
    @settings(PATIENT, max_examples=10)
    @given(st.one_of(tokens, st.floats(0.01, 2.0).map(lambda value: f"{value!r} {unit}")))
    def check(token):
        code, out, err = run("lab", "--duration", "2", option, token)
        assert code in (0, 2)
        assert "Traceback" not in out + err

    check()


rows = st.lists(
    st.one_of(
        st.tuples(*[st.one_of(numbers, st.sampled_from(["", "x", "nan", '"1"', "1_0", "1,5"]))] * 3).map(",".join),
        st.sampled_from(["", "# note", "t,v,omega", "1 2 3", "\t", "1;2;3", "\ufeff", "t,left,right", "1,2,3,4"]),
        st.text(max_size=8),
    ),
    max_size=8,
).map(lambda lines: "\n".join(lines).encode("utf-8", "surrogatepass"))
GOOD = b"".join(b"%d,%d,%d\n" % (i, i % 7, i % 3) for i in range(50))


@st.composite
def damaged(draw):
    """A log, packed or not, with some bytes changed, taken out or cut off."""
    data = bytearray(draw(st.sampled_from([GOOD, gzip.compress(GOOD, mtime=0), b"t,left,right\n" + GOOD])))
    for _ in range(draw(st.integers(0, 3))):
        place = draw(st.integers(0, len(data) - 1))
        data[place : place + draw(st.integers(0, 2))] = draw(st.binary(max_size=2))
    return bytes(data[: draw(st.integers(0, len(data)))])


KINDS = [
    ["--from", "velocities"],
    ["--from", "rates", "--track", "1", "--radius", "0.1"],
    ["--from", "ticks", "--track", "1", "--radius", "0.1", "--ticks", "10"],
    ["--from", "ticks", "--track", "1", "--radius", "0.1", "--ticks", "10", "--bits", "4", "--since-last"],
    ["--from", "velocities", "--covariance", "1", "1", "1", "1", "--equal-times"],
]


@pytest.mark.parametrize("bytes_of", [rows, damaged(), st.binary(max_size=300)], ids=["rows", "damaged", "bytes"])
def test_logs(bytes_of, tmp_path):
    @PATIENT
    @given(bytes_of, st.sampled_from(KINDS))
    def check(data, kind):
        piped = run("odometry", "-", *kind, data=data)
        whole = run("odometry", "-", *kind, "-o", tmp_path / "poses.csv", data=data)
        assert piped[0] == whole[0]
        assert piped[2] == whole[2]
        assert piped[0] in (0, 2)
        assert "Traceback" not in piped[2]
        for row in piped[1].splitlines()[1:]:
            assert all(abs(float(cell)) < float("inf") for cell in row.split(","))
        if piped[0] == 0:
            assert (tmp_path / "poses.csv").read_text() == piped[1]
            (tmp_path / "poses.csv").unlink()
        assert os.listdir(tmp_path) == []

    check()
