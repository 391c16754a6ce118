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


def test_work_inside_of_work_stays_on_its_thread():
    threads = Threads(2)

    def inner(n):
        return threading.get_ident()

    for outside, inside in threads.map(lambda n: (threading.get_ident(), threads.map(inner, range(3))), range(4)):
        assert set(inside) == {outside}


@pytest.mark.parametrize("problem", [ValueError("bad"), KeyboardInterrupt()])
def test_what_nobody_waits_for_ends_at_its_next_look(problem):
    threads, ended = Threads(2), []

    def work(n):
        if n == 0:
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
