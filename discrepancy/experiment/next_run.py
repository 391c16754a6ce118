"""Step 6: the cheapest next experiment that would separate what is left, within the rig's limits."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field, replace
from itertools import pairwise
from typing import Any

import numpy as np

from discrepancy.alike.untold import asked_of_runs, origins_untold, parts_untold, parts_untold_before, repeated
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.quantities import QUANTITIES
from discrepancy.campaign.unplaced import QUESTION, REMEDY
from discrepancy.doubts.unstated_texts import without_place
from discrepancy.experiment.rig_runs import (
    REPEATS,
    describe,
    limits,
)
from discrepancy.experiment.weighed_runs import apart_text, measured_in, telling_either, telling_forms, weighed
from discrepancy.inference.chi_square import chi_text
from discrepancy.inference.next_experiment import ENOUGH, NextExperiment, rival_of
from discrepancy.inference.noise.series import stream_of
from discrepancy.inference.refit.refit import Refit
from discrepancy.inference.verdict import BASE_OFF, INCOMPLETE, NONE, ONE, UNKNOWN, Settings
from discrepancy.model_file import ModelFile
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import BASE, is_unplaced
from discrepancy.remembered import diagnosed
from discrepancy.scales import shown
from discrepancy.verdict import Answer
from discrepancy.words import as_told
from discrepancy.words.clauses import clauses
from fmu_src.effect_words import effect_words
from fmu_src.threads import sharing_no_matrices

MOST_RIVALS = 4
# What a rig can set, so that a misfit over it can be asked for; lines of such questions, and values named in one.
FACTORS_SET = ("speed", "load", "temperature", "hours")
MOST_OPEN, MOST_TEXTS = 4, 6
# What a misfit that is the same everywhere is asked for, and what the answer decides.
MOUNTED_ANEW = (
    "off at all conditions alike, so that no other condition says more; mount sensor and unit anew and repeat: a misfit that changes with the mounting"
    " comes from the bench (sensor, its seat, alignment), one that stays from the reducer,"
    " from a scale that no mounting changes, or from the numbers of the base model"
)
# Of loops in which that may be the position of the input, which no mounting tells.
POSITION_MISSING = (
    f"{QUESTION}, so that they are predicted as the mean over a turn of the cranks: what is left at all conditions alike may be the position, which is"
    f" missing before anything is mounted anew; {REMEDY}"
)


@dataclass(frozen=True)
class Asked:
    """An experiment that shows a misfit better that nothing explains: ``like`` is the condition that has all else, ``cost`` that of its runs,
    ``expected`` what they are off by [chi-square] if it goes on as in the runs of this signal; None where no law says so."""

    experiment: str
    why: str
    like: str = ""
    cost: float | None = None
    expected: float | None = None

    @property
    def text(self) -> str:
        return f"{self.experiment}: {self.why}"


@dataclass(frozen=True)
class NextRun:
    """``proposals`` best first; ``rivals`` are what they separate; ``asked``: what shows a misfit better that nothing explains, or, where
    nothing is missing, what these runs cannot show; ``untold``: with what
    the verdict begins, which no run of these signals tells."""

    answer: Answer
    result: NextExperiment | None
    rivals: list[str]
    verdict: str
    asked: list[Asked] = field(default_factory=list)
    untold: list[str] = field(default_factory=list)

    @property
    def lines(self) -> list[str]:
        """The verdict a clause a line: whole it has a hundred words and more."""
        return clauses(self.verdict)

    @property
    def open(self) -> list[str]:
        """What is asked for, in words."""
        return [asked.text for asked in self.asked]

    def as_json(self) -> dict[str, Any]:
        plain = self.result.to_dict() if self.result else {"separable": None, "proposals": [], "at_stake": {}}
        campaign = self.answer.model.campaign
        for proposal in plain["proposals"]:
            proposal["settings"] = {name: as_told.setting(name, value, campaign) for name, value in proposal["settings"].items()}
            proposal["spans"] = {name: [as_told.setting(name, value, campaign) for value in span] for name, span in proposal["spans"].items()}
        plain["at_stake"] = {name: {"text": text, "si": self.result.at_stake[name]} for name, text in self.stakes().items()} if self.result else {}
        return plain | {"verdict": self.verdict, "lines": self.lines, "rivals": self.rivals, "diagnosis": self.answer.verdict, "open": self.open,
                        "asked": [asdict(asked) for asked in self.asked]}  # fmt: skip

    @property
    def cost_unit(self) -> str:
        """What costs are counted in: the rig's currency, runs where the campaign has no rig; empty where the rig does not say."""
        rig = self.answer.model.campaign.rig
        return "runs" if rig is None else rig.currency if rig.currency != "1" else ""

    def stakes(self) -> dict[str, str]:
        """By which the rivals differ where the reducer is used, in the unit of each signal."""
        signals = {name: name.partition(" at ")[0] for name in (self.result.at_stake if self.result else {})}
        return {
            name: shown(size, QUANTITIES[signals[name].partition("[")[0]].unit, signals[name])
            for name, size in (self.result.at_stake.items() if self.result else ())
        }


