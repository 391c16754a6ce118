"""Try: effects by hand.  A model of the folder stays in memory, and the predicted curve follows a slider."""

import math
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np

from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.model import Campaign
from discrepancy.inference.noise.series import stream_of
from discrepancy.model_file import every_effect, load_model
from discrepancy.page import amounts
from discrepancy.page.runs import axis_name
from discrepancy.prediction.candidates import parameter_of
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import BASE, ORDERS, Candidate, Parameter, Record
from discrepancy.scales import Scale, of_axis, of_number, of_parameter
from discrepancy.words.as_told import tables_of
from fmu_src.arrays import Floats
from fmu_src.effect import EffectParameter
from fmu_src.effect_words import effect_title
from fmu_src.faults import InputFault
from fmu_src.table import Table
from fmu_src.threads import Stopped, giving_way
from workbench.beside import Beside
from workbench.folder import Folder
from workbench.look import amplitudes_of
from workbench.own_zero import ALIKE, as_in_look, at_own_zero, moved
from workbench.thinned import looked_at, of_one, taken_words, thinned

# A slider reaches so many typical sizes to either side, where the bounds of the parameter are wider (assumed: what a bench meets).
REACH = 5.0
# Models that stay in memory.
KEPT = 2


class Trial:
    """One model held against one campaign; a move of the hand goes before all else, and runs beside what is computed exactly until that gives way."""

    def __init__(self) -> None:
        # Held, the first before the second: by what is computed exactly, one after the other, and by a move, or while models are opened or changed.
        self.slow, self.lock = threading.Lock(), threading.Lock()
        # By folder, model and what they were; the last two, for one may be looked at beside the other.
        self.models: dict[tuple[str, str, str], Beside] = {}
        # Moves that were asked for so far, in all tabs.
        self.moves = 0
        # When the last comparison was written, of which model, and what it calibrated.
        self.compared: tuple[int, str, dict[str, float]] = (0, "", {})

    def opened(self, folder: Folder, model: str) -> Beside:
        """The model, made anew where folder or model have changed, with what a diagnosis knows beside effects."""
        key = (str(folder.root), model, folder.stamp(model))
        found = self.models.pop(key, None)
        if found is None:
            campaign = load_campaign(folder.root)
            thin = replace(campaign, records=tuple(thinned(record) for record in campaign.records))
            found = Beside(PhysicalModel(load_model(folder.model({"model": model})), thin), campaign)
            while len(self.models) >= KEPT:
                self.models.pop(next(iter(self.models)))
        self.models[key] = found
        found.refresh()
        found.stand(self.standing(folder, model, found.model))
        return found

    def at_hand(self, folder: Folder, model: str) -> Beside | None:
        """The model if it is open as it is now; else it has to be opened, which changes what is computed with it."""
        found = self.models.get((str(folder.root), model, folder.stamp(model)))
        return found if found and found.stands(self.standing(folder, model, found.model)) else None

    def standing(self, folder: Folder, model: str, found: PhysicalModel) -> dict[str, float]:
        """What is calibrated first, as the last comparison of this model found it; else where it starts."""
        result = folder.memory / "jobs/compare/result.json"
        written = result.stat().st_mtime_ns if result.is_file() else 0
        # A move has no time to read all of it.
        if written != self.compared[0]:
            last = folder.recall("jobs/compare/result")
            self.compared = written, str(last.get("model")), last.get("nuisances", {})
        _, compared, calibrated = self.compared
        known = calibrated if compared == model else {}
        return found.standing() | {name: float(known[name]) for name in known if name in {p.name for p in found.nuisances}}

    def in_look(self, model: str) -> bool:
        """Whether Look shows errors of this model, as of the last time it was asked for."""
        return self.compared[1] == model

    def controls(self, folder: Folder, model: str) -> dict[str, Any]:
        """Every effect with its parameters as sliders, and the runs that can be looked at."""
        self.moves += 1
        with self.slow, self.lock:
            found = self.opened(folder, model).model
            about = every_effect()
            effects = []
            for candidate in found.candidates:
                if candidate.part == BASE:
                    continue
                effect = about.get(candidate.name.partition(".")[0])
                effects.append({
                    "name": candidate.name, "title": effect_title(candidate.name), "part": candidate.part, "signals": list(candidate.signals),
                    "law": effect.law if effect else "", "says": effect.signature if effect else candidate.title, "source": effect.source if effect else "",
                    "parameters": [slider(p, p in candidate.amplitudes) for p in candidate.parameters],
                })  # fmt: skip
            numbers = [base_number(c, tables_of(found)) for c in found.candidates if c.part == BASE]
            runs = [{"run": r.name, "signal": stream_of(r), "title": amounts.signal_title(stream_of(r)), "condition": r.condition, "replicate": r.replicate,
                     "held_out": r.held_out, "samples": len(r.values), "axis": axis_name(r)} for r in found.records if not r.left_out]  # fmt: skip
            return {"model": model, "effects": present(found) + effects, "numbers": numbers, "runs": runs}

    def curve(
        self, folder: Folder, model: str, run: str, values: Mapping[str, float], roughly: bool = False, beside: str = ""
    ) -> tuple[dict[str, Any], Floats]:
        """Values of a run over its axis, in the units of the bench: (words, rows axis, measured, base, predicted, model ``beside``).

        ``roughly``: while the hand moves, within some parts in a hundred of what the values change.  Exactly it gives way to a move, ``late``.
        """
        both = (model, beside or model)
        if roughly:
            self.moves += 1
            with self.lock:
                at_hand = [open_now for name in both if (open_now := self.at_hand(folder, name))]
                if len(at_hand) == len(both):
                    return drawn(at_hand, run, values, roughly, self.in_look(model))
            with self.slow, self.lock:
                return drawn([self.opened(folder, name) for name in both], run, values, roughly, self.in_look(model))
        try:
            with self.giving_way(folder, both) as found:
                return drawn(found, run, values, roughly, self.in_look(model))
        except Stopped:
            return {"late": True}, np.zeros((5, 0))

    def everywhere(self, folder: Folder, model: str, values: Mapping[str, float]) -> list[dict[str, Any]] | None:
        """What the values would do to each signal; None where it gave way to a move of the hand."""
        try:
            with self.giving_way(folder, (model,)) as (found,):
                return changes_of(found, values, self.in_look(model))
        except Stopped:
            return None

    @contextmanager
    def giving_way(self, folder: Folder, models: Sequence[str]) -> Iterator[list[Beside]]:
        """The models, for what ends by ``Stopped`` where a move is asked for from now on."""
        known = self.moves
        with self.slow:
            with self.lock:
                found = [self.opened(folder, name) for name in models]
            with giving_way(lambda: self.moves > known):
                yield found


