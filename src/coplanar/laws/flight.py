"""A projectile under gravity and quadratic drag: force -C |v| v, k = C/m [1/m], in closed form up to one quadrature.

With psi the angle of the path, u = v cos psi and s = asinh(tan psi), the hodograph needs no differential equation:

    1/u^2 = 1/u0^2 + (2 k/g) (F(s0) - F(s)),   F = (sinh s cosh s + s)/2,
    dt = -(v/g) ds,   dx = -(v^2/g) cos psi ds,   dy = -(v^2/g) sin psi ds.

It is written here in m = exp(s0 - s), the factor by which the path has turned, and q = (m - 1)/g, so that nothing
divides by g (at g = 0 the path is the logarithmic straight line), by k (at k = 0 it is the parabola) or by cos psi0.
With A = 1 + sin psi0 and B = 1 - sin psi0,

    N = (u0/u)^2 = 1 + k v0^2 q ((A^2/m + B^2 m)(1 + 1/m)/4 + A B log(m)/(g q)),
    v cos psi = v0 cos psi0 / sqrt N,   v sin psi = v0 (A/m - B m)/2 / sqrt N.

The quadrature runs in theta, with q = expm1(theta)/a, and with v0 and a for units (``scales``). Its only singularities
are the zeros of N: the one on the real axis, where the speed would have been infinite before the launch, is sent to
-infinity or to the line of imaginary part pi by the choice of ``pace`` a; the others stay at least pi/2 from the real
axis. A Gauss panel of ``PANEL`` and 16 points then errs by less than 3.2^-32 of the integral.

Sources: de Mestre 1990, The Mathematics of Projectiles in Sport, ch. 3; Parker 1977, Am. J. Phys. 45, 606.
"""

from coplanar.engine import (
    Integral,
    absolute,
    atan,
    exp,
    expm1,
    hypot,
    log1p,
    maximum,
    sqrt,
    where,
)

PANEL = 2.2  # widest panel in theta
STRAIGHT = 1e-16  # a cosine below this is straight up or down
STEEP = 1e-10  # and takes this hodograph: t and y differ by its square, and x is linear in the true cosine
WEAKEST = 0.5**100  # gravity over ``pace``: none is the limit of so little, and a power of 2 rounds nothing
FAINTEST = 1e-12  # [1/m] drag in ``pace`` only, so that a flight without any force has one too
SERIES_BELOW = 1e-5  # the first term left out is below 3e-16


def drag_rates(vx, vy, k, g):
    """The accelerations vx' = -k |v| vx,  vy' = -g - k |v| vy."""
    drag = k * hypot(vx, vy)
    return -drag * vx, -g - drag * vy


def log1p_ratio(x):
    """log(1 + x)/x for x >= 0, 1 at 0."""
    small = x < SERIES_BELOW
    return where(small, 1.0 - x * (0.5 - x * (1.0 / 3.0)), log1p(x) / where(small, 1.0, x))


def expm1_ratio(x):
    """(exp(x) - 1)/x, 1 at 0."""
    small = absolute(x) < SERIES_BELOW
    return where(small, 1.0 + x * (0.5 + x * (1.0 / 6.0)), expm1(x) / where(small, 1.0, x))


def atan_ratio(x):
    """atan(x)/x, 1 at 0."""
    small = absolute(x) < SERIES_BELOW
    return where(small, 1.0 - x * x * (1.0 / 3.0), atan(x) / where(small, 1.0, x))


def sides(c, s):
    """A = 1 + sin psi, B = 1 - sin psi of a direction (cos psi, sin psi), with A B = cos^2 psi, never 0."""
    cosine = where(absolute(c) < STRAIGHT, STEEP, absolute(c))
    large = 1.0 + absolute(s)
    small = cosine * cosine / large
    return where(s > 0.0, large, small), where(s > 0.0, small, large)


def pace(v0, k, g):
    """Scale of q in theta, q = expm1(theta)/a: a = b + g + sqrt(b (b + g)) [m/s^2], b = k v0^2 + g/50."""
    b = (k + FAINTEST) * v0 * v0 + 0.02 * g
    return b + g + sqrt(b) * sqrt(b + g)  # not sqrt(b (b + g)): b may be as great as 1e300


def theta_of_straight(t, v0, k, g):
    """Parameter theta = log(1 + a q), q = t/v0 + k t^2/2: with gravity theta is never less."""
    return log1p(pace(v0, k, g) * t * (1.0 / v0 + 0.5 * k * t))


def turn(theta, v0, k, g):
    """How far the path has turned: m = 1 + g q, q = expm1(theta)/a."""
    return 1.0 + g * expm1(theta) / pace(v0, k, g)


def theta_of_turn(m, v0, k, g):
    """Parameter theta = log(1 + a (m - 1)/g); 0 where there is no gravity to turn the path."""
    still = g <= 0.0
    return log1p(where(still, 0.0, pace(v0, k, g) * (m - 1.0) / where(still, 1.0, g)))


