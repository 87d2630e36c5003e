"""Numbers by dimension: plain ones are SI and radians; at this edge alone "30 deg" and "12 in" are read as well."""

from __future__ import annotations

import difflib
import math
import re
from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from coplanar.scenarios.arithmetic import UNITS, Dimensions, measured

LARGEST = 1e12  # of any number of a scenario, in SI units: far beyond every robot, far below what overflows


@dataclass(frozen=True, slots=True)
class Dimension:
    """What a number measures.

    Attributes:
        name: In a sentence, with its article: "a length".
        unit: Its SI unit; empty for a plain number.
        exponents: Of length, time, mass and angle; more than one where either will do.
        example: How somebody may write it.
    """

    name: str
    unit: str
    exponents: tuple[Dimensions, ...]
    example: str

    @property
    def words(self) -> str:
        """What is needed, as errors say it."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


NUMBER = Dimension("a number", "", ((0, 0, 0, 0),), "0.5")
LENGTH = Dimension("a length", "m", ((1, 0, 0, 0),), "20 cm")
ANGLE = Dimension("an angle", "rad", ((0, 0, 0, 1),), "30 deg")
JOINT = Dimension("an angle, or the length of a slide", "rad or m", ((0, 0, 0, 1), (1, 0, 0, 0)), "30 deg")
TIME = Dimension("a time", "s", ((0, 1, 0, 0),), "20 ms")
MASS = Dimension("a mass", "kg", ((0, 0, 1, 0),), "150 g")
AREA = Dimension("an area", "m^2", ((2, 0, 0, 0),), "12 cm^2")
SPEED = Dimension("a speed", "m/s", ((1, -1, 0, 0),), "3 km/h")
TURN_RATE = Dimension("a rate of turn", "rad/s", ((0, -1, 0, 1),), "90 deg/s")
ACCELERATION = Dimension("an acceleration", "m/s^2", ((1, -2, 0, 0),), "0.5 m/s^2")
TURN_ACCELERATION = Dimension("a turn acceleration", "rad/s^2", ((0, -2, 0, 1),), "90 deg/s^2")
DRAG = Dimension("a drag", "kg/m", ((-1, 0, 1, 0),), "20 g/m")
DRAG_PER_MASS = Dimension("a drag over mass", "1/m", ((-1, 0, 0, 0),), "0.02/m")
DENSITY = Dimension("a density", "kg/m^3", ((-3, 0, 1, 0),), "1.2 kg/m^3")
RATE = Dimension("a gain", "1/s", ((0, -1, 0, 0),), "3/s")
RATE_SQUARED = Dimension("a gain", "1/s^2", ((0, -2, 0, 0),), "3/s^2")
KNOWN = (
    NUMBER, LENGTH, ANGLE, TIME, MASS, AREA, SPEED, TURN_RATE, ACCELERATION, TURN_ACCELERATION, DRAG, RATE,
    RATE_SQUARED, DRAG_PER_MASS, DENSITY,
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Quantity:
    """How a field of one dimension is read, and what its schema says.

    Attributes:
        dimension: What it measures.
        above: It is greater than this.
        least: It is this or more.
        below: It is less than this.
        most: It is this or less.

    Example:
        >>> Quantity(LENGTH, above=0.0).read("12 in").__round__(4), Quantity(ANGLE).read(1)
        (0.3048, 1.0)
    """

    dimension: Dimension
    above: float | None = None
    least: float | None = None
    below: float | None = None
    most: float | None = None

    @property
    def words(self) -> str:
        """What is needed, with its bounds."""
        named = (("above", self.above), ("at least", self.least), ("below", self.below), ("at most", self.most))
        bounds = " and ".join(f"{name} {value:g}" for name, value in named if value is not None)
        return f"{self.dimension.words} {bounds}" if bounds else self.dimension.words

    def read(self, given: Any) -> float:
        """The number in SI units.

        Raises:
            PydanticCustomError: With what is needed, and what to do.
        """
        value = self._number(given)
        if not math.isfinite(value) or abs(value) > LARGEST:
            raise self._refused(f"a finite number of at most {LARGEST:g} in size")
        tests = (
            (self.above, value.__gt__), (self.least, value.__ge__),
            (self.below, value.__lt__), (self.most, value.__le__),
        )  # fmt: skip
        if not all(bound is None or test(bound) for bound, test in tests):
            raise self._refused()
        return value

    def _number(self, given: Any) -> float:
        if isinstance(given, bool) or not isinstance(given, int | float | str):
            raise self._refused("yes and no are no numbers" if isinstance(given, bool) else "")
        if not isinstance(given, str):
            return float(given) if abs(given) <= LARGEST else math.inf
        try:
            value, dimensions = measured(given)
        except ValueError as error:
            raise self._refused(_with_near_unit(str(error))) from None
        if dimensions is not None and dimensions not in self.dimension.exponents:
            raise self._refused(_instead(dimensions, self.dimension.example))
        return value

    def _refused(self, remedy: str = "") -> PydanticCustomError:
        return PydanticCustomError("quantity", "needed {needed}", {"needed": self.words, "remedy": remedy})

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Read by ``read``."""
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """A number within the bounds, or a text."""
        named = {
            "exclusiveMinimum": self.above, "minimum": self.least, "exclusiveMaximum": self.below, "maximum": self.most,
        }  # fmt: skip
        number = {"type": "number"} | {name: value for name, value in named.items() if value is not None}
        text = {"type": "string", "examples": [self.dimension.example]}
        return {"anyOf": [number, text], "x-unit": self.dimension.unit}


