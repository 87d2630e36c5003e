"""Damped least squares for few equations: step = -J^T (J J^T + lambda I)^-1 F, lambda = mu |F|^2 with an adapted mu.

Sources: Levenberg 1944; Marquardt 1963; Fan and Yuan 2005, Computing 74, 23-39 (lambda from |F|); Sugihara 2011, IEEE
T-RO 27, 984 (for arms).
"""

from coplanar.engine import maximum, where

LEAST_DAMPING = 1e-14  # of the trace of J J^T: keeps a rank-deficient system solvable, far below any that matters
LEAST_LAMBDA = 2.2250738585072014e-308  # where even the trace is 0
LARGEST = 1.7976931348623157e308
GOOD, POOR, TAKEN = 0.75, 0.25, 1e-4  # actual over predicted gain: relax, tighten, accept  [Fan and Yuan 2005]
RELAX, TIGHTEN, REFUSE = 0.1, 4.0, 16.0  # factors of the damping
DAMPING_FLOOR = 1e-10  # of mu = lambda/|F|^2: so that it can rise again within a few iterations


def damping(mu, square, trace):
    """Damping lambda = mu |F|^2, and a rounding of the trace of J J^T for a system without full rank."""
    return mu * square + LEAST_DAMPING * trace + LEAST_LAMBDA


def free(x, lower, upper, slope):
    """1, or 0 where x stands at a bound and downhill, against the slope, leads past it."""
    blocked = ((x <= lower) & (slope > 0.0)) | ((x >= upper) & (slope < 0.0))
    return where(blocked, 0.0, 1.0)


def solve_three(a, b, c, d, e, f, u, v, w):
    """The y with A y = (u, v, w), A = [[a, b, c], [b, d, e], [c, e, f]] positive definite, by A = L D L^T."""
    l21, l31 = b / a, c / a
    pivot, cross = d - l21 * b, e - l21 * c
    l32 = cross / pivot
    second = v - l21 * u
    y3 = (w - l31 * u - l32 * second) / (f - l31 * c - l32 * cross)
    y2 = second / pivot - l32 * y3
    return u / a - l21 * y2 - l31 * y3, y2, y3


def shortening(length, longest):
    """The factor that makes a step no longer than allowed; 1 for one without end."""
    over = (length > longest) & (length <= LARGEST)
    return where(over, longest, 1.0) / where(over, length, 1.0)


def gain(square, predicted, there):
    """Fall of |F|^2 over the fall that the linear model predicted; -1 where it predicted none."""
    falls = square > predicted
    return where(falls, square - there, -1.0) / where(falls, square - predicted, 1.0)


def adapted(mu, gained):
    """The next mu, and 1 if the step is taken: less where the linear model holds, more where not, most if refused."""
    change = where(gained > GOOD, RELAX, where(gained < POOR, TIGHTEN, 1.0))
    taken = gained > TAKEN
    return maximum(mu * where(taken, change, REFUSE), DAMPING_FLOOR), where(taken, 1.0, 0.0)


def still(length, size, small):
    """1 where a step is nothing beside 1 + |x|, else 0."""
    return where(length <= small * (1.0 + size), 1.0, 0.0)
