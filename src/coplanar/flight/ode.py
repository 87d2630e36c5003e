"""The same flight by a general integrator: slow, and independent of the hodograph."""

from __future__ import annotations

from typing import Any

import numpy as np

from coplanar.engine import evaluator
from coplanar.laws import flight as laws

_drag_rates = evaluator(laws.drag_rates)

RTOL = 1e-13  # of every state, by step
ATOL = 1e-14  # [m, m/s]


def flown(vx: Any, vy: Any, drag_per_mass: Any, gravity: Any, time: Any) -> tuple[np.ndarray, ...]:
    """Way and velocity after a time, by Dormand and Prince's method of order 8.

    Every row runs over its own time, scaled to 1, so that all of them are one system.

    Returns:
        x, y [m] from the launch point, vx, vy [m/s].
    """
    from scipy.integrate import solve_ivp

    vx, vy, k, g, t = np.broadcast_arrays(vx, vy, drag_per_mass, gravity, time)

    def rates(_: float, flat: np.ndarray) -> np.ndarray:
        _, _, u, w = flat.reshape(4, *t.shape)
        return np.ravel(np.stack([t * u, t * w, *(t * a for a in _drag_rates(u, w, k, g))]))

    start = np.ravel(np.stack([0.0 * vx, 0.0 * vy, vx, vy]))
    end = solve_ivp(rates, (0.0, 1.0), start, method="DOP853", rtol=RTOL, atol=ATOL).y[:, -1]
    x, y, u, w = end.reshape(4, *t.shape)
    return x, y, u, w
