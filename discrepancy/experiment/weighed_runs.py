"""Experiments that the rig can do, held against what several models predict of them: which tells those apart, and which was measured already."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from discrepancy.alike.ring_directions import by_symmetry
from discrepancy.campaign.model import Campaign
from discrepancy.experiment.rig_runs import Measurement, at_a_position, at_rated, describe, possible
from discrepancy.held_names import LOCKED_POSITION
from discrepancy.inference.chi_square import chi_text
from discrepancy.inference.next_experiment import ENOUGH, NextExperiment, Proposal, RivalLaw, next_experiment, rival_of
from discrepancy.inference.noise.series import stream_of
from discrepancy.problem import Record, is_unplaced
from discrepancy.words.as_told import effect_name, is_direction
from fmu_src.arrays import Floats
from fmu_src.effect_words import effect_words

if TYPE_CHECKING:
    from discrepancy.verdict import Answer


# Where a campaign does not say what its rig can do.
UNSTATED_RIG = (
    "by another run of what was measured, within the ranges of this campaign (it states no [rig], so that nothing beyond them was weighed: [rig] says"
    " what else can be set and measured): none"
)
# So many forms of one effect are held against each other.
MOST_FORMS = 4


def weighed(answer: "Answer", campaign: Campaign, rivals: Sequence[RivalLaw]) -> NextExperiment:
    """Every experiment that the rig can do, held against what the rivals predict of it."""
    experiments = possible(answer.model, campaign, answer.diagnosis.fits.space)
    if any(LOCKED_POSITION in rival.name for rival in rivals):
        experiments += [at_a_position(e, campaign) for e in experiments if is_unplaced(e.record)]

    def predict(rival: RivalLaw, values: Mapping[str, float], experiment: Measurement) -> Floats:
        return answer.model.one(experiment.record, {**answer.model.zeros, **values})

    def naming(p: Proposal) -> str:
        return f"{p.kind} at {describe(p.settings, campaign, p.spans)}"

    limits = "on this rig: no setting within its limits" if campaign.rig else UNSTATED_RIG
    return next_experiment(predict, experiments, rivals, interests=at_rated(answer.model), naming=naming, limits=limits)


def telling_forms(answer: "Answer", campaign: Campaign) -> list[str]:
    """Of effects of which several forms fit as well: the run that tells which it is, or that none of those does that the rig can do."""
    members = {member.name: member for member in answer.diagnosis.fits.members}
    texts = []
    for effect in answer.effects:
        others = effect.get("other_forms", ())
        if not others:
            continue
        forms = [members[one["candidates"][0]] for one in (effect, *others)]
        least = min(form.fit.chi2 for form in forms)
        result = weighed(answer, campaign, [rival_of(form, None, least) for form in forms[:MOST_FORMS]])
        names = " or ".join(form.name.partition(".")[2].replace("_", " ") for form in forms)
        none = "no run of what was measured tells; another quantity may (quantities of [rig]), or a gauge at the part itself"
        found = result.verdict if any(p.score >= ENOUGH for p in result.proposals) else none
        texts.append(f"which form of {effect_words(effect['name'])} it is, {names}: {found}")
    return texts


def telling_either(answer: "Answer", campaign: Campaign) -> list[str]:
    """Of numbers that are named, or stand in the model file, and of which another value shows the same in the runs so far: the cheapest run that tells which
    of the two it is, or that none does; nothing of those that no run can tell."""
    texts = []
    for told, there in either_of(answer):
        here = law_of(answer)
        result = weighed(answer, campaign, [here, replace(here, name=f"{here.name}, otherwise", values={**here.values, **there})])
        # What was measured did not tell.
        new = [proposal for proposal in result.proposals if proposal.least >= ENOUGH and not measured_in(proposal, campaign)]
        run = f"{new[0].experiment} tells that, the cheapest that does ({apart_text(new[0])})" if new else "no run within the limits tells that by itself"
        texts.append(f"{told}: {run}")
    return texts


def either_of(answer: "Answer") -> list[tuple[str, dict[str, float]]]:
    """What is asked, and the other values, of numbers of which others show the same and which no symmetry of the reducer hides."""
    file, members = answer.model.file, answer.diagnosis.fits.members
    named = [(effect["name"], effect["parameters"]) for effect in answer.effects] if len(members) == 1 else []
    more = len({name for name, _ in named} | file.effects.keys()) > 1
    found = []
    for effect, entries in [*named, *file.effects.items()]:
        others = {name: entry["alike"] for name, entry in entries.items() if "alike" in entry}
        turned = [name for name in others if is_direction(effect, name)]
        found += [(f"which of the two {effect_name(effect, name)} is", {name: others[name]})
                  for name in turned if not by_symmetry(name, file.reducer.topology, more)]  # fmt: skip
        if signs := {name: other for name, other in others.items() if name not in turned}:
            found.append((f"which way {effect_words(effect)} {'go' if effect.endswith('s') else 'goes'}", signs))
    return found


def law_of(answer: "Answer") -> RivalLaw:
    """The model with what is named, or as it is calibrated where nothing is."""
    if members := answer.diagnosis.fits.members:
        return rival_of(members[0], 1.0)
    base = answer.diagnosis.fits.space.base
    scales, covariance = np.array([p.scale for p in base.parameters]), np.linalg.pinv(base.normal, hermitian=True).astype(float)
    return RivalLaw("the model", dict(base.values), base.names, covariance, scales)


def apart_text(best: Proposal) -> str:
    """How far two rivals lie apart in an experiment."""
    return f"they differ there by {chi_text(best.least)} in chi-square, where {ENOUGH:g} is enough"


def measured_in(proposal: Proposal, campaign: Campaign) -> list[str]:
    """Conditions in which the campaign has a run of what is proposed: at the same settings, where these make no difference within their span; of what no
    run states nothing is asked."""
    stated = {name for record in campaign.records for name in record.factors}
    wanted = {name: proposal.spans.get(name, (value, value)) for name, value in proposal.settings.items() if name in stated}

    def alike(record: Record) -> bool:
        return stream_of(record) == proposal.kind and all(within(record.factors.get(name), span) for name, span in wanted.items())

    return list(dict.fromkeys(record.condition for record in campaign.records if alike(record)))


def within(value: float | None, span: tuple[float, float]) -> bool:
    return value is not None and (span[0] <= value <= span[1] or any(math.isclose(value, end, rel_tol=1e-9, abs_tol=1e-9) for end in span))
