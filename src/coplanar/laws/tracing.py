# ruff: noqa: D403 (a symbol keeps its case)
"""A curve seen from the base of an arm.

Source: Lynch and Park 2017, Modern Robotics, sec. 6.1 (the ring that two links reach) and 5.3 (singularities).
"""

from coplanar.engine import hypot


def radius(x, y, base_x, base_y):
    """r = |P - B|."""
    return hypot(x - base_x, y - base_y)


def radial_rate(x, y, dx, dy, base_x, base_y):
    """r dr/dphi = (P - B) . P': 0 where the distance from the base is extreme, on the base, and at a cusp."""
    return (x - base_x) * dx + (y - base_y) * dy
