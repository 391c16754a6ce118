"""Work shared between threads of this process: compiled kernels run beside each other, Python's own code in turn.

Whoever shares need not know who else does: never more threads work than there are to be.  Context variables are there what they were where the
work was asked for.
"""

import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future
from contextlib import contextmanager
from contextvars import Context, ContextVar, copy_context
from functools import wraps
from typing import Generic, ParamSpec, TypeVar

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


# Of each thread the ``Threads`` whose shared work it does.
HERE = threading.local()


class Share(Generic[Item, Result]):
    """One piece of shared work: every item is taken once, by whoever is free."""

    def __init__(self, function: Callable[[Item], Result], work: Sequence[Item]):
        self.function, self.work = function, work
        self.results: dict[int, Result] = {}
        self.places = iter(range(len(work)))
        self.left = len(work)
        self.problem: BaseException | None = None
        self.lock = threading.Lock()

    def take(self) -> int | None:
        """The place of the next item; None if all are taken, or no more are wanted."""
        with self.lock:
            place = None if self.problem else next(self.places, None)
            self.left -= place is not None
            return place

    def do(self, context: Context) -> None:
        """Items until none is left, each in a copy of the ``context``."""
        while (place := self.take()) is not None:
            self.one(place, context)

    def one(self, place: int, context: Context | None = None) -> None:
        """The item of a place, in a copy of the ``context`` if there is one."""
        try:
            item = self.work[place]
            self.results[place] = context.copy().run(self.function, item) if context else self.function(item)
        except BaseException as problem:  # noqa: BLE001 - who waits for the work raises it
            with self.lock:
                self.problem = self.problem or problem

    def ended(self) -> list[Result]:
        """The results in the order of the items, or the first problem."""
        if self.problem:
            raise self.problem
        return [self.results[place] for place in range(len(self.work))]


class Threads:
    """``jobs`` threads; with one, everything happens where it is asked for.

    Work inside of shared work is done by the thread that asks for it, and by those that have nothing else to do meanwhile.
    """

    def __init__(self, jobs: int = 1):
        self.jobs = jobs
        self.stopped = False
        self.busy = 0
        self.lock = threading.Lock()

    def __getstate__(self) -> dict[str, int]:
        """A thread goes nowhere; their number does."""
        return {"jobs": self.jobs}

    def __setstate__(self, state: dict[str, int]) -> None:
        self.__init__(state["jobs"])  # type: ignore[misc]

    @property
    def inside(self) -> bool:
        """Whether this thread does shared work."""
        return getattr(HERE, "threads", None) is self

    def map(self, function: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
        """``function`` of every item, in their order.  The first exception is raised when all threads have come to rest."""
        work = list(items)
        if self.jobs < 2 or len(work) < 2:
            return [function(item) for item in work]
        share = Share(function, work)
        return self.helped(share) if self.inside else self.waited_for(share)

    def waited_for(self, share: Share[Item, Result]) -> list[Result]:
        """What all threads make of the work, while this one can hear Ctrl-C."""
        helpers = [self.helper(share, outermost=True) for _ in range(min(self.jobs, len(share.work)))]
        # All of them, before the first has work of its own to share.
        self.works(len(helpers))
        started = 0
        try:
            for helper in helpers:
                helper.start()
                started += 1
            for helper in helpers:
                helper.join()
        except BaseException as problem:  # noqa: BLE001 - Ctrl-C, raised as soon as all have come to rest
            # What has not begun does not begin, the rest ends at its next prediction.
            share.problem, self.stopped = problem, True
            self.works(started - len(helpers))
            for helper in helpers[:started]:
                helper.join()
        finally:
            self.stopped = False
        return share.ended()

    def helped(self, share: Share[Item, Result]) -> list[Result]:
        """What this thread makes of the work, helped by those that are free."""
        helpers: list[threading.Thread] = []
        while (place := share.take()) is not None:
            if share.left and self.takes_room():
                helpers.append(self.helper(share))
                helpers[-1].start()
            share.one(place)
        for helper in helpers:
            helper.join()
        return share.ended()

    def helper(self, share: Share[Item, Result], outermost: bool = False) -> threading.Thread:
        """A thread that does items of a share until none is left."""
        context = copy_context()

        def work() -> None:
            HERE.threads = self
            share.do(context)
            self.works(-1)
            # The others end at their next prediction.
            if outermost and share.problem:
                self.stopped = True

        return threading.Thread(target=work, name="rvwear")

    def works(self, more: int) -> None:
        """So many ``more`` threads work than did."""
        with self.lock:
            self.busy += more

    def takes_room(self) -> bool:
        """Whether one more thread may work; then it counts as working."""
        with self.lock:
            free = self.busy < self.jobs
            self.busy += free
            return free

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

    def check(self) -> None:
        """To be called now and then in long work: ends it if nobody waits for it."""
        if self.stopped and self.inside:
            raise Stopped


def made_elsewhere(future: Future[object]) -> object:
    """What another thread makes; who waits for it leaves room for a third."""
    threads: Threads | None = getattr(HERE, "threads", None)
    if threads is None:
        return future.result()
    threads.works(-1)
    try:
        return future.result()
    finally:
        threads.works(1)


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
            return future.result() if own or future.done() else made_elsewhere(future)  # type: ignore[return-value]
        except Stopped:
            if own:
                raise
            # Only who made it was to end.
            return self.get(key, make)
