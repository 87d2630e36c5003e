"""Files of other programs: runs out and in as logs, paths, trajectories and arms in.

``write_log`` and ``read_log`` go by the suffix: CSV, JSON and WPILOG as they are, MCAP and Parquet with the extra
``logs``. What cannot be read is refused with the file and the place in it; every file appears whole or not at all.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from coplanar.lazy import names_of

if TYPE_CHECKING:
    from coplanar.logs.choreo import read_choreo
    from coplanar.logs.formats import FORMATS, read_log, write_log
    from coplanar.logs.paths import Waypoints, read_path
    from coplanar.logs.urdf import UrdfArm, read_urdf
    from coplanar.logs.urdf_writing import write_urdf

__all__ = [
    "FORMATS",
    "UrdfArm",
    "Waypoints",
    "read_choreo",
    "read_log",
    "read_path",
    "read_urdf",
    "write_log",
    "write_urdf",
]

__getattr__, __dir__ = names_of(
    __name__,
    {
        "choreo": "read_choreo",
        "formats": "FORMATS read_log write_log",
        "paths": "Waypoints read_path",
        "urdf": "UrdfArm read_urdf",
        "urdf_writing": "write_urdf",
    },
)
