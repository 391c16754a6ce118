"""Named physics on a real RV reducer of ratio 81, beside what knows none: python examples/rv_reducer_te/answer.py CLONE_OR_TABLE

Writes a campaign, the fitted model (model.toml), every figure (answer.json) and a page (answer.html) into a folder.
"""

import argparse
import json
import shutil
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from answer_page import NOT_BLIND, page_of
from named_physics import ARCSEC, LADDER, ZERO, Fitted, Fitter, Rung
from rivals import MISSING, RIVALS, count, predictions
from steps import steps_of

from discrepancy.campaign.from_rv_te import Measured, measured_in
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.write_rv_te import held_out, write_campaign
from discrepancy.model_file import ModelFile, every_effect, load_model, save_model
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from fmu_src.progress import task
from pages.render import rendered_sections

HERE = Path(__file__).resolve().parent
RATED = 1600.0
# Where the rig says no torque its own drag keeps the flanks together: a share of the rated torque (assumed; without one the output floats).
DRAG = 0.01
HELD_OUT = 0.2
STEPS = 1024
# A deviation from a fitted value that 95 % of repetitions would not exceed.
LIKELY = 1.96
SENSES = {1.0: "forward", -1.0: "backward"}


@dataclass(frozen=True)
class Errors:
    """Mean absolute error of the curve over conditions [arcsec], by sense: whole, of the waves alone, of the means alone."""

    whole: dict[str, float]
    waves: dict[str, float]
    means: dict[str, float]


def with_drag(record: Record) -> Record:
    return replace(record, factors={**record.factors, "load": max(record.factors["load"], DRAG * RATED)})


def curve(record: Record, numbers: Floats) -> Floats:
    """The curve over a turn that a record's numbers make."""
    angle = np.outer(np.asarray(record.axes["order"]), 2.0 * np.pi * np.arange(STEPS) / STEPS)
    return numbers @ np.where((np.asarray(record.axes["part"]) == 0.0)[:, None], np.cos(angle), np.sin(angle))


def errors(records: Sequence[Record], predicted: dict[int, Floats]) -> Errors:
    """Of the curves that the ten orders make; a condition whose mean nobody knows counts without it."""
    found: dict[str, dict[float, list[float]]] = {kind: {1.0: [], -1.0: []} for kind in ("whole", "waves", "means")}
    for i, numbers in predicted.items():
        left = records[i].values - numbers
        mean = np.asarray(records[i].axes["order"]) == 0.0
        for kind, of in (("whole", left), ("waves", np.where(mean, 0.0, left)), ("means", np.where(mean, left, 0.0))):
            found[kind][records[i].factors["direction"]].append(float(np.abs(curve(records[i], of)).mean()) / ARCSEC)
    return Errors(*({SENSES[s]: float(np.mean(e)) for s, e in by_sense.items() if e} for by_sense in found.values()))


def prepared(runs: Sequence[Measured], folder: Path) -> PhysicalModel:
    """The completed reducer on the campaign of what was measured, written into ``folder``."""
    write_campaign(folder / "campaign", runs, str(folder / "rig.toml"), RATED, None, HELD_OUT, True)
    shutil.copyfile(HERE / "rig.toml", folder / "rig.toml")
    campaign = load_campaign(folder / "campaign")
    campaign = replace(campaign, records=tuple(with_drag(r) for r in campaign.records), nuisances=())
    # Where the encoder's angle 0 lies is not asked: each effect that has one brings its own phase.
    return PhysicalModel(load_model(folder / "rig.toml"), campaign, zeros={})


def wanted(names: Path, conditions: Sequence[str]) -> set[str]:
    """Conditions that a file names, a line each; InputFault for one that nobody measured, before any work is done."""
    try:
        listed = set(names.read_text(encoding="utf-8").split())
    except (OSError, UnicodeDecodeError) as problem:
        raise InputFault(f"--held-out {names}: {problem}; give a text file with the name of a condition on each line") from None
    unknown = sorted(listed - set(conditions))
    if unknown or not listed:
        what = f"condition {unknown[0]}: nobody measured one of that name" if unknown else "it names no condition"
        raise InputFault(f"--held-out {names}: {what}; they look like {min(conditions)}")
    if listed >= set(conditions):
        raise InputFault(f"--held-out {names}: it names all {len(conditions)} conditions; leave some to fit")
    return listed


