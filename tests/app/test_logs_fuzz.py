"""Readers of files hold against anything: a run, or a refusal that names the file; nothing else, and soon."""

from __future__ import annotations

import json
import math
import tracemalloc

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from coplanar import Arm
from coplanar.errors import CoplanarError
from coplanar.logs import read_choreo, read_log, read_path, read_urdf, write_log, write_urdf
from coplanar.run import KINDS, Kind, Run, RunStatus
from tests.app.logs import RUNS, same, same_numbers
from tests.app.test_logs_choreo import swerve

NEEDS = {"mcap": "mcap_ros2", "parquet": "pyarrow"}
READERS = {
    "csv": read_log, "json": read_log, "mcap": read_log, "parquet": read_log, "wpilog": read_log,
    "traj": read_choreo, "txt": read_path, "urdf": read_urdf,
}  # fmt: skip
TROUBLE = [
    b"", b"\x00" * 4, b"\xff" * 4,
    b"\xff\xff\xff\x7f", b"\x00\x00\x00\x80", b"1e999", b"nan", b"null", b"-1", b"[", b"{",
    b"<", b'"', b"\n", b",", b"9" * 400, b"\xef\xbb\xbf", b"\\ud800",
]  # fmt: skip
EXAMPLES = settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.too_slow])


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("fuzz")


@pytest.fixture(scope="module")
def valid(folder):
    """Whole files of every kind."""

    def make(suffix):
        if suffix == "traj":
            return [json.dumps({"name": "a", "version": 1, "trajectory": {"samples": swerve()[:4]}}).encode()]
        if suffix == "txt":
            return [b"# x, y, theta\nx,y,yaw\n0,1,2\n1,2,3\n4,5,6\n", b"0 1\n2 3\n"]
        if suffix == "urdf":
            arm = Arm((1.0, 0.5, 0.2), joints="RPR", limits=[(-1.0, 1.0)] * 3)
            return [write_urdf(arm, folder / "whole.urdf").read_bytes()]
        return [
            write_log(RUNS[name], folder / f"whole.{suffix}").read_bytes() for name in ("unicycle", "arm", "diverged")
        ]

    return make


def holds(path, reader):
    """It is read, or refused by the file's name."""
    try:
        return reader(path)
    except CoplanarError as error:
        refusal = str(error)
    assert str(path) in refusal
    return None


CUT = st.tuples(st.floats(0.0, 1.0), st.integers(0, 40), st.sampled_from(TROUBLE), st.booleans())


