"""Step 5: add an effect to the model, and see on runs that were never used whether it helped.

Every attempt becomes a step of the model's ladder, those that did not help too.  A gain on the
runs that the parameters were fitted to is never called a success.
"""

import difflib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, cast

from discrepancy.alike.already_there import AlreadyThere, numbers_of
from discrepancy.alike.opposite_sign import others_of
from discrepancy.alike.ring_directions import either_texts
from discrepancy.alike.untold import forms_untold, other_forms, parts_untold
from discrepancy.campaign.model import Campaign
from discrepancy.compare import by_signal, figures_of, runs_of
from discrepancy.doubts.locked_zeros import zeros_told
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.held_out.held_out import SEEN, WITHIN_NOISE, HeldOut, HeldOutJudge
from discrepancy.inference.noise.series import stream_of
from discrepancy.inference.refit.refit import Refit, estimates, leave_condition_out
from discrepancy.inference.telling import with_base
from discrepancy.inference.verdict import Settings
from discrepancy.model_file import ModelFile
from discrepancy.prediction.orders import named_orders
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import BASE, Candidate, Parameter, effect_of
from discrepancy.verdict import Answer
from discrepancy.words import as_told
from discrepancy.words.intervals import relied_on
from discrepancy.words.sample_errors import OF_PATTERNS, PATTERNS, patterns_text, plain, samples_text
from discrepancy.words.written_number import digits_of, rounded
from fmu_src.faults import InputFault
from fmu_src.progress import task
from fmu_src.threads import sharing_no_matrices

HELPED, NOT_PROVEN, DID_NOT_HELP = "helped", "not proven", "did not help"
# An error within this factor of the old one is no better.
BETTER = 0.97
# What chance leaves as often as this is not said to be left to explain.
BY_CHANCE = 0.05


class UnknownEffect(InputFault):
    """An effect that is not among the candidates; ``nearest`` are names that were perhaps meant, ``name`` what was asked for."""

    def __init__(self, name: str, nearest: list[str], text: str):
        super().__init__(text)
        self.name, self.nearest = name, nearest


@dataclass(frozen=True)
class Extension:
    """The extended model and the step of its ladder; ``file`` is the old one where the step did not help; ``units`` (SI) of its nuisances;
    ``figures`` are the key figures, each of the model before and with what was added."""

    file: ModelFile
    step: dict[str, Any]
    verdict: str
    units: dict[str, str] = field(default_factory=dict)
    figures: list[tuple[KeyFigure, KeyFigure]] = field(default_factory=list)

    def as_json(self) -> dict[str, Any]:
        signals = [as_told.row(r, r["signal"], r["unit"], ("before", "after", "noise_floor")) for r in self.step["signals"]]
        effects = {
            name: {as_told.effect_name(name, key): as_told.added(name, key, entry) for key, entry in numbers.items()}
            for name, numbers in self.file.effects.items()
        }
        step = self.step | {"signals": signals, "nuisances": as_told.numbers(self.step["nuisances"], self.units, as_told.tables_of(self.file))}
        return {"model": self.file.name, "verdict": self.verdict, "step": step, "effects": effects,
                "key_figures": as_told.figures([f for f, _ in self.figures]), "key_figures_after": as_told.figures([f for _, f in self.figures])}  # fmt: skip


