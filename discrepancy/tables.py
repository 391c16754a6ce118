"""Results of comparison and diagnosis as tables that other programs read, in the units of a bench."""

import math
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from discrepancy.campaign.model import Campaign
from discrepancy.compare import Comparison, calibrated_numbers
from discrepancy.doubts.calibrated_deviations import deviations_of, doubt_of
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.noise.series import stream_of
from discrepancy.model_file import ModelFile
from discrepancy.prediction.defined_samples import defined_at
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record
from discrepancy.scales import Scale, of_axis, of_estimate, of_signal
from discrepancy.verdict import Answer
from discrepancy.words.as_told import tables_of as tables_in
from discrepancy.words.as_told import told_name
from discrepancy.words.intervals import relied_on
from exports.tables import Column, Table, rows_table
from fmu_src.arrays import Floats, Mask

# Keys of a comparison's rows that are in the signal's unit.
SCALED = ("error", "noise_floor")


def tables_of(result: Comparison | Answer | ModelFile) -> list[Table]:
    """Tables of a result; the first is what most would read, curves come last, one table a signal."""
    if isinstance(result, ModelFile):
        return [ladder_table(result)]
    return comparison_tables(result) if isinstance(result, Comparison) else answer_tables(result)


def ladder_table(file: ModelFile) -> Table:
    """The steps of a model: misfit in the patterns before and after, on fitted and on unused runs."""
    errors = ("training_before", "training_after", "held_out_before", "held_out_after")
    rows = [
        {"step": number, "effects": " + ".join(step["effects"]), "verdict": step.get("verdict", ""), "kept": step.get("kept", True)}
        | {key: none_as_nan(step.get(key)) for key in errors}
        for number, step in enumerate(file.steps, 1)
    ]  # fmt: skip
    return rows_table("steps", rows, {})


def comparison_tables(result: Comparison) -> list[Table]:
    """Errors and noise of runs and signals, key figures, and every sample measured and predicted.

    ``predicted`` is the base model's as it was calibrated: ``calibrated`` says what was.
    """
    space = result.diagnostician.space
    curves = curve_tables(space, {"predicted": result.predictions}, result.model.campaign)
    return [
        rows_table("runs", [in_bench_units(row) for row in result.runs], {}), rows_table("signals", [in_bench_units(row) for row in result.signals], {}),
        figure_rows(result.figures), *calibrated_rows(result.model, space), *curves,
    ]  # fmt: skip


def answer_tables(result: Answer) -> list[Table]:
    """What is named with its parameters, rivals, key figures, and every sample with the base model and the best fit."""
    found = result.diagnosis
    space = found.fits.space
    every = list(range(len(space.records)))
    predictions = {"base_model": space.predictions(space.base.values, every)}
    if found.fits.members:
        predictions["with_effect"] = space.predictions(found.fits.members[0].fit.values, every)
    rivals = [{"candidate": r["name"], "chi2_difference": none_as_nan(r["chi2_difference"]), "reason": r["reason"]} for r in found.rejected]
    verdict = [{"model": result.model.file.name, "campaign": result.model.campaign.name, "verdict": result.verdict, "reason": result.reason}]
    effects = rows_table("effects", [row for effect in result.effects for row in parameter_rows(effect, result)], {})
    named = [effects] if effects.columns else []
    curves = curve_tables(space, predictions, result.model.campaign)
    return [*named, rows_table("verdict", verdict, {}), rows_table("rivals", rivals, {}), figure_rows(result.figures, result.figures_after),
            *calibrated_rows(result.model, space), *curves]  # fmt: skip


def calibrated_rows(model: PhysicalModel, space: Workspace) -> list[Table]:
    """What of the base model was calibrated to the campaign before it was held against it; no table for nothing."""
    deviations = deviations_of(space.base)
    rows = [
        {"parameter": told, "value": scale.number(value), "unit": scale.unit,
         "standard_deviation": abs(scale.factor) * deviations.get(name, math.nan), "doubt": doubt_of(space.base, name)}
        for name, (told, value, scale) in zip(space.base.values, calibrated_numbers(model, space.base.values))
    ]  # fmt: skip
    return [rows_table("calibrated", rows, {})] if rows else []


def none_as_nan(value: float | None) -> float:
    return float("nan") if value is None else value


def parameter_rows(effect: Mapping[str, Any], answer: Answer) -> list[dict[str, Any]]:
    """A row a parameter, with the 95 % interval."""
    rows = []
    for name, p in effect["parameters"].items():
        low, high = relied_on(p)
        told = told_name(name, tables_in(answer.model))
        scale = of_estimate(p)
        rows.append({
            "effect": effect["name"], "variant": effect["variant"], "parameter": told, "value": scale.number(p["value"]), "low": scale.number(low),
            "high": scale.number(high), "unit": scale.unit, "share_explained": effect["share_explained"],
            "held_out_error_before": none_as_nan(effect.get("held_out_error_before")), "held_out_error_after": none_as_nan(effect.get("held_out_error_after")),
        })  # fmt: skip
    return rows


def in_bench_units(row: Mapping[str, Any]) -> dict[str, Any]:
    scale = of_signal(row["signal"], row["unit"])
    return dict(row) | {key: scale.number(row[key]) for key in SCALED} | {"unit": scale.unit}


