"""Serial arms in the plane: links, Jacobian columns, the two-link inverse, whole turns, rates and torques.

Angles are counterclockwise from the x axis unless a law says "relative"; every length is positive. The two-link
inverse works on the half angle, tan^2(q2/2) = a^2/b^2 with a^2 = L^2 - r^2, b^2 = r^2 - D^2, L = l1 + l2, D = l1 - l2,
and tan q2 = 2 a b/(b^2 - a^2): next to the base of an equal-link arm the textbook cosine (r^2 - l1^2 - l2^2)/(2 l1 l2)
leaves 1e-8 of the links' length in the tip, these squares a rounding.

Sources: Lynch and Park 2017, Modern Robotics, ch. 4-6; Siciliano et al. 2009, Robotics, sec. 2.12 and 3.1-3.5;
Nakamura and Hanafusa 1986 (damped rates).
"""

from coplanar.engine import PI, TAU, absolute, atan2, floor, hypot, maximum, minimum, nearest, sincos, sqrt, where
from coplanar.laws.se2 import wrap


def link(x, y, angle, length):
    """Q = P + l [cos phi, sin phi]."""
    s, c = sincos(angle)
    return x + length * c, y + length * s


def joint_link(x, y, angle, q, carry, turns, bend, length, slides):
    """The next link's end and direction: phi = carry phi_before + turns q + bend, P += (l + slides q) [cos, sin].

    carry is 1, or 0 for an absolute angle; turns and slides are 1 and 0 at a revolute joint, 0 and 1 at a prismatic.
    """
    phi = carry * angle + turns * q + bend
    px, py = link(x, y, phi, length + slides * q)
    return px, py, phi


def link_velocity(vx, vy, angle, rate, length, length_rate):
    """Qdot = Pdot + l phidot [-sin phi, cos phi] + ldot [cos phi, sin phi]."""
    s, c = sincos(angle)
    return vx + length_rate * c - length * rate * s, vy + length_rate * s + length * rate * c


def two_link(q1, q2, l1, l2):
    """Q = l1 [cos q1, sin q1] + l2 [cos(q1 + q2), sin(q1 + q2)], q2 relative to the first link."""
    x, y = link(0.0, 0.0, q1, l1)
    return link(x, y, q1 + q2, l2)


def revolute_column(px, py, ex, ey):
    """Lever z x (E - P): how a point E moves for a radian of a joint at P; of velocities, the rate of that column."""
    return py - ey, ex - px


def prismatic_column(angle):
    """[cos phi, sin phi]: how the tip moves for each metre that a link along phi extends."""
    s, c = sincos(angle)
    return c, s


def prismatic_column_rate(angle, rate):
    """d/dt [cos phi, sin phi] = phidot [-sin phi, cos phi]."""
    s, c = sincos(angle)
    return -rate * s, rate * c


def elbow_squares(square, l1, l2):
    """Squares of the legs about the angle |q2|/2, a^2 = L^2 - r^2 and b^2 = r^2 - D^2, and a b, from r^2.

    L = l1 + l2 and D = l1 - l2. Beyond the reach a is 0 and inside the hole b is: q2 is 0 or pi there, so that a radius
    of more than 2 L is as good as 2 L, whose square is finite.
    """
    outer, inner = (l1 + l2) * (l1 + l2), (l1 - l2) * (l1 - l2)
    near = minimum(square, 4.0 * outer)
    opposite, adjacent = maximum(near, outer) - near, near - minimum(near, inner)
    return opposite, adjacent, sqrt(opposite * adjacent)


def two_link_triangle(x, y, l1, l2):
    """r^2, 2 l1 times the second link's reach along and across the first, r^2 + l1^2 - l2^2 and a b, and |q2|.

    Beyond the reach only the sign of the reach along the first link counts, and r^2 is held to the outer ring's.
    """
    outer = l1 + l2
    square = x * x + y * y
    opposite, adjacent, across = elbow_squares(square, l1, l2)
    along = minimum(square, outer * outer) + (l1 - l2) * outer
    return square, along, across, atan2(2.0 * across, adjacent - opposite)


