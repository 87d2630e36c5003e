"""Where the laws of aiming are defined: lines of sight with a launch above them, and rows of a search as it begins."""

from __future__ import annotations

import inspect

import numpy as np

from coplanar.laws import aiming
from tests.laws.domains_flight import _derivative_rates, _direction, _forces, _speed


def _sight(slope):
    """A line of sight at least 0.2 rad from the vertical."""
    angle = 1.37 * np.sin(slope)
    return [np.cos(angle), np.sin(angle)]


def _farthest(columns):
    v0, slope, _, k, g = columns
    k, g = _forces(k, g)
    return [_speed(v0), *_sight(slope), np.minimum(k, 1.0), g + 0.5]


def _arc(columns):
    v0, slope, other, k, g, ratio, best, most, theta, side = columns
    v0, c, s, k, g = _farthest([v0, slope, other, k, g])
    most = 0.5 + np.abs(most)
    zenith = np.arctan2(c, s)
    part = 0.55 + 0.1 * np.sin(ratio)
    return [v0, c, s, k, g, part * most, (0.5 + 0.1 * np.sin(best)) * zenith, most, 1.0 + 0.2 * np.sin(theta),
            np.where(side < 0.0, -1.0, 1.0)]  # fmt: skip


def _row(begin, inside, columns):
    """The row of a search as it begins; what is not of the row stays as it is."""
    count = begin.__code__.co_argcount
    row = [np.asarray(c, float) for c in begin(*(np.asarray(c, float) for c in inside(list(columns[:count]))))]
    return [*row, *columns[len(row) :]]


def _farthest_row(columns):
    return _row(aiming.farthest_begin, _farthest, columns)


def _arc_row(columns):
    return _row(aiming.arc_begin, _arc, columns)


def _return(columns):
    """A flight from the row of the search for the farthest launch, and its integrals."""
    row = dict(
        zip(inspect.signature(aiming.farthest_span).parameters, _farthest_row([*columns, *columns]), strict=False)
    )
    wanted = inspect.signature(aiming.return_to_line).parameters
    return [row.get(name, column) for name, column in zip(wanted, columns, strict=True)]


def _guess(columns):
    _, c, s, _, _, distance, best, most, _, side = _arc([*columns, columns[0], columns[1]])
    return [np.arctan2(c, s), best, most, 2.0 * most, distance, c, s, side]


DOMAIN = {
    aiming.aim_rates: _derivative_rates,
    aiming.arc_begin: _arc,
    aiming.arc_finish: lambda columns: [columns[0], *_arc_row(columns[1:])],
    aiming.arc_guess: _guess,
    aiming.arc_improve: _arc_row,
    aiming.arc_span: _arc_row,
    aiming.best_curve: lambda columns: [np.sin(columns[0]), np.abs(columns[1])],
    aiming.best_turning: lambda columns: [*_sight(columns[0]), np.abs(columns[2])],
    aiming.best_zenith: lambda columns: [np.abs(columns[0]), np.sin(columns[1]), np.abs(columns[2])],
    aiming.drag_strength: lambda columns: [columns[0], np.abs(columns[1]), 0.5 + np.abs(columns[2])],
    aiming.farthest_begin: _farthest,
    aiming.farthest_finish: lambda columns: [columns[0], *_farthest_row(columns[1:])],
    aiming.farthest_improve: _farthest_row,
    aiming.farthest_span: _farthest_row,
    aiming.flight_span: lambda columns: [np.abs(columns[0]), np.abs(columns[1]), *columns[2:]],
    aiming.free_turning: lambda columns: [0.3 + 0.2 * np.sin(columns[0]), *_sight(columns[1])],
    aiming.launch_sides: lambda columns: [0.8 + 0.7 * np.sin(columns[0])],
    aiming.return_to_line: _return,
    aiming.sector: lambda columns: _direction(*columns),
    aiming.theta_of_turning: lambda columns: [np.abs(columns[0]), _speed(columns[1]), *_forces(*columns[2:])],
}
