"""Where the printed drag force is wrong, and what is right."""

from __future__ import annotations

import numpy as np

from coplanar.engine import evaluator
from coplanar.laws.flight import drag_rates


def force(v, C):
    """The drag force on 1 kg without gravity."""
    return np.array(evaluator(drag_rates)(*v, C, 0.0))


def test_minus_C_v_squared_along_the_unit_vector_is_minus_C_times_speed_times_velocity():
    """-C v^2 vhat = -C |v| v; the printed right-hand side, -C |v| vhat, is a force that grows with v, not with v^2."""
    v, C = np.array([3.0, -4.0]), 0.5
    speed = np.hypot(*v)
    unit = v / speed
    assert np.allclose(force(v, C), -C * speed**2 * unit)
    assert np.allclose(force(v, C), -C * speed * v)
    printed = -C * speed * unit
    assert np.hypot(*(printed - force(v, C))) > 0.5 * np.hypot(*force(v, C))


def test_twice_the_speed_is_four_times_the_drag():
    v = np.array([3.0, -4.0])
    assert np.allclose(force(2.0 * v, 0.5), 4.0 * force(v, 0.5))
