"""Predictions shared between processes: the same numbers, faults that arrive, nothing left behind."""

import numpy as np
import pytest

from discrepancy.prediction.crew import Crew, shares
from discrepancy.problem import Record


def record(name, condition, size, quantity="transmission_error"):
    return Record(name=name, quantity=quantity, unit="rad", condition=condition, replicate=1, values=np.zeros(size),
                  axes={"angle": np.arange(float(size))}, factors={})


RECORDS = [record("a", "one", 400), record("b", "two", 300), record("c", "one", 400), record("d", "three", 200)]


def predict(i, factor, fails):
    if i == fails:
        raise ValueError(f"record {i}")
    return np.full(len(RECORDS[i].values), factor * i)


def test_a_condition_stays_with_one_process_and_work_is_even():
    owner = shares(RECORDS, 2)
    assert owner[0] == owner[2] != owner[1] == owner[3]


def test_answers_come_in_the_order_asked_and_faults_arrive():
    crew = Crew(RECORDS, predict, 2)
    found = crew([3, 0, 2, 1], (2.0, None))
    assert [y[0] for y in found] == [6.0, 0.0, 4.0, 2.0]
    for fails in range(4):
        with pytest.raises(ValueError, match=f"record {fails}"):
            crew([0, 1, 2, 3], (1.0, fails))
        # No answer of the failed round is taken for one of the next.
        assert [y[0] for y in crew([1, 0], (1.0, None))] == [1.0, 0.0]
    processes = crew.processes
    crew.close()
    assert not any(p.is_alive() for p in processes)


def test_a_crew_that_is_forgotten_ends_its_processes():
    crew = Crew(RECORDS, predict, 3)
    processes = crew.processes
    del crew
    for process in processes:
        process.join(timeout=5.0)
    assert not any(p.is_alive() for p in processes)
