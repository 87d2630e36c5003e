"""Golden values for arms, by other means than the library's: run from the repository's root.

The two-link inverse by the law of cosines with 50 digits (mpmath); Jacobians and their time derivatives by symbolic
differentiation of the tip (sympy); the demo by MINPACK (scipy's fsolve); nearest points within joint limits by a
bounded minimiser from many starts (scipy).
"""

from __future__ import annotations

import json
import random
from pathlib import Path

import mpmath
import numpy as np
import scipy
import sympy
from scipy.optimize import fsolve, minimize

mpmath.mp.dps = 50
FOLDER = Path(__file__).parent.parent / "tests" / "truth"
ARMS = [
    {"links": [1.0, 0.8], "joints": "RR", "angles": "relative"},
    {"links": [1.0, 0.8], "joints": "RR", "angles": "absolute", "tool": [0.2, -0.1, 0.3], "base": [0.3, -0.4, 0.9]},
    {"links": [0.7, 0.5, 0.3], "joints": "RRR", "angles": "relative", "tool": [0.1, 0.2, -0.4]},
    {"links": [0.7, 0.5, 0.3], "joints": "RPR", "angles": "relative", "base": [0.3, -0.4, 0.9]},
    {"links": [0.7, 0.5, 0.3, 0.2], "joints": "RPRP", "angles": "absolute", "tool": [0.1, 0.2, -0.4]},
    {"links": [0.2, 0.1], "joints": "PP", "angles": "relative", "bends": [0.0, 1.5]},
    {"links": [0.9, 0.6, 0.4, 0.3, 0.2], "joints": "RRRRR", "angles": "relative", "bends": [0.1, -0.2, 0.3, 0.0, 0.5]},
]


def cosine_law(x, y, l1, l2, elbow):
    """Both joints by the law of cosines."""
    x, y, l1, l2 = map(mpmath.mpf, (x, y, l1, l2))
    r2 = x * x + y * y
    cosine = (r2 - l1**2 - l2**2) / (2 * l1 * l2)
    q2 = elbow * mpmath.acos(cosine)
    return mpmath.atan2(y, x) - mpmath.atan2(l2 * mpmath.sin(q2), l1 + l2 * mpmath.cos(q2)), q2


def inverse_cases(count=160):
    draw = random.Random(1)
    cases = []
    while len(cases) < count:
        l1 = draw.uniform(0.2, 2.0)
        l2 = l1 if draw.random() < 0.4 else draw.uniform(0.2, 2.0)
        hole, reach = abs(l1 - l2), l1 + l2
        near = 10.0 ** draw.uniform(-13, -1)
        r = draw.choice([draw.uniform(hole, reach), reach * (1.0 - near), hole + near])
        turn = draw.uniform(-3.14, 3.14)
        x, y = float(r * mpmath.cos(turn)), float(r * mpmath.sin(turn))
        radius = mpmath.hypot(mpmath.mpf(x), mpmath.mpf(y))
        if not abs(mpmath.mpf(l1) - mpmath.mpf(l2)) < radius < mpmath.mpf(l1) + mpmath.mpf(l2):
            continue
        elbow = draw.choice([1, -1])
        q1, q2 = cosine_law(x, y, l1, l2, elbow)
        q1 = mpmath.atan2(mpmath.sin(q1), mpmath.cos(q1))
        cases.append({"given": [x, y, l1, l2, elbow], "q": [mpmath.nstr(v, 25) for v in (q1, q2)],
                      "sine": float(abs(mpmath.sin(q2)))})  # fmt: skip
    return cases


def symbolic_tip(arm, q):
    """Position and heading of the tool as sympy expressions of q."""
    base, tool = ([sympy.Float(str(v)) for v in arm.get(k, [0.0, 0.0, 0.0])] for k in ("base", "tool"))
    bends = [sympy.Float(str(v)) for v in arm.get("bends", [0.0] * len(q))]
    x, y, phi = base
    for length, joint, value, bend in zip(arm["links"], arm["joints"], q, bends, strict=True):
        length = sympy.Float(str(length)) + (value if joint == "P" else 0)
        if joint == "R":
            phi = (base[2] if arm["angles"] == "absolute" else phi) + value
        phi = phi + bend
        x, y = x + length * sympy.cos(phi), y + length * sympy.sin(phi)
    x = x + tool[0] * sympy.cos(phi) - tool[1] * sympy.sin(phi)
    y = y + tool[0] * sympy.sin(phi) + tool[1] * sympy.cos(phi)
    return sympy.Matrix([x, y, phi + tool[2]])


