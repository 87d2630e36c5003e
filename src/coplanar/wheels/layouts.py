"""Tables of wheels: differential, omni, mecanum. Lengths are taken by name, halves and wholes."""

from __future__ import annotations

from math import cos, pi, sin, tau

from coplanar.errors import InvalidValue
from coplanar.wheels.wheel import Wheel, number, positive_number

ROLLERS = {"X": -pi / 4, "O": pi / 4}  # gamma of the front left wheel [rad]


def half_length(half_name: str, half: float | None, whole_name: str, whole: float | None) -> float:
    """Half a length that was given either as a half or as a whole, never both.

    Raises:
        InvalidValue: If none or both are given, or the one is not positive.

    Example:
        >>> half_length("half_track", None, "track", 0.6)
        0.3
    """
    if (half is None) == (whole is None):
        raise InvalidValue(
            f"{half_name}, {whole_name}", (half, whole), "exactly one of them",
            f"{whole_name} is twice {half_name}",
        )  # fmt: skip
    if half is not None:
        return positive_number(half_name, half)
    return 0.5 * positive_number(whole_name, whole)  # type: ignore[arg-type]


def differential(half_track: float, left_radius: float, right_radius: float) -> tuple[Wheel, ...]:
    """Two ordinary wheels on the y axis: left, right."""
    return (
        Wheel(0.0, half_track, 0.0, left_radius, name="left"),
        Wheel(0.0, -half_track, 0.0, right_radius, name="right"),
    )


def omni(count: int, wheel_distance: float, radius: float, first_angle: float) -> tuple[Wheel, ...]:
    """Omni wheels at equal angles on a circle, each driving counterclockwise round it: beta = angle + 90 deg."""
    if not isinstance(count, int) or count < 1:
        raise InvalidValue("count", count, "a whole number of at least 1", "three omni wheels drive every direction")
    distance = positive_number("wheel_distance", wheel_distance)
    angles = [number("first_angle", first_angle) + tau * i / count for i in range(count)]
    return tuple(
        Wheel(distance * cos(a), distance * sin(a), a + pi / 2, radius, 0.0, name=f"wheel_{i}")
        for i, a in enumerate(angles, start=1)
    )


def mecanum(half_wheelbase: float, half_track: float, radius: float, front_left_roller: float) -> tuple[Wheel, ...]:
    """Four wheels that drive forward; the roller angle changes its sign from corner to neighbouring corner."""
    corners = (("front_left", 1, 1), ("front_right", 1, -1), ("rear_left", -1, 1), ("rear_right", -1, -1))
    return tuple(
        Wheel(front * half_wheelbase, left * half_track, 0.0, radius, front * left * front_left_roller, name=name)
        for name, front, left in corners
    )
