"""The playground: a page in the browser whose mathematics is the library's, served on this machine only."""

from coplanar.play.app import play
from coplanar.play.session import Session

__all__ = ["Session", "play"]
