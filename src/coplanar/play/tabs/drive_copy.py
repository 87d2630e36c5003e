"""The Drive tab as a program and as a scenario."""

from __future__ import annotations

from typing import Any

from coplanar.play import copying
from coplanar.play.controls import State
from coplanar.play.tabs import strokes
from coplanar.play.tabs.drive_loop import NOISE

STABILITY = (("margin", "report.margin"), ("largest_step", "report.largest_step"))
ERRORS = {
    "point": (("last_error", "numpy.hypot(*run.errors[-1])"), ("largest_error", "numpy.hypot(*run.errors.T).max()")),
    "polar": (("last_error", "run['rho'][-1]"), ("largest_error", "run['rho'].max()")),
}
RUN = (
    ("largest_v", "abs(run['v']).max()"),
    ("largest_omega", "abs(run['omega']).max()"),
    ("end_x", "run['x'][-1]"),
    ("end_y", "run['y'][-1]"),
    ("end_theta", "run['theta'][-1]"),
)
TRACKER = ("kp", "kd", "ki", "feedforward", "error_against")
POLAR = ("k_rho", "k_alpha", "k_beta", "form", "direction", "arrive_within")


def python(state: State) -> str:
    """A program with the same controller, reference and run."""
    n = {key: copying.number(value) for key, value in state.items() if isinstance(value, float)}
    polar, rests = state["controller"] == "polar", strokes.curve_of(state) is None
    lines = [*(_polar(state, n) if polar else _point(state, n, rests)), f"limits = {_limits(state, n)}"]
    lines += [f"noise = {_noise(state, n)}"] if state["noisy"] else []
    lines += [
        "run = coplanar.simulate(",
        f"    coplanar.Unicycle(), controller, reference, duration={n['duration']}, step={n['step']},",
        f'    method="{state["method"]}", limits=limits, start=start,{" noise=noise," if state["noisy"] else ""}',
        ")",
    ]
    speed = "" if polar else ", speed=speed"
    if not polar:
        lines.append(f"speed = numpy.hypot(*reference.velocity(numpy.linspace(0.0, {n['duration']}, 2001)).T).max()")
    lines.append(f'report = controller.stability({n["step"]}, method="{state["method"]}"{speed})')
    imports = ["import numpy", "", "import coplanar"]
    imports += ["from coplanar.control import Limits"] if state["limited"] else []
    imports += ["from coplanar.curves import HeldPoint"] if rests and not polar else []
    imports += ["from coplanar.simulation import Noise"] if state["noisy"] else []
    lines += ["print(report)", "print(run.status.value)"]
    return copying.program(imports, lines, (*STABILITY, *ERRORS[state["controller"]], *RUN))


def _point(state: State, n: dict[str, str], rests: bool) -> list[str]:
    gains = f"kp={n['kp']}, kd={n['kd']}, ki={n['ki']}"
    how = f'feedforward={state["feedforward"]}, error_against="{state["error_against"]}"'
    followed = f"HeldPoint(({n['curve_x']}, {n['curve_y']}))" if rests else f"curve.over({n['duration']})"
    free = state["start"] == "free"
    return [
        f"controller = coplanar.PointTracker(({n['px']}, {n['py']}), {gains}, {how})",
        *([] if rests else [f"curve = {strokes.code_of(state)}"]),
        f"reference = {followed}",
        f"start = {_pose(n) if free else 'controller.start(reference, 0.0)'}",
    ]


def _polar(state: State, n: dict[str, str]) -> list[str]:
    goal = f"coplanar.Pose({n['goal_x']}, {n['goal_y']}, {n['goal_heading']})"
    gains = f"{n['k_rho']}, {n['k_alpha']}, {n['k_beta']}"
    how = f'form="{state["form"]}", direction="{state["direction"]}", arrive_within={n["arrive_within"]}'
    return [
        f"controller = coplanar.PolarController({goal}, {gains}, {how})",
        "reference = None",
        f"start = {_pose(n)}",
    ]


def _pose(n: dict[str, str]) -> str:
    return f"coplanar.Pose({n['start_x']}, {n['start_y']}, {n['heading']})"


def _limits(state: State, n: dict[str, str]) -> str:
    if not state["limited"]:
        return "None"
    return f'Limits(v={n["v_limit"]}, omega={n["omega_limit"]}, mode="{state["mode"]}")'


def _noise(state: State, n: dict[str, str]) -> str:
    spreads = ", ".join(f"{key}={n[f'noise_{key}']}" for key in NOISE)
    return f"Noise({spreads}, seed={round(state['seed'])})"


def scenario(state: State) -> dict[str, Any]:
    """The same as a scenario."""
    polar = state["controller"] == "polar"
    data: dict[str, Any] = {"type": "track"}
    if polar or state["start"] == "free":
        data["robot"] = {"start": {"x": state["start_x"], "y": state["start_y"], "theta": state["heading"]}}
    if polar:
        goal = {"x": state["goal_x"], "y": state["goal_y"], "theta": state["goal_heading"]}
        data["controller"] = {"type": "polar", "goal": goal} | {key: state[key] for key in POLAR}
    else:
        data["reference"] = {"curve": strokes.data_of(state)}
        tracker = {"type": "point-tracker", "point": [state["px"], state["py"]]}
        data["controller"] = tracker | {key: state[key] for key in TRACKER}
    data |= {"integrator": {"method": state["method"], "step": state["step"]}, "duration": state["duration"]}
    if state["limited"]:
        data["limits"] = {"v": state["v_limit"], "omega": state["omega_limit"], "mode": state["mode"]}
    if state["noisy"]:
        data["noise"] = {key: state[f"noise_{key}"] for key in NOISE} | {"seed": round(state["seed"])}
    return data | {"unstable": "run"}