def drawn(models: Sequence[Beside], run: str, values: Mapping[str, float], roughly: bool, in_look: bool) -> tuple[dict[str, Any], Floats]:
    """``Trial.curve`` of the first of two models that are open, beside the second, which may be the same; ``in_look``: whether Look has errors of it."""
    beside_it, second = models
    found = beside_it.model
    record = run_of(found, run)
    own, standing = checked_values(found, values), beside_it.standing
    in_common = found.one(record, standing)
    base, by = moved(record, in_common, found.nuisances)
    tried = own_curve(found, record, {**standing, **beside_it.calibrated(own, roughly), **own}, roughly) if own else base
    other = own_curve(second.model, run_of(second.model, run), second.standing) if second is not beside_it else base
    factor, unit = amounts.scale(record.unit, stream_of(record))
    name = axis_name(record)
    speed = of_axis("speed", found.campaign)
    x = amounts.axis_values(name, np.asarray(record.axes[name]), speed) if name else np.arange(len(record.values), dtype=float)
    # As the prediction's mean is fitted where a zero is free, all count from it.
    zero = float(base.mean()) if record.free_zero and name else 0.0
    curves = [curve - zero for curve in (np.asarray(record.values, np.float64), base, tried, other)]
    if record.quantity == ORDERS:
        every = np.asarray(record.axes["order"], np.float64)
        x, curves = np.unique(every), [amplitudes_of(every, values) for values in curves]
    axis = {"name": name or "sample", "title": amounts.axis_title(name, speed) if name else "sample"}
    words = {
        "unit": unit, "axis": axis, "loop": name == "torque", "stems": record.quantity == ORDERS, "title": amounts.signal_title(stream_of(record)),
        "condition": record.condition, "free": record.free_zero, "rms": [error_of(record, base) * factor, error_of(record, tried) * factor],
        "aside": list(record.far_off), "placed": beside_it.words(record, list(own)),
        "taken": taken_words(run_of(beside_it.campaign, run), found.records), "of": of_one(record, run_of(beside_it.campaign, run)),
        "look": as_in_look(error_of(record, in_common) * factor, error_of(record, base) * factor, unit, by) if in_look else "",
    }  # fmt: skip
    return words, np.array([x, *(factor * curve for curve in curves)])


