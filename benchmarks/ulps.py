"""Worst error of the primitives in units of the last place, against mpmath."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from benchmarks.truth import exact, mp
from coplanar.engine import atan2, cos, evaluator, exp, expm1, hypot, log1p, sin, sinc, sqrt, tan


@dataclass(frozen=True, slots=True)
class Ulps:
    """One primitive on one range: worst error [ulp] in floats, as NumPy text, compiled."""

    primitive: str
    range: str
    floats: float
    text: float
    compiled: float


def law_sin(x: Any) -> Any:
    """Sine."""
    return sin(x)


def law_cos(x: Any) -> Any:
    """Cosine."""
    return cos(x)


def law_tan(x: Any) -> Any:
    """Tangent."""
    return tan(x)


def law_sinc(x: Any) -> Any:
    """Sin(x)/x."""
    return sinc(x)


def law_exp(x: Any) -> Any:
    """Exponential."""
    return exp(x)


def law_expm1(x: Any) -> Any:
    """Exponential less 1."""
    return expm1(x)


def law_log1p(x: Any) -> Any:
    """Logarithm of 1 + x."""
    return log1p(x)


def law_sqrt(x: Any) -> Any:
    """Root."""
    return sqrt(x)


def law_atan2(y: Any, x: Any) -> Any:
    """Angle of a direction."""
    return atan2(y, x)


def law_hypot(y: Any, x: Any) -> Any:
    """Length."""
    return hypot(y, x)


CASES: tuple[tuple[Callable[..., Any], Callable[..., Any], tuple[float, float], int], ...] = (
    (law_sin, mp.sin, (-3.2, 3.2), 1),
    (law_sin, mp.sin, (-1e3, 1e3), 1),
    (law_cos, mp.cos, (-1e3, 1e3), 1),
    (law_tan, mp.tan, (-1.5, 1.5), 1),
    (law_sinc, lambda x: mp.sin(x) / x if x else mp.mpf(1), (-3.2, 3.2), 1),
    (law_exp, mp.exp, (-20.0, 20.0), 1),
    (law_expm1, mp.expm1, (-1.0, 3.0), 1),
    (law_log1p, mp.log1p, (-0.9, 20.0), 1),
    (law_sqrt, mp.sqrt, (0.0, 10.0), 1),
    (law_atan2, mp.atan2, (-3.0, 3.0), 2),
    (law_hypot, mp.hypot, (-3.0, 3.0), 2),
)


def primitive_errors(samples: int) -> list[Ulps]:
    """Worst errors over random arguments."""
    rng, table = np.random.default_rng(9), []
    for law, truth, (low, high), count in CASES:
        columns = [rng.uniform(low, high, samples) for _ in range(count)]
        wanted = [truth(*exact(row)) for row in zip(*columns, strict=True)]
        run = evaluator(law)
        floats = np.array([run.on_floats(*map(float, row)) for row in zip(*columns, strict=True)])
        answers = (floats, run.on_text(*columns), run.on_compiled(*columns))
        errors = (_worst(answer, wanted) for answer in answers)
        table.append(Ulps(law.__name__.removeprefix("law_"), f"{low:g} ... {high:g}", *errors))
    return table


def _worst(answer: np.ndarray, wanted: list[Any]) -> float:
    errors = (
        abs(mp.mpf(float(a)) - w) / mp.mpf(float(np.spacing(abs(float(w)))))
        for a, w in zip(answer, wanted, strict=True)
    )
    return float(max(errors))
