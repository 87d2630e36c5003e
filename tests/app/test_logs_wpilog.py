"""WPILOG against WPILib's own reader and writer."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar.errors import InvalidValue
from coplanar.logs import read_log, write_log
from coplanar.logs.wpilog import SCHEMAS
from coplanar.logs.wpilog_records import MAGIC, entries_of, finish, header, record, start
from coplanar.run import Run
from tests.app.logs import BATCH, RUNS, T, unicycle

log = pytest.importorskip("wpiutil.log")


VALUES = {"double": "getDouble", "double[]": "getDoubleArray", "json": "getString"}


def records_of(path):
    """(stamp, value) of every record by WPILib's reader, by the names of the entries, and the names' types."""
    reader = log.DataLogReader(str(path))
    assert reader.isValid()
    assert reader.getVersion() == 0x0100
    names, types, found, finished = {}, {}, {}, set()
    for one in reader:
        if one.isStart():
            data = one.getStartData()
            names[data.entry], types[data.name], found[data.name] = data.name, data.type, []
        elif one.isFinish():
            finished.add(names[one.getFinishEntry()])
        else:
            name = names[one.getEntry()]
            value = getattr(one, VALUES.get(types[name], "getRaw"))()
            found[name].append((one.getTimestamp(), bytes(value) if types[name] not in VALUES else value))
    assert finished == set(found)
    return found, types


@pytest.mark.parametrize("name", [name for name in RUNS if name != "diverged"])
def test_wpilib_reads_every_column_to_the_bit(tmp_path, name):
    run = RUNS[name]
    found, types = records_of(write_log(run, tmp_path / "run.wpilog"))
    for column, values in run.columns.items():
        assert types[f"/columns/{column}"] == "double"
        assert [value for _, value in found[f"/columns/{column}"]] == values.tolist()
    begin = min(0.0, float(run.t.min()))
    stamps = [stamp for stamp, _ in found[f"/columns/{run.index}"]]
    assert stamps == np.rint((run.t - begin) * 1e6).astype(int).tolist()
    ((_, described),) = found["/run"]
    assert types["/run"] == "json"
    assert json.loads(described)["status"] == "COMPLETE"


def test_poses_and_speeds_are_wpilibs_structs(tmp_path):
    geometry = pytest.importorskip("wpimath.geometry")
    kinematics = pytest.importorskip("wpimath.kinematics")
    wpistruct = pytest.importorskip("wpiutil.wpistruct")
    run = unicycle()
    found, types = records_of(write_log(run, tmp_path / "run.wpilog"))
    assert (types["/pose"], types["/speeds"]) == ("struct:Pose2d", "struct:ChassisSpeeds")
    for i, ((_, pose), (_, speeds)) in enumerate(zip(found["/pose"], found["/speeds"], strict=True)):
        assert struct.unpack("<ddd", pose) == (run["x"][i], run["y"][i], run["theta"][i])
        unpacked = wpistruct.unpack(geometry.Pose2d, pose)
        assert (unpacked.x, unpacked.y) == (run["x"][i], run["y"][i])
        assert unpacked.rotation().radians() == pytest.approx(run["theta"][i], abs=1e-15)
        twist = wpistruct.unpack(kinematics.ChassisSpeeds, speeds)
        assert (twist.vx, twist.vy, twist.omega) == (run["v"][i], 0.0, run["omega"][i])
    for kind in (geometry.Pose2d, geometry.Rotation2d, geometry.Translation2d, kinematics.ChassisSpeeds):
        name = wpistruct.getTypeName(kind)
        assert SCHEMAS[name] == wpistruct.getSchema(kind)
        ((_, schema),) = found[f"/.schema/struct:{name}"]
        assert types[f"/.schema/struct:{name}"] == "structschema"
        assert schema.decode() == wpistruct.getSchema(kind)


def test_body_speeds_joints_and_batches(tmp_path):
    body = RUNS["body"]
    found, _ = records_of(write_log(body, tmp_path / "run.wpilog"))
    assert struct.unpack("<ddd", found["/speeds"][7][1]) == (body["vx"][7], body["vy"][7], body["omega"][7])
    arm = RUNS["arm"]
    found, types = records_of(write_log(arm, tmp_path / "run.wpilog"))
    assert types["/joints"] == "double[]"
    assert list(found["/joints"][5][1]) == arm.states[5].tolist()
    assert "/pose" not in found
    found, types = records_of(write_log(BATCH, tmp_path / "run.wpilog"))
    assert (types["/pose"], types["/columns/x"], types["/columns/t"]) == ("struct:Pose2d[]", "double[]", "double")
    assert list(found["/columns/x"][4][1]) == BATCH["x"][4].ravel().tolist()
    poses = np.frombuffer(found["/pose"][4][1]).reshape(3, 2, 3)
    np.testing.assert_array_equal(poses[..., 0], BATCH["x"][4])
    np.testing.assert_array_equal(poses[..., 1], np.broadcast_to(BATCH["y"][4], (3, 2)))
    assert (poses[..., 2] == T[4]).all()


def test_a_fleet_of_many_and_a_long_run(tmp_path):
    """Lengths of two and three bytes, stamps of five."""
    run = Run({"t": [0.0, 5000.0], "x": np.arange(2.0 * 9000).reshape(2, 9000)})
    found, _ = records_of(write_log(run, tmp_path / "run.wpilog"))
    assert found["/columns/x"][1][0] == 5_000_000_000
    assert list(found["/columns/x"][1][1]) == run["x"][1].tolist()
    many = Run({"t": [0.0, 1.0], **{f"c{i}": [i, i + 0.5] for i in range(300)}})
    found, _ = records_of(write_log(many, tmp_path / "run.wpilog"))
    assert found["/columns/c299"][1][1] == 299.5
    assert read_log(tmp_path / "run.wpilog")["c299"].tolist() == [299.0, 299.5]


def test_the_examples_of_the_specification():
    assert header().hex(" ") == "57 50 49 4c 4f 47 00 01 00 00 00 00"
    value = record(1, 1_000_000, (3).to_bytes(8, "little"))
    assert value.hex(" ") == "20 01 08 40 42 0f 03 00 00 00 00 00 00 00"
    begun = start(1, "test", "int64", 1_000_000)
    assert len(begun) == 32
    assert begun.hex(" ").startswith("20 00 1a 40 42 0f 00 01 00 00 00 04 00 00 00 74 65 73 74 05 00 00 00")
    assert finish(1, 1_000_000).hex(" ") == "20 00 05 40 42 0f 01 01 00 00 00"


LENGTHS = st.tuples(st.integers(2, 4), st.integers(2, 4), st.integers(3, 8))


@given(st.lists(st.tuples(st.integers(1, 3), LENGTHS, st.integers(0, 2**24 - 1), st.binary(max_size=300)), max_size=12))
@settings(deadline=None, max_examples=40)
def test_integers_of_any_length_as_wpilibs_reader_reads_them(tmp_path_factory, rows):
    data = header("made by hand") + b"".join(start(i, f"/{i}", "raw", 0) for i in (1, 2, 3))
    for entry, lengths, stamp, payload in rows:
        parts = zip((entry, len(payload), stamp), lengths, strict=True)
        bits = (lengths[0] - 1) | (lengths[1] - 1) << 2 | (lengths[2] - 1) << 4
        data += bytes([bits]) + b"".join(value.to_bytes(size, "little") for value, size in parts) + payload
    entries = entries_of(Path("any"), data)
    theirs = {name: b"" for name in entries}
    path = tmp_path_factory.mktemp("any") / "any.wpilog"
    path.write_bytes(data)
    for one in log.DataLogReader(str(path)):
        if not one.isControl():
            theirs[f"/{one.getEntry()}"] += bytes(one.getRaw())
    assert {name: bytes(entry.payload) for name, entry in entries.items()} == theirs
    assert sum(entry.count for entry in entries.values()) == len(rows)


FIRST = header() + start(1, "/run", "json", 0)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "byte 0 of .*header"),
        (b"WPILOGG" * 5, "byte 6 of .*version"),
        (MAGIC + b"\x00\x01\xff\xff\xff\xff", "byte 8 of .*4294967295 bytes"),
        (FIRST[:-1], "byte 12 of .*the file ends"),
        (header() + b"\x7f", "byte 12 of .*the file ends"),
        (header() + b"\x0c\x01\xff\xff\xff\xff\x00", "byte 12 of .*4294967"),
        (header() + record(7, 0, b"12345678"), "byte 12 of .*entry 7.*starts"),
        (header() + record(0, 0, b"\x03\x00\x00\x00\x00"), "byte 12 of .*control record"),
        (header() + record(0, 0, b""), "byte 12 of .*control record"),
        (header() + finish(3, 0), "byte 12 of .*entry 3"),
        (header() + record(0, 0, b"\x00\x01\x00\x00\x00\xff\xff\xff\x7fxx"), "byte 12 of .*a text of 2147483647"),
        (header() + record(0, 0, b"\x00\x01\x00\x00\x00\x01\x00\x00\x00\xff" + bytes(8)), "byte 12 of .*UTF-8"),
        (FIRST + start(2, "/run", "json", 0), "not taken"),
        (FIRST + start(1, "/other", "json", 0), "not taken"),
        (FIRST, "line 1 of"),
        (header() + start(1, "/run", "double", 0), "an entry /run"),
        (FIRST + record(1, 0, b"{}") + start(2, "/columns/t", "float", 0), "entry /columns/t .*doubles"),
        (
            FIRST + record(1, 0, b"{}") + start(2, "/columns/t", "double[]", 0)
            + record(2, 0, bytes(8)) + record(2, 0, bytes(16)), "as many in every record",
        ),
        (
            FIRST + record(1, 0, b"{}") + start(2, "/columns/t", "double", 0) + record(2, 0, bytes(7)),
            "column 't' of .*7 bytes in 1 rows",
        ),
    ],
)  # fmt: skip
def test_logs_that_break_off_or_lie(tmp_path, data, words):
    path = tmp_path / "bad.wpilog"
    path.write_bytes(data)
    with pytest.raises(InvalidValue, match=words):
        read_log(path)


@pytest.mark.parametrize("shape", [[-1], [1e3], ["2"], 2, [10**9] * 5, [0] * 100, [True]])
def test_shapes_are_not_believed(tmp_path, shape):
    path = write_log(BATCH, tmp_path / "run.wpilog")
    text = json.dumps({"coplanar": 1, "shapes": {"t": [], "x": shape}}).encode()
    entries = FIRST + record(1, 0, text) + start(2, "/columns/x", "double[]", 0) + record(2, 0, bytes(16))
    path.write_bytes(entries)
    with pytest.raises(InvalidValue, match="column 'x'"):
        read_log(path)


def test_metadata_is_passed_over_and_numbers_may_be_used_again(tmp_path):
    path = tmp_path / "run.wpilog"
    parts = write_log(Run({"t": [0.0, 1.0]}), path).read_bytes()
    more = start(9, "/note", "string", 0) + record(0, 0, b"\x02\x09\x00\x00\x00\x02\x00\x00\x00{}")
    path.write_bytes(parts + more + finish(9, 0) + start(9, "/other", "raw", 0) + record(9, 0, b"abc"))
    assert read_log(path)["t"].tolist() == [0.0, 1.0]