def changes_of(beside: Beside, values: Mapping[str, float], in_look: bool) -> list[dict[str, Any]]:
    """What the values would do to each signal: root mean square of the change and of the error before and after, one run a condition.

    Of a new reducer exactly: of a large change a rough look leaves more than a bench's noise.  A life is dear, and looked at roughly.
    """
    found = beside.model
    own, standing = checked_values(found, values), beside.standing
    calibrated = {**standing, **beside.calibrated(own)}
    cells: dict[str, list[tuple[float, float, float]]] = {}
    in_common: dict[str, dict[str, list[float]]] = {}
    looked: dict[str, list[Record]] = {}
    seen = set()
    for record in found.records:
        key = (stream_of(record), record.condition, record.mounting)
        if key in seen or record.left_out:
            continue
        seen.add(key)
        roughly = is_worn(record)
        plain = found.one(record, standing, rough=roughly)
        base, tried = at_own_zero(record, plain, found.nuisances), own_curve(found, record, calibrated | own, roughly)
        in_common.setdefault(key[0], {}).setdefault("held out" if record.held_out else "fitted", []).append(error_of(record, plain))
        looked.setdefault(key[0], []).append(record)
        cells.setdefault(key[0], []).append((rms(tried - base), error_of(record, base), error_of(record, tried)))
    rows = []
    for signal, entries in cells.items():
        change, before, after = map(mean_of, zip(*entries))
        every = mean_of([error for errors in in_common[signal].values() for error in errors])
        unit = looked[signal][0].unit
        of_look = ", ".join(f"{kind} {amounts.text(mean_of(errors), unit, signal)}" for kind, errors in sorted(in_common[signal].items()))
        shown = [amounts.text(v, unit, signal) for v in (change, before, after)]
        rows.append({"signal": signal, "title": amounts.signal_title(signal), "change": shown[0], "before": shown[1], "after": shown[2],
                     "of": looked_at(looked[signal], beside.campaign.records),
                     "better": after < 0.97 * before, "touched": change > 1e-3 * max(before, 1e-300),
                     "look": of_look if in_look and abs(every - before) > ALIKE * before else ""})  # fmt: skip
    return rows


def own_curve(model: PhysicalModel, record: Record, values: Mapping[str, float], rough: bool = False) -> Floats:
    """What is shown of a record: each curve from its own zero."""
    return at_own_zero(record, model.one(record, values, rough=rough), model.nuisances)


def is_worn(record: Record) -> bool:
    return bool(np.any(np.asarray(record.axes.get("hours", record.factors.get("hours", 0.0))) > 0.0))


def run_of(model: PhysicalModel | Campaign, run: str) -> Record:
    """InputFault where there is none of that name."""
    found = next((r for r in model.records if r.name == run), None)
    if found is None:
        raise InputFault(f"{run}: there is no such run, or no prediction of it")
    return found


def error_of(record: Record, predicted: Floats) -> float:
    """Root mean square of what is left, without samples that stand far off."""
    return rms((record.values - predicted)[record.counted])


def rms(values: Floats) -> float:
    kept = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(kept**2))) if kept.size else 0.0


def mean_of(errors: Sequence[float]) -> float:
    """Root mean square of root mean squares."""
    return math.sqrt(float(np.mean(np.square(errors))))


