"""How a generator writes its golden file: ``tests/truth/<topic>.json``, read back by ``tests/truth/golden.py``.

A generator is a script ``tools/truth_<topic>.py`` that computes cases by mpmath, SymPy or another library, never by
Coplanar, and ends with ``write(__file__, cases, ...)``. Run it from anywhere: ``python tools/truth_<topic>.py``.
"""

from __future__ import annotations

import json
import platform
from collections.abc import Iterable, Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any

TRUTH = Path(__file__).parents[1] / "tests" / "truth"


def write(
    generator: str,
    cases: Iterable[Mapping[str, Any]],
    *,
    packages: Iterable[str],
    tolerance: str | float | Mapping[str, float],
    unit: str,
) -> Path:
    """Write the golden file of a generator; the topic is the generator's name without ``truth_``.

    Args:
        generator: ``__file__`` of the script.
        cases: One mapping a case, of floats, strings and lists of them; floats are written so that they read back
            to the same bits.
        packages: Distribution names whose versions are noted.
        tolerance: What a test may ask for: a number, numbers by name, or a sentence.
        unit: In which units the numbers are, for instance "m, rad, s".

    Returns:
        Where the file is.
    """
    script = Path(generator)
    head = {
        "generator": f"tools/{script.name}",
        "versions": {"python": platform.python_version(), **{name: version(name) for name in sorted(packages)}},
        "tolerance": tolerance,
        "unit": unit,
    }
    lines = [json.dumps(case, allow_nan=False) for case in cases]
    path = TRUTH / f"{script.stem.removeprefix('truth_')}.json"
    start = json.dumps(head, indent=1).removesuffix("\n}")
    path.write_text(f'{start},\n "cases": [\n  ' + ",\n  ".join(lines) + "\n ]\n}\n", encoding="utf-8")
    print(f"{path}: {len(lines)} cases, {path.stat().st_size} bytes")
    return path
