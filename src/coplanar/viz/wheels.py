"""What a wheeled base looks like from above."""

from __future__ import annotations

import numpy as np

from coplanar.viz.axes import Axes, axes_or_new, plane
from coplanar.wheels import WheeledBase


def plot_base(base: WheeledBase, ax: Axes | None = None) -> Axes:
    """A base from above in its own frame: wheels along their drive directions, rollers across, x forward.

    Args:
        base: Any layout.
        ax: Where to draw; a new figure if None.

    Returns:
        The axes, with what the base cannot do below the title.
    """
    ax = plane(axes_or_new(ax))
    places = np.array([(w.x, w.y) for w in base.wheels])
    reach = max(float(np.hypot(*places.T).max()), 2.0 * float(base.radii.max()))
    order = np.argsort(np.arctan2(places[:, 1], places[:, 0]))
    ax.fill(*places[order].T, alpha=0.12, linewidth=0)
    ax.annotate("", (0.8 * reach, 0.0), (0.0, 0.0), arrowprops={"arrowstyle": "->", "color": "C5"})
    for number, (wheel, radius) in enumerate(zip(base.wheels, base.radii, strict=True), 1):
        along = radius * np.array([np.cos(wheel.drive_angle), np.sin(wheel.drive_angle)])
        here = np.array([wheel.x, wheel.y])
        tyre = np.column_stack([here - along, here + along])
        ax.plot(*tyre, linewidth=9, solid_capstyle="butt", color="C0", alpha=0.8)
        if wheel.roller_angle is not None:
            free = wheel.drive_angle + 0.5 * np.pi + wheel.roller_angle
            across = 0.5 * radius * np.array([np.cos(free), np.sin(free)])
            ax.plot(*np.column_stack([here - across, here + across]), linewidth=2, color="C1")
        ax.annotate(str(number), tuple(0.72 * here), ha="center", va="center")
    ax.margins(0.25)
    if base.cannot:
        ax.set_title("; ".join(base.cannot), fontsize=9)
    return ax
