"""Rigid motions of the plane, SE(2): points, poses, exponential and logarithm, their Jacobians.

A pose (x, y, theta) stands for T = [[R(theta), (x, y)], [0, 1]], R(theta) = [[c, -s], [s, c]].
Exponential coordinates (dx, dy, dtheta) are a displacement seen from the moving frame.

Sources: Lynch and Park 2017, Modern Robotics, ch. 3; Sola, Deray, Atchuthan 2018, A micro Lie theory, sec. IV.
"""

from coplanar.engine import PI, TAU, absolute, atan2, dsinc, hypot, sinc, sincos, turn_remainder, where


def wrap(angle):
    """The same direction in (-pi, pi]: whole turns of TAU taken off, without rounding."""
    rest = turn_remainder(angle)
    return where(rest <= -PI, rest + TAU, rest)


def heading(cosine, sine):
    """Heading in (-pi, pi] of the direction (cos theta, sin theta), of any length but 0."""
    return wrap(atan2(sine, cosine))


def rotate(theta, px, py):
    """R(theta) p."""
    s, c = sincos(theta)
    return c * px - s * py, s * px + c * py


def act(x, y, theta, px, py):
    """Coordinates in the outer frame of the point p given in the inner one: C_0 = O_1 + R C_1."""
    s, c = sincos(theta)
    return x + c * px - s * py, y + s * px + c * py


def act_inverse(x, y, theta, px, py):
    """Coordinates in the inner frame of the point p given in the outer one: C_1 = R^T (C_0 - O_1)."""
    s, c = sincos(theta)
    dx, dy = px - x, py - y
    return c * dx + s * dy, c * dy - s * dx


def compose(x1, y1, theta1, x2, y2, theta2):
    """T_0_2 = T_0_1 T_1_2."""
    s, c = sincos(theta1)
    return x1 + c * x2 - s * y2, y1 + s * x2 + c * y2, theta1 + theta2


def inverse(x, y, theta):
    """T^-1 = (-R^T p, -theta)."""
    s, c = sincos(theta)
    return -c * x - s * y, s * x - c * y, -theta


def between(x1, y1, theta1, x2, y2, theta2):
    """T_1_2 = T_0_1^-1 T_0_2."""
    s, c = sincos(theta1)
    dx, dy = x2 - x1, y2 - y1
    return c * dx + s * dy, c * dy - s * dx, theta2 - theta1


def exp(dx, dy, dtheta):
    """Pose reached by (dx, dy, dtheta): walk the chord at mid-heading, p = sinc(h) R(h) (dx, dy), h = dtheta/2."""
    half = 0.5 * dtheta
    s, c = sincos(half)
    chord = sinc(half)
    return chord * (c * dx - s * dy), chord * (s * dx + c * dy), dtheta


def log(x, y, theta):
    """Exponential coordinates of a pose, dtheta in (-pi, pi]: (dx, dy) = R(-h) p / sinc(h), h = dtheta/2."""
    turn = wrap(theta)
    half = 0.5 * turn
    s, c = sincos(half)
    chord = sinc(half)
    return (c * x + s * y) / chord, (c * y - s * x) / chord, turn


def step(x, y, theta, dx, dy, dtheta):
    """T exp(dx, dy, dtheta): the pose after a displacement seen from the moving frame."""
    half = 0.5 * dtheta
    s, c = sincos(theta + half)
    chord = sinc(half)
    return x + chord * (c * dx - s * dy), y + chord * (s * dx + c * dy), theta + dtheta


def adjoint(x, y, theta, vx, vy, omega):
    """Ad_T xi: a twist seen from the inner frame, as the outer frame sees it (velocity of its own origin)."""
    s, c = sincos(theta)
    return c * vx - s * vy + y * omega, s * vx + c * vy - x * omega, omega


def exp_jacobian(dx, dy, dtheta):
    """Entries of the Jacobian of exp: dp/d(dx, dy) = [[a, -b], [b, a]], dp/d(dtheta) = (u, w).

    With h = dtheta/2: a = sinc(h) cos(h), b = sinc(h) sin(h) and their derivatives by h halved.
    """
    half = 0.5 * dtheta
    s, c = sincos(half)
    chord, slope = sinc(half), dsinc(half)
    da, db = 0.5 * (slope * c - chord * s), 0.5 * (slope * s + chord * c)
    return chord * c, chord * s, da * dx - db * dy, db * dx + da * dy


def right_jacobian(dx, dy, dtheta):
    """Last column above the 1 and the rotation block of J_r: exp(xi + d) = exp(xi) exp(J_r d).  [Sola 2018, eq. 163]

    J_r = [[a, b, u], [-b, a, w], [0, 0, 1]], that is R(-dtheta) times the Jacobian of exp.
    """
    half = 0.5 * dtheta
    s, c = sincos(half)
    chord, slope = sinc(half), dsinc(half)
    da, db = 0.5 * (slope * c - chord * s), 0.5 * (slope * s + chord * c)
    s2, c2 = 2.0 * s * c, c * c - s * s
    px, py = da * dx - db * dy, db * dx + da * dy
    return chord * c, chord * s, c2 * px + s2 * py, c2 * py - s2 * px


def during(vx, vy, omega, dt):
    """Displacement made in dt at a constant twist: xi = V dt."""
    return vx * dt, vy * dt, omega * dt


def over(dx, dy, dtheta, dt):
    """The constant twist that makes a displacement in dt: V = xi / dt."""
    return dx / dt, dy / dt, dtheta / dt


def integrate(x, y, theta, vx, vy, omega, dt):
    """T exp(V dt): the pose after a constant twist for dt."""
    return step(x, y, theta, vx * dt, vy * dt, omega * dt)


def screw(x, y, theta, dx, dy, dtheta, fraction):
    """The pose a fraction of the way along the constant twist (dx, dy, dtheta)."""
    return step(x, y, theta, fraction * dx, fraction * dy, fraction * dtheta)


def lerp(x1, y1, theta1, x2, y2, theta2, fraction):
    """Position on the straight line and heading on the shorter turn, each on its own."""
    return x1 + fraction * (x2 - x1), y1 + fraction * (y2 - y1), theta1 + fraction * wrap(theta2 - theta1)


def separation(x1, y1, theta1, x2, y2, theta2):
    """Distance of two origins, and the angle in [0, pi] between two headings."""
    return hypot(x2 - x1, y2 - y1), absolute(wrap(theta2 - theta1))


def coordinate(px, py, ax, ay):
    """[p]_k = p . x_k: the coordinate of p along the unit vector x_k = (ax, ay)."""
    return px * ax + py * ay
