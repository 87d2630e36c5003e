"""A run as messages of ROS 2: which topics a kind of run has, and what stands in them.

| run | topics |
|---|---|
| x, y, theta (unicycle, body, table) | /pose PoseStamped, /odom Odometry, /tf odom -> base_link, /path Path |
| arm | /joint_states JointState; the tool as /tool_pose PoseStamped and /tf world -> tool with theta, as /tool_point PointStamped without; /path |
| flight | /odom Odometry, /tf world -> projectile, /path |
| any | /columns/NAME Float64, every column as it is |

A plane on the ground is ROS's x-y plane, headings turn about z: q = (0, 0, sin theta/2, cos theta/2). A flight stands
upright: its y is ROS's z [REP 103]. The twist of an Odometry is the command that led to the row, in the robot's own
frame as the message wants it. Rows that are not finite have no messages but those of the columns.
"""  # noqa: E501 - a table

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from coplanar.run import Run

_FIELDS: Mapping[str, str] = MappingProxyType(
    {
        "geometry_msgs/Point": "float64 x|float64 y|float64 z",
        "geometry_msgs/PointStamped": "std_msgs/Header header|geometry_msgs/Point point",
        "geometry_msgs/Pose": "geometry_msgs/Point position|geometry_msgs/Quaternion orientation",
        "geometry_msgs/PoseStamped": "std_msgs/Header header|geometry_msgs/Pose pose",
        "geometry_msgs/PoseWithCovariance": "geometry_msgs/Pose pose|float64[36] covariance",
        "geometry_msgs/Quaternion": "float64 x|float64 y|float64 z|float64 w",
        "geometry_msgs/Transform": "geometry_msgs/Vector3 translation|geometry_msgs/Quaternion rotation",
        "geometry_msgs/TransformStamped": (
            "std_msgs/Header header|string child_frame_id|geometry_msgs/Transform transform"
        ),
        "geometry_msgs/Twist": "geometry_msgs/Vector3 linear|geometry_msgs/Vector3 angular",
        "geometry_msgs/TwistWithCovariance": "geometry_msgs/Twist twist|float64[36] covariance",
        "geometry_msgs/Vector3": "float64 x|float64 y|float64 z",
        "nav_msgs/Odometry": (
            "std_msgs/Header header|string child_frame_id|"
            "geometry_msgs/PoseWithCovariance pose|geometry_msgs/TwistWithCovariance twist"
        ),
        "nav_msgs/Path": "std_msgs/Header header|geometry_msgs/PoseStamped[] poses",
        "sensor_msgs/JointState": (
            "std_msgs/Header header|string[] name|float64[] position|float64[] velocity|float64[] effort"
        ),
        "std_msgs/Float64": "float64 data",
        "std_msgs/Header": "builtin_interfaces/Time stamp|string frame_id",
        "tf2_msgs/TFMessage": "geometry_msgs/TransformStamped[] transforms",
        "builtin_interfaces/Time": "int32 sec|uint32 nanosec",
    }
)
BASE_FRAME, FIXED_FRAME = "base_link", "odom"
WORLD = "world"
NANOSECONDS = 1_000_000_000  # a second


class Message(NamedTuple):
    """A message, where it goes and what it is."""

    topic: str
    type: str
    body: dict[str, Any]


def definition(type: str) -> str:
    """The fields of a message type, and of every type that stands in it, as ROS 2 writes them.

    Example:
        >>> definition("std_msgs/Float64")
        'float64 data'
    """
    names = [type]
    for name in names:
        fields = (field.split()[0].partition("[")[0] for field in _FIELDS[name].split("|"))
        names += [field for field in fields if field in _FIELDS and field not in names]
    first, *rest = (_FIELDS[name].replace("|", "\n") for name in names)
    separator = "\n" + "=" * 80 + "\nMSG: "
    return first + "".join(f"{separator}{name}\n{text}" for name, text in zip(names[1:], rest, strict=True))


def before_all(run: Run, stamps: list[int]) -> Iterator[Message]:
    """What is known from the start: the whole path."""
    if {"x", "y"} <= set(run.columns):
        place = _upright if run.kind == "flight" else _flat
        frame = FIXED_FRAME if _drives(run) else WORLD
        table = _table(run, "x", "y", "theta")
        rows = zip(stamps, table.tolist(), strict=True)
        poses = [_pose_stamped(stamp, frame, place(*row)) for stamp, row in rows if _finite(row)]
        yield Message("/path", "nav_msgs/Path", {"header": _header(stamps[0], frame), "poses": poses})


def by_row(run: Run) -> Callable[[int, int], Iterable[Message]]:
    """A function (row, stamp) -> its messages, without those of the columns."""
    if run.kind == "arm":
        return _of_arm(run)
    if run.kind == "flight":
        return _of_flight(run)
    return _of_base(run) if _drives(run) else lambda *_: ()


