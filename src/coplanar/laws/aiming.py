"""The launches at a speed that go farthest along a line of sight, and those that reach a place on it.

In the launch's own frame: the origin at the launch point, the target ahead at the end of the line of sight of direction
(slope_c, slope_s), slope_c > 0, under gravity. A launch is given by its angle z from the zenith, so that the lofted arc
of a near target keeps its digits; Z is that angle of the line. Each search runs on the angle and on the hodograph's
parameter at the end of the flight at once: Newton for where the path is on the line again, and for the range there.

First guesses are made from the flight without drag, of which the drag shifts the best angle and turns the path further.
"""

from coplanar.engine import (
    Integral,
    Search,
    absolute,
    asinh,
    atan2,
    exp,
    expm1,
    log1p,
    maximum,
    minimum,
    sincos,
    sqrt,
    where,
)
from coplanar.laws.flight import PANEL, hodograph, lean, scales, sides, theta_of_turn

ROUGH, FAIR = 0.12, 0.3  # shares of a panel's nodes: the flight to about 1e-5 and 1e-8
MIDDLING, SMALL = 0.03, 1e-3  # steps after which these are too few
FINE = 1e-6  # last step of an angle, over the way to the end of its sector, and of theta; what is left is its square
ASIDE = 0.1  # of a step, by which a flight may end beside the line to count for the next secant
SHARP = 10.0  # times as fine: the range at the best angle comes from a secant as rough as this step
ASTRAY = 1e-9  # part of the distance by which a launch that was found may miss; it misses by about 1e-14
ROOM = 0.1  # part of the way to the end of its sector that a step of an angle leaves
LONGEST = 1.0  # longest step in theta
TINIEST = 1e-300  # in quotients that may be 0/0 where nothing is left to do


def aim_rates(theta, c, A, B, K, G, W):
    """Rates of t, x/cos(psi0), y, and their derivatives by psi0 at a constant q (of x itself)."""
    step, cosh_s, sinh_s, slow, turned, lifted, slowed = lean(expm1(theta), c, A, B, K, G, W)
    root = sqrt(slow)
    way, twice = step * slow, turned - cosh_s * slowed
    return (
        step * cosh_s * root,
        way * cosh_s,
        way * cosh_s * sinh_s,
        step * root * (turned - 0.5 * cosh_s * slowed),
        way * (c * twice - 0.5 * (A - B) * cosh_s),
        way * (lifted * cosh_s + sinh_s * twice),
    )


aimed = Integral(aim_rates)


def flight_span(theta, share, c, A, B, K, G, W):
    """The integral over the whole flight, on a share of the panels while no more is needed."""
    return share * theta / PANEL, 0.0 * theta, theta, c, A, B, K, G, W


def return_to_line(theta, c, A, B, K, G, W, unit, length, slope_c, slope_s, t, x, y, t_psi, x_psi, y_psi):
    """The step in theta to the line, time and range there, and how theta, time and range go with the angle z."""
    q = expm1(theta)
    _, back, cosh_s, sinh_s, n, _ = hodograph(q, A, B, K, G, W)
    step, slow = (1.0 + q) * back * cosh_s, 1.0 / n
    way = step * slow
    x, x_rate, y_rate = c * x, c * way, way * sinh_s
    down = slope_c * y_rate - slope_s * x_rate
    along, t_rate = slope_c * x_rate + slope_s * y_rate, step * sqrt(slow)
    further = (slope_s * x - slope_c * y) / down
    by_z = (slope_c * y_psi - slope_s * x_psi) / down  # z falls as psi rises
    return (
        further,
        unit * (t + t_rate * further),
        length * (slope_c * x + slope_s * y + along * further),
        by_z,
        unit * (t_rate * by_z - t_psi),
        length * (along * by_z - slope_c * x_psi - slope_s * y_psi),
    )


def launch_sides(z):
    """Cosine of a launch at the angle z from the zenith, and A = 1 + sin psi0, B = 1 - sin psi0."""
    c, s = sincos(z)
    A, B = sides(c, s)
    return c, A, B


def free_turning(z, slope_c, slope_s):
    """Without drag, log(m) of the flight along a line: asinh(cot z) + asinh(cot z - 2 cot Z)."""
    s, c = sincos(z)
    cot = c / s
    return asinh(cot) + asinh(cot - 2.0 * slope_s / slope_c)


def theta_of_turning(turning, v0, k, g):
    """The parameter of a turn m = exp(turning)."""
    return theta_of_turn(exp(minimum(turning, 300.0)), v0, k, g)


