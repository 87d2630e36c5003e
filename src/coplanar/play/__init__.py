"""The playground: every system under the hand, in a browser. All mathematics is the library's.

``Session`` answers messages and knows nothing of sockets; the page draws what it says.
"""

from coplanar.play.session import Session

__all__ = ["Session"]
