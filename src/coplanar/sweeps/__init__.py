"""Many runs: a grid or random draws over any keys of a scenario, measured in batches, shared among workers.

``sweep("track-astroid", {"controller.kp": [50, 100], "controller.kd": "0:0.4:5"})`` gives a ``Sweep``: one row a run.
"""

from coplanar.sweeps.result import Sweep
from coplanar.sweeps.sweeping import sweep
from coplanar.sweeps.vary import Normal, Uniform, Values, read_vary

__all__ = ["Normal", "Sweep", "Uniform", "Values", "read_vary", "sweep"]
