"""Where the laws of curves are defined: durations are positive and not tiny."""

from __future__ import annotations

import numpy as np

from coplanar.laws import curves as laws


def _positive_duration(columns):
    t, start, duration = columns
    return [t, start, 0.1 + np.abs(duration)]


DOMAIN = {laws.uniform: _positive_duration, laws.minimum_jerk: _positive_duration}
