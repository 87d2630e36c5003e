"""Where the laws of wheels are compared between evaluators."""

from __future__ import annotations

import numpy as np

from coplanar.laws import wheels


def off_the_pole(columns):
    """Roller angles away from +-90 deg, where the tangent has its pole."""
    return [*columns[:3], 1.4 * np.sin(columns[3])]


DOMAIN = {wheels.rolling_row: off_the_pole}
