"""One wheel of a base."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import pi

import numpy as np

from coplanar import checks
from coplanar.errors import InvalidShape, InvalidValue


@dataclass(frozen=True, slots=True)
class Wheel:
    """A wheel of a base, seen from above; the body frame has x forward and y to the left.

    Attributes:
        x: Forward position of the contact [m].
        y: Position of the contact to the left [m].
        drive_angle: beta, where the contact is driven by a positive rate; counterclockwise from x [rad].
        radius: r [m].
        roller_angle: gamma, from the drive direction to the axle of the roller that touches the ground,
            counterclockwise [rad]: 0 plain omni, +-pi/4 mecanum. None is an ordinary wheel: no sideways velocity.
        name: What to call it; the base numbers the wheels that have none.

    Raises:
        InvalidShape: If a value is not one number.
        InvalidValue: If something is not finite, the radius is not positive, or the roller angle is not between
            -pi/2 and pi/2 (at +-pi/2 the rollers would turn along the drive direction, and nothing is driven).

    Example:
        >>> Wheel(0.0, 0.2, drive_angle=0.0, radius=0.05, name="left").is_ordinary
        True
    """

    x: float
    y: float
    drive_angle: float
    radius: float
    roller_angle: float | None = None
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        for entry in ("x", "y", "drive_angle"):
            object.__setattr__(self, entry, number(entry, getattr(self, entry)))
        object.__setattr__(self, "radius", positive_number("radius", self.radius))
        if self.roller_angle is not None:
            gamma = number("roller_angle", self.roller_angle)
            if not abs(gamma) < pi / 2:
                raise InvalidValue(
                    "roller_angle", gamma, "between -pi/2 and pi/2 [rad]", "0 is a plain omni wheel, +-pi/4 mecanum"
                )
            object.__setattr__(self, "roller_angle", gamma)

    @property
    def is_ordinary(self) -> bool:
        """Whether it has no rollers, and so no sideways velocity."""
        return self.roller_angle is None


def number(name: str, value: float) -> float:
    """One finite number.

    Raises:
        InvalidShape: If it is an array.
        InvalidValue: If it is not finite.
    """
    checked = checks.real(name, value)
    if np.ndim(checked):
        raise InvalidShape(name, f"shape {np.shape(checked)}", "one number", "a base is not batched; its rates are")
    return float(checked)


def positive_number(name: str, value: float) -> float:
    """One finite number greater than zero.

    Raises:
        InvalidShape: If it is an array.
        InvalidValue: If it is not finite and positive.
    """
    return number(name, checks.positive(name, value))
