"""The Lab tab as a program and as a scenario."""

from __future__ import annotations

from typing import Any

from coplanar.play import copying
from coplanar.play.controls import State
from coplanar.play.tabs.problems import COUNTS, METHODS_SHOWN, Problem

SHOT = '''
def rates(t, state):
    """Velocity and acceleration of a shot with quadratic drag."""
    x, y, vx, vy = state
    return numpy.array([vx, vy, *drag_rates(vx, vy, projectile.drag_per_mass, projectile.gravity)])
'''
SEGMENT = '''
def rates(t, pose):
    """Pose rates of a body that moves with the segment's velocity."""
    return segment.twist(t).in_world(pose[2])
'''


def python(state: State, count: int, problem: Problem) -> str:
    """A program with the same motion and steps."""
    n = {key: copying.number(value) for key, value in state.items() if isinstance(value, float)}
    imports = ["import numpy", "", "import coplanar"]
    if state["motion"] == "shot":
        imports.append("from coplanar.laws.flight import drag_rates")
        lines = [
            f"projectile = coplanar.Projectile(mass=1.0, drag={n['drag']})",
            f"shot = projectile.launch(speed={n['speed']}, angle={n['angle']})",
            "start = [0.0, 0.0, shot.vx, shot.vy]",
            f"exact = shot.at({n['duration']}).position",
            "", SHOT,
        ]  # fmt: skip
    else:
        parts = ", ".join(n[key] for key in ("v", "omega", "a", "alpha"))
        lines = [
            f"segment = coplanar.Segment({parts}, duration={n['duration']})",
            "start = [0.0, 0.0, 0.0]",
            "exact = segment.end(coplanar.Pose()).position",
            "", SEGMENT,
        ]  # fmt: skip
    lines += [
        f"t = numpy.linspace(0.0, {n['duration']}, {count + 1})",
        "ends = {",
        f"    method: coplanar.integrate_ode(rates, t, start, method=method)[-1, :2] for method in {METHODS_SHOWN!r}",
        "}",
    ]
    able = [method for method in METHODS_SHOWN if problem.points(method, count) is not None]
    if len(able) < len(METHODS_SHOWN):
        lines[-2] = lines[-2].replace(repr(METHODS_SHOWN), repr(tuple(able)))
    shown = [(f"apart_{m}", f'numpy.hypot(*(ends["{m}"] - exact))') for m in able]
    if state["motion"] != "shot":
        imports.append("from coplanar.motion import Comparison")
        steps = f"[{n['duration']} / count for count in {COUNTS!r}]"
        lines += [
            "program = coplanar.Program([segment])",
            f"compared = Comparison(program, coplanar.Pose(), {METHODS_SHOWN!r}, {steps})",
            'print("orders", compared.orders())',
        ]
    return copying.program(imports, lines, shown)


def scenario(state: State) -> dict[str, Any]:
    """The same as a scenario: the integrators of a driven motion, or a shot."""
    if state["motion"] == "shot":
        launch = {"speed": state["speed"], "angle": state["angle"]}
        projectile = {"mass": 1.0, "drag": state["drag"]}
        return {"type": "shot", "projectile": projectile, "launch": launch, "duration": state["duration"]}
    segment = {key: state[key] for key in ("v", "omega", "a", "alpha", "duration")}
    return {
        "type": "lab", "segments": [segment], "methods": list(METHODS_SHOWN),
        "steps": sorted({state["step"], *(state["duration"] / count for count in COUNTS[1:7])}),
    }  # fmt: skip
