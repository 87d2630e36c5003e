"""``python -m benchmarks``: measure, print the table, write the page."""

from __future__ import annotations

import argparse
import sys
import time
import warnings
from pathlib import Path

from benchmarks import page
from benchmarks.features import vector_levels
from benchmarks.fresh import start_up
from benchmarks.limits import machine_limits
from benchmarks.machine import description
from benchmarks.measure import FULL, QUICK, Effort, measure
from benchmarks.memory import peaks
from benchmarks.page import Findings
from benchmarks.peers import versions
from benchmarks.sizes import cost_against_size
from benchmarks.ulps import primitive_errors
from benchmarks.workloads import ALL

PARTS = ("sizes", "startup", "memory", "primitives", "vectors")
NAMES = (*(workload.name for workload in ALL), *PARTS)


def main() -> int:
    """Measure what is asked for, print it, write the page if all of it was measured or a place is given."""
    asked = _arguments()
    names = asked.only or NAMES
    effort, started = QUICK if asked.quick else FULL, time.perf_counter()
    warnings.simplefilter("ignore")
    findings = Findings(description(), versions(), machine_limits(), asked.quick)
    _workloads(findings, names, effort)
    _parts(findings, names, effort)
    _print(f"\n# Summary after {time.perf_counter() - started:.0f} s", page.machine(findings))
    if findings.results:
        _print("", page.summary(findings))
    _print("Behind", page.misses(findings))
    place = asked.output or (None if asked.only or asked.quick else Path("docs/benchmarks.md"))
    if place:
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(page.page(findings), encoding="utf-8")
        print(f"\nwritten: {place}")
    return 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__.splitlines()[0])
    parser.add_argument("--only", action="append", choices=NAMES, metavar="NAME", help=f"one of {', '.join(NAMES)}")
    parser.add_argument("--quick", action="store_true", help="smaller batches, shorter rounds: under a minute")
    parser.add_argument("--output", type=Path, help="where the page goes; docs/benchmarks.md after a full run")
    return parser.parse_args()


def _workloads(findings: Findings, names: tuple[str, ...] | list[str], effort: Effort) -> None:
    for workload in ALL:
        if workload.name in names:
            if not effort.quick:
                findings.limits = machine_limits(findings.limits)
            started = time.perf_counter()
            result = measure(workload, effort)
            findings.results.append(result)
            title = f"\n{workload.title} ({workload.name}, {time.perf_counter() - started:.0f} s)"
            _print(title, page.detail(result, findings.limits))


def _parts(findings: Findings, names: tuple[str, ...] | list[str], effort: Effort) -> None:
    if "sizes" in names:
        findings.sizes = cost_against_size(effort)
        _print("\nCost against size", page.sizes(findings))
    if "startup" in names:
        findings.imports, findings.calls = start_up(effort)
        _print("\nStart-up", [*page.starts(findings.imports), *page.starts(findings.calls)])
    if "memory" in names:
        findings.memory = peaks(effort)
        _print("\nMemory", page.memory(findings))
    if "vectors" in names:
        findings.levels = vector_levels(effort)
        _print("\nInstruction sets", page.levels(findings))
    if "primitives" in names:
        findings.ulps = primitive_errors(200 if effort.quick else 1000)
        _print("\nWorst errors of the primitives [ulp]", page.ulps(findings))


def _print(title: str, lines: list[str]) -> None:
    print(title, *lines, sep="\n", flush=True)


if __name__ == "__main__":
    sys.exit(main())
