"""What a sweep gives: a table, one row a run."""

from __future__ import annotations

import importlib
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from coplanar.errors import InvalidValue, MissingExtra, UnknownName
from coplanar.run.files import write_table, written_whole
from coplanar.sweeps.plan import Plan
from coplanar.sweeps.task import PROBLEM, Columns

SUFFIXES = (".csv", ".parquet")


@dataclass(frozen=True, slots=True, eq=False)
class Sweep:
    """Columns by name: first the varied keys, then what was measured.

    A row that could not run has NaN for its numbers, and the sentence why in the column "problem".

    Attributes:
        columns: Name to values, shape (rows,) each.
        varied: The names of the varied keys.
        name: The scenario's name.
    """

    columns: Mapping[str, np.ndarray]
    varied: tuple[str, ...]
    name: str

    @classmethod
    def of(cls, plan: Plan, parts: Iterable[Columns]) -> Sweep:
        """The table of a plan, from what its tasks found, in their order."""
        found = list(parts)
        names = dict.fromkeys(name for columns in found for name in columns)
        sizes = [len(next(iter(columns.values()))) for columns in found]
        whole = {
            name: [v for columns, size in zip(found, sizes, strict=True) for v in _filled(columns, name, size)]
            for name in names
        }
        return cls({**plan.columns, **_flat(whole)}, tuple(plan.columns), plan.scenario.name)

    def __getitem__(self, name: str) -> np.ndarray:
        """The column of that name.

        Raises:
            UnknownName: If there is none.
        """
        if name not in self.columns:
            raise UnknownName("column", name, self.columns)
        return self.columns[name]

    def __len__(self) -> int:
        """How many rows."""
        return len(next(iter(self.columns.values())))

    @property
    def measured(self) -> tuple[str, ...]:
        """The names of what was measured."""
        return tuple(name for name in self.columns if name not in self.varied and name != PROBLEM)

    @property
    def problems(self) -> int:
        """How many rows could not run."""
        return int(np.count_nonzero(self.columns[PROBLEM] != "")) if PROBLEM in self.columns else 0

    def statistics(self) -> dict[str, dict[str, float]]:
        """Mean, standard deviation, smallest, median and largest of every measured number, where it is finite.

        Example:
            >>> Sweep({"k": np.arange(3.0), "error": np.array([1.0, 2.0, 6.0])}, ("k",), "x").statistics()["error"]
            {'mean': 3.0, 'deviation': 2.160246899469287, 'smallest': 1.0, 'median': 2.0, 'largest': 6.0, 'finite': 3}
        """
        told = {}
        for name in self.measured:
            values = self.columns[name]
            finite = values[np.isfinite(values)] if values.dtype.kind == "f" else np.empty(0)
            if finite.size:
                told[name] = {
                    "mean": float(finite.mean()), "deviation": float(finite.std()), "smallest": float(finite.min()),
                    "median": float(np.median(finite)), "largest": float(finite.max()), "finite": finite.size,
                }  # fmt: skip
        return told

    def write(self, path: str | os.PathLike[str]) -> Path:
        """Write the table as .csv or .parquet, whole or not at all.

        Raises:
            InvalidValue: If the suffix is another.
            MissingExtra: For .parquet, if pyarrow is not installed.
        """
        target = checked_table(Path(path))
        if target.suffix == ".csv":
            return write_table(target, {name: _cells(values) for name, values in self.columns.items()})
        import pyarrow
        from pyarrow import parquet

        table = pyarrow.table({name: values.tolist() for name, values in self.columns.items()})
        with written_whole(target) as part:
            parquet.write_table(table, part)
        return target

    def to_dataframe(self) -> Any:
        """The table as a pandas DataFrame.

        Raises:
            MissingExtra: If pandas is not installed.
        """
        try:
            pandas = importlib.import_module("pandas")
        except ImportError:
            raise MissingExtra("pandas") from None
        return pandas.DataFrame(dict(self.columns))

    def plot(self, measure: str, ax: Any = None) -> Any:
        """A measure against one varied key, or over two of them; returns the axes.

        Raises:
            UnknownName: If there is no such column.
            InvalidValue: If it holds no numbers, or no key or more than two keys with numbers are varied.
        """
        from coplanar.sweeps.picture import plot_sweep

        return plot_sweep(self, measure, ax)


def checked_table(path: Path) -> Path:
    """A path that a table can be written to.

    Raises:
        InvalidValue: If its suffix is none of those known.
        MissingExtra: For .parquet, if pyarrow is not installed.
    """
    if path.suffix not in SUFFIXES:
        raise InvalidValue("path", str(path), f"a name that ends in {' or '.join(SUFFIXES)}")
    if path.suffix == ".parquet":
        try:
            importlib.import_module("pyarrow")
        except ImportError:
            raise MissingExtra("pyarrow", "logs") from None
    return path


def _filled(columns: Columns, name: str, size: int) -> list[Any]:
    return columns.get(name, ["" if name == PROBLEM else float("nan")] * size)


def _flat(columns: Mapping[str, list[Any]]) -> dict[str, np.ndarray]:
    """Arrays of one value a row: an entry that is a list becomes a column for each of its places."""
    flat: dict[str, np.ndarray] = {}
    for name, values in columns.items():
        width = max((len(v) for v in values if isinstance(v, list)), default=0)
        if not width:
            flat[name] = _column(values)
        for k in range(width):
            flat[f"{name}.{k}"] = _column(
                [v[k] if isinstance(v, list) and k < len(v) else float("nan") for v in values]
            )
    return flat


def _column(values: list[Any]) -> np.ndarray:
    kinds = {type(value) for value in values}
    if kinds <= {bool}:
        return np.array(values, dtype=bool)
    if kinds <= {int, float, bool, type(None)}:
        return np.array([float("nan") if v is None else v for v in values], dtype=np.float64)
    return np.array(["" if v != v else str(v) for v in values], dtype=object)


def _cells(values: np.ndarray) -> list[Any]:
    """Numbers as they are; words quoted where a comma or a quote is in them."""
    if values.dtype.kind in "fi":
        return list(values)
    return [_quoted(v) if isinstance(v, str) else int(v) if isinstance(v, bool | np.bool_) else v for v in values]


def _quoted(text: str) -> str:
    plain = " ".join(text.split())
    return '"' + plain.replace('"', '""') + '"' if set(plain) & set(',"') else plain
