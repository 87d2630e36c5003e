"""An arm as a URDF that RViz, Foxglove, MoveIt and every simulator read."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from xml.sax.saxutils import quoteattr

from coplanar import checks
from coplanar.arms import Arm
from coplanar.errors import InvalidShape, InvalidValue
from coplanar.run.files import written_whole
from coplanar.se2 import Pose

_THICKNESS = 0.02  # of the arm's length: how thick its links are drawn


def write_urdf(
    arm: Arm,
    path: str | os.PathLike[str],
    *,
    names: Sequence[str] | None = None,
    robot: str = "arm",
    effort: float = 1000.0,
    velocity: float = 100.0,
) -> Path:
    """Write an arm as a URDF in the x-y plane; ``read_urdf`` makes the same arm of it, to rounding.

    The links are "world", "base" (where the arm stands), "link1" ... "linkN" with their x axes along themselves, "end"
    (of the last link) and "tool". A joint without limits that turns is continuous. Links are drawn as boxes; they have
    no mass.

    Args:
        arm: The arm, with relative angles, as all joints of a URDF are.
        path: Where to; the file appears whole or not at all.
        names: Of the joints; "q1" ... "qN" unless given.
        robot: The name of the whole.
        effort: The largest torque or force, which the format asks for at every limit and the arm does not know
            [N m or N].
        velocity: The largest joint rate, likewise [rad/s or m/s].

    Returns:
        Where it was written.

    Raises:
        InvalidValue: If the angles are absolute, a joint is limited on one side only or a slide not at all, or the
            file cannot be written.
        InvalidShape: If there is not a name for every joint.
    """
    checks.instance("arm", arm, Arm)
    if arm.angles != "relative":
        raise InvalidValue("angles", arm.angles, "relative angles", "the joints of a URDF turn against the link before")
    given = tuple(f"q{i}" for i in range(1, arm.n + 1)) if names is None else tuple(names)
    if len(given) != arm.n or len(set(given)) != arm.n:
        raise InvalidShape("names", f"{given}", f"{arm.n} different names")
    bounds = (checks.positive("effort", effort), checks.positive("velocity", velocity))
    target = Path(path)
    text = "\n".join(_lines(arm, given, robot, bounds)) + "\n"
    try:
        with written_whole(target) as part:
            part.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise InvalidValue("path", str(path), f"a place that can be written ({error.strerror})") from None
    return target


def _lines(arm: Arm, names: Sequence[str], robot: str, bounds: tuple[float, float]) -> Iterator[str]:
    yield '<?xml version="1.0"?>'
    yield f"<robot name={_quoted('robot', robot)}>"
    yield '  <link name="world"/>'
    yield '  <link name="base"/>'
    yield from _fixed("base_joint", "world", "base", arm.base)
    links = ["base", *(f"link{i}" for i in range(1, arm.n + 1))]
    starts = [0.0, *arm.links]
    thick = _THICKNESS * (sum(arm.links) or 1.0)
    for i, name in enumerate(names):
        yield from _box(links[i + 1], arm.links[i], thick)
        kind = _kind(arm, i)
        yield f"  <joint name={_quoted('names', name)} type={quoteattr(kind)}>"
        yield from _ends(links[i], links[i + 1], Pose(starts[i], 0.0, arm.bends[i]))
        yield f'    <axis xyz="{"0 0 1" if arm.joints[i] == "R" else "1 0 0"}"/>'
        if kind != "continuous":
            low, high = arm.limits[i]
            yield f'    <limit lower="{low!r}" upper="{high!r}" effort="{bounds[0]!r}" velocity="{bounds[1]!r}"/>'
        yield "  </joint>"
    yield '  <link name="end"/>'
    yield from _fixed("end_joint", links[-1], "end", Pose(arm.links[-1], 0.0, 0.0))
    yield '  <link name="tool"/>'
    yield from _fixed("tool_joint", "end", "tool", arm.tool)
    yield "</robot>"


def _kind(arm: Arm, i: int) -> str:
    """What kind of joint it is.

    Raises:
        InvalidValue: If the format has none for its limits.
    """
    low, high = (-math.inf, math.inf) if arm.limits is None else arm.limits[i]
    if math.isfinite(low) and math.isfinite(high):
        return "revolute" if arm.joints[i] == "R" else "prismatic"
    if math.isfinite(low) or math.isfinite(high) or arm.joints[i] == "P":
        raise InvalidValue(
            "limits", (low, high), f"limits on both sides of joint {i}", "a URDF has no others; a slide has them always"
        )
    return "continuous"


def _fixed(name: str, parent: str, child: str, pose: Pose) -> Iterator[str]:
    yield f'  <joint name="{name}" type="fixed">'
    yield from _ends(parent, child, pose)
    yield "  </joint>"


def _ends(parent: str, child: str, pose: Pose) -> Iterator[str]:
    yield f'    <parent link="{parent}"/>'
    yield f'    <child link="{child}"/>'
    yield f'    <origin xyz="{float(pose.x)!r} {float(pose.y)!r} 0" rpy="0 0 {float(pose.theta)!r}"/>'


def _box(name: str, length: float, thick: float) -> Iterator[str]:
    yield f'  <link name="{name}">'
    if length > 0.0:
        yield f'    <visual><origin xyz="{length / 2!r} 0 0"/>'
        yield f'      <geometry><box size="{length!r} {thick!r} {thick!r}"/></geometry></visual>'
    yield "  </link>"


def _quoted(name: str, word: str) -> str:
    """A name as XML holds it.

    Raises:
        InvalidValue: If it holds what XML does not.
    """
    if not isinstance(word, str) or not word or not word.isprintable():
        raise InvalidValue(name, word, "words without control characters")
    return quoteattr(word)
