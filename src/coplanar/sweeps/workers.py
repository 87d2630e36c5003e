"""Who does the work: this process, processes of this machine, a Dask cluster, any ``concurrent.futures.Executor``."""

from __future__ import annotations

import importlib
import multiprocessing
import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, CancelledError, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import Any

from coplanar.errors import CoplanarError, InvalidValue, MissingExtra

AHEAD = 64  # tasks that are handed out before the first answers


class WorkersLost(CoplanarError):
    """The workers ended before their work was done; what was finished is kept."""


@contextmanager
def processes(jobs: int | None, tasks: int) -> Iterator[Executor | None]:
    """So many processes of this machine, as many as it has processors if None; None where one is enough."""
    wanted = min(jobs or os.cpu_count() or 1, tasks)
    if wanted < 2:
        yield None
        return
    with ProcessPoolExecutor(wanted, multiprocessing.get_context("spawn")) as pool:
        try:
            yield pool
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


@contextmanager
def dask_cluster(address: str) -> Iterator[Executor]:
    """The workers of a Dask scheduler, as ``tcp://host:8786``; those that die on the way are replaced by the others.

    Raises:
        MissingExtra: If Dask is not installed.
        InvalidValue: If no scheduler answers there.
    """
    try:
        connect: Any = importlib.import_module("distributed").Client
    except ImportError:
        raise MissingExtra("distributed", "cluster") from None
    try:
        client = connect(address, timeout=5)
    except (OSError, ValueError) as error:
        needed = "the address of a running scheduler, as tcp://127.0.0.1:8786"
        raise InvalidValue("dask", address, needed, f"start one with  dask scheduler  ({error})") from None
    with client:
        yield client.get_executor(retries=3)


def results(
    work: Callable[..., Any], tasks: Iterable[tuple[int, tuple[Any, ...]]], executor: Executor | None
) -> Iterator[tuple[int, Any]]:
    """The number of each task and its answer, in the order in which they are done.

    Args:
        work: What is called.
        tasks: Their numbers and arguments.
        executor: Who calls it; this process if None.

    Raises:
        WorkersLost: If the executor breaks down.
    """
    if executor is None:
        for number, arguments in tasks:
            yield number, work(*arguments)
        return
    running: dict[Future[Any], int] = {}
    source = iter(tasks)
    try:
        while True:
            while len(running) < AHEAD and (task := next(source, None)) is not None:
                running[executor.submit(work, *task[1])] = task[0]
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                yield running.pop(future), future.result()
    except (BrokenProcessPool, CancelledError) as error:
        raise WorkersLost(
            f"the workers ended before their work was done ({error}); run it again to go on from what is finished; in "
            "a script, the call has to stand under  if __name__ == '__main__':"
        ) from None
    finally:
        for future in running:
            future.cancel()