@pytest.mark.parametrize("suffix", READERS)
@given(data=st.data())
@EXAMPLES
def test_bytes_changed_in_a_whole_file(folder, valid, suffix, data):
    """Pieces cut out, put in, written over, twice there."""
    pytest.importorskip(NEEDS.get(suffix, "json"))
    content = data.draw(st.sampled_from(valid(suffix)))
    for where, length, put, over in data.draw(st.lists(CUT, min_size=1, max_size=4)):
        place = round(where * len(content))
        put = put or content[place // 2 : place // 2 + length]
        content = content[:place] + put + content[place + (len(put) if over else length) :]
    path = folder / f"changed.{suffix}"
    path.write_bytes(content)
    holds(path, READERS[suffix])


@pytest.mark.parametrize("suffix", READERS)
@given(where=st.floats(0.0, 1.0, exclude_max=True), bit=st.integers(0, 7))
@EXAMPLES
def test_one_bit_and_the_end(folder, valid, suffix, where, bit):
    pytest.importorskip(NEEDS.get(suffix, "json"))
    for whole in valid(suffix):
        place = int(where * len(whole))
        path = folder / f"bit.{suffix}"
        path.write_bytes(whole[:place])
        holds(path, READERS[suffix])
        path.write_bytes(whole[:place] + bytes([whole[place] ^ 1 << bit]) + whole[place + 1 :])
        holds(path, READERS[suffix])


@pytest.mark.parametrize("suffix", ["mcap", "parquet"])
@given(where=st.floats(0.0, 1.0, exclude_max=True), bit=st.integers(0, 7))
@EXAMPLES
def test_checksums_keep_the_numbers(folder, valid, suffix, where, bit):
    """A file with a wrong bit is refused, or has the numbers that were written."""
    pytest.importorskip(NEEDS[suffix])
    whole = valid(suffix)[0]
    place = int(where * len(whole))
    path = folder / f"sum.{suffix}"
    path.write_bytes(whole[:place] + bytes([whole[place] ^ 1 << bit]) + whole[place + 1 :])
    run = holds(path, read_log)
    if run is not None:
        for name, values in RUNS["unicycle"].columns.items():
            if name in run.columns:
                np.testing.assert_array_equal(run[name], values)


@pytest.mark.parametrize("suffix", READERS)
@given(content=st.binary(max_size=400))
@settings(deadline=None, max_examples=40)
def test_any_bytes(folder, suffix, content):
    pytest.importorskip(NEEDS.get(suffix, "json"))
    path = folder / f"any.{suffix}"
    path.write_bytes(content)
    holds(path, READERS[suffix])


NUMBERS = st.floats() | st.integers() | st.booleans() | st.none()
ANYTHING = st.recursive(
    NUMBERS | st.text(max_size=5), lambda held: st.lists(held, max_size=3) | st.dictionaries(st.text(max_size=3), held),
    max_leaves=8,
)  # fmt: skip
COLUMN = st.lists(NUMBERS, max_size=4) | st.lists(st.floats(-9.0, 9.0), min_size=2, max_size=2) | ANYTHING
DESCRIBED = st.fixed_dictionaries(
    {
        "columns": st.fixed_dictionaries({"t": st.just([0.0, 1.0]) | COLUMN}, optional={"x": COLUMN, "q1": COLUMN})
        | ANYTHING
    },
    optional={
        "coplanar": st.just(1) | ANYTHING,
        "kind": st.sampled_from([*KINDS]) | ANYTHING,
        "index": st.just("t") | ANYTHING,
        "status": st.sampled_from([*RunStatus.__members__]) | ANYTHING,
        "warnings": st.lists(st.text(max_size=3)) | ANYTHING,
        "info": ANYTHING,
    },
)
SAMPLE = st.fixed_dictionaries(
    {}, optional={name: NUMBERS for name in ("t", "x", "y", "heading", "vx", "vy", "omega", "vl")}
)
TRAJECTORY = st.fixed_dictionaries(
    {}, optional={"version": st.just(1) | ANYTHING, "name": ANYTHING, "trajectory": st.fixed_dictionaries(
        {}, optional={"samples": st.lists(SAMPLE | ANYTHING, max_size=3) | ANYTHING, "waypoints": ANYTHING})}
)  # fmt: skip


@pytest.mark.parametrize(("suffix", "table"), [("json", DESCRIBED), ("traj", TRAJECTORY)], ids=["json", "traj"])
@given(data=st.data())
@EXAMPLES
def test_json_of_any_structure(folder, suffix, table, data):
    path = folder / f"structure.{suffix}"
    path.write_text(json.dumps(data.draw(table)), encoding="utf-8")
    holds(path, READERS[suffix])


CELL = st.sampled_from(
    ["0", "1", "-2.5", "1e-3", "1e999", "nan", "", "x", "y", "theta", "t", '"', "#", "x_ft", "1_0", "½"]
)
MARK = st.sampled_from([",", ", ", ";", "\t", " ", "\n", "\r\n", "\n\n", "\r", "\x85", "#"])


@pytest.mark.parametrize("suffix", ["csv", "txt"])
@given(words=st.lists(st.tuples(CELL, MARK), max_size=30))
@EXAMPLES
def test_tables_of_any_structure(folder, suffix, words):
    path = folder / f"structure.{suffix}"
    path.write_bytes("".join(cell + mark for cell, mark in words).encode())
    holds(path, READERS[suffix])


LINK = st.sampled_from(["a", "b", "c", "d"])
WORD = st.sampled_from(["0", "1", "-1", "0.5", "1.5707963267948966", "3", "1e308", "-1e-320", "nan", "x", "1e999"])
VECTOR = st.lists(st.sampled_from(["0", "1", "0", "-1", "0.5"]) | WORD, min_size=3, max_size=3).map(" ".join)
KIND = st.sampled_from(["revolute", "continuous", "prismatic", "fixed", "floating"])
JOINT = st.tuples(st.integers(0, 5), KIND, LINK, LINK, VECTOR, VECTOR, VECTOR, WORD, WORD)


@given(joints=st.lists(JOINT, max_size=5), in_a_row=st.booleans(), tip=st.none() | LINK)
@EXAMPLES
def test_urdf_of_any_structure(folder, joints, in_a_row, tip):
    text = ['<robot name="r">', *(f'<link name="{link}"/>' for link in "abcdef")]
    for i, (number, kind, parent, child, xyz, rpy, axis, low, high) in enumerate(joints):
        ends = ("abcdef"[i], "abcdef"[i + 1]) if in_a_row else (parent, child)
        text.append(
            f'<joint name="j{number}" type="{kind}"><parent link="{ends[0]}"/><child link="{ends[1]}"/>'
            f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/><limit lower="{low}" upper="{high}"/></joint>'
        )
    path = folder / "structure.urdf"
    path.write_text("\n".join([*text, "</robot>"]), encoding="utf-8")
    found = holds(path, lambda file: read_urdf(file, tip=tip))
    if found is not None:
        place = found.arm.forward(found.joints(np.zeros(len(found.names))))
        assert math.isfinite(place.x) or max(map(abs, found.plane.ravel())) > 1e100 or sum(found.arm.links) > 1e100


NAMES = st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=6).filter(
    lambda name: name == name.strip() and not set(name) & set(',"\n\r') and not name.startswith("\ufeff")
)
INFO = st.dictionaries(st.text(max_size=4), st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(max_size=5),
    lambda held: st.lists(held, max_size=3) | st.dictionaries(st.text(max_size=3), held, max_size=3), max_leaves=5,
), max_size=3)  # fmt: skip


