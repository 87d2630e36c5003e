"""One compiled kernel per search: its laws inside the loops of ``rounds``."""

from __future__ import annotations

from numba import types

from coplanar.engine.compiled import layout, rounds
from coplanar.engine.compiled.kernels import Loops


class SearchKernel(Loops):
    """The laws of a search in compiled loops."""

    def __init__(self, laws, sizes) -> None:
        """Laws by the names that the module of ``Search`` gives them, and how many numbers each takes and returns."""
        super().__init__(laws, {"rounds": rounds})
        more = {"GIVEN": laws["begin"].__code__.co_argcount, "WITH": 1 + sizes["ROW"], "SPAN": 3 + sizes["ARGS"]}
        self._constants = tuple({**sizes, **more}.items())
        self.single = None  # from a tuple of numbers and the rounds to the answer, once it is compiled

    def run(self, inputs, outputs, shape, most):
        """Search every row of the broadcast inputs in so many rounds; the outputs are new arrays of ``shape``."""
        columns = tuple(out.reshape(-1) for out in outputs)
        ready = layout.columns(inputs, shape)
        self.fill("rounds", inputs, ready, columns, shape, more=(most,), work=rounds.WORK, constants=self._constants)
        self.warm_up(len(inputs))

    def warm_up(self, count):
        """Compile the search for one row of so many numbers."""
        if self.single is None:
            self.single = self.one("rounds", count, (types.int64,), self._constants)
