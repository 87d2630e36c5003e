"""Odometry: where a body is, from what it measured of each tick of its motion, and how sure that is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike, Real
from coplanar.engine import Evaluator, Walk, evaluator, is_foreign, memory, running_sum, written
from coplanar.errors import InvalidShape
from coplanar.integrators import METHODS
from coplanar.laws import motion as laws
from coplanar.laws import se2
from coplanar.motion.covariance import OdometryNoise, about, carried, checked_covariance, lever, summed_about
from coplanar.motion.program import held_samples
from coplanar.motion.sequence import along, before_last_axis
from coplanar.se2 import Displacement, Pose
from coplanar.se2.triple import matrix_of

_covered = evaluator(laws.covered)
_rotate = evaluator(se2.rotate)
_step = evaluator(se2.step)
_step_jacobian = evaluator(laws.step_jacobian)
_walk = Walk(se2.step)
_wheel_increments = evaluator(laws.wheel_increments)

EXACT = "exact"
PATH_METHODS = (EXACT, *METHODS)


@dataclass(frozen=True, slots=True)
class Odometry:
    """A row of displacements, each along a constant twist of its own: T_k+1 = T_k exp(increment_k).

    Attributes:
        increments: What each tick measured, seen from the body; shape (..., n). Leading axes are robots.

    Raises:
        InvalidShape: If there is no last axis to run along.

    Example:
        >>> Odometry.from_wheels([1.0, 1.0], [1.0, 1.0], track=0.3).path(Pose()).x.tolist()
        [0.0, 1.0, 2.0]
    """

    increments: Displacement

    def __post_init__(self) -> None:
        shape = self.increments.shape
        if not shape:
            raise InvalidShape("increments", "shape ()", "shape (..., n)", "for one tick use pose.step(increment)")
        parts = (along(p, shape[-1]) for p in self.increments.parts)
        object.__setattr__(self, "increments", Displacement._of(*parts))

    @classmethod
    def from_velocities(cls, v: ArrayLike, omega: ArrayLike, t: ArrayLike) -> Odometry:
        """From velocities that hold until the next time.

        Args:
            v: Forward velocity [m/s], shape (..., n) or (..., n - 1); of n samples the last one is not driven.
            omega: Turn rate [rad/s], likewise.
            t: Strictly monotone times [s], shape (n,); decreasing times drive back.

        Raises:
            InvalidShape: If the counts differ.

        Example:
            >>> Odometry.from_velocities([1.0, 3.0, 9.0], 0.0, [5.0, 6.0, 8.0]).path(Pose()).x.tolist()
            [0.0, 1.0, 7.0]
        """
        times = checks.monotone("t", t)
        dt = np.diff(times)
        held = {name: held_samples(name, rate, times.size, look=False) for name, rate in (("v", v), ("omega", omega))}
        way, turn = (_measured(_covered, 1, **{name: rate}, dt=dt)[0] for name, rate in held.items())
        checks.broadcast(v=way, omega=turn)
        return cls(Displacement._of(way, 0.0, turn))

    @classmethod
    def from_wheels(cls, left: ArrayLike, right: ArrayLike, *, track: ArrayLike) -> Odometry:
        """From how far the wheels of a differential drive rolled in each tick.

        Args:
            left: Way of the left wheel [m], shape (..., n).
            right: Way of the right wheel [m], shape (..., n).
            track: The whole distance between the wheels [m], not half of it; a number, or shape (..., 1).

        Raises:
            InvalidValue: If the track is not positive.
            InvalidShape: If they do not broadcast.

        Example:
            >>> Odometry.from_wheels([0.1], [0.3], track=0.4).path(Pose()).theta.round(12).tolist()
            [0.0, 0.5]
        """
        ways = {
            name: checks.ending_in(None, name, checks.reals(name, way))
            for name, way in (("left", left), ("right", right))
        }
        distance, turn = _measured(_wheel_increments, 2, **ways, track=checks.positive("track", track))
        return cls(Displacement._of(distance, 0.0, turn))

    def path(self, start: Pose, *, method: str = EXACT, out: np.ndarray | None = None) -> Pose:
        """The pose before each tick and after the last one, shape (..., n + 1), with no loop over ticks.

        Headings are running sums of turns, positions running sums of chords. Headings are never wrapped.

        Args:
            start: Where it begins.
            method: "exact" for arcs, or a Runge-Kutta method ("euler", "midpoint", "heun", "rk4") that takes one step
                along the twist of each tick, to see what it costs.
            out: Where x, y and theta are written, shape (3, ..., n + 1); the poses that come back look at it.

        Raises:
            UnknownName: If there is no such method.
            InvalidShape: If ``out`` is of another shape or type.

        Example:
            >>> Odometry(Displacement([1.0, 1.0], 0.0, 0.0)).path(Pose(1.0, 2.0, 0.0)).y.tolist()
            [2.0, 2.0, 2.0]
        """
        checks.choice("method", method, PATH_METHODS)
        if out is not None:
            *lead, n = np.broadcast_shapes((*start.shape, 1), self.increments.shape)
            checks.output(out, (3, *lead, n + 1))
        if method == EXACT:
            return Pose._of(*_walk(start.parts, self.increments.parts, out=out))
        path = walked(self.increments, start, method)[0]
        return path if out is None else Pose._of(*written(out, path.parts))

    def end(self, start: Pose) -> Pose:
        """The pose after the last tick, the last one of ``path``; the others take no memory.

        Example:
            >>> Odometry(Displacement([1.0, 1.0], 0.0, 0.0)).end(Pose(1.0, 2.0, 0.0))
            Pose(x=3.0, y=2.0, theta=0.0)
        """
        return Pose._of(*_walk(start.parts, self.increments.parts, keep="end"))

    def jacobians(self, start: Pose) -> tuple[np.ndarray, np.ndarray]:
        """How the pose after each tick moves with the pose before it, F, and with its increment, G.

        Returns:
            F and G, each of shape (..., n, 3, 3).

        Example:
            >>> F, G = Odometry(Displacement([2.0], 0.0, 0.0)).jacobians(Pose())
            >>> F[0].tolist()
            [[1.0, 0.0, -0.0], [0.0, 1.0, 2.0], [0.0, 0.0, 1.0]]
        """
        heading = before_last_axis(start.theta) + running_sum(self.increments.dtheta)
        a, b, u, w, dx, dy = _step_jacobian(heading[..., :-1], *self.increments.parts)
        return lever(dx, dy), matrix_of((a, -b, u), (b, a, w), (0.0, 0.0, 1.0))

    def covariances(
        self, start: Pose, noise: OdometryNoise | ArrayLike, initial: ArrayLike | None = None
    ) -> np.ndarray:
        """Covariance of (x, y, theta) before each tick and after the last one: P' = F P F^T + G Q G^T.

        F only moves the point that the heading's error swings about, so all of them are summed about the start and
        moved to where each belongs: no loop over ticks.

        Args:
            start: Where it begins.
            noise: A model, or Q of each increment, shape (..., n, 3, 3) [m^2, m rad, rad^2].
            initial: P at the start, shape (..., 3, 3); certain where None.

        Returns:
            Shape (..., n + 1, 3, 3) [m^2, m rad, rad^2].

        Raises:
            InvalidShape: If a covariance is not 3 by 3.
            InvalidValue: If it is not symmetric.

        Example:
            >>> straight = Odometry(Displacement([1.0, 1.0], 0.0, 0.0))
            >>> P = straight.covariances(Pose(), OdometryNoise(forward=0.1))
            >>> P[:, 0, 0].round(12).tolist()
            [0.0, 0.01, 0.02]
        """
        Q = (
            noise.covariances(self.increments)
            if isinstance(noise, OdometryNoise)
            else checked_covariance("noise", noise)
        )
        P = np.zeros((3, 3)) if initial is None else checked_covariance("initial", initial)
        path, _ = walked(self.increments, start)
        return carried(about(path, start), summed_about(path, start, self.increments, Q, P))


def _measured(law: Evaluator, results: int, **given: Real) -> Any:
    """What a law makes of arrays; that they are finite is seen on the way.

    Raises:
        InvalidShape: If they do not broadcast.
        InvalidValue: If one of them has a NaN or an infinity.
    """
    shape = checks.broadcast(**given)
    if any(map(is_foreign, given.values())):
        answer = law(*given.values())
        return answer if results > 1 else (answer,)
    table: np.ndarray = memory.empty((results, *shape))
    if not law.into(tuple(table), *given.values(), finite=True):
        for name, value in given.items():
            checks.finite(name, value if np.ndim(value) else float(value), np.asarray(value))
    return table


def walked(
    increments: Displacement, start: Pose, method: str = EXACT, before: Sequence[Real | None] = (None, None, None)
) -> tuple[Pose, tuple[Real, Real, Real]]:
    """Poses (..., n + 1), and the sums of chords and turns after the last tick, which are ``before`` of more ticks."""
    sums = [None, None, running_sum(increments.dtheta, before[2])]
    x, y, theta = map(before_last_axis, start.parts)
    heading = theta + sums[2]
    for i, chord in enumerate(_chords(heading[..., :-1], increments, method)):
        sums[i] = running_sum(chord, before[i])
    return Pose._of(x + sums[0], y + sums[1], heading), tuple(total[..., -1] for total in sums)


def _chords(heading: Real, increments: Displacement, method: str) -> tuple[Real, Real]:
    """What each tick adds to the position: an arc, or by slopes, sum_i b_i R(theta + c_i dtheta) (dx, dy)."""
    dx, dy, dtheta = increments.parts
    if method == EXACT:
        along_x, along_y, _ = _step(0.0, 0.0, heading, dx, dy, dtheta)
        return along_x, along_y
    row = METHODS[method]
    slopes = [_rotate(heading + c * dtheta, dx, dy) for c in row.c]
    x, y = (sum(b * slope for b, slope in zip(row.b, axis, strict=True)) for axis in zip(*slopes, strict=True))
    return x, y
