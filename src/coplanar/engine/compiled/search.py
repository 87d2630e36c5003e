"""One compiled kernel per search: its laws inside the loops of ``rounds``."""

from __future__ import annotations

from coplanar.engine.compiled import rounds
from coplanar.engine.compiled.kernels import Loops


class SearchKernel(Loops):
    """The laws of a search in compiled loops."""

    def __init__(self, laws, sizes) -> None:
        """Laws by the names that the module of ``Search`` gives them, and how many numbers each takes and returns."""
        super().__init__(laws, {"rounds": rounds})
        more = {"WITH": 1 + sizes["ROW"], "SPAN": 3 + sizes["ARGS"]}
        self._constants = tuple({**sizes, **more}.items())
        self.one = None  # from a tuple of numbers and the rounds to the answer; there after the first batch

    def run(self, inputs, outputs, shape, most):
        """Search every row of the broadcast inputs in so many rounds; the outputs are new arrays of ``shape``."""
        columns = tuple(out.reshape(-1) for out in outputs)
        self.fill("rounds", inputs, columns, shape, more=(most,), work=rounds.WORK, constants=self._constants)
        if self.one is None:
            self._call("rounds", "rounds_one", self._constants, ((0.5,) * len(inputs), 1))
            self.one = self._compiled("rounds", "rounds_one", self._constants)
