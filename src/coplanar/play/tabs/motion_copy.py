"""The Motion tab as a program and as a scenario."""

from __future__ import annotations

from coplanar.errors import InvalidInput
from coplanar.motion import Segment
from coplanar.play import copying
from coplanar.play.controls import State

SHOWN = (
    ("end_x", "end.x"),
    ("end_y", "end.y"),
    ("end_theta", "end.theta"),
    ("duration", "program.duration"),
)
STEPPED = '''
def stepped(method):
    """The last pose by an integrator, each segment in equal steps of at most STEP."""
    pose = start.as_array()
    for segment in program:
        count = math.ceil(segment.duration / STEP - 1e-9)
        t = numpy.linspace(0.0, segment.duration, count + 1)
        rates = lambda time, now: segment.twist(time).in_world(now[2])
        pose = coplanar.integrate_ode(rates, t, pose, method=method)[-1]
    return pose
'''


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
    lines += [f"STEP = {copying.number(state['step'])}", "", STEPPED]
    apart = [
        (f"apart_{method}", f'math.hypot(*(stepped("{method}")[:2] - end.position))') for method in ("euler", "rk4")
    ]
    return copying.program(["import math", "", "import numpy", "", "import coplanar"], lines, (*SHOWN, *apart))


def yaml(_state: State) -> str:
    """A scenario of the same."""
    raise InvalidInput("as", "yaml", "python", "scenarios of this tab are not written yet")
