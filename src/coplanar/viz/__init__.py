"""What things look like: ``plot_x(thing, ax=None) -> ax`` in Matplotlib, scenes for the canvas player, animations.

Nothing here shows a window or waits for one; everything works without a screen. A picture that is given no axes makes
a figure of its own: ``ax.figure.savefig("picture.png")`` writes it.
"""

from coplanar.viz.animation import animate
from coplanar.viz.arms import plot_arm, plot_ellipse, plot_reach, plot_workspace
from coplanar.viz.axes import plot_headings, plot_linkage, plot_path, plot_series
from coplanar.viz.control import plot_poles
from coplanar.viz.flight import plot_envelope, plot_flight, plot_shot, plot_shots
from coplanar.viz.frames import plot_frames
from coplanar.viz.integrators import plot_convergence, plot_integrators
from coplanar.viz.motion import plot_holonomic, plot_program, plot_ramp, plot_segment, plot_velocities
from coplanar.viz.player import Player
from coplanar.viz.runs import plot_columns, plot_commands, plot_errors, plot_run, plot_track
from coplanar.viz.scene import Scene
from coplanar.viz.scenes import scene_of_run
from coplanar.viz.style import drawn_in
from coplanar.viz.traces import plot_joints, plot_trace
from coplanar.viz.wheels import plot_base, plot_icr, plot_rolling

__all__ = [
    "Player",
    "Scene",
    "animate",
    "drawn_in",
    "plot_arm",
    "plot_base",
    "plot_columns",
    "plot_commands",
    "plot_convergence",
    "plot_ellipse",
    "plot_envelope",
    "plot_errors",
    "plot_flight",
    "plot_frames",
    "plot_headings",
    "plot_holonomic",
    "plot_icr",
    "plot_integrators",
    "plot_joints",
    "plot_linkage",
    "plot_path",
    "plot_poles",
    "plot_program",
    "plot_ramp",
    "plot_reach",
    "plot_rolling",
    "plot_run",
    "plot_segment",
    "plot_series",
    "plot_shot",
    "plot_shots",
    "plot_trace",
    "plot_track",
    "plot_velocities",
    "plot_workspace",
    "scene_of_run",
]
