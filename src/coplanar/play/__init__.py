"""The playground: every system under the hand, in a browser. All mathematics is the library's.

``Session`` answers messages and knows nothing of sockets; the page draws what it says. ``play`` serves both, on this
machine only unless it is told otherwise.
"""

from coplanar.play.app import play
from coplanar.play.session import Session

__all__ = ["Session", "play"]
