"""Memory of large results: used again when nobody holds it, and never before."""

from __future__ import annotations

import gc
import subprocess
import sys
import threading

import numpy as np
import pytest

from coplanar import Displacement, Pose, checks
from coplanar.engine import memory

ROWS = memory.LARGE // 8


@pytest.fixture(autouse=True)
def _nothing_waits():
    memory._waiting.clear()
    yield
    memory._waiting.clear()


def place(array):
    return array.__array_interface__["data"][0]


def test_what_nobody_holds_is_used_again():
    first = memory.empty((ROWS,))
    there = place(first)
    del first
    assert place(memory.empty((2, ROWS // 2))) == there


def test_what_a_view_holds_is_not():
    first = memory.empty((2, ROWS))
    view = first[1, 3:5]
    view[:] = 7.0
    there = place(first)
    del first
    second = memory.empty((2, ROWS))
    second[:] = 0.0
    assert place(second) != there
    assert view.tolist() == [7.0, 7.0]


def test_a_little_longer_memory_serves_and_much_longer_does_not():
    first = memory.empty((ROWS + ROWS // 8,))
    there = place(first)
    del first
    second = memory.empty((ROWS,))
    assert place(second) == there
    assert second.shape == (ROWS,)
    del second
    long = memory.empty((4 * ROWS,))
    there = place(long)
    del long
    assert place(memory.empty((2 * ROWS,))) != there


def test_no_more_waits_than_is_said():
    held = [memory.empty((memory.KEPT // 24,)) for _ in range(5)]
    del held
    gc.collect()
    assert 0 < sum(m.nbytes for m in memory._waiting.values()) <= memory.KEPT


def test_less_than_a_large_result_comes_from_the_heap():
    assert memory.empty((ROWS - 1,)).base is None


def test_a_type_of_its_own():
    assert memory.empty((ROWS * 2,), np.float32).dtype == np.float32


def test_a_read_only_result_stays_so():
    result = memory.empty((ROWS,))
    assert result.flags.writeable
    result.flags.writeable = False
    with pytest.raises(ValueError, match="WRITEABLE"):
        result.flags.writeable = True
    assert checks.frozen(result) is result


def test_a_result_that_may_be_written_is_copied_by_what_keeps_it():
    result = memory.empty((ROWS,))
    result[:] = 1.0
    pose = Pose(result, 0.0, 0.0)
    result[:] = 2.0
    assert pose.x[0] == 1.0


def test_results_of_calls_do_not_meet():
    way = Displacement(np.ones(ROWS), 0.0, 0.0)
    first = Pose(np.zeros(ROWS), 0.0, 0.0).step(way)
    second = first.step(way)
    kept = first.x
    del first
    third = second.step(way)
    assert (kept[0], second.x[0], third.x[0]) == (1.0, 2.0, 3.0)


def test_threads_do_not_get_the_same_memory():
    wrong = []

    def work(number):
        for _ in range(200):
            mine = memory.empty((ROWS,))
            mine[::4096] = number
            if not (mine[::4096] == number).all():
                wrong.append(number)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_a_program_may_end_while_it_holds_results():
    code = "from coplanar.engine import memory\nheld = memory.empty((1 << 20,))\nheld[:] = 1.0"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
