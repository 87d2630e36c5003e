"""How the tests run the command line: in this process, or as a shell does."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

from typer.testing import CliRunner

import coplanar
from coplanar.cli import app

SOURCES = str(Path(coplanar.__file__).parents[1])
TOLD = "error: "


def run(*args, data=None):
    """Exit code, stdout and stderr of a command in this process."""
    result = CliRunner(env={"COLUMNS": "80"}).invoke(app, [str(a) for a in args], input=data)
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result.exit_code, result.stdout, result.stderr


def told(*args, data=None, code=0):
    """What a command says with --json."""
    got, out, err = run(*args, "--json", data=data)
    assert got == code, (out, err)
    document = json.loads(out, parse_constant=refused)
    assert document["ok"] is (code == 0)
    return document


def refused(constant):
    raise AssertionError(f"{constant} is no JSON")


def environment(**more):
    """The surroundings of a shell that finds these sources."""
    return {**os.environ, "PYTHONPATH": SOURCES, "PYTHONWARNINGS": "error", **more}


def shell(*args, **options):
    """A command as a process of its own, to its end."""
    env = environment(**options.pop("env", {}))
    command = [sys.executable, "-m", "coplanar", *map(str, args)]
    return subprocess.run(command, env=env, capture_output=True, timeout=120, **options)


def started(*args, **options):
    """A command as a process of its own, with pipes."""
    command = [sys.executable, "-m", "coplanar", *map(str, args)]
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    return subprocess.Popen(command, env=environment(), **(pipes | options))
