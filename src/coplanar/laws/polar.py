# ruff: noqa: D403 (a symbol keeps its case)
"""Driving a unicycle to a pose by the polar coordinates of the goal.

Sources: Siegwart, Nourbakhsh, Scaramuzza 2011, Introduction to Autonomous Mobile Robots, sec. 3.6.2;
Aicardi, Casalino, Bicchi, Balestrino 1995, Closed loop steering of unicycle-like vehicles.
"""

from coplanar.engine import PI, absolute, atan2, cos, hypot, minimum, sinc, where
from coplanar.laws.control import unicycle_step
from coplanar.laws.motion import arc
from coplanar.laws.se2 import wrap


def polar_coordinates(x, y, theta, gx, gy, gtheta):
    """rho to the goal, alpha its bearing from the heading, beta = heading of the goal - direction to it."""
    dx, dy = gx - x, gy - y
    towards = atan2(dy, dx)
    return hypot(dx, dy), wrap(towards - theta), wrap(gtheta - towards)


def polar_linear(rho, alpha, beta, k_rho, k_alpha, k_beta):
    """v = k_rho rho, omega = k_alpha alpha + k_beta beta.  [Siegwart 2011, eq. 3.52]"""
    return k_rho * rho, k_alpha * alpha + k_beta * beta


def polar_smooth(rho, alpha, beta, k_rho, k_alpha, k_beta):
    """v = g rho cos(alpha), omega = k alpha + g cos(alpha) sinc(alpha) (alpha - h beta).  [Aicardi 1995, eq. 8]

    Here g = k_rho, k = k_alpha, h = k_beta > 0, and the book's theta is -beta.
    """
    forward = cos(alpha)
    return k_rho * rho * forward, k_alpha * alpha + k_rho * forward * sinc(alpha) * (alpha - k_beta * beta)


def polar_linear_pull(k_rho, k_alpha, k_beta):
    """omega = k_alpha alpha + k_beta beta already: (k_alpha, k_beta)."""
    nothing = 0.0 * k_rho
    return k_alpha + nothing, k_beta + nothing


def polar_smooth_pull(k_rho, k_alpha, k_beta):
    """omega = (k + g) alpha - g h beta near the goal, of ``polar_smooth``."""
    return k_alpha + k_rho, -k_rho * k_beta


def polar_rates(k_rho, on_alpha, on_beta):
    """Damping and stiffness of s^2 + (on_alpha - k_rho) s - k_rho on_beta near the goal.  [Siegwart 2011, eq. 3.57]

    alphadot = k_rho alpha - omega, betadot = -k_rho alpha, omega = on_alpha alpha + on_beta beta.
    """
    return on_alpha - k_rho, -k_rho * on_beta


def polar_loop(h, k_rho, on_alpha, on_beta, lead):
    """Trace and determinant of a step of (alpha, beta) near the goal, for h k_rho < 1.

    The way left shrinks by 1 - f, f = h k_rho, and the direction to the goal turns as alpha/(1 - f); ``lead`` as in
    ``control.lateral_polynomial``.
    """
    f = h * k_rho
    q = 1.0 / where(f < 1.0, 1.0 - f, 1.0)
    m = 1.0 + lead * f * q
    trace = 1.0 + q - m * h * on_alpha + (m - 1.0) * h * on_beta
    return trace, q - m * h * on_alpha + (m - q) * h * on_beta


def polar_margin(h, k_rho, on_alpha, on_beta, lead):
    """Least of 1 - f, 1 - |det| and 1 + det - |trace|: above 0 where both roots are inside the unit circle."""
    trace, det = polar_loop(h, k_rho, on_alpha, on_beta, lead)
    return minimum(1.0 - h * k_rho, minimum(1.0 - absolute(det), 1.0 + det - absolute(trace)))


def polar_strong(k_rho, k_alpha, k_beta):
    """k_alpha + 5/3 k_beta - 2/pi k_rho: above 0 the robot keeps facing the goal.  [Siegwart 2011, eq. 3.62]"""
    return k_alpha + 5.0 / 3.0 * k_beta - 2.0 / PI * k_rho


