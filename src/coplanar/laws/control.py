# ruff: noqa: D403 (a symbol keeps its case)
"""Driving a unicycle by feedback: a point fixed on it follows a reference, within what the motors allow.

The robot stands at (x, y, theta), is driven by (v, omega), and P = C + R(theta) p is a point fixed on it.
A loop samples every h seconds; z is its shift by one sample. g = h V/|px| is how far the robot turns in one
sample, per radian of misalignment, when its reference moves at speed V.

Sources: Yun and Yamamoto 1992, On feedback linearization of mobile robots (point P); Jury 1964, Theory and
Application of the z-Transform Method.
"""

from coplanar.engine import absolute, copysign, maximum, minimum, sincos, sqrt, where
from coplanar.laws.motion import arc, euler
from coplanar.laws.se2 import act, rotate
from coplanar.laws.wheels import clipped, differential_forward, differential_inverse


def unicycle_step(x, y, theta, v, omega, h, at_start, at_middle, at_end):
    """(x, y) + h v sum of w_i (cos, sin)(theta + c_i h omega) at c = 0, 1/2, 1; theta + h omega.

    The heading turns evenly while the command is held, so that a Runge-Kutta method with nodes 0, 1/2 and 1 is the
    quadrature rule of its weights: Euler (1, 0, 0), midpoint (0, 1, 0), Heun (1/2, 0, 1/2), classical (1, 4, 1)/6.
    """
    turn, way = h * omega, h * v
    s0, c0 = sincos(theta)
    s1, c1 = sincos(theta + 0.5 * turn)
    s2, c2 = sincos(theta + turn)
    forward = at_start * c0 + at_middle * c1 + at_end * c2
    sideways = at_start * s0 + at_middle * s1 + at_end * s2
    return x + way * forward, y + way * sideways, theta + turn


def center_under(point_x, point_y, theta, px, py):
    """C = P - R(theta) p."""
    dx, dy = rotate(theta, px, py)
    return point_x - dx, point_y - dy


def point_velocity(theta, px, py, v, omega):
    """Pdot = A [v, omega], A = [[c, -(px s + py c)], [s, px c - py s]], det A = px."""
    s, c = sincos(theta)
    return c * v - (px * s + py * c) * omega, s * v + (px * c - py * s) * omega


def point_command(theta, px, py, wx, wy):
    """[v, omega] = A^-1 w, A^-1 = [[c - (py/px) s, s + (py/px) c], [-s/px, c/px]].

    By 1/px, whose division waits for nothing else in a step.
    """
    s, c = sincos(theta)
    omega = (c * wy - s * wx) * (1.0 / px)
    return c * wx + s * wy + py * omega, omega


def feedback(e, last, total, rate, kp, kd, ki, h):
    """w = kp e + kd edot + ki int e + refdot, edot the backward difference (e - last)/h.

    By 1/h, which a loop over robots takes once a step for all of them.
    """
    return kp * e + kd * ((e - last) * (1.0 / h)) + ki * total + rate


def track_point(x, y, theta, rx, ry, fx, fy, last_x, last_y, sum_x, sum_y, px, py, kp, kd, ki, h):
    """[v, omega] = A^-1 (kp e + kd edot + ki int e + refdot), e = r - P; then e and its integral."""
    point_x, point_y = act(x, y, theta, px, py)
    ex, ey = rx - point_x, ry - point_y
    total_x, total_y = sum_x + h * ex, sum_y + h * ey
    wx = feedback(ex, last_x, total_x, fx, kp, kd, ki, h)
    wy = feedback(ey, last_y, total_y, fy, kp, kd, ki, h)
    v, omega = point_command(theta, px, py, wx, wy)
    return v, omega, ex, ey, total_x, total_y


def tracking_euler(x, y, theta, v, omega, last_x, last_y, sum_x, sum_y, rx, ry, fx, fy, h, px, py, kp, kd, ki):
    """``track_point``, then an Euler step: one turn of the closed loop."""
    v, omega, ex, ey, sum_x, sum_y = track_point(
        x, y, theta, rx, ry, fx, fy, last_x, last_y, sum_x, sum_y, px, py, kp, kd, ki, h
    )
    x, y, theta = euler(x, y, theta, v, omega, h)
    return x, y, theta, v, omega, ex, ey, sum_x, sum_y


def tracking_step(
    x, y, theta, v, omega, last_x, last_y, sum_x, sum_y, rx, ry, fx, fy, h, px, py, kp, kd, ki,
    at_start, at_middle, at_end,
):  # fmt: skip
    """``track_point``, then ``unicycle_step``: one turn of the closed loop."""
    v, omega, ex, ey, sum_x, sum_y = track_point(
        x, y, theta, rx, ry, fx, fy, last_x, last_y, sum_x, sum_y, px, py, kp, kd, ki, h
    )
    x, y, theta = unicycle_step(x, y, theta, v, omega, h, at_start, at_middle, at_end)
    return x, y, theta, v, omega, ex, ey, sum_x, sum_y


def tracking_arc(x, y, theta, v, omega, last_x, last_y, sum_x, sum_y, rx, ry, fx, fy, h, px, py, kp, kd, ki):
    """``track_point``, then the arc of the held command: one turn of the closed loop."""
    v, omega, ex, ey, sum_x, sum_y = track_point(
        x, y, theta, rx, ry, fx, fy, last_x, last_y, sum_x, sum_y, px, py, kp, kd, ki, h
    )
    x, y, theta = arc(x, y, theta, v, omega, h)
    return x, y, theta, v, omega, ex, ey, sum_x, sum_y


