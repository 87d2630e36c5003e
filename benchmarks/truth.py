"""Answers by mpmath at fifty digits, from other formulas than Coplanar's."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from mpmath import mp, mpf

__all__ = ["arc", "chain", "exact", "impact", "low_angle", "mp", "mpf", "rows", "segment", "two_link"]

mp.dps = 50


def exact(values: Iterable[Any]) -> list[Any]:
    """The very numbers that the floats are."""
    return [mpf(float(v)) for v in values]


def rows(function: Any, columns: Any, count: int) -> np.ndarray:
    """The function of exact numbers over the first rows, rounded to floats."""
    whole = [np.asarray(c) for c in np.broadcast_arrays(*columns)]
    table = [function(*exact(c[i] for c in whole)) for i in range(min(count, len(whole[0])))]
    return np.array([[float(v) for v in row] for row in table])


def arc(x: Any, y: Any, theta: Any, dx: Any, dy: Any, turn: Any) -> tuple[Any, Any, Any]:
    """Pose after a displacement: the exponential by its quotients, sin(turn)/turn and (1 - cos(turn))/turn."""
    if turn == 0:
        a, b = mpf(1), mpf(0)
    else:
        a, b = mp.sin(turn) / turn, (1 - mp.cos(turn)) / turn
    px, py = a * dx - b * dy, b * dx + a * dy
    c, s = mp.cos(theta), mp.sin(theta)
    return x + c * px - s * py, y + s * px + c * py, theta + turn


def segment(x: Any, y: Any, theta: Any, v: Any, omega: Any, a: Any, alpha: Any, t: Any) -> tuple[Any, Any, Any]:
    """Pose after constant accelerations, by the Taylor series of exp(i phi) integrated term by term."""
    total, power = mp.mpc(0), [mp.mpc(1)]
    b, c = 1j * omega, 1j * alpha / 2
    # exp(b s + c s^2) = sum p_k s^k with (k + 1) p_(k+1) = b p_k + 2 c p_(k-1)
    for k in range(120):
        before = power[k - 1] if k else mp.mpc(0)
        power.append((b * power[k] + 2 * c * before) / (k + 1))
        total += power[k] * t ** (k + 1) * (v / (k + 1) + a * t / (k + 2))
    end = mp.expjpi(theta / mp.pi) * total
    return x + end.real, y + end.imag, theta + omega * t + alpha * t * t / 2


def two_link(x: Any, y: Any, l1: Any, l2: Any) -> tuple[Any, Any, Any, Any]:
    """Both branches (q1, q2) by the law of cosines, elbow + then -."""
    r = mp.sqrt(x * x + y * y)
    bend = mp.acos((r * r - l1 * l1 - l2 * l2) / (2 * l1 * l2))
    lean = mp.acos((r * r + l1 * l1 - l2 * l2) / (2 * l1 * r))
    towards = mp.atan2(y, x)
    return towards - lean, bend, towards + lean, -bend


def chain(links: Any, *q: Any) -> list[Any]:
    """Pose of the tip and the Jacobian's rows for relative joints."""
    angles = [sum(q[: i + 1]) for i in range(len(q))]
    xs = [mpf(length) * mp.cos(angle) for length, angle in zip(links, angles, strict=True)]
    ys = [mpf(length) * mp.sin(angle) for length, angle in zip(links, angles, strict=True)]
    n = len(q)
    across = [-sum(ys[i:]) for i in range(n)]
    ahead = [sum(xs[i:]) for i in range(n)]
    return [sum(xs), sum(ys), angles[-1], *across, *ahead, *([mpf(1)] * n)]


def impact(speed: Any, angle: Any, k: Any, g: Any) -> tuple[Any, Any]:
    """Distance and time at which a shot under drag is back at its level: the hodograph in s = asinh(tan psi)."""
    with mp.workdps(30):
        s0 = mp.asinh(mp.tan(angle))
        u0 = speed * mp.cos(angle)

        def u(s: Any) -> Any:
            fallen = mp.sinh(s0) * mp.cosh(s0) + s0 - mp.sinh(s) * mp.cosh(s) - s
            return 1 / mp.sqrt(1 / u0**2 + k / g * fallen)

        def height(s: Any) -> Any:
            return mp.quad(lambda p: u(p) ** 2 * mp.sinh(2 * p), mp.linspace(s, s0, 5)) / (2 * g)

        end = mp.findroot(height, (-s0, -1.3 * s0), tol=1e-25)
        pieces = mp.linspace(end, s0, 5)
        x = mp.quad(lambda p: u(p) ** 2 * mp.cosh(p), pieces) / g
        return x, mp.quad(lambda p: u(p) * mp.cosh(p), pieces) / g


def low_angle(distance: Any, guess: Any, speed: Any, k: Any, g: Any) -> Any:
    """The launch angle near a guess that lands at a distance."""
    with mp.workdps(25):
        return mp.findroot(lambda angle: impact(speed, angle, k, g)[0] - distance, (guess, guess * 1.001), tol=1e-20)
