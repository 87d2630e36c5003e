"""Motion of a body that rolls forward without sideways slip: x' = v cos(theta), y' = v sin(theta), theta' = omega.

Constant (v, omega) is an arc, constant accelerations (a, alpha) a generalised Fresnel integral; both are walked from
the heading in the middle, so that nothing cancels when omega and alpha vanish.

Sources: Thrun, Burgard, Fox 2005, Probabilistic Robotics, sec. 5.3; Sola, Deray, Atchuthan 2018, A micro Lie theory;
Bertolazzi, Frego 2015, G1 fitting with clothoids, sec. 2 (Fresnel integrals).
"""

from coplanar.engine import Integral, absolute, hypot, maximum, sinc, sincos, where
from coplanar.laws.se2 import exp_jacobian, rotate

PANEL_PHASE = 6.0  # [rad] turned within one panel; 16 points then leave out less than 2e-20 of the path's length
NEVER = float("inf")  # [s]


def unicycle_rates(theta, v, omega):
    """Pose rates x' = v cos(theta), y' = v sin(theta), theta' = omega."""
    s, c = sincos(theta)
    return v * c, v * s, omega


def euler(x, y, theta, v, omega, dt):
    """Pose after one Euler step: x + h v cos(theta), y + h v sin(theta), theta + h omega."""
    s, c = sincos(theta)
    return x + dt * v * c, y + dt * v * s, theta + dt * omega


def chord(theta, distance, turn):
    """Chord of a circular arc: distance sinc(h) along theta + h, h = turn/2.  [Thrun 2005, eq. 5.9; chord form]"""
    half = 0.5 * turn
    length = distance * sinc(half)
    s, c = sincos(theta + half)
    return length * c, length * s


def advance(x, y, theta, distance, turn):
    """Pose after a circular arc of this length that turns by this angle."""
    dx, dy = chord(theta, distance, turn)
    return x + dx, y + dy, theta + turn


def arc(x, y, theta, v, omega, dt):
    """Pose after driving the circular arc of constant v and omega for dt."""
    return advance(x, y, theta, v * dt, omega * dt)


def velocities(v, omega, a, alpha, t):
    """Velocities v + a t and omega + alpha t."""
    return v + a * t, omega + alpha * t


def most_turn(omega, alpha, dt):
    """A bound on the turn: |dt| times the fastest rate, which is at one of the ends."""
    return maximum(absolute(omega), absolute(omega + alpha * dt)) * absolute(dt)


def drift(u, v, omega, a, alpha):
    """(v + a u) (cos - 1, sin)(omega u + alpha u^2/2): what turning adds to the velocity, seen from u = 0.

    By the half angle, cos - 1 = -2 sin^2, so that a straight line comes out exactly.
    """
    s, c = sincos(0.5 * (omega + 0.5 * alpha * u) * u)
    lag = 2.0 * (v + a * u) * s
    return -lag * s, lag * c


swept = Integral(drift)


def segment(x, y, theta, v, omega, a, alpha, dt):
    """Pose p + int_0^dt (v + a s) (cos, sin)(theta + omega s + alpha s^2/2) ds, taken about the middle, s = dt/2 + u.

    What turning adds to the straight way is integrated. No panel turns by more than PANEL_PHASE.
    """
    half = 0.5 * dt
    middle_v, middle_omega = velocities(v, omega, a, alpha, half)
    panels = most_turn(omega, alpha, dt) / PANEL_PHASE
    lag, left = swept(panels, -half, half, middle_v, middle_omega, a, alpha)
    dx, dy = rotate(theta + (omega + 0.5 * alpha * half) * half, middle_v * dt + lag, left)
    return x + dx, y + dy, theta + middle_omega * dt


