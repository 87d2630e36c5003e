"""The Motion tab as a program and as a scenario."""

from __future__ import annotations

from typing import Any

from coplanar.motion import Segment
from coplanar.play import copying
from coplanar.play.controls import State

SHOWN = (
    ("end_x", "end.x"),
    ("end_y", "end.y"),
    ("end_theta", "end.theta"),
    ("duration", "program.duration"),
)


def python(state: State, segments: list[Segment]) -> str:
    """A program with the same segments."""
    start = copying.numbers((state["start_x"], state["start_y"], state["heading"]))
    rows = [
        f"    coplanar.Segment({copying.numbers(s.parts[:4])[1:-1]}, duration={copying.number(s.duration)}),"
        for s in segments
    ]
    lines = [f"start = coplanar.Pose{start}", "program = coplanar.Program([", *rows, "])", "end = program.end(start)"]
    lines.append("print([segment.kind for segment in program])")
    if not state["compare"]:
        return copying.program(["import coplanar"], lines, SHOWN)
    step = copying.number(state["step"])
    lines.append(f"compared = Comparison(program, start, ('euler', 'rk4'), [{step}])")
    apart = [
        (f"apart_{method}", f'numpy.hypot(*(compared.path("{method}", {step})[1].position[-1] - end.position))')
        for method in ("euler", "rk4")
    ]
    imports = ["import numpy", "", "import coplanar", "from coplanar.motion import Comparison"]
    return copying.program(imports, lines, (*SHOWN, *apart))


def scenario(state: State, segments: list[Segment]) -> dict[str, Any]:
    """The same as a scenario."""
    rows = [dict(zip(("v", "omega", "a", "alpha", "duration"), segment.parts, strict=True)) for segment in segments]
    start = {"x": state["start_x"], "y": state["start_y"], "theta": state["heading"]}
    return {"type": "program", "segments": rows, "start": start}
