"""Every demonstration of the catalog, run, checked, drawn and written to a folder."""

from coplanar.tour.runner import run_tour

__all__ = ["run_tour"]
