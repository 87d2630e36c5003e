"""Velocity and force ellipses: what unit joint rates do to the tool, what unit joint torques hold."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from coplanar import checks
from coplanar.checks import ArrayLike
from coplanar.engine import evaluator
from coplanar.errors import InvalidShape
from coplanar.laws import arms as laws

KINDS = ("force", "velocity")

_axis_angle = evaluator(laws.axis_angle)


@dataclass(frozen=True, slots=True)
class Ellipse:
    """Half axes and their directions, largest first; an ellipsoid for the task "pose".

    Attributes:
        radii: Half axes, shape (..., m): singular values of J for velocities, their inverses for forces, which are
            infinite where the arm is singular [m/rad, 1/m].
        axes: Unit vectors in the columns, shape (..., m, m).
    """

    radii: np.ndarray
    axes: np.ndarray

    @property
    def angle(self) -> Any:
        """Direction of the largest half axis, in (-pi/2, pi/2] [rad].

        Raises:
            InvalidShape: If this is an ellipsoid.
        """
        self._needs_plane()
        return _axis_angle(self.axes[..., 0, 0], self.axes[..., 1, 0])

    def outline(self, centre: ArrayLike = (0.0, 0.0), *, scale: float = 1.0, count: int = 65) -> np.ndarray:
        """Points of the closed outline, shape (..., count, 2).

        Args:
            centre: Where to draw it, shape (..., 2) [m].
            scale: Length drawn for a radius of 1.
            count: How many points; the last one is the first.

        Raises:
            InvalidShape: If this is an ellipsoid.
        """
        self._needs_plane()
        turn = np.linspace(0.0, 2.0 * np.pi, count)
        circle = np.stack((np.cos(turn), np.sin(turn)), axis=-1)
        radii = scale * self.radii[..., None, :]
        offsets = np.einsum("...ij,...kj->...ki", self.axes, radii * circle)
        points: np.ndarray = checks.vector("centre", centre, 2)[..., None, :] + offsets
        return points

    def _needs_plane(self) -> None:
        if self.radii.shape[-1] != 2:
            raise InvalidShape("task", "pose", "position", "an ellipsoid of positions and angles has no outline")


def ellipse_of(jacobian: np.ndarray, kind: str) -> Ellipse:
    """The ellipse of J, shape (..., m, n): axes U and radii of J = U S V^T.

    Example:
        >>> ellipse_of(np.array([[2.0, 0.0], [0.0, 0.5]]), "force").radii.tolist()
        [2.0, 0.5]
    """
    checks.choice("kind", kind, KINDS)
    m = jacobian.shape[-2]
    axes, values, _ = np.linalg.svd(jacobian)
    lacking = [(0, 0)] * (values.ndim - 1) + [(0, m - values.shape[-1])]
    radii = np.pad(values, lacking)
    if kind == "velocity":
        return Ellipse(radii, axes)
    with np.errstate(divide="ignore"):
        return Ellipse(1.0 / radii[..., ::-1], axes[..., ::-1])
