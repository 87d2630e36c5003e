"""Forward and inverse kinematics of one arm."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Any

import typer

from coplanar.cli.answers import Answer, Fact, give
from coplanar.cli.arguments import Json, maybe, quantities, quantity
from coplanar.errors import InvalidValue

if TYPE_CHECKING:
    from coplanar.arms import Arm, Solution
    from coplanar.se2 import Pose


class Angles(StrEnum):
    """What a joint angle is measured from."""

    RELATIVE = "relative"
    ABSOLUTE = "absolute"


class Elbow(StrEnum):
    """A branch: the sign of the sine at the elbow."""

    POSITIVE = "positive"
    NEGATIVE = "negative"


class Method(StrEnum):
    """How joints are found."""

    AUTO = "auto"
    CLOSED = "closed"
    NUMERICAL = "numerical"


Links = Annotated[list[str], typer.Option("--links", metavar="L1 L2 ...", help="Length of every link [m].")]
Joints = Annotated[str | None, typer.Option(metavar="RP...", help="R turns, P slides; a letter a link. [all R]")]
Convention = Annotated[Angles, typer.Option(help="From the link before, or from the base's x axis.")]
Triple = tuple[str, str, str]
Base = Annotated[Triple, typer.Option(metavar="X Y THETA", help="Where the arm stands.")]
Tool = Annotated[Triple, typer.Option(metavar="X Y THETA", help="The tool in the last link's frame.")]


def fk(
    links: Links,
    q: Annotated[list[str], typer.Option("--q", metavar="Q1 Q2 ...", help="Joint variables [rad or m].")],
    joints: Joints = None,
    angles: Convention = Angles.RELATIVE,
    base: Base = ("0", "0", "0"),
    tool: Tool = ("0", "0", "0"),
    as_json: Json = False,
) -> None:
    """Where an arm is: pose of its tool, points, Jacobian, ellipse.

    Example: coplanar fk --links 0.4 0.3 --q "30 deg" -0.5
    """
    from coplanar.scenarios.quantities import JOINT

    arm = arm_of(links, joints, angles, base, tool)
    at = list(quantities("q", q, JOINT))
    pose, jacobian = arm.kinematics(at)
    ellipse = arm.ellipse(at)
    facts = (
        Fact("position", [pose.x, pose.y], "m"),
        Fact("heading", pose.theta, "rad"),
        Fact("points", arm.points(at), "m"),
        Fact("jacobian", jacobian),
        Fact("manipulability", arm.manipulability(at)),
        Fact("ellipse radii", ellipse.radii, "m/rad"),
        Fact("ellipse angle", ellipse.angle, "rad"),
    )
    give(Answer("the tool of the arm in the world", facts), as_json)


def ik(
    links: Links,
    target: Annotated[tuple[str, str], typer.Option(metavar="X Y", help="Where the tool should be [m].")],
    heading: Annotated[str | None, typer.Option(metavar="ANGLE", help="Where it should point [rad].")] = None,
    elbow: Annotated[Elbow | None, typer.Option(help="Take this branch.  [the nearest]")] = None,
    near: Annotated[list[str] | None, typer.Option(metavar="Q1 Q2 ...", help="Joints to come nearest to.")] = None,
    limits: Annotated[list[str] | None, typer.Option(metavar="LOW:HIGH ...", help="Of every joint; or free.")] = None,
    method: Annotated[Method, typer.Option(help="In closed form where there is one.")] = Method.AUTO,
    tolerance: Annotated[str, typer.Option(help="Distance that counts as reached.")] = "1e-9 m",
    iterations: Annotated[int, typer.Option(help="Budget of the search.", min=1, max=100_000)] = 100,
    joints: Joints = None,
    angles: Convention = Angles.RELATIVE,
    base: Base = ("0", "0", "0"),
    tool: Tool = ("0", "0", "0"),
    as_json: Json = False,
) -> None:
    """Joints that bring the tool of an arm to a target.

    Every branch is said; out of reach, the nearest point and the gap, and the exit code is 1.

    Example: coplanar ik --links 0.4 0.3 --target -0.3 0.4 --elbow negative
    """
    from coplanar.scenarios.quantities import JOINT, LENGTH

    arm = arm_of(links, joints, angles, base, tool, limits)
    solution = arm.inverse(
        _goal(target, heading),
        near=list(quantities("near", near, JOINT)) if near else None,
        elbow={None: None, Elbow.POSITIVE: 1, Elbow.NEGATIVE: -1}[elbow],
        method=method.value,
        tolerance=quantity("tolerance", tolerance, LENGTH),
        iterations=iterations,
    )
    give(Answer(solution.status.value, _solved(solution), ok=bool(solution.reached)), as_json)


def arm_of(
    links: list[str], joints: str | None, angles: Angles, base: Triple, tool: Triple, limits: list[str] | None = None
) -> Arm:
    """The arm that the options describe."""
    from coplanar.arms import Arm
    from coplanar.scenarios.quantities import LENGTH

    return Arm(
        quantities("links", links, LENGTH), joints=joints, angles=angles.value, base=_pose("base", base),
        tool=_pose("tool", tool), limits=None if not limits else [_pair(text) for text in limits],
    )  # fmt: skip


def _goal(target: tuple[str, str], heading: str | None) -> Any:
    from coplanar.scenarios.quantities import ANGLE, LENGTH
    from coplanar.se2 import Pose

    x, y = quantities("target", target, LENGTH, LENGTH)
    theta = maybe("heading", heading, ANGLE)
    return (x, y) if theta is None else Pose(x, y, theta)


def _pose(name: str, parts: Triple) -> Pose:
    from coplanar.scenarios.quantities import ANGLE, LENGTH
    from coplanar.se2 import Pose

    return Pose(*quantities(name, parts, LENGTH, LENGTH, ANGLE))


def _pair(text: str) -> tuple[float, float] | None:
    """The limits of one joint."""
    from coplanar.scenarios.quantities import JOINT

    if text.strip() == "free":
        return None
    low, colon, high = text.partition(":")
    if not colon:
        raise InvalidValue("limits", text, "LOW:HIGH or free for every joint", "write -90deg:90deg")
    return quantity("limits", low, JOINT), quantity("limits", high, JOINT)


def _solved(solution: Solution) -> tuple[Fact, ...]:
    """What an inverse says."""
    branches = [
        {"elbow": {1: "positive", -1: "negative"}.get(sign, "-"), "within limits": bool(allowed), "q": branch}
        for sign, allowed, branch in zip((1, -1), solution.allowed.tolist(), solution.branches.tolist(), strict=False)
    ]
    if len(branches) == 1:
        branches[0]["elbow"] = "-"
    return (
        Fact("code", solution.status.name),
        Fact("q", solution.q, "rad" if set(solution.chain.joints) == {"R"} else "rad or m"),
        Fact("gap", solution.gap, "m"),
        Fact("nearest", solution.nearest, "m"),
        Fact("heading error", solution.heading_error(), "rad"),
        Fact("smallest singular value", solution.singular_value(), "m/rad"),
        Fact("iterations", solution.iterations),
        Fact("branches", branches),
    )
