"""What the crews of the tests work on: a file of its own, for spawned processes import it, and nothing dear with it."""

import multiprocessing
import os

import numpy as np

from discrepancy.problem import Record
from fmu_src.progress import task


def record(name, condition, size, quantity="transmission_error"):
    return Record(name=name, quantity=quantity, unit="rad", condition=condition, replicate=1, values=np.zeros(size),
                  axes={"angle": np.arange(float(size))}, factors={})


RECORDS = [record("a", "one", 400), record("b", "two", 300), record("c", "one", 400), record("d", "three", 200)]


def predict(i, factor, fails):
    if i == fails:
        raise ValueError(f"record {i}")
    return np.full(len(RECORDS[i].values), factor * i)


def dying(i, factor, fails):
    if multiprocessing.parent_process() is not None:
        os._exit(3)
    return predict(i, factor, fails)


def interrupted(i, factor, fails):
    if multiprocessing.parent_process() is None and fails is not None:
        raise KeyboardInterrupt
    return predict(i, factor, None)


class Deaf:
    """A listener that must not be asked in another process: its locks may be held there for ever."""

    def begin(self, task):
        assert multiprocessing.parent_process() is None

    end = say = begin


def telling(i, factor, fails):
    with task("predicting"):
        return predict(i, factor, fails)
