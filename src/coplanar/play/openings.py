"""What a scenario is called in the playground: from the fields of each kind to the state of a tab."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from coplanar.errors import InvalidValue
from coplanar.play.controls import State

PARTS = ("v", "omega", "a", "alpha", "duration")


def _arm(scenario: Any) -> State:
    part = scenario.arm
    n = len(part.links)
    if n not in (2, 3) or set(part.joints or "R") != {"R"} or part.angles != "relative":
        raise InvalidValue("arm", part.joints or n, "two or three revolute links with relative angles")
    state: State = {"links": str(n), "limited": part.limits is not None}
    state |= {f"l{i}": length for i, length in enumerate(part.links, 1)}
    for i, pair in enumerate(part.limits or (), 1):
        low, high = pair or (None, None)
        state |= {f"lower{i}": -math.pi if low is None else low, f"upper{i}": math.pi if high is None else high}
    return state


def _joints(values: Any) -> State:
    return {f"q{i}": q for i, q in enumerate(values or (), 1)}


def _arm_pose(scenario: Any) -> State:
    return _arm(scenario) | _joints(scenario.q) | {"follow": "joints"}


def _arm_reach(scenario: Any) -> State:
    arm, target = scenario.arm.build(), scenario.target
    answer = scenario.build().solution
    state = _arm(scenario) | _joints(answer.q.tolist()) | {"follow": "target"}
    elbow = {"elbow": "-1" if answer.elbow < 0 else "+1"} if arm.n == 2 else {}
    return state | {"target_x": target[0], "target_y": target[1]} | elbow


def _arm_trace(scenario: Any) -> State:
    near = scenario.near
    if near is None:  # the start that the trace finds by itself
        arm, curve = scenario.build()
        start = curve.position(curve.interval[0])
        near = arm.inverse(start, elbow=scenario.elbow).q.tolist()
    ways = {
        "at_singular": scenario.at_singular,
        "duration": scenario.duration,
        "follow": "joints",
        "points": scenario.points,
    }
    return _arm(scenario) | _joints(near) | _curve(scenario.curve) | ways


def _curve(part: Any) -> State:
    if part.type == "point":
        return {"curve": "point", "curve_x": part.point[0], "curve_y": part.point[1]}
    if part.type in ("spline", "polyline"):
        return {"curve": "stroke", "stroke": [list(point) for point in part.points]}
    if part.type == "line":
        (x0, y0), (x1, y1) = part.start, part.end
        half, tilt = 0.5 * math.hypot(x1 - x0, y1 - y0), math.atan2(y1 - y0, x1 - x0)
        return {"curve": "line", "size": half, "curve_x": 0.5 * (x0 + x1), "curve_y": 0.5 * (y0 + y1), "tilt": tilt}
    size = part.radius if part.type == "circle" else part.a
    return {"curve": part.type, "size": size, "curve_x": part.center[0], "curve_y": part.center[1], "tilt": part.tilt}


def _track(scenario: Any) -> State:
    integrator, loop = scenario.integrator, scenario.build()
    state = _polar(loop.controller) if scenario.controller.type == "polar" else _tracker(scenario)
    state |= {"method": integrator.method, "step": integrator.step, "duration": scenario.duration}
    if scenario.limits is not None:
        limits = scenario.limits
        state |= {"limited": True, "mode": limits.mode}
        given = {"v_limit": limits.v, "omega_limit": limits.omega}
        state |= {key: value for key, value in given.items() if value is not None}
    if loop.noise is not None:
        spreads = {f"noise_{key}": getattr(loop.noise, key) for key in ("position", "heading", "v", "omega")}
        state |= {"noisy": True, **spreads, "seed": loop.noise.seed}
    if loop.start is not None:
        start = loop.start
        state |= {"start": "free", "start_x": start.x, "start_y": start.y, "heading": start.theta}
    return state


def _tracker(scenario: Any) -> State:
    controller = scenario.controller
    state = _curve(scenario.reference.curve) | {"px": controller.point[0], "py": controller.point[1]}
    return state | {key: getattr(controller, key) for key in ("kp", "kd", "ki", "feedforward", "error_against")}


def _polar(controller: Any) -> State:
    x, y, heading = controller.goal.parts
    state = {"controller": "polar", "goal_x": x, "goal_y": y, "goal_heading": heading}
    keys = ("k_rho", "k_alpha", "k_beta", "form", "direction", "arrive_within")
    return state | {key: getattr(controller, key) for key in keys}


def _wheels(scenario: Any) -> State:
    wheels = [
        {
            "x": wheel.x, "y": wheel.y, "drive_angle": math.remainder(wheel.drive_angle, math.tau),
            "radius": wheel.radius, "kind": "ordinary" if wheel.is_ordinary else "rollers",
            "roller_angle": wheel.roller_angle or 0.0,
        }
        for wheel in scenario.base.build().wheels
    ]  # fmt: skip
    twist = {key: getattr(scenario.twist, key) for key in ("vx", "vy", "omega")}
    return {"layout": "custom", "wheels": wheels, "duration": scenario.duration, **twist, **_named(scenario.base)}


def _named(base: Any) -> State:
    """The named layout, where the playground has the same one."""
    if base.type == "differential" and base.radius is not None:
        half = base.half_track if base.half_track is not None else 0.5 * base.track
        return {"layout": "differential", "half_width": half, "radius": base.radius}
    if base.type == "omni" and base.count in (3, 4) and base.first_angle == 0.0:
        return {"layout": f"omni{base.count}", "distance": base.wheel_distance, "radius": base.radius}
    if base.type == "mecanum":
        length = base.half_length if base.half_length is not None else 0.5 * base.wheelbase
        width = base.half_width if base.half_width is not None else 0.5 * base.track
        sizes = {"half_length": length, "half_width": width, "radius": base.radius}
        return {"layout": "mecanum", "rollers": base.rollers, **sizes}
    return {}


def _program(scenario: Any) -> State:
    first, *rest = [{key: getattr(segment, key) for key in PARTS} for segment in scenario.segments]
    start = {"start_x": scenario.start.x, "start_y": scenario.start.y, "heading": scenario.start.theta}
    return {"preset": "custom", **first, "then": rest, **start, "compare": False}


def _aim(scenario: Any) -> State:
    projectile, target = scenario.build().projectile, scenario.target
    given = {} if scenario.form == "least" else {scenario.form: getattr(scenario, scenario.form)}
    flown = {"mass": projectile.mass, "drag": projectile.drag, "gravity": projectile.gravity}
    x, y = target[0] - scenario.start[0], target[1] - scenario.start[1]
    return {"by": scenario.form, **given, **flown, "target_x": x, "target_y": y}


def _lab(scenario: Any) -> State:
    start = scenario.start
    if len(scenario.segments) != 1 or (start.x, start.y, start.theta) != (0.0, 0.0, 0.0):
        raise InvalidValue("segments", len(scenario.segments), "one segment from the origin")
    return {"motion": "custom", **{key: getattr(scenario.segments[0], key) for key in PARTS}, "step": scenario.steps[0]}


OPENINGS: Mapping[str, tuple[str, Callable[[Any], State]]] = MappingProxyType(
    {
        "arm-pose": ("arm", _arm_pose), "arm-reach": ("arm", _arm_reach), "arm-trace": ("arm", _arm_trace),
        "track": ("drive", _track), "wheels": ("base", _wheels), "program": ("motion", _program),
        "aim": ("shoot", _aim), "lab": ("lab", _lab),
    }
)  # fmt: skip
