"""What the outcome of a scenario looks like: a figure for every kind, and a moving scene where something moves."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from coplanar.scenarios import Outcome
from coplanar.viz.outcomes import arms, driving, flight, tracking, wheels
from coplanar.viz.scene import Scene

__all__ = ["figure_of", "scene_of"]

_FIGURES: Mapping[str, Callable[[Outcome, Any], None]] = MappingProxyType(
    {
        "frames": arms.draw_frames, "arm-pose": arms.draw_pose, "arm-reach": arms.draw_reach,
        "arm-trace": arms.draw_trace, "rolling-wheel": wheels.draw_rolling, "wheels": wheels.draw_base,
        "drive": driving.draw_drive, "program": driving.draw_program, "holonomic": driving.draw_holonomic,
        "ramp": driving.draw_ramp, "lab": driving.draw_lab, "track": tracking.draw_track, "shot": flight.draw_shot,
        "aim": flight.draw_aim,
    }
)  # fmt: skip
_SCENES: Mapping[str, Callable[[Outcome], Scene | None]] = MappingProxyType(
    {
        "arm-reach": arms.reach_scene, "arm-trace": arms.trace_scene, "rolling-wheel": wheels.rolling_scene,
        "wheels": wheels.base_scene, "drive": driving.path_scene, "program": driving.path_scene,
        "holonomic": driving.holonomic_scene, "ramp": driving.ramp_scene, "track": tracking.track_scene,
        "shot": flight.shot_scene, "aim": flight.aim_scene,
    }
)  # fmt: skip


def figure_of(outcome: Outcome, figure: Any = None) -> Any:
    """The figure of an outcome.

    Args:
        outcome: What a scenario gave.
        figure: A Matplotlib figure to draw on; a new one if None.

    Returns:
        The figure.
    """
    if figure is None:
        from matplotlib.figure import Figure

        figure = Figure(figsize=(7.2, 4.6), layout="constrained")
    _FIGURES[outcome.scenario.type](outcome, figure)
    return figure


def scene_of(outcome: Outcome) -> Scene | None:
    """The moving picture of an outcome; None where nothing moves.

    Example:
        >>> from coplanar.scenarios import load
        >>> scene_of(load("arm-pose").run()) is None
        True
    """
    maker = _SCENES.get(outcome.scenario.type)
    return maker(outcome) if maker else None
