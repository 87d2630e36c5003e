"""Programs: segments driven one after another."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import evaluator, running_sum, stack
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.laws import motion as laws
from coplanar.laws import ramps, se2
from coplanar.motion.segment import Segment
from coplanar.motion.sequence import along, before_last_axis, joined, pick, piece_at
from coplanar.se2 import Pose, Twist

_clamp = evaluator(ramps.clamp)
_rotate = evaluator(se2.rotate)
_segment = evaluator(laws.segment)
_velocities = evaluator(laws.velocities)


@dataclass(frozen=True, slots=True)
class Program:
    """Segments one after another, joined by coordinate transforms: T(t1) = T(t) T'.

    Before 0 and after the end the body stands still.

    Attributes:
        segments: Given as a sequence of segments, or as one ``Segment`` whose last axis runs along the program;
            kept as the latter, shape (..., n). Leading axes are robots.
        knots: When each segment begins, and when the last one ends [s], shape (..., n + 1).
        frames: Where each segment begins, and where the last one ends, seen from the start; shape (..., n + 1).

    Raises:
        InvalidShape: If there is no segment, or they do not broadcast.

    Example:
        >>> from math import pi
        >>> corner = Program([Segment(1.0, 0.0, duration=2.0), Segment(0.0, pi / 2, duration=1.0)])
        >>> corner.then(Segment(1.0, 0.0, duration=3.0)).end(Pose()).as_array().round(12).tolist()
        [2.0, 3.0, 1.570796326795]
    """

    segments: Segment
    knots: Any = field(init=False, repr=False, compare=False)
    frames: Pose = field(init=False, repr=False, compare=False)

    def __init__(self, segments: Segment | Iterable[Segment]) -> None:
        rows = _rows(segments)
        knots = running_sum(rows.duration)
        dx, dy, turn = _segment(0.0, 0.0, 0.0, *rows.parts)
        heading = running_sum(turn)
        x, y = (running_sum(way) for way in _rotate(heading[..., :-1], dx, dy))
        frames = Pose._of(*map(checks.frozen, (x, y, heading)))
        for name, value in (("segments", rows), ("knots", checks.frozen(knots)), ("frames", frames)):
            object.__setattr__(self, name, value)

    @classmethod
    def from_samples(cls, v: ArrayLike, omega: ArrayLike, t: ArrayLike) -> Program:
        """The driving history that holds each sample until the next time: one arc for every interval.

        Args:
            v: Forward velocity [m/s], shape (..., n) or (..., n - 1); of n samples the last one is not driven.
            omega: Turn rate [rad/s], likewise.
            t: Strictly increasing times [s], shape (n,). The program begins at its own 0.

        Raises:
            InvalidValue: If the times do not increase.
            InvalidShape: If the counts differ.

        Example:
            >>> Program.from_samples([1.0, 3.0, 9.0], 0.0, [5.0, 6.0, 8.0]).end(Pose()).x
            7.0
        """
        times = checks.monotone("t", t)
        if times[1] < times[0]:
            raise InvalidValue("t", t, "increasing times", "reverse the samples")
        durations = np.diff(times)
        held = [held_samples(name, value, times.size) for name, value in (("v", v), ("omega", omega))]
        return cls(Segment(*held, duration=durations))

    def __len__(self) -> int:
        return int(self.segments.duration.shape[-1])

    def __getitem__(self, index: int) -> Segment:
        """One segment of the program."""
        return Segment._of(*(checks.frozen(checks.real("segment", p[..., index])) for p in self.segments.parts))

    def __iter__(self) -> Iterator[Segment]:
        return (self[i] for i in range(len(self)))

    def then(self, more: Segment | Program) -> Program:
        """This program, and afterwards another segment or program.

        Example:
            >>> len(Program([Segment(1.0, 0.0, duration=1.0)]).then(Segment(0.0, 1.0, duration=1.0)))
            2
        """
        rows = more.segments if isinstance(more, Program) else _rows([more])
        return Program(Segment._of(*map(joined, self.segments.parts, rows.parts)))

    @property
    def duration(self) -> Real:
        """When the last segment ends [s]; a float, or an array where the segments' durations differ between robots."""
        return checks.real("duration", self.knots[..., -1])

    def pose(self, start: Pose, t: ArrayLike) -> Pose:
        """The pose at time t, exact to rounding.

        Args:
            start: Pose at time 0; broadcasts with the leading shape.
            t: Time since the start [s], any shape that broadcasts with the leading shape.

        Example:
            >>> Program([Segment(1.0, 0.0, duration=2.0)]).pose(Pose(), [-1.0, 0.5, 9.0]).x.tolist()
            [0.0, 0.5, 2.0]
        """
        index, since, parts = self._piece(checks.real("t", t))
        frame = (pick(p, index) for p in self.frames.parts)
        return start @ Pose._of(*_segment(*frame, *parts[:4], since))

    def twist(self, t: ArrayLike) -> Twist:
        """The velocity at time t seen from the body; at a knot that of the segment which begins there.

        Example:
            >>> Program([Segment(1.0, 0.0, duration=2.0)]).twist([0.0, 2.0, 2.1]).vx.tolist()
            [1.0, 1.0, 0.0]
        """
        time = checks.real("t", t)
        _, since, parts = self._piece(time)
        inside = 1.0 * ((time >= 0.0) & (time <= self.knots[..., -1]))
        v, omega = _velocities(*parts[:4], since)
        return Twist._of(checks.real("v", v * inside), 0.0, checks.real("omega", omega * inside))

    def end(self, start: Pose) -> Pose:
        """The pose when the program is over.

        Example:
            >>> Program([Segment(1.0, 0.0, duration=2.0)] * 3).end(Pose()).x
            6.0
        """
        return start @ Pose._of(*(checks.real("end", p[..., -1]) for p in self.frames.parts))

    def poses(self, start: Pose) -> Pose:
        """The poses at the knots, shape (..., n + 1).

        Example:
            >>> Program([Segment(1.0, 0.0, duration=2.0)] * 2).poses(Pose()).x.tolist()
            [0.0, 2.0, 4.0]
        """
        return Pose._of(*map(before_last_axis, start.parts)) @ self.frames

    def sample(self, start: Pose, step: float) -> tuple[np.ndarray, Pose]:
        """Times 0, step, 2 step ... and the end, shape (m,), with their poses, shape (..., m).

        Raises:
            InvalidShape: If the durations differ between robots.
            InvalidValue: If the step is not positive.

        Example:
            >>> t, poses = Program([Segment(1.0, 0.0, duration=1.0)]).sample(Pose(), 0.4)
            >>> poses.x.tolist()
            [0.0, 0.4, 0.8, 1.0]
        """
        end, step = self.duration, checks.positive("step", step)
        if np.ndim(end):
            raise InvalidShape("duration", f"shape {np.shape(end)}", "one duration for all robots", "call pose")
        # The last step may be short, but not by a rounding: a count that is whole to 1e-9 is whole.
        t = np.minimum(step * np.arange(np.ceil(end / step - 1e-9) + 1.0), end)
        t[-1] = end
        robots = max(len(self.segments.shape) - 1, len(start.shape))
        poses = self.pose(start, t.reshape(-1, *[1] * robots))
        return t, Pose._of(*(np.moveaxis(p, 0, -1) for p in np.broadcast_arrays(*poses.parts)))

    def _piece(self, t: Real) -> tuple[Any, Any, list[Any]]:
        """The index of the piece at time t, the time since it began, and its parts."""
        index = piece_at(self.knots, t)
        parts = [pick(p, index) for p in self.segments.parts]
        since = t - pick(self.knots, index)
        return index, _clamp(since, 0.0, parts[-1]), parts


