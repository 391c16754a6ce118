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
    """Results as they come; what a process that dies was to compute is computed again once."""
    if jobs == 1:
        yield from map(function, tasks)
        return
    from joblib import Parallel, delayed
    from joblib.externals.loky.process_executor import BrokenProcessPool

    left = {task.number: task for task in tasks}
    for _ in range(2):
        try:
            for number, found in Parallel(n_jobs=jobs, return_as="generator_unordered", batch_size=1)(
                delayed(with_number)(function, task) for task in list(left.values())
            ):
                del left[number]
                yield found
            return
        except BrokenProcessPool as problem:
            # Other lives than those that it computed are lost with a process: all that have not arrived run again.
            lost = problem
    raise RunFault(
        f"processes died twice under lives {', '.join(map(str, sorted(left)[:10]))}{' ...' if len(left) > 10 else ''}"
        f" ({str(lost).split('. ')[0]}): out of memory, or killed. {len(tasks) - len(left)} lives of this run are kept;"
        " the same command with fewer --jobs goes on"
    )


def with_number(function: Callable[[Task], Found], task: Task) -> tuple[int, Found]:
    return task.number, function(task)


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
