"""Aims of any shape: rows are answered a block at a time, so that what is needed on the way does not grow with them."""

from __future__ import annotations

from typing import Any

import numpy as np

from coplanar.engine import memory
from coplanar.flight import forms
from coplanar.flight.forms import Answer, Way

BLOCK = 16_384  # rows; about a hundred columns of them are in use at a time


class Answers:
    """The answers to all rows.

    Attributes:
        low: Velocity and time of the low arc, three arrays.
        high: Of the lofted one.
        code: Places of the statuses.
        shortfall: How far every row falls short [m].
        lost_point: Whether the target of a row is its launch point, where that has no answer.
    """

    def __init__(self, shape: tuple[int, ...]) -> None:
        table = memory.empty((7, *shape))
        *arcs, self.shortfall = (table[k, ...] for k in range(7))
        self.low, self.high = tuple(arcs[:3]), tuple(arcs[3:])
        self.code = np.empty(shape, np.intp)
        self.lost_point = False


def answers(name: str, columns: list[Any], shape: tuple[int, ...]) -> Answers:
    """Answer all rows of target x, y, start x, y, drag per mass, gravity and the number that is given."""
    whole = Answers(shape)
    if not shape:
        _fill(whole, (), name, [np.asarray(column, np.float64) for column in columns])
        return whole
    flat, spread = _flat(whole), [np.broadcast_to(column, shape).flat for column in columns]
    for start in range(0, whole.code.size, BLOCK):
        rows = slice(start, start + BLOCK)
        _fill(flat, (rows,), name, [np.asarray(column[rows], np.float64) for column in spread])
    whole.lost_point = flat.lost_point
    return whole


def _flat(whole: Answers) -> Answers:
    flat = Answers((0,))
    flat.low, flat.high = (tuple(column.reshape(-1) for column in arc) for arc in (whole.low, whole.high))
    flat.code, flat.shortfall = whole.code.reshape(-1), whole.shortfall.reshape(-1)
    return flat


def _fill(whole: Answers, rows: tuple[slice, ...], name: str, columns: list[np.ndarray]) -> None:
    tx, ty, sx, sy, drag_per_mass, gravity, number = columns
    x, y = tx - sx, ty - sy
    whole.lost_point |= bool(np.any((x == 0.0) & (y == 0.0) & ((name != "time") | (gravity <= 0.0))))
    side, way = np.where(x < 0.0, -1.0, 1.0), Way(np.abs(x), y, drag_per_mass, gravity)
    with np.errstate(all="ignore"):  # what is not a number is said by the code
        answer = _answer(way, name, number, side)
    for place, (vx, vy, time) in ((whole.low, answer.low), (whole.high, answer.high)):
        for k, part in enumerate((side * vx, vy, time)):
            place[k][rows] = part
    whole.code[rows] = answer.code
    whole.shortfall[rows] = _shortfall(way, name, number, side, answer)


def _answer(way: Way, name: str, number: np.ndarray, side: np.ndarray) -> Answer:
    if name == "time":
        return forms.by_time(way, number)
    if name == "speed":
        return forms.by_speed(way, number)
    if name == "angle":
        return forms.by_angle(way, side * np.cos(number), np.sin(number))
    return forms.by_least(way)


def _shortfall(way: Way, name: str, number: np.ndarray, side: np.ndarray, answer: Answer) -> Any:
    """How far the target is beyond the limit of a speed, or from the half line along which it is launched."""
    if name != "angle":
        return np.where(answer.code == forms.OUT_OF_REACH, way.distance - answer.furthest, 0.0)
    cosine, sine = side * np.cos(number), np.sin(number)
    ahead = way.x * cosine + way.y * sine > 0.0
    aside = np.where(ahead, np.abs(way.x * sine - way.y * cosine), way.distance)
    return np.where(answer.code == forms.OFF_THE_LINE, aside, 0.0)
