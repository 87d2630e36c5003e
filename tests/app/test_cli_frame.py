"""What all commands share: help, completion, exit codes, pipes, signals."""

from __future__ import annotations

import ast
import json
import os
import pty
import re
import signal
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import pytest
import typer

from coplanar import cli
from coplanar.cli import app, arguments
from coplanar.cli.commands import COMMANDS
from coplanar.cli.conduct import conducted
from coplanar.errors import InvalidValue, MissingExtra, NoSolution
from tests.app.commands import SOURCES, environment, run, shell, started

REACHED = ("ik", "--links", "0.4", "0.3", "--target", "-0.3", "0.4")
BEYOND = ("ik", "--links", "0.4", "0.3", "--target", "9", "0.4")


@pytest.mark.parametrize("command", [[], *([name] for name in COMMANDS)], ids=lambda c: " ".join(c) or "coplanar")
def test_help_says_what_there_is(command):
    code, out, _ = run(*command, "--help")
    assert code == 0
    assert out.startswith("Usage: coplanar")
    assert all(name in out for name in (COMMANDS if not command else ["--help"]))
    listed = out.partition("Commands:")[2].splitlines()
    assert not [line for line in listed if line.endswith("...")]  # first lines are short enough to be whole


def test_help_needs_nothing_heavy():
    text = "import sys\nfrom coplanar.cli import main\nsys.argv[1:] = [%r, '--help']\n"
    text += "try:\n    main()\nfinally:\n    print(*sys.modules)"
    for name in COMMANDS:
        done = subprocess.run([sys.executable, "-c", text % name], env=environment(), capture_output=True, text=True)
        heavy = {"numpy", "scipy", "numba", "matplotlib", "coplanar.scenarios", "rich.markdown"}
        assert not heavy & set(done.stdout.splitlines()[-1].split()), name


def test_a_quantity_needs_no_scenario():
    text = "import sys\nfrom coplanar.cli import main\nsys.argv[1:] = ['fk', '--links', '1', '--q', '30 deg']\n"
    text += "try:\n    main()\nfinally:\n    print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", text], env=environment(), capture_output=True, text=True)
    assert "position" in done.stdout
    assert not {"coplanar.scenarios.kinds", "numba", "matplotlib"} & set(done.stdout.splitlines()[-1].split())


def test_modules_of_commands_import_little():
    """Whoever adds a command: what it works with is imported inside it, or help would wait for it."""
    allowed = {"typer", "coplanar.cli", "coplanar.errors", *sys.stdlib_module_names}
    for name in set(COMMANDS.values()):
        tree = ast.parse((Path(cli.__file__).parent / f"{name}.py").read_text())
        for node in tree.body:
            names = [a.name for a in node.names] if isinstance(node, ast.Import) else [getattr(node, "module", None)]
            for module in filter(None, names if isinstance(node, ast.Import | ast.ImportFrom) else []):
                assert any(module == a or module.startswith(f"{a}.") for a in allowed), (name, module)


def test_version():
    assert run("--version")[1].startswith("coplanar ")
    done = shell("--version")
    assert (done.returncode, done.stderr) == (0, b"")


def test_an_unknown_command_is_refused_with_a_suggestion():
    code, _, err = run("odometri")
    assert code == 2
    assert "odometry" in err
    assert run("fk")[0] == run("fk", "--nothing")[0] == run("aim", "--target", "1")[0] == 2


def test_no_command_is_help():
    _, out, err = run()
    assert "odometry" in out + err


