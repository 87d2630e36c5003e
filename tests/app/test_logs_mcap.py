"""MCAP against two independent readers: mcap-ros2-support and rosbags."""

from __future__ import annotations

import io
import json
import math

import numpy as np
import pytest

from coplanar.errors import InvalidValue
from coplanar.logs import read_log, write_log
from coplanar.logs.ros import definition
from coplanar.run import Run
from tests.app.logs import RUNS, same

reader = pytest.importorskip("mcap.reader")
decoder = pytest.importorskip("mcap_ros2.decoder")
writer = pytest.importorskip("mcap_ros2.writer")

BASE_TOPICS = {"/pose": "PoseStamped", "/odom": "Odometry", "/tf": "TFMessage", "/path": "Path"}
TOPICS = {
    "unicycle": BASE_TOPICS,
    "body": BASE_TOPICS,
    "arm": {"/joint_states": "JointState", "/tool_point": "PointStamped", "/path": "Path"},
    "arm with heading": {
        "/joint_states": "JointState", "/tool_pose": "PoseStamped", "/tf": "TFMessage", "/path": "Path"
    },
    "flight": {"/odom": "Odometry", "/tf": "TFMessage", "/path": "Path"},
    "table": {},
}  # fmt: skip


def by_mcap_ros2(path):
    """Decoded messages and their types by topic, as mcap-ros2-support has them."""
    found, types = {}, {}
    with path.open("rb") as file:
        log = reader.make_reader(file, validate_crcs=True, decoder_factories=[decoder.DecoderFactory()])
        for schema, channel, message, decoded in log.iter_decoded_messages():
            found.setdefault(channel.topic, []).append((message.log_time, decoded))
            types[channel.topic] = schema.name
        (metadata,) = log.iter_metadata()
    return found, types, json.loads(metadata.metadata["json"])


def by_rosbags(path):
    """Decoded messages and their types by topic, as rosbags has them."""
    anyreader = pytest.importorskip("rosbags.highlevel").AnyReader
    found, types = {}, {}
    with anyreader([path]) as log:
        for connection, stamp, raw in log.messages():
            found.setdefault(connection.topic, []).append((stamp, log.deserialize(raw, connection.msgtype)))
            types[connection.topic] = connection.msgtype
    return found, types, None


READERS = {"mcap-ros2-support": by_mcap_ros2, "rosbags": by_rosbags}


@pytest.fixture(params=READERS)
def opened(request, tmp_path):
    return lambda run: READERS[request.param](write_log(run, tmp_path / "run.mcap"))


def heading_of(turn):
    assert turn.x == turn.y == 0.0
    assert math.hypot(turn.z, turn.w) == pytest.approx(1.0, abs=1e-15)
    return 2.0 * math.atan2(turn.z, turn.w)


def stamp_of(header):
    return header.stamp.sec * 1_000_000_000 + header.stamp.nanosec


@pytest.mark.parametrize("name", TOPICS)
def test_each_kind_has_its_topics(opened, name):
    run = RUNS[name]
    found, types, said = opened(run)
    wanted = TOPICS[name] | {f"/columns/{column}": "Float64" for column in run.columns}
    assert {topic: kind.split("/")[-1] for topic, kind in types.items()} == wanted
    assert all(kind.split("/")[1] == "msg" for kind in types.values())
    for column, values in run.columns.items():
        rows = sorted(found[f"/columns/{column}"], key=lambda row: -row[0]) if name == "table" else found[
            f"/columns/{column}"
        ]  # fmt: skip
        assert [message.data for _, message in rows] == values.tolist()
    assert said is None or said["kind"] == (run.kind if isinstance(run.kind, str) else run.kind._asdict() | {
        "states": ["h*"], "angles": ["höhe"], "commands": [], "errors": [], "held": []
    })  # fmt: skip


@pytest.mark.parametrize("name", ["unicycle", "body"])
def test_a_robot_on_the_ground(opened, name):
    run = RUNS[name]
    found, _, _ = opened(run)
    forward = run["v" if name == "unicycle" else "vx"]
    left = np.zeros(len(run)) if name == "unicycle" else run["vy"]
    for i, t in enumerate(run.t):
        (at, pose), (_, odometry), (_, tf) = (found[topic][i] for topic in ("/pose", "/odom", "/tf"))
        (transform,) = tf.transforms
        assert at == stamp_of(pose.header) == stamp_of(odometry.header) == stamp_of(transform.header) == round(t * 1e9)
        assert pose.header.frame_id == odometry.header.frame_id == transform.header.frame_id == "odom"
        assert odometry.child_frame_id == transform.child_frame_id == "base_link"
        for place, turn in (
            (pose.pose.position, pose.pose.orientation),
            (odometry.pose.pose.position, odometry.pose.pose.orientation),
            (transform.transform.translation, transform.transform.rotation),
        ):
            assert (place.x, place.y, place.z) == (run["x"][i], run["y"][i], 0.0)
            assert heading_of(turn) == pytest.approx(run["theta"][i], abs=1e-15)
        twist = odometry.twist.twist
        assert (twist.linear.x, twist.linear.y, twist.linear.z) == (forward[i], left[i], 0.0)
        assert (twist.angular.x, twist.angular.y, twist.angular.z) == (0.0, 0.0, run["omega"][i])