@sharing_no_matrices
def extend(file: ModelFile, campaign: Campaign, names: list[str], settings: Settings = Settings(), anyway: bool = False,
           jobs: int = 1, answer: Answer | None = None, doctor: Diagnostician | None = None) -> Extension:
    """Fit the named candidates (``effect`` or ``effect.variant``) and add them; ``base.NUMBER`` corrects an assumed number of the reducer.

    ``anyway`` keeps an effect that did not help, for those who know better; ``answer`` is a diagnosis of the same to go on from, ``doctor`` one that was
    interrupted.
    """
    diagnostician = answer.doctor if answer else doctor or beginning(file, campaign, settings, jobs)
    # Whoever began made it in ``beginning``.
    model = answer.model if answer else cast(PhysicalModel, diagnostician.model)
    # A name that nobody knows is refused before minutes are spent.
    asked = [variants_of(name, model.candidates, file) for name in names]
    if not answer:
        with task("fitting the base model"):
            diagnostician.prepare()
        # Where a fit starts is known from the candidate's own score.
        with task(f"looking at what {', '.join(names)} would do"):
            diagnostician.screened([candidate for variants in asked for candidate in variants])
    space = diagnostician.space
    every = list(range(len(space.records)))
    before = by_signal(runs_of(space, space.predictions(space.base.values, every)))
    tried = [best_of(variants, diagnostician) for variants in asked]
    chosen, added = [best for best, _ in tried], {best.name for best, _ in tried}
    forms = {best.name: dict.fromkeys(near, "") | (other_forms(answer.effects, best.name, added) if answer else {}) for best, near in tried}
    with task(f"fitting {', '.join(c.name for c in chosen)}"):
        fit = diagnostician.final([c.name for c in chosen])
    effects = {k: dict(v) for k, v in file.effects.items()}
    others = others_of(fit, space)
    sure = intervals_of(diagnostician, fit, settings.coverage, answer)
    settings_found = dict(file.settings)
    for candidate in fit.candidates:
        if candidate.part == BASE:
            # A number of the reducer file that was assumed: from now on as it was measured.
            settings_found |= {p.name: known_to(fit.fit.values[p.name], sure[p.name]) for p in candidate.parameters}
            continue
        effects.setdefault(effect_of(candidate.name), {}).update({
            p.name: {"value": float(fit.fit.values[p.name]), "unit": p.unit,
                     "low": float(sure[p.name][0]), "high": float(sure[p.name][1])} | ({"alike": others[p.name]} if p.name in others else {})
            for p in candidate.parameters
        })  # fmt: skip
    extended = replace(file, effects=effects, settings=settings_found)
    with task("judging it on unused runs"):
        judged = judgement(diagnostician, fit, None) if diagnostician.space.held_out else None
        fitted = judgement(diagnostician, fit, diagnostician.space.training)
        outcome, reason = verdict_of(judged, lambda: goes_with(diagnostician, fit)) if judged is None or judged.seen else unseen(diagnostician, fit, judged)
    after = runs_of(diagnostician.space, diagnostician.space.predictions(fit.fit.values, every))
    figures = list(zip(figures_of(diagnostician, model), figures_of(diagnostician, model, fit.fit.values), strict=True))
    zeros = zeros_told(model, fit.fit)
    step = {
        "campaign": campaign.name, "effects": [c.name for c in chosen], "verdict": outcome, "reason": reason,
        "training_before": fitted.before if fitted else None, "training_after": fitted.after if fitted else None,
        "held_out_before": judged.before if judged else None, "held_out_after": judged.after if judged else None,
        "unseen": judged is not None and not judged.seen,
        "nuisances": {p.name: float(fit.fit.values[p.name]) for p in diagnostician.space.base.parameters} | zeros,
        "positions": zeros,
        "other_forms": {name: list(others) for name, others in forms.items() if others},
        "untold": [*forms_untold(forms), *(parts_untold([e for e in answer.effects if {c.name for c in chosen} & set(e["candidates"])]) if answer else []),
                   *either_told(fit, others, file)],
        "signals": [
            {"signal": a["signal"], "held_out": a["held_out"], "unit": a["unit"], "before": b["error"], "after": a["error"],
             "noise_floor": a["noise_floor"]}
            for b, a in zip(before, by_signal(after))
        ],
    }  # fmt: skip
    # What was tested on unused runs and did not help there stays out.
    keep = outcome == HELPED or judged is None or (outcome == NOT_PROVEN and not judged.seen) or anyway
    step["kept"] = keep
    return Extension(replace(extended if keep else file, steps=(*file.steps, step)), step, outcome,
                     {p.name: p.unit for p in diagnostician.space.base.parameters}, figures)