@pytest.mark.parametrize(
    ("raised", "code", "words"),
    [
        (InvalidValue("speed", -1, "more than 0"), 2, "error: speed = -1: needed more than 0"),
        (MissingExtra("mcap", "logs"), 2, "pip install 'coplanar[logs]'"),
        (NoSolution("out of reach", None), 1, "error: out of reach"),
        (OSError(28, "No space left on device", "a.csv"), 2, "error: a.csv: No space left on device"),
        (MemoryError(), 2, "error: this takes more memory"),
        (KeyboardInterrupt(), 130, ""),
        (BrokenPipeError(), 0, ""),
        (typer.Exit(1), 1, ""),
    ],
)
def test_every_end_has_its_exit_code(raised, code, words, capsys):
    def command():
        raise raised

    try:
        conducted(command)()
        got = 0
    except typer.Exit as end:
        got = end.exit_code
    assert got == code
    out, err = capsys.readouterr()
    assert (words in err, out) == (True, "")


def test_a_bug_is_no_error_of_the_user():
    def command():
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        conducted(command)()


def test_the_honest_no_is_an_answer_with_exit_code_1():
    code, out, err = run(*BEYOND)
    assert (code, err) == (1, "")
    assert out.startswith("the target is beyond the outer ring")
    code, out, err = run(*BEYOND, "--json")
    assert (code, err) == (1, "")
    assert json.loads(out)["ok"] is False


def test_a_reader_that_leaves_is_no_error():
    for command, code in ((REACHED, 0), (BEYOND, 1), ((*BEYOND, "--json"), 1)):
        process = started(*command)
        process.stdout.close()
        err = process.stderr.read()
        assert (process.wait(60), err) == (code, b"")
        process.stdin.close()
        process.stderr.close()


def test_interruption_is_130_without_a_traceback():
    process = started("odometry", "-", "--from", "velocities")
    process.stdin.write(b"0 1 0\n1 1 0\n")
    process.stdin.flush()
    head = b"".join(process.stdout.readline() for _ in range(3))
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out, err) == (130, b"", b"")
    assert head == b"t,x,y,theta\n0.0,0.0,0.0,0.0\n1.0,1.0,0.0,0.0\n"  # as they came, before the end


def test_interruption_at_any_moment_is_no_traceback():
    work = ["lab", "--duration", "700", "--within", "1e-9 m"]
    code = f"import sys; from coplanar.cli import main; sys.argv[1:] = {work}\n"
    for wait in (0.02, 0.1, 0.3, 0.6):
        command = [sys.executable, "-c", f"{code}print(flush=True); main()"]
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        with subprocess.Popen(command, env=environment(), **pipes) as process:
            process.stdout.readline()  # from here on Python belongs to the command
            time.sleep(wait)
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=60)
            assert (process.returncode, out, err) == (130, b"", b""), wait


def test_no_colour_in_a_pipe_nor_where_none_is_wanted():
    assert b"\x1b" not in shell(*BEYOND).stdout
    plain, coloured = (on_a_terminal(*BEYOND, env=env) for env in ({"NO_COLOR": "1"}, {}))
    assert re.search(r"\x1b\[[\d;]*3\dm", coloured)
    assert not re.search(r"\x1b\[[\d;]*3\dm", plain)


def test_progress_is_shown_on_a_terminal_only(tmp_path):
    log = tmp_path / "log"
    log.write_bytes(b"".join(b"%d 1 0\n" % i for i in range(1000)))
    command = ("odometry", log, "--from", "velocities", "-o", tmp_path / "out.csv")
    assert shell(*command).stderr == b""
    assert "poses" in on_a_terminal(*command)