@sharing_no_matrices
def next_run(file: ModelFile, campaign: Campaign, settings: Settings = Settings(), jobs: int = 1) -> NextRun:
    """Diagnose, or take the diagnosis from before, and propose what to measure next."""
    answer = diagnosed(file, campaign, settings, jobs)
    try:
        return proposal_for(answer, campaign)
    except KeyboardInterrupt as stop:
        raise KeyboardInterrupt("while experiments were weighed: the diagnosis is kept, and the same command goes on from there") from stop


def proposal_for(answer: Answer, campaign: Campaign) -> NextRun:
    """What to measure next after a diagnosis."""
    fits = answer.diagnosis.fits
    # Where nothing is missing, what came nearest is no suspect.
    members = fits.members or ([] if answer.verdict == NONE else fits.rivals[:MOST_RIVALS])
    names: dict[str, Refit] = {}
    for member in members:
        # Variants of one effect need no separation: the effect is known.
        names.setdefault(plainly(member), member)
    unexplained = answer.verdict in (INCOMPLETE, UNKNOWN)
    left = open_questions(answer, campaign) if unexplained else []
    known = effect_words(" and ".join(names)) if fits.members else ""
    start = f"{f'beside {known} ' if known else ''}something is left {answer.left_over}" if unexplained else ""
    if answer.verdict == BASE_OFF and len(names) < 2:
        off = ", ".join(as_told.told_name(e.name, as_told.tables_of(answer.model)) for e in answer.diagnosis.base_off)
        number = f"no effect is missing: the base model is off ({off}); correct it (rvwear extend) or declare it as a nuisance"
        # Of no number, it is the model as a whole.
        text = f"{number if fits.members else f'{answer.reason}; mend that'}, then ask again"
        return NextRun(answer, None, list(names), text, left)
    if len(names) < 2:
        against = confirming(answer, campaign, members[0]) if answer.verdict == ONE and members else ""
        untold = [*questions_left(answer, campaign), *([] if unexplained else telling_forms(answer, campaign))]
        text = start or rest_text(stands_text(known, answer) if known else "nothing is missing that this campaign shows", untold, campaign)
        before = of_model_before(answer) if answer.verdict == NONE else ""
        either = [] if unexplained else telling_either(answer, campaign)
        # What is not missing as far as these runs show may be so for what they do not show.
        left = left or [Asked(f.remedy, f.text) for f in (answer.would_show.lacking if answer.would_show else ())]
        return NextRun(answer, None, list(names), "; ".join(filter(None, [*untold, *either, text, against, before])), left, untold)
    chosen = list(names.values())[:MOST_RIVALS]
    least = min(member.fit.chi2 for member in chosen)
    result = weighed(answer, campaign, [rival_of(member, None, least) for member in chosen])
    verdict = f"{start}; of those that come nearest {result.verdict}" if start else "; ".join([result.verdict, *telling_forms(answer, campaign)])
    return NextRun(answer, result, [member.name for member in chosen], verdict, left)


def questions_left(answer: Answer, campaign: Campaign) -> list[str]:
    """What is named, or stands in the model file, leaves open: first what runs can answer after a change, then what another run tells or none can."""
    left = list(dict.fromkeys([*origins_untold(answer.effects, answer.model.file, campaign), *parts_untold(answer.effects),
                               *parts_untold_before(answer.model.file), *answer.untold]))  # fmt: skip
    by_runs = asked_of_runs(left)
    return by_runs + [text for text in left if text not in by_runs]


def stands_text(known: str, answer: Answer) -> str:
    """That what is named has no rival, or has those that the diagnosis lists."""
    others = [f"{name} could as well be {' or '.join(found)}" for name, found in answer.diagnosis.alternatives.items()]
    return f"{known} stands; {', '.join(others)}, which this campaign does not tell" if others else f"{known} stands alone"


def rest_text(stands: str, untold: Sequence[str], campaign: Campaign) -> str:
    """What is said of an answer that needs no separating: that this is all, or that questions are open and what they cost, never both."""
    by_runs = asked_of_runs(untold)
    if not by_runs:
        return f"{'apart from that ' if untold else ''}nothing is left to separate: {stands}"
    cost = f"{REPEATS * campaign.rig.cost_per_run:g} {campaign.rig.currency.removeprefix('1')}".rstrip() if campaign.rig else f"{REPEATS} runs"
    which = "this" if len(untold) == 1 else "only the first of these" if len(by_runs) == 1 else f"the first {len(by_runs)} of these"
    asked = f"{which} can still be asked: {'it' if len(by_runs) == 1 else 'each'} costs"
    return f"{asked} the change itself and {cost} after it: {REPEATS} repetitions of {repeated(campaign)}; apart from that {stands}"


def of_model_before(answer: Answer) -> str:
    """Who asks for what a model has already is told nothing: what would confirm that is asked of the model without it."""
    added = [effect_words(name) for name in answer.model.file.effects]
    if not added:
        return ""
    told = f"which run tells {' and '.join(added)}, which its file has, from what came nearest to it"
    return f"{told} is asked of the model that it was added to (`rvwear next` of that)"