def _with_near_unit(sentence: str) -> str:
    """The sentence, with the unit that was probably meant."""
    quoted = re.match(r"'(\w+)' is no unit", sentence)
    near = difflib.get_close_matches(quoted[1].lower(), UNITS, n=1) if quoted else []
    return f"{sentence}: did you mean {near[0]!r}?" if near else sentence


def _instead(dimensions: Dimensions, example: str) -> str:
    names = [known.name for known in KNOWN if dimensions in known.exponents]
    what = f"its unit is that of {names[0]}" if names else "its unit is another one"
    return f"{what}; write it like {example!r}"


Number = Annotated[float, Quantity(NUMBER)]
Positive = Annotated[float, Quantity(NUMBER, above=0.0)]
Length = Annotated[float, Quantity(LENGTH)]
PositiveLength = Annotated[float, Quantity(LENGTH, above=0.0)]
Distance = Annotated[float, Quantity(LENGTH, least=0.0)]
Angle = Annotated[float, Quantity(ANGLE)]
Joint = Annotated[float, Quantity(JOINT)]
Duration = Annotated[float, Quantity(TIME, above=0.0)]
Time = Annotated[float, Quantity(TIME, least=0.0)]
Mass = Annotated[float, Quantity(MASS, above=0.0)]
Speed = Annotated[float, Quantity(SPEED)]
PositiveSpeed = Annotated[float, Quantity(SPEED, above=0.0)]
SpeedSpread = Annotated[float, Quantity(SPEED, least=0.0)]
AngleSpread = Annotated[float, Quantity(ANGLE, least=0.0)]
TurnRate = Annotated[float, Quantity(TURN_RATE)]
PositiveTurnRate = Annotated[float, Quantity(TURN_RATE, above=0.0)]
TurnRateSpread = Annotated[float, Quantity(TURN_RATE, least=0.0)]
Acceleration = Annotated[float, Quantity(ACCELERATION)]
PositiveAcceleration = Annotated[float, Quantity(ACCELERATION, above=0.0)]
Gravity = Annotated[float, Quantity(ACCELERATION, least=0.0)]
TurnAcceleration = Annotated[float, Quantity(TURN_ACCELERATION)]
PositiveTurnAcceleration = Annotated[float, Quantity(TURN_ACCELERATION, above=0.0)]
Drag = Annotated[float, Quantity(DRAG, least=0.0)]
DragPerMass = Annotated[float, Quantity(DRAG_PER_MASS, least=0.0)]
Density = Annotated[float, Quantity(DENSITY, least=0.0)]
Area = Annotated[float, Quantity(AREA, least=0.0)]
NotNegative = Annotated[float, Quantity(NUMBER, least=0.0)]
Gain = Annotated[float, Quantity(RATE)]
PositiveGain = Annotated[float, Quantity(RATE, above=0.0)]
GainPerTime = Annotated[float, Quantity(RATE_SQUARED, least=0.0)]

Point = tuple[Length, Length]
Velocity = tuple[Speed, Speed]
