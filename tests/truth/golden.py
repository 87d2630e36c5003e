"""How a test reads a golden file, and how far two numbers are apart."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Golden:
    """The content of ``tests/truth/<topic>.json``."""

    generator: str
    versions: dict[str, str]
    tolerance: Any
    unit: str
    cases: list[dict[str, Any]]

    def of(self, kind: str) -> list[dict[str, Any]]:
        """The cases whose ``kind`` is this one; a kind without cases is a mistake in the test."""
        found = [case for case in self.cases if case.get("kind") == kind]
        if not found:
            raise LookupError(f"{self.generator} made no cases of kind {kind!r}")
        return found

    def column(self, name: str, kind: str | None = None) -> np.ndarray:
        """One entry of every case, as an array."""
        return np.array([case[name] for case in (self.cases if kind is None else self.of(kind))])


def golden(topic: str) -> Golden:
    """The golden file of a topic."""
    return Golden(**json.loads((Path(__file__).parent / f"{topic}.json").read_text(encoding="utf-8")))


def relative_error(value: Any, truth: Any) -> np.ndarray:
    """|value - truth| / |truth|, entry by entry; where the truth is 0, |value|."""
    value, truth = np.asarray(value, dtype=float), np.asarray(truth, dtype=float)
    return np.abs(value - truth) / np.where(truth == 0.0, 1.0, np.abs(truth))
