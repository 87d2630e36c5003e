"""Sweeps on workers that die: a Dask cluster over TCP, processes of this machine."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

from coplanar.scenarios import load
from coplanar.sweeps import sweep
from coplanar.sweeps.workers import WorkersLost

VARY = {"controller.kp": "10:100", "controller.kd": "0:0.3"}
HOW = {"samples": 40, "seed": 4, "task_rows": 2}


@pytest.fixture
def scenario():
    return load("track-astroid").replaced({"duration": 3, "noise": {"position": 0.01}})


def started(arguments, tmp_path, says):
    """A process, and what matched in its first lines."""
    with tempfile.TemporaryFile("w+") as told:
        process = subprocess.Popen([sys.executable, *arguments], cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=told)
        end = time.monotonic() + 60.0
        while process.poll() is None and time.monotonic() < end:
            told.seek(0)
            if match := re.search(says, told.read()):
                return process, match
            time.sleep(0.05)
        process.kill()
        process.wait()
        told.seek(0)
        raise AssertionError(f"{arguments} did not say {says}: {told.read()}")


@pytest.fixture
def cluster(tmp_path):
    """A scheduler and two workers on 127.0.0.1; nobody else is asked for anything."""
    pytest.importorskip("distributed", reason="Dask needs the extra cluster")
    local = ["--host", "127.0.0.1", "--port", "0"]
    scheduler, found = started(
        ["-m", "distributed.cli.dask_scheduler", *local, "--no-dashboard", "--no-jupyter"], tmp_path,
        r"(tcp://127\.0\.0\.1:\d+)",
    )  # fmt: skip
    address = found[1]
    how = [address, "--no-dashboard", "--no-nanny", "--nthreads", "1", "--host", "127.0.0.1"]
    workers = [started(["-m", "distributed.cli.dask_worker", *how], tmp_path, "Registered to")[0] for _ in range(2)]
    yield address, workers
    for process in (*workers, scheduler):
        process.kill()
        process.wait()


def same(one, other):
    assert list(one.columns) == list(other.columns)
    for name, values in one.columns.items():
        np.testing.assert_array_equal(values, other[name])


def test_a_dask_worker_killed_on_the_way_changes_nothing(scenario, cluster):
    address, workers = cluster
    alone = sweep(scenario, VARY, samples=60, seed=4, jobs=1, task_rows=2)

    def kill_one(done, _):
        if done == 8 and workers[0].poll() is None:
            workers[0].send_signal(signal.SIGKILL)

    shared = sweep(scenario, VARY, samples=60, seed=4, executor=address, task_rows=2, progress=kill_one)
    assert workers[0].wait(10) == -signal.SIGKILL
    assert workers[1].poll() is None
    same(alone, shared)


def test_processes_that_die_lose_only_what_was_not_finished(scenario, tmp_path):
    path = tmp_path / "table.csv"
    alone = sweep(scenario, VARY, **HOW, jobs=1)

    def kill_them(done, _):
        if done == 4:
            for process in pool._processes.values():
                os.kill(process.pid, signal.SIGKILL)

    with ProcessPoolExecutor(2, get_context("spawn")) as pool, pytest.raises(WorkersLost, match="run it again"):
        sweep(scenario, VARY, **HOW, executor=pool, path=path, progress=kill_them)
    assert not path.exists()
    begun = []
    same(
        alone,
        sweep(
            scenario,
            VARY,
            samples=40,
            seed=4,
            jobs=1,
            task_rows=2,
            path=path,
            progress=lambda done, _: begun.append(done),
        ),
    )
    assert begun[0] >= 4


SCRIPT = """
import sys, time
from coplanar.scenarios import load
from coplanar.sweeps import sweep
def told(done, _):
    print(done, flush=True)
    time.sleep(0.05)
sweep(load("arm-reach"), {"target.0": "0.1:1:400"}, jobs=1, task_rows=2, path="t.csv", progress=told)
"""


def test_a_sweep_killed_outright_goes_on_where_it_was(tmp_path):
    process = subprocess.Popen([sys.executable, "-c", SCRIPT], cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    with process:
        while int(process.stdout.readline()) < 5:
            pass
        process.kill()
    kept = list((tmp_path / "t.csv.parts").glob("[0-9]*.json"))
    assert len(kept) >= 5
    assert all(json.loads(part.read_text()) for part in kept)
    again = subprocess.run(
        [sys.executable, "-c", SCRIPT.replace("0.05", "0")], cwd=tmp_path, check=True, capture_output=True, text=True
    )
    assert int(again.stdout.split()[0]) == len(kept)
    assert len((tmp_path / "t.csv").read_text().splitlines()) == 401
