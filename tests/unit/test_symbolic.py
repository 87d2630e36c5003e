"""The derivation of the equations of motion, and what happens without SymPy."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from coplanar.engine import evaluator
from coplanar.errors import MissingExtra
from coplanar.laws.flight import drag_rates
from coplanar.symbolic import derive_projectile

sympy = pytest.importorskip("sympy")


def test_the_accelerations_are_the_law_as_symbols():
    found = derive_projectile()
    vx, vy = found.velocity
    k, speed = found.drag / found.mass, sympy.sqrt(vx**2 + vy**2)
    expected = (-k * speed * vx, -found.gravity - k * speed * vy)
    assert all(sympy.simplify(a - b) == 0 for a, b in zip(found.accelerations, expected, strict=True))


def test_the_accelerations_are_the_law_in_numbers():
    found = derive_projectile()
    symbols = (*found.velocity, found.drag, found.mass, found.gravity)
    rates = sympy.lambdify(symbols, found.accelerations)
    vx, vy = np.random.default_rng(0).uniform(-30, 30, (2, 50))
    assert np.allclose(rates(vx, vy, 0.05, 2.0, 9.81), evaluator(drag_rates)(vx, vy, 0.025, 9.81), rtol=1e-14)


def test_the_lagrangian_is_kinetic_less_potential_energy_and_the_force_is_drag():
    found = derive_projectile()
    assert len(found.lagrangian.atoms(sympy.Derivative)) == 2
    power = sum(
        f * r for f, r in zip(found.forces, sorted(found.lagrangian.atoms(sympy.Derivative), key=str), strict=True)
    )
    speed = sympy.sqrt(sum(r**2 for r in found.lagrangian.atoms(sympy.Derivative)))
    assert sympy.simplify(power + found.drag * speed**3) == 0


def test_without_sympy_the_message_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "sympy", None)
    with pytest.raises(MissingExtra, match=r"coplanar\[symbolic\]"):
        derive_projectile()
