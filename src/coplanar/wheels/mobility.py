"""What the rows of a base determine, allow and forbid."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from coplanar.checks import frozen
from coplanar.engine import evaluator
from coplanar.laws import wheels as laws

_twist_bracket = evaluator(laws.twist_bracket)


@dataclass(frozen=True, slots=True)
class Mobility:
    """Ranks and directions of the rows of a base; a direction is a twist (vx, vy, omega) with rms speed 1.

    Twists are compared by the length L: omega counts as the speed L omega, so that all entries are speeds.

    Attributes:
        length: L, the root mean square distance of the wheels from the body origin [m].
        singular_values: Of all rows, with the omega column divided by L; three, largest first [-].
        rank: Of all rows: 3 when the wheels determine the twist.
        constraint_rank: Of the lateral rows of the ordinary wheels.
        inverse: Least-squares inverse of all rows (3, rows), of least norm where the rank is below 3.
        weakest: The twist that turns the wheels least, shape (3,).
        undriven: Twists that turn no wheel and slide none: nothing drives or holds them, shape (3 - rank, 3).
        free: Twists that slide no ordinary wheel, driven or not, shape (3 - constraint_rank, 3).
        admissible: Twists that the wheels drive without sliding, shape (degrees of control, 3).
        projection: The matrix that takes a twist to the nearest one that the base can be driven along, (3, 3).
    """

    length: float
    singular_values: np.ndarray
    rank: int
    constraint_rank: int
    inverse: np.ndarray
    weakest: np.ndarray
    undriven: np.ndarray
    free: np.ndarray
    admissible: np.ndarray
    projection: np.ndarray

    @classmethod
    def of_rows(cls, rolling: np.ndarray, lateral: np.ndarray, *, length: float, tolerance: float) -> Mobility:
        """From the rows.

        Args:
            rolling: One row for each wheel, (N, 3) [1, 1, m].
            lateral: One row for each ordinary wheel, (L, 3) [1, 1, m].
            length: What omega is multiplied by to compare it with a speed [m].
            tolerance: Singular values below this share of the largest, or of 1, count as zero [-].
        """
        scale = np.array([1.0, 1.0, length])
        rows = np.concatenate([rolling, lateral])
        values, driven, undriven, inverse = _split(rows / scale, tolerance)
        inverse = _exact_inverse(rows) if len(driven) == 3 else inverse / scale[:, None]
        _, sliding, free, _ = _split(lateral / scale, tolerance)
        admissible = _split(free @ driven.T @ driven, tolerance)[1] if free.size and undriven.size else free
        projection = (admissible.T @ admissible) * scale / scale[:, None]
        return cls(
            length, frozen(values), len(driven), len(sliding), frozen(inverse),
            frozen(np.concatenate([driven, undriven])[-1] / scale), frozen(undriven / scale), frozen(free / scale),
            frozen(admissible / scale), frozen(projection),
        )  # fmt: skip

    @property
    def condition(self) -> float:
        """Largest over smallest singular value [-]: 1 is isotropic, infinite when the rank is below 3."""
        return float(self.singular_values[0] / self.singular_values[-1]) if self.rank == 3 else float("inf")

    @property
    def degrees_of_control(self) -> int:
        """How many independent twists the wheels drive without sliding."""
        return len(self.admissible)

    @property
    def degrees_of_mobility(self) -> int:
        """3 less the rank of the lateral rows: the twists that slide no ordinary wheel.  [Campion 1996]"""
        return 3 - self.constraint_rank

    def degrees_of_configuration(self, tolerance: float = 1e-9) -> int:
        """How many of (x, y, theta) the driven twists reach together: the dimension of their Lie algebra.

        Args:
            tolerance: Singular values below this share of the largest, or of 1, count as zero [-].
        """
        scale = np.array([1.0, 1.0, self.length])
        span = self.admissible
        while len(span):
            brackets = [np.array(_twist_bracket(*map(float, (*a, *b)))) * self.length for a in span for b in span]
            basis = _split(np.array([*span, *brackets]) * scale, tolerance)[1] / scale
            if len(basis) == len(span):
                return len(span)
            span = basis
        return 0


def _split(rows: np.ndarray, tolerance: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Singular values (three), bases of the row space and of its complement, pseudo-inverse.

    Every row of a wheel has length 1 or more, so singular values are measured against 1 at least.
    """
    if not rows.size:
        return np.zeros(3), np.zeros((0, 3)), np.eye(3), np.zeros((3, 0))
    left, values, right = np.linalg.svd(rows, full_matrices=True)
    rank = int(np.sum(values > tolerance * max(1.0, values[0])))
    inverse = right[:rank].T @ (left[:, :rank] / values[:rank]).T
    padded = np.concatenate([values, np.zeros(3 - values.size)])
    return np.where(np.arange(3) < rank, padded, 0.0), right[:rank], right[rank:], inverse


def _exact_inverse(rows: np.ndarray) -> np.ndarray:
    """(A^T A)^-1 A^T by Cramer's rule in whole numbers, rounded once: what cancels by symmetry cancels exactly."""
    A = [[Fraction(entry) for entry in row] for row in rows.tolist()]
    p, q, r = ([_dot([row[i] for row in A], [row[j] for row in A]) for j in range(3)] for i in range(3))
    adjugate = (_cross(q, r), _cross(r, p), _cross(p, q))
    determinant = _dot(p, adjugate[0])
    return np.array([[float(_dot(line, row) / determinant) for row in A] for line in adjugate])


def _dot(a: list[Fraction], b: list[Fraction]) -> Fraction:
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


def _cross(a: list[Fraction], b: list[Fraction]) -> list[Fraction]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
