"""The tool under trial: sees nothing but the campaign's folder."""

import json
import signal
import threading
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.model import Campaign
from discrepancy.model_file import ModelFile, load_model
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.verdict import diagnose
from fmu_src.threads import Once

# Runs of each reducer that campaigns with equal conditions share in one process: they change no number, only the time.
SHARED: dict[str, Once] = {}
# Seconds after which no answer is the answer: nobody waits longer.  Beside other work as many seconds of CPU time, in so many times as long.
LONGEST = 900.0
BESIDE_OTHERS = 4.0


def answer_of(folder: Path) -> dict[str, Any]:
    """The diagnosis of one campaign as plain data, with times and whatever went wrong."""
    started = time.perf_counter()
    times = {}
    try:
        with warnings.catch_warnings(), within(LONGEST):
            warnings.simplefilter("ignore")
            campaign = load_campaign(folder)
            times["load"] = time.perf_counter() - started
            file = model_of(campaign)
            model = PhysicalModel(file, campaign)
            model.bench.runs = model.rough_bench.runs = SHARED.setdefault(file.reducer.name, Once(4_000))
            times["model"] = time.perf_counter() - started - times["load"]
            answer = plain(diagnose(file, campaign, model=model).in_si())
    except Exception as problem:  # noqa: BLE001 - a crash is a result of the trial
        answer = {"verdict": "crash", "effects": [], "error": f"{type(problem).__name__}: {problem}"[:500]}
    times["whole"] = time.perf_counter() - started
    return {**answer, "times": times}


def model_of(campaign: Campaign) -> ModelFile:
    """The plain model of the reducer that the campaign says it is of."""
    assert campaign.reducer is not None
    return load_model(campaign.reducer.name)


@contextmanager
def within(seconds: float) -> Iterator[None]:
    """TimeoutError after so long, and as much CPU time; only where signals are, which is a process's main thread."""
    if threading.current_thread() is not threading.main_thread() or not hasattr(signal, "setitimer"):
        yield
        return

    started, cpu = time.perf_counter(), time.process_time()

    def stop(*_: object) -> None:
        left = seconds - (time.process_time() - cpu)
        if left > 0.0 and time.perf_counter() - started < BESIDE_OTHERS * seconds:
            signal.setitimer(signal.ITIMER_REAL, left)
            return
        raise TimeoutError(f"no answer within {seconds:g} s")

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def plain(tree: dict[str, Any]) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(json.dumps(tree, default=lambda x: x.tolist() if hasattr(x, "tolist") else float(x)))
    return found