def scales(v0, k, g):
    """The pace a, drag K = k v0^2/a, gravity G = g/a and 1/G, with the speed of launch and the pace for units."""
    a = pace(v0, k, g)
    G = maximum(g / a, WEAKEST)
    return a, k * v0 * v0 / a, G, 1.0 / G


def hodograph(q, A, B, K, G, W):
    """Turn m, 1/m, cosh(s)/cosh(s0), sinh(s)/cosh(s0), N = (u0/u)^2 and log(m)/G at q, where W = 1/G."""
    turned = G * q
    m = 1.0 + turned
    back = 1.0 / m
    up, down = A * back, B * m
    log_m = W * log1p(turned)
    n = 1.0 + K * (0.25 * q * (A * up + B * down) * (1.0 + back) + A * B * log_m)
    return m, back, 0.5 * (up + down), 0.5 * (up - down), n, log_m


def travel_rates(theta, A, B, K, G, W):
    """Rates of t, x/cos(psi0), y: (v, v^2 cos psi/cos psi0, v^2 sin psi) exp(theta)/m."""
    q = expm1(theta)
    _, back, cosh_s, sinh_s, n, _ = hodograph(q, A, B, K, G, W)
    step, slow = (1.0 + q) * back * cosh_s, 1.0 / n
    way = step * slow
    return step * sqrt(slow), way, way * sinh_s


distance = Integral(travel_rates)


def travel(lower, upper, v0, c, s, k, g):
    """Time, x and y flown from theta = lower to upper after a launch at speed v0 along (c, s)."""
    A, B = sides(c, s)
    a, K, G, W = scales(v0, k, g)
    t, x, y = distance((upper - lower) / PANEL, lower, upper, A, B, K, G, W)
    unit = v0 / a
    return unit * t, unit * v0 * c * x, unit * v0 * y


def velocity(theta, v0, c, s, k, g):
    """Velocity vx = v0 cos psi0/sqrt N,  vy = v0 (A/m - B m)/2/sqrt N."""
    A, B = sides(c, s)
    _, K, G, W = scales(v0, k, g)
    _, _, _, sinh_s, n, _ = hodograph(expm1(theta), A, B, K, G, W)
    u = v0 / sqrt(n)
    return u * c, u * sinh_s


def clock(theta, v0, c, s, k, g):
    """Time t(theta) and dt/dtheta."""
    A, B = sides(c, s)
    a, K, G, W = scales(v0, k, g)
    t, _, _ = distance(theta / PANEL, 0.0, theta, A, B, K, G, W)
    rate, _, _ = travel_rates(theta, A, B, K, G, W)
    return v0 / a * t, v0 / a * rate


def parallel_turn(c, s, slope_c, slope_s):
    """Turn m at which the path is parallel to a line: exp(s0 - asinh(slope)), or 1 if that is past."""
    A, B = sides(c, s)
    A1, B1 = sides(slope_c, slope_s)
    return maximum(1.0, sqrt((A * B1) / (B * A1)))


def last_turn(v0, c, s, k, g):
    """Turn m from which the path is straight down at terminal speed, to 1e-16."""
    _, B = sides(c, s)
    return 2.0e16 / B * (1.0 + sqrt(g / (k + FAINTEST)) / v0)


def ballistic_bend(t, v0, A, B, g):
    """How far the path has turned after the time t without drag, (m - 1)/g: t/v0 without gravity."""
    w = 0.5 * (A - B) - g * t / v0
    up, h = absolute(w), sqrt(A * B + w * w)
    risen = w > 0.0
    return t / v0 * (up + h + where(risen, A, B)) / ((1.0 + h) * where(risen, up + h, B))


def ballistic_turn(t, v0, c, s, g):
    """Turn m after the time t without drag; with drag the path turns more."""
    A, B = sides(c, s)
    return 1.0 + g * ballistic_bend(t, v0, A, B, g)


def coast(time, vx, vy, k, g):
    """Way and velocity after a time at the present k |v| and vertical acceleration: right to t^3, exact for k = 0.

    At terminal speed, where k |v| is constant and the vertical acceleration 0, it is exact as well.
    """
    fade = k * hypot(vx, vy)
    ay = -g - fade * vy
    x = vx * time * expm1_ratio(-fade * time)
    return x, time * (vy + 0.5 * time * ay), vx * exp(-fade * time), vy + time * ay


def lean(q, c, A, B, K, G, W):
    """What d/d psi0 at a constant q makes of the hodograph: that, then of cosh(s), sinh(s) and log N."""
    m, back, cosh_s, sinh_s, n, log_m = hodograph(q, A, B, K, G, W)
    slow = 1.0 / n
    return (
        (1.0 + q) * back, cosh_s, sinh_s, slow,
        -0.5 * c * G * q * (1.0 + back),  # -cos psi0 sinh(s0 - s)
        0.5 * c * (m + back),  # cos psi0 cosh(s0 - s)
        K * c * (q * sinh_s * (1.0 + back) - (A - B) * log_m) * slow,
    )  # fmt: skip