def either_told(fit: Refit, others: Mapping[str, float], file: ModelFile) -> list[str]:
    """What stays open of numbers that were fitted and of which ``others`` show the same."""

    def told(p: Parameter) -> dict[str, Any]:
        return {"value": fit.fit.values[p.name], "direction": p.is_direction} | ({"alike": others[p.name]} if p.name in others else {})

    effects = [{"candidates": [c.name], "parameters": {p.name: told(p) for p in c.parameters}} for c in fit.candidates]
    return either_texts(effects, fit.fit.values, file, bool(file.effects) or len(fit.candidates) > 1)


def beginning(file: ModelFile, campaign: Campaign, settings: Settings = Settings(), jobs: int = 1) -> Diagnostician:
    """One that has done nothing yet."""
    model = PhysicalModel(file, campaign, jobs=jobs)
    return Diagnostician(model, settings, named_orders(model.bench, campaign.orders))


def intervals_of(doctor: Diagnostician, fit: Refit, coverage: float, answer: Answer | None) -> dict[str, tuple[float, float]]:
    """By parameter the interval to rely on, as the diagnosis of the same fit tells it."""
    numbers = {e.name: e for e in estimates(doctor.space, fit, coverage, doctor.inflation(fit))}
    names = {c.name for c in fit.candidates}
    if answer and any({c.name for c in member.candidates} == names for member in answer.diagnosis.fits.members):
        told = {name: relied_on(entry) for e in answer.diagnosis.effects if e.name in names for name, entry in e.parameters.items()}
    else:
        freed = doctor.beside_base(fit)
        told = {p.name: relied_on({"interval": numbers[p.name].interval} | with_base(numbers[p.name], p, freed)) for p in fit.own}
    return {name: e.interval for name, e in numbers.items()} | told


def known_to(value: float, interval: tuple[float, float]) -> float:
    """A number of the reducer with the digits that it was measured to: a setting has no interval that would say them later."""
    return rounded(float(value), digits_of(float(value), 0.5 * (interval[1] - interval[0])))


def variants_of(name: str, candidates: Sequence[Candidate], file: ModelFile) -> list[Candidate]:
    """Candidates of a name: one variant, or all those of an effect."""
    if exact := [c for c in candidates if c.name == name]:
        return exact
    variants = [c for c in candidates if effect_of(c.name) == name]
    if numbers := numbers_of(name, file):
        # Of an effect that is there another form is not meant by the name alone.
        raise AlreadyThere(name, file, numbers, [c.name for c in variants])
    if not variants:
        known = sorted({c.name for c in candidates})
        plain = [*known, *{c.partition(".")[0] for c in known}]
        nearest = difflib.get_close_matches(name, plain, 1) or difflib.get_close_matches(effect_of(name), plain, 1)
        text = f"effect {name!r}: not among those that this campaign can show and the model lacks"
        raise UnknownEffect(name, nearest, text + (f"; did you mean {nearest[0]}?" if nearest else f": {', '.join(known)}"))
    return variants


def best_of(variants: list[Candidate], diagnostician: Diagnostician) -> tuple[Candidate, list[str]]:
    """The variant that fits best, and the names of those that fit as well."""
    if len(variants) == 1:
        return variants[0], []
    misfits = []
    with task("trying each form", total=len(variants)) as trying:
        for candidate in variants:
            trying.what = f"trying {candidate.name}"
            misfits.append(diagnostician.fit([candidate.name]).fit.chi2)
            trying.advance()
    ordered = sorted(zip(misfits, variants), key=lambda pair: pair[0])
    return ordered[0][1], [c.name for misfit, c in ordered[1:] if misfit - ordered[0][0] <= diagnostician.settings.margin]


def judgement(diagnostician: Diagnostician, fit: Refit, indices: Sequence[int] | None) -> HeldOut | None:
    """The misfit in the patterns before and after, on the held-out runs or on those of ``indices``: the one that a diagnosis gives, too."""
    return HeldOutJudge(diagnostician.space, diagnostician.localisation, [fit], diagnostician.orders, indices=indices).judge(fit)


