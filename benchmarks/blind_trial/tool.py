"""The tool under trial: sees nothing but the campaign's folder."""

import json
import time
import warnings
from pathlib import Path

from discrepancy.campaign import load_campaign
from discrepancy.inference.diagnose import diagnose
from discrepancy.model_file import load_model
from discrepancy.prediction.physical_model import PhysicalModel

MODEL = "RV20E-121"
# Runs of the bench that campaigns with equal conditions share; None: every campaign starts from nothing.
SHARED: dict | None = None


def answer_of(folder: Path) -> dict:
    """The diagnosis of one campaign as plain data, with times and whatever went wrong."""
    started = time.perf_counter()
    times = {}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            campaign = load_campaign(folder)
            times["load"] = time.perf_counter() - started
            model = PhysicalModel(load_model(MODEL), campaign)
            if SHARED is not None:
                model.bench.runs = SHARED
            times["model"] = time.perf_counter() - started - times["load"]
            found = diagnose(model)
        answer = plain(found.to_dict())
    except Exception as problem:  # noqa: BLE001 - a crash is a result of the trial
        answer = {"verdict": "crash", "effects": [], "error": f"{type(problem).__name__}: {problem}"[:500]}
    times["whole"] = time.perf_counter() - started
    return {**answer, "times": times}


def plain(tree: dict) -> dict:
    return json.loads(json.dumps(tree, default=lambda x: x.tolist() if hasattr(x, "tolist") else float(x)))