def derivative_rates(theta, c, A, B, K, G, W):
    """Derivatives of the rates of t, x, y at a constant q: by v0, then by psi0."""
    step, cosh_s, sinh_s, slow, turned, lifted, slowed = lean(expm1(theta), c, A, B, K, G, W)
    root = sqrt(slow)
    by_speed, way, twice = step * cosh_s * slow, step * slow, turned - cosh_s * slowed
    return (
        by_speed * root,
        2.0 * by_speed * c * slow,
        2.0 * by_speed * sinh_s * slow,
        step * root * (turned - 0.5 * cosh_s * slowed),
        way * (c * twice - 0.5 * (A - B) * cosh_s),
        way * (lifted * cosh_s + sinh_s * twice),
    )


dependence = Integral(derivative_rates)


def derivatives(theta, v0, c, s, k, g):
    """Derivatives of t, x, y by the speed v0, then by the angle psi0, at a constant q (a constant turn)."""
    A, B = sides(c, s)
    a, K, G, W = scales(v0, k, g)
    t_v, x_v, y_v, t_psi, x_psi, y_psi = dependence(theta / PANEL, 0.0, theta, c, A, B, K, G, W)
    unit, length = v0 / a, v0 * v0 / a
    return t_v / a, unit * x_v, unit * y_v, unit * t_psi, length * x_psi, length * y_psi


def climb_height(v0, k, g):
    """Height of a shot straight up: log(1 + k v0^2/g)/(2 k)."""
    return 0.5 * v0 * v0 / g * log1p_ratio(k * v0 * v0 / g)


def climb_speed(height, k, g):
    """Speed that climbs to a height straight up: v0^2 = g (exp(2 k h) - 1)/k."""
    return sqrt(2.0 * g * height * expm1_ratio(2.0 * k * height))


def speed_at_height(v0, height, k, g):
    """Speed left after a climb straight up: v^2 = v0^2 exp(-2 k h) - g (1 - exp(-2 k h))/k."""
    return sqrt(v0 * v0 * exp(-2.0 * k * height) - 2.0 * g * height * expm1_ratio(-2.0 * k * height))


def climb_time(v0, v, k, g):
    """Time in which a climb straight up slows from v0 to v: (atan(v0 b/g) - atan(v b/g))/b, b = sqrt(k g)."""
    y = (v0 - v) / (g + k * v0 * v)
    return y * atan_ratio(sqrt(k * g) * y)


def free_speed(distance, slope_c, c, sine_above, g):
    """Speed without drag to a distance along a slope: v0^2 = g d cos^2(alpha)/(2 cos psi sin(psi - alpha))."""
    return slope_c * sqrt(0.5 * g * distance / (c * sine_above))


def hold_off(kd):
    """Logarithm of v0 over the speed without drag on a flat path: log(2 (exp z - 1 - z)/z^2)/2, z = 2 k d, nearly.

    A first guess: the fraction is exp(z)/(1 + 2 z/3 + z^2/2) to second order at 0, and in the limit.
    """
    z = 2.0 * kd
    return 0.5 * z - 0.5 * log1p(z * (2.0 / 3.0 + 0.5 * z))


def first_climb(x, y, time, k, g):
    """Velocity w with w T = d + the fall, the fall being g T^2/2 without drag and T sqrt(g/k) in the end, nearly."""
    return x / time, y / time + 0.5 * g * time / (1.0 + 0.5 * time * sqrt(k * g))


def launch_speed_of_mean(mean, time, k):
    """Speed v0 = (exp(k w T) - 1)/(k T) that drag alone turns into a mean speed w over T, and its slope by w."""
    return mean * expm1_ratio(k * mean * time), exp(k * mean * time)


def straight_time(distance, speed, k):
    """Time over a straight distance against drag alone: (exp(k d) - 1)/(k v0)."""
    return distance / speed * expm1_ratio(k * distance)


def energy(mass, y, vx, vy, g):
    """Kinetic and potential energy: T = m v^2/2, V = m g y."""
    return 0.5 * mass * (vx * vx + vy * vy), mass * g * y


def miss_across(x_v, y_v, x_psi, y_psi, vx, vy, sigma_speed, sigma_angle):
    """Standard deviation of the way by which the path passes the target, to first order in independent errors."""
    v = hypot(vx, vy)
    by_speed = sigma_speed * (vx * y_v - vy * x_v) / v
    by_angle = sigma_angle * (vx * y_psi - vy * x_psi) / v
    return hypot(by_speed, by_angle)
