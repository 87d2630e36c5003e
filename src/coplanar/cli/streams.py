"""Logs in and poses out, piece by piece: to a pipe as they come, to a file whole or not at all."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO

import numpy as np

from coplanar.cli.progress import progress
from coplanar.errors import InvalidValue
from coplanar.logs.lines import Reader
from coplanar.logs.ticks import Piece
from coplanar.run.files import written_whole
from coplanar.se2 import Pose

POSE = ("x", "y", "theta")
COVARIANCE = ("xx", "xy", "xtheta", "yy", "ytheta", "thetatheta")  # the upper triangle
PIPE = "-"


@dataclass(slots=True)
class Tally:
    """What has gone by.

    Attributes:
        rows: How many poses there were.
        began: Time of the first one, where there are times [s].
        ended: Time of the last one.
        pose: The last one.
        covariance: Its covariance, where one was asked for.
        distance: Length of the path [m].
        turn: Turns of either side summed up [rad].
        file: Where the poses are.
    """

    rows: int = 0
    began: float | None = None
    ended: float | None = None
    pose: Pose = field(default_factory=Pose)
    covariance: np.ndarray | None = None
    distance: float = 0.0
    turn: float = 0.0
    file: str | None = None

    @property
    def duration(self) -> float | None:
        """From the first time to the last one [s]."""
        return None if self.began is None or self.ended is None else self.ended - self.began

    def add(self, piece: Piece) -> None:
        """Count a piece."""
        self.rows += piece.poses.shape[0]
        self.pose = piece.onward.pose
        if piece.times is not None:
            self.began = float(piece.times[0]) if self.began is None else self.began
            self.ended = float(piece.times[-1])
        self.covariance = None if piece.covariances is None else piece.covariances[-1]
        dx, dy, dtheta = piece.ticks.parts
        self.distance += float(np.sum(np.hypot(dx, dy)))
        self.turn += float(np.sum(np.abs(dtheta)))


@contextmanager
def source(log: str) -> Iterator[tuple[Reader, str]]:
    """The bytes of a log, as soon as there are any, and what to call it.

    Raises:
        InvalidValue: If there is no such file.
    """
    if log == PIPE:
        buffer = sys.stdin.buffer
        yield getattr(buffer, "read1", buffer.read), "stdin"
        return
    with ExitStack() as stack:
        try:
            file = stack.enter_context(open(log, "rb", buffering=0))
            file.read(0)
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or error
            raise InvalidValue("log", log, f"a file that can be read ({reason})") from None
        yield file.read, log


def poses_to(target: str | None, pieces: Iterable[Piece], every: int, decimals: int | None) -> Tally:
    """Write every so manyth pose, and the last one.

    Args:
        target: A file, which appears when all is done; "-" for stdout; None for nowhere.
        pieces: Of the path.
        every: 1 for all poses.
        decimals: Digits after the point; None for as many as tell the numbers apart.
    """
    tally = Tally()
    if target is None:
        for _ in _told(pieces, tally):
            continue
    elif target == PIPE:
        out = sys.stdout.buffer
        for text in _texts(pieces, tally, every, decimals):
            out.write(text)
            out.flush()
    else:
        with _whole(target) as file:
            file.writelines(_texts(pieces, tally, every, decimals))
        tally.file = target
    return tally


def _told(pieces: Iterable[Piece], tally: Tally) -> Iterator[Piece]:
    """The pieces, each counted after it is used, with progress."""
    with progress("rows") as step:
        for piece in pieces:
            yield piece
            tally.add(piece)
            step("poses", tally.rows, None)


def _texts(pieces: Iterable[Piece], tally: Tally, every: int, decimals: int | None) -> Iterator[bytes]:
    """The poses as text, piece by piece."""
    last = b""
    for piece in _told(pieces, tally):
        table = _table(piece)
        head = b"" if tally.rows else _header(piece)
        yield head + _text(table[-tally.rows % every :: every], decimals)
        done = tally.rows + len(table)
        last = b"" if (done - 1) % every == 0 else _text(table[-1:], decimals)
    yield last


def _header(piece: Piece) -> bytes:
    names = (*(() if piece.times is None else ("t",)), *POSE, *(() if piece.covariances is None else COVARIANCE))
    return (",".join(names) + "\n").encode()


def _table(piece: Piece) -> np.ndarray:
    columns = [*([] if piece.times is None else [piece.times]), *piece.poses.parts]
    if piece.covariances is not None:
        columns += [piece.covariances[:, i, j] for i in range(3) for j in range(i, 3)]
    return np.stack(columns, axis=1)


def _text(table: np.ndarray, decimals: int | None) -> bytes:
    """Rows as text, by one conversion for all of them."""
    cell = "%r" if decimals is None else f"%.{decimals}f"
    row = ",".join([cell] * table.shape[1]) + "\n"
    return (row * len(table) % tuple(table.ravel().tolist())).encode()


@contextmanager
def _whole(target: str) -> Iterator[BinaryIO]:
    """A file beside the target that takes its place when the block has ended well, and is gone otherwise."""
    path = Path(target)
    if not path.name or "\0" in target:
        raise InvalidValue("output", target, "a file that can be written")
    if path.exists() and not path.is_file():  # a device or a named pipe is written to as it is
        with path.open("wb") as device:
            yield device
        return
    with written_whole(path) as part, part.open("xb") as file:
        yield file
