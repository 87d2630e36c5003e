"""One text, other names: run the code object of a law over another set of primitives.

A law is looked up in four kinds of names: primitives (replaced), other laws and integrals of laws (bound in turn) and
constants (kept). Nothing is compiled from text and nothing is rewritten: the law keeps its file and its line numbers.
"""

from __future__ import annotations

import dis
import types
from collections.abc import Callable, Mapping
from types import FunctionType
from typing import Any

from coplanar.engine import arrays

PRIMITIVES: frozenset[str] = frozenset(
    name
    for name, value in vars(arrays).items()
    if isinstance(value, FunctionType) and not name.startswith("_") and name not in ("panel_count", "rule")
)

_OPERATIONS = frozenset(("BINARY_OP", "UNARY_NEGATIVE", "COMPARE_OP"))


def bind(
    law: Callable[..., Any],
    primitives: Mapping[str, Any],
    wrap: Callable[[FunctionType], Any] = lambda function: function,
    bound: dict[Any, Any] | None = None,
) -> Any:
    """The law's own code over other primitives.

    Args:
        law: A function of ``coplanar.laws``.
        primitives: What stands for each primitive's name.
        wrap: Applied to every bound function, for instance a compiler's decorator.
        bound: The laws bound so far; shared between calls so that each is bound once.

    Returns:
        The bound function, as ``wrap`` returns it.

    Example:
        >>> import math
        >>> def chord(radius, angle):
        ...     return 2 * radius * sin(angle / 2)
        >>> chord.__globals__["sin"] = arrays.sin
        >>> bind(chord, {"sin": math.sin})(1.0, math.pi)
        2.0
    """
    done: dict[Any, Any] = {} if bound is None else bound
    if law not in done:
        done[law] = wrap(_rebound(law, primitives, wrap, done))
    return done[law]


def _rebound(law: Any, primitives: Mapping[str, Any], wrap: Any, done: dict[Any, Any]) -> FunctionType:
    names: dict[str, Any] = {"__builtins__": __builtins__, "__name__": law.__module__}
    for name in law.__code__.co_names:
        value = law.__globals__.get(name, names)
        if name in primitives and value is getattr(arrays, name, None):
            names[name] = primitives[name]
        elif isinstance(value, FunctionType):
            names[name] = bind(value, primitives, wrap, done)
        elif isinstance(value, arrays.Integral):
            make = primitives.get("integral", arrays.Integral)
            names[name] = make(bind(value.integrand, primitives, wrap, done), value.points)
        elif value is not names:
            names[name] = value
    function = FunctionType(law.__code__, names, law.__name__, law.__defaults__, law.__closure__)
    function.__doc__, function.__qualname__ = law.__doc__, law.__qualname__
    return function


def operations(law: Any) -> int:
    """About how many array operations a call of the law makes, its integrals at every point.

    Example:
        >>> operations(lambda x, y: 2.0 * x + y)
        2
    """
    count = sum(step.opname in _OPERATIONS for step in dis.get_instructions(law))
    for name in law.__code__.co_names:
        value = law.__globals__.get(name)
        if name in PRIMITIVES:
            count += 2  # a call, and at least one operation within
        elif isinstance(value, FunctionType):
            count += operations(value)
        elif isinstance(value, arrays.Integral):
            count += value.points * operations(value.integrand)
    return count


def array_primitives(namespace: types.ModuleType) -> dict[str, Any]:
    """The array text of every primitive, bound to another array library's namespace."""
    names = dict(vars(arrays), xp=namespace)
    primitives: dict[str, Any] = {
        name: FunctionType(getattr(arrays, name).__code__, names, name) for name in PRIMITIVES
    }
    primitives["integral"] = lambda integrand, points: arrays.Integral(integrand, points, primitives["where"])
    return primitives
