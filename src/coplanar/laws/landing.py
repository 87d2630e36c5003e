"""Where a shot comes down on a line: the laws of a search along the hodograph's integral.

In the launch's own frame (origin at (x_0, y_0), x the way it goes, which is to ``side``) the line has the direction
(slope_c, slope_s), slope_c >= 0, and the launch point stands ``height`` above it along its normal. The search goes up
to where the path is farthest above the line, and from there down: to where the way left would be fallen at the mean
acceleration to come, the path turning as it does without drag in a time that drag makes a little longer. What is left
is of the third order of the step, and what is integrated is only the way from one guess to the next.

A row is (theta, upper, t, x, y) and then what stays: (top, end, v0, c, A, B, k, g, a, K, G, W, slope_c, slope_s,
height, x_0, y_0, side).
"""

from coplanar.engine import Search, absolute, expm1, hypot, log1p, maximum, minimum, sincos, sqrt, where
from coplanar.laws.flight import (
    PANEL,
    ballistic_bend,
    coast,
    distance,
    drag_rates,
    hodograph,
    last_turn,
    parallel_turn,
    scales,
    sides,
    theta_of_turn,
)

LAST = 690.0  # theta without an end: exp of it is still a number
NEAR = 1e-5  # last step in theta, over the way since the top; the rest is coasted, which errs by its third power
BACK = -0.9  # of exp(theta): the longest step back
LIGHTER = 0.8  # part of an acceleration that its fall may take off
SLOWEST = 1e-30  # [m/s] in a quotient, so that nothing left to fall takes no time
TOUCHING = 1e-13  # a wall is reached when this part of the way to it is left


def landing_begin(x_0, y_0, vx, vy, k, g, line_x, line_y, line_c, line_s):
    """From the launch towards the top of the path above the line, one panel at the most."""
    side, v0 = where(vx < 0.0, -1.0, 1.0), hypot(vx, vy)
    c, s, slope_s = absolute(vx) / v0, vy / v0, side * line_s
    height = line_c * (y_0 - line_y) - line_s * (x_0 - line_x)
    A, B = sides(c, s)
    top = theta_of_turn(parallel_turn(c, s, line_c, slope_s), v0, k, g)
    end = where(g > 0.0, maximum(top, theta_of_turn(last_turn(v0, c, s, k, g), v0, k, g)), LAST)
    start = 0.0 * v0
    row = start, minimum(top, PANEL), start, start, start
    return *row, top, end, v0, c, A, B, k, g, *scales(v0, k, g), line_c, slope_s, height, x_0, y_0, side


def landing_span(
    theta, upper, t, x, y, top, end, v0, c, A, B, k, g, a, K, G, W, slope_c, slope_s, height, x_0, y_0, side
):
    """The rates of travel from one guess to the next."""
    return absolute(upper - theta) / PANEL, theta, upper, A, B, K, G, W


def approach(theta, x, y, v0, c, A, B, k, g, K, G, W, slope_c, slope_s, height):
    """At theta: speed, velocity, height over a line, and speed, acceleration and jerk towards the line."""
    _, _, cosh_s, sinh_s, n, _ = hodograph(expm1(theta), A, B, K, G, W)
    u = v0 / sqrt(n)
    v, vx, vy = u * cosh_s, u * c, u * sinh_s
    ax, ay = drag_rates(vx, vy, k, g)
    above = height + slope_c * y - slope_s * x
    towards, pull = slope_s * vx - slope_c * vy, slope_s * ax - slope_c * ay
    return v, vx, vy, above, towards, pull, -k * ((vx * ax + vy * ay) / v * towards + v * pull)


def landing_time(above, towards, pull, jerk):
    """Time to come down to a line: h = w t + a t^2/2 by 2 h/(w + sqrt(w^2 + 2 a h)), with the mean a of that time."""
    w = maximum(towards, 0.0)
    time = 2.0 * above / maximum(w + sqrt(w * w + 2.0 * pull * above), SLOWEST)
    mean = pull + maximum(jerk * time * (1.0 / 3.0), -LIGHTER * absolute(pull))
    return 2.0 * above / maximum(w + sqrt(w * w + 2.0 * mean * above), SLOWEST)


def never(theta, above, towards, top, g):
    """Whether the path stays below the line, or goes away from it without gravity: 1 or 0."""
    return where((theta <= top) & (above < 0.0) | (g <= 0.0) & (towards <= 0.0), 1.0, 0.0)


def theta_after(theta, time, v, A, B, g, a, G):
    """The parameter after a time without drag from theta on, where the speed is v."""
    grown = expm1(theta)
    m = 1.0 + G * grown
    up, down = A / m, B * m
    half = 0.5 * (up + down)
    bend = m * ballistic_bend(time, v, up / half, down / half, g)
    return theta + log1p(maximum(a * bend / (1.0 + grown), BACK))


def landing_improve(
    theta, upper, t, x, y, top, end, v0, c, A, B, k, g, a, K, G, W, slope_c, slope_s, height, x_0, y_0, side,
    more_t, more_x, more_y,
):  # fmt: skip
    """The state at the end of the integral, and the next guess; it goes on while that is another step away."""
    unit = v0 / a
    t, x, y = t + unit * more_t, x + unit * v0 * c * more_x, y + unit * v0 * more_y
    v, _, _, above, towards, pull, jerk = approach(upper, x, y, v0, c, A, B, k, g, K, G, W, slope_c, slope_s, height)
    time = (1.0 - never(upper, above, towards, top, g)) * landing_time(above, towards, pull, jerk)
    further = theta_after(upper, time * (1.0 + 0.5 * k * v * time), v, A, B, g, a, G)
    ahead = minimum(maximum(further, top), where(upper < top, top, end)) - upper
    step = minimum(maximum(ahead, -PANEL), PANEL)
    going = where((upper < top) | (absolute(step) > NEAR * minimum(1.0, upper - top)), 1.0, 0.0)
    return going, upper, upper + step, t, x, y


def landing_finish(
    going, theta, upper, t, x, y, top, end, v0, c, A, B, k, g, a, K, G, W, slope_c, slope_s, height, x_0, y_0, side
):
    """The parameter, time, place and velocity on the line, or nearest to it, 0 where it is reached, 1 where not."""
    _, vx, vy, above, towards, pull, _ = approach(theta, x, y, v0, c, A, B, k, g, K, G, W, slope_c, slope_s, height)
    none = never(theta, above, towards, top, g)
    time = (1.0 - none) * landing_time(above, towards, pull, 0.0)
    way_x, way_y, _, _ = coast(time, vx, vy, k, g)
    short = (slope_c <= 0.0) & (height - slope_s * (x + way_x) > TOUCHING * height)
    reached = where(short, 0.0, 1.0 - none)
    _, _, _, sinh_s, n, _ = hodograph(expm1(upper), A, B, K, G, W)
    u = v0 / sqrt(n)
    x, y = x + reached * way_x, y + reached * way_y
    return upper, t + reached * time, x_0 + side * x, y_0 + y, side * u * c, u * sinh_s, 1.0 - reached


landing = Search(landing_begin, landing_span, distance, landing_improve, landing_finish)


def launch_velocity(v0, psi):
    """Velocity v0 (cos psi, sin psi)."""
    s, c = sincos(psi)
    return v0 * c, v0 * s
