"""Step 3: which effect the model lacks, as an answer that can be read, kept and acted upon.

The statistics speaks of candidates; several can be variants of one effect (a pin ring off
centre, or oval).  Here they are put together under the effect's name.
"""

import time
from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

from discrepancy.alike.opposite_sign import with_others
from discrepancy.alike.other_places import placed
from discrepancy.alike.ring_directions import either_texts, seen_from_crank
from discrepancy.alike.unsearched_places import unsearched_text
from discrepancy.alike.untold import origins_untold, parts_untold_before
from discrepancy.campaign.model import Campaign
from discrepancy.compare import beforehand, figures_of, reducer_words, warnings_of
from discrepancy.doubts.calibrated_doubts import calibrated_doubts, softer_by_loops
from discrepancy.doubts.hidden_by_position import hidden_by_position
from discrepancy.doubts.locked_zeros import zero_texts, zeros_told
from discrepancy.doubts.unstated_texts import unstated_texts
from discrepancy.doubts.whose_angle import gained_as_input
from discrepancy.figures.beside_none import beside_none
from discrepancy.figures.figure_chance import chance_text
from discrepancy.figures.key_figures import GAIN, KeyFigure, calibrated_first
from discrepancy.figures.stiffest import out_of_reach, too_rigid
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.law.recover import Recovered, recover
from discrepancy.inference.noise.series import stream_of
from discrepancy.inference.refit.profile import Profile
from discrepancy.inference.verdict import INCOMPLETE, NONE, ONE, SET, SEVERAL, STOPPED, UNKNOWN, Diagnosis, Interrupted, Settings
from discrepancy.model_file import ModelFile
from discrepancy.prediction.orders import named_orders
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.scales import of_axis, of_signal, unit_of_axis
from discrepancy.words import as_told
from discrepancy.words.waves import waves_of
from discrepancy.words.would_show import WouldShow, would_show
from fmu_src.progress import say, task
from fmu_src.table import Table
from fmu_src.threads import sharing_no_matrices
from reducers.library import available


@dataclass(frozen=True)
class Answer:
    """A diagnosis with its effects by name; ``laws`` are what was recovered where no name fits, ``doctor`` can go on from here,
    ``made`` is when it was made [s since 1970], ``made_in`` the campaign's folder: one that is kept is found again later;
    ``profiles`` of fits by their name, once a page has drawn them;
    ``untold``: from which of two things what is named, or stands in the model file, comes; ``zeros``: of angles [rad], as loops tell them;
    ``would_show``: what an answer is worth that nothing is missing;
    ``figures`` are of the base model, ``figures_after`` the same with what fits best in it, empty where nothing was fitted."""

    model: PhysicalModel
    diagnosis: Diagnosis
    verdict: str
    reason: str
    effects: list[dict[str, Any]]
    confusable: list[str]
    laws: list[Recovered]
    warnings: list[str]
    figures: list[KeyFigure]
    doctor: Diagnostician = field(repr=False)
    made: float = field(default_factory=time.time, compare=False)
    made_in: str = field(default="", compare=False)
    untold: list[str] = field(default_factory=list)
    zeros: dict[str, float] = field(default_factory=dict)
    profiles: dict[str, list[Profile]] = field(default_factory=dict, repr=False, compare=False)
    figures_after: list[KeyFigure] = field(default_factory=list)
    would_show: WouldShow | None = None

    @property
    def added(self) -> str:
        """What ``figures_after`` have in the model; of alternatives the first."""
        return self.diagnosis.fits.members[0].name if self.diagnosis.fits.members else ""

    @property
    def of_chance(self) -> str:
        """What chance makes of the key figures, where nothing is missing."""
        return chance_text(self.figures) if self.verdict == NONE else ""

    @property
    def left_over(self) -> str:
        """What is said of a misfit that is left, as the end of a sentence."""
        most, members = self.doctor.settings.most_effects, self.diagnosis.fits.members
        if members and len(members[0].candidates) >= most:
            return f"beyond the {most} effects that are looked for at once: add what is named and diagnose again"
        if not members:
            return "that no effect of the catalogue explains"
        # Others may do so together, or with numbers that a diagnosis holds: only what was tried is said.
        return f"that none of the effects tried beside {'it' if len(members[0].candidates) == 1 else 'them'} explains"

    def in_si(self) -> dict[str, Any]:
        """Everything in SI units and by the names that kernels have: what programs of this project go on with."""
        plain = self.diagnosis.to_dict()
        return plain | {
            "model": self.model.file.name, "campaign": self.model.campaign.name, "verdict": self.verdict, "reason": self.reason,
            "effects": self.effects, "confusable": self.confusable, "warnings": self.warnings, "untold": self.untold,
            "laws": [law.to_dict() for law in self.laws], "not_predicted": self.model.unpredicted,
            "key_figures": [f.as_json() for f in self.figures], "key_figures_after": [f.as_json() for f in self.figures_after],
            "would_show": self.would_show.as_json() if self.would_show else None,
        }  # fmt: skip

    def as_json(self) -> dict[str, Any]:
        """By the names and in the units that screen and page have."""
        space, tables = self.diagnosis.fits.space, as_told.tables_of(self.model)
        units = {p.name: p.unit for p in space.base.parameters}
        signals = {stream_of(r): r.unit for r in space.records}
        held_out = {
            name: entry | {"rms": {s: as_told.row(r, s, signals[s], ("before", "after", "floor")) for s, r in (entry.get("rms") or {}).items()}}
            for name, entry in self.diagnosis.held_out.items()
        }
        nuisances = self.diagnosis.nuisances | {name: zero for name, zero in self.zeros.items() if name in self.diagnosis.nuisances}
        stand_ins = {
            name: [s | {"parameters": as_told.parameters(s["parameters"], tables)} for s in others] for name, others in self.in_si()["stand_ins"].items()
        }
        return self.in_si() | {
            "effects": [effect_told(e, tables) for e in self.effects], "stand_ins": stand_ins,
            "base_off": [as_told.base_error(e, tables) for e in self.diagnosis.base_off], "held_out": held_out,
            "nuisances": as_told.numbers(nuisances, units, tables), "key_figures": as_told.figures(self.figures),
            "key_figures_after": as_told.figures(self.figures_after),
            "noise": as_told.noises(self.diagnosis.noise, {s: signals[s] for s in self.diagnosis.noise if s in signals}),
        }  # fmt: skip