def test_the_path_is_there_from_the_start(opened):
    run = RUNS["unicycle"]
    found, _, _ = opened(run)
    ((at, path),) = found["/path"]
    assert at == round(run.t[0] * 1e9)
    assert path.header.frame_id == "odom"
    assert [(p.pose.position.x, p.pose.position.y) for p in path.poses] == list(zip(run["x"], run["y"], strict=True))
    assert [stamp_of(p.header) for p in path.poses] == np.rint(run.t * 1e9).astype(int).tolist()


def test_an_arm_has_joints_and_its_tool(opened):
    run = RUNS["arm with heading"]
    found, _, _ = opened(run)
    for i in range(len(run)):
        (_, joints), (_, tool) = found["/joint_states"][i], found["/tool_pose"][i]
        assert list(joints.name) == ["q1", "q2"]
        assert list(joints.position) == run.states[i].tolist()
        assert len(joints.velocity) == len(joints.effort) == 0
        assert (tool.header.frame_id, tool.pose.position.x) == ("world", run["x"][i])
        assert heading_of(tool.pose.orientation) == pytest.approx(run["theta"][i], abs=1e-15)
    found, _, _ = opened(RUNS["arm"])
    assert found["/tool_point"][3][1].point.y == RUNS["arm"]["y"][3]


def test_a_flight_stands_upright(opened):
    run = RUNS["flight"]
    found, _, _ = opened(run)
    for i in range(len(run)):
        (_, odometry) = found["/odom"][i]
        place, linear = odometry.pose.pose.position, odometry.twist.twist.linear
        assert (place.x, place.y, place.z) == (run["x"][i], 0.0, run["y"][i])
        assert (linear.x, linear.y, linear.z) == (run["vx"][i], 0.0, run["vy"][i])
        assert odometry.pose.pose.orientation.w == 1.0


def test_rows_that_are_not_finite_have_no_pose(opened):
    found, _, _ = opened(RUNS["diverged"])
    assert len(found["/pose"]) == 1
    assert len(found["/columns/x"]) == 3
    assert math.isnan(found["/columns/x"][2][1].data)


def test_a_turn_of_many_turns_is_a_quaternion_of_length_one(opened):
    found, _, _ = opened(Run({"t": [0.0, 1.0], "x": [0.0, 0.0], "y": [0.0, 0.0], "theta": [0.0, 1e6]}))
    assert math.remainder(heading_of(found["/pose"][1][1].pose.orientation) - 1e6, 2 * math.pi) == pytest.approx(
        0.0, abs=1e-9
    )


def test_the_definitions_are_those_of_ros():
    stores = pytest.importorskip("rosbags.typesys")
    store = stores.get_typestore(stores.Stores.ROS2_HUMBLE)
    for kind in sorted({*BASE_TOPICS.values(), "JointState", "PointStamped", "Float64"}):
        (name,) = (n for n in store.types if n.endswith(f"/msg/{kind}"))
        ours = stores.get_types_from_msg(definition(name.replace("/msg/", "/")), name)
        for each, fields in ours.items():
            if each != "builtin_interfaces/msg/Time":
                assert fields[1] == store.fielddefs[each][1], each


def test_chunks_by_others(tmp_path):
    """Without compression, and without chunks, the same run comes back."""
    run = RUNS["unicycle"]
    path = write_log(run, tmp_path / "run.mcap")
    with path.open("rb") as file:
        records = list(reader.make_reader(file).iter_messages(log_time_order=False))
        file.seek(0)
        (metadata,) = reader.make_reader(file).iter_metadata()
    plain = pytest.importorskip("mcap.writer")
    for options in ({"compression": plain.CompressionType.NONE}, {"use_chunking": False}, {"chunk_size": 300}):
        out = io.BytesIO()
        log = plain.Writer(out, **options)
        log.start()
        ids: dict = {}
        for schema, channel, message in records:
            if channel.topic not in ids:
                schema_id = log.register_schema(schema.name, schema.encoding, schema.data)
                ids[channel.topic] = log.register_channel(channel.topic, "cdr", schema_id)
            log.add_message(ids[channel.topic], message.log_time, message.data, message.publish_time)
        log.add_metadata(metadata.name, metadata.metadata)
        log.finish()
        path.write_bytes(out.getvalue())
        same(run, read_log(path))


def test_logs_that_are_none_of_ours(tmp_path):
    path = tmp_path / "run.mcap"
    with path.open("wb") as file, writer.Writer(file) as log:
        schema = log.register_msgdef("std_msgs/msg/Float64", "float64 data")
        log.write_message("/speed", schema, {"data": 1.0}, 0)
    with pytest.raises(InvalidValue, match=r"topics \['/speed'\].*metadata record"):
        read_log(path)
    with path.open("wb") as file, writer.Writer(file) as log:
        log.add_metadata("coplanar.run", {"json": "{"})
    with pytest.raises(InvalidValue, match="line 1 of"):
        read_log(path)
    with path.open("wb") as file, writer.Writer(file) as log:
        schema = log.register_msgdef("std_msgs/msg/Float32", "float32 data")
        log.write_message("/columns/t", schema, {"data": 1.0}, 0)
    with pytest.raises(InvalidValue, match=r"topic /columns/t of .*Float64"):
        read_log(path)


def test_a_chunk_that_unpacks_to_more_than_allowed(tmp_path):
    run = Run({"t": np.arange(30_000.0)})
    path = write_log(run, tmp_path / "run.mcap")
    assert path.stat().st_size < 900_000
    with pytest.raises(InvalidValue, match=r"a chunk of .*bytes unpacked.*largest="):
        read_log(path, largest=900_000)
    same(run, read_log(path))
