"""Odometry of logs of any length: files, pipes, gzip, wrong lines, files that appear whole or not at all."""

from __future__ import annotations

import gzip
import os
import re
import signal
import subprocess
import sys
import threading
from contextlib import suppress
from math import pi

import numpy as np
import pytest

from coplanar import Odometry, OdometryNoise, Pose
from coplanar.logs.columns import MOST
from tests.app.commands import environment, run, shell, started, told

VELOCITIES = ("--from", "velocities")
BASE = ("--track", "40 cm", "--radius", 0.05)


def drive(count, seed=0):
    """Times and velocities that a text of a few digits keeps exactly."""
    rng = np.random.default_rng(seed)
    return np.column_stack((np.arange(count) / 64.0, np.round(rng.normal(size=(count, 2)), 3)))


def text_of(table, separator=",", head=""):
    return (head + "".join(separator.join(map(repr, row)) + "\n" for row in table.tolist())).encode()


def table_of(csv):
    head, *rows = csv.splitlines()
    return head.split(","), np.loadtxt(rows, delimiter=",", ndmin=2)


def close(rows, others):
    """The same to 1e-12 m: a long call may run as a compiled loop, whose sines round in their own way."""
    return rows.shape == others.shape and np.abs(rows - others).max() <= 1e-12 * (1.0 + np.abs(others).max())


def expected(table, start=Pose(), **options):  # noqa: B008
    t, v, omega = table.T
    return np.column_stack((t, Odometry.from_velocities(v, omega, t).path(start, **options).as_array()))


@pytest.mark.parametrize("separator", [",", " ", "\t", ";"])
def test_a_file_and_a_pipe_give_the_poses_of_the_library(tmp_path, separator):
    table = drive(MOST + 7)
    log = tmp_path / "drive.log"
    log.write_bytes(text_of(table, separator, "# drive\n"))
    for code, out, err in (run("odometry", log, *VELOCITIES), run("odometry", "-", *VELOCITIES, data=log.read_bytes())):
        assert (code, err) == (0, "")
        names, rows = table_of(out)
        assert names == ["t", "x", "y", "theta"]
        assert close(rows, expected(table))


@pytest.mark.parametrize("method", ["euler", "midpoint", "heun", "rk4", "exact"])
def test_the_method_is_that_of_the_library(method):
    table = drive(200)
    start = ("--start", "-1", "50 cm", "90 deg")
    out = run("odometry", "-", *VELOCITIES, "--method", method, *start, data=text_of(table))[1]
    assert np.array_equal(table_of(out)[1], expected(table, Pose(-1.0, 0.5, pi / 2), method=method))


def test_covariance_is_that_of_the_library():
    table = drive(300)
    noise = OdometryNoise(0.05, 0.01, 0.02, pi / 180)
    command = ("odometry", "-", *VELOCITIES, "--covariance", 0.05, "1 cm", 0.02, "1 deg")
    names, rows = table_of(run(*command, data=text_of(table))[1])
    assert names[4:] == ["xx", "xy", "xtheta", "yy", "ytheta", "thetatheta"]
    spread = Odometry.from_velocities(*table.T[1:], table.T[0]).covariances(Pose(), noise)
    assert np.array_equal(rows[:, 4:], spread[:, *np.triu_indices(3)])
    assert told(*command, data=text_of(table))["covariance"] == spread[-1].tolist()


def test_ticks_of_wheels_that_differ_and_wrap():
    counts = np.cumsum(np.random.default_rng(1).integers(-900, 901, (500, 2)), axis=0)
    data = text_of(counts % 65536, "\t", "left\tright\n")
    options = ("--track", 0.4, "--radius", 0.05, "51 mm", "--ticks", 4096, "--bits", 16)
    names, rows = table_of(run("odometry", "-", "--from", "ticks", *options, data=data)[1])
    left, right = np.diff(counts, axis=0).T * (2 * pi / 4096) * np.array([[0.05], [0.051]])
    assert names == ["x", "y", "theta"]
    assert rows == pytest.approx(Odometry.from_wheels(left, right, track=0.4).path(Pose()).as_array(), abs=1e-12)


def test_counts_since_the_last_row_and_wheel_rates():
    each = told("odometry", "-", "--from", "ticks", *BASE, "--ticks", 100, "--since-last", data=b"10 10\n10 10\n")
    assert each["end"] == pytest.approx([0.2 * pi * 0.05 * 2, 0.0])
    assert (each["rows"], each["duration"]) == (2, None)
    rates = told("odometry", "-", "--from", "rates", *BASE, data=b"left,right,t\n10,10,0\n1,1,2\n")
    assert (rates["end"], rates["duration"]) == (pytest.approx([1.0, 0.0]), 2.0)


