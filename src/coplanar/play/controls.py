"""What can be set on a tab, with its range: everything that enters a state passes one of these."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any

from coplanar.errors import InvalidShape, InvalidValue, UnknownName

State = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Control:
    """What every control has.

    Attributes:
        key: Its name in the state.
        label: What it is called on the page.
        group: Under which heading it stands.
        help: One sentence.
        only: For which values of other controls it matters: key -> values; the page may hide it otherwise.
    """

    key: str
    label: str
    _: KW_ONLY
    group: str = ""
    help: str = ""
    only: Mapping[str, tuple[Any, ...]] | None = None

    def described(self, kind: str, **more: Any) -> dict[str, Any]:
        """The control as the page reads it."""
        common = {"key": self.key, "label": self.label, "kind": kind, "group": self.group, "help": self.help}
        only = {} if self.only is None else {"only": {key: list(values) for key, values in self.only.items()}}
        return common | only | more


@dataclass(frozen=True, slots=True)
class Slider(Control):
    """A number in a range.

    Attributes:
        low: Smallest value.
        high: Largest value.
        step: What the slider moves by; other numbers in the range are taken as they are.
        default: Where it begins.
        unit: Empty for numbers without one.
        scale: "linear" or "log": how the slider is divided.
    """

    low: float
    high: float
    step: float
    default: float
    unit: str = ""
    scale: str = "linear"

    def checked(self, value: Any) -> float:
        """The number as a float.

        Raises:
            InvalidValue: If it is not a finite number in the range.
        """
        needed = f"a number from {self.low:g} to {self.high:g}{f' {self.unit}' if self.unit else ''}"
        if isinstance(value, bool) or not isinstance(value, int | float) or not self.low <= value <= self.high:
            raise InvalidValue(self.key, value, needed)
        return float(value)

    def as_mapping(self) -> dict[str, Any]:
        """The control as the page reads it."""
        return self.described(
            "slider", unit=self.unit, min=self.low, max=self.high, step=self.step, default=self.default,
            scale=self.scale,
        )  # fmt: skip


@dataclass(frozen=True, slots=True)
class Choice(Control):
    """One of a few names.

    Attributes:
        options: Pairs (value, label).
        default: A value.
    """

    options: tuple[tuple[str, str], ...]
    default: str

    def checked(self, value: Any) -> str:
        """The value.

        Raises:
            UnknownName: If it is none of the options.
        """
        known = [option for option, _ in self.options]
        if not isinstance(value, str) or value not in known:
            raise UnknownName(self.key, value, known)
        return value

    def as_mapping(self) -> dict[str, Any]:
        """The control as the page reads it."""
        options = [{"value": value, "label": label} for value, label in self.options]
        return self.described("choice", options=options, default=self.default)


@dataclass(frozen=True, slots=True)
class Switch(Control):
    """On or off."""

    default: bool

    def checked(self, value: Any) -> bool:
        """The value.

        Raises:
            InvalidValue: If it is neither true nor false.
        """
        if not isinstance(value, bool):
            raise InvalidValue(self.key, value, "true or false")
        return value

    def as_mapping(self) -> dict[str, Any]:
        """The control as the page reads it."""
        return self.described("switch", default=self.default)


@dataclass(frozen=True, slots=True)
class Stroke(Control):
    """A line drawn by hand: points [x, y]; empty until something is drawn.

    Attributes:
        most: How many points at most.
        reach: Largest absolute coordinate [m].
        picture: On which picture it is drawn.
    """

    most: int = 400
    reach: float = 20.0
    picture: str = "main"

    @property
    def default(self) -> list[list[float]]:
        """Nothing drawn."""
        return []

    def checked(self, value: Any) -> list[list[float]]:
        """The points, neighbours that coincide taken as one.

        Raises:
            InvalidShape: If they are not points [x, y], or too many.
            InvalidValue: If a coordinate is not a finite number in reach.
        """
        if not isinstance(value, Sequence) or isinstance(value, str) or len(value) > self.most:
            raise InvalidShape(self.key, _size(value), f"at most {self.most} points [x, y]")
        points: list[list[float]] = []
        for entry in value:
            point = point_of(self.key, entry, self.reach)
            if not points or point != points[-1]:
                points.append(point)
        return points

    def as_mapping(self) -> dict[str, Any]:
        """The control as the page reads it."""
        return self.described("stroke", most=self.most, reach=self.reach, picture=self.picture, default=[])


@dataclass(frozen=True, slots=True)
class Rows(Control):
    """A list of rows of the same fields: wheels, segments.

    Attributes:
        fields: Controls of one row.
        default: Rows.
        most: How many rows at most.
        row: What one row is called.
        least: How many rows at least.
        first: The number of the first row.
    """

    fields: tuple[Slider | Choice | Switch, ...]
    default: list[State]
    most: int
    row: str
    least: int = 1
    first: int = 1

    def checked(self, value: Any) -> list[State]:
        """The rows, missing fields filled with their defaults.

        Raises:
            InvalidShape: If it is no list of rows, too short or too long.
            InvalidInput: As the fields do, naming the row.
        """
        if not isinstance(value, list) or not self.least <= len(value) <= self.most:
            raise InvalidShape(self.key, _size(value), f"{self.least} to {self.most} rows")
        return [checked_state(self.fields, row, prefix=f"{self.key}.{i}") for i, row in enumerate(value)]

    def as_mapping(self) -> dict[str, Any]:
        """The control as the page reads it."""
        fields = [one.as_mapping() for one in self.fields]
        return self.described(
            "list", fields=fields, min=self.least, max=self.most, row=self.row, first=self.first, default=self.default
        )


AnyControl = Slider | Choice | Switch | Stroke | Rows


def checked_state(controls: Sequence[AnyControl], given: Any, *, prefix: str = "") -> State:
    """The complete state: what is given, checked, and the defaults of what is missing.

    Raises:
        InvalidInput: Naming the key, what was given and what was needed.
    """
    name = prefix or "state"
    if not isinstance(given, Mapping):
        raise InvalidValue(name, given, "a mapping from keys to values")
    known = {control.key: control for control in controls}
    for key in given:
        if key not in known:
            raise UnknownName(f"{name}.key" if prefix else "key", key, known)
    state: State = {}
    for key, control in known.items():
        try:
            state[key] = control.checked(given[key]) if key in given else control.checked(control.default)
        except (InvalidShape, InvalidValue, UnknownName) as error:
            if not prefix or error.name.startswith(prefix):
                raise
            raise InvalidValue(f"{prefix}.{error.name}", error.given, error.needed) from None
    return state


def clipped(controls: Sequence[AnyControl], key: str, value: float) -> float:
    """The nearest value that the slider of this key allows, for what follows from a drag."""
    slider = next(control for control in controls if control.key == key and isinstance(control, Slider))
    return min(max(value, slider.low), slider.high)


def point_of(name: str, value: Any, reach: float) -> list[float]:
    """A point [x, y] of finite numbers within ``reach``.

    Raises:
        InvalidShape: If it is not two numbers.
        InvalidValue: If one is not finite or too large.
    """
    if not isinstance(value, Sequence) or isinstance(value, str) or len(value) != 2:
        raise InvalidShape(name, _size(value), "a point [x, y]")
    for entry in value:
        number = isinstance(entry, int | float) and not isinstance(entry, bool)
        if not number or not abs(entry) <= reach or not math.isfinite(entry):
            raise InvalidValue(name, entry, f"numbers from {-reach:g} to {reach:g}")
    return [float(value[0]), float(value[1])]


def _size(value: Any) -> str:
    if isinstance(value, Sequence) and not isinstance(value, str):
        return f"{len(value)} entries"
    return f"a {type(value).__name__}"
