"""A run on disk: a folder with the scenario as it was run, its numbers, its figures.

``scenario.yaml`` has every default filled in; ``run.csv`` and further tables, 17 digits (``motion.csv`` where the run
over time is another table); ``figure-light.svg`` and
``figure-dark.svg``; ``summary.json``. The folder appears whole or not at all.
"""

from coplanar.store.folders import whole_folder
from coplanar.store.record import Record, is_record, read_record, write_record

__all__ = ["Record", "is_record", "read_record", "whole_folder", "write_record"]
