"""A full diagnosis of a campaign: cost against conditions, samples and candidate effects, and what takes the time.

Campaigns come from the blind trial's generator: transmission error, loops of torque and input torque in turn, a drag
that the model lacks, in every fifth condition held out.  Each is diagnosed from nothing, as the blind trial does it.
"""

import tempfile
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import chain, zip_longest
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np

from benchmarks.blind_trial.generator.designs import TURN, Design, make_design
from benchmarks.blind_trial.generator.folder import write_campaign
from benchmarks.blind_trial.generator.laws.friction import Drag
from benchmarks.blind_trial.generator.make import measure as measured_runs
from benchmarks.blind_trial.generator.truth import Bench
from benchmarks.ratios import Curve, Figure, Measured, exponent
from discrepancy.campaign.load import load_campaign
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.selection import Selection
from discrepancy.model_file import load_model
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.verdict import diagnose

SEED = 5
DRAG = 0.05  # [N m] at the input
CONDITIONS = 20
# Growth is measured about this case: conditions, samples of a transmission error, share of the catalogue.
MIDDLE = (6, 360, 0.5)
# Wall time of the case with all conditions and the whole catalogue on two cores [s].
LIMIT = 60.0
# What is timed -> its part of a diagnosis; the rest of the run is the verdict.
STAGES = {
    (Workspace, "fit_base"): "base fit", (Diagnostician, "prepare"): "localisation", (Diagnostician, "screened"): "screening",
    (Selection, "foremost"): "refits", (Selection, "compared"): "refits", (Selection, "several"): "rivals",
}  # fmt: skip


@dataclass(frozen=True)
class Diagnosed:
    """Processor and wall time [s] of model and diagnosis, wall time by stage [s], predictions asked for."""

    processor: float
    wall: float
    stages: dict[str, float]
    predictions: int
    candidates: int
    verdict: str


def design_of(conditions: int, samples: int) -> Design:
    """The rich design with the first ``conditions`` of its blocks in turn, ``samples`` per transmission error."""
    design = make_design(np.random.default_rng(SEED), ["te", "loops", "torque"], "rich")
    blocks = [[n for n in design.conditions if n.startswith(word)] for word in ("te", "loop", "drive")]
    names = [n for n in chain.from_iterable(zip_longest(*blocks)) if n is not None][:conditions]
    design.conditions = {n: design.conditions[n] for n in names}
    design.held_out = set(names[4::5])
    design.series = [s for s in design.series if s.condition in names]
    for series in design.series:
        if "angle" in series.axes:
            series.axes["angle"] = np.linspace(0.0, TURN, samples, endpoint=False)
    return design


def write(folder: Path, conditions: int, samples: int) -> None:
    """A campaign in ``folder``/measured."""
    rng, design = np.random.default_rng(SEED), design_of(conditions, samples)
    truth = Drag(rng)
    truth.a = DRAG
    write_campaign(folder / "measured", "measured", design, measured_runs(rng, design, Bench({}), [truth]), "not sealed")


@contextmanager
def stopwatch() -> Iterator[dict[str, float]]:
    """Wall time of the stages of whatever diagnosis runs meanwhile."""
    spent = dict.fromkeys(STAGES.values(), 0.0)
    kept = {place: getattr(*place) for place in STAGES}

    def timed(function: Callable[..., Any], stage: str) -> Callable[..., Any]:
        def run(*arguments: Any, **options: Any) -> Any:
            begun = time.perf_counter()
            try:
                return function(*arguments, **options)
            finally:
                spent[stage] += time.perf_counter() - begun
        return run

    for (owner, name), stage in STAGES.items():
        setattr(owner, name, timed(kept[owner, name], stage))
    try:
        yield spent
    finally:
        for (owner, name), function in kept.items():
            setattr(owner, name, function)
        # The base fit is the first part of the preparation.
        spent["localisation"] -= spent["base fit"]


def diagnosed(conditions: int, samples: int, share: float = 1.0, jobs: int = 1) -> Diagnosed:
    """Diagnosis of one campaign with ``share`` of the catalogue's candidates."""
    with tempfile.TemporaryDirectory() as temporary, warnings.catch_warnings(), stopwatch() as spent:
        warnings.simplefilter("ignore")
        write(Path(temporary), conditions, samples)
        campaign, file = load_campaign(Path(temporary) / "measured"), load_model("RV20E-121")
        processor, wall = process_time(), time.perf_counter()
        model = PhysicalModel(file, campaign, jobs=jobs)
        built = time.perf_counter() - wall
        # Evenly over the catalogue, which goes from part to part.
        model.candidates = model.candidates[:: round(1.0 / share)]
        answer = diagnose(file, campaign, model=model)
        processor, wall = process_time() - processor, time.perf_counter() - wall
    stages = {"model": built} | spent | {"verdict": wall - built - sum(spent.values())}
    return Diagnosed(processor, wall, stages, answer.diagnosis.fits.space.predictions.calls, len(model.candidates), answer.verdict)


def grow(found: Measured, what: str, points: list[tuple[float, Diagnosed]]) -> None:
    """Exponents of processor time and of predictions against a size."""
    for kind, unit, value in (("processor time", "s", lambda d: d.processor), ("predictions", "1", lambda d: float(d.predictions))):
        line = [(size, value(d)) for size, d in points]
        power = exponent(line)
        found.figures.append(Figure("diagnosis", f"{kind} of a diagnosis against {what}, exponent", power, "1",
                                    note=", ".join(f"{size:g}: {v:.3g}" for size, v in line)))
        found.curves.append(Curve(f"Diagnosis: {kind} against {what}", what, unit, {kind: line}, {kind: power}))


def measure(quick: bool = False) -> Measured:
    found = Measured()
    conditions, samples, share = MIDDLE
    # Loads what the runs share.
    diagnosed(3, samples, 0.1)
    whole = diagnosed(3, samples, 0.25) if quick else diagnosed(CONDITIONS, samples)
    text = f"diagnosis of {3 if quick else CONDITIONS} conditions, {whole.candidates} candidates"
    found.figures += [
        Figure("diagnosis", f"{text}: processor time", whole.processor, "s", note=f"{whole.predictions} predictions; {whole.verdict}"),
        Figure("diagnosis", f"{text}: wall time in one process", whole.wall, "s"),
        *(Figure("diagnosis", f"{text}: {stage}", seconds, "s", note=f"{seconds / whole.wall:.0%} of the wall time")
          for stage, seconds in whole.stages.items()),
    ]  # fmt: skip
    if quick:
        return found
    pair = diagnosed(CONDITIONS, samples, jobs=2)
    found.figures.append(Figure("diagnosis", f"{text}: wall time with two processes, their start included", pair.wall, "s", at_most=LIMIT,
                                note="other load on the machine counts against it"))
    middle = diagnosed(*MIDDLE)
    half, twice = conditions // 2, 2 * conditions
    grow(found, "conditions", [(half, diagnosed(half, samples, share)), (conditions, middle), (twice, diagnosed(twice, samples, share))])
    grow(found, "samples of a run", [(samples, middle), *((k * samples, diagnosed(conditions, k * samples, share)) for k in (2, 4))])
    fewer, more = (diagnosed(conditions, samples, s) for s in (0.5 * share, 2.0 * share))
    grow(found, "candidates", [(d.candidates, d) for d in (fewer, middle, more)])
    return found
