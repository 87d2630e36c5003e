"""Every system on its demonstration, run, checked, drawn and written to a folder."""

from coplanar.tour.demo import Demo
from coplanar.tour.demos import DEMOS
from coplanar.tour.runner import run_tour

__all__ = ["DEMOS", "Demo", "run_tour"]