def chosen(records: Sequence[Record], names: set[str] | None) -> list[int]:
    """Records that are held out: those of some conditions, or those that the campaign marks."""
    return [i for i, r in enumerate(records) if (r.held_out if names is None else r.condition in names)]


def split_at_random(records: Sequence[Record], seed: int) -> list[int]:
    """Of each sense its share, as the campaign holds out."""
    held = held_out(sorted({r.condition for r in records}), HELD_OUT, seed)
    return [i for i, r in enumerate(records) if r.condition in held]


def others(records: Sequence[Record], held: Sequence[int]) -> list[int]:
    return sorted(set(range(len(records))) - set(held))


def of_rivals(records: Sequence[Record], held: Sequence[int]) -> dict[str, Errors]:
    return {name: errors(records, predictions(name, records, others(records, held), held)) for name in RIVALS}


def by_order(records: Sequence[Record], fitted: Fitted) -> list[dict[str, Any]]:
    """Of every order root mean squares [arcsec]: measured, and what the named effects leave, by sense."""
    rows = []
    for order in np.unique(np.concatenate([r.axes["order"] for r in records])):
        row: dict[str, Any] = {"order": float(order)}
        for sense, word in SENSES.items():
            here = [(r, y) for r, y in zip(records, fitted.predicted) if r.factors["direction"] == sense and order in r.axes["order"]]
            for kind, of in (("measured", [r.values for r, _ in here]), ("left", [r.values - y for r, y in here])):
                sizes = [float(np.sum(v[np.asarray(r.axes["order"]) == order] ** 2)) for v, (r, _) in zip(of, here)]
                row[f"{kind} {word}"] = float(np.sqrt(np.mean(sizes))) / ARCSEC
                row[f"median {kind} {word}"] = float(np.sqrt(np.median(sizes))) / ARCSEC
        rows.append(row)
    return rows


def intervals(fitted: Fitted) -> dict[str, tuple[float, float, float]]:
    """(value, low, high) of each number."""
    half = LIKELY * np.sqrt(np.maximum(np.diag(fitted.covariance), 0.0))
    return {n.name: (fitted.values[n.name], fitted.values[n.name] - h, fitted.values[n.name] + h) for n, h in zip(fitted.numbers, half)}


def model_file(model: PhysicalModel, fitted: Fitted, steps: Sequence[dict[str, Any]] = ()) -> ModelFile:
    """The fitted numbers as a model; the encoders' zero is the campaign's, not the reducer's, and calibrated there."""
    known, found = every_effect(), intervals(fitted)
    effects: dict[str, dict[str, dict[str, Any]]] = {}
    for rung in LADDER:
        if rung.effect == ZERO:
            continue
        units = {p.variable.name: p.variable.unit for p in known[rung.effect].parameters}
        effects[rung.effect] = {
            n.name: dict(zip(("value", "low", "high"), found[n.name])) | {"unit": units[n.name.partition("[")[0]]} for n in rung.numbers
        }  # fmt: skip
    return replace(model.file, name="rig of ratio 81", effects=effects, steps=tuple(steps))


def climbed(fitter: Fitter, held: Sequence[int]) -> list[tuple[Rung, Fitted]]:
    """Each rung, and the fit of all rungs up to it."""
    training = others(fitter.records, held)
    return [(rung, fitter.fit(LADDER[: place + 1], training)) for place, rung in enumerate(LADDER)]


def row_of(rung: Rung | None, records: Sequence[Record], predicted: Sequence[Floats], held: Sequence[int]) -> dict[str, Any]:
    """Errors on fitted and on held-out conditions, with all rungs up to this one; without any, if it is None."""
    found = {
        kind: vars(errors(records, {i: predicted[i] for i in which})) for kind, which in (("training", others(records, held)), ("held_out", held))
    }  # fmt: skip
    return found | ({"effect": rung.effect, "says": rung.says, "numbers": len(rung.numbers)} if rung else {})


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=Path, help="your clone of the public repository, or a table of orders made of it (.csv)")
    parser.add_argument("--output", type=Path, default=Path("rv_reducer_te_answer"), help="folder to write to (default rv_reducer_te_answer)")
    parser.add_argument("--held-out", type=Path, metavar="FILE", help="conditions that are used for nothing, one a line (default: every fifth, by chance)")
    parser.add_argument("--splits", type=int, default=20, help="further splits by chance (default 20)")
    options = parser.parse_args(arguments)
    try:
        runs, wrong = measured_in(options.source)
        names = wanted(options.held_out, [run.condition for run in runs]) if options.held_out else None
        model = prepared(runs, options.output)
    except InputFault as fault:
        print(f"answer.py: {fault}", file=sys.stderr)
        return 2
    answered(model, wrong, names, options.splits, options.output)
    return 0