def first_direction(x, y, k1, k2):
    """Direction of the first link, atan2(k1 y - k2 x, k1 x + k2 y); 0 where it is free."""
    sine, cosine = k1 * y - k2 * x, k1 * x + k2 * y
    free = (sine == 0.0) & (cosine == 0.0)
    return atan2(sine, where(free, 1.0, cosine))


def two_link_inverse(x, y, l1, l2, elbow):
    """Joints (q1, q2) with the tip at (x, y), q2 relative; elbow = +1 or -1 is the sign of sin q2.

    q2 = elbow atan2(2 a b, b^2 - a^2), q1 = atan2(k1 y - k2 x, k1 x + k2 y) with k1 = r^2 + l1^2 - l2^2 and
    k2 = elbow a b, which are 2 l1 times l1 + l2 cos q2 and l2 sin q2. Out of reach: the arm points at the target,
    stretched or folded. On the base q1 is free, and 0.
    """
    _, k1, k2, bend = two_link_triangle(x, y, l1, l2)
    return first_direction(x, y, k1, elbow * k2), elbow * bend


def two_link_turns(x, y, elbow, l1, l2, inner, tolerance, rest):
    """The two-link inverse with the first link at ``rest`` where it is free: the target is on its axis, and reached."""
    square, k1, k2, bend = two_link_triangle(x, y, l1, l2)
    r = sqrt(square)
    free = (r == 0.0) | ((r <= tolerance) & (inner - r <= tolerance))
    return where(free, rest, first_direction(x, y, k1, elbow * k2)), elbow * bend


def two_link_both(x, y, l1, l2, inner, outer, tolerance):
    """Both branches (q1 of the elbow +1, q1 of -1, |q2|), and the two-link reach: gap, how the target stands."""
    square, k1, k2, bend = two_link_triangle(x, y, l1, l2)
    r = sqrt(square)
    free = (r <= tolerance) & (inner - r <= tolerance)
    up, down = first_direction(x, y, k1, k2), first_direction(x, y, k1, -k2)
    return where(free, 0.0, up), where(free, 0.0, down), bend, *two_link_reach(x, y, inner, outer, tolerance)


def two_link_row(x, y, l1, l2, elbow, axis):
    """The target and its two-link inverse: x, y, q1, q2; q1, free where r^2 <= ``axis``, is 0 there."""
    square, k1, k2, bend = two_link_triangle(x, y, l1, l2)
    return x, y, where(square <= axis, 0.0, first_direction(x, y, k1, elbow * k2)), elbow * bend


def two_link_reach(x, y, inner, outer, tolerance):
    """Gap to the ring, and how the target stands: 0 reached, 1 and on the axis, 2 beyond the ring, 3 in its hole."""
    r = hypot(x, y)
    gap = radial_gap(r, inner, outer)
    return gap, where(gap <= tolerance, where(r <= tolerance, 1.0, 0.0), where(r > outer, 2.0, 3.0))


def elbow_sine(x, y, l1, l2):
    """|sin q2| = a b/(2 l1 l2) of the two-link inverse: 0 where its branches meet."""
    _, _, across = elbow_squares(x * x + y * y, l1, l2)
    return across / (2.0 * l1 * l2)


def two_link_rates(q1, q2, l1, l2, vx, vy):
    """Joint rates for a tip velocity: [c12 vx + s12 vy, -(x vx + y vy)/l2]/(l1 sin q2), x and y the tip."""
    x, y = two_link(q1, q2, l1, l2)
    s12, c12 = sincos(q1 + q2)
    s2, _ = sincos(q2)
    return (c12 * vx + s12 * vy) / (l1 * s2), -(x * vx + y * vy) / (l1 * l2 * s2)