def drift_moments(u, v, omega, a, alpha, half):
    """Integrands of a segment's derivatives: s^k e^(i phi), k = 0, 1, and s^k (v + a u) e^(i phi), k = 1, 2."""
    s, c = sincos((omega + 0.5 * alpha * u) * u)
    time = half + u
    lever = time * (v + a * u)
    return c, s, time * c, time * s, lever * c, lever * s, time * lever * c, time * lever * s


moments = Integral(drift_moments)


def segment_jacobian(theta, v, omega, a, alpha, dt):
    """Derivatives of a segment's end (x, y) by v, omega, a, alpha and theta, pair by pair; then of its end heading.

    By v: int e^(i phi); by a: int s e^(i phi); by omega: i int s (v + a s) e^(i phi); by alpha: i/2 int s^2 (v + a s)
    e^(i phi); by theta: i times the displacement. The heading's are dt by omega and dt^2/2 by alpha.
    """
    half = 0.5 * dt
    middle_v, middle_omega = velocities(v, omega, a, alpha, half)
    panels = most_turn(omega, alpha, dt) / PANEL_PHASE
    c0, s0, c1, s1, c2, s2, c3, s3 = moments(panels, -half, half, middle_v, middle_omega, a, alpha, half)
    middle = theta + (omega + 0.5 * alpha * half) * half
    xv, yv = rotate(middle, c0, s0)
    xa, ya = rotate(middle, c1, s1)
    p2, q2 = rotate(middle, c2, s2)
    p3, q3 = rotate(middle, c3, s3)
    dx, dy = v * xv + a * xa, v * yv + a * ya
    return xv, yv, -q2, p2, xa, ya, -0.5 * q3, 0.5 * p3, -dy, dx, dt, 0.5 * dt * dt


def curvature(v, omega, a, alpha):
    """Curvature kappa = omega/v; infinite for a turn on the spot, alpha/a at rest, 0 where nothing moves."""
    num = where(v != 0.0, omega, where(omega != 0.0, omega, alpha))
    den = where(v != 0.0, v, where(omega != 0.0, 0.0, a))
    spin = where(num > 0.0, NEVER, where(num < 0.0, -NEVER, 0.0))
    return where(den != 0.0, num / where(den != 0.0, den, 1.0), spin)


def cusp_time(v, a, duration):
    """The time -v/a within (0, duration) at which v + a t changes sign; infinite where it never does."""
    time = -v / where(a != 0.0, a, 1.0)
    return where((a != 0.0) & (time > 0.0) & (time < duration), time, NEVER)


def covered(rate, dt):
    """Way or turn of a velocity that is held for a time: rate dt."""
    return rate * dt


def wheel_increments(left, right, track):
    """Distance (left + right)/2 and turn (right - left)/track from how far each wheel rolled."""
    return 0.5 * (left + right), (right - left) / track


def step_jacobian(theta, dx, dy, dtheta):
    """How the step T exp(dx, dy, dtheta) moves (x, y): along and across per dx, the pair per dtheta, the chord itself.

    With (a, b), (u, w), (p, q) in this order: G = [[a, -b, u], [b, a, w], [0, 0, 1]] by the increment and
    F = [[1, 0, -q], [0, 1, p], [0, 0, 1]] by the pose.  [Sola 2018, sec. IV]
    """
    along, across, ux, uy = exp_jacobian(dx, dy, dtheta)
    a, b = rotate(theta, along, across)
    u, w = rotate(theta, ux, uy)
    return a, b, u, w, a * dx - b * dy, b * dx + a * dy


def increment_variances(dx, dy, dtheta, forward, sideways, turn_per_metre, turn_per_radian):
    """Variances that grow with the way and the turn: s^2 |d|, so that splitting a tick changes nothing.

    [Chong and Kleeman 1997, Accurate odometry and error modelling for a mobile robot]
    """
    way = hypot(dx, dy)
    turn = turn_per_metre * turn_per_metre * way + turn_per_radian * turn_per_radian * absolute(dtheta)
    return forward * forward * way, sideways * sideways * way, turn
