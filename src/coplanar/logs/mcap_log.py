"""A run as an MCAP of ROS 2 messages: what Foxglove, Lichtblick, PlotJuggler and ``ros2 bag`` open.

``coplanar.logs.ros`` says which topics a run has. Every column is a topic of Float64 messages, so that a plot of any
of them is a matter of choosing its name, and nothing is lost: a message holds the column's double to the last bit, and
the metadata record "coplanar.run" holds kind, index, status, warnings and info as JSON. Reading takes these two, not
the poses, whose quaternions are rounded. Messages are stamped in whole nanoseconds.

A reader believes nothing: records end where the file ends, a chunk is unpacked only up to the size that is allowed, and
checksums are held.

Source: MCAP Format Specification; ROS 2 common_interfaces; REP 103, REP 105.
"""

from __future__ import annotations

import importlib
import io
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from coplanar.errors import InvalidShape, InvalidValue, MissingExtra
from coplanar.logs import ros
from coplanar.logs.description import column_of, described, run_of
from coplanar.logs.files import Source, parsed_json, refuse
from coplanar.logs.stamps import stamps_of
from coplanar.run import Run

METADATA = "coplanar.run"
_COLUMNS = "/columns/"
_LITTLE_ENDIAN = b"\x00\x01\x00\x00"  # how a CDR message begins
_CHANNEL, _MESSAGE, _MESSAGE_HEAD = 4, 5, 22  # opcodes, and the bytes of a message before its data


def write(run: Run, path: Path) -> None:
    """Write the log.

    Raises:
        InvalidShape: If the run is a batch.
        InvalidValue: If the times are beyond 31 bits of seconds.
        MissingExtra: If the extra ``logs`` is not installed.
    """
    if run.shape:
        raise InvalidShape("run", f"a batch of shape {run.shape}", "one robot", "choose it by run.robot(index)")
    stamps = [int(s) for s in stamps_of(run, ros.NANOSECONDS, bits=60)]
    module = _package("mcap_ros2.writer", "mcap-ros2-support")
    with path.open("xb") as file, module.Writer(file) as log:
        log.add_metadata(METADATA, {"json": described(run)})
        schemas = _Schemas(log)
        for message in ros.before_all(run, stamps):
            schemas.send(message, stamps[0])
        rows, columns = ros.by_row(run), {name: values.tolist() for name, values in run.columns.items()}
        for row, stamp in enumerate(stamps):
            for message in rows(row, stamp):
                schemas.send(message, stamp)
            for name, values in columns.items():
                schemas.send(ros.Message(_COLUMNS + name, "std_msgs/Float64", {"data": values[row]}), stamp)


@dataclass(slots=True)
class _Schemas:
    """A log to write to, with the message types that it knows already."""

    log: Any
    known: dict[str, Any] = field(default_factory=dict)

    def send(self, message: ros.Message, stamp: int) -> None:
        if message.type not in self.known:
            package, name = message.type.split("/")
            self.known[message.type] = self.log.register_msgdef(f"{package}/msg/{name}", ros.definition(message.type))
        self.log.write_message(message.topic, self.known[message.type], message.body, stamp, stamp)


