"""Serial chains over many rows: compiled loops of places, Jacobians and searches, for laws that the caller names."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar.engine import memory
from coplanar.engine.policy import FIRST_COMPILED_ROWS, pays

SEARCH_STEPS = 10  # a row of a search is the work of so many rows of places
FIRST_SEARCHED_ROWS = 5_000  # below this many searches a batch never waits for the compiler


@dataclass(frozen=True, slots=True, eq=False)
class ChainTable:
    """A chain as the loops read it.

    Attributes:
        joints: (carry, turns, bend, length, slides, turns the tool) of every joint, shape (n, 6).
        ends: For every joint the place that turns with it as one rigid body, shape (n,): k + 1 is the end of link k,
            n + 1 the tool.
        frames: Base and tool, each (x, y, direction), shape (2, 3).
    """

    joints: np.ndarray
    ends: np.ndarray
    frames: np.ndarray

    @property
    def parts(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The three tables."""
        return self.joints, self.ends, self.frames


class Linkage:
    """The laws of serial chains in compiled loops, where rows are many.

    The names of the laws are those of ``engine.compiled.chains`` and ``engine.compiled.searches``.
    """

    def __init__(self, **laws: Callable[..., Any]) -> None:
        self._laws = laws
        self._loops: Any = None
        self._ready: set[str] = set()

    def pays(self, kind: str, rows: int) -> bool:
        """Whether the compiled loop, "chain" or "search", serves so many rows sooner than NumPy text."""
        first = FIRST_SEARCHED_ROWS if kind == "search" else FIRST_COMPILED_ROWS
        return pays(rows, kind in self._ready, first=first)

    def places(self, table: ChainTable, q: np.ndarray, pose: Any, points: Any, jacobian: Any) -> None:
        """Write what is wanted; what is not is None.

        Args:
            table: The chain.
            q: Joints, shape (rows, n).
            pose: Of the tool, x, y and direction, shape (3, rows).
            points: The first places, shape (rows, count, 2).
            jacobian: Two or three rows of it, shape (rows, 2 or 3, n).
        """
        rows, n = q.shape
        pose = np.empty((3, 0)) if pose is None else pose
        points = np.empty((rows, 0, 2)) if points is None else points
        jacobian = np.empty((0, 3, n)) if jacobian is None else jacobian
        self._run("chain", (_read_only(q), *table.parts, pose, points, jacobian, rows), n * rows, rows)

    def search(
        self,
        table: ChainTable,
        start: np.ndarray,
        aims: np.ndarray,
        *,
        bounds: np.ndarray,
        settings: tuple[float, ...],
        budget: int,
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """The joints nearest to every target by damped least squares.

        Args:
            table: The chain.
            start: First guess, shape (rows, n).
            aims: x and y of the targets, and headings where they matter, shape (2 or 3, rows).
            bounds: Lower and upper, shape (2, n).
            settings: Tolerance, least step, first mu, longest step, and metres that a radian of heading counts.
            budget: Iterations.

        Returns:
            Joints, codes of ``engine.compiled.searches``, iterations, norms of the error.
        """
        rows, n = start.shape
        outputs = (memory.empty((rows, n)), np.empty(rows, np.int64), np.empty(rows, np.int64), np.empty(rows))
        given = (_read_only(start), _read_only(aims), *table.parts, _read_only(bounds), np.array(settings), budget)
        self._run("search", (*given, outputs, rows), SEARCH_STEPS * n * rows, rows)
        return outputs

    def _run(self, kind: str, arguments: tuple[Any, ...], work: int, rows: int) -> None:
        if self._loops is None:
            from coplanar.engine.compiled import chains, searches
            from coplanar.engine.compiled.kernels import Loops

            self._loops = Loops(self._laws, {"chain": chains, "search": searches})
        self._loops.loop(kind, arguments, work, rows)
        self._ready.add(kind)


def _read_only(array: np.ndarray) -> np.ndarray:
    """The array as the loops are compiled for: contiguous, and not to be written."""
    view = np.ascontiguousarray(array, np.float64).view()
    view.flags.writeable = False
    return view
