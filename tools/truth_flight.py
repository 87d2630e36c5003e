"""Golden values for projectiles, by differential equations: the library's own way, the hodograph, is not used.

States and impacts by Taylor series of the equations of motion with 30 digits (mpmath); straight climbs and falls by
their closed forms (mpmath); aims and best angles by DOP853 with brentq, fsolve and minimize_scalar (scipy).
"""

from __future__ import annotations

import mpmath as mp
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve, minimize_scalar

from golden import write

mp.mp.dps = 30
STATES = [  # speed [m/s], angle [deg], k [1/m], g [m/s^2], time [s]
    *((v, a, k, 9.81, t) for v, k in ((10, 0.02), (30, 0.005), (60, 0.02)) for a in (5, 45, 80) for t in (0.5, 4)),
    *((200, 60, 0.5, 9.81, t) for t in (0.01, 0.1, 1, 5)),  # the demonstration: launched at (100, 100 tan 60 deg)
    (30, 45, 1e-9, 9.81, 3), (30, -40, 0.02, 9.81, 3), (15, 89.99, 0.1, 9.81, 4), (30, 40, 0.02, 1e-6, 3),
    (30, 130, 0.02, 9.81, 3), (5, 30, 3.0, 1.62, 2),
]  # fmt: skip
IMPACTS = [(30, 40, 0.02, 9.81, 0.0), (30, 70, 0.1, 9.81, 0.0), (60, 20, 0.005, 9.81, -25.0), (20, 60, 0.02, 9.81, 8.0)]
BEST = [1e-6, 0.005, 0.02, 0.1, 0.5]
AIMS = [(20.0, 5.0, 30.0, 0.02), (8.0, -3.0, 12.0, 0.1), (60.0, 10.0, 60.0, 0.01)]


def taylor(v, degrees, k, g):
    """The state as a function of time, by a Taylor series of the equations of motion."""
    psi = mp.radians(mp.mpf(degrees))
    k, g = mp.mpf(k), mp.mpf(g)

    def rates(_, z):
        speed = mp.sqrt(z[2] ** 2 + z[3] ** 2)
        return [z[2], z[3], -k * z[2] * speed, -g - k * z[3] * speed]

    return mp.odefun(rates, 0, [mp.mpf(0), mp.mpf(0), v * mp.cos(psi), v * mp.sin(psi)])


def states():
    for v, degrees, k, g, time in STATES:
        z = taylor(v, degrees, k, g)(mp.mpf(time))
        yield {"kind": "state", "given": [v, degrees, k, g, time], "state": [float(c) for c in z]}


def impacts():
    for v, degrees, k, g, level in IMPACTS:
        path = taylor(v, degrees, k, g)
        late = 2 * v * mp.sin(mp.radians(degrees)) / g + 1
        time = mp.findroot(lambda t, path=path, level=level: path(t)[1] - level, (late / 2, late), tol=1e-25)
        z = path(time)
        yield {"kind": "impact", "given": [v, degrees, k, g, level], "time": float(time), "x": float(z[0])}


def upright():
    """Up with tan, down with tanh; thrown down faster than the terminal speed with coth."""
    for v, k, g, time in ((30, 0.1, 9.81, 1.0), (30, 0.1, 9.81, 5.0), (200, 0.5, 9.81, 3.0), (10, 1e-4, 1.62, 9.0)):
        v, k, g, time = map(mp.mpf, (v, k, g, time))
        b, end = mp.sqrt(k * g), mp.sqrt(g / k)
        rise = mp.atan(v / end) / b
        up = min(time, rise)
        y = mp.log(mp.cos(mp.atan(v / end) - b * up) / mp.cos(mp.atan(v / end))) / k
        y -= mp.log(mp.cosh(b * max(time - rise, 0))) / k
        speed = end * mp.tan(b * (rise - time)) if time < rise else -end * mp.tanh(b * (time - rise))
        yield {"kind": "upright", "given": [float(a) for a in (v, k, g, time)], "y": float(y), "vy": float(speed)}
    for v, k, g, time in ((30, 0.1, 9.81, 2.0), (2, 0.1, 9.81, 2.0)):
        v, k, g, time = map(mp.mpf, (v, k, g, time))
        b, end = mp.sqrt(k * g), mp.sqrt(g / k)
        y = -mp.log(mp.cosh(b * time) + v / end * mp.sinh(b * time)) / k
        speed = -end * (v + end * mp.tanh(b * time)) / (end + v * mp.tanh(b * time))
        yield {"kind": "upright", "given": [float(a) for a in (-v, k, g, time)], "y": float(y), "vy": float(speed)}