@st.composite
def runs(draw, batches=True):
    """Runs of any kind, names, numbers."""
    rows = draw(st.integers(1, 4))
    finite = draw(st.booleans())
    number = st.floats(allow_nan=not finite, allow_infinity=not finite)
    index = draw(NAMES)
    times = draw(st.lists(st.floats(-1e6, 1e6), min_size=rows, max_size=rows, unique=True))
    columns = {index: sorted(times, reverse=draw(st.booleans()))}
    for name in draw(
        st.lists(NAMES | st.sampled_from(["x", "y", "theta", "v", "vx", "vy", "omega", "q1"]), max_size=6)
    ):
        shape = draw(st.sampled_from([(rows,), (rows, 2), (rows, 2, 2)] if batches else [(rows,)]))
        columns.setdefault(
            name, np.array(draw(st.lists(number, min_size=math.prod(shape), max_size=math.prod(shape)))).reshape(shape)
        )
    own = Kind(tuple(draw(st.lists(NAMES, max_size=2))), held=tuple(columns)[:1])
    return Run(
        columns, draw(st.sampled_from([*KINDS, own])), index=index,
        status=RunStatus.COMPLETE if finite else RunStatus.DIVERGED,
        warnings=draw(st.lists(st.text(max_size=5), max_size=2)), info=draw(INFO),
    )  # fmt: skip


@pytest.mark.parametrize("format", ["csv", "json", "mcap", "parquet", "wpilog"])
@given(data=st.data())
@EXAMPLES
def test_any_run_comes_back(folder, format, data):
    pytest.importorskip(NEEDS.get(format, "json"))
    run = data.draw(runs(batches=format not in ("csv", "mcap")))
    path = write_log(run, folder / f"any-run.{format}")
    if format == "csv":
        same_numbers(run, read_log(path, index=run.index))
    else:
        same(run, read_log(path))


@pytest.mark.parametrize("suffix", ["wpilog", "mcap", "json", "csv", "txt", "urdf"])
def test_memory_goes_with_the_file_not_with_what_it_says(folder, valid, suffix):
    """Lengths of gigabytes in a file of kilobytes cost kilobytes."""
    pytest.importorskip(NEEDS.get(suffix, "json"))
    whole = valid(suffix)[0]
    holds_before = folder / f"memory.{suffix}"
    holds_before.write_bytes(whole)
    holds(holds_before, READERS[suffix])
    tracemalloc.start()
    try:
        for place in range(0, len(whole), max(1, len(whole) // 150)):
            holds_before.write_bytes(whole[:place] + b"\xff\xff\xff\x7f" + whole[place + 4 :])
            holds(holds_before, READERS[suffix])
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 8e6 + 50 * len(whole)