def settled(rho, near, v, omega, theta, gtheta, k_alpha):
    """Within ``near`` of the goal only the heading is left: v = 0, omega = k_alpha (gtheta - theta)."""
    away = rho > near
    left = wrap(where(away, 0.0, gtheta - theta))  # in the sum below, where no comparison hides a NaN of it
    return where(away, v, 0.0), where(away, omega, 0.0) + k_alpha * left


def facing(x, y, theta, gx, gy, gtheta, sign):
    """``polar_coordinates`` of a robot that drives forward (sign = 1), or backward: robot and goal turned by pi."""
    flip = 0.5 * PI * (1.0 - sign)
    return polar_coordinates(x, y, theta + flip, gx, gy, gtheta + flip)


def drive_linear(x, y, theta, gx, gy, gtheta, sign, k_rho, k_alpha, k_beta, near):
    """[v, omega] by ``polar_linear`` until it has ``settled``; then rho, alpha and beta."""
    rho, alpha, beta = facing(x, y, theta, gx, gy, gtheta, sign)
    v, omega = polar_linear(rho, alpha, beta, k_rho, k_alpha, k_beta)
    v, omega = settled(rho, near, sign * v, omega, theta, gtheta, k_alpha)
    return v, omega, rho, alpha, beta


def drive_smooth(x, y, theta, gx, gy, gtheta, sign, k_rho, k_alpha, k_beta, near):
    """[v, omega] by ``polar_smooth`` until it has ``settled``; then rho, alpha and beta."""
    rho, alpha, beta = facing(x, y, theta, gx, gy, gtheta, sign)
    v, omega = polar_smooth(rho, alpha, beta, k_rho, k_alpha, k_beta)
    v, omega = settled(rho, near, sign * v, omega, theta, gtheta, k_alpha)
    return v, omega, rho, alpha, beta


def linear_step(
    x, y, theta, v, omega, rho, alpha, beta, h, gx, gy, gtheta, sign, k_rho, k_alpha, k_beta, near,
    at_start, at_middle, at_end,
):  # fmt: skip
    """``drive_linear``, then ``control.unicycle_step``: one turn of the closed loop."""
    v, omega, rho, alpha, beta = drive_linear(x, y, theta, gx, gy, gtheta, sign, k_rho, k_alpha, k_beta, near)
    x, y, theta = unicycle_step(x, y, theta, v, omega, h, at_start, at_middle, at_end)
    return x, y, theta, v, omega, rho, alpha, beta


def linear_arc(
    x, y, theta, v, omega, rho, alpha, beta, h, gx, gy, gtheta, sign, k_rho, k_alpha, k_beta, near
):  # fmt: skip
    """``drive_linear``, then the arc of the held command: one turn of the closed loop."""
    v, omega, rho, alpha, beta = drive_linear(x, y, theta, gx, gy, gtheta, sign, k_rho, k_alpha, k_beta, near)
    x, y, theta = arc(x, y, theta, v, omega, h)
    return x, y, theta, v, omega, rho, alpha, beta


def smooth_step(
    x, y, theta, v, omega, rho, alpha, beta, h, gx, gy, gtheta, sign, k_rho, k_alpha, k_beta, near,
    at_start, at_middle, at_end,
):  # fmt: skip
    """``drive_smooth``, then ``control.unicycle_step``: one turn of the closed loop."""
    v, omega, rho, alpha, beta = drive_smooth(x, y, theta, gx, gy, gtheta, sign, k_rho, k_alpha, k_beta, near)
    x, y, theta = unicycle_step(x, y, theta, v, omega, h, at_start, at_middle, at_end)
    return x, y, theta, v, omega, rho, alpha, beta


def smooth_arc(
    x, y, theta, v, omega, rho, alpha, beta, h, gx, gy, gtheta, sign, k_rho, k_alpha, k_beta, near
):  # fmt: skip
    """``drive_smooth``, then the arc of the held command: one turn of the closed loop."""
    v, omega, rho, alpha, beta = drive_smooth(x, y, theta, gx, gy, gtheta, sign, k_rho, k_alpha, k_beta, near)
    x, y, theta = arc(x, y, theta, v, omega, h)
    return x, y, theta, v, omega, rho, alpha, beta