def test_columns_by_name_and_number_and_the_summary():
    data = b"stamp,speed,gyro,note\n0,1,0,go\n2,0,0.5,stop\n4,0,0,end\n"
    for columns in ("stamp,speed,gyro", "1,2,3", "stamp, 2, gyro"):
        summary = told("odometry", "-", *VELOCITIES, "--columns", columns, data=data)
        assert (summary["rows"], summary["distance"], summary["turn"], summary["duration"]) == (3, 2.0, 1.0, 4.0)
        assert (summary["end"], summary["heading"]) == ([2.0, 0.0], 1.0)


@pytest.mark.parametrize("every", [1, 2, 7, MOST, MOST + 1, 10**9])
def test_each_nth_pose_and_the_last_one(every):
    table = drive(MOST + 5)
    rows = table_of(run("odometry", "-", *VELOCITIES, "--every", every, data=text_of(table))[1])[1]
    places = sorted({*range(0, len(table), every), len(table) - 1})
    assert close(rows, expected(table)[places])


def test_decimals():
    out = run("odometry", "-", *VELOCITIES, "--decimals", 3, data=b"0 1 0\n0.12345 0 0\n")[1]
    assert out == "t,x,y,theta\n0.000,0.000,0.000,0.000\n0.123,0.123,0.000,0.000\n"


def test_gzip_by_its_content(tmp_path):
    table = drive(5000)
    log = tmp_path / "no-suffix"
    log.write_bytes(gzip.compress(text_of(table)))
    assert told("odometry", log, *VELOCITIES)["rows"] == 5000
    assert told("odometry", "-", *VELOCITIES, data=log.read_bytes())["end"] == expected(table)[-1, 1:3].tolist()


def test_a_file_appears_whole(tmp_path):
    out = tmp_path / "poses.csv"
    out.write_text("before")
    code, said, err = run("odometry", "-", *VELOCITIES, "-o", out, data=text_of(drive(100)))
    assert (code, err) == (0, "")
    assert said.startswith("100 poses")
    assert len(out.read_text().splitlines()) == 101
    document = told("odometry", "-", *VELOCITIES, "-o", out, data=text_of(drive(10)))
    assert (document["file"], document["rows"]) == (str(out), 10)
    assert os.listdir(tmp_path) == ["poses.csv"]


WRONG = {
    "nan": (b"5,nan,0\n", "v in line {} of stdin = nan: needed a finite number"),
    "missing": (b"5,1\n", "line {} of stdin = '5,1': needed 3 cells, as in line 1; it has 2"),
    "words": (b"5,1,fast\n", "omega in line {} of stdin = 'fast': needed a number"),
    "backwards": (b"-1,1,1\n", "t in line {} of stdin = -1.0: needed a time after"),
    "equal": (b"%r,1,1\n", "rows of equal times can be accepted"),
    "binary": (b"\x00\x01\x02\n", "line {} of stdin = 'bytes that are not text'"),
}


@pytest.mark.parametrize("name", WRONG)
@pytest.mark.parametrize("good", [1, 20_000])
def test_a_bad_value_names_its_line_and_what_was_finished_stays(tmp_path, name, good):
    bad, words = WRONG[name]
    table = drive(good)
    bad = bad.replace(b"%r", repr(float(table[-1, 0])).encode())
    data = text_of(table) + bad + b"1e9,1,1\n"
    code, out, err = run("odometry", "-", *VELOCITIES, data=data)
    assert code == 2
    assert err.startswith("error: ")
    assert words.format(good + 1) in err
    if name != "binary":
        assert close(table_of(out)[1], expected(table) if good > 1 else np.zeros((1, 4)))
    target = tmp_path / "poses.csv"
    target.write_text("before")
    assert run("odometry", "-", *VELOCITIES, "-o", target, data=data)[0] == 2
    assert target.read_text() == "before"
    assert os.listdir(tmp_path) == ["poses.csv"]


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "no row of numbers"),
        (b"# only a comment\n", "no row of numbers"),
        (b"t,v,w\n0,1,2\n", "column in line 1 of stdin = 'omega': needed one of t, v, w"),
        (b"0,1\n", "needed columns t, v, omega"),
        (os.urandom(1) + bytes(range(256)) * 8, "line"),
        (gzip.compress(b"0 1 0\n1 1 0\n2 1 0\n", mtime=0)[:-5], "gzip that can be unpacked to its end"),
        ("0 1 0\n".encode("utf-16"), "save the table as UTF-8"),
        (b"0 1 0\n1e308 1 0\n1.7e308 1e10 0\n1.75e308 1 0", "path at line 4 of stdin"),
    ],
)
def test_logs_that_cannot_be_read(data, message):
    code, _, err = run("odometry", "-", *VELOCITIES, data=data)
    assert code == 2
    assert message in err


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (("nowhere.log", *VELOCITIES), "log = 'nowhere.log': needed a file that can be read (No such file"),
        ((".", *VELOCITIES), "log = '.'"),
        (("-", "--from", "ticks", *BASE), "--ticks = 'nothing'"),
        (("-", "--from", "ticks", *BASE, "--ticks", 0), "ticks_per_turn"),
        (("-", "--from", "ticks", *BASE, "--ticks", 9, "--bits", 99), "bits"),
        (("-", "--from", "ticks", *BASE, "--ticks", "nan"), "ticks_per_turn"),
        (("-", "--from", "rates"), "--track, --radius"),
        (("-", "--from", "rates", *BASE, 1, 2), "one radius"),
        (("-", "--from", "rates", *BASE, "--bits", 8), "--from ticks"),
        (("-", *VELOCITIES, "--track", 1), "--from rates or ticks"),
        (("-", *VELOCITIES, "--covariance", 1, 2), "needed 4 numbers"),
        (("-", *VELOCITIES, "--covariance", "-1", 0, 0, 0), "forward"),
        (("-", *VELOCITIES, "--columns", "1,2"), "one for each of t, v, omega"),
        (("-", *VELOCITIES, "-o", "/nowhere/x.csv"), "No such file"),
        (("-", *VELOCITIES, "-o", "/"), "output = '/'"),
        (("-", *VELOCITIES, "-o", "."), "output"),
        (("-", *VELOCITIES, "-o", "a\0b"), "output"),
        (("a\0b", *VELOCITIES), "log"),
    ],
)
def test_options_that_cannot_be_used(args, message):
    code, out, err = run("odometry", *args, data=b"0 1 0\n1 1 0\n")
    assert (code, out) == (2, "")
    assert err.startswith("error: ")
    assert message in err


