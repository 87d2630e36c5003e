"""Where compiled loops are kept between runs: one folder per state of the sources.

Numba's own cache looks only at the file that holds the loop, so it would go on answering with an old law after an edit.
Here the folder's name is a hash of every source that can matter; a folder that cannot be written means no cache, not an
error.
"""

from __future__ import annotations

import functools
import hashlib
import os
import tempfile
import threading
from contextlib import contextmanager
from pathlib import Path

import numba
from numba.core import config
from numba.misc.appdirs import user_cache_dir

_lock = threading.Lock()


def folder():
    """The cache folder of these sources, or None if none can be written just now.

    ``COPLANAR_CACHE`` names another place than the user's cache folder.
    """
    root = Path(os.environ.get("COPLANAR_CACHE") or user_cache_dir("coplanar"))
    path = root / f"numba-{_fingerprint()}"
    try:
        path.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path):
            return path
    except OSError:
        return None


@contextmanager
def in_folder():
    """Numba places the functions that are decorated in this block into the cache folder; yields whether it may."""
    path = folder()
    with _lock:
        before = config.CACHE_DIR
        config.CACHE_DIR = str(path or "")
        try:
            yield path is not None
        finally:
            config.CACHE_DIR = before


@functools.cache
def _fingerprint():
    package = Path(__file__).parents[2]
    digest = hashlib.sha256(numba.__version__.encode())
    for source in sorted([*package.glob("laws/**/*.py"), *package.glob("engine/**/*.py")]):
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]
