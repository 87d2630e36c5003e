"""The Arm tab as a program and as a scenario."""

from __future__ import annotations

from typing import Any

from coplanar.arms import Arm
from coplanar.curves import Curve
from coplanar.play import copying
from coplanar.play.controls import State
from coplanar.play.tabs import strokes

PROOF = ("smallest_conditioning", "largest_step", "position_error")


def python(state: State, arm: Arm, curve: Curve | None) -> str:
    """A program with the same arm, target or curve."""
    limits = "" if arm.limits is None else f", limits=[{', '.join(map(copying.numbers, arm.limits))}]"
    lines = [f"arm = coplanar.Arm({copying.numbers(arm.links)}{limits})"]
    q = copying.numbers(state[f"q{i}"] for i in range(1, arm.n + 1))
    if curve is not None:
        points = round(state["points"])
        lines += [
            f"curve = {strokes.code_of(state)}",
            f"followed = coplanar.trace(arm, curve, {points}, near={q}, at_singular={state['at_singular']!r})",
            "print(followed)",
        ]
        return copying.program(["import coplanar"], lines, [(key, f"followed.certificate.{key}") for key in PROOF])
    if state["follow"] == "joints":
        lines.append(f"q = {q}")
    else:
        elbow = f", elbow={int(state['elbow'])}" if arm.n == 2 else ""
        target = copying.numbers((state["target_x"], state["target_y"]))
        lines += [f"answer = arm.inverse({target}, near={q}{elbow})", "print(answer.sentence())", "q = answer.q"]
    lines += ['tool, jacobian = arm.kinematics(q, task="position")']
    shown = [(f"q{i}", f"q[{i - 1}]") for i in range(1, arm.n + 1)]
    shown += [(key, f"tool.{key}") for key in ("x", "y", "theta")]
    shown += [(f"j{i}{j}", f"jacobian[{i - 1}, {j - 1}]") for i in (1, 2) for j in range(1, arm.n + 1)]
    shown.append(("w", "arm.manipulability(q)"))
    return copying.program(["import coplanar"], lines, shown)


def scenario(state: State, arm: Arm, curve: Curve | None) -> dict[str, Any]:
    """The same as a scenario: the arm's pose, its reach for the target, or its way along the curve."""
    drawn: dict[str, Any] = {"links": list(arm.links)}
    if arm.limits is not None:
        drawn["limits"] = [list(pair) for pair in arm.limits]
    q = [state[f"q{i}"] for i in range(1, arm.n + 1)]
    if curve is not None:
        way = {
            "points": round(state["points"]),
            "near": q,
            "at_singular": state["at_singular"],
            "duration": state["duration"],
        }
        return {"type": "arm-trace", "arm": drawn, "curve": strokes.data_of(state), **way}
    if state["follow"] == "joints":
        return {"type": "arm-pose", "arm": drawn, "q": q}
    target = {"target": [state["target_x"], state["target_y"]], "near": q}
    elbow = {"elbow": int(state["elbow"])} if arm.n == 2 else {}
    return {"type": "arm-reach", "arm": drawn, **target, **elbow}
