"""Step 1: calibrate the declared nuisances, predict every run, hold it against what was measured."""

import math
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from discrepancy.alike.untold import parts_untold_before
from discrepancy.campaign.amount import readable
from discrepancy.campaign.angle_doubts import angle_doubts
from discrepancy.campaign.design import Design
from discrepancy.campaign.doubts import order_of_rows
from discrepancy.campaign.findings import Finding, exchanges, missing_factors
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.quantities import VALUE
from discrepancy.campaign.repetition_words import copied_words, what_is_done, words
from discrepancy.campaign.sample_words import REMEDY, words_of
from discrepancy.doubts.calibrated_deviations import AT_BOUND, deviations_of, stands_at_bound
from discrepancy.doubts.calibrated_doubts import calibrated_doubts, softer_by_loops
from discrepancy.doubts.locked_doubts import locked_doubts
from discrepancy.doubts.locked_zeros import zero_texts
from discrepancy.doubts.plausible import doubts_of
from discrepancy.doubts.unstated_texts import place_texts
from discrepancy.figures.figure_chance import chance_text
from discrepancy.figures.key_figures import KeyFigure, key_figures
from discrepancy.figures.stiffest import too_soft
from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.noise.series import stream_of
from discrepancy.inference.verdict import Settings
from discrepancy.model_file import ModelFile
from discrepancy.outlying_samples import outlying_samples
from discrepancy.prediction.conditions import LAG_SHARE
from discrepancy.prediction.orders import named_orders
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.prediction.unstated_places import is_from_there
from discrepancy.repetitions import Outlying
from discrepancy.scales import Scale, of_calibrated, shown
from discrepancy.words import as_told
from discrepancy.words.standing_notes import floating_of, standing_notes
from fmu_src.arrays import Floats
from fmu_src.threads import sharing_no_matrices
from reducers.reducer import Reducer

# A run whose error is this many times its noise is worth a look.
CONSPICUOUS = 1.5
# Of a number's usual size; what a fit that ends at 0 leaves is less.
ROUNDING = 1e-7


@dataclass(frozen=True)
class Comparison:
    """Measured against predicted.

    ``runs``: one entry per run with rms error and noise floor in the record's SI unit;
    ``signals``: the same by signal, apart for training and held-out runs; ``predictions``:
    predicted values per run, in the order of ``model.records``; ``scale_doubts``: those of ``warnings``
    that doubt the scale of what was measured.
    """

    model: PhysicalModel
    diagnostician: Diagnostician
    runs: list[dict[str, Any]]
    signals: list[dict[str, Any]]
    nuisances: dict[str, float]
    warnings: list[str]
    predictions: list[Floats]
    outlying: list[Outlying] = field(default_factory=list)
    figures: list[KeyFigure] = field(default_factory=list)
    scale_doubts: list[Finding] = field(default_factory=list)

    @property
    def of_chance(self) -> str:
        """What chance makes of the key figures, where no place carries a significant misfit; else what is off is said already."""
        return "" if self.diagnostician.localisation.findings else chance_text(self.figures)

    def as_json(self) -> dict[str, Any]:
        tables, units = as_told.tables_of(self.model), {p.name: p.unit for p in self.model.nuisances}
        signals, runs = ([as_told.row(r, r["signal"], r["unit"], ("error", "noise_floor")) for r in rows] for rows in (self.signals, self.runs))
        return {
            "model": self.model.file.name, "campaign": self.model.campaign.name, "signals": signals, "runs": runs,
            "nuisances": as_told.numbers(self.nuisances, units, tables), "warnings": self.warnings, "not_predicted": self.model.unpredicted,
            "key_figures": as_told.figures(self.figures),
            "outlying": [asdict(o) | {"weight": o.weight} for o in self.outlying],
            "localisation": self.diagnostician.localisation.to_dict(),
        }  # fmt: skip


