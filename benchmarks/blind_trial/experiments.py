"""What a proposed experiment is worth: how often it leaves one right name, against one drawn at random and those of other criteria.

    python -m benchmarks.blind_trial.experiments --folder /tmp/trial --cases 100 --jobs 2

Takes the trial's campaigns of one effect that ended with a set; where these are too few, makes more of the same kind.  Each is made
again with a rig that can also measure whatever the hidden law says something about, and what every bench measures.  `rvwear next`
proposes; beside it stand the criteria of ``criteria`` on the same rivals and experiments, and one experiment drawn at random from everything that
the rig can do: any of its quantities, at any setting within its limits, either way round.  Each is carried out with the
hidden truth, added to the campaign and diagnosed.  Writes experiments.jsonl into the folder; resumes.
"""

import argparse
import json
import os
import sys
import time
import warnings
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from itertools import count, islice
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.blind_trial.criteria import CRITERIA, Prediction
from benchmarks.blind_trial.generator.designs import RPM, Run, Series, there_and_back
from benchmarks.blind_trial.generator.folder import write_campaign
from benchmarks.blind_trial.generator.laws import CATALOGUE
from benchmarks.blind_trial.generator.make import Drawn, Task, drawn, measure
from benchmarks.blind_trial.generator.noise import noise_for, round_to
from benchmarks.blind_trial.generator.reducer import HOUR, Setting
from benchmarks.blind_trial.generator.truth import LIVED
from benchmarks.blind_trial.results import KINDS, end_line, finished, resolved
from benchmarks.blind_trial.run import one as diagnosed
from benchmarks.blind_trial.score import Case
from benchmarks.blind_trial.tool import answer_of, model_of
from benchmarks.blind_trial.words import EXPERIMENTS, ONE, PROPOSED, RANDOM, RESULTS, SET
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.model import Campaign
from discrepancy.experiment.next_run import NextRun, next_run
from discrepancy.experiment.rig_runs import Measurement, possible
from discrepancy.inference.next_experiment import RivalLaw, rival_of
from discrepancy.prediction.physical_model import PhysicalModel
from fmu_src.arrays import Floats

RIG = """[rig]
input_speed = ["300 rpm", "2500 rpm"]
load_torque = ["20 N.m", "250 N.m"]
temperature = ["10 degC", "60 degC"]
hours = ["100 h", "3000 h"]
cost_per_run = 1.0
cost_per_hour = 0.01
"""
# The same in SI.
LIMITS = {"speed": (300.0 * RPM, 2500.0 * RPM), "load": (20.0, 250.0), "temperature": (283.15, 333.15), "hours": (100.0 * HOUR, 3000.0 * HOUR)}
USUAL = ("transmission_error", "hysteresis", "input_torque")
REPLICATES = 2
# Campaigns that are made beside a trial's, so many at a time; sizes that cost too much to be carried out five times over.
FIRST_MORE, MORE_SEED, BATCH, LARGE = 1_000_000, 5_772_156, 20, ("rich", "bench")


