"""Where the laws of damped least squares are defined: positive definite systems, ratios off their thresholds."""

from __future__ import annotations

import numpy as np

from coplanar.laws import squares


def _positive_definite(columns):
    """A = B B^T + 1 for some B."""
    a, b, c, d, e, f, *right = columns
    rows = np.array([[a, b, c], [d, e, f], [f, a, d]])
    square = np.einsum("ikn,jkn->ijn", rows, rows) + np.eye(3)[:, :, None]
    return [square[0, 0], square[0, 1], square[0, 2], square[1, 1], square[1, 2], square[2, 2], *right]


DOMAIN = {
    squares.damping: lambda columns: [np.abs(c) for c in columns],
    squares.gain: lambda columns: [np.round(c, 1) for c in columns],
    squares.shortening: lambda columns: [np.abs(c) for c in columns],
    squares.solve_three: _positive_definite,
}
