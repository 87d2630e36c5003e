"""Whether a law may be compiled with the fast primitives: it may unless it can hide their NaN.

A fast primitive says "not by me" with NaN, and the loop evaluates every row again that shows one. A comparison forgets
a NaN: ``where(sin(x) > 0, 1, -1)`` would answer -1 for every angle that is too large for the fast sine. So the law is
run once on symbols that remember which answers of fast primitives they hang on, and every answer that was compared
must still show in some result. What hangs on an answer only on one side of a ``where`` may be compared if a result
hangs on it on that side too: the answer carries the side with it.
"""

from __future__ import annotations

import itertools

from coplanar.engine.binding import PRIMITIVES, bind
from coplanar.engine.compiled.primitives import NAN_WHERE_NOT


def shows_every_nan(law):
    """Whether a NaN of any fast primitive reaches a result of the law, or cannot matter."""
    trace = _Trace()
    arguments = [_Symbol(trace) for _ in range(law.__code__.co_argcount)]
    answer = bind(law, trace.primitives())(*arguments)
    shown = frozenset().union(*(_must(a) for a in (answer if isinstance(answer, tuple) else (answer,))))
    return all(any(number == n and sides <= s for n, sides in shown) for number, s in trace.compared)


class _Trace:
    """One run of a law: numbers the answers of fast primitives, and collects those that were compared.

    An answer is its number and the sides of ``where`` on which it counts.
    """

    def __init__(self):
        self.compared = frozenset()
        self._numbers = itertools.count()

    def primitives(self):
        special = {
            "where": self._where,
            "copysign": self._copysign,
            "sincos": self._sincos,
            "integral": self._integral,
        }
        return special | {name: self._ordinary(name) for name in PRIMITIVES if name not in special}

    def compare(self, *values):
        for value in values:
            self.compared |= _may(value)
        return _Symbol(self)

    def join(self, *values):
        may, must = (frozenset().union(*(held(v) for v in values)) for held in (_may, _must))
        return _Symbol(self, may, must)

    def _new(self, *values):
        answer = frozenset(((next(self._numbers), frozenset()),))
        return self.join(_Symbol(self, answer, answer), *values)

    def _ordinary(self, name):
        return self._new if name in NAN_WHERE_NOT else self.join

    def _where(self, _condition, yes, no):
        number = next(self._numbers)
        may, must = (
            _on_side(held(yes), number, side=True) | _on_side(held(no), number, side=False) for held in (_may, _must)
        )
        return _Symbol(self, may, must | (_must(yes) & _must(no)))

    def _copysign(self, size, sign):
        self.compare(sign)
        return size

    def _sincos(self, angle):
        pair = self._new(angle)
        return pair, pair

    def _integral(self, integrand, _points):
        def integrate(panels, lower, upper, *parameters):
            terms = integrand(self.join(lower, upper), *parameters)
            enough = self._new(panels, lower, upper)
            return tuple(self.join(term, enough) for term in terms)

        return integrate


class _Symbol:
    """A number of which is known which answers may make it NaN, and which surely do."""

    def __init__(self, trace, may=frozenset(), must=frozenset()):
        self._trace, self.may, self.must = trace, may, must

    def _join(self, *others):
        return self._trace.join(self, *others)

    def _compare(self, *others):
        return self._trace.compare(self, *others)

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = _join
    __pow__ = __rpow__ = __mod__ = __rmod__ = __floordiv__ = __neg__ = __pos__ = __abs__ = _join
    __lt__ = __le__ = __gt__ = __ge__ = __eq__ = __ne__ = _compare
    __and__ = __rand__ = __or__ = __ror__ = __xor__ = __invert__ = _join
    __hash__ = None  # type: ignore[assignment]


def _on_side(answers, number, *, side):
    """The answers, which count on this side of a ``where`` only."""
    return frozenset((answer, sides | {(number, side)}) for answer, sides in answers)


def _may(value):
    return value.may if isinstance(value, _Symbol) else frozenset()


def _must(value):
    return value.must if isinstance(value, _Symbol) else frozenset()
