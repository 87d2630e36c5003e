"""Where the laws of landing are defined: rows of a search, as it begins them, some way on."""

from __future__ import annotations

import numpy as np

from coplanar.laws import landing
from tests.laws.domains_flight import _direction, _forces


def _begin(columns):
    """A launch point and velocity, forces, and a line through a point."""
    x, y, vx, vy, k, g, line_x, line_y, *slope = columns
    return [x, y, vx, 1.0 + np.abs(vy), *_forces(k, g), line_x, line_y, *_direction(*slope)]


def _row(columns):
    """A row of a search somewhere between its guesses."""
    theta, further, t, x, y, *launch = columns[:15]
    row = list(landing.landing_begin(*(np.asarray(c, float) for c in _begin(launch))))
    row[:5] = np.abs(theta), np.abs(theta) + np.abs(further), t, x, y
    return [*row, *columns[len(row) :]]


def _finish(columns):
    """With little drag, against which it may be far to coast, even back."""
    going, *row = columns
    row[9] = 0.01 * row[9]
    return [going, *_row(row)]


def _approach(columns):
    row = _row([*columns, *columns[:10]])
    names = landing.landing_span.__code__.co_varnames
    place = dict(zip(names, row, strict=False))
    return [place[name] for name in landing.approach.__code__.co_varnames[: landing.approach.__code__.co_argcount]]


def _after(columns):
    theta, time, v = columns[:3]
    row = dict(zip(landing.landing_span.__code__.co_varnames, _row([*columns, *columns, *columns]), strict=False))
    return [np.abs(theta), 0.1 * np.abs(time), 0.1 + np.abs(v), *(row[name] for name in ("A", "B", "g", "a", "G"))]


def _fall(columns):
    above, towards, pull, jerk = columns
    return [above, 0.1 + np.abs(towards), 0.1 + np.abs(pull) + towards * 0.0, jerk]


DOMAIN = {
    landing.approach: _approach,
    landing.landing_begin: _begin,
    landing.landing_finish: _finish,
    landing.landing_improve: _row,
    landing.landing_span: _row,
    landing.landing_time: _fall,
    landing.theta_after: _after,
}