def effect_told(effect: Mapping[str, Any], tables: Sequence[Table]) -> dict[str, Any]:
    """An effect, with its other forms, by the names and in the units that screen and page have."""
    return {**effect, "parameters": as_told.parameters(effect["parameters"], tables), "at_bounds": [as_told.told_name(n, tables) for n in effect["at_bounds"]],
            "forms": {form: [as_told.told_name(n, tables) for n in names] for form, names in effect["forms"].items()},
            "other_forms": [effect_told(form, tables) for form in effect["other_forms"]],
            "waves": [wave.as_json(tables) for wave in waves_of(effect["parameters"])]}  # fmt: skip


# What Ctrl-C says where there is no answer yet.
NOTHING_YET = "while the base model was fitted, from which everything else begins: nothing is known yet, and the same command begins anew"


class AnswerSoFar(KeyboardInterrupt):
    """Ctrl-C in a diagnosis; ``answer`` is what was known by then, and its ``doctor`` can go on."""

    def __init__(self, answer: Answer):
        super().__init__(answer.reason)
        self.answer = answer


@sharing_no_matrices
def diagnose(file: ModelFile, campaign: Campaign, settings: Settings = Settings(), model: PhysicalModel | None = None,
             jobs: int = 1, fmus: Path | None = None, doctor: Diagnostician | None = None) -> Answer:
    """The effect that the model lacks, a set that cannot be separated, none, or the law without a name; ``AnswerSoFar`` at Ctrl-C.

    ``fmus``: folder of FMUs to predict with, instead of their kernels in this process; ``doctor``: one that was interrupted, to go on from.
    """
    if doctor is not None and isinstance(doctor.model, PhysicalModel):
        model = doctor.model
    model = model or PhysicalModel(file, campaign, jobs=jobs, fmus=fmus)
    doctor = doctor or Diagnostician(model, settings, named_orders(model.bench, model.campaign.orders))
    try:
        doctor.prepare()
    except KeyboardInterrupt as stop:
        raise KeyboardInterrupt(NOTHING_YET) from stop
    try:
        figures = figures_of(doctor, model)
        beyond = out_of_reach(figures, model.bench)
    except KeyboardInterrupt:
        doctor.doing = "reading the key figures"
        raise AnswerSoFar(answer_of(model, doctor, doctor.stopped(), [])) from None
    try:
        other = reducer_words(model)
        for text in [*other, *too_rigid(figures, model.bench, available())]:
            say(text)
        found = doctor.run(GAIN, "; ".join([*other, beyond])) if beyond else doctor.run(calibrated_first(figures))
        return answer_of(model, doctor, found, figures_of(doctor, model) if doctor.anew else figures)
    except Interrupted as stop:
        raise AnswerSoFar(answer_of(model, doctor, stop.found, figures)) from None


