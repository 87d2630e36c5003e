"""Frames: the same points in the coordinates of another frame."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np
from pydantic import Field

from coplanar.frames import FrameTree
from coplanar.scenarios import truths
from coplanar.scenarios.outcome import Outcome
from coplanar.scenarios.parts.common import PosePart
from coplanar.scenarios.quantities import Point
from coplanar.scenarios.scenario import Progress, Scenario

FrameName = Annotated[str, Field(min_length=1, max_length=40)]


class FramePart(PosePart):
    """A frame and where it stands in its parent."""

    name: FrameName = Field(description="What to call it")
    parent: FrameName = Field(default="world", description="The frame in which x, y and theta are given")


class Converted(NamedTuple):
    """What the library makes of it."""

    tree: FrameTree
    points: np.ndarray
    converted: np.ndarray


class Frames(Scenario):
    """A tree of frames, and points that are seen from another one."""

    vectorised_keys: ClassVar[tuple[str, ...]] = ("frames.*.x", "frames.*.y", "frames.*.theta")
    example: ClassVar[dict[str, Any]] = {
        "frames": [
            {"name": "robot", "x": 2.0, "y": 1.0, "theta": "30 deg"},
            {"name": "camera", "parent": "robot", "x": 0.3, "theta": "-90 deg"},
        ],
        "points": [[1.0, 0.0]], "seen_in": "camera", "wanted_in": "world",
    }  # fmt: skip

    type: Literal["frames"] = Field(default="frames", description="Points in the coordinates of other frames")
    frames: Annotated[tuple[FramePart, ...], Field(min_length=1, max_length=200)] = Field(
        description="The frames, each after its parent; the first parent is the world"
    )
    points: Annotated[tuple[Point, ...], Field(min_length=1, max_length=10_000)] = Field(description="The points")
    seen_in: FrameName = Field(description="The frame whose coordinates are given")
    wanted_in: FrameName = Field(default="world", description="The frame whose coordinates are wanted")

    def build(self) -> Converted:
        """The tree and the points in both frames."""
        tree = FrameTree()
        for frame in self.frames:
            tree = tree.with_frame(frame.name, frame.parent, frame.build())
        points = np.array(self.points)
        batch = len(np.shape(tree.pose(self.seen_in, self.wanted_in).x))
        rows = points.reshape(len(points), *(1,) * batch, 2)
        return Converted(tree, points, tree.convert(rows, from_=self.seen_in, to=self.wanted_in))

    def _numbers(self, things: Any) -> dict[str, Any]:
        pose = things.tree.pose(self.seen_in, self.wanted_in)
        first = things.converted[0]
        return {"x": first[..., 0], "y": first[..., 1], "frame_x": pose.x, "frame_y": pose.y, "frame_theta": pose.theta}

    def _outcome(self, _: Progress, /) -> Outcome:
        built = self.build()
        places = {"world": (0j, 0.0)}
        for frame in self.frames:
            origin, turned = places[frame.parent]
            place = origin + complex(frame.x, frame.y) * np.exp(1j * turned)
            places[frame.name] = (place, turned + frame.theta)
        (origin, turned), (other, back) = places[self.seen_in], places[self.wanted_in]
        world = origin + truths.points_of(built.points) * np.exp(1j * turned)
        error = float(np.abs((world - other) * np.exp(-1j * back) - truths.points_of(built.converted)).max())
        numbers, scale = self._numbers(built), max(1.0, float(np.abs(world).max()))
        x, y = (value.tolist() for value in (built.converted[:, 0], built.converted[:, 1]))
        given = f"({built.points[0, 0]:g}, {built.points[0, 1]:g}) m in {self.seen_in}"
        return self._told(
            built,
            numbers,
            {},
            ok=True,
            status=f"points of {self.seen_in} in the coordinates of {self.wanted_in}",
            headline=f"{given} is ({x[0]:.4f}, {y[0]:.4f}) m in {self.wanted_in}",
            check=f"complex numbers from frame to frame: {error:.0e} m",
            passed=bool(error < 1e-13 * scale),
            tables={"run.csv": {"x": built.points[:, 0], "y": built.points[:, 1], "x_wanted": x, "y_wanted": y}},
        )
