"""Arms that follow curves: joints by continuity, with a certificate of the branch or the interval where it fails."""

from coplanar.tracing.follow import trace
from coplanar.tracing.result import Certificate, Failure, Reason, SingularPoint, Trace, TraceStatus

__all__ = ["Certificate", "Failure", "Reason", "SingularPoint", "Trace", "TraceStatus", "trace"]
