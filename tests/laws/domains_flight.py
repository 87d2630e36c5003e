"""Where the laws of flight are defined: directions of length 1, positive speeds, drag and gravity of at least 0."""

from __future__ import annotations

import numpy as np

from coplanar.laws import flight


def _forces(k, g):
    """Drag up to 3 per metre, gravity 0 or between 0.1 and 3.1: among both are zeros."""
    return [np.abs(k), np.where(g == 0.0, 0.0, 0.1 + np.abs(g))]


def _speed(v):
    return 0.1 + np.abs(v)


def _direction(c, s):
    """Unit vectors at least 0.02 rad from the vertical, where the rounding of the angle is not multiplied by more."""
    angle = 1.55 * np.sin(c + 2.0 * s)
    return [np.cos(angle), np.sin(angle)]


def _sides(c, s):
    """1 + sin, 1 - sin of a direction."""
    _, sine = _direction(c, s)
    return [1.0 + sine, 1.0 - sine]


def _launch(columns):
    """Parameters >= 0, then v0, c, s, k, g."""
    *thetas, v0, c, s, k, g = columns
    return [*np.abs(thetas), _speed(v0), *_direction(c, s), *_forces(k, g)]


def _units(v0, k, g):
    """Drag K, gravity G and 1/G in the units of a launch."""
    return flight.scales(_speed(v0), *_forces(k, g))[1:]


def _rates(columns):
    theta, A, B, v0, k, g = columns
    return [np.abs(theta), *_sides(A, B), *_units(v0, k, g)]


def _derivative_rates(columns):
    theta, v0, A, B, k, g, _ = columns
    theta, A, B, K, G, W = _rates([theta, A, B, v0, k, g])
    return [theta, np.sqrt(A * B), A, B, K, G, W]


def _pace(columns):
    v0, k, g = columns
    return [_speed(v0), *_forces(k, g)]


def _turned(columns):
    m, *rest = columns
    return [1.0 + np.abs(m), *_pace(rest)]


def _parameter(columns):
    theta, *rest = columns
    return [np.abs(theta), *_pace(rest)]


def _ballistic(columns):
    t, v0, c, s, g = columns
    return [np.abs(t), _speed(v0), *_direction(c, s), np.abs(g)]


def _bend(columns):
    t, v0, A, B, g = columns
    return [np.abs(t), _speed(v0), *_sides(A, B), np.abs(g)]


def _positive(columns):
    return [0.1 + np.abs(c) for c in columns]


def _level(columns):
    """A speed above that of the climb, so that what is left is no root of a difference of nearly equal numbers."""
    v0, height, k, g = _positive(columns)
    k, g = np.minimum(k, 1.0), np.minimum(g, 1.0)
    return [4.0 + v0 + np.exp(k * height) * 3.0, height, k, g]


def _climb(columns):
    v0, v, k, g = _positive(columns)
    return [v0 + v, v, *_forces(k, g)]


def _not_negative(columns):
    return [np.abs(c) for c in columns]


def _mean(columns):
    return _positive(columns)


DOMAIN = {
    flight.atan_ratio: _not_negative,
    flight.ballistic_bend: _bend,
    flight.ballistic_turn: _ballistic,
    flight.climb_height: _positive,
    flight.climb_speed: _positive,
    flight.climb_time: _climb,
    flight.clock: _launch,
    flight.coast: lambda columns: [0.1 * columns[0], *columns[1:3], *_forces(*columns[3:])],
    flight.derivative_rates: _derivative_rates,
    flight.derivatives: _launch,
    flight.first_climb: lambda columns: [*columns[:2], 0.1 + np.abs(columns[2]), *_forces(*columns[3:])],
    flight.free_speed: _positive,
    flight.hodograph: _rates,
    flight.hold_off: _not_negative,
    flight.last_turn: lambda columns: _launch(columns),
    flight.launch_speed_of_mean: _mean,
    flight.log1p_ratio: _not_negative,
    flight.lean: _derivative_rates,
    flight.miss_across: lambda columns: [*columns[:4], *_positive(columns[4:6]), *columns[6:]],
    flight.pace: _pace,
    flight.parallel_turn: lambda columns: [*_direction(*columns[:2]), *_direction(*columns[2:])],
    flight.scales: _pace,
    flight.sides: lambda columns: _direction(*columns),
    flight.speed_at_height: _level,
    flight.straight_time: _positive,
    flight.theta_of_straight: lambda columns: [np.abs(columns[0]), *_pace(columns[1:])],
    flight.theta_of_turn: _turned,
    flight.travel: lambda columns: _launch([columns[0], np.abs(columns[0]) + np.abs(columns[1]), *columns[2:]]),
    flight.travel_rates: _rates,
    flight.turn: _parameter,
    flight.velocity: _launch,
}