def drag_strength(v0, k, g):
    """log(1 + k v0^2/g): the one number on which best angles depend, apart from the line."""
    return log1p(k * v0 * v0 / g)


def best_zenith(zenith, slope_s, strength):
    """The best angle, to about a hundredth of the line's: half of it without drag, more towards a line that goes up."""
    return zenith * (0.5 + strength / (1.0 + 0.1 * strength) * (0.071 + slope_s * (0.04 - 0.027 * slope_s)))


def best_curve(slope_s, strength):
    """How sharp the best angle is, -(1 - cos Z) d^2R/dz^2/R, nearly: 4 without drag."""
    low = 0.5 * (1.0 - slope_s)
    return 4.0 * (1.0 - (0.2 + low * (0.2 + 0.6 * low)) * strength / (1.0 + (0.77 + 0.2 * low) * strength))


def best_turning(slope_c, slope_s, strength):
    """How much more the path of the best launch turns than without drag, to some hundredths."""
    steep = 0.06 * strength / (1.0 + 0.1 * strength) - 0.18
    return 1.0 + strength * (0.17 + 0.15 / slope_c + slope_s * steep)


def within(step, lower, upper):
    """A step that leaves ``ROOM`` before the ends of its sector, which are at these steps."""
    return minimum(maximum(step, (1.0 - ROOM) * lower), (1.0 - ROOM) * upper)


def share_of(turn, onward):
    """The share of a panel's nodes that the next integral is worth after these steps, each over its scale."""
    size = absolute(turn) + absolute(onward)
    return where(size < SMALL, 1.0, where(size < MIDDLING, FAIR, ROUGH))


def unsettled(turn, onward, share):
    """Whether a search on angle and theta goes on after these steps, each over its scale: 1 or 0."""
    return where((absolute(turn) > FINE) | (absolute(onward) > FINE) | (share < 1.0), 1.0, 0.0)


def farthest_begin(v0, slope_c, slope_s, k, g):
    """A row (z, theta, cos psi0, A, B, the last z, dR/dz there, time, range) and what stays."""
    zenith = atan2(slope_c, slope_s)
    strength = drag_strength(v0, k, g)
    z = best_zenith(zenith, slope_s, strength)
    theta = theta_of_turning(free_turning(z, slope_c, slope_s) * best_turning(slope_c, slope_s, strength), v0, k, g)
    a, K, G, W = scales(v0, k, g)
    curve = best_curve(slope_s, strength) / sector(slope_c, slope_s)
    start = 0.0 * v0
    row = z, theta, ROUGH + start, *launch_sides(z), z, start, start, start
    return *row, K, G, W, v0 / a, v0 * v0 / a, slope_c, slope_s, zenith, curve


def sector(slope_c, slope_s):
    """1 - cos Z of a line of sight, which is slope_c^2/(1 + slope_s) where it goes up."""
    large = 1.0 + absolute(slope_s)
    return where(slope_s > 0.0, slope_c * slope_c / large, large)


def farthest_span(
    z, theta, share, c, A, B, z_1, f_1, time, far, K, G, W, unit, length, slope_c, slope_s, zenith, curve
):
    """The whole flight."""
    return flight_span(theta, share, c, A, B, K, G, W)


def farthest_improve(
    z, theta, share, c, A, B, z_1, f_1, time, far, K, G, W, unit, length, slope_c, slope_s, zenith, curve,
    t, x, y, t_psi, x_psi, y_psi,
):  # fmt: skip
    """A secant to the angle where the range goes with it no more; the first one by the curve of a flight like it."""
    further, time, far, by_z, t_z, far_z = return_to_line(
        theta, c, A, B, K, G, W, unit, length, slope_c, slope_s, t, x, y, t_psi, x_psi, y_psi
    )
    gap, like = z - z_1, -curve * far
    first = gap == 0.0
    slope = where(first, like, (far_z - f_1) / where(first, 1.0, gap))
    near = absolute(further) < MIDDLING
    step = within(where(near, -far_z / minimum(slope, 0.3 * like), 0.0), -z, zenith - z)
    onward = within(further + by_z * step, -minimum(theta, LONGEST), LONGEST)
    short = minimum(theta, 1.0)
    going = unsettled(SHARP * step / zenith, further / short, share)
    there = z + step
    aside = absolute(further) >= ASIDE * absolute(step)  # no secant from a flight that ends beside the line
    before = where(aside, there, z)
    row = there, theta + onward, share_of(step / zenith, onward / short), *launch_sides(there), before, far_z
    return going, *row, time + t_z * step, far + 0.5 * far_z * step