def confirming(answer: Answer, campaign: Campaign, named: Refit) -> str:
    """Of an effect that stands alone: what came nearest behind it, by how much, and which experiment holds the two against each other; empty where nothing
    else was fitted."""
    others = [rival for rival in answer.diagnosis.fits.rivals if plainly(rival) != plainly(named)]
    if not others:
        return ""
    nearest = min(others, key=lambda rival: rival.fit.chi2)
    worse = nearest.fit.chi2 - named.fit.chi2
    how = f"fits worse by {chi_text(worse)} in chi-square" if worse > 0.0 else "fits as well and was turned down for what the diagnosis says of it"
    said = f"nearest of other effects comes {effect_words(plainly(nearest))}, which {how}"
    # Alike in weight: how likely each is by now is told already.
    result = weighed(answer, campaign, [rival_of(one, 1.0) for one in (named, nearest)])
    if not result.proposals:
        return said
    best = result.proposals[0]
    for proposal in result.proposals:
        if proposal.least >= ENOUGH and (there := measured_in(proposal, campaign)):
            # What is decided need not be measured again.
            return f"{said}; the runs of {proposal.kind} in {' and '.join(there)} tell them apart already ({apart_text(proposal)})"
    if best.least >= ENOUGH:
        return f"{said}; whoever wants it confirmed against that measures {best.experiment}, the cheapest that tells them apart ({apart_text(best)})"
    most = f"most {best.experiment} ({apart_text(best)})"
    return f"{said}; no further experiment within the limits would tell these apart by itself, {most}"


def plainly(member: Refit) -> str:
    """Effects without their variants, numbers of the base model by their own names."""
    pairs = (name.partition(".") for name in member.name.split(" + "))
    return " + ".join(dict.fromkeys(f"the base's {variant}" if effect == BASE else effect for effect, _, variant in pairs))


def open_questions(answer: Answer, campaign: Campaign) -> list[Asked]:
    """Where a misfit that nothing explains should be measured: at the widest gaps of what it changes with."""
    findings = answer.diagnosis.leftover.get("findings") or answer.diagnosis.localisation.get("findings", [])
    left: dict[tuple[str, str], float] = {}
    for f in findings:
        key = f["signal"], f["dependence"]
        left[key] = max(left.get(key, 0.0), f.get("statistic", 0.0))
    for law in answer.laws:
        left.setdefault((law.signal, law.leading), 0.0)
    cost = REPEATS * (campaign.rig.cost_per_run if campaign.rig else 1.0)
    asked = []
    unplaced = set(without_place(answer.model, answer.diagnosis))
    for (signal, name), size in left.items():
        runs = sum(stream_of(r) == signal and r.fitted for r in answer.model.records)
        expected = REPEATS * size / runs if size and runs else None
        missing = dict.fromkeys(r.condition for r in answer.model.records if stream_of(r) == signal and is_unplaced(r) and r.condition in unplaced)
        if name == "everywhere" and missing:
            # It costs nothing where somebody knows it.
            asked.append(Asked(signal, POSITION_MISSING, f"loops in {', '.join(missing)}"))
        elif name == "everywhere":
            asked.append(Asked(signal, MOUNTED_ANEW, "any condition of it, in another mounting", cost, expected))
        elif name in FACTORS_SET:
            asked.append(replace(at_gap(signal, name, answer.model, campaign), cost=cost, expected=expected))
    return asked[:MOST_OPEN] or [
        Asked("what is left shows no place and no dependence", "repeat the runs that are off, and measure at conditions between those that there are:"
              " what comes again is the reducer's or the bench's, what does not is noise beyond what repetitions told")
    ]


def at_gap(signal: str, name: str, model: PhysicalModel, campaign: Campaign) -> Asked:
    """The value of a factor furthest from those at which the signal was measured, within the rig's limits."""
    seen = [v for r in model.records if stream_of(r) == signal for v in np.atleast_1d(r.axes.get(name, r.factors.get(name, np.nan)))]
    measured = sorted({float(v) for v in seen if np.isfinite(v)})
    low, high = limits(name, model, campaign.rig, campaign)
    ends = [v for v in (low, high) if low <= high]
    trials = ends + [0.5 * (a + b) for a, b in pairwise(measured)]
    best = max(trials, key=lambda v: min((abs(v - m) for m in measured), default=0.0), default=low)
    texts = list(dict.fromkeys(describe({name: v}, campaign) for v in measured))
    stated = [r for r in model.records if stream_of(r) == signal and name in r.factors]
    like = min(stated, key=lambda r: abs(float(r.factors[name]) - best)).condition if stated else ""
    return Asked(f"{signal} at {describe({name: best}, campaign)}", f"what is left changes with {name}, measured at {', '.join(texts[:MOST_TEXTS])}",
                 f"all else as {like}" if like else "")  # fmt: skip


