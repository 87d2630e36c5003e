"""The Drive tab as a program and as a scenario."""

from __future__ import annotations

from typing import Any

from coplanar.play import copying
from coplanar.play.controls import State
from coplanar.play.tabs import strokes

SHOWN = (
    ("margin", "report.margin"),
    ("largest_step", "report.largest_step"),
    ("last_error", "numpy.hypot(*run.errors[-1])"),
    ("largest_error", "numpy.hypot(*run.errors.T).max()"),
    ("largest_v", "abs(run['v']).max()"),
    ("largest_omega", "abs(run['omega']).max()"),
    ("end_x", "run['x'][-1]"),
    ("end_y", "run['y'][-1]"),
    ("end_theta", "run['theta'][-1]"),
)


def python(state: State) -> str:
    """A program with the same tracker, reference and run."""
    n = {key: copying.number(value) for key, value in state.items() if isinstance(value, float)}
    point = f"({n['px']}, {n['py']})"
    gains = f"kp={n['kp']}, kd={n['kd']}, ki={n['ki']}"
    how = f'feedforward={state["feedforward"]}, error_against="{state["error_against"]}"'
    rests = strokes.curve_of(state) is None
    followed = f"HeldPoint(({n['curve_x']}, {n['curve_y']}))" if rests else f"curve.over({n['duration']})"
    lines = [
        f"tracker = coplanar.PointTracker({point}, {gains}, {how})",
        *([] if rests else [f"curve = {strokes.code_of(state)}"]),
        f"reference = {followed}",
        f"start = {_start(state, n)}",
        f"limits = {_limits(state, n)}",
        "run = coplanar.simulate(",
        f"    coplanar.Unicycle(), tracker, reference, duration={n['duration']}, step={n['step']},",
        f'    method="{state["method"]}", limits=limits, start=start,',
        ")",
        f"speed = numpy.hypot(*reference.velocity(numpy.linspace(0.0, {n['duration']}, 2001)).T).max()",
        f'report = tracker.stability({n["step"]}, method="{state["method"]}", speed=speed)',
        "print(report)",
        "print(run.status.value)",
    ]
    imports = ["import numpy", "", "import coplanar"]
    imports += ["from coplanar.control import Limits"] if state["limited"] else []
    imports += ["from coplanar.curves import HeldPoint"] if rests else []
    return copying.program(imports, lines, SHOWN)


def _start(state: State, n: dict[str, str]) -> str:
    if state["start"] == "free":
        return f"coplanar.Pose({n['start_x']}, {n['start_y']}, {n['heading']})"
    return "tracker.start(reference, 0.0)"


def _limits(state: State, n: dict[str, str]) -> str:
    if not state["limited"]:
        return "None"
    return f'Limits(v={n["v_limit"]}, omega={n["omega_limit"]}, mode="{state["mode"]}")'


def scenario(state: State) -> dict[str, Any]:
    """The same as a scenario."""
    curve = strokes.data_of(state)
    tracker = {"type": "point-tracker", "point": [state["px"], state["py"]]}
    tracker |= {key: state[key] for key in ("kp", "kd", "ki", "feedforward", "error_against")}
    data: dict[str, Any] = {"type": "track"}
    if state["start"] == "free":
        data["robot"] = {"start": {"x": state["start_x"], "y": state["start_y"], "theta": state["heading"]}}
    data |= {
        "reference": {"curve": curve}, "controller": tracker,
        "integrator": {"method": state["method"], "step": state["step"]}, "duration": state["duration"],
    }  # fmt: skip
    if state["limited"]:
        data["limits"] = {"v": state["v_limit"], "omega": state["omega_limit"], "mode": state["mode"]}
    return data | {"unstable": "run"}
