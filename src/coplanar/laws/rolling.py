"""A wheel that rolls along a line, seen from the side: x along the road, y up.

A positive rate phidot turns the wheel clockwise and drives it towards +x. The rim angle beta is measured at the
centre, from the contact, in the sense of the turning: 0 at the contact, pi/2 at the rear, pi on top, 3 pi/2 in front.

Sources: Goldstein 1980, Classical Mechanics, sec. 1.3 (rolling); Yates 1947, Curves and their properties (cycloid).
"""

from coplanar.engine import sincos


def point_velocity(vx, vy, omega, px, py):
    """v_p = v + omega x p, p from the point that moves with v; omega counterclockwise."""
    return vx - omega * py, vy + omega * px


def centre_speed(rate, radius, slip):
    """v_centre = r phidot + slip; slip = 0 when the wheel rolls."""
    return radius * rate + slip


def slip_speed(speed, rate, radius):
    """Slip v_centre - r phidot: the velocity of the contact along the road."""
    return speed - radius * rate


def rolling_rate(speed, radius, slip):
    """Rate phidot = (v_centre - slip)/r."""
    return (speed - slip) / radius


def rim_offset(radius, beta):
    """The rim point seen from the centre: r (-sin beta, -cos beta)."""
    s, c = sincos(beta)
    return -radius * s, -radius * c


def rim_velocity(rate, radius, slip, beta):
    """v_centre + omega x (point - centre), omega = -phidot: (slip, 0) at the contact, v_centre + r phidot on top."""
    px, py = rim_offset(radius, beta)
    return point_velocity(centre_speed(rate, radius, slip), 0.0 * rate, -rate, px, py)


def rim_position(centre, radius, beta):
    """The rim point of a wheel on the road y = 0; centre = r beta draws the cycloid r (b - sin b, 1 - cos b)."""
    px, py = rim_offset(radius, beta)
    return centre + px, radius + py
