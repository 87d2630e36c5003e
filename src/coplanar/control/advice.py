"""Sentences about a tracked point: what will happen, and what to do about it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from coplanar.checks import Real
from coplanar.control.stability import Stability


def tracker_warnings(
    tracker: Any, status: Any, numbers: Mapping[str, Any], lag: tuple[Real, Real], lead: float,
    *, side_ratio: float = 1.0, turn_limit: float = 1.0,
) -> tuple[str, ...]:  # fmt: skip
    """What to expect of a point tracker.

    Args:
        tracker: The ``PointTracker``.
        status: ``Stability``, or an object array of them.
        numbers: ``gain_sum`` and ``turn_per_step`` of the report.
        lag: h [s] and the largest error expected [m].
        lead: Of the plant's Butcher row.
        side_ratio: |py/px| above which v is said to be amplified [1].
        turn_limit: The turn in one step above which omega is said to be large [rad].

    Returns:
        Sentences, none if there is nothing to say; for arrays each says how many it is about.
    """
    step, error = lag
    gain, turn = numbers["gain_sum"], numbers["turn_per_step"]
    px, py, kd = tracker.px, tracker.py, tracker.kd
    ratio, omega = np.abs(py / px), tracker.omega_for(error)
    needs = "h kp + 2 kd + h^2 ki/2 is {:.6g} and has to be below 2"
    moving = np.greater(turn, 0.0) & ~np.isclose(gain, 2.0, rtol=0.0, atol=1e-6)  # not the gains, but the speed
    inside = (status == Stability.UNSTABLE) & np.less(gain, 2.0) & np.less(np.abs(kd), 1.0)
    cases = (
        ((status == Stability.BOUNDARY) & ~moving, f"on the stability boundary: {needs.format(_most(gain))}"),
        (
            (status == Stability.BOUNDARY) & moving,
            f"on the stability boundary on the move: {_on_the_move(gain, turn, lead)}",
        ),
        ((status == Stability.UNSTABLE) & np.greater_equal(gain, 2.0), f"unstable: {needs.format(_most(gain))}"),
        (np.greater_equal(np.abs(kd), 1.0), f"unstable: |kd| is {_most(np.abs(kd)):.6g} and has to be below 1"),
        (inside & np.greater(turn, 0.0), f"unstable on the move: {_on_the_move(gain, turn, lead)}"),
        (inside & np.equal(turn, 0.0), "unstable: the integral outruns the negative kd, take a smaller ki or step"),
        (np.less(px, 0.0), "px < 0: P tracks while the robot turns round and drives in reverse"),
        (np.greater(ratio, side_ratio), f"|py/px| = {_most(ratio):.3g} amplifies v: put P nearer the robot's axis"),
        (
            np.greater(step * omega, turn_limit),
            f"an error of {_most(error):.3g} m asks for |omega| = kp |e|/|px| = {_most(omega):.4g} rad/s, "
            f"{_most(step * omega):.3g} rad in one step: take a larger |px|, smaller kp or limits",
        ),
        (
            tracker.feedforward and tracker.error_against == "next",
            "feed-forward with the error against the next reference counts the reference's motion twice",
        ),
    )
    return tuple(_counted(where, sentence) for where, sentence in cases if np.any(where))


def _on_the_move(gain: Real, turn: Real, lead: float) -> str:
    """What a moving reference adds: the heading takes part, and the plant may move sideways while it turns."""
    if lead == 0.0:
        return f"h V/|px| is {_most(turn):.6g} and has to be below 2, take a smaller step or a larger |px|"
    return (
        f"h kp + 2 kd + h V/|px| is {_most(gain + turn):.6g} and has to be below 2, because the robot moves sideways "
        "while it turns; take a smaller step, smaller gains or a larger |px|"
    )


def _counted(where: Any, sentence: str) -> str:
    """The sentence, with how many of an array it is about."""
    return f"{sentence} ({np.sum(where)} of {np.size(where)})" if np.ndim(where) else sentence


def _most(value: Real) -> float:
    return float(np.max(value))