def slider(p: Parameter, is_amplitude: bool, called: str = "", scale: Scale | None = None) -> dict[str, Any]:
    """A parameter in the unit that suits its size, or as ``scale`` has it, from bound to bound, or as far as a bench is likely to meet; ``called`` other
    than by its own name."""
    low, high = max(p.lower, p.off - REACH * p.scale), min(p.upper, p.off + REACH * p.scale)
    if p.sign > 0:
        low = p.off
    if p.sign < 0:
        high = p.off
    all_round, off = p.is_direction and p.upper - p.lower > 2.0 * math.pi, p.off
    if all_round:
        low, high, off = -math.pi, math.pi, math.remainder(p.off, 2.0 * math.pi)
    if p.counts:
        low, high = 1.0, p.upper
    # An angle is told in the unit of its usual size, as a diagnosis tells what it finds, not in that of how far the slider reaches.
    scale = scale or of_parameter(p.scale if p.unit == "rad" else max(abs(low), abs(high)), p.unit, p.is_direction)
    plain = p.description.removesuffix(" (0: off)")
    return {
        "name": p.name, "called": called or p.name.replace("_", " "), "unit": amounts.pretty(scale.unit), "factor": scale.factor,
        "offset": scale.offset, "off": scale.number(off),
        "low": scale.number(low), "high": scale.number(high), "bounds": [scale.number(p.lower), scale.number(p.upper)], "typical": scale.factor * p.scale,
        "amplitude": is_amplitude, "all_round": all_round, "counts": p.counts, "description": p.description, "of": "" if amounts.pretty(scale.unit) else plain,
    }  # fmt: skip


def base_number(candidate: Candidate, tables: Sequence[Table]) -> dict[str, Any]:
    """A number of the reducer, called and in the unit as on the reducer's own page: people look it up there."""
    [p] = candidate.parameters
    variable = next(t.by_name[p.name] for t in tables if p.name in t.by_name)
    return {"name": candidate.name, "title": variable.path, "parameters": [slider(p, True, variable.path, of_number(variable))]}


def own_parameters(model: PhysicalModel) -> dict[str, list[tuple[EffectParameter, Parameter]]]:
    """Of the effects that the model carries, as they stand in it; elements of arrays are left as they are."""
    about = every_effect()
    found = {}
    for name, entries in model.file.effects.items():
        known = {p.variable.name: p for p in about[name].parameters if p.kind != "choice"}
        found[name] = [(known[key], around(parameter_of(known[key], float(entry["value"])), known[key].variable.start)) for key, entry in entries.items()
                       if key in known]  # fmt: skip
    return found


def around(p: Parameter, start: float) -> Parameter:
    """With a slider that reaches from where the effect vanishes to as far beyond where it stands."""
    return replace(p, sign=0, scale=max(p.scale, 1.2 * abs(p.off - start) / REACH))


def present(model: PhysicalModel) -> list[dict[str, Any]]:
    """Effects that the model carries already: their sliders begin where they stand, and ``without`` takes them away."""
    about = every_effect()
    return [
        {"name": name, "title": effect_title(name), "part": "", "signals": [], "law": about[name].law, "says": about[name].signature,
         "source": about[name].source, "carried": True, "without": {p.variable.name: p.variable.start for p, _ in own if p.kind == "amplitude"},
         "parameters": [slider(parameter, p.kind == "amplitude") for p, parameter in own]}
        for name, own in own_parameters(model).items()
    ]  # fmt: skip


def checked_values(model: PhysicalModel, values: Mapping[str, Any]) -> dict[str, float]:
    """SI values of known parameters within their bounds; InputFault for any other."""
    known = {p.name: p for c in model.candidates for p in c.parameters}
    known |= {p.name: p for own in own_parameters(model).values() for _, p in own}
    found = {}
    for name, value in values.items():
        if name not in known:
            raise InputFault(f"{name}: no effect that this campaign can show has such a parameter")
        try:
            number = float(value)
        except (TypeError, ValueError):
            raise InputFault(f"{name}: {value!r} is no number") from None
        if not math.isfinite(number):
            raise InputFault(f"{name}: a finite number is needed")
        found[name] = min(max(number, known[name].lower), known[name].upper)
    return found
