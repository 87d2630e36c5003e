"""Where it ran: processor, versions, threads, how busy the machine was."""

from __future__ import annotations

import os
import platform
from importlib import metadata
from pathlib import Path

OURS = ("coplanar", "numpy", "numba", "llvmlite")


def processor() -> str:
    """Name of the processor, and whether it has the wide vectors that matter to the compiled loops."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    fields = {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in lines)}
    flags = fields.get("flags", "").split()
    wide = next((name for name in ("avx512f", "avx2", "sse4_2") if name in flags), platform.machine())
    return f"{fields.get('model name', platform.machine())}, {wide}"


def description() -> list[tuple[str, str]]:
    """Lines of a small table: what, value."""
    from numba import config

    load = "/".join(f"{value:.1f}" for value in os.getloadavg()) if hasattr(os, "getloadavg") else "unknown"
    return [
        ("processor", processor()),
        (
            "cores",
            f"{os.cpu_count()}; compiled loops on 1 or {config.NUMBA_NUM_THREADS} threads, as each row says",
        ),
        ("system", f"{platform.system()} {platform.release()}, Python {platform.python_version()}"),
        ("load average", f"{load} over 1/5/15 min when the run began; the benchmark itself is about 1"),
        ("versions", ", ".join(f"{name} {metadata.version(name)}" for name in OURS)),
    ]
