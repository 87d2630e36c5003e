"""Root finders that show their work: a status that is a sentence, a residual anybody can recompute, every iteration.

``bracketed_root`` finds a root between two ends, for a float or for arrays of brackets; ``least_squares`` solves
small systems, one or a batch, by damped least squares or Newton.
"""

from coplanar.solving.report import Iteration, Report
from coplanar.solving.roots import RootResult, bracketed_root
from coplanar.solving.squares import LeastSquaresResult, least_squares
from coplanar.solving.status import Status, code_of, count_by_status, status_of

__all__ = [
    "Iteration",
    "LeastSquaresResult",
    "Report",
    "RootResult",
    "Status",
    "bracketed_root",
    "code_of",
    "count_by_status",
    "least_squares",
    "status_of",
]
