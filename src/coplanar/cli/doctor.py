"""What there is to work with on this machine."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

from coplanar.cli.answers import Answer, Fact, give
from coplanar.cli.arguments import Json

NEEDED = {  # what an extra brings, by the names of its distributions
    "logs": ("mcap", "mcap-ros2-support", "pyarrow"),
    "video": ("imageio-ffmpeg",),
    "cluster": ("dask", "distributed"),
    "jax": ("jax",),
    "symbolic": ("sympy",),
}
BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome", "msedge")
LIBRARIES = (
    "numpy",
    "scipy",
    "matplotlib",
    "pydantic",
    "pyyaml",
    "typer",
    "rich",
    "starlette",
    "uvicorn",
    "websockets",
)


def doctor(as_json: Json = False) -> None:
    """What there is to work with on this machine.

    Versions, processors, compiler and its cache, extras; the exit code is 1 if something needed is missing.
    """
    import platform

    from coplanar.version import __version__

    missing = [name for name in LIBRARIES if _version(name) is None]
    compiler, warnings = _compiler()
    facts = (
        Fact("coplanar", __version__),
        Fact("python", f"{platform.python_version()} ({platform.python_implementation()}), {sys.executable}"),
        Fact("system", f"{platform.system()} {platform.release()}, {platform.machine()}"),
        *_processor(),
        Fact("libraries", [{"library": name, "version": _version(name)} for name in LIBRARIES]),
        *compiler,
        Fact("extras", list(_extras())),
        Fact("browser", _browser()),
    )
    status = f"missing: {', '.join(missing)}; run  pip install coplanar" if missing else "everything needed is here"
    give(Answer(status, facts, not missing, warnings), as_json)


def _version(distribution: str) -> str | None:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version(distribution)
    except PackageNotFoundError:
        return None


def _processor() -> Iterator[Fact]:
    """How many processors this process may use, and the vector instructions that NumPy found."""
    import os

    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    yield Fact("processors", usable)
    try:
        import numpy as np

        found: dict[str, Any] = np.show_config(mode="dicts")  # type: ignore[assignment]
        extensions = found.get("SIMD Extensions", {})
        yield Fact("vector instructions", [*extensions.get("baseline", []), *extensions.get("found", [])])
    except ImportError:
        return


def _compiler() -> tuple[tuple[Fact, ...], tuple[str, ...]]:
    """Numba, and the folder that keeps compiled loops between runs."""
    import importlib

    try:
        from coplanar.engine import can_compile
    except ImportError:  # NumPy itself is missing
        return (), ()
    if not can_compile():
        return (Fact("numba", None),), ("without Numba batches are answered by NumPy: several times more slowly",)
    place = importlib.import_module("coplanar.engine.compiled.cache").folder()
    facts = (
        Fact("numba", _version("numba")),
        Fact("cache folder", None if place is None else str(place)),
        Fact("cache loops", 0 if place is None else sum(1 for _ in place.rglob("*.nbi"))),
    )
    advice = "no cache folder can be written: loops are compiled anew in every run; set COPLANAR_CACHE to a folder"
    return facts, () if place is not None else (advice,)


def _extras() -> Iterator[dict[str, Any]]:
    """Each extra, and the command that adds it where it is absent."""
    for extra, parts in NEEDED.items():
        versions = {part: _version(part) for part in parts}
        here = all(versions.values())
        found = ", ".join(f"{part} {number}" for part, number in versions.items() if number)
        yield {
            "extra": extra, "present": here, "found": found or None,
            "add": None if here else f"pip install 'coplanar[{extra}]'",
        }  # fmt: skip


def _browser() -> str | None:
    """A browser that the playground can be tried with headlessly."""
    from shutil import which

    return next((path for path in map(which, BROWSERS) if path), None)
