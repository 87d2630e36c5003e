"""How a run ended, and which of its columns are what."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from types import MappingProxyType
from typing import NamedTuple


class RunStatus(Enum):
    """How a run ended; the value is the sentence."""

    COMPLETE = "ran to its end"
    DIVERGED = "stopped being finite: the loop diverged"


class Kind(NamedTuple):
    """Which columns of a run are what, by name or pattern (``q*``).

    Attributes:
        states: What is integrated.
        commands: What drives it.
        errors: What is wanted to be 0.
        angles: Columns in radians, unwrapped before they are interpolated.
        held: Columns that hold over the interval that ends in their row, and are not interpolated.
    """

    states: tuple[str, ...] = ()
    commands: tuple[str, ...] = ()
    errors: tuple[str, ...] = ()
    angles: tuple[str, ...] = ()
    held: tuple[str, ...] = ()


_POSE = ("x", "y", "theta")
KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        "table": Kind(angles=("theta",)),
        "unicycle": Kind(
            _POSE, ("v", "omega"), ("ex", "ey", "rho", "alpha", "beta"), ("theta", "alpha", "beta"), ("v", "omega")
        ),
        "body": Kind(_POSE, ("vx", "vy", "omega"), (), ("theta",)),
        "arm": Kind(("q[0-9]*",), (), ("ex", "ey"), ("q[0-9]*", "theta")),
        "flight": Kind(("x", "y", "vx", "vy")),
    }
)
