"""What every simulation returns: a table in time."""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from fnmatch import fnmatchcase
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike
from coplanar.engine import stack
from coplanar.errors import InvalidShape, InvalidValue, MissingExtra, UnknownName
from coplanar.run.files import read_table, write_table
from coplanar.run.kinds import KINDS, Kind, RunStatus
from coplanar.run.showing import Shown
from coplanar.run.summary import summary_of
from coplanar.se2 import Pose


@dataclass(frozen=True, slots=True, eq=False)
class Run(Shown):
    """Columns by name over one monotone column, ``t`` unless told otherwise.

    A column has shape (rows,), or (rows, ...) for a batch of robots that share the time.

    Attributes:
        columns: Name -> values; read-only.
        kind: One of ``KINDS`` (which columns are states, commands, errors, angles), or a ``Kind``.
        index: The monotone column.
        status: How it ended. Only a complete run has to be finite.
        warnings: Sentences that were known before it ran; those of a simulation are worked out when they are asked for.
        info: Whatever else belongs to it: method, gains, seed.

    Raises:
        InvalidShape: If columns differ in length, or ``index`` is not a vector.
        InvalidValue: If there is no ``index`` column, it is not monotone, or an entry is not finite.
        UnknownName: If the kind is not known.

    Example:
        >>> run = Run({"t": [0.0, 1.0], "x": [0.0, 2.0]})
        >>> run.at(0.25)["x"].tolist()
        [0.5]
    """

    columns: Mapping[str, Any]
    kind: str | Kind = "table"
    index: str = field(default="t", kw_only=True)
    status: RunStatus = field(default=RunStatus.COMPLETE, kw_only=True)
    warnings: tuple[str, ...] = field(default=(), kw_only=True)
    info: Mapping[str, Any] = field(default_factory=dict, kw_only=True)

    def __post_init__(self) -> None:
        if not isinstance(self.kind, Kind):
            checks.choice("kind", self.kind, KINDS)
        if self.index not in self.columns:
            raise InvalidValue("columns", list(self.columns), f"a column {self.index!r}", "name another by index=")
        table = {name: self._checked(name, values) for name, values in self.columns.items()}
        rows = np.shape(table[self.index])
        if len(rows) != 1 or any(v.shape[:1] != rows for v in table.values()):
            lengths = ", ".join(f"{name}: {v.shape}" for name, v in table.items())
            raise InvalidShape("columns", lengths, f"one length, and {self.index!r} a vector")
        if rows[0] > 1:
            checks.monotone(self.index, table[self.index])
        object.__setattr__(self, "columns", MappingProxyType(table))
        object.__setattr__(self, "info", MappingProxyType(dict(self.info)))
        object.__setattr__(self, "warnings", tuple(self.warnings))

    @classmethod
    def _of(
        cls, columns: Mapping[str, np.ndarray], kind: str, *, status: RunStatus,
        warnings: Callable[[], tuple[str, ...]], info: Mapping[str, Any],
    ) -> Run:  # fmt: skip
        """The run without the checks, for results of laws, which become read-only."""
        for column in columns.values():
            for array in (column, column.base):
                if isinstance(array, np.ndarray):
                    array.flags.writeable = False
        new = object.__new__(cls)
        values = (MappingProxyType(columns), kind, "t", status, warnings, MappingProxyType(info))
        for each, value in zip(fields(cls), values, strict=True):
            object.__setattr__(new, each.name, value)
        return new

    def _checked(self, name: str, values: ArrayLike) -> np.ndarray:
        if not isinstance(name, str) or not name or set(name) & set(',"\n\r'):
            raise InvalidValue("columns", name, "names without commas, quotes and line ends")
        if self.status is RunStatus.COMPLETE:
            values = checks.real(name, values)
        column: np.ndarray = checks.frozen(np.atleast_1d(np.asarray(values, np.float64)))
        return column

    def __getitem__(self, name: str) -> np.ndarray:
        """The column of that name.

        Raises:
            UnknownName: If there is none.
        """
        if name not in self.columns:
            raise UnknownName("column", name, self.columns)
        column: np.ndarray = self.columns[name]
        return column

    def __len__(self) -> int:
        """How many rows."""
        return len(self.t)

    @property
    def t(self) -> np.ndarray:
        """The index column, time [s], shape (rows,)."""
        return self[self.index]

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the batch, () for one robot."""
        return np.broadcast_shapes(*(v.shape[1:] for v in self.columns.values()))

    @property
    def names(self) -> Kind:
        """The names of its own columns in each role."""
        kind = self.kind if isinstance(self.kind, Kind) else KINDS[self.kind]
        return Kind(*(tuple(n for p in role for n in self.columns if fnmatchcase(n, p)) for role in kind))

    @property
    def states(self) -> np.ndarray:
        """The states side by side, shape (rows, ..., n)."""
        return self.stacked(*self.names.states)

    @property
    def commands(self) -> np.ndarray:
        """The commands side by side, shape (rows, ..., m); row i + 1 holds what led from row i to it."""
        return self.stacked(*self.names.commands)

    @property
    def errors(self) -> np.ndarray:
        """The errors side by side, shape (rows, ..., k); row i + 1 holds what led to its command."""
        return self.stacked(*self.names.errors)

    @property
    def poses(self) -> Pose:
        """The poses (x, y, theta), each of shape (rows, ...)."""
        return Pose._of(self["x"], self["y"], self["theta"])

    def stacked(self, *names: str) -> np.ndarray:
        """Columns side by side on a last axis; of length 0 for no names.

        Raises:
            UnknownName: If there is no such column.
        """
        if not names:
            return np.empty((len(self), *self.shape, 0))
        table: np.ndarray = stack([self[name] for name in names])
        return table

    def robot(self, index: Any) -> Run:
        """One robot of a batch (or a slice of them).

        Example:
            >>> run = Run({"t": [0.0, 1.0], "x": [[0.0, 5.0], [1.0, 6.0]]})
            >>> run.robot(1)["x"].tolist()
            [5.0, 6.0]
        """
        where = index if isinstance(index, tuple) else (index,)
        whole = {n: v if n == self.index else np.broadcast_to(v, (len(self), *self.shape)) for n, v in self._items()}
        return self._with({n: v if n == self.index else v[(slice(None), *where)] for n, v in whole.items()})

    def at(self, t: ArrayLike) -> Run:
        """The run at other times, interpolated; a run again, of one row for one time.

        Angles are unwrapped first, unless their range shows that they already wind; commands hold.

        Args:
            t: Strictly monotone times within the run [s].

        Raises:
            InvalidValue: If a time is outside the run.

        Example:
            >>> run = Run({"t": [0, 1], "x": [0, 0], "y": [0, 0], "theta": [3.0, -3.0]}, kind="unicycle")
            >>> run.at(0.5)["theta"].round(6).tolist()
            [3.141593]
        """
        times = np.atleast_1d(checks.real("t", t))
        low, high = float(self.t.min()), float(self.t.max())
        if times.ndim != 1 or np.any(times < low) or np.any(times > high):
            raise InvalidValue("t", t, f"times from {low:g} to {high:g}, in a vector")
        if len(self) == 1:
            return self
        names = self.names
        angles, held = names.angles, names.held
        table = {
            n: times if n == self.index else self._resampled(_unwound(v) if n in angles else v, times, n in held)
            for n, v in self._items()
        }
        return self._with(table)

    def _resampled(self, column: np.ndarray, times: np.ndarray, held: bool) -> np.ndarray:
        sign = 1.0 if self.t[-1] > self.t[0] else -1.0
        own, wanted = sign * self.t, sign * times
        if held:
            return column[np.searchsorted(own, wanted, side="left")]
        i = np.clip(np.searchsorted(own, wanted, side="right") - 1, 0, len(own) - 2)
        fraction = (wanted - own[i]) / (own[i + 1] - own[i])
        fraction = fraction.reshape(-1, *(1 for _ in column.shape[1:]))
        between: np.ndarray = (1.0 - fraction) * column[i] + fraction * column[i + 1]
        return between

    def _items(self) -> list[tuple[str, np.ndarray]]:
        return list(self.columns.items())

    def _with(self, columns: Mapping[str, np.ndarray]) -> Run:
        return Run(
            columns, self.kind, index=self.index, status=self.status, warnings=self.warnings, info=self.info
        )  # fmt: skip

    def to_csv(self, path: str | os.PathLike[str]) -> Path:
        """Write one robot's table: a header, then 17 significant digits; the file appears whole or not at all.

        Returns:
            Where it was written.

        Raises:
            InvalidShape: If it holds a batch.
        """
        return write_table(Path(path), self._single())

    @classmethod
    def from_csv(cls, path: str | os.PathLike[str], kind: str | Kind = "table", *, index: str = "t") -> Run:
        """Read what ``to_csv`` writes, or any table of numbers with a header.

        Raises:
            InvalidValue: Naming the line and the column that is no number.
            OSError: If the file cannot be read.
        """
        table = read_table(Path(path))
        finite = all(np.isfinite(v).all() for v in table.values())
        return cls(table, kind, index=index, status=RunStatus.COMPLETE if finite else RunStatus.DIVERGED)

    def to_dataframe(self) -> Any:
        """One robot's table as a pandas DataFrame.

        Raises:
            MissingExtra: If pandas is not installed.
            InvalidShape: If it holds a batch.
        """
        try:
            pandas = importlib.import_module("pandas")
        except ImportError:
            raise MissingExtra("pandas") from None
        return pandas.DataFrame(self._single())

    def _single(self) -> dict[str, np.ndarray]:
        if self.shape:
            raise InvalidShape("run", f"a batch of shape {self.shape}", "one robot", "choose it by run.robot(index)")
        return dict(self.columns)

    def summary(self) -> dict[str, Any]:
        """The run in numbers: floats, or arrays over a batch.

        Example:
            >>> Run({"t": [0, 2], "x": [0, 3], "y": [0, 4], "theta": [0, 0]}, "unicycle").summary()["distance"]
            5.0
        """
        return summary_of(self)


def _unwound(angles: np.ndarray) -> np.ndarray:
    """Angles without jumps of a turn, if they stay within one turn; those that already wind are left alone."""
    wound = np.ptp(angles, axis=0) > 2.0 * np.pi * (1.0 + 1e-12)
    return np.where(wound, angles, np.unwrap(angles, axis=0))


class _WhenAsked:
    """A field that may be given as a call, which is made when the field is first read."""

    def __init__(self, slot: Any) -> None:
        self._slot = slot

    def __get__(self, run: Run | None, kind: type | None = None) -> Any:
        if run is None:
            return self
        value = self._slot.__get__(run, kind)
        if callable(value):
            value = tuple(value())
            self._slot.__set__(run, value)
        return value

    def __set__(self, run: Run, value: Any) -> None:
        self._slot.__set__(run, value)


setattr(Run, "warnings", _WhenAsked(vars(Run)["warnings"]))  # noqa: B010 (to a type checker it stays the field that it is)
