"""One row for every wheel of a base: fixed, omni, mecanum; and what follows from the rows.

The body frame has x forward and y to the left; all angles are counterclockwise seen from above. A wheel stands at
(x, y); a positive rate drives its contact along the drive direction beta. The roller that touches the ground has its
axle along beta + gamma and rolls freely along beta + gamma + 90 deg; gamma = 0 is a plain omni wheel, +-45 deg mecanum.
A row (a, b, c) stands for a vx + b vy + c omega.

Sources: Lynch and Park 2017, Modern Robotics, eqs. 13.5 and 13.6; Campion, Bastin, d'Andrea-Novel 1996 (mobility).
"""

from coplanar.engine import absolute, maximum, minimum, sincos, tan, where
from coplanar.laws.se2 import act, rotate

NONE = float("inf")  # where there is no centre of rotation


def traction_row(x, y, ux, uy):
    """Row of the velocity along (ux, uy) of the body point (x, y): (ux, uy) . ([vx, vy] + omega [-y, x])."""
    return ux, uy, x * uy - y * ux


def rolling_row(x, y, beta, gamma):
    """Rolling row: r phidot = [1, tan gamma] . R(-beta) . ([vx, vy] + omega [-y, x])."""
    ux, uy = rotate(beta, 1.0, tan(gamma))
    return traction_row(x, y, ux, uy)


def lateral_row(x, y, beta):
    """Lateral row: 0 = [0, 1] . R(-beta) . ([vx, vy] + omega [-y, x]): an ordinary wheel has no sideways velocity."""
    s, c = sincos(beta)
    return traction_row(x, y, -s, c)


def row_speed(a, b, c, vx, vy, omega):
    """Speed a vx + b vy + c omega of one row."""
    return a * vx + b * vy + c * omega


def row_residual(speed, a, b, c, vx, vy, omega):
    """Residual r phidot - J xi of one row."""
    return speed - row_speed(a, b, c, vx, vy, omega)


def wheel_rate(a, b, c, radius, vx, vy, omega):
    """Rate phidot = J xi / r of one row."""
    return row_speed(a, b, c, vx, vy, omega) / radius


def add_share(vx, vy, omega, a, b, c, rate):
    """Sum xi + (a, b, c) phidot: the twist with one wheel's share added; (a, b, c) is its column of J+ r."""
    return vx + a * rate, vy + b * rate, omega + c * rate


def pfaffian_row(a, b, c, theta):
    """The body row for world rates: a vx + b vy + c omega = A(q) . (xdot, ydot, thetadot)."""
    u, w = rotate(theta, a, b)
    return u, w, c


def twist_bracket(vx1, vy1, omega1, vx2, vy2, omega2):
    """[xi1, xi2] = (omega1 J v2 - omega2 J v1, 0), J a quarter turn: what a small loop of both motions opens.

    [Murray, Li, Sastry 1994, ch. 7]
    """
    return omega2 * vy1 - omega1 * vy2, omega1 * vx2 - omega2 * vx1, 0.0 * omega1


def differential_forward(left_rate, right_rate, left_radius, right_radius, half_track):
    """Body v = (r_r phidot_r + r_l phidot_l)/2, omega = (r_r phidot_r - r_l phidot_l)/(2b)."""
    left, right = left_radius * left_rate, right_radius * right_rate
    return 0.5 * (right + left), (right - left) / (2.0 * half_track)


def differential_inverse(v, omega, left_radius, right_radius, half_track):
    """Rates phidot_l = (v - b omega)/r_l, phidot_r = (v + b omega)/r_r."""
    return (v - half_track * omega) / left_radius, (v + half_track * omega) / right_radius


def turning_radius(left_speed, right_speed, half_track):
    """R = b (v_r + v_l)/(v_r - v_l), positive to the left; infinite when both speeds are equal."""
    turns = right_speed != left_speed
    return where(turns, half_track * (right_speed + left_speed) / where(turns, right_speed - left_speed, 1.0), NONE)


def wheel_centre_speeds(radius, omega, half_track):
    """v_l = (R - b) omega, v_r = (R + b) omega: left and right wheel about a centre at the distance R."""
    return (radius - half_track) * omega, (radius + half_track) * omega


def rotation_centre(vx, vy, omega):
    """The body point without velocity, (-vy, vx)/omega; infinite when omega = 0."""
    turns = omega != 0.0
    divisor = where(turns, omega, 1.0)
    return where(turns, -vy / divisor, NONE), where(turns, vx / divisor, NONE)


def rotation_centre_in_world(x, y, theta, vx, vy, omega):
    """The centre of rotation in the world; (x - R sin theta, y + R cos theta) when vy = 0; infinite when omega = 0."""
    turns = omega != 0.0
    divisor = where(turns, omega, 1.0)
    px, py = act(x, y, theta, -vy / divisor, vx / divisor)
    return where(turns, px, NONE), where(turns, py, NONE)


def limited_share(share, rate, limit):
    """The smaller of a share and limit/|rate|: what every rate is multiplied by to keep this one inside its limit."""
    return minimum(share, limit / maximum(absolute(rate), limit))


def clipped(rate, limit):
    """The rate brought into [-limit, limit]."""
    return maximum(-limit, minimum(limit, rate))


def turning_share(alone, together):
    """The turning keeps what fits by itself, or together with the translation where that is more."""
    return maximum(alone, together)


def moving_share(share, turning, moving, limit):
    """The largest share, up to the given one, with |turning + share moving| <= limit, where any share fits."""
    room = maximum(limit - where(moving < 0.0, -turning, turning), 0.0)
    over = absolute(moving) > room
    return minimum(share, where(over, room / where(over, absolute(moving), 1.0), 1.0))