def chosen(results: Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """Results of single effects that ended in a set which holds the truth."""
    found = []
    for result in results:
        if "truth" not in result:
            continue
        case = Case(result)
        if case.kind == "effect" and case.verdict == SET and case.covered and len(case.set) > 1 and case.size not in LARGE:
            found.append(result)
    return found


def more_tasks() -> Iterator[Task]:
    """Further small campaigns of one effect, without end; none of them is in a trial."""
    rng = np.random.default_rng(MORE_SEED)
    for number in count(FIRST_MORE):
        law = CATALOGUE[int(rng.integers(len(CATALOGUE)))]
        size, strength = str(rng.choice(["small", "small", "poor"])), float(rng.choice([8.0, 12.0, 20.0]))
        yield Task(number, int(rng.integers(2**31)), "effect", (law.name,), strength, size)


def enough_cases(folder: Path, cases: int, jobs: int) -> list[dict[str, Any]]:
    """So many campaigns that ended with a set: those of the trial, then others that are made and diagnosed for it."""
    from joblib import Parallel, delayed

    found = chosen(result for _, result in sorted(finished(folder).items()))
    if len(found) >= cases:
        return found[:cases]
    beside = folder / "more"
    beside.mkdir(exist_ok=True)
    tasks, done = more_tasks(), finished(beside)
    while len(found) < cases:
        batch = list(islice(tasks, BATCH))
        end_line(beside / RESULTS)
        with (beside / RESULTS).open("a", encoding="utf-8") as lines:
            left = [t for t in batch if t.number not in done]
            for result in Parallel(n_jobs=jobs, return_as="generator_unordered", batch_size=1)(delayed(diagnosed)(t, beside, False, False) for t in left):
                done[result["number"]] = result
                lines.write(json.dumps(result, default=float) + "\n")
                lines.flush()
        found += chosen(done[t.number] for t in batch)
        print(f"{min(len(found), cases)} of {cases} campaigns that ended with a set", flush=True)
    return found[:cases]


def quantities_of(made: Drawn) -> list[str]:
    """What every bench measures, what this one measured, and whatever else the hidden laws say something about."""
    return sorted({q for t in made.truths for q in t.quantities} | made.design.quantities() | set(USUAL))


def rig_of(made: Drawn) -> str:
    return RIG + f"quantities = {quantities_of(made)}\n"


def at_random(made: Drawn, rng: np.random.Generator) -> Series:
    """Any experiment that the rig can do."""
    known = {s.quantity for s in made.design.series}
    # Over which axes a spectrum or a print is measured only the campaign says.
    possible = [q for q in quantities_of(made) if q in known or q not in ("vibration_order", "wear_profile")]
    quantity = str(rng.choice(possible))
    tags = ""
    if quantity in ("wear_depth", "wear_profile"):
        tags = "[surface=pin]" if quantity == "wear_profile" else f"[surface={rng.choice(['flank', 'inner_race', 'outer_race'])}]"
    # A trial's curves and torques are those of a new reducer.
    settings = {name: float(rng.uniform(*ends)) for name, ends in LIMITS.items() if name != "hours" or quantity in LIVED}
    series = series_of(quantity + tags, settings, made, rng)
    direction = int(rng.choice([1, -1])) if quantity == "transmission_error" else 1
    series.setting = replace(series.setting, direction=direction)
    return series


def series_of(signal: str, settings: Mapping[str, float], made: Drawn, rng: np.random.Generator) -> Series:
    """The series of a signal (its quantity, tags in brackets) at settings, with the noise of this bench."""
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


def by_criteria(proposed: NextRun, campaign: Campaign) -> dict[str, Measurement]:
    """The experiment that each criterion of the literature takes, of the same ones and for the same rivals as the proposal."""
    answer = proposed.answer
    fits = answer.diagnosis.fits
    every = [*fits.members, *fits.rivals]
    members = [next(r for r in every if r.name == name) for name in proposed.rivals]
    rivals = [rival_of(m, None, min(r.fit.chi2 for r in members)) for m in members]
    best: dict[str, tuple[float, Measurement]] = {}
    for experiment in possible(answer.model, campaign, fits.space):
        predictions = [prediction(answer.model, experiment, rival) for rival in rivals]
        for name, criterion in CRITERIA.items():
            worth = criterion(predictions)
            if name not in best or worth > best[name][0]:
                best[name] = worth, experiment
    return {name: experiment for name, (_, experiment) in best.items()}


def prediction(model: PhysicalModel, experiment: Measurement, rival: RivalLaw) -> Prediction:
    """What a rival predicts, in units of the noise."""

    def at(values: Mapping[str, float]) -> Floats:
        return np.asarray(model.one(experiment.record, {**model.zeros, **values}) / experiment.deviation, np.float64)

    mean = at(rival.values)
    jacobian = np.column_stack([(at({**rival.values, n: rival.values[n] + 0.01 * s}) - mean) / (0.01 * s) for n, s in zip(rival.names, rival.scales)])
    values, vectors = np.linalg.eigh(0.5 * (rival.covariance + rival.covariance.T))
    return Prediction(mean, jacobian @ (vectors * np.sqrt(np.maximum(values, 0.0))), rival.weight)


def one(result: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Every choice for one campaign, and what came of it; each is drawn and measured by chance of its own."""
    task = Task(**{**result["task"], "laws": tuple(result["task"]["laws"]), "rivals": False})
    made = drawn(task)
    design = made.design
    runs = measure(made.rng, design, made.bench, made.truths)

    def write(name: str, more: list[Run]) -> Path:
        every: list[Run] = [{**run, "values": round_to(run["values"], run["series"].noise.quantum)} for run in runs + more]
        conditions = design.conditions | {run["series"].condition: run["series"].setting for run in more}
        target = folder / "experiments" / task.name / name.replace(" ", "_")
        write_campaign(target, task.name, replace(design, conditions=conditions), every, result["seal"], rig=rig_of(made), reducer=task.base)
        return target

    found: dict[str, Any] = {"number": task.number, "law": list(task.laws), "strength": task.strength}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        campaign = load_campaign(write("before", []))
        proposed = next_run(model_of(campaign), campaign)
        proposals = proposed.result.proposals if proposed.result else []
        if not proposals:
            return found | {"verdict": proposed.verdict}
        chance = {name: np.random.default_rng([task.seed, 77, k]) for k, name in enumerate(KINDS)}
        choices = {PROPOSED: series_of(proposals[0].kind, proposals[0].settings, made, chance[PROPOSED]), RANDOM: at_random(made, chance[RANDOM])}
        choices |= {name: series_of(e.kind, e.settings, made, chance[name]) for name, e in by_criteria(proposed, campaign).items()}
    acceptable = Case(result).acceptable
    known: dict[tuple[str, str, Setting], dict[str, Any]] = {}
    for name, series in choices.items():
        key = (series.quantity, str(sorted(series.tags.items())), series.setting)
        if key not in known:
            more = measure(chance[name], replace(design, series=[series], conditions={}, uneven=False), made.bench, made.truths)
            answer = answer_of(write(name, more))
            names = list(dict.fromkeys(e["name"] for e in answer["effects"]))
            known[key] = {"quantity": series.quantity, "setting": vars(series.setting), "verdict": answer["verdict"], "names": names,
                          "resolved": answer["verdict"] == ONE and names[0] in acceptable}  # fmt: skip
        found[name] = known[key]
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

    folder = arguments.folder.resolve()
    path = folder / EXPERIMENTS
    done = {json.loads(line)["number"] for line in path.read_text(encoding="utf-8").splitlines()} if path.is_file() else set()
    left = [r for r in enough_cases(folder, arguments.cases, arguments.jobs) if r["number"] not in done]
    started = time.perf_counter()
    with path.open("a", encoding="utf-8") as lines:
        made = Parallel(n_jobs=arguments.jobs, return_as="generator_unordered", batch_size=1)(delayed(one)(r, folder) for r in left)
        for k, found in enumerate(made, 1):
            lines.write(json.dumps(found, default=float) + "\n")
            lines.flush()
            told = {name: (found[name]["quantity"], found[name]["verdict"], *found[name]["names"]) for name in KINDS if name in found}
            minutes = (time.perf_counter() - started) / k * (len(left) - k) / 60.0
            print(found["number"], *found["law"], told or found["verdict"], f"[{k} of {len(left)}, {minutes:.0f} min left]", flush=True)
    print(json.dumps(resolved(folder), indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())