@sharing_no_matrices
def compare(file: ModelFile, campaign: Campaign, settings: Settings = Settings(), model: PhysicalModel | None = None,
            jobs: int = 1, fmus: Path | None = None) -> Comparison:
    """Hold a model against a campaign; localises the misfit on the way.  ``fmus``: folder of FMUs to predict with."""
    model = model or PhysicalModel(file, campaign, jobs=jobs, fmus=fmus)
    diagnostician = Diagnostician(model, settings, named_orders(model.bench, model.campaign.orders))
    diagnostician.prepare()
    space = diagnostician.space
    every = list(range(len(space.records)))
    predictions = space.predictions(space.base.values, every)
    floating = floating_of(model.campaign)
    runs = [run | {"near_no_torque": floating.get(run["run"], 0)} for run in runs_of(space, predictions)]
    scales = doubts_of(zip(space.records, predictions), campaign)
    # With effects in the model file positions are found; without, all are the mean.
    places = place_texts(model, frozenset(), space.base.values)
    doubts = [f"{d.text}; {d.remedy}" for d in (*scales, *([] if places else locked_doubts(campaign)))] + places
    figures = figures_of(diagnostician, model)
    doubts += calibrated_doubts(space.base, as_told.tables_of(model), records=space.records, softer=softer_by_loops(figures))
    doubts += zero_texts(model, space, space.base)
    warnings = parts_untold_before(file) + beforehand(model, figures, runs) + doubts + warnings_of(model, list(space.noise.warnings))
    calibrated = {name: value for name, value in space.base.values.items() if not is_from_there(name)}
    return Comparison(model, diagnostician, runs, by_signal(runs), calibrated, warnings, predictions, model.outlying, figures, scales)


def calibrated_texts(model: PhysicalModel, values: Mapping[str, float], base: Fit | None = None) -> list[str]:
    """What of the model was calibrated to the campaign before it was held against it, a line for each meaning; empty for nothing.

    ``angle_zero[1] = -1.048 +- 0.002 deg, angle_zero[2] = 0.05 +- 0.002 deg: output angle of the model at the record's angle 0``: with the standard
    deviation, where it is known, within which a calibration beside other effects finds another number.
    """
    deviations = deviations_of(base) if base else {}
    meanings = {p.name: p.description for p in model.nuisances}
    lines: dict[str, list[str]] = {}
    for own, (name, value, scale) in zip(values, calibrated_numbers(model, values)):
        # Without one there is nothing that numbers have in common.
        bound = f" ({AT_BOUND})" if base and stands_at_bound(base, own) else ""
        lines.setdefault(meanings.get(own) or name, []).append(f"{name} = {with_deviation(value, deviations.get(own, 0.0), scale)}{bound}")
    known = set(meanings.values())
    return [", ".join(numbers) + (f": {meaning}" if meaning in known else "") for meaning, numbers in lines.items()]


def with_deviation(value: float, deviation: float, scale: Scale) -> str:
    """``1.015 +- 0.031``, in the unit behind it; without a deviation the number alone."""
    size = abs(scale.factor) * deviation
    if not 0.0 < size < math.inf:
        return scale.text(value, 4)
    told, unit = scale.number(value), "" if scale.unit == "1" else scale.unit
    return f"{readable(told, digits_beside(told, size))} +- {readable(size, 2)} {unit}".rstrip()


def digits_beside(value: float, deviation: float) -> int:
    """So many digits of a value that its last is not above the first of its ``deviation``; four at least."""
    return max(4, 1 + math.floor(math.log10(abs(value))) - math.floor(math.log10(deviation))) if value and deviation > 0.0 else 4


def calibrated_numbers(model: PhysicalModel, values: Mapping[str, float]) -> list[tuple[str, float, Scale]]:
    """Calibrated numbers (SI) by the names that are told, with the scale to tell them in."""
    known, tables = {p.name: p for p in model.nuisances}, as_told.tables_of(model)
    found = []
    for name, value in values.items():
        unit, least = (known[name].unit, ROUNDING * known[name].scale) if name in known else ("1", 0.0)
        # A share at its bound is 0 but for what a solver leaves, here as in what is said against it.
        told = 0.0 if abs(value) < least else round(value, 4) if name == LAG_SHARE else value
        found.append((as_told.told_name(name, tables), told, of_calibrated(name, abs(told), unit)))
    return found


def figures_of(diagnostician: Diagnostician, model: PhysicalModel, values: Mapping[str, float] | None = None) -> list[KeyFigure]:
    """Key figures of what was measured beside those of the base model with its nuisances, or of the model at other ``values`` (SI)."""
    space = diagnostician.space
    predictions = space.predictions(space.base.values if values is None else values, list(range(len(space.records))))
    return key_figures(space, predictions, diagnostician.orders, model.campaign.rated_torque or model.bench.rated_load)


