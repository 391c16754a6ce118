"""Work shared between threads of this process: compiled kernels run beside each other, Python's own code in turn.

Inside shared work nothing is shared further, so that whoever shares need not know who else does.  Context variables are there what they
were where the work was asked for.
"""

import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar, copy_context
from functools import wraps
from typing import ParamSpec, TypeVar

from fmu_src.progress import task

Item = TypeVar("Item")
Result = TypeVar("Result")
Given = ParamSpec("Given")


def sharing_no_matrices(function: Callable[Given, Result]) -> Callable[Given, Result]:
    """While ``function`` runs, linear algebra stays on the thread that asks for it: matrices are small here, and a library's own threads wait for
    the next one by turning round and round, on cores that others need (half of a diagnosis's CPU time)."""

    @wraps(function)
    def run(*arguments: Given.args, **options: Given.kwargs) -> Result:
        from threadpoolctl import threadpool_limits

        with threadpool_limits(1, "blas"):
            return function(*arguments, **options)

    return run


class Stopped(BaseException):
    """Raised in a thread whose work nobody waits for any more."""


# Looked at before anything is made anew: raises ``Stopped`` where nobody waits for the whole of it any more.
GIVES_WAY: ContextVar[Callable[[], None] | None] = ContextVar("gives_way", default=None)


@contextmanager
def giving_way(to: Callable[[], bool]) -> Iterator[None]:
    """What is computed inside ends, by ``Stopped``, soon after there is something ``to`` give way to; what was made by then is kept."""

    def look() -> None:
        if to():
            raise Stopped

    before = GIVES_WAY.set(look)
    try:
        yield
    finally:
        GIVES_WAY.reset(before)


class Threads:
    """``jobs`` threads; with one, everything happens where it is asked for."""

    def __init__(self, jobs: int = 1):
        self.jobs = jobs
        self.stopped = False
        self.here = threading.local()

    def __getstate__(self) -> dict[str, int]:
        """A thread goes nowhere; their number does."""
        return {"jobs": self.jobs}

    def __setstate__(self, state: dict[str, int]) -> None:
        self.__init__(state["jobs"])  # type: ignore[misc]

    def map(self, function: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
        """``function`` of every item, in their order.  The first exception is raised when all threads have come to rest."""
        work = list(items)
        if self.jobs < 2 or len(work) < 2 or getattr(self.here, "inside", False):
            return [function(item) for item in work]
        with ThreadPoolExecutor(self.jobs, "rvwear") as pool:
            try:
                # Ctrl-C may come before all are handed out.
                futures: list[Future[Result]] = [pool.submit(copy_context().run, self.inside, function, item) for item in work]
                return [future.result() for future in futures]
            except BaseException:
                # An error, or Ctrl-C: what has not begun does not begin, the rest ends at its next prediction.
                self.stopped = True
                pool.shutdown(wait=True, cancel_futures=True)
                raise
            finally:
                self.stopped = False

    def told(self, what: str, function: Callable[[Item], Result], items: Iterable[Item], named: Callable[[Item], str]) -> list[Result]:
        """``map``, telling whoever listens what is being tried and how much of it is done."""
        work = list(items)
        with task(what, total=len(work)) as trying:

            def one(item: Item) -> Result:
                trying.what = f"{what}, {named(item)}"
                result = function(item)
                trying.advance()
                return result

            return self.map(one, work)

    def inside(self, function: Callable[[Item], Result], item: Item) -> Result:
        self.here.inside = True
        return function(item)

    def check(self) -> None:
        """To be called now and then in long work: ends it if nobody waits for it."""
        if self.stopped and getattr(self.here, "inside", False):
            raise Stopped


class Once:
    """Results by key, each made once, whoever asks first; the others wait for it."""

    def __init__(self, most: int):
        self.most = most
        self.found: dict[object, Future[object]] = {}
        # What is done is asked for a hundred times as often as it is made: without a lock.
        self.made: dict[object, object] = {}
        self.lock = threading.Lock()

    def __len__(self) -> int:
        return len(self.found)

    def __getstate__(self) -> dict[str, int]:
        """What was made can be made again."""
        return {"most": self.most}

    def __setstate__(self, state: dict[str, int]) -> None:
        self.__init__(state["most"])  # type: ignore[misc]

    def peek(self, key: object) -> object | None:
        """What has been made under ``key``; None if nothing has."""
        return self.made.get(key)

    def get(self, key: object, make: Callable[[], Result]) -> Result:
        try:
            return self.made[key]  # type: ignore[return-value]
        except KeyError:
            pass
        with self.lock:
            future = self.found.get(key)
            own = future is None
            if future is None:
                if len(self.found) > self.most:
                    self.found.clear()
                    self.made.clear()
                future = self.found[key] = Future()
        if own:
            try:
                if look := GIVES_WAY.get():
                    look()
                result = make()
                with self.lock:
                    if self.found.get(key) is future:
                        self.made[key] = result
                future.set_result(result)
            except BaseException as problem:
                with self.lock:
                    self.found.pop(key, None)
                future.set_exception(problem)
                raise
        try:
            return future.result()  # type: ignore[return-value]
        except Stopped:
            if own:
                raise
            # Only who made it was to end.
            return self.get(key, make)
