"""What a proposed experiment is worth: how often it leaves one right name, against one drawn at random.

    python -m benchmarks.blind_trial.experiments --folder /tmp/trial --cases 20 --jobs 2

Takes the trial's campaigns of one effect that ended with a set.  Each is made again with a rig that can also measure whatever
the hidden law says something about, `rvwear next` proposes, and the proposal and one of its own list drawn at random are carried
out with the hidden truth, added to the campaign and diagnosed.  Writes experiments.jsonl into the folder; resumes.
"""

import argparse
import json
import os
import sys
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.blind_trial.generator.designs import Run, Series, there_and_back
from benchmarks.blind_trial.generator.folder import write_campaign
from benchmarks.blind_trial.generator.make import Drawn, Task, drawn, measure
from benchmarks.blind_trial.generator.noise import noise_for, round_to
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.results import EXPERIMENTS, finished, resolved
from benchmarks.blind_trial.score import ONE, SET, Case
from fmu_src.arrays import Floats

RIG = """[rig]
input_speed = ["300 rpm", "2500 rpm"]
load_torque = ["20 N.m", "250 N.m"]
temperature = ["10 degC", "60 degC"]
hours = ["100 h", "3000 h"]
cost_per_run = 1.0
cost_per_hour = 0.01
"""
REPLICATES = 2


def chosen(folder: Path, cases: int) -> list[dict[str, Any]]:
    """Results of single effects that ended in a set which holds the truth."""
    found = []
    for _, result in sorted(finished(folder).items()):
        if "truth" not in result:
            continue
        case = Case(result)
        if case.kind == "effect" and case.verdict == SET and case.covered and len(case.set) > 1:
            found.append(result)
    return found[:cases]


def rig_of(made: Drawn) -> str:
    """What the bench measured, and whatever else the hidden laws say something about."""
    known = {q for t in made.truths for q in t.quantities} | made.design.quantities()
    return RIG + f"quantities = {sorted(known)}\n"


def series_of(name: str, settings: dict[str, float], made: Drawn, rng: np.random.Generator) -> Series:
    """The series that a proposal asks for, with the noise of this bench."""
    signal = name.partition(" at ")[0]
    quantity, _, words = signal.partition("[")
    pairs = (word.partition("=") for word in words.rstrip("]").split(",") if word)
    tags = {key: value for key, _, value in pairs}
    known = next((s for s in made.design.series if s.quantity == quantity), None)
    noise = known.noise if known else noise_for(rng, quantity)
    setting = Setting(settings.get("speed", 200.0), settings.get("load", 167.0), settings.get("temperature", 293.15), settings.get("hours", 0.0))
    axes: dict[str, Floats] = {}
    rows = []
    if quantity == "transmission_error":
        axes = {"angle": np.linspace(0.0, 2.0 * np.pi, 450, endpoint=False)}
    elif quantity == "hysteresis":
        axes, tags = {"torque": there_and_back(167.0, 10)}, {"locked": "input"}
    elif quantity in ("vibration_order", "wear_profile"):
        assert known is not None, f"{quantity}: no series of this campaign says over which axes"
        axes = known.axes
    else:
        rows = [setting]
    return Series(quantity, "added", setting, noise, axes, rows, tags, REPLICATES)


def one(result: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Proposal and random choice for one campaign, and what came of them."""
    from benchmarks.blind_trial.tool import MODEL, answer_of
    from discrepancy.campaign.load import load_campaign
    from discrepancy.model_file import load_model
    from discrepancy.next_run import next_run

    task = Task(**{**result["task"], "laws": tuple(result["task"]["laws"])})
    made = drawn(task)
    design, rng = made.design, np.random.default_rng([task.seed, 77])
    runs = measure(made.rng, design, made.bench, made.truths)

    def write(name: str, more: list[Run]) -> Path:
        every: list[Run] = [{**run, "values": round_to(run["values"], run["series"].noise.quantum)} for run in runs + more]
        conditions = design.conditions | {run["series"].condition: run["series"].setting for run in more}
        target = folder / "experiments" / task.name / name
        write_campaign(target, task.name, replace(design, conditions=conditions), every, result["seal"], rig=rig_of(made))
        return target

    found: dict[str, Any] = {"number": task.number, "law": list(task.laws), "strength": task.strength}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        proposed = next_run(load_model(MODEL), load_campaign(write("before", [])))
    proposals, every = (proposed.result.proposals, proposed.result.every) if proposed.result else ([], [])
    if not proposals:
        return found | {"verdict": proposed.verdict}
    acceptable = Case(result).acceptable
    for kind, proposal in (("proposed", proposals[0]), ("random", every[int(rng.integers(len(every)))])):
        series = series_of(proposal.experiment, proposal.settings, made, rng)
        more = measure(rng, replace(design, series=[series], conditions={}, uneven=False), made.bench, made.truths)
        answer = answer_of(write(kind, more))
        names = list(dict.fromkeys(e["name"] for e in answer["effects"]))
        found[kind] = {"experiment": proposal.experiment, "least": proposal.least, "verdict": answer["verdict"], "names": names,
                       "resolved": answer["verdict"] == ONE and names[0] in acceptable}  # fmt: skip
    return found | {"verdict": proposed.verdict, "rivals": proposed.rivals, "choices": len(proposals)}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=Path, required=True, help="folder of a trial")
    parser.add_argument("--cases", type=int, default=20)
    parser.add_argument("--jobs", type=int, default=-1)
    arguments = parser.parse_args()
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    from joblib import Parallel, delayed

    path = arguments.folder / EXPERIMENTS
    done = {json.loads(line)["number"] for line in path.read_text(encoding="utf-8").splitlines()} if path.is_file() else set()
    left = [r for r in chosen(arguments.folder, arguments.cases) if r["number"] not in done]
    folder = arguments.folder.resolve()
    with path.open("a", encoding="utf-8") as lines:
        for found in Parallel(n_jobs=arguments.jobs, return_as="generator_unordered", batch_size=1)(delayed(one)(r, folder) for r in left):
            lines.write(json.dumps(found, default=float) + "\n")
            lines.flush()
            print(found["number"], *found["law"], {k: (found[k]["experiment"], found[k]["verdict"], *found[k]["names"])
                                                   for k in ("proposed", "random") if k in found} or found["verdict"], flush=True)  # fmt: skip
    print(json.dumps(resolved(arguments.folder), indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())