def wrist(x, y, angle, along, across):
    """Where the last joint is: the tip less R(phi) (along, across)."""
    s, c = sincos(angle)
    return x - (c * along - s * across), y - (s * along + c * across)


def radial_gap(r, inner, outer):
    """Distance of a radius r from the interval [inner, outer]; 0 inside it."""
    return maximum(maximum(r - outer, inner - r), 0.0 * r)


def ring_gap(x, y, inner, outer):
    """Distance from (x, y) to the ring inner <= r <= outer about the origin; 0 on it."""
    return radial_gap(hypot(x, y), inner, outer)


def ring_nearest(x, y, inner, outer):
    """The point of the ring inner <= r <= outer nearest to (x, y); on the x axis for the origin."""
    r = hypot(x, y)
    apart = r > 0.0
    reach = where(r > outer, outer, where(r < inner, inner, r))
    inside, bottom = reach == r, where(apart, r, 1.0)  # x/r before its product with the reach, which may be large
    return where(inside, x, where(apart, reach * (x / bottom), reach)), where(inside, y, reach * (y / bottom))


def turn_near(angle, near):
    """The angle + 2 pi k with the k that comes nearest to ``near``."""
    return angle + TAU * nearest((near - angle) / TAU)


def turn_within(angle, near, lower, upper):
    """The angle + 2 pi k inside [lower, upper] and nearest to ``near``; where no k fits, the last one below upper."""
    least = -floor((angle - lower) / TAU)
    most = floor((upper - angle) / TAU)
    wanted = nearest((near - angle) / TAU)
    above = where(wanted < least, least, wanted)
    return angle + TAU * where(above > most, most, above)


def joint_near(turn, before, bend, near):
    """Joint of a link near another: its turn, on top of the direction before for absolute angles, less its bend."""
    return turn_near(turn + before - bend, near)


def joint_within(turn, before, bend, near, lower, upper):
    """The same within limits, and whether it is: 1 or 0."""
    q = turn_within(turn + before - bend, near, lower, upper)
    return q, where((q >= lower) & (q <= upper), 1.0, 0.0)


def chosen_elbow(off_up, off_down, wish, inside_up, inside_down):
    """+1 or -1: the only branch inside the limits, else the wished one, else the one less far off; +1 of equals."""
    nearer = where(off_down < off_up, -1.0, 1.0)
    wanted = where(wish == 0.0, nearer, wish)
    return where(inside_up == inside_down, wanted, where(inside_up > inside_down, 1.0, -1.0))


def turn_onto(angle, near, lower, upper):
    """Of [lower, upper], what is nearest to ``angle`` around the circle: a turn of it inside, or the nearer end."""
    inside = turn_within(angle, near, lower, upper)
    low, high = absolute(wrap(angle - lower)), absolute(wrap(angle - upper))
    end = where(low <= high, lower, upper)
    return where((inside < lower) | (inside > upper), end, inside)


def damped_gain(sigma, damping):
    """sigma/(sigma^2 + lambda^2): what damped least squares puts for 1/sigma; 0 for both 0."""
    bottom = sigma * sigma + damping * damping
    return where(bottom > 0.0, sigma, 0.0) / where(bottom > 0.0, bottom, 1.0)


def torque(jx, jy, jt, fx, fy, moment):
    """Joint torque tau = J^T f: one joint's entry, from its column of the Jacobian and the wrench on the tool."""
    return jx * fx + jy * fy + jt * moment


def axis_angle(ax, ay):
    """Direction of an undirected axis, in (-pi/2, pi/2]."""
    angle = atan2(ay, ax)
    return where(angle > 0.5 * PI, angle - PI, where(angle <= -0.5 * PI, angle + PI, angle))


def task_error(x, y, angle, target_x, target_y, heading, weight):
    """Tool less target [m]; the turn between them, in (-pi, pi], counts ``weight`` metres a radian."""
    return x - target_x, y - target_y, weight * wrap(angle - heading)
