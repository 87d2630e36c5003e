"""The Drive tab as a program and as a scenario."""

from __future__ import annotations

from coplanar.errors import InvalidInput
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
        "speed = numpy.hypot(*reference.velocity(run.t).T).max()",
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


def yaml(_state: State) -> str:
    """A scenario of the same."""
    raise InvalidInput("as", "yaml", "python", "scenarios of this tab are not written yet")
