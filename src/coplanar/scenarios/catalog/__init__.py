"""The demonstrations of planar robotics as scenario files, in the order of a course."""

from __future__ import annotations

from importlib import resources

from coplanar.scenarios.problems import InvalidScenario, Problem, did_you_mean

_NAMES = (
    "frames",
    "arm-pose",
    "arm-reach",
    "trace-circle",
    "trace-lemniscate",
    "rolling-wheel",
    "drive-square",
    "arc-chain",
    "clothoid",
    "holonomic",
    "omni-three",
    "mecanum",
    "ramp",
    "track-astroid",
    "track-astroid-p",
    "drive-to-pose",
    "shot",
    "aim-time",
    "aim-speed",
    "aim-angle",
    "aim-least",
    "integrators",
)


def names() -> tuple[str, ...]:
    """The names of all demonstrations.

    Example:
        >>> "track-astroid" in names()
        True
    """
    return _NAMES


def found(name: str) -> str:
    """The name itself, or the only one of which it is the end.

    Raises:
        InvalidScenario: If there is none, or more than one.

    Example:
        >>> found("reach")
        'arm-reach'
    """
    if name in _NAMES:
        return name
    ends = [known for known in _NAMES if known.endswith(f"-{name}")]
    if len(ends) == 1:
        return ends[0]
    needed = f"a path that ends in .yaml, .toml or .json, or one of {', '.join(ends or _NAMES)}"
    raise InvalidScenario([Problem("", repr(name[:60]), needed, did_you_mean(name, _NAMES))], "scenario")


def text(name: str) -> str:
    """The file of a demonstration.

    Raises:
        InvalidScenario: If there is no such name.
    """
    return resources.files(__name__).joinpath(f"{found(name)}.yaml").read_text("utf-8")
