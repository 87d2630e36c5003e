"""A sweep, from the plan to the table."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from contextlib import nullcontext
from pathlib import Path
from typing import Any

from coplanar.errors import InvalidValue
from coplanar.scenarios import Scenario, load
from coplanar.sweeps.parts import Parts
from coplanar.sweeps.plan import planned
from coplanar.sweeps.result import Sweep, checked_table
from coplanar.sweeps.task import measure_rows
from coplanar.sweeps.workers import dask_cluster, processes, results

Progress = Callable[[int, int], None]


def sweep(
    scenario: Scenario | str | os.PathLike[str],
    vary: Mapping[str, Any] | None = None,
    *,
    samples: int | None = None,
    seed: int = 0,
    executor: Executor | str | None = None,
    jobs: int | None = None,
    path: str | os.PathLike[str] | None = None,
    task_rows: int = 250,
    progress: Progress | None = None,
) -> Sweep:
    """Measure a scenario at every combination of values, or at random draws of them: one row of a table each.

    A task is ``task_rows`` rows, measured together where the scenario takes arrays. The table depends on the plan
    alone: the same seed gives the same table, whatever the workers and their number.

    Args:
        scenario: A scenario, its name in the catalog, or a file.
        vary: Key to values: a list, ``"lo:hi:n"``, ``"lo:hi:n:log"``, ``"a,b,c"``; to draws: ``"lo:hi"`` or
            ``Uniform``, ``"mean+-deviation"`` or ``Normal``.
        samples: Draws for each combination of listed values. Where the scenario has noise, each row has its own.
        seed: Of the draws.
        executor: Who works: any ``concurrent.futures.Executor``, or the address of a Dask scheduler,
            ``"tcp://host:8786"`` (extra ``cluster``); processes of this machine if None.
        jobs: How many processes; as many as there are processors if None, 1 for this process alone.
        path: Where to write the table, .csv or .parquet (extra ``logs``). Beside it stands a folder ``.parts`` while
            the sweep runs: run an interrupted sweep again with the same path, and it goes on.
        task_rows: How many rows go to a worker at once.
        progress: Called with the number of tasks done and of all.

    Returns:
        The table.

    Raises:
        InvalidScenario: If a key or a value does not fit the scenario.
        InvalidValue: If nothing is varied, or parts of another sweep stand beside ``path``.
        WorkersLost: If the workers die; what is finished is kept beside ``path``.

    Example:
        >>> table = sweep("arm-reach", {"target.0": [0.4, 0.5, 2.0]}, jobs=1)
        >>> table["reached"].tolist()
        [True, True, False]
    """
    made = scenario if isinstance(scenario, Scenario) else load(os.fspath(scenario))
    plan = planned(made, vary or {}, samples=samples, seed=seed, task_rows=task_rows)
    if jobs is not None and (isinstance(jobs, bool) or not isinstance(jobs, int) or jobs < 1):
        raise InvalidValue("jobs", jobs, "a whole number of 1 or more")
    table = None if path is None else checked_table(Path(path))
    parts = Parts(plan, table)
    told = progress or (lambda _done, _all: None)
    told(len(parts), plan.count)
    data = made.data()
    tasks = ((number, (data, columns)) for number, columns in enumerate(plan.tasks()) if number not in parts)
    with _workers(executor, jobs, plan.count - len(parts)) as workers:
        for number, columns in results(measure_rows, tasks, workers):
            parts.add(number, columns)
            told(len(parts), plan.count)
    found = Sweep.of(plan, parts)
    if table is not None:
        found.write(table)
        parts.remove()
    return found


def _workers(executor: Executor | str | None, jobs: int | None, tasks: int) -> Any:
    if isinstance(executor, str):
        return dask_cluster(executor)
    if executor is None:
        return processes(jobs, tasks)
    if not isinstance(executor, Executor):
        raise InvalidValue("executor", executor, "a concurrent.futures.Executor or the address of a Dask scheduler")
    return nullcontext(executor)