def held_samples(name: str, value: ArrayLike, count: int, *, look: bool = True) -> Real:
    """The n - 1 samples that are held between n times: a number, or the first n - 1 of the last axis.

    Without ``look`` somebody else has to look for NaN and infinity.

    Raises:
        InvalidShape: If the last axis is neither n nor n - 1 long.

    Example:
        >>> held_samples("v", [1.0, 2.0, 3.0], 3).tolist()
        [1.0, 2.0]
    """
    samples = checks.real(name, value) if look else checks.reals(name, value)
    shape = np.shape(samples)
    if not shape:
        return samples
    if shape[-1] not in (count, count - 1):
        raise InvalidShape(name, f"shape {shape}", f"shape (..., {count}) or (..., {count - 1})")
    return samples[..., : count - 1]


def _rows(segments: Segment | Iterable[Segment]) -> Segment:
    """One segment whose last axis runs along the program; every field has that axis."""
    if not isinstance(segments, Segment):
        pieces = list(segments)
        if not pieces:
            raise InvalidShape("segments", "none", "one segment or more")
        checks.broadcast(**{f"segment {i}": np.zeros(piece.shape) for i, piece in enumerate(pieces)})
        columns = zip(*(piece.parts for piece in pieces), strict=True)
        return Segment._of(*(checks.frozen(stack(column)) for column in columns))
    if not segments.shape or not segments.shape[-1]:
        raise InvalidShape("segments", f"a Segment of shape {segments.shape}", "shape (..., n)", "pass a list")
    return Segment._of(*(along(part, segments.shape[-1]) for part in segments.parts))
