"""Work on several threads: same answers, errors and Ctrl-C heard, each run made once."""

import threading
import time
from contextvars import ContextVar

import pytest

from fmu_src.threads import Once, Stopped, Threads, giving_way


def test_results_come_in_the_order_of_the_items():
    assert Threads(4).map(lambda n: (time.sleep(0.001 * (9 - n)), n * n)[1], range(9)) == [n * n for n in range(9)]


def test_context_goes_along_and_stays_apart():
    """What one piece of work sets, no other sees; what stood when it was asked for, all see."""
    place = ContextVar("place", default="outside")

    def work(n):
        seen = place.get()
        place.set(f"changed by {n}")
        time.sleep(0.005)
        return seen, place.get()

    place.set("here")
    assert Threads(2).map(work, range(4)) == [("here", f"changed by {n}") for n in range(4)]
    assert place.get() == "here"


def test_work_inside_of_work_goes_to_threads_that_have_nothing_else_to_do():
    """One long item beside short ones: its own work is shared, and never do more threads work than there are to be."""
    threads, at_work, most, lock = Threads(2), [], [], threading.Lock()

    def inner(n):
        with lock:
            at_work.append(n)
            most.append(len(at_work))
        time.sleep(0.005)
        with lock:
            at_work.remove(n)
        return n, threading.get_ident()

    def outer(n):
        found = threads.map(inner, range(20 * n, 20 * n + (20 if n == 0 else 2)))
        return [k for k, _ in found], {who for _, who in found}

    results = threads.map(outer, range(3))
    assert [places for places, _ in results] == [list(range(20)), [20, 21], [40, 41]]
    assert len(results[0][1]) == 2 and max(most) == 2


def test_who_waits_for_another_leaves_room_for_a_third():
    """Two ask for the same run, which has parts: one would wait while the other makes them alone."""
    threads, kept = Threads(2), Once(10)

    def part(n):
        time.sleep(0.005)
        return threading.get_ident()

    found = threads.map(lambda n: kept.get("run", lambda: set(threads.map(part, range(20)))), range(2))
    assert len(found[0]) > 1 and found[0] == found[1]
    assert threads.busy == 0


def test_a_problem_inside_of_work_is_that_of_who_asked():
    """Values at which the reducer finds no equilibrium end no search."""
    threads = Threads(2)

    def outer(n):
        try:
            threads.map(lambda k: 1 // (k - 3), range(6))
        except ZeroDivisionError:
            return n
        raise AssertionError

    assert threads.map(outer, range(3)) == [0, 1, 2]
    assert threads.busy == 0


@pytest.mark.parametrize("problem", [ValueError("bad"), KeyboardInterrupt()])
def test_what_nobody_waits_for_ends_at_its_next_look(problem):
    threads, ended = Threads(2), []

    def work(n):
        if n == 0:
            # The other has begun.
            time.sleep(0.02)
            raise problem
        try:
            for _ in range(5000):
                time.sleep(0.001)
                threads.check()
        except Stopped:
            ended.append(n)
            raise

    begun = time.perf_counter()
    with pytest.raises(type(problem)):
        threads.map(work, range(50))
    assert 1 <= len(ended) <= 2 and time.perf_counter() - begun < 2.0
    # And the next work is done.
    assert threads.map(abs, [-1, -2]) == [1, 2]


def test_a_run_that_two_ask_for_is_made_once():
    made, kept = [], Once(10)

    def make():
        made.append(1)
        time.sleep(0.02)
        return len(made)

    assert Threads(4).map(lambda n: kept.get("run", make), range(8)) == [1] * 8


def test_a_run_that_failed_is_tried_again():
    kept = Once(10)
    with pytest.raises(ZeroDivisionError):
        kept.get("run", lambda: 1 / 0)
    assert kept.get("run", lambda: 7) == 7


def test_what_gives_way_ends_before_it_makes_anything_anew_and_keeps_what_it_made():
    kept, first = Once(10), []
    with giving_way(lambda: bool(first)):
        assert kept.get("a", lambda: 1) == 1
        first.append("a move")
        # What is there costs nothing.
        assert kept.get("a", lambda: 2) == 1
        with pytest.raises(Stopped):
            kept.get("b", lambda: 3)
    assert kept.get("b", lambda: 4) == 4


def test_who_waits_for_what_was_to_end_makes_it_itself():
    kept, begun = Once(10), threading.Event()

    def ends():
        begun.set()
        time.sleep(0.05)
        raise Stopped

    def asked():
        with pytest.raises(Stopped):
            kept.get("run", ends)

    other = threading.Thread(target=asked)
    other.start()
    begun.wait()
    assert kept.get("run", lambda: 7) == 7
    other.join()
