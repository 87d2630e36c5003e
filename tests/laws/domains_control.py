"""Where the laws of control are defined: sizes, steps and limits are positive and not tiny."""

from __future__ import annotations

import numpy as np

from coplanar.laws import control as laws


def _positive(*places):
    def inside(columns):
        return [0.1 + np.abs(c) if i in places else c for i, c in enumerate(columns)]

    return inside


DOMAIN = {
    laws.point_command: _positive(1),
    laws.feedback: _positive(7),
    laws.track_point: _positive(11, 13, 16),
    laws.pd_poles: _positive(0, 1),
    laws.largest_step: _positive(0, 2),
    laws.turn_rate: _positive(1, 2),
    laws.turn_per_step: _positive(0, 2),
    laws.scaled: _positive(2, 3),
    laws.from_rims: _positive(2),
    laws.rims_scaled: _positive(2, 3),
    laws.rims_clipped: _positive(2, 3),
    laws.rims_keeping_omega: _positive(2, 3),
}