def answer_of(model: PhysicalModel, doctor: Diagnostician, found: Diagnosis, figures: list[KeyFigure]) -> Answer:
    """A diagnosis with its effects by name, and the law where none is named."""
    effects = placed(effects_of(found, doctor), model, found)
    # What looks like a named one is no rival of it.
    alike = {name for effect in effects for name in effect["look_alike"]}
    found = replace(found, rejected=[r for r in found.rejected if r["name"] not in alike])
    verdict = found.verdict
    names = list(dict.fromkeys(e["name"] for e in effects))
    beside = "or it is the base model that is off" if verdict == SET else "beside that the base model is off"
    off = ", ".join(as_told.told_name(e.name, as_told.tables_of(model)) for e in found.base_off)
    reason = found.reason + (f"; {beside}: {off}" if effects and off else "")
    if verdict == NONE and (figure := beside_none(figures, doctor.space, doctor.localisation.groups)):
        reason += f"; {figure}"
    if verdict in (SET, SEVERAL) and len(names) == 1:
        reason = reason_of(effects[0], verdict)
        verdict = ONE
    best = found.fits.members[0] if found.fits.members else None
    # Fitted each by itself they are alternatives, whatever they leave.
    confusable = names if verdict == SET or (verdict == INCOMPLETE and len(names) > 1 and best and len(best.candidates) == 1) else []
    laws = []
    if verdict in (UNKNOWN, INCOMPLETE):
        space = found.fits.space
        fit = found.fits.members[0].fit if found.fits.members else space.base
        touched = {finding["signal"] for finding in found.localisation["findings"]}
        with task("recovering the law without a name"):
            laws = recover(space, fit, sorted(touched) or None, told_in(model))
    # Beside what is named a number may be what it should be.
    own = {p.name for p in best.own} if best else ()
    fit = best.fit if best else doctor.space.base
    doubts = calibrated_doubts(fit, as_told.tables_of(model), own, doctor.space.records, partial(gained_as_input, model, doctor.space, fit),
                               softer_by_loops(figures))  # fmt: skip
    doubts += hidden_by_position(doctor, found, as_told.tables_of(model))
    # Where nothing is missing, nothing was looked for.
    places = [text] if verdict != NONE and (text := unsearched_text(model)) else []
    doubts += unstated_texts(model, found)
    doubts += zero_texts(model, doctor.space, fit) + (too_rigid(figures, model.bench, available()) if verdict in (UNKNOWN, INCOMPLETE) else [])
    effects = seen_from_crank(with_others(effects, found), fit.values, model.file)
    effects = [effect | {"other_forms": forms_seen(effect["other_forms"], found, model.file)} for effect in effects]
    untold = origins_untold(effects, model.file, model.campaign) + parts_untold_before(model.file)
    untold += either_texts(effects, fit.values, model.file, bool(model.file.effects) or verdict == SEVERAL)
    # Who interrupts waits for nothing more.
    after = figures_of(doctor, model, fit.values) if best and figures and verdict != STOPPED else []
    # A stiffness that what is named explains is no riddle.
    warnings = untold + beforehand(model, after or figures) + doubts + places + warnings_of(model, list(found.warnings))
    warnings, zeros = list(dict.fromkeys(warnings)), zeros_told(model, fit)
    worth = would_show(found, model) if verdict == NONE else None
    return Answer(model, found, verdict, reason, effects, confusable, laws, warnings, figures, doctor, untold=untold, zeros=zeros, figures_after=after,
                  would_show=worth)  # fmt: skip