def pd_poles(h, kp, kd):
    """Roots of z^2 - (1 - h kp - kd) z - kd, as (Re z1, Im z1, Re z2, Im z2), the larger real one first."""
    middle = 0.5 * (1.0 - h * kp - kd)
    square = middle * middle + kd
    spread = sqrt(square)
    far = middle + copysign(spread, middle)
    near = where(far == 0.0, 0.0, -kd / where(far == 0.0, 1.0, far))
    real = square >= 0.0
    turn = sqrt(-square)
    high = where(real, maximum(far, near), middle)
    return high, turn, where(real, minimum(far, near), middle), -turn


def pid_polynomial(h, kp, kd, ki):
    """(z - m)(z^2 - (1 - h kp - kd) z - kd) + h^2 ki z^2, highest power first, m = 1 if ki > 0 and 0 otherwise."""
    memory = where(ki > 0.0, 1.0, 0.0)
    middle = 1.0 - h * kp - kd
    return 1.0 + 0.0 * middle, h * h * ki - middle - memory, memory * middle - kd, memory * kd


def lateral_polynomial(h, kp, kd, ki, g, lead):
    """The loop across a straight reference: heading and error together, highest power first.

    (z - m)(z (z - 1)(z - 1 + g) + (h kp z + kd (z - 1)) B) + h^2 ki z^2 B,  B = (1 + lead g)(z - 1) + g;
    m as in ``pid_polynomial``; lead = half the weight at_middle plus that at_end of ``unicycle_step``: 0 for Euler,
    1/2 from order 2 on.
    """
    memory = where(ki > 0.0, 1.0, 0.0)
    slope, drop = 1.0 + lead * g, 1.0 + lead * g - g
    gain, pull = h * kp + kd, h * h * ki
    a2 = gain * slope + g - 2.0
    a1 = 1.0 - g - gain * drop - kd * slope
    a0 = kd * drop
    return 1.0 + 0.0 * a2, a2 - memory + pull * slope, a1 - memory * a2 - pull * drop, a0 - memory * a1, -memory * a0


def schur_cohn(a1, a2, a3, a4):
    """Least 1 - |k| over the reflection coefficients of z^4 + a1 z^3 + a2 z^2 + a3 z + a4.  [Jury 1964]

    Above 0 if and only if all four roots are inside the unit circle.
    """
    rest = 1.0 - a4 * a4
    scale = where(rest > 0.0, rest, 1.0)
    b1, b2, b3 = (a1 - a4 * a3) / scale, (a2 - a4 * a2) / scale, (a3 - a4 * a1) / scale
    rest = 1.0 - b3 * b3
    scale = where(rest > 0.0, rest, 1.0)
    c1, c2 = (b1 - b3 * b2) / scale, (b2 - b3 * b1) / scale
    d1 = c1 / where(c2 > -1.0, 1.0 + c2, 1.0)
    largest = maximum(maximum(absolute(a4), absolute(b3)), maximum(absolute(c2), absolute(d1)))
    return 1.0 - largest


def lateral_margin(h, kp, kd, ki, speed, px, lead):
    """``schur_cohn`` of ``lateral_polynomial``: above 0 where the loop across a moving reference is stable."""
    one, a1, a2, a3, a4 = lateral_polynomial(h, kp, kd, ki, turn_per_step(h, speed, px), lead)
    return schur_cohn(a1 / one, a2 / one, a3 / one, a4 / one)


def gain_sum(h, kp, kd, ki):
    """h kp + 2 kd + h^2 ki/2: below 2 where no pole has passed -1.  [Jury 1964]"""
    return h * kp + 2.0 * kd + 0.5 * h * h * ki


def largest_step(kp, kd, ki):
    """The step at which gain_sum = 2, or at which the integral outruns a negative kd; 0 unless |kd| < 1."""
    room = 1.0 - kd
    to_minus_one = 4.0 * room / (kp + sqrt(kp * kp + 4.0 * ki * room))
    outrun = -kd * ki
    around = where(outrun > 0.0, (1.0 + kd) * kp / where(outrun > 0.0, outrun, 1.0), to_minus_one)
    return where(absolute(kd) < 1.0, minimum(to_minus_one, around), 0.0)


def turn_rate(e, kp, px):
    """|omega| = kp |e|/|px|: the turn rate that an error e across the robot asks for."""
    return kp * absolute(e) / absolute(px)


def turn_per_step(h, speed, px):
    """g = h V/|px|."""
    return h * absolute(speed) / absolute(px)


def scaled(v, omega, v_max, omega_max):
    """(v, omega) divided by whichever limit is exceeded most: the curvature omega/v stays."""
    excess = maximum(1.0, maximum(absolute(v) / v_max, absolute(omega) / omega_max))
    return v / excess, omega / excess


def rims_scaled(v, omega, half_track, rim_max):
    """(v, omega) divided by the excess of the faster rim: the curvature stays."""
    excess = maximum(1.0, (absolute(v) + half_track * absolute(omega)) / rim_max)
    return v / excess, omega / excess


def rims_clipped(v, omega, half_track, rim_max):
    """Each rim clipped by itself: the path changes."""
    left, right = differential_inverse(v, omega, 1.0, 1.0, half_track)
    return differential_forward(clipped(left, rim_max), clipped(right, rim_max), 1.0, 1.0, half_track)


def rims_keeping_omega(v, omega, half_track, rim_max):
    """omega first, v what the rims have left."""
    turn = clipped(omega, rim_max / half_track)
    return clipped(v, maximum(rim_max - half_track * absolute(turn), 0.0)), turn


def slewed(u, last, rate_max, h):
    """u no further from the last command than rate_max h."""
    return last + clipped(u - last, rate_max * h)
