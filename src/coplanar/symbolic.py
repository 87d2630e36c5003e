"""Equations derived rather than stated; needs SymPy, which is loaded on the first call."""

from __future__ import annotations

from typing import Any, NamedTuple

from coplanar.errors import MissingExtra


class Derivation(NamedTuple):
    """The equations of motion of a projectile, as SymPy expressions.

    Attributes:
        lagrangian: L = T - V.
        forces: Generalised forces of drag, along x and y.
        equations: d/dt dL/dq' - dL/dq = Q, one for each coordinate.
        accelerations: (x'', y''), solved from the equations.
        velocity: The symbols (vx, vy) that stand for x' and y' in the accelerations.
        drag: C [kg/m].
        mass: m [kg].
        gravity: g [m/s^2].
    """

    lagrangian: Any
    forces: tuple[Any, Any]
    equations: tuple[Any, Any]
    accelerations: tuple[Any, Any]
    velocity: tuple[Any, Any]
    drag: Any
    mass: Any
    gravity: Any


def derive_projectile() -> Derivation:
    """Accelerations of a projectile with quadratic drag, from d/dt dL/dq' - dL/dq = Q with L = T - V.

    The drag force is F = -C |v| v; its generalised forces are Q_j = F . dr/dq_j with r = (x, y).

    Returns:
        The Lagrangian, the forces, the equations and the accelerations.

    Raises:
        MissingExtra: If SymPy is not installed.

    Source: Goldstein 1980, Classical Mechanics, sec. 1-4 and 1-5.

    Example:
        >>> print(derive_projectile().accelerations[0])
        -C*vx*sqrt(vx**2 + vy**2)/m
    """
    sympy = _sympy()
    t = sympy.Symbol("t", real=True)
    m, C, g = sympy.symbols("m C g", positive=True)
    q = [sympy.Function(name, real=True)(t) for name in ("x", "y")]
    rates = [coordinate.diff(t) for coordinate in q]
    square = rates[0] ** 2 + rates[1] ** 2
    lagrangian = m * square / 2 - m * g * q[1]
    force = [-C * sympy.sqrt(square) * rate for rate in rates]
    point = sympy.Matrix(q)
    forces = [sum(f * d for f, d in zip(force, point.diff(coordinate), strict=True)) for coordinate in q]
    equations = [
        sympy.Eq(lagrangian.diff(rate).diff(t) - lagrangian.diff(coordinate), push)
        for coordinate, rate, push in zip(q, rates, forces, strict=True)
    ]
    velocity = sympy.symbols("vx vy", real=True)
    unknown = [coordinate.diff(t, 2) for coordinate in q]
    solved = sympy.solve(equations, unknown, dict=True)[0]
    plain = dict(zip(rates, velocity, strict=True))
    accelerations = [solved[a].subs(plain) for a in unknown]
    return Derivation(
        lagrangian, tuple(forces), tuple(equations), tuple(accelerations), tuple(velocity), drag=C, mass=m, gravity=g
    )


def _sympy() -> Any:
    try:
        import sympy
    except ImportError:
        raise MissingExtra("sympy", "symbolic") from None
    return sympy