def on_a_terminal(*args, env=None):
    """All that a command writes to a terminal."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "coplanar", *map(str, args)], stdin=theirs, stdout=theirs, stderr=theirs,
        env=environment(TERM="xterm-256color", **(env or {})),
    )  # fmt: skip
    os.close(theirs)
    text = b""
    try:
        while piece := os.read(ours, 65536):
            text += piece
    except OSError:  # the other end is closed
        pass
    os.close(ours)
    process.wait(60)
    return text.decode()


def completed(words, shell="bash"):
    """What completion offers for the last word."""
    env = {"_COPLANAR_COMPLETE": f"complete_{shell}", "COMP_WORDS": " ".join(words), "COMP_CWORD": str(len(words) - 1)}
    code = "import sys; sys.argv[0] = 'coplanar'; from coplanar.cli import main; main()"
    done = subprocess.run([sys.executable, "-c", code], env=environment(**env), capture_output=True, text=True)
    return done.stdout.split()


def test_completion_knows_commands_options_and_names():
    assert set(COMMANDS) <= set(completed(["coplanar", ""]))
    assert completed(["coplanar", "odom"]) == ["odometry"]
    assert completed(["coplanar", "ik", "--elb"]) == ["--elbow"]
    assert completed(["coplanar", "ik", "--elbow", ""]) == ["positive", "negative"]
    assert completed(["coplanar", "odometry", "--from", "ra"]) == ["rates"]
    assert set(completed(["coplanar", "wheels", ""])) == {"differential", "omni", "mecanum", "swerve", "table"}


def test_completion_can_be_shown():
    named = environment(_TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION="1")  # the shell is said, not looked for
    command = [sys.executable, "-m", "coplanar", "--show-completion", "bash"]
    done = subprocess.run(command, env=named, capture_output=True, check=True)
    assert b"COMPLETE=complete_bash" in done.stdout


def test_the_entry_point_is_there():
    project = Path(SOURCES).parent / "pyproject.toml"
    if project.exists():
        scripts = tomllib.loads(project.read_text())["project"]["scripts"]
        assert scripts == {"coplanar": "coplanar.cli:main"}
    assert callable(cli.main)
    assert isinstance(app, typer.Typer)
    with pytest.raises(AttributeError):
        _ = cli.nothing


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ("--q 1 -0.5 --json", "--q 1 --q -0.5 --json"),
        ("--q 30deg -pi/2 --links 1 2", "--q 30deg --q -pi/2 --links 1 --links 2"),
        ("--q=1 2 -x 3", "--q=1 --q 2 -x 3"),
        ("--q --links 1", "--q --links --q 1"),
        ("log --q 1 2024.csv", "log --q 1 2024.csv"),
        ("--q 1 log 2", "--q 1 log 2"),
        ("--q 1 2 -- 3", "--q 1 --q 2 -- 3"),
        ("--target -0.3 0.4", "--target -0.3 0.4"),
        ("--q 1,2 .5 (1+2)", "--q 1,2 --q .5 --q (1+2)"),
        ("", ""),
    ],
)
def test_lists_follow_their_option(given, expected):
    assert arguments.repeated(given.split(), ["--q", "--links"]) == expected.split()


def test_quantities_have_units_and_say_what_is_wrong():
    from coplanar.scenarios.quantities import ANGLE, LENGTH

    assert arguments.quantities("q", ["30 deg", "1,-0.5"], ANGLE) == pytest.approx((0.5235987755982988, 1.0, -0.5))
    assert arguments.quantities("target", ("12 in", "-1"), LENGTH, LENGTH) == pytest.approx((0.3048, -1.0))
    with pytest.raises(InvalidValue, match=r"q = '3 kg'"):
        arguments.quantities("q", ["3 kg"], ANGLE)
    with pytest.raises(InvalidValue, match=r"target = '1 2 3': needed 2 numbers"):
        arguments.quantities("target", ["1,2", "3"], LENGTH, LENGTH)
    assert arguments.maybe("q", None, ANGLE) is None


def test_what_a_terminal_would_obey_is_shown_and_not_done():
    log = b"a\x1b[31m,b\x07,c\x9b2J\n1,2,3\n"
    for err in (
        run("odometry", "-", "--from", "velocities", data=log)[2],
        run("fk", "--links", "\x1b[2J", "--q", "1")[2],
    ):
        assert "\\x1b" in err
        assert all(c.isprintable() or c == "\n" for c in err)
    out = run("wheels", "table", "--wheel", "0,0.2,0,0.1,l\x1b[31m", "0,-0.2,0,0.1,right")[1]
    assert "l\\x1b[31m" in out
    assert "\x1b" not in out