def told_in(model: PhysicalModel) -> Callable[[str], tuple[float, float, str]]:
    """Units of axes, factors and signals as the campaign and the field have them, for laws."""
    units = {stream_of(r): r.unit for r in model.records}

    def told(name: str) -> tuple[float, float, str]:
        if name not in units:
            scale = of_axis(name, model.campaign)
            return scale.factor, scale.offset, unit_of_axis(name, model.campaign)
        scale = of_signal(name, units[name])
        return scale.factor, scale.offset, "" if scale.unit == "1" else scale.unit

    return told


def reason_of(effect: dict[str, Any], verdict: str) -> str:
    """Of one effect in several forms: alternatives that look alike in this campaign, or forms that are all needed."""
    forms = ", ".join(c.partition(".")[2].replace("_", " ") for c in effect["candidates"])
    if verdict == SEVERAL:
        return f"in several forms, each significant beside the others: {forms}"
    return f"it explains the misfit; which of its forms it is this campaign cannot tell, for they look alike in it: {forms}"


def forms_seen(forms: Sequence[Mapping[str, Any]], found: Diagnosis, file: ModelFile) -> list[dict[str, Any]]:
    """Forms that fit as well as the one whose values are told, each with the other values and places that show the same in its own fit."""
    members = {m.name: m for m in found.fits.members}
    return [one for form in forms for one in seen_from_crank(with_others([form], found), members[form["candidates"][0]].fit.values, file)]


def added_of(effect: Mapping[str, Any]) -> list[str]:
    """Candidates of an effect that are added: all forms that were fitted together, of those that look alike the one whose values are told."""
    return list(effect["candidates"]) if effect["forms"] else list(effect["candidates"][:1])


def instead_of(effect: Mapping[str, Any]) -> list[str]:
    """Candidates that could be added in place of ``added_of`` the effect: its other forms, and other parts, that look alike in this campaign."""
    return [c for c in dict.fromkeys([*effect["candidates"], *effect.get("look_alike", ())]) if c not in added_of(effect)]


def effects_of(found: Diagnosis, doctor: Diagnostician) -> list[dict[str, Any]]:
    """Effects by name; what was fitted together has the share of each alone, too."""
    together = {c.name for c in found.fits.members[0].candidates} if found.fits.members else set()
    effects = merged([effect.to_dict() for effect in found.effects], together)
    if not found.fits.members or len(found.fits.members[0].candidates) < 2:
        return effects
    return [effect | {"share_alone": share_alone(effect["candidates"], doctor, found)} for effect in effects]


def share_alone(names: list[str], doctor: Diagnostician, found: Diagnosis) -> float:
    """Share of the misfit that one of several effects takes without the others: effects that do alike take it from each other beside them."""
    refits, together = doctor.refits, found.fits.members[0].gain
    whole = refits.fitted.get(frozenset(names))
    forms = [refits.fitted[key].gain if (key := frozenset([n])) in refits.fitted else refits.scores[n].statistic for n in names]
    gain = max([*forms, *([whole.gain] if whole else [])])
    return float(min(1.0, max(gain, 0.0) / max(together, 1e-300)) * found.captured)


def merged(effects: list[dict[str, Any]], together: Container[str]) -> list[dict[str, Any]]:
    """Variants of one effect under its name: the best speaks for those that are alternatives, all do that were fitted ``together``, with
    ``forms``: variant -> its parameters; ``other_forms`` are alternatives whole, each with its own values."""
    found: dict[str, dict[str, Any]] = {}
    for entry in effects:
        candidate = entry["name"]
        name, _, variant = candidate.partition(".")
        entry = entry | {"name": name, "variant": variant, "candidates": [candidate], "forms": {}, "other_forms": []}
        if name not in found:
            found[name] = entry
            continue
        first = found[name]
        if candidate in together and first["candidates"][0] in together:
            first["forms"] = (first["forms"] or {first["variant"]: list(first["parameters"])}) | {variant: list(entry["parameters"])}
            first["parameters"] |= entry["parameters"]
            first["variant"] = f"{first['variant']} + {variant}"
            first["at_bounds"] = [*first["at_bounds"], *entry["at_bounds"]]
            first["share_explained"] = min(1.0, first["share_explained"] + entry["share_explained"])
        else:
            first["other_forms"].append(entry)
        first["candidates"] += entry["candidates"]
    return list(found.values())