def figure_rows(figures: Sequence[KeyFigure], after: Sequence[KeyFigure] = ()) -> Table:
    """``after``: the same with what a diagnosis names, if it names anything, in columns of their own."""
    rows = []
    for k, f in enumerate(figures):
        scale = of_signal(f.told_as, f.unit)
        rows.append({
            "signal": f.signal, "condition": f.condition, "figure": f.name, "measured": scale.number(f.measured), "model": scale.number(f.model),
            "noise": scale.factor * f.noise, "unit": scale.unit, "off_in_noise": f.off, "runs": f.runs,
            "model_curve": curve_of(f, scale), "model_from": f.model_from,
        } | ({"with_effect": scale.number(after[k].model), "off_in_noise_with_effect": after[k].off,
              "with_effect_curve": curve_of(after[k], scale)} if after else {}))  # fmt: skip
    return rows_table("key_figures", rows, {})


def curve_of(f: KeyFigure, scale: Scale) -> float:
    """What the model's curve has by itself, without noise."""
    return scale.number(f.model if f.model_curve is None else f.model_curve)


def curve_tables(space: Workspace, predictions: Mapping[str, Sequence[Floats]], campaign: Campaign) -> list[Table]:
    """Of each signal a row a sample: run, condition, axes, measured, each prediction, noise (standard deviation); what was dropped is left out.

    Samples near no torque, where the output floats, have neither prediction nor noise (NaN, an empty cell).
    """
    groups: dict[str, list[int]] = defaultdict(list)
    for i, record in enumerate(space.records):
        groups[stream_of(record)].append(i)
    return [curve_table(signal, indices, space, predictions, campaign) for signal, indices in groups.items()]


@dataclass(frozen=True)
class Rows:
    """Which samples of a run as it was measured are exported: ``shown`` (n,); ``compared`` (m,) of these have a prediction, of which
    ``kept`` are the samples in the model's record."""

    measured: Record
    shown: Mask
    compared: Mask
    kept: Mask

    def of_measured(self, values: Floats) -> Floats:
        return np.asarray(values, float)[self.shown]

    def of_model(self, values: Floats) -> Floats:
        """NaN where there is no prediction."""
        found = np.full(int(self.shown.sum()), np.nan)
        found[self.compared] = np.asarray(values, float)[self.kept]
        return found


def rows_of(record: Record, kept: Mask, measured: Mapping[str, Record], campaign: Campaign) -> Rows:
    whole = measured.get(record.name, record)
    defined = defined_at(whole, campaign) if len(whole.values) > len(record.values) else np.ones(len(record.values), bool)
    shown = ~defined
    shown[defined] = kept
    return Rows(whole, shown, defined[shown], kept)


def curve_table(signal: str, indices: Sequence[int], space: Workspace, predictions: Mapping[str, Sequence[Floats]], campaign: Campaign) -> Table:
    records, whiteners = [space.records[i] for i in indices], [space.noise.whiteners[i] for i in indices]
    measured = {r.name: r for r in campaign.records}
    runs = [rows_of(r, w.kept, measured, campaign) for r, w in zip(records, whiteners)]
    counts = [int(run.shown.sum()) for run in runs]
    scale = of_signal(signal, records[0].unit)
    columns = [
        Column(name, "", np.repeat(np.array(values), counts)) for name, values in (
            ("run", [r.name for r in records]), ("condition", [r.condition for r in records]), ("replicate", [r.replicate for r in records]),
            ("held_out", [r.held_out for r in records]), ("left_out", [r.left_out for r in records]))
    ]  # fmt: skip
    for name in dict.fromkeys(factor for r in records for factor in r.factors if factor != "direction"):
        axis = of_axis(name, campaign)
        values = [axis.number(r.factors[name]) if name in r.factors else float("nan") for r in records]
        columns.append(Column(f"{name}_set", axis.unit, np.repeat(values, counts)))
    for name in dict.fromkeys(axis for r in records for axis in r.axes):
        axis = of_axis(name, campaign)
        parts = [axis.factor * run.of_measured(run.measured.axes[name]) + axis.offset if name in run.measured.axes else np.full(n, np.nan)
                 for run, n in zip(runs, counts)]  # fmt: skip
        columns.append(Column(name, axis.unit, np.concatenate(parts)))
    stacks = {"measured": [run.of_measured(run.measured.values) for run in runs]}
    stacks |= {name: [run.of_model(rows[i]) for run, i in zip(runs, indices)] for name, rows in predictions.items()}
    for name, parts in stacks.items():
        columns.append(Column(name, scale.unit, scale.factor * np.concatenate(parts) + scale.offset))
    noises = []
    for run, w in zip(runs, whiteners):
        noise = np.full(len(w.kept), np.nan)
        noise[w.kept] = w.scale * np.sqrt(1.0 + w.between)
        noises.append(run.of_model(noise))
    columns.append(Column("noise", scale.unit, scale.factor * np.concatenate(noises)))
    return Table("_".join(part for part in signal.replace("[", "_").replace("]", "").replace("=", "_").replace(",", "_").split()), tuple(columns))
