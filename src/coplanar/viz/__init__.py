"""What things look like: ``plot_x(thing, ax=None) -> ax`` in Matplotlib, and scenes for the canvas player.

Nothing here shows a window or waits for one; everything works without a screen.
"""

from coplanar.viz.axes import plot_headings, plot_linkage, plot_path, plot_series
from coplanar.viz.control import plot_poles
from coplanar.viz.flight import plot_envelope, plot_shot
from coplanar.viz.scene import Scene
from coplanar.viz.style import drawn_in
from coplanar.viz.wheels import plot_base

__all__ = [
    "Scene",
    "drawn_in",
    "plot_base",
    "plot_envelope",
    "plot_headings",
    "plot_linkage",
    "plot_path",
    "plot_poles",
    "plot_series",
    "plot_shot",
]
