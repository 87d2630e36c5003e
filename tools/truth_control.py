"""Golden curves, poles and closed loops by mpmath, to 50 digits.

Derivatives of curves are differenced, poles are roots of polynomials, and the loop is the algorithm written out: solve
A [v, omega] = kp e + kd edot + ki int e, then a Runge-Kutta step in full, or the chord of the arc.
"""

from __future__ import annotations

import mpmath as mp

from golden import write

mp.mp.dps = 50

CURVES = {
    "circle": ([0.7], lambda u, r: (r * mp.cos(u), r * mp.sin(u))),
    "ellipse": ([2.0, 0.5], lambda u, a, b: (a * mp.cos(u), b * mp.sin(u))),
    "lemniscate": ([1.5, 0.8], lambda u, a, b: (a * mp.cos(u), b * mp.cos(u) * mp.sin(u))),
    "astroid": ([1.25], lambda u, a: (a * mp.cos(u) ** 3, a * mp.sin(u) ** 3)),
}
LOOPS = [
    {"method": "euler", "point": [0.05, 0.0], "kp": 100.0, "kd": 0.5, "ki": 0.0, "step": 0.01},
    {"method": "exact", "point": [0.05, 0.02], "kp": 60.0, "kd": 0.25, "ki": 40.0, "step": 0.01},
    {"method": "rk4", "point": [0.1, -0.03], "kp": 30.0, "kd": 0.0, "ki": 0.0, "step": 0.02},
    {"method": "midpoint", "point": [0.1, 0.0], "kp": 30.0, "kd": 0.1, "ki": 0.0, "step": 0.02},
    {"method": "heun", "point": [0.1, 0.0], "kp": 30.0, "kd": 0.1, "ki": 5.0, "step": 0.02},
]


def curves():
    for name, (sizes, function) in CURVES.items():
        for phi in (0.0, 0.3, 1.5707963267948966, 2.9, 4.0, 6.0):
            at = mp.mpf(phi)
            rows = [derivative(function, sizes, at, order) for order in (0, 1, 2)]
            yield {"curve": name, "sizes": sizes, "parameter": phi, "derivatives": floats(rows)}


def derivative(function, sizes, at, order):
    return [mp.diff(lambda u, k=k: function(u, *map(mp.mpf, sizes))[k], at, order) for k in (0, 1)]


def poles():
    for h, kp, kd, ki in ((0.01, 100, 0.5, 0), (0.02, 20, 0.1, 0), (0.01, 30, -0.4, 0), (0.05, 10, 0.25, 8)):
        h, kp, kd, ki = map(mp.mpf, (h, kp, kd, ki))
        middle = 1 - h * kp - kd
        cubic = [1, h * h * ki - middle - 1, middle - kd, kd]
        roots = mp.polyroots(cubic if ki else [1, -middle, -kd], maxsteps=200, extraprec=200)
        yield {
            "step": float(h), "kp": float(kp), "kd": float(kd), "ki": float(ki),
            "poles": sorted([float(mp.re(z)), float(mp.im(z))] for z in roots),
        }  # fmt: skip


def advance(x, y, theta, v, omega, h, method):
    """Classical Runge-Kutta in full for the table's methods; the chord of the arc for "exact"."""
    if method == "exact":
        half = omega * h / 2
        chord = v * h * (mp.sin(half) / half if half else 1)
        return x + chord * mp.cos(theta + half), y + chord * mp.sin(theta + half), theta + 2 * half

    def rates(state):
        return (v * mp.cos(state[2]), v * mp.sin(state[2]), omega)

    def moved(state, by, rate):
        return tuple(s + by * r for s, r in zip(state, rate, strict=True))

    state = (x, y, theta)
    k1 = rates(state)
    if method == "euler":
        return moved(state, h, k1)
    if method == "midpoint":
        return moved(state, h, rates(moved(state, h / 2, k1)))
    if method == "heun":
        k2 = rates(moved(state, h, k1))
        return tuple(s + h * (a + b) / 2 for s, a, b in zip(state, k1, k2, strict=True))
    k2 = rates(moved(state, h / 2, k1))
    k3 = rates(moved(state, h / 2, k2))
    k4 = rates(moved(state, h, k3))
    return tuple(s + h * (a + 2 * b + 2 * c + d) / 6 for s, a, b, c, d in zip(state, k1, k2, k3, k4, strict=True))


def reference(t, duration):
    phi = 2 * mp.pi * t / duration
    return mp.cos(phi) ** 3, mp.sin(phi) ** 3


def loop(method, point, kp, kd, ki, step, duration=10):
    """The algorithm of the closed loop, every hundredth row."""
    h = mp.mpf(step)
    px, py = map(mp.mpf, point)
    theta = mp.pi / 2
    rx, ry = reference(mp.mpf(0), duration)
    x = rx - (px * mp.cos(theta) - py * mp.sin(theta))
    y = ry - (px * mp.sin(theta) + py * mp.cos(theta))
    ex0 = ey0 = sx = sy = mp.mpf(0)
    steps = round(duration / step)
    for i in range(steps):
        c, s = mp.cos(theta), mp.sin(theta)
        rx, ry = reference(mp.mpf(duration) * (i + 1) / steps, duration)
        ex, ey = rx - (x + c * px - s * py), ry - (y + s * px + c * py)
        sx, sy = sx + h * ex, sy + h * ey
        wx = kp * ex + kd * (ex - ex0) / h + ki * sx
        wy = kp * ey + kd * (ey - ey0) / h + ki * sy
        ex0, ey0 = ex, ey
        v, omega = mp.lu_solve(mp.matrix([[c, -(px * s + py * c)], [s, px * c - py * s]]), mp.matrix([wx, wy]))
        x, y, theta = advance(x, y, theta, v, omega, h, method)
        if (i + 1) % 100 == 0:
            yield [i + 1, *floats([x, y, theta, v, omega, ex, ey])]


def floats(values):
    return [floats(v) for v in values] if isinstance(values, list) else float(values)


write(
    __file__,
    [
        *({"kind": "curve", **case} for case in curves()),
        *({"kind": "poles", **case} for case in poles()),
        *({"kind": "loop", **case, "rows": list(loop(**case))} for case in LOOPS),
    ],
    packages=["mpmath"],
    tolerance={"curve": 1e-14, "poles": 1e-12, "loop": 1e-9},
    unit="m, rad, s",
)
