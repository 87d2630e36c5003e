"""The Shoot tab as a program and as a scenario."""

from __future__ import annotations

import math
from typing import Any

from coplanar.flight import Aim
from coplanar.play import copying
from coplanar.play.controls import State
from coplanar.play.tabs import shoot_view


def python(state: State, aim: Aim) -> str:
    """A program with the same projectile and target."""
    n = {key: copying.number(value) for key, value in state.items() if isinstance(value, float)}
    given = "" if state["by"] == "least" else f", {state['by']}={n[state['by']]}"
    lines = [
        f"projectile = coplanar.Projectile(mass={n['mass']}, drag={n['drag']}, gravity={n['gravity']})",
        f"aim = projectile.aim(({n['target_x']}, {n['target_y']}){given})",
        "print(aim.sentence())",
    ]
    shown = [("shortfall", "aim.shortfall"), ("least_speed", "aim.least_speed")]
    shown += [("furthest", "aim.furthest")] if math.isfinite(aim.furthest) else []
    for name in shoot_view.arcs_of(aim):
        shown += [(f"{name}_{key}", f"aim.{name}.{key}") for key in ("angle", "speed", "time")]
        shown += [(f"{name}_end_{key}", f"aim.{name}.arrival().{key}") for key in ("speed", "angle")]
        shown += [(f"{name}_apex", f"aim.{name}.shot.apex().y")]
        shown += [
            (f"{name}_by_angle_{axis}", f"aim.{name}.shot.sensitivity(aim.{name}.time).by_angle[{i}]")
            for i, axis in enumerate("xy")
        ]
    return copying.program(["import coplanar"], lines, shown)


def scenario(state: State) -> dict[str, Any]:
    """The same as a scenario."""
    projectile = {key: state[key] for key in ("mass", "drag", "gravity")}
    given = {} if state["by"] == "least" else {state["by"]: state[state["by"]]}
    return {"type": "aim", "projectile": projectile, "target": [state["target_x"], state["target_y"]], **given}