def _drives(run: Run) -> bool:
    return {"x", "y", "theta"} <= set(run.columns) and run.kind not in ("arm", "flight")


def _of_base(run: Run) -> Callable[[int, int], Iterator[Message]]:
    commands = run.names.commands
    names = ("x", "y", "theta", "v" if "v" in commands else "vx", "vy", "omega")
    table = _table(run, *names, only={"x", "y", "theta", *commands})

    def messages(row: int, stamp: int) -> Iterator[Message]:
        x, y, theta, vx, vy, omega = values = table[row].tolist()
        if _finite(values):
            pose = _flat(x, y, theta)
            yield Message("/pose", "geometry_msgs/PoseStamped", _pose_stamped(stamp, FIXED_FRAME, pose))
            yield _odometry(stamp, FIXED_FRAME, BASE_FRAME, pose, (_point(vx, vy, 0.0), _point(0.0, 0.0, omega)))
            yield _transform(stamp, FIXED_FRAME, BASE_FRAME, pose)

    return messages


def _of_arm(run: Run) -> Callable[[int, int], Iterator[Message]]:
    joints, names = run.states, list(run.names.states)
    tool = _table(run, "x", "y", "theta")
    placed, turned = {"x", "y"} <= set(run.columns), "theta" in run.columns

    def messages(row: int, stamp: int) -> Iterator[Message]:
        position, where = joints[row].tolist(), tool[row].tolist()
        if names and _finite(position):
            body = {"header": _header(stamp, WORLD), "name": names, "position": position, "velocity": [], "effort": []}
            yield Message("/joint_states", "sensor_msgs/JointState", body)
        if placed and _finite(where):
            pose = _flat(*where)
            if turned:
                yield Message("/tool_pose", "geometry_msgs/PoseStamped", _pose_stamped(stamp, WORLD, pose))
                yield _transform(stamp, WORLD, "tool", pose)
            else:
                point = {"header": _header(stamp, WORLD), "point": pose["position"]}
                yield Message("/tool_point", "geometry_msgs/PointStamped", point)

    return messages


def _of_flight(run: Run) -> Callable[[int, int], Iterator[Message]]:
    table = _table(run, "x", "y", "vx", "vy")

    def messages(row: int, stamp: int) -> Iterator[Message]:
        x, y, vx, vy = values = table[row].tolist()
        if {"x", "y"} <= set(run.columns) and _finite(values):
            pose = _upright(x, y)
            yield _odometry(stamp, WORLD, "projectile", pose, (_point(vx, 0.0, vy), _point(0.0, 0.0, 0.0)))
            yield _transform(stamp, WORLD, "projectile", pose)

    return messages


def _table(run: Run, *names: str, only: set[str] | None = None) -> np.ndarray:
    """Columns side by side, 0 where there is none of that name."""
    known = set(run.columns) if only is None else only & set(run.columns)
    return np.stack([run[name] if name in known else np.zeros(len(run)) for name in names], axis=-1)


def _finite(values: list[float]) -> bool:
    return math.isfinite(sum(map(abs, values)))


def _header(stamp: int, frame: str) -> dict[str, Any]:
    sec, nanosec = divmod(stamp, NANOSECONDS)
    return {"stamp": {"sec": sec, "nanosec": nanosec}, "frame_id": frame}


def _point(x: float, y: float, z: float) -> dict[str, float]:
    return {"x": x, "y": y, "z": z}


def _flat(x: float, y: float, theta: float) -> dict[str, Any]:
    """On the ground."""
    turn = {"x": 0.0, "y": 0.0, "z": math.sin(0.5 * theta), "w": math.cos(0.5 * theta)}
    return {"position": _point(x, y, 0.0), "orientation": turn}


def _upright(x: float, y: float, _: float = 0.0) -> dict[str, Any]:
    """In a plane that stands on the ground."""
    return {"position": _point(x, 0.0, y), "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}}


def _pose_stamped(stamp: int, frame: str, pose: dict[str, Any]) -> dict[str, Any]:
    return {"header": _header(stamp, frame), "pose": pose}


def _odometry(
    stamp: int, frame: str, child: str, pose: dict[str, Any], twist: tuple[dict[str, float], dict[str, float]]
) -> Message:
    unknown = [0.0] * 36
    body = {
        "header": _header(stamp, frame),
        "child_frame_id": child,
        "pose": {"pose": pose, "covariance": unknown},
        "twist": {"twist": {"linear": twist[0], "angular": twist[1]}, "covariance": unknown},
    }
    return Message("/odom", "nav_msgs/Odometry", body)


def _transform(stamp: int, frame: str, child: str, pose: dict[str, Any]) -> Message:
    transform = {"translation": pose["position"], "rotation": pose["orientation"]}
    body = {"header": _header(stamp, frame), "child_frame_id": child, "transform": transform}
    return Message("/tf", "tf2_msgs/TFMessage", {"transforms": [body]})
