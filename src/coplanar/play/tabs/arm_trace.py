"""An arm on its way along a curve, with what the trace certifies."""

from __future__ import annotations

import numpy as np

from coplanar.curves import Curve
from coplanar.play.answer import Answer, Handle
from coplanar.play.controls import State
from coplanar.play.tabs import arm_view
from coplanar.tracing import Failure, Trace
from coplanar.tracing.result import TraceStatus
from coplanar.viz.scene import Scene

WANTED = 161  # points of the curve as it is drawn
TONES = {TraceStatus.FOLLOWED: "good", TraceStatus.PASSED: "note", TraceStatus.FAILED: "no"}


def show(answer: Answer, followed: Trace, state: State) -> None:
    """The animation, the joints in time, the certificate."""
    run = followed.as_run(state["duration"])
    still = arm_view.background(followed.arm, live=True)
    wanted = followed.curve.position(followed.curve.parameters(WANTED))
    scene = Scene(run.t, still.layers, view=still.view).curve(wanted, dashed=True)
    for failure in followed.failures:
        scene = scene.curve(_part(followed, failure), role="no")
    scene = scene.linkage(followed.arm.points(followed.q)).trail(run.stacked("x", "y"))
    answer.pictures["main"] = scene
    _handle(answer, state)
    joints = {f"q{i}": run[f"q{i}"] for i in range(1, followed.arm.n + 1)}
    answer.plot("Joints", "rad", ("time [s]", run.t), joints)
    answer.plot("Distance from the curve", "m", ("time [s]", run.t), {"error": followed.position_error()})
    _read(answer, followed)
    _say(answer, followed)


def outline(answer: Answer, curve: Curve, state: State, lost: np.ndarray | None) -> None:
    """The curve alone over an arm that stands still, with the places that no posture reaches, shape (n, 2)."""
    scene = answer.pictures["main"].curve(curve.position(curve.parameters(WANTED)), dashed=True)
    if lost is not None:
        scene = scene.cross(lost.reshape(1, -1), role="no", size=4.0)
        share = 100.0 * len(lost) / round(state["points"])
        answer.sentences = []
        answer.say("no", f"no posture within the limits reaches {share:.3g} % of the curve: the arm cannot follow it")
    answer.pictures["main"] = scene
    answer.handles = []
    _handle(answer, state)


def _handle(answer: Answer, state: State) -> None:
    if state["curve"] != "stroke":
        centre = (state["curve_x"], state["curve_y"])
        answer.handles.append(Handle("curve", "Curve: drag its centre", centre))


def _part(followed: Trace, failure: Failure) -> np.ndarray:
    """The part of the curve that is not followed."""
    return followed.curve.position(np.linspace(failure.first, failure.last, 41))


def _read(answer: Answer, followed: Trace) -> None:
    proof = followed.certificate
    if proof.smallest_sine is not None:
        answer.read("smallest_sine", "smallest |sin q2|", proof.smallest_sine, "", "Certificate")
    answer.read("smallest_conditioning", "smallest / largest", proof.smallest_conditioning, "", "Certificate")
    answer.read("largest_step", "largest joint step", proof.largest_step, "rad", "Certificate")
    answer.read("limit_margin", "margin to a limit", proof.limit_margin, "rad", "Certificate")
    answer.read("position_error", "largest distance", proof.position_error, "m", "Certificate")


def _say(answer: Answer, followed: Trace) -> None:
    answer.say(TONES[followed.status], followed.status.value)
    for failure in followed.failures:
        answer.say("no", f"curve parameter {failure}")
    for place in followed.singular_points:
        turn = f"; the first joint turns by {place.turn:.4g} rad there" if place.turn else ""
        answer.say("warn", f"branches meet at curve parameter {place.parameter:.6g}: {place.kind}{turn}")
    if followed.arm.limits is not None and followed.certificate.limits_kept:
        answer.say("good", "every joint keeps its limits")