def answered(model: PhysicalModel, wrong: list[str], names: set[str] | None, splits: int, output: Path) -> None:
    """Everything: fit, rivals, ``splits`` other splits, written into ``output`` and said."""
    records, held = model.records, chosen(model.records, names)
    fitter = Fitter(model)
    with task("ladder"):
        ladder = climbed(fitter, held)
    fitted = ladder[-1][1]
    rivals = of_rivals(records, held)
    spread: dict[str, list[Errors]] = {name: [] for name in ("named physics", *RIVALS)}
    for seed in range(splits):
        with task(f"split {seed + 1} of {splits}"):
            test = split_at_random(records, seed)
            tried = fitter.fit(LADDER, others(records, test))
            spread["named physics"].append(errors(records, {i: tried.predicted[i] for i in test}))
            for name, found in of_rivals(records, test).items():
                spread[name].append(found)
    ours = errors(records, {i: fitted.predicted[i] for i in held})
    result = {
        "conditions": len({r.condition for r in records}), "held_out": sorted(records[i].condition for i in held), "left_out": wrong,
        "held_out_by_sense": {word: sum(records[i].factors["direction"] == sense for i in held) for sense, word in SENSES.items()},
        "missing": MISSING,
        "numbers": {name: dict(zip(("value", "low", "high"), found)) for name, found in intervals(fitted).items()},
        "errors": {"named physics": vars(ours)} | {name: vars(e) for name, e in rivals.items()},
        "fitted_numbers": {"named physics": str(len(fitted.numbers))} | {name: count(name, records) for name in RIVALS},
        "ladder": [row_of(rung, records, found.predicted, held) for rung, found in ladder],
        "splits": {name: [vars(e) for e in found] for name, found in spread.items()},
        "orders": by_order(records, fitted),
    }  # fmt: skip
    (output / "answer.json").write_text(json.dumps(result, indent=1))
    steps = steps_of(row_of(None, records, fitter.predict({}), held), result["ladder"])
    save_model(model_file(model, fitted, steps), output / "model.toml")
    curves = {i: (curve(records[i], np.asarray(records[i].values)) / ARCSEC, curve(records[i], fitted.predicted[i]) / ARCSEC) for i in held}
    (output / "answer.html").write_text(rendered_sections(page_of(result, records, curves)))
    print(text_of(result))
    print(f"written: {', '.join(str(output / name) for name in ('answer.html', 'answer.json', 'model.toml'))}")


def text_of(result: dict[str, Any]) -> str:
    """The result in lines."""
    counts = ", ".join(f"{number} {word}" for word, number in result["held_out_by_sense"].items())
    lines = [f"{len(result['held_out'])} of {result['conditions']} conditions held out ({counts}); mean absolute error of the curve, arcsec"]
    lines.append(f"{'':30}{'numbers':>10}{'forward':>9}{'backward':>9}   other splits: forward, backward")
    for name, found in result["errors"].items():
        whole = found["whole"]
        other = [
            f"{np.mean(e):.1f} ± {np.std(e):.1f}" for word in SENSES.values()
            if (e := [s["whole"][word] for s in result["splits"][name] if word in s["whole"]])
        ]  # fmt: skip
        shown = "".join(f"{whole[w]:9.2f}" if w in whole else f"{'':9}" for w in SENSES.values())
        lines.append(f"{name:30}{result['fitted_numbers'][name]:>10}{shown}   {', '.join(other)}")
    return "\n".join([*lines, NOT_BLIND, *([result["missing"]] if result["missing"] else [])])


if __name__ == "__main__":
    sys.exit(main())
