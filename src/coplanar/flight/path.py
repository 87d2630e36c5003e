"""One flight by its hodograph: where it is at a time, where it crosses a line, how both depend on the launch.

Everything here is in the launch's own frame: the origin at the launch point, x the way the launch goes, so that
``cosine`` is not negative. Nothing is checked; rows broadcast.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from coplanar.engine import evaluator
from coplanar.flight.roots import ROUNDING, rising_root
from coplanar.laws import flight as laws
from coplanar.laws.landing import landing

Row = Any  # a float or an array of float64

_ballistic_turn = evaluator(laws.ballistic_turn)
_coast = evaluator(laws.coast)
_clock = evaluator(laws.clock)
_derivatives = evaluator(laws.derivatives)
_last_turn = evaluator(laws.last_turn)
_parallel_turn = evaluator(laws.parallel_turn)
_theta_of_straight = evaluator(laws.theta_of_straight)
_theta_of_turn = evaluator(laws.theta_of_turn)
_travel = evaluator(laws.travel)
_velocity = evaluator(laws.velocity)

LONGEST = 4.0  # longest Newton step in theta beyond what has been seen: the speed falls by exp(2) in it at most


class Path(NamedTuple):
    """A launch: speed [m/s], cosine and sine of its angle, drag per mass k [1/m], gravity [m/s^2]."""

    speed: Row
    cosine: Row
    sine: Row
    drag_per_mass: Row
    gravity: Row


class State(NamedTuple):
    """Time, position and velocity on a path; ``theta`` is where the path's parameter stands."""

    theta: Row
    time: Row
    x: Row
    y: Row
    vx: Row
    vy: Row


def state_at(path: Path, theta: Row) -> State:
    """The state at the parameter theta."""
    return State(theta, *_travel(0.0, theta, *path), *_velocity(theta, *path))


def after(path: Path, state: State, time: Row) -> State:
    """The state a little later, or much later where there is no drag or the path falls at terminal speed."""
    x, y, vx, vy = _coast(time, state.vx, state.vy, path.drag_per_mass, path.gravity)
    return State(state.theta, state.time + time, state.x + x, state.y + y, vx, vy)


def theta_of_turn(path: Path, turn: Row) -> Row:
    """The parameter theta where the path has turned by the factor ``turn`` in exp(asinh(tan psi))."""
    return _theta_of_turn(turn, path.speed, path.drag_per_mass, path.gravity)


def last_theta(path: Path) -> Row:
    """The parameter theta from which the path falls straight at terminal speed."""
    return theta_of_turn(path, _last_turn(*path))


def at_time(path: Path, time: Row) -> State:
    """The state at a time >= 0: t(theta) = time.

    The first guess is a lower bound: the turn without drag, or what drag alone makes of q.
    """
    v, c, s, k, g = path
    straight = _theta_of_straight(time, v, k, g)
    turned = theta_of_turn(path, np.maximum(1.0, _ballistic_turn(time, v, c, s, g)))
    end = last_theta(path)
    end = np.where(end > 0.0, end, np.inf)
    start = np.minimum(np.maximum(straight, turned), end)

    def late(theta: Row, time: Row, *path: Row) -> tuple[Row, Row]:
        t, rate = _clock(theta, *path)
        return np.where(np.abs(t - time) <= ROUNDING * time, 0.0, t - time), rate

    state = state_at(path, rising_root(late, start, 0.0, end, time, *path, longest=LONGEST))
    return after(path, state, time - state.time)


def parallel(path: Path, slope_cosine: Row, slope_sine: Row) -> State:
    """Where the path is farthest above a line of this direction: the apex if the line is level."""
    return state_at(path, theta_of_turn(path, _parallel_turn(path.cosine, path.sine, slope_cosine, slope_sine)))


def crossing(path: Path, slope_cosine: Row, slope_sine: Row, height: Row = 0.0) -> tuple[State, Row]:
    """Where the path crosses a line from above to below.

    Args:
        path: The launch.
        slope_cosine: Cosine of the line's angle, >= 0; 0 is a wall.
        slope_sine: Its sine.
        height: How far the launch point stands above the line [m], along the line's normal.

    Returns:
        The state there and True, or the state nearest to the line and False.
    """
    v, c, s, k, g = path
    *state, missed = landing(
        0.0, 0.0, v * c, v * s, k, g, height * slope_sine, -height * slope_cosine, slope_cosine, slope_sine
    )
    return State(*state), np.asarray(missed) <= 0.0


def by_launch(path: Path, state: State) -> tuple[Row, Row, Row, Row]:
    """Derivatives of the position at the state's time: dx/dv, dy/dv [s], dx/dpsi, dy/dpsi [m/rad]."""
    t_v, x_v, y_v, t_psi, x_psi, y_psi = _derivatives(state.theta, *path)
    return (
        x_v - state.vx * t_v,
        y_v - state.vy * t_v,
        x_psi - state.vx * t_psi,
        y_psi - state.vy * t_psi,
    )