def jacobian_cases():
    draw, cases, t = random.Random(2), [], sympy.Symbol("t")
    for arm in ARMS:
        n = len(arm["links"])
        q = sympy.Matrix([sympy.Function(f"q{i}")(t) for i in range(n)])
        tip = symbolic_tip(arm, q)
        jacobian = tip.jacobian(q)
        slope = jacobian.diff(t)
        for _ in range(3):
            at, rate = ([round(draw.uniform(-2.5, 2.5), 3) for _ in range(n)] for _ in range(2))
            rates = [(q[i].diff(t), sympy.Float(str(rate[i]), 30)) for i in range(n)]
            here = [(q[i], sympy.Float(str(at[i]), 30)) for i in range(n)]
            values = [m.subs(rates).subs(here).evalf(20) for m in (tip, jacobian, slope)]
            tip_value, jacobian_value, slope_value = (np.array(m.tolist(), dtype=float).tolist() for m in values)
            cases.append({"arm": arm, "q": at, "q_rate": rate, "tip": [v for (v,) in tip_value],
                          "jacobian": jacobian_value, "jacobian_dot": slope_value})  # fmt: skip
    return cases


def demo():
    def miss(q):
        return [0.5 * np.cos(q[0]) + 0.5 * np.cos(q[0] + q[1]) - 0.5, 0.5 * np.sin(q[0]) + 0.5 * np.sin(q[0] + q[1])]

    q, info, ended, _ = fsolve(miss, [0.1, 0.1], full_output=True, xtol=1e-13)
    wrapped = np.arctan2(np.sin(q), np.cos(q))
    return {"links": [0.5, 0.5], "target": [0.5, 0.0], "start": [0.1, 0.1], "q_wrapped": wrapped.tolist(),
            "residual": float(np.hypot(*info["fvec"])), "ended": int(ended)}  # fmt: skip


def limited_cases(count=24):
    draw, cases = random.Random(3), []
    for i in range(count):
        l1, l2 = draw.uniform(0.4, 1.2), draw.uniform(0.4, 1.2)
        limits = [sorted(round(draw.uniform(-3, 3), 2) for _ in range(2)) for _ in range(2)]
        target = [round(draw.uniform(-2.5, 2.5), 2) for _ in range(2)]
        angles = ("relative", "absolute")[i % 2]

        def square(q, l1=l1, l2=l2, target=target, absolute=angles == "absolute"):
            second = q[1] if absolute else q[0] + q[1]
            x, y = l1 * np.cos(q[0]) + l2 * np.cos(second), l1 * np.sin(q[0]) + l2 * np.sin(second)
            return (x - target[0]) ** 2 + (y - target[1]) ** 2

        grid = [np.linspace(*limit, 7) for limit in limits]
        answers = [minimize(square, [a, b], bounds=limits, tol=1e-15) for a in grid[0] for b in grid[1]]
        least = min(a.fun for a in answers)
        cases.append({"links": [l1, l2], "angles": angles, "limits": limits, "target": target,
                      "distance": float(np.sqrt(max(least, 0.0)))})  # fmt: skip
    return cases


def main():
    versions = {m.__name__: m.__version__ for m in (mpmath, sympy, scipy, np)}
    content = {
        "generator": "tools/truth_arms.py",
        "versions": versions,
        "tolerance": {"inverse_times_sine": 8e-15, "jacobian": 1e-14, "demo": 1e-10, "limited": 2e-6},
        "inverse": inverse_cases(),
        "jacobian": jacobian_cases(),
        "demo": demo(),
        "limited": limited_cases(),
    }
    (FOLDER / "arms.json").write_text(json.dumps(content, indent=1) + "\n")


if __name__ == "__main__":
    main()
