"""What a tab answers: pictures, handles, readouts, sentences, series."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from coplanar.viz.scene import Scene

TONES = ("good", "note", "warn", "no")
SHOWN_DIGITS = 6  # of a number that is read


@dataclass(frozen=True, slots=True)
class Handle:
    """Something that can be taken by hand.

    Attributes:
        name: Its id.
        label: What it is called.
        at: Where it is, in the axes' unit.
        step: How far an arrow key moves it [unit of the axes, or rad where it turns].
        about: The point that it turns about; None where it moves freely.
        picture: On which picture.
        value: What a screen reader says of where it is.
    """

    name: str
    label: str
    at: tuple[float, float]
    step: float = 0.02
    about: tuple[float, float] | None = None
    picture: str = "main"
    value: str = ""

    def as_mapping(self) -> dict[str, Any]:
        """The handle as the page reads it."""
        keys = {"step": self.step, "unit": "m" if self.about is None else "rad"}
        place = [float(f"{v:.9g}") for v in self.at]
        said = self.value or f"x {self.at[0]:.3f}, y {self.at[1]:.3f}"
        return {"id": self.name, "label": self.label, "at": place, "picture": self.picture, "keys": keys, "value": said}

    def nudged(self, right: int, up: int) -> list[float]:
        """Where so many presses of the arrow keys take it."""
        x, y = self.at
        if self.about is None:
            return [x + right * self.step, y + up * self.step]
        # Right and down turn clockwise, left and up counterclockwise.
        turned = complex(x - self.about[0], y - self.about[1]) * _unit(self.step * (up - right))
        return [self.about[0] + turned.real, self.about[1] + turned.imag]


@dataclass(slots=True)
class Answer:
    """What is shown for a state.

    Attributes:
        pictures: By name; "main" first.
        handles: What can be dragged.
        readouts: Numbers beside the picture.
        sentences: What the library says of it.
        series: Curves under the picture.
        legends: What the lines of a picture are, by its name.
        complete: Whether nothing has been left out for the sake of time.
    """

    pictures: dict[str, Scene] = field(default_factory=dict)
    handles: list[Handle] = field(default_factory=list)
    readouts: list[dict[str, Any]] = field(default_factory=list)
    sentences: list[dict[str, str]] = field(default_factory=list)
    series: list[dict[str, Any]] = field(default_factory=list)
    legends: dict[str, list[dict[str, Any]]] = field(default_factory=dict)
    complete: bool = True

    def read(self, key: str, label: str, value: float | str, unit: str = "", group: str = "") -> None:
        """Add a readout; of a number the digits are chosen here."""
        entry: dict[str, Any] = {"key": key, "label": label, "value": shown(value), "unit": unit, "group": group}
        if not isinstance(value, str) and math.isfinite(value):
            entry["number"] = float(value)
        self.readouts.append(entry)

    def say(self, tone: str, text: str) -> None:
        """Add a sentence in one of ``TONES``."""
        self.sentences.append({"tone": tone, "text": text})

    def name(self, label: str, role: str, *, dashed: bool = False, picture: str = "main") -> None:
        """Add a line to the legend of a picture."""
        entry = {"label": label, "role": role} | ({"dashed": True} if dashed else {})
        self.legends.setdefault(picture, []).append(entry)

    def plot(
        self,
        title: str,
        unit: str,
        x: tuple[str, Any],
        lines: Mapping[str, Iterable[float]],
        *,
        log: bool = False,
        roles: Mapping[str, str] | None = None,
    ) -> None:
        """Add a series: ``x`` is its label and values, ``lines`` the values by name, ``roles`` their colours."""
        label, places = x
        entry = {
            "title": title, "unit": unit, "x": {"label": label, "values": _values(places)},
            "lines": [
                {"label": name, "values": _values(values), "role": (roles or {}).get(name, "")}
                for name, values in lines.items()
            ],
        }  # fmt: skip
        self.series.append(entry | ({"log": True} if log else {}))

    def as_mapping(self) -> dict[str, Any]:
        """The answer as the page reads it."""
        return {
            "complete": self.complete,
            "pictures": {name: scene.as_mapping() for name, scene in self.pictures.items()},
            "handles": [handle.as_mapping() for handle in self.handles],
            "readouts": self.readouts,
            "sentences": self.sentences,
            "series": self.series,
            "legends": self.legends,
        }


def shown(value: float | str) -> str:
    """A number as it is read: six significant digits, a true minus sign left out of rounded zeros."""
    if isinstance(value, str):
        return value
    if not math.isfinite(value):
        return "infinite" if value > 0.0 else ("minus infinite" if value < 0.0 else "undefined")
    if value and not 1e-4 <= abs(value) < 1e7:
        return f"{value:.3e}"
    return f"{round(value, 6) + 0.0:.{SHOWN_DIGITS}g}"


def _values(values: Iterable[float]) -> list[float | None]:
    """Six significant digits of the largest; None where a value is not finite."""
    array = np.asarray(values, dtype=np.float64)
    good = np.isfinite(array)
    largest = float(np.abs(array[good]).max(initial=0.0))
    if largest > 0.0 and array[good].min() > 0.0 and largest / float(array[good].min()) > 1e4:
        rounded = [float(f"{v:.6g}") for v in array.tolist()]
    else:
        places = 5 - math.floor(math.log10(largest)) if largest > 1e-300 else 0
        rounded = (np.round(np.where(good, array, 0.0), min(places, 300)) + 0.0).tolist()
    return [v if fine else None for v, fine in zip(rounded, good.tolist(), strict=True)]


def _unit(angle: float) -> complex:
    return complex(math.cos(angle), math.sin(angle))
