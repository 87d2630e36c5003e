"""Where the laws of control are defined: sizes, steps and limits are positive and not tiny."""

from __future__ import annotations

import numpy as np

from coplanar.laws import control as laws


def _positive(*places, least=0.1):
    def inside(columns):
        return [least + np.abs(c) if i in places else c for i, c in enumerate(columns)]

    return inside


def _gentle(columns):
    """A closed loop that turns by no more than a few radians in a step."""
    return [0.3 * c for c in _positive(13, 14, 16, least=2.0)(columns)]


DOMAIN = {
    laws.point_command: _positive(1),
    laws.feedback: _positive(7),
    laws.track_point: _positive(11, 13, 16),
    laws.tracking_euler: _gentle,
    laws.tracking_step: _gentle,
    laws.tracking_arc: _gentle,
    laws.schur_cohn: lambda columns: [0.3 * c for c in columns],
    laws.lateral_margin: lambda columns: [0.3 * c for c in _positive(0, 1, 5, least=1.0)(columns)],
    laws.pd_poles: _positive(0, 1),
    laws.largest_step: _positive(0, 2),
    laws.turn_rate: _positive(1, 2),
    laws.turn_per_step: _positive(0, 2),
    laws.scaled: _positive(2, 3),
    laws.rims_scaled: _positive(2, 3),
    laws.rims_clipped: _positive(2, 3),
    laws.rims_keeping_omega: _positive(2, 3),
}