def read(source: Source) -> Run:
    """The run of such a log.

    Raises:
        InvalidValue: Naming the file and what in it cannot be.
        MissingExtra: If the extra ``logs`` is not installed.
    """
    path, module = source.path, _package("mcap.stream_reader", "mcap")
    topics: dict[int, str] = {}
    columns: dict[str, bytearray] = {}
    described_by = None
    for record in _records(path, module, source.data):
        form = type(record).__name__
        if form == "Metadata" and record.name == METADATA:
            described_by = record.metadata.get("json", "")
        elif form == "Channel":
            topics[record.id] = record.topic
        elif form == "Chunk":
            for channel, payload in _messages(path, _unpacked(path, record, source.largest), topics):
                _keep(path, columns, topics.get(channel, ""), payload)
        elif form == "Message":
            _keep(path, columns, topics.get(record.channel_id, ""), record.data)
    if described_by is None:
        refuse(path, "", f"topics {list(topics.values())[:8]}", f"a metadata record {METADATA!r}, as write_log writes")
    description = parsed_json(path, described_by)
    table = {name: column_of(path, name, raw, len(raw) // 8, {}) for name, raw in columns.items()}
    return run_of(path, table, description)


def _records(path: Path, module: Any, data: bytes) -> Iterator[Any]:
    """The records of the file, chunks unopened; what the library says of a broken file becomes a refusal."""
    stream = io.BytesIO(data)
    reader = module.StreamReader(stream, emit_chunks=True, validate_crcs=True, record_size_limit=len(data))
    records = reader.records
    while True:
        place = stream.tell()
        try:
            record = next(records, None)
        except Exception as error:
            raise _broken(path, f"byte {place}", error) from None
        if record is None:
            return
        yield record


def _unpacked(path: Path, chunk: Any, largest: int) -> bytes:
    """What a chunk holds, if it is not more than ``largest``, and as its checksum says."""
    size = chunk.uncompressed_size
    if size > largest:
        refuse(path, "a chunk", f"{size} bytes unpacked", f"at most {largest}", "allow more by largest=")
    try:
        unpacked = _decompressed(chunk, size)
    except Exception as error:
        raise _broken(path, "a chunk", error) from None
    if chunk.uncompressed_crc and zlib.crc32(unpacked) != chunk.uncompressed_crc:
        refuse(path, "a chunk", f"checksum {zlib.crc32(unpacked):08x}", f"{chunk.uncompressed_crc:08x}, as it says")
    return unpacked


def _decompressed(chunk: Any, size: int) -> bytes:
    if not chunk.compression:
        return bytes(chunk.data)
    if chunk.compression != "zstd":
        raise ValueError(f"compression {chunk.compression!r} instead of zstd or none")
    zstd = _package("zstandard", "zstandard")
    if zstd.get_frame_parameters(chunk.data).content_size != size:
        raise ValueError(f"frame and chunk do not agree on {size} bytes unpacked")
    return bytes(zstd.ZstdDecompressor().decompress(chunk.data, max_output_size=size))


def _messages(path: Path, data: bytes, topics: dict[int, str]) -> Iterator[tuple[int, bytes]]:
    """Channel and payload of the messages in a chunk; channels that begin in it are added to the topics."""
    place = 0
    while place < len(data):
        opcode, length = struct.unpack_from("<BQ", data, place) if place + 9 <= len(data) else (0, len(data))
        begin, place = place + 9, place + 9 + length
        if place > len(data) or (opcode == _MESSAGE and length < _MESSAGE_HEAD):
            refuse(path, f"byte {begin - 9} of a chunk", f"a record of {length} bytes", "one that ends in its chunk")
        if opcode == _MESSAGE:
            yield int.from_bytes(data[begin : begin + 2], "little"), data[begin + _MESSAGE_HEAD : place]
        elif opcode == _CHANNEL:
            number, topic = _channel(path, data[begin:place])
            topics[number] = topic


def _channel(path: Path, payload: bytes) -> tuple[int, str]:
    records, stream = (_package(f"mcap.{name}", "mcap") for name in ("records", "data_stream"))
    try:
        channel = records.Channel.read(stream.ReadDataStream(io.BytesIO(payload)))
    except Exception as error:
        raise _broken(path, "a channel", error) from None
    return channel.id, channel.topic


def _keep(path: Path, columns: dict[str, bytearray], topic: str, payload: bytes) -> None:
    """Add the double of a column's message to what there is of it."""
    if topic.startswith(_COLUMNS):
        if len(payload) != 12 or payload[:4] != _LITTLE_ENDIAN:
            refuse(path, f"topic {topic}", payload[:16], "Float64 messages in little-endian CDR")
        columns.setdefault(topic.removeprefix(_COLUMNS), bytearray()).extend(payload[4:])


def _broken(path: Path, place: str, error: Exception) -> InvalidValue:
    text = f"{type(error).__name__}: {error}".rstrip(": ")
    return InvalidValue(f"{place} of {path}", text, "a whole MCAP file")


def _package(module: str, package: str) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError:
        raise MissingExtra(package, "logs") from None
