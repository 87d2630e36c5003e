"""Plane curves by one parameter, and how time runs along them.

Each curve has three laws: position, first and second derivative with respect to its parameter.
Curves stand at the origin; ``se2.act`` and ``se2.rotate`` place them.

Sources: Lawrence 1972, A Catalog of Special Plane Curves (astroid 6.6, lemniscate of Gerono 5.4);
Flash and Hogan 1985, The coordination of arm movements, eq. 3 (minimum jerk).
"""

from coplanar.engine import maximum, minimum, sincos, where


def line(phi, x0, y0, x1, y1):
    """P0 + phi (P1 - P0)."""
    return x0 + phi * (x1 - x0), y0 + phi * (y1 - y0)


def line_rate(phi, x0, y0, x1, y1):
    """P1 - P0."""
    return x1 - x0 + 0.0 * phi, y1 - y0 + 0.0 * phi


def line_second(phi, x0, y0, x1, y1):
    """(0, 0): a line does not bend."""
    nothing = 0.0 * (phi + x0 + y0 + x1 + y1)
    return nothing, nothing


def ellipse(phi, a, b):
    """(a cos phi, b sin phi)."""
    s, c = sincos(phi)
    return a * c, b * s


def ellipse_rate(phi, a, b):
    """(-a sin phi, b cos phi)."""
    s, c = sincos(phi)
    return -a * s, b * c


def ellipse_second(phi, a, b):
    """(-a cos phi, -b sin phi)."""
    s, c = sincos(phi)
    return -a * c, -b * s


def lemniscate(phi, a, b):
    """(a cos phi, b cos phi sin phi): the lemniscate of Gerono."""
    s, c = sincos(phi)
    return a * c, b * c * s


def lemniscate_rate(phi, a, b):
    """(-a sin phi, b (cos^2 phi - sin^2 phi))."""
    s, c = sincos(phi)
    return -a * s, b * (c - s) * (c + s)


def lemniscate_second(phi, a, b):
    """(-a cos phi, -4 b cos phi sin phi)."""
    s, c = sincos(phi)
    return -a * c, -4.0 * b * c * s


def astroid(phi, a):
    """(a cos^3 phi, a sin^3 phi)."""
    s, c = sincos(phi)
    return a * c * c * c, a * s * s * s


def astroid_rate(phi, a):
    """(-3 a cos^2 phi sin phi, 3 a sin^2 phi cos phi): zero at the four cusps."""
    s, c = sincos(phi)
    return -3.0 * a * c * c * s, 3.0 * a * s * s * c


def astroid_second(phi, a):
    """(3 a cos phi (2 sin^2 phi - cos^2 phi), 3 a sin phi (2 cos^2 phi - sin^2 phi))."""
    s, c = sincos(phi)
    return 3.0 * a * c * (2.0 * s * s - c * c), 3.0 * a * s * (2.0 * c * c - s * s)


def uniform(t, start, duration):
    """Progress s = (t - start)/duration from 0 to 1 with its two time derivatives; at rest before and after."""
    moving = where(t < start, 0.0, where(t > start + duration, 0.0, 1.0))
    progress = minimum(maximum((t - start) / duration, 0.0), 1.0)
    return progress, moving / duration, 0.0 * moving


def minimum_jerk(t, start, duration):
    """Progress s = u^3 (10 - 15 u + 6 u^2), u = (t - start)/duration, from rest to rest.  [Flash 1985, eq. 3]"""
    u = minimum(maximum((t - start) / duration, 0.0), 1.0)
    rest = 1.0 - u
    progress = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u)
    rate = 30.0 * u * u * rest * rest / duration
    return progress, rate, 60.0 * u * rest * (rest - u) / (duration * duration)


def velocity_along(dx, dy, rate):
    """dP/dt = P' phidot."""
    return dx * rate, dy * rate


def acceleration_along(dx, dy, ddx, ddy, rate, change):
    """d2P/dt2 = P'' phidot^2 + P' phiddot."""
    square = rate * rate
    return ddx * square + dx * change, ddy * square + dy * change
