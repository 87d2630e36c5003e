"""How a run shows itself: figure, animation, notebook.

Pictures and logs are above runs. What is here reaches up when it is called, as ``coplanar`` itself imports on demand,
so that a run costs no Matplotlib until somebody looks at it.
"""

from __future__ import annotations

import importlib
import os
from pathlib import Path
from typing import Any

from coplanar.errors import InvalidInput


class Shown:
    """The methods by which a ``Run`` is looked at and saved."""

    __slots__ = ()

    def plot(self, figure: Any = None, **options: Any) -> Any:
        """Everything there is to see of the run in one figure; see ``coplanar.viz.plot_run``.

        Args:
            figure: Matplotlib's; a new one if None.
            **options: ``reference``, ``point``.

        Returns:
            The figure; ``.savefig("run.png")`` writes it.
        """
        return importlib.import_module("coplanar.viz").plot_run(self, figure, **options)

    def animate(self, path: str | os.PathLike[str] | None = None, **options: Any) -> Any:
        """Write the run as .gif, .mp4 or .html; without a path a player that shows itself in a notebook.

        Args:
            path: Where to write; see ``coplanar.viz.animate``.
            **options: ``arm``, ``reference``, ``point``, ``radius``; for files also ``fps``, ``size``, ``theme`` and
                others of ``coplanar.viz.animate``.

        Returns:
            The path that was written, or the player.
        """
        viz = importlib.import_module("coplanar.viz")
        return viz.Player(viz.scene_of_run(self, **options)) if path is None else viz.animate(self, path, **options)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the run as what the suffix says: .csv, .json, .wpilog, .mcap or .parquet; see ``coplanar.logs``.

        Returns:
            Where it was written.

        Raises:
            UnknownName: If the suffix is another.
            InvalidShape: If the format holds one robot and this is a batch.
            MissingExtra: If the format needs a package that is not installed.
        """
        written: Path = importlib.import_module("coplanar.logs").write_log(self, path)
        return written

    def _repr_html_(self) -> str | None:
        """For notebooks: the player, or None where there is nothing to play."""
        try:
            shown: str = self.animate()._repr_html_()
        except InvalidInput:
            return None
        return shown