def runs_of(space: Workspace, predictions: Sequence[Floats]) -> list[dict[str, Any]]:
    """Error and noise floor of every run, root mean square in SI units, for the predicted values of all records."""
    runs = []
    for record, predicted, whitener in zip(space.records, predictions, space.noise.whiteners):
        kept = whitener.kept
        error = float(np.sqrt(np.mean((record.values - predicted)[kept] ** 2))) if kept.any() else float("nan")
        floor = whitener.floor
        runs.append({
            "run": record.name, "signal": stream_of(record), "condition": record.condition, "replicate": record.replicate,
            "held_out": record.held_out, "left_out": record.left_out, "unit": record.unit, "samples": int(kept.sum()), "dropped": int((~kept).sum()),
            "error": error, "noise_floor": floor, "ratio": error / floor if floor > 0.0 else float("inf"),
        })  # fmt: skip
    return runs


def outlier_text(found: Outlying, model: PhysicalModel, runs: Sequence[Mapping[str, Any]] = ()) -> str:
    """A repetition that stands out, what the model makes of it and of the others in these ``runs``, and what is done about it."""
    alike = [r for r in runs if r["signal"] == found.signal and r["condition"] == found.condition]
    own = [r["error"] for r in alike if r["run"] == found.run]
    rest = [r["error"] for r in alike if r["run"] != found.run]
    errors = [shown(v, found.unit, found.signal) for v in (*own, min(rest), max(rest))] if own and rest else []
    errs = f"; the model errs there by {errors[0]}, in the others by {' to '.join(dict.fromkeys(errors[1:]))}" if errors else ""
    return f"{words(found)}{model.campaign.place(found.run, VALUE)}{errs}; {what_is_done(found)}"


def by_signal(runs: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Root mean squares over the runs of a signal that are not left out, training and held-out apart."""
    cells: dict[tuple[str, bool], list[dict[str, Any]]] = defaultdict(list)
    for run in runs:
        if not run["left_out"]:
            cells[run["signal"], run["held_out"]].append(run)
    return [
        {
            "signal": signal, "held_out": held_out, "runs": len(members), "unit": members[0]["unit"],
            "error": rms(m["error"] for m in members), "noise_floor": rms(m["noise_floor"] for m in members),
            "ratio": rms(m["error"] for m in members) / rms(m["noise_floor"] for m in members),
        }
        for (signal, held_out), members in sorted(cells.items())
    ]  # fmt: skip


def rms(values: Iterable[float]) -> float:
    return float(np.sqrt(np.mean(np.square(list(values)))))


def another_reducer(model: PhysicalModel) -> Reducer | None:
    """The reducer that the campaign names, if it is not the model's."""
    named = model.campaign.reducer
    return None if named is None or named.name == model.file.reducer.name else named


def reducer_words(model: PhysicalModel) -> list[str]:
    """That the campaign is of another reducer, and what to do."""
    if (named := another_reducer(model)) is None:
        return []
    made_of = model.file.reducer.name
    return [f"the campaign is of {named.name}, the model is made of {made_of}: whatever differs between the two looks like an effect; take {named.name}"]


def beforehand(model: PhysicalModel, figures: Sequence[KeyFigure], runs: Sequence[Mapping[str, Any]] = ()) -> list[str]:
    """What is said before anything is fitted: another reducer, wrong angles, shuffled rows, interchanged runs, samples and repetitions far off, a base
    that is too soft, conditions that leave something out; ``runs``: with what the model makes of them, where it was held against them."""
    design = Design(model.campaign)
    angles = [found.sentence for found in (*angle_doubts(model.campaign), *order_of_rows(design), *exchanges(design))]
    samples = [f"{words_of(found, model.campaign)}; {REMEDY}" for found in outlying_samples(model.campaign.records)]
    repetitions = [outlier_text(found, model, runs) for found in model.outlying]
    return [*reducer_words(model), *angles, *samples, *repetitions, *too_soft(figures, model.bench), *incomplete(model.campaign)]


def incomplete(campaign: Campaign) -> list[str]:
    """Conditions that leave out what their quantities depend on: the model's own number stands in, which may be wrong by much."""
    return [f"{found.text}: the model's own is taken; {found.remedy}" for found in missing_factors(Design(campaign))]


def warnings_of(model: PhysicalModel, warnings: list[str]) -> list[str]:
    if model.unpredicted:
        warnings.append(f"no prediction for {', '.join(model.unpredicted)}: these runs are left out")
    warnings += standing_notes(model.campaign, model.records)
    warnings += ["; ".join(copied_words(model.campaign.copies))] if model.campaign.copies else []
    if not any(r.unused for r in model.records):
        warnings.append("no run is held out: nothing says how the model does on conditions that it has not seen")
    return warnings
