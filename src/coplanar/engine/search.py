"""A search along an integral: rows that go from guess to guess, each until it has settled.

The textbook says it in laws; the arguments decide who evaluates them, as with ``Evaluator``:

    row = begin(*inputs)                                   the state, and after it what stays as it is
    panels, lower, upper, *parameters = span(*row)         the next integral, and a bound on its panels of 16 points
    open, *state = improve(*row, *integrals)               1 where it goes on, 0 where it is settled
    answer = finish(open, *row)                            open is 1 where the rounds were spent
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from coplanar.engine import gauss, memory, scalars
from coplanar.engine.arrays import Integral
from coplanar.engine.evaluator import Evaluator, evaluator
from coplanar.engine.foreign import broadcast_shape
from coplanar.engine.policy import AT_ONCE, can_compile, mode, pays, warm
from coplanar.errors import InvalidShape

FIRST_COMPILED_ROWS = 5_000  # below this many a batch never waits for the compiler; a row is the work of many
MOST_ROUNDS = 64
TEXT_ROWS = 512  # rows that NumPy takes at a time, as every node of a panel has a row of its own

Law = Callable[..., Any]
_FLOAT = frozenset((float,))


class Search:
    """Laws of a search, as the module says.

    ``panels`` has to bound the whole integrand, so that a part of a panel may be left to fewer nodes.

    Example:
        >>> def begin(wanted, rate):
        ...     return 0.0 * wanted, wanted, 0.0 * wanted, wanted, rate
        >>> def span(lower, upper, sum, wanted, rate):
        ...     return 0.5, lower, upper, rate
        >>> def growth(s, rate):
        ...     return (1.0 + rate * s,)
        >>> def improve(lower, upper, sum, wanted, rate, more):
        ...     step = (wanted - sum - more) / (1.0 + rate * upper)
        ...     return 1.0 * (abs(step) > 1e-12), upper, upper + step, sum + more
        >>> def finish(open, lower, upper, sum, wanted, rate):
        ...     return (upper,)
        >>> round(Search(begin, span, Integral(growth), improve, finish)(1.5, 1.0)[0], 12)  # s + s^2/2 = 3/2
        1.0
    """

    def __init__(
        self, begin: Law, span: Law, integral: Integral, improve: Law, finish: Law, *, rounds: int = MOST_ROUNDS
    ) -> None:
        if integral.points != gauss.WHOLE:
            raise ValueError(f"a search is along integrals of {gauss.WHOLE} points")
        laws = {"begin": begin, "span": span, "rates": integral.integrand, "improve": improve, "finish": finish}
        self._laws: dict[str, Evaluator] = {name: evaluator(law) for name, law in laws.items()}
        self._integrals = scalars.integral(self._laws["rates"].on_floats, gauss.WHOLE)
        self.rounds = rounds
        self._loops: Any = None
        self._ready = False  # whether a batch has been through the compiled loops
        functools.update_wrapper(self, begin)

    def __call__(self, *inputs: Any, rounds: int | None = None) -> tuple[Any, ...]:
        """The answer for numbers, or arrays that broadcast.

        Args:
            *inputs: What ``begin`` takes.
            rounds: Spend no more than so many.

        Raises:
            InvalidShape: If they do not broadcast.
        """
        most = rounds or self.rounds
        if _FLOAT.issuperset(map(type, inputs)):
            one = self._single(inputs) if warm(self._loops is not None) else None
            return one(inputs, most) if one else self.on_floats(*inputs, rounds=most)
        arrays = [np.asarray(a, np.float64) for a in inputs]
        try:
            shape = broadcast_shape(arrays)
        except ValueError:
            given = "shapes " + ", ".join(str(a.shape) for a in arrays)
            raise InvalidShape("arguments", given, "shapes that broadcast as in NumPy") from None
        rows = math.prod(shape)
        if rows == 1:
            answer = self(*(a.item() for a in arrays), rounds=rounds)
            return tuple(np.full(shape, a) for a in answer) if shape else answer
        if pays(rows, self._ready, first=FIRST_COMPILED_ROWS):
            return self.on_compiled(arrays, shape, most)
        return self.on_text(arrays, shape, most)

    def on_floats(self, *inputs: float, rounds: int = MOST_ROUNDS) -> tuple[float, ...]:
        """One row by ``math``."""
        span, improve = (self._laws[name].on_floats for name in ("span", "improve"))
        try:
            row = self._laws["begin"].on_floats(*inputs)
            going = 1.0
            for _ in range(rounds):
                going, *state = improve(*row, *self._integrals(*span(*row)))
                row = (*state, *row[len(state) :])
                if not going > 0.0:
                    break
            answer: tuple[float, ...] = self._laws["finish"].on_floats(going, *row)
        except (ArithmeticError, ValueError):  # where math raises, arrays answer inf or NaN
            with np.errstate(all="ignore"):
                return tuple(a.item() for a in self._text_block([np.array([a]) for a in inputs], rounds))
        return answer

    def on_text(
        self, inputs: Sequence[np.ndarray], shape: tuple[int, ...], rounds: int = MOST_ROUNDS
    ) -> tuple[np.ndarray, ...]:
        """The laws as they are written, on so many NumPy rows at a time that they stay in the caches."""
        columns = [np.broadcast_to(a, shape).reshape(-1) for a in inputs]
        starts = range(0, max(len(columns[0]), 1), TEXT_ROWS)
        blocks = [self._text_block([c[start : start + TEXT_ROWS] for c in columns], rounds) for start in starts]
        return tuple(np.concatenate(parts).reshape(shape) for parts in zip(*blocks, strict=True))

    def _text_block(self, inputs: list[np.ndarray], rounds: int) -> tuple[np.ndarray, ...]:
        begin, span, rates, improve, finish = (law.on_text for law in self._laws.values())
        whole = begin(*inputs)
        left, row, going = np.arange(len(whole[0])), list(whole), np.ones(len(whole[0]))
        spent = going.copy()
        for _ in range(rounds):
            going, *state = improve(*row, *_on_columns(rates, *span(*row)))
            row[: len(state)] = state
            open_ = going > 0.0
            if open_.all():
                continue
            spent[left] = going
            for kept, now in zip(whole, row, strict=True):
                kept[left] = now
            left, row, going = left[open_], [column[open_] for column in row], going[open_]
            if not left.size:
                break
        for kept, now in zip(whole, row, strict=True):
            kept[left] = now
        answer: tuple[np.ndarray, ...] = finish(spent, *whole)
        return answer

    def on_compiled(
        self, inputs: Sequence[np.ndarray], shape: tuple[int, ...], rounds: int = MOST_ROUNDS
    ) -> tuple[np.ndarray, ...]:
        """The laws in one compiled loop over blocks of rows that advance together."""
        outputs = tuple(memory.empty(shape) for _ in range(self.sizes["OUT"]))
        self._kernel().run(inputs, outputs, shape, rounds)
        self._ready = True
        return outputs

    def _kernel(self) -> Any:
        if self._loops is None:
            from coplanar.engine.compiled.search import SearchKernel

            self._loops = SearchKernel({name: law.law for name, law in self._laws.items()}, self.sizes)
        return self._loops

    def _single(self, inputs: tuple[float, ...]) -> Any:
        """The compiled search for one row, if it is there or wanted."""
        if self._loops is None and not can_compile():
            return None
        if mode.get() == AT_ONCE:
            self._kernel().warm_up(len(inputs))
        return self._loops.single

    @functools.cached_property
    def sizes(self) -> dict[str, int]:
        """How many numbers a row, its state, the integrand's parameters, the integrals and the answer have."""
        laws = self._laws
        given = {name: law.law.__code__.co_argcount for name, law in self._laws.items()}
        out = len(laws["finish"](*(0.5,) * given["finish"]))
        integrals = given["improve"] - given["span"]
        state = len(laws["improve"](*(0.5,) * given["improve"])) - 1
        return {"ROW": given["span"], "STATE": state, "ARGS": given["rates"] - 1, "SUMS": integrals, "OUT": out}


def _on_columns(rates: Law, panels: Any, lower: Any, upper: Any, *parameters: Any) -> list[np.ndarray]:
    """The integrals of rows, all nodes of a panel at once."""
    count = gauss.panel_count(panels)
    half = 0.5 * (upper - lower) / count + np.where(panels <= count, 0.0, np.nan)
    part = float(np.max(panels, where=panels <= count, initial=0.0)) / count
    nodes, weights = (np.array(side) for side in gauss.rule(gauss.nodes_for(part)))
    total: Any = 0.0
    for k in range(count):
        terms = rates(lower + (2 * k + 1) * half + nodes[:, None] * half, *parameters)
        total = total + np.stack([weights @ term for term in terms])
    return list(half * total)
