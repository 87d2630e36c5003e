"""Coordinates of a vector in an orthonormal basis of the plane, and the vector made of them.

The coordinate itself, [p]_k = p . x_k, is ``coplanar.laws.se2.coordinate``.

Source: Lynch and Park 2017, Modern Robotics, sec. 3.1.
"""

from coplanar.engine import absolute, maximum
from coplanar.laws.se2 import coordinate


def coordinates(px, py, ax, ay, bx, by):
    """[p]_1 = p . x_1 and [p]_2 = p . x_2 for the basis x_1 = (ax, ay), x_2 = (bx, by)."""
    return coordinate(px, py, ax, ay), coordinate(px, py, bx, by)


def combination(c1, c2, ax, ay, bx, by):
    """Vector p = [p]_1 x_1 + [p]_2 x_2."""
    return c1 * ax + c2 * bx, c1 * ay + c2 * by


def orthonormality_gap(ax, ay, bx, by):
    """Largest of |x_1 . x_1 - 1|, |x_2 . x_2 - 1| and |x_1 . x_2|: zero for an orthonormal basis."""
    lengths = maximum(absolute(coordinate(ax, ay, ax, ay) - 1.0), absolute(coordinate(bx, by, bx, by) - 1.0))
    return maximum(lengths, absolute(coordinate(ax, ay, bx, by)))