def farthest_finish(
    going, z, theta, share, c, A, B, z_1, f_1, time, far, K, G, W, unit, length, slope_c, slope_s, zenith, curve
):
    """The best angle from the zenith, the range, theta and the time at its end, and whether it was found: 1 or 0."""
    return z, far, theta, time, 1.0 - going


farthest = Search(farthest_begin, farthest_span, aimed, farthest_improve, farthest_finish, rounds=24)


def arc_guess(zenith, best, most, free, distance, slope_c, slope_s, side):
    """The angle of an arc (low where side is 1, high where -1) and its part of the best path's extra turning, nearly.

    Without drag R/R_max = (cos(2 z - Z) - cos Z)/(1 - cos Z). With it the sectors beside the best angle are stretched:
    at the line as the range is short of that without drag, and towards the zenith evenly.
    """
    ratio, wide = distance / most, sector(slope_c, slope_s)
    part = 0.5 - atan2(sqrt(wide * (1.0 - ratio)), sqrt(1.0 + slope_s + ratio * wide)) / zenith
    low = side > 0.0
    edge = where(low, zenith - best, best) / zenith
    first = where(low, minimum(most / free, 1.0), 1.0 + 0.6 * (2.0 * edge - 1.0))
    away = zenith * part * (first + 2.0 * part * (2.0 * edge - first))
    return where(low, zenith - away, away), where(low, 4.0 * part * (1.0 - part), 0.15 + 1.7 * part)


def arc_begin(v0, slope_c, slope_s, k, g, distance, best, most, best_theta, side):
    """A row (z, theta, cos psi0, A, B, time) and what stays."""
    zenith = atan2(slope_c, slope_s)
    a, K, G, W = scales(v0, k, g)
    free = v0 * v0 / (g * maximum(1.0 + slope_s, TINIEST))
    z, share = arc_guess(zenith, best, most, free, distance, slope_c, slope_s, side)
    more = log1p(G * expm1(best_theta)) / free_turning(best, slope_c, slope_s) - 1.0
    theta = theta_of_turning(free_turning(z, slope_c, slope_s) * (1.0 + more * share), v0, k, g)
    ends = best, where(side > 0.0, zenith, 0.0)
    row = z, theta, ROUGH + 0.0 * v0, *launch_sides(z), 0.0 * v0
    return *row, K, G, W, v0 / a, v0 * v0 / a, slope_c, slope_s, distance, most, side, *ends


def arc_span(z, theta, share, c, A, B, time, K, G, W, unit, length, slope_c, slope_s, distance, most, side, best, edge):
    """The whole flight."""
    return flight_span(theta, share, c, A, B, K, G, W)


def arc_improve(
    z, theta, share, c, A, B, time, K, G, W, unit, length, slope_c, slope_s, distance, most, side, best, edge,
    t, x, y, t_psi, x_psi, y_psi,
):  # fmt: skip
    """Newton to the range, on the root of what is missing to the greatest one: near that the arcs merge like it."""
    further, time, far, by_z, t_z, far_z = return_to_line(
        theta, c, A, B, K, G, W, unit, length, slope_c, slope_s, t, x, y, t_psi, x_psi, y_psi
    )
    gap, root = sqrt(most - distance), sqrt(most - far)
    slope = side * far_z * (root + gap)
    falls = (slope < 0.0) & ((root > 0.0) | (gap <= 0.0))
    newton = 2.0 * root * (distance - far) / where(falls, slope, -1.0)
    ahead, behind = side * (edge - z), side * (best - z)
    step = side * within(where(falls, newton, ROOM * ahead), behind, ahead)
    onward = within(further + by_z * step, -minimum(theta, LONGEST), LONGEST)
    there = z + step
    turn, part = step / ahead, onward / minimum(theta, 1.0)
    row = there, theta + onward, share_of(turn, part), *launch_sides(there)
    astray = absolute(far + far_z * step - distance) > ASTRAY * distance
    return where(astray, 1.0, unsettled(turn, part, share)), *row, time + t_z * step


def arc_finish(
    going, z, theta, share, c, A, B, time, K, G, W, unit, length, slope_c, slope_s, distance, most, side, best, edge
):
    """The angle from the zenith, the time to the place, and whether they were found: 1 or 0."""
    return z, time, 1.0 - going


arc = Search(arc_begin, arc_span, aimed, arc_improve, arc_finish, rounds=24)
