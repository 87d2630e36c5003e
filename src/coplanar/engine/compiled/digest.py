"""What tells one law from another as they are in memory."""

from __future__ import annotations

import hashlib
from types import FunctionType

from coplanar.engine.arrays import Integral


def digest_of(*laws):
    """Of laws as they are in memory, with those they call: one may be newer or older than its file, or have none."""
    digest = hashlib.sha256()
    for law in laws:
        _add_text(law, digest, set())
    return digest.hexdigest()[:12]


def _add_text(law, digest, seen):
    seen.add(law)
    code = law.__code__
    digest.update(repr((code.co_code, code.co_consts, code.co_names)).encode())
    for name in code.co_names:
        value = law.__globals__.get(name)
        if isinstance(value, Integral):
            digest.update(str(value.points).encode())
            value = value.integrand
        if isinstance(value, FunctionType):
            if value not in seen:
                _add_text(value, digest, seen)
        elif isinstance(value, float | int | str | tuple):
            digest.update(repr((name, value)).encode())
