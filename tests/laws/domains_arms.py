"""Where the laws of arms are defined: positive lengths, ordered limits, elbows of one sign or the other."""

from __future__ import annotations

import numpy as np

from coplanar.laws import arms


def _lengths(*columns):
    """Lengths between 0.1 and 3.1."""
    return [0.1 + np.abs(c) for c in columns]


def _two_links(columns):
    """Tips that two links reach, well away from where their branches meet: there the answer is ill-conditioned."""
    x, y, l1, l2, *rest = columns
    l1, l2 = _lengths(l1, l2)
    part = 0.1 + 0.8 * np.abs(np.sin(x))
    r = np.sqrt((l1 - l2) ** 2 * (1.0 - part) + (l1 + l2) ** 2 * part)
    return [r * np.cos(y), r * np.sin(y), l1, l2, *[np.where(e < 0.0, -1.0, 1.0) for e in rest]]


def _radii(columns):
    r, l1, l2 = columns
    x, _, l1, l2 = _two_links([r, 0.0 * r, l1, l2])
    return [x, l1, l2]


def _both(columns):
    x, y, l1, l2, _, _, tolerance = columns
    x, y, l1, l2 = _two_links([x, y, l1, l2])
    return [x, y, l1, l2, np.abs(l1 - l2), l1 + l2, 0.0 * tolerance + 1e-6]


def _row(columns):
    *columns, axis = columns
    return [*_two_links(columns), 0.0 * axis - 1.0]


def _rates(columns):
    q1, q2, l1, l2, *velocity = columns
    return [q1, np.where(q2 < 0.0, -1.0, 1.0) * (0.5 + 2.0 * np.abs(np.sin(q2))), *_lengths(l1, l2), *velocity]


def _rings(columns):
    x, y, inner, width = columns
    inner, width = _lengths(inner, width)
    return [x, y, inner, inner + width]


def _turns(columns):
    x, y, elbow, l1, l2, _, tolerance, rest = columns
    x, y, l1, l2, elbow = _two_links([x, y, l1, l2, elbow])
    return [x, y, elbow, l1, l2, np.abs(l1 - l2), 1e-6 * np.abs(tolerance), rest]


def _reach(columns):
    """Targets whose status is not a matter of the last digit."""
    x, y, _, width, tolerance = columns
    return [
        np.round(x, 1) + 0.01,
        np.round(y, 1),
        0.0 * x + 0.55,
        0.95 + np.abs(np.round(width, 1)),
        0.0 * tolerance + 1e-3,
    ]


def _off_the_jumps(columns):
    """Angles whose whole turns are not a matter of the last digit."""
    angle, near, *limits = columns
    return [np.round(angle, 1) + 0.01, np.round(near, 1), *_ordered(limits)]


def _joints_off_the_jumps(columns):
    turn, before, bend, near, *limits = columns
    turn, near, *limits = _off_the_jumps([turn, near, *limits])
    return [turn, np.round(before, 1), np.round(bend, 1), near, *limits]


def _ordered(limits):
    if not limits:
        return []
    lower, width = limits
    return [np.round(lower, 1), np.round(lower, 1) + 0.5 + np.abs(np.round(width, 1))]


DOMAIN = {
    arms.chosen_elbow: lambda columns: [np.round(c) for c in columns],
    arms.elbow_squares: _radii,
    arms.elbow_sine: _two_links,
    arms.joint_near: _joints_off_the_jumps,
    arms.joint_within: _joints_off_the_jumps,
    arms.ring_gap: _rings,
    arms.ring_nearest: _rings,
    arms.turn_near: _off_the_jumps,
    arms.turn_onto: _off_the_jumps,
    arms.turn_within: _off_the_jumps,
    arms.two_link_both: _both,
    arms.two_link_inverse: _two_links,
    arms.two_link_rates: _rates,
    arms.two_link_reach: _reach,
    arms.two_link_triangle: _two_links,
    arms.two_link_row: _row,
    arms.two_link_turns: _turns,
}
