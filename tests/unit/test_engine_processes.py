"""The engine in a process of its own: what it loads; without Numba, without a cache, with an old one, after a fork."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import coplanar
from tests.engines import NEEDS_NUMBA

PACKAGE = Path(coplanar.__file__).parent
HEAVY = ("numba", "llvmlite", "scipy", "jax", "sympy", "matplotlib", "pandas", "typer", "rich", "mpmath")

BATCH = """
import numpy as np
from coplanar.engine import evaluator
from coplanar.laws import se2
numbers = np.linspace(-2.0, 2.0, 30_000)
answer = evaluator(se2.coordinate)(numbers, numbers, 1.0, 0.25)
print(float(answer[0]), evaluator(se2.coordinate)._kernel is not None)
"""


def run(code, *arguments, source=PACKAGE.parent, cache=None, path=()):
    """What a fresh interpreter prints, without the white space at its ends."""
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join(map(str, (*path, source))), PYTHONWARNINGS="error")
    if cache is not None:
        environment["COPLANAR_CACHE"] = str(cache)
    done = subprocess.run(
        [sys.executable, "-c", code, *map(str, arguments)], env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


@pytest.fixture
def copy_of_the_package(tmp_path):
    """A source folder whose laws a test may edit."""
    shutil.copytree(PACKAGE, tmp_path / "src" / "coplanar", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path / "src"


def change_a_sign(source):
    """Edit the law ``coordinate`` on disk."""
    laws = source / "coplanar" / "laws" / "se2.py"
    text = laws.read_text()
    assert "px * ax + py * ay" in text
    laws.write_text(text.replace("px * ax + py * ay", "px * ax - py * ay"))


def test_import_loads_numpy_at_most():
    code = f"import coplanar, sys; print(*(m for m in {HEAVY!r} if m in sys.modules))"
    assert run(code) == ""


def test_a_pose_loads_numpy_and_nothing_heavier():
    code = "from coplanar import Pose; import sys; print('numpy' in sys.modules, *(m for m in {} if m in sys.modules))"
    assert run(code.format(HEAVY)) == "True"


def test_a_small_batch_loads_nothing_more():
    code = f"""
import sys, numpy as np
from coplanar import Pose
T = Pose(np.zeros(1000), 1.0, 0.5)
T @ T.inverse() @ (1.0, 2.0)
print(*(m for m in {HEAVY!r} if m in sys.modules))
"""
    assert run(code) == ""


def test_without_numba_the_numpy_text_answers():
    assert run("import sys; sys.modules['numba'] = None\n" + BATCH) == "-2.5 False"


def test_with_a_numba_that_does_not_fit_the_numpy_text_answers(tmp_path):
    (tmp_path / "numba.py").write_text("raise ImportError('Numba needs another NumPy')\n")
    assert run(BATCH, path=[tmp_path]) == "-2.5 False"


@NEEDS_NUMBA
def test_a_cache_that_cannot_be_written_is_no_cache(tmp_path):
    file = tmp_path / "a file"
    file.touch()
    assert run(BATCH, cache=file) == "-2.5 True"
    assert run(BATCH, cache=file / "inside") == "-2.5 True"


@NEEDS_NUMBA
def test_a_cache_that_goes_away_is_no_cache(tmp_path):
    """And nothing is written elsewhere, such as beside the sources, where no edit would be noticed."""
    code = f"""
import shutil
from coplanar.engine.compiled import cache
path = cache.folder()
with cache.in_folder() as writeable:
    print(writeable)
shutil.rmtree(path)
path.touch()
with cache.in_folder() as writeable:
    print(writeable)
{BATCH}
"""
    assert run(code, cache=tmp_path / "cache").split() == ["True", "False", "-2.5", "True"]


@NEEDS_NUMBA
def test_a_full_disk_is_no_error(tmp_path):
    code = f"""
from numba.core.caching import IndexDataCacheFile
def full(self, key, data):
    print("full")
    raise OSError(28, "No space left on device")
IndexDataCacheFile.save = full
{BATCH}
"""
    assert run(code, cache=tmp_path / "cache").split() == ["full", "-2.5", "True"]


@NEEDS_NUMBA
def test_a_cached_loop_is_used_again(tmp_path):
    cache = tmp_path / "cache"
    assert run(BATCH, cache=cache) == "-2.5 True"
    kept = {file: file.stat().st_mtime_ns for file in cache.rglob("*.nb*")}
    assert kept
    assert run(BATCH, cache=cache) == "-2.5 True"
    assert {file: file.stat().st_mtime_ns for file in cache.rglob("*.nb*")} == kept


@NEEDS_NUMBA
def test_an_edited_law_answers_anew(copy_of_the_package, tmp_path):
    cache = tmp_path / "cache"
    assert run(BATCH, source=copy_of_the_package, cache=cache) == "-2.5 True"
    change_a_sign(copy_of_the_package)
    assert run(BATCH, source=copy_of_the_package, cache=cache) == "-1.5 True"


@NEEDS_NUMBA
def test_a_law_that_is_edited_under_a_running_process_does_not_spoil_the_cache(copy_of_the_package, tmp_path):
    """The process compiles what it has in memory; the next one must not take that for the law on disk."""
    cache = tmp_path / "cache"
    edit = f"""
import sys
sys.path.insert(0, {str(Path(__file__).parents[2])!r})
from pathlib import Path
import coplanar.laws.se2
from tests.unit.test_engine_processes import change_a_sign
change_a_sign(Path(sys.argv[1]))
"""
    assert run(edit + BATCH, copy_of_the_package, source=copy_of_the_package, cache=cache) == "-2.5 True"
    assert run(BATCH, source=copy_of_the_package, cache=cache) == "-1.5 True"


@NEEDS_NUMBA
def test_two_laws_of_one_name_do_not_share_a_loop(tmp_path):
    code = """
import numpy as np
from coplanar.engine import evaluator
FACTOR = {factor}
def scaled(x):
    return {text}
print(evaluator(scaled).on_compiled(np.ones(3))[0])
"""
    for factor, text, right in ((2.0, "FACTOR * x", "2.0"), (3.0, "FACTOR * x", "3.0"), (3.0, "FACTOR - x", "2.0")):
        assert run(code.format(factor=factor, text=text), cache=tmp_path) == right


@NEEDS_NUMBA
@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
def test_a_forked_child_computes_after_its_parent_used_threads(tmp_path):
    code = """
import os, warnings
import numpy as np
from coplanar.engine import evaluator
from coplanar.laws import se2
warnings.simplefilter("ignore", DeprecationWarning)  # Python 3.12 warns of any fork beside threads
angle = np.linspace(-3.0, 3.0, 250_000)
right = evaluator(se2.rotate).on_text(angle, 1.0, 2.0)
def fine():
    found = evaluator(se2.rotate)(angle, 1.0, 2.0)
    return all(np.allclose(a, b, rtol=0.0, atol=1e-14) for a, b in zip(found, right, strict=True))
print(fine())
child = os.fork()
if child == 0:
    os._exit(0 if fine() else 1)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), fine())
"""
    assert run(code, cache=tmp_path).split() == ["True", "0", "True"]