def test_a_device_is_written_to_and_stays_a_device():
    assert run("odometry", "-", *VELOCITIES, "-o", "/dev/null", data=b"0 1 0\n")[0] == 0
    assert not os.path.isfile("/dev/null")
    full = run("odometry", "-", *VELOCITIES, "-o", "/dev/full", data=b"0 1 0\n")
    assert full[0] == 2
    assert "No space left" in full[2]


def test_head_ends_a_pipe_quietly():
    process = started("odometry", "-", *VELOCITIES)

    def feed():
        with suppress(BrokenPipeError), process.stdin:
            process.stdin.write(text_of(drive(100_000)))

    feeder = threading.Thread(target=feed)
    feeder.start()
    assert process.stdout.readline() == b"t,x,y,theta\n"
    process.stdout.close()
    assert (process.wait(60), process.stderr.read()) == (0, b"")
    feeder.join()
    process.stderr.close()


def test_rows_are_answered_as_they_come():
    process = started("odometry", "-", *VELOCITIES)
    for i in range(3):
        process.stdin.write(b"%d 1 0\n" % i)
        process.stdin.flush()
        if i == 0:
            assert process.stdout.readline() == b"t,x,y,theta\n"
        assert process.stdout.readline() == f"{i}.0,{i}.0,0.0,0.0\n".encode()
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out, err) == (0, b"", b"")


@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGTERM])
def test_interruption_leaves_no_half_of_a_file(tmp_path, stop):
    target = tmp_path / "poses.csv"
    process = started("odometry", "-", *VELOCITIES, "-o", target)
    process.stdin.write(b"0 1 0\n1 1 0\n")
    process.stdin.flush()
    while not os.listdir(tmp_path) and process.poll() is None:
        pass
    process.send_signal(stop)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out, err) == (130 if stop is signal.SIGINT else 143, b"", b"")
    assert os.listdir(tmp_path) == []


PEAK = """
import runpy, sys
sys.argv[0] = "coplanar"
try:
    runpy.run_module("coplanar", run_name="__main__")
except SystemExit:
    peak = [line for line in open("/proc/self/status") if line.startswith("VmHWM")]
    print(*peak, file=sys.stderr)
"""


def peak(log, *options):
    """Most memory that a run ever held [kB]."""
    command = [sys.executable, "-c", PEAK, "odometry", str(log), *VELOCITIES, *options]
    done = subprocess.run(command, env=environment(), capture_output=True, text=True, timeout=120)
    return int(re.search(r"VmHWM:\s+(\d+)", done.stderr)[1])


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="asks Linux for the peak of memory")
@pytest.mark.parametrize("options", [(), ("--covariance", "1", "1", "1", "1", "--every", "100")])
def test_memory_does_not_grow_with_the_log(tmp_path, options):
    sizes = []
    for count in (40_000, 400_000) if not options else (40_000, 160_000):
        log = tmp_path / f"{count}.log"
        rows = b"".join(b"%d 0.5 0.25\n" % i for i in range(count))
        log.write_bytes(rows)
        sizes.append(peak(log, *options))
    assert sizes[1] < sizes[0] + 8_000


def test_a_process_of_its_own_says_the_same():
    data = text_of(drive(100))
    done = shell("odometry", "-", *VELOCITIES, input=data)
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout.decode() == run("odometry", "-", *VELOCITIES, data=data)[1]
