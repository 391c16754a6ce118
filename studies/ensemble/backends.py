"""Where lives run: processes of this machine (joblib), or a cluster (Dask)."""

from collections.abc import Callable, Generator, Sequence
from typing import Protocol, TypeVar

from fmu_src.faults import InputFault, RunFault

# Workers that may die under one life before that life is to blame.
RETRIES = 10


class Numbered(Protocol):
    @property
    def number(self) -> int: ...


Task = TypeVar("Task", bound=Numbered)
Found = TypeVar("Found")


def through_joblib(function: Callable[[Task], Found], tasks: Sequence[Task], jobs: int) -> Generator[Found, None, None]:
    """Results as they come."""
    if jobs == 1:
        yield from map(function, tasks)
        return
    from joblib import Parallel, delayed

    yield from Parallel(n_jobs=jobs, return_as="generator_unordered", batch_size=1)(delayed(function)(task) for task in tasks)


def through_dask(function: Callable[[Task], Found], tasks: Sequence[Task], scheduler: str) -> Generator[Found, None, None]:
    """Results as they come; a life whose worker dies runs again on another, so nothing is lost."""
    from distributed import Client, KilledWorker, as_completed

    try:
        client = Client(scheduler, timeout=10)
    except (OSError, ValueError) as problem:
        raise InputFault(f"--scheduler {scheduler}: no Dask scheduler answers there ({problem})") from None
    with client:
        futures = {client.submit(function, task, pure=False, retries=RETRIES): task for task in tasks}
        deaths: dict[int, int] = {}
        arriving = as_completed(futures)
        try:
            for future in arriving:
                task = futures.pop(future)
                try:
                    yield future.result()
                except KilledWorker:
                    deaths[id(task)] = deaths.get(id(task), 0) + 1
                    if deaths[id(task)] > RETRIES:
                        raise RunFault(f"life {task.number}: {RETRIES} workers died under it; look at their memory") from None
                    again = client.submit(function, task, pure=False, retries=RETRIES)
                    futures[again] = task
                    arriving.add(again)
        finally:
            client.cancel(list(futures))