def height_at(x, v, psi, k, g=9.81):
    """The height of a path at a distance, or -inf: DOP853."""

    def rates(_, z):
        speed = np.hypot(z[2], z[3])
        return [z[2], z[3], -k * z[2] * speed, -g - k * z[3] * speed]

    def wall(_, z):
        return z[0] - x

    wall.terminal = True
    answer = solve_ivp(
        rates, (0, 60), [0, 0, v * np.cos(psi), v * np.sin(psi)], "DOP853", rtol=1e-13, atol=1e-13, events=wall
    )
    return answer.y_events[0][0][1] if len(answer.t_events[0]) else -np.inf


def range_of(v, psi, k, g=9.81):
    def rates(_, z):
        speed = np.hypot(z[2], z[3])
        return [z[2], z[3], -k * z[2] * speed, -g - k * z[3] * speed]

    def ground(_, z):
        return z[1]

    ground.terminal, ground.direction = True, -1
    start = [0, 1e-300, v * np.cos(psi), v * np.sin(psi)]
    return solve_ivp(rates, (0, 60), start, "DOP853", rtol=1e-13, atol=1e-13, events=ground).y_events[0][0][0]


def best_angles():
    for k in BEST:
        found = minimize_scalar(lambda p, k=k: -range_of(30.0, p, k), bounds=(0.3, 0.9), method="bounded",
                                options={"xatol": 1e-9})  # fmt: skip
        yield {"kind": "best", "k": k, "degrees": float(np.degrees(found.x)), "range": float(-found.fun)}


def aims():
    for x, y, v, k in AIMS:
        top = minimize_scalar(
            lambda p, a=(x, v, k): -height_at(a[0], a[1], p, a[2]), bounds=(0.2, 1.3), method="bounded"
        )
        angles = [
            brentq(lambda p, a=(x, y, v, k): height_at(a[0], a[2], p, a[3]) - a[1], *ends, xtol=1e-13)
            for ends in ((np.arctan2(y, x), top.x), (top.x, 1.54))
        ]
        yield {"kind": "angles", "given": [x, y, v, k], "low": angles[0], "high": angles[1]}


def demonstration():
    """C = 0.05, m = 2, T = 2, target (5, 10)."""

    def miss(velocity):
        k, g = 0.025, 9.81

        def rates(_, z):
            speed = np.hypot(z[2], z[3])
            return [z[2], z[3], -k * z[2] * speed, -g - k * z[3] * speed]

        z = solve_ivp(rates, (0, 2), [0, 0, *velocity], "DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
        return z[:2] - [5.0, 10.0]

    yield {"kind": "time", "given": [5.0, 10.0, 2.0], "velocity": fsolve(miss, [3.0, 15.0], xtol=1e-13).tolist()}


if __name__ == "__main__":
    write(
        __file__,
        [*states(), *impacts(), *upright(), *best_angles(), *aims(), *demonstration()],
        packages=["mpmath", "numpy", "scipy"],
        tolerance={"state": 1e-12, "best_degrees": 2e-5, "best_range": 1e-10, "angle": 1e-10, "velocity": 1e-10},
        unit="m, s, m/s; angles in degrees where given or named so, otherwise in rad",
    )