def goes_with(diagnostician: Diagnostician, fit: Refit) -> str:
    """The condition by which effects should be larger here and smaller there, or that what a fit leaves of the fitted runs goes with, most; empty for none."""
    _, _, left, _ = diagnostician.judgement.leftover(fit)
    conditions = {name for record in diagnostician.space.records for name in record.factors}
    uneven = {name: test["statistic"] - test["width"] for name, test in left["dependence"].items()
              if name in conditions and test["p"] < diagnostician.settings.leftover_level}  # fmt: skip
    return max(uneven, key=lambda name: uneven[name]) if uneven else next((f["dependence"] for f in left["findings"] if f["dependence"] in conditions), "")


def verdict_of(judged: HeldOut | None, condition: Callable[[], str] = str) -> tuple[str, str]:
    """``condition``: that which what is left goes with, for who asks."""
    if judged is None:
        return NOT_PROVEN, (
            "no run was held out: the error on the runs that were fitted fell, which any effect can achieve;"
            " measure at a condition that was not used, or mark one as held_out"
        )
    # Patterns stand out of noise that drowns single samples.
    drowned = bool(judged.rms) and all(row["before"] <= row["floor"] for row in judged.rms.values())
    little = "; single samples are off by less than their noise" if drowned else ""
    samples = f"{samples_text(judged.rms, plain)}; " if judged.rms else ""
    patterns = patterns_text(judged.before, judged.after)
    if judged.before <= WITHIN_NOISE and judged.after <= WITHIN_NOISE:
        return NOT_PROVEN, (
            f"{samples}{patterns}: within the noise before and after, the unused runs do not show this effect; hold out a condition that does"
        )
    if judged.after < BETTER * judged.before:
        over = judged.after > WITHIN_NOISE and judged.p_after < BY_CHANCE
        name = condition() if over else ""
        with_what = f", and it goes with {name}" if name else ""
        left = f"; not enough: {judged.after:.1f} times what noise leaves in the patterns is still left to explain{with_what}" if over else ""
        return HELPED, f"{samples}{patterns}{little}{left}"
    return DID_NOT_HELP, (
        f"{samples}{patterns}{little}: on unused runs it did not fall, although on fitted runs it did; the effect fits noise or stands for another one;"
        " the model stays as it was"
    )


def unseen(diagnostician: Diagnostician, fit: Refit, judged: HeldOut) -> tuple[str, str]:
    """Of an effect that does next to nothing in the unused runs: conditions that are left out in turn judge it instead."""
    space = diagnostician.space
    acts = sorted({stream_of(space.records[i]) for c in fit.candidates for i in space.touched(c)})
    blind = sorted({stream_of(space.records[i]) for i in space.held_out})
    before, after = (sum(leave_condition_out(space, f).values()) / space.size for f in (space.base, fit.fit))
    told = (
        f"no unused run can judge it: it acts on {', '.join(acts)}, and changes the unused runs of {', '.join(blind)} by less than {SEEN:g} times the noise"
        f" in all ({there_text(judged)})"
    )
    left_out = "with one condition left out at a time the misfit"
    if after < BETTER * before:
        return NOT_PROVEN, (
            f"{told}; {left_out} falls from {before:.2f} to {after:.2f} of chi-square per value,"
            f" which speaks for it; hold out a condition of {acts[0]} to prove it"
        )
    return DID_NOT_HELP, (
        f"{told}; {left_out} does not fall ({before:.3g} -> {after:.3g} of chi-square per value), which decides: the model stays as it was"
    )


def there_text(judged: HeldOut) -> str:
    """What becomes of unused runs that an effect hardly changes: few patterns show a growth of the misfit that decides nothing."""
    before, after = f"{judged.before:.2f}", f"{judged.after:.2f}"
    went = f"stays at {after}" if before == after else f"{'grows' if judged.after > judged.before else 'falls'} from {before} to {after}"
    return f"the {PATTERNS} there {went}; {OF_PATTERNS}"


def build_units(model: Path, folder: Path) -> list[Path]:
    """The FMUs of an extended model's file, its effects switched on: named after model and file as those of ``rvwear build``."""
    # Here, so that a diagnosis that builds nothing does not load what writes FMUs.
    from discrepancy.named_reducer import named_reducer
    from studies import building

    built, packages = building.build_units(named_reducer(model), folder)
    return [Path(entry["fmu"]) for entry in built] + packages
